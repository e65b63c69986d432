//! Systems far from the origin.

use std::error::Error;

use nalgebra::Vector3;
use piola_kinematics::ParticleSystem;
use piola_lagrangian::{Holonomic, Lagrangian, Placement};
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

use super::{Numbers, Row, Table, doubled, rounding, worse};

/// A double pendulum that hangs far away.
struct DistantPendulum {
    distance: f64,
}

impl Holonomic for DistantPendulum {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (mut x, mut z) = (T::lit(self.distance), T::lit(self.distance));
        for &angle in q {
            let (sine, cosine) = angle.sin_cos();
            x += sine;
            z -= cosine;
            bodies.particle(1.0, Vector3::new(x, T::zero(), z));
        }
    }
}

fn doubled_vectors(vectors: &[Vector3<f64>]) -> Vec<Vector3<DoubleDouble>> {
    vectors.iter().map(|v| Vector3::new(v.x, v.y, v.z).map(DoubleDouble::lit)).collect()
}

/// Errors of the angular momentum, kinetic energy and inertia about the centre of mass, over their own size.
fn about_the_centre_of_mass(distance: f64, numbers: &mut Numbers) -> Result<[f64; 3], Box<dyn Error>> {
    let mut vectors = |scale: f64, offset: f64| -> Vec<Vector3<f64>> {
        (0..20).map(|_| Vector3::from_fn(|_, _| scale * numbers.next() + offset)).collect()
    };
    // At 1e12 m a double resolves 0.1 mm; the positions are what the doubles say.
    let (positions, velocities) = (vectors(1.0, distance), vectors(1.0, 3e4));
    let masses: Vec<f64> = (1..=20).map(f64::from).collect();
    let computed = ParticleSystem::new(&masses, &positions, &velocities)?;
    let (positions, velocities) = (doubled_vectors(&positions), doubled_vectors(&velocities));
    let exact = ParticleSystem::new(&masses, &positions, &velocities)?;
    let origin = Vector3::zeros();
    let spin = rounding(
        computed.angular_momentum(&origin).relative.as_slice(),
        exact.angular_momentum(&origin.map(DoubleDouble::lit)).relative.as_slice(),
    );
    let energy = rounding(&[computed.kinetic_energy().relative], &[exact.kinetic_energy().relative]);
    let inertia =
        rounding(computed.inertia_about_centre_of_mass().as_slice(), exact.inertia_about_centre_of_mass().as_slice());
    Ok([spin, energy, inertia])
}

pub(super) fn from_origin() -> Result<Table, Box<dyn Error>> {
    let mut rows = Vec::new();
    for exponent in [0, 3, 6, 9, 12] {
        let distance = 10_f64.powi(exponent);
        let mut numbers = Numbers(7);
        let mut errors = vec![0.0; 4];
        for _ in 0..32 {
            let splits = about_the_centre_of_mass(distance, &mut numbers)?;
            for (error, split) in errors.iter_mut().zip(splits) {
                *error = worse(*error, split);
            }
            let pendulum = Lagrangian::of(DistantPendulum { distance }).with_gravity(9.80665);
            let (q, v) = (numbers.several(2), numbers.several(2));
            let computed = pendulum.acceleration(&q, &v, 0.0)?;
            let exact = pendulum.acceleration(&doubled(&q), &doubled(&v), DoubleDouble::lit(0.0))?;
            errors[3] = worse(errors[3], rounding(computed.as_slice(), exact.as_slice()));
        }
        rows.push(Row { input: format!("1e{exponent} m"), errors, allowed: vec![1e-14; 4] });
    }
    Ok(Table {
        title: "Far from the origin",
        text: "20 particles within a metre of each other, flying at 50 km/s with relative velocities of 1 m/s: the parts of moment of \
               momentum and kinetic energy about the centre of mass, and the inertia tensor there, each relative to itself; \
               and the accelerations of a double pendulum. 32 states each.",
        columns: vec!["distance", "angular momentum", "kinetic energy", "inertia tensor", "q̈"],
        rows,
    })
}
