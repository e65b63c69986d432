//! Accelerations where the inertia metric is nearly singular.

use std::error::Error;

use nalgebra::{DMatrix, Vector3};
use piola_lagrangian::{Holonomic, Lagrangian, Placement};
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

use super::{Numbers, Row, Table, doubled, rounding, worse};

/// Particles on a curve whose coefficients are the coordinates: powers that are ever less independent.
struct Powers {
    particles: usize,
}

impl Powers {
    fn abscissa(&self, particle: usize) -> f64 {
        (particle as f64 + 1.0) / self.particles as f64
    }
}

impl Holonomic for Powers {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        for particle in 0..self.particles {
            let s = T::lit(self.abscissa(particle));
            let mut x = T::zero();
            for &q in q.iter().rev() {
                x = x * s + q;
            }
            bodies.particle(1.0, Vector3::new(x, T::zero(), T::lit(0.5) * x * x));
        }
    }
}

/// A planar chain of pendulums with given masses, rods of one metre, angles from the downward vertical.
struct Pendulums<'a> {
    masses: &'a [f64],
}

impl Holonomic for Pendulums<'_> {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (mut x, mut z) = (T::zero(), T::zero());
        for (&angle, &mass) in q.iter().zip(self.masses) {
            let (sine, cosine) = angle.sin_cos();
            x += sine;
            z -= cosine;
            bodies.particle(mass, Vector3::new(x, T::zero(), z));
        }
    }
}

/// The condition number of the metric scaled to unit diagonal, from the scaled columns of √m ∂x/∂q.
fn scaled_condition(columns: &DMatrix<f64>) -> f64 {
    let mut scaled = columns.clone();
    for mut column in scaled.column_iter_mut() {
        let length = column.norm();
        column /= length;
    }
    let values = scaled.singular_values();
    (values.max() / values.min()).powi(2)
}

/// The error of q̈ over some states, and the condition number of the worst conditioned.
fn accelerations<S: Holonomic>(
    lagrangian: &Lagrangian<S>,
    states: &[(Vec<f64>, Vec<f64>)],
    columns: impl Fn(&[f64]) -> DMatrix<f64>,
) -> Result<(f64, f64), Box<dyn Error>> {
    let (mut worst, mut condition) = (0.0_f64, 0.0_f64);
    for (q, v) in states {
        let computed = lagrangian.acceleration(q, v, 0.0)?;
        let exact = lagrangian.acceleration(&doubled(q), &doubled(v), DoubleDouble::lit(0.0))?;
        worst = worse(worst, rounding(computed.as_slice(), exact.as_slice()));
        condition = condition.max(scaled_condition(&columns(q)));
    }
    Ok((worst, condition))
}

/// The error, and the same in units of what the condition number leaves, and its root.
fn shares(error: f64, condition: f64) -> Vec<f64> {
    let ulps = error / f64::EPSILON;
    vec![error, ulps / condition, ulps / condition.sqrt()]
}

/// Beyond 1e10 rows are solved in place of the metric: there an error of κ ulp would be a fault.
fn bounds(condition: f64) -> Vec<f64> {
    vec![f64::INFINITY, if condition < 1e10 { 8.0 } else { 1e-2 }, f64::INFINITY]
}

/// Coordinates that are nearly dependent.
pub(super) fn near_dependence() -> Result<Table, Box<dyn Error>> {
    let mut rows = Vec::new();
    for n in 2..=10 {
        let system = Powers { particles: n + 2 };
        let columns = |q: &[f64]| {
            // Row pairs: ∂x/∂q and x ∂x/∂q.
            DMatrix::from_fn(2 * (n + 2), n, |row, column| {
                let s = Powers { particles: n + 2 }.abscissa(row / 2);
                let x = q.iter().rev().fold(0.0, |x, q| x * s + q);
                (0..column).fold(if row % 2 == 0 { 1.0 } else { x }, |power, _| power * s)
            })
        };
        let mut numbers = Numbers(n as u64);
        let states: Vec<_> = (0..32).map(|_| (numbers.several(n), numbers.several(n))).collect();
        let (error, condition) = accelerations(&Lagrangian::of(system).with_gravity(9.80665), &states, columns)?;
        rows.push(Row {
            input: format!("{n} coefficients, κ ≤ {condition:.0e}"),
            errors: shares(error, condition),
            allowed: bounds(condition),
        });
    }
    Ok(Table {
        title: "Nearly dependent coordinates",
        text: "Particles at z = x²/2 whose x is a polynomial of 2 to 10 coefficients, the coordinates: the metric, scaled to unit \
               diagonal, has the condition number κ. Where its pivots show that κ is large, q̈ comes from the rows √m ∂x/∂q, whose condition \
               number is √κ; what is left beyond √κ ulp is what an ulp of the forces does. 32 states each, under gravity.",
        columns: vec!["input", "q̈", "in ulp × κ", "in ulp × √κ"],
        rows,
    })
}

/// Masses that are very different.
pub(super) fn mass_ratios() -> Result<Table, Box<dyn Error>> {
    let chains: [(&str, &[f64]); 6] = [
        ("double pendulum, 1 kg above 1e-12 kg", &[1.0, 1e-12]),
        ("double pendulum, 1e-12 kg above 1 kg", &[1e-12, 1.0]),
        ("double pendulum, 1e-6 kg above 1e6 kg", &[1e-6, 1e6]),
        ("four in turn 1 kg and 1e-12 kg", &[1.0, 1e-12, 1.0, 1e-12]),
        ("four in turn 1e-12 kg and 1 kg", &[1e-12, 1.0, 1e-12, 1.0]),
        ("ten, 1 kg to 1e-12 kg", &[1.0, 5e-2, 2e-3, 1e-4, 5e-6, 2e-7, 1e-8, 5e-10, 2e-11, 1e-12]),
    ];
    let mut rows = Vec::new();
    for (input, masses) in chains {
        let n = masses.len();
        let columns = |q: &[f64]| {
            DMatrix::from_fn(2 * n, n, |row, column| {
                let (part, angle) = (row / 2, q[column]);
                let entry = if row % 2 == 0 { angle.cos() } else { angle.sin() };
                if column <= part { masses[part].sqrt() * entry } else { 0.0 }
            })
        };
        let mut numbers = Numbers(n as u64);
        // Every other chain is stretched but for a milliradian, where a light mass above a heavy one hardly shows.
        let states: Vec<_> = (0..64)
            .map(|state| {
                let (angle, spread) = (3.0 * numbers.next(), if state % 2 == 0 { 3.0 } else { 1e-3 });
                (numbers.several(n).iter().map(|x| angle + spread * x).collect(), numbers.several(n))
            })
            .collect();
        let lagrangian = Lagrangian::of(Pendulums { masses }).with_gravity(9.80665);
        let (error, condition) = accelerations(&lagrangian, &states, columns)?;
        rows.push(Row {
            input: format!("{input}, κ ≤ {condition:.0e}"),
            errors: shares(error, condition),
            allowed: bounds(condition),
        });
    }
    Ok(Table {
        title: "Mass ratios up to 1e12",
        text: "Chains of pendulums at 64 states each, half of them stretched but for a milliradian. κ is the largest condition number of the metric scaled to unit diagonal.",
        columns: vec!["input", "q̈", "in ulp × κ", "in ulp × √κ"],
        rows,
    })
}
