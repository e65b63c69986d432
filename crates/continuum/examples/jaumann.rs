//! Times and difference of two ways from P and ∂P/∂F to the tangent of Jaumann's rate, Abaqus' `DDSDDE`: directly, and through ∂S/∂E.
//!
//! ```sh
//! cargo build --release -p piola-continuum --example jaumann && taskset -c 1 target/release/examples/jaumann
//! ```
#![expect(clippy::print_stdout, reason = "prints a table")]

use std::hint::black_box;
use std::time::Instant;

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{ContinuumError, DeformationGradient, FirstPiola, SecondPiola};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{LaneKernel, Lanes, Real, dispatch_lanes};
use piola_tensor::{FourthOrder, MajorSymmetric, PairSymmetric, Symmetric};

/// Numbers of a point: F, P, ∂P/∂F by rows.
const NUMBERS: usize = 99;
const POINTS: usize = 1000;

#[inline(always)]
fn converted<const DIRECT: bool, T: Real>(numbers: &[T; NUMBERS]) -> [T; 21] {
    let row = |first: usize| [numbers[first], numbers[first + 1], numbers[first + 2]];
    let f = DeformationGradient::trusted([row(0), row(3), row(6)]);
    let p = FirstPiola(from_rows([row(9), row(12), row(15)]));
    let mut components = [[T::zero(); 9]; 9];
    let mut k = 0;
    while k < 81 {
        components[k / 9][k % 9] = numbers[18 + k];
        k += 1;
    }
    let tangent = FirstPiolaTangent(FourthOrder { components });
    let stress = p.kirchhoff(&f).cauchy(&f);
    if DIRECT {
        let spatial = tangent.spatial(&stress, &f).jaumann(&stress).0;
        let upper: MajorSymmetric<T> = PairSymmetric::from_slots(&spatial.components);
        upper.components
    } else {
        let material = tangent.material(&p.second_piola(&f), &f).0.major_part();
        MaterialTangent::<T>(material).truesdell(&f).jaumann(&stress).0.components
    }
}

#[inline(never)]
fn alone<const DIRECT: bool>(numbers: &[f64; NUMBERS]) -> [f64; 21] {
    converted::<DIRECT, f64>(numbers)
}

/// All points in blocks of eight.
struct Points<'a, const DIRECT: bool> {
    given: &'a [[[f64; 8]; NUMBERS]],
    answers: &'a mut [[[f64; 8]; 21]],
}

impl<const DIRECT: bool> LaneKernel for Points<'_, DIRECT> {
    type Output = ();

    #[inline(always)]
    fn run<const N: usize>(self) {
        for (given, answer) in self.given.iter().zip(self.answers) {
            for part in 0..8 / N {
                let mut numbers = [Lanes([0.0; N]); NUMBERS];
                let mut k = 0;
                while k < NUMBERS {
                    numbers[k] = Lanes(given[k].as_chunks().0[part]);
                    k += 1;
                }
                let found = converted::<DIRECT, _>(&numbers);
                let mut k = 0;
                while k < 21 {
                    answer[k].as_chunks_mut().0[part] = found[k].0;
                    k += 1;
                }
            }
        }
    }
}

/// Nanoseconds a call.
fn timed(calls: u32, mut call: impl FnMut()) -> f64 {
    let begin = Instant::now();
    for _ in 0..calls {
        call();
    }
    begin.elapsed().as_secs_f64() * 1e9 / f64::from(calls)
}

fn main() -> Result<(), ContinuumError> {
    // λ = 1, μ = 2 between E and S.
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [0.1, 0.9, 0.05], [0.0, 0.03, 1.2]])?;
    let material = MaterialTangent::<f64>(MajorSymmetric::isotropic(1.0, 2.0));
    let stress = SecondPiola(Symmetric::new(0.4, -0.1, 0.5, 0.3, 0.1, 0.02));
    let (p, tangent) = (stress.first_piola(&f), material.first_piola(&stress, &f));
    let entries = [f.matrix().transpose(), p.0.transpose()];
    let mut numbers = [0.0; NUMBERS];
    let all = entries.iter().flat_map(nalgebra::Matrix3::as_slice).chain(tangent.0.components.as_flattened());
    for (number, value) in numbers.iter_mut().zip(all) {
        *number = *value;
    }
    for (x, y) in alone::<true>(&numbers).iter().zip(alone::<false>(&numbers)) {
        assert!((x - y).abs() < 1e-13, "both ways give the same: {x} {y}");
    }
    let given = vec![numbers.map(|x| [x; 8]); POINTS / 8];
    let mut answers = vec![[[0.0; 8]; 21]; POINTS / 8];
    let mut least = [f64::INFINITY; 4];
    for _ in 0..40 {
        let times = [
            timed(5000, || _ = black_box(alone::<false>(black_box(&numbers)))),
            timed(5000, || _ = black_box(alone::<true>(black_box(&numbers)))),
            timed(20, || {
                let answers = &mut answers[..];
                dispatch_lanes::<_, 2, 4, 8>(Points::<false> { given: black_box(&given), answers });
            }) / POINTS as f64,
            timed(20, || {
                let answers = &mut answers[..];
                dispatch_lanes::<_, 2, 4, 8>(Points::<true> { given: black_box(&given), answers });
            }) / POINTS as f64,
        ];
        for (least, time) in least.iter_mut().zip(times) {
            *least = least.min(time);
        }
    }
    println!("| P, ∂P/∂F to DDSDDE | by way of ∂S/∂E, ns | directly, ns |\n|---|---|---|");
    println!("| one call | {:.0} | {:.0} |", least[0], least[1]);
    println!("| {POINTS} points in lanes, a point | {:.0} | {:.0} |", least[2], least[3]);
    Ok(())
}
