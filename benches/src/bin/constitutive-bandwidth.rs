//! P of 10⁶ points beside a copy of as many bytes, in turn: `taskset -c 1 cargo run --release -p piola-benches --bin
//! constitutive-bandwidth`.
//!
//! Medians of forty turns, nanoseconds a point: what one turn of the machine's memory does to one of them it does to all.
#![expect(clippy::print_stdout, reason = "a program that prints a table")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_batch::{Gradients, LaneBlocks};
use piola_benches::constitutive::WithoutTangent;
use piola_benches::constitutive::laws;
use piola_benches::continuum::ordinary_deformations;
use piola_solids::batch;
use piola_solids::isochoric::{Gent, NeoHookean, Yeoh};
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, ElasticConstants, Hyperelastic, LinearElastic, SaintVenantKirchhoff};

const POINTS: usize = 1_000_000;
const BLOCK: usize = 8;
const TURNS: usize = 40;

type Blocks = Vec<[[f64; BLOCK]; 9]>;

/// Nanoseconds a point of every turn.
struct Times {
    name: &'static str,
    turns: Vec<f64>,
}

impl Times {
    fn of(name: &'static str) -> Self {
        Self { name, turns: Vec::with_capacity(TURNS) }
    }

    fn median(&mut self) -> f64 {
        self.turns.sort_by(f64::total_cmp);
        self.turns[self.turns.len() / 2]
    }
}

fn stress<L: Hyperelastic + Sync>(
    times: &mut Times,
    law: &L,
    gradients: &Blocks,
    stresses: &mut Blocks,
) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let to = LaneBlocks::new_mut(stresses, POINTS)?;
    batch::evaluate(black_box(Gradients(LaneBlocks::new(gradients, POINTS)?)), batch::first_piola(black_box(law), to))?;
    times.turns.push(start.elapsed().as_secs_f64() * 1e9 / POINTS as f64);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let bulk = Quadratic::new(20.0)?;
    let (rubber, isochoric) = (laws::mooney_rivlin()?, laws::mooney_rivlin_isochoric()?);
    let (neo_hookean, yeoh) = (Compressible::new(NeoHookean::new(0.8)?, bulk), Yeoh::new(0.5, -0.02, 0.001)?);
    let (yeoh, gent) = (Compressible::new(yeoh, bulk), Compressible::new(Gent::new(1.0, 50.0)?, bulk));
    let (kirchhoff, linear) =
        (SaintVenantKirchhoff::new(1.5, 0.75)?, LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75)?)?);
    let names = [
        "copy",
        "Mooney–Rivlin",
        "Mooney–Rivlin without a tangent",
        "Mooney–Rivlin, isochoric",
        "neo-Hookean, isochoric",
        "Yeoh",
        "Gent",
        "St. Venant–Kirchhoff",
        "linear",
    ];
    let mut times = names.map(Times::of);
    let f = ordinary_deformations(POINTS);
    let component = |b: usize, k: usize| core::array::from_fn(|lane| f[BLOCK * b + lane].matrix()[(k / 3, k % 3)]);
    let gradients: Blocks = (0..POINTS / BLOCK).map(|b| core::array::from_fn(|k| component(b, k))).collect();
    let mut stresses: Blocks = vec![[[0.0; BLOCK]; 9]; POINTS / BLOCK];
    for _ in 0..TURNS {
        let start = Instant::now();
        black_box(&mut stresses[..]).copy_from_slice(black_box(&gradients));
        times[0].turns.push(start.elapsed().as_secs_f64() * 1e9 / POINTS as f64);
        stress(&mut times[1], &rubber, &gradients, &mut stresses)?;
        stress(&mut times[2], &WithoutTangent(rubber), &gradients, &mut stresses)?;
        stress(&mut times[3], &isochoric, &gradients, &mut stresses)?;
        stress(&mut times[4], &neo_hookean, &gradients, &mut stresses)?;
        stress(&mut times[5], &yeoh, &gradients, &mut stresses)?;
        stress(&mut times[6], &gent, &gradients, &mut stresses)?;
        stress(&mut times[7], &kirchhoff, &gradients, &mut stresses)?;
        stress(&mut times[8], &linear, &gradients, &mut stresses)?;
    }
    let copy = times[0].median();
    println!("| | ns a point | share of the copy's speed |");
    println!("|---|---|---|");
    for times in &mut times {
        let median = times.median();
        println!("| {} | {median:.2} | {:.0} % |", times.name, 100.0 * copy / median);
    }
    Ok(())
}
