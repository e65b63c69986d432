//! From how many points on two threads pay in a batch: `cargo run --release -p piola-benches --bin
//! continuum-threads`.
//!
//! A cheap request (first Piola–Kirchhoff stress of Cauchy's) and a dear one (R, U and ln U), whole on one thread and in
//! two halves on two; the shortest of some hundred passes each, in turn, in nanoseconds a point.
#![expect(clippy::print_stdout, reason = "a program that prints a table")]

use std::hint::black_box;
use std::time::Instant;

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_benches::continuum::{methods, ordinary_deformations};
use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola, Symmetric};

/// Inputs and outputs of both requests.
struct Points<'a> {
    f: &'a [DeformationGradient],
    t: &'a [CauchyStress],
    p: &'a mut [FirstPiola],
    r: &'a mut [Matrix3<f64>],
    u: &'a mut [Symmetric],
    l: &'a mut [Symmetric],
}

impl Points<'_> {
    fn halves(self) -> (Self, Self) {
        let half = (self.f.len() / 2).next_multiple_of(64);
        let (f, t) = (self.f.split_at(half), self.t.split_at(half));
        let (p, r) = (self.p.split_at_mut(half), self.r.split_at_mut(half));
        let (u, l) = (self.u.split_at_mut(half), self.l.split_at_mut(half));
        (
            Self { f: f.0, t: t.0, p: p.0, r: r.0, u: u.0, l: l.0 },
            Self { f: f.1, t: t.1, p: p.1, r: r.1, u: u.1, l: l.1 },
        )
    }
}

fn cheap(points: Points<'_>) {
    let request = batch::cauchy_to_first_piola(black_box(points.t), points.p);
    black_box(batch::evaluate(black_box(points.f), request).is_ok());
}

#[expect(clippy::needless_pass_by_value, reason = "one signature for both requests")]
fn dear(points: Points<'_>) {
    black_box(methods::polar_batch(black_box(points.f), points.r, points.u, points.l));
}

/// In two halves, from a thread that is none of the pool's, as a user's main thread.
fn on_two_threads(points: Points<'_>, request: fn(Points<'_>)) {
    let (head, tail) = points.halves();
    rayon::join(|| request(head), || request(tail));
}

fn main() {
    let largest = 1 << 16;
    let f = ordinary_deformations(largest);
    let t = vec![CauchyStress(Symmetric::new(3.0, -1.0, 2.0, 0.5, 4.0, -2.0)); largest];
    let (mut p, mut r) = (vec![FirstPiola::zero(); largest], vec![Matrix3::zeros(); largest]);
    let (mut u, mut l) = (vec![Symmetric::zero(); largest], vec![Symmetric::zero(); largest]);
    println!("threads: {}", rayon::current_num_threads());
    println!("| points | P, one thread | two | R, U, ln U, one thread | two |\n|---|---|---|---|---|");
    for count in (7..=16).map(|power| 1_usize << power) {
        let mut shortest = [f64::INFINITY; 4];
        for _ in 0..400.min(4_000_000 / count) {
            for (which, least) in shortest.iter_mut().enumerate() {
                let points = Points {
                    f: &f[..count],
                    t: &t[..count],
                    p: &mut p[..count],
                    r: &mut r[..count],
                    u: &mut u[..count],
                    l: &mut l[..count],
                };
                let start = Instant::now();
                match which {
                    0 => cheap(points),
                    1 => on_two_threads(points, cheap),
                    2 => dear(points),
                    _ => on_two_threads(points, dear),
                }
                *least = least.min(1e9 * start.elapsed().as_secs_f64() / count as f64);
            }
        }
        let [a, b, c, d] = shortest;
        println!("| {count} | {a:.1} | {b:.1} | {c:.1} | {d:.1} |");
    }
}
