//! Time and worst error of each method on deformations that are hard to decompose.
//!
//! Errors are norm-wise (largest entry) against 31 digits: of R in absolute terms, of U relative to U, of ln U relative
//! to ln U (absolute for pure rotations, whose ln U is rounding), of eigenpairs the largest of |A V − V Λ|/|A|,
//! `|VᵀV − 1|` and `|Δλ|/|A|`. The input is taken as exact.

use std::hint::black_box;
use std::time::Instant;

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_continuum::polar::PolarHencky;
use piola_continuum::strain::RightCauchyGreen;
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::DoubleDouble;
use piola_testkit::spectral::{AdversarialCase, PolarReference, adversarial_set, eigenpairs, polar_reference};

use super::methods::{self, Pairs, Polar};

/// Samples of each time, one in every round over all methods.
const ROUNDS: usize = 41;
/// The condition number λ₁/λ₃ up to which deformations are ordinary.
const ORDINARY: f64 = 10.0;

/// A method on one set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measurement {
    /// The median time, ns a point.
    pub nanoseconds: f64,
    /// The worst error.
    pub error: f64,
}

/// A method on both sets.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// Its name.
    pub name: &'static str,
    /// Whether it is ours.
    pub ours: bool,
    /// Where λ₁/λ₃ ≤ 10.
    pub ordinary: Measurement,
    /// On the full set.
    pub full: Measurement,
}

/// What is computed, by all methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What.
    pub title: &'static str,
    /// The methods.
    pub methods: Vec<Method>,
}

/// All tasks, and how often the slow path was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The tasks.
    pub tasks: Vec<Task>,
    /// Kind of deformation, number of points, points on the slow path.
    pub slow_path: Vec<(&'static str, usize, usize)>,
    /// Points of the ordinary and of the full set.
    pub points: [usize; 2],
}

/// The memory that methods read and write.
struct Points {
    typed: Vec<DeformationGradient>,
    matrices: Vec<Matrix3<f64>>,
    squares: Vec<Symmetric>,
    square_matrices: Vec<Matrix3<f64>>,
    absolute: Vec<bool>,
    polar: Vec<PolarReference>,
    eigenvalues: Vec<[f64; 3]>,
}

/// Results, each where it is asked for.
struct Output {
    polar: Vec<Polar>,
    pairs: Vec<Pairs>,
    ours: Vec<PolarHencky>,
    rotations: Vec<Matrix3<f64>>,
    stretches: Vec<Symmetric>,
    logarithms: Vec<Symmetric>,
    values: Vec<[f64; 3]>,
}

type Run = fn(&Points, &mut Output);
type Error = fn(&Points, &Output, usize) -> f64;

struct Candidate {
    name: &'static str,
    ours: bool,
    run: Run,
    error: Error,
}

/// Measures everything.
///
/// # Panics
/// Never: the set consists of deformations.
#[must_use]
pub fn chart() -> Chart {
    let set = adversarial_set();
    let ordinary: Vec<AdversarialCase> = set.iter().filter(|case| case.condition <= ORDINARY).copied().collect();
    let sets = [Points::of(&ordinary), Points::of(&set)];
    let tasks = tasks().into_iter().map(|(title, candidates)| Task { title, methods: measure(&candidates, &sets) });
    let tasks = tasks.collect();
    let mut slow_path: Vec<(&'static str, usize, usize)> = Vec::new();
    for case in &set {
        let f = DeformationGradient::from_rows(case.gradient).expect("the set consists of deformations");
        let slow = usize::from(piola_continuum::polar::StretchAnalysis::of(&f).slow_path());
        match slow_path.iter_mut().find(|row| row.0 == case.kind) {
            Some(row) => (row.1, row.2) = (row.1 + 1, row.2 + slow),
            None => slow_path.push((case.kind, 1, slow)),
        }
    }
    Chart { tasks, slow_path, points: [ordinary.len(), set.len()] }
}

impl Points {
    fn of(cases: &[AdversarialCase]) -> Self {
        let typed: Vec<_> = cases
            .iter()
            .map(|case| DeformationGradient::from_rows(case.gradient).expect("the set consists of deformations"))
            .collect();
        let squares: Vec<_> = typed.iter().map(|f| RightCauchyGreen::of(f).0).collect();
        Self {
            matrices: typed.iter().map(|f| *f.matrix()).collect(),
            square_matrices: squares.iter().map(Symmetric::matrix).collect(),
            absolute: cases.iter().map(|case| case.kind == "pure rotation").collect(),
            polar: cases.iter().map(|case| polar_reference(case.gradient)).collect(),
            eigenvalues: squares
                .iter()
                .map(|c| {
                    let size = largest(&c.matrix());
                    let scaled = c.rows().map(|row| row.map(|x| DoubleDouble::lit(x / size)));
                    eigenpairs(scaled).0.map(|x| x.primal(0) * size)
                })
                .collect(),
            typed,
            squares,
        }
    }
}

impl Output {
    fn of(count: usize) -> Self {
        let (m, s) = (Matrix3::zeros(), Symmetric::zero());
        Self {
            polar: vec![Polar { rotation: m, right_stretch: m, hencky: m }; count],
            pairs: vec![Pairs { values: [0.0; 3], vectors: m }; count],
            ours: vec![PolarHencky { rotation: m, right_stretch: s, hencky: s }; count],
            rotations: vec![m; count],
            stretches: vec![s; count],
            logarithms: vec![s; count],
            values: vec![[0.0; 3]; count],
        }
    }
}

fn measure(candidates: &[Candidate], sets: &[Points; 2]) -> Vec<Method> {
    let mut outputs = [Output::of(sets[0].typed.len()), Output::of(sets[1].typed.len())];
    let mut samples = vec![[Vec::new(), Vec::new()]; candidates.len()];
    let mut errors = vec![[0.0_f64; 2]; candidates.len()];
    for round in 0..ROUNDS {
        for (number, candidate) in candidates.iter().enumerate() {
            for (which, (set, output)) in sets.iter().zip(&mut outputs).enumerate() {
                let start = Instant::now();
                (candidate.run)(black_box(set), black_box(output));
                let elapsed = start.elapsed().as_secs_f64();
                samples[number][which].push(1e9 * elapsed / set.typed.len() as f64);
                if round == 0 {
                    let worst = (0..set.typed.len()).map(|index| (candidate.error)(set, output, index));
                    // A NaN is the worst of all.
                    errors[number][which] =
                        worst.fold(0.0, |worst: f64, error| if error <= worst { worst } else { error.max(worst) });
                }
            }
        }
    }
    let median = |mut samples: Vec<f64>| {
        samples.sort_by(f64::total_cmp);
        samples[samples.len() / 2]
    };
    let rows = candidates.iter().zip(samples).zip(errors);
    rows.map(|((candidate, [ordinary, full]), errors)| Method {
        name: candidate.name,
        ours: candidate.ours,
        ordinary: Measurement { nanoseconds: median(ordinary), error: errors[0] },
        full: Measurement { nanoseconds: median(full), error: errors[1] },
    })
    .collect()
}

fn largest(a: &Matrix3<f64>) -> f64 {
    a.iter().fold(0.0, |largest, x| if x.abs() <= largest { largest } else { x.abs() })
}

fn distance(a: &Matrix3<f64>, b: &[[f64; 3]; 3]) -> f64 {
    let difference = largest(&(a - from_rows(*b)));
    // Not finite: no digit is right.
    if difference.is_finite() { difference } else { LOST }
}

/// The error that stands for a result that is not finite.
pub const LOST: f64 = 10.0;

fn relative(a: &Matrix3<f64>, b: &[[f64; 3]; 3]) -> f64 {
    distance(a, b) / largest(&from_rows(*b))
}

fn logarithm_error(points: &Points, index: usize, hencky: &Matrix3<f64>) -> f64 {
    let exact = &points.polar[index].hencky_material;
    if points.absolute[index] || largest(&from_rows(*exact)) <= 0.0 {
        distance(hencky, exact)
    } else {
        relative(hencky, exact)
    }
}

fn polar_error(points: &Points, index: usize, rotation: &Matrix3<f64>, stretch: &Matrix3<f64>) -> f64 {
    let exact = &points.polar[index];
    distance(rotation, &exact.rotation).max(relative(stretch, &exact.right_stretch))
}

fn pairs_error(points: &Points, index: usize, pairs: &Pairs) -> f64 {
    let (a, v) = (&points.square_matrices[index], &pairs.vectors);
    let size = largest(a);
    let residual = largest(&(a * v - v * Matrix3::from_diagonal(&pairs.values.into()))) / size;
    let orthogonality = largest(&(v.transpose() * v - Matrix3::identity()));
    let mut values = pairs.values;
    values.sort_by(|x, y| y.total_cmp(x));
    let exact = points.eigenvalues[index];
    let shift = (0..3).map(|k| (values[k] - exact[k]).abs() / size).fold(0.0, f64::max);
    let error = residual.max(orthogonality).max(shift);
    if error.is_finite() { error } else { LOST }
}

fn tasks() -> Vec<(&'static str, Vec<Candidate>)> {
    vec![
        ("polar decomposition and logarithm: R, U, ln U", polar_hencky()),
        ("logarithm alone: ln U", logarithm()),
        ("eigenvalues and eigenvectors of C", eigen()),
    ]
}

/// A loop over the points by a one-point function.
macro_rules! each {
    ($points:ident.$input:ident, $output:ident.$results:ident, $function:expr) => {
        for (input, result) in $points.$input.iter().zip(&mut $output.$results) {
            *result = $function(black_box(input));
        }
    };
}

fn polar_hencky() -> Vec<Candidate> {
    let theirs: Error = |points, output, index| {
        let polar = &output.polar[index];
        polar_error(points, index, &polar.rotation, &polar.right_stretch).max(logarithm_error(
            points,
            index,
            &polar.hencky,
        ))
    };
    let at_points: Error = |points, output, index| {
        let polar = &output.ours[index];
        polar_error(points, index, &polar.rotation, &polar.right_stretch.matrix()).max(logarithm_error(
            points,
            index,
            &polar.hencky.matrix(),
        ))
    };
    let ours: Error =
        |points, output, index| {
            polar_error(points, index, &output.rotations[index], &output.stretches[index].matrix())
                .max(logarithm_error(points, index, &output.logarithms[index].matrix()))
        };
    vec![
        Candidate {
            name: "Piola, one point",
            ours: true,
            run: |points, output| each!(points.typed, output.ours, methods::polar),
            error: at_points,
        },
        Candidate {
            name: "Piola, one point, compiled for any machine",
            ours: true,
            run: |points, output| each!(points.typed, output.ours, methods::polar_inlined),
            error: at_points,
        },
        Candidate {
            name: "Piola, batch in lanes",
            ours: true,
            run: |points, output| {
                let Output { rotations, stretches, logarithms, .. } = output;
                black_box(methods::polar_batch(&points.typed, rotations, stretches, logarithms));
            },
            error: ours,
        },
        Candidate {
            name: "nalgebra, SVD of F",
            ours: false,
            run: |points, output| each!(points.matrices, output.polar, methods::polar_by_svd),
            error: theirs,
        },
        Candidate {
            name: "nalgebra, eigenvectors of C",
            ours: false,
            run: |points, output| each!(points.matrices, output.polar, methods::polar_by_eigen),
            error: theirs,
        },
        Candidate {
            name: "closed form (trigonometric)",
            ours: false,
            run: |points, output| each!(points.matrices, output.polar, methods::polar_by_trigonometry),
            error: theirs,
        },
    ]
}

fn logarithm() -> Vec<Candidate> {
    let theirs: Error = |points, output, index| logarithm_error(points, index, &output.polar[index].hencky);
    let ours: Error = |points, output, index| logarithm_error(points, index, &output.logarithms[index].matrix());
    vec![
        Candidate {
            name: "Piola, one point",
            ours: true,
            run: |points, output| each!(points.typed, output.logarithms, methods::hencky),
            error: ours,
        },
        Candidate {
            name: "Piola, batch in lanes",
            ours: true,
            run: |points, output| {
                let report = batch::evaluate(&points.typed[..], batch::hencky(&mut output.logarithms[..]));
                black_box(report.map_or(0, |report| report.slow_path));
            },
            error: ours,
        },
        Candidate {
            name: "nalgebra, SVD of F",
            ours: false,
            run: |points, output| {
                for (f, polar) in points.matrices.iter().zip(&mut output.polar) {
                    polar.hencky = methods::hencky_by_svd(black_box(f));
                }
            },
            error: theirs,
        },
        Candidate {
            name: "nalgebra, eigenvectors of C",
            ours: false,
            run: |points, output| {
                for (f, polar) in points.matrices.iter().zip(&mut output.polar) {
                    polar.hencky = methods::hencky_by_eigen(black_box(f));
                }
            },
            error: theirs,
        },
        Candidate {
            name: "closed form (trigonometric)",
            ours: false,
            run: |points, output| {
                for (f, polar) in points.matrices.iter().zip(&mut output.polar) {
                    polar.hencky = methods::hencky_by_trigonometry(black_box(f));
                }
            },
            error: theirs,
        },
    ]
}

fn eigen() -> Vec<Candidate> {
    let error: Error = |points, output, index| pairs_error(points, index, &output.pairs[index]);
    vec![
        Candidate {
            name: "Piola, one point",
            ours: true,
            run: |points, output| each!(points.squares, output.pairs, methods::pairs),
            error,
        },
        Candidate {
            name: "Piola, batch in lanes",
            ours: true,
            run: |points, output| {
                let Output { values, rotations, .. } = output;
                let requests = batch::eigenpairs(&points.squares[..], &mut values[..], &mut rotations[..]);
                black_box(batch::evaluate(batch::Undeformed(points.squares.len()), requests).is_ok());
            },
            error: |points, output, index| {
                let vectors = output.rotations[index].transpose();
                pairs_error(points, index, &Pairs { values: output.values[index], vectors })
            },
        },
        Candidate {
            name: "nalgebra, SVD",
            ours: false,
            run: |points, output| each!(points.square_matrices, output.pairs, methods::pairs_by_svd),
            error,
        },
        Candidate {
            name: "nalgebra, symmetric eigenvectors",
            ours: false,
            run: |points, output| each!(points.square_matrices, output.pairs, methods::pairs_by_nalgebra),
            error,
        },
        Candidate {
            name: "closed form (trigonometric)",
            ours: false,
            run: |points, output| each!(points.square_matrices, output.pairs, methods::pairs_by_trigonometry),
            error,
        },
    ]
}
