//! One double pendulum in three formulations: they agree to the thirteenth digit.
//!
//! 1. where its masses are, with the angles from the vertical;
//! 2. one function L(q, q̇, t), written down by hand;
//! 3. where its masses are in Cartesian coordinates, seen through a change to the angle of the first rod and the
//!    angle at the joint.
//!
//! Then the reactions of the first are put back, and Newton's equation holds for both masses as if they were free.
#![expect(clippy::print_stdout, reason = "an example prints")]

use nalgebra::Vector3;
use piola::kinematics::particle::Motion;
use piola::kinematics::placement::PlacementEvaluator;
use piola::lagrangian::newton_euler::particle_acceleration;
use piola::lagrangian::{ChangeOfCoordinates, Holonomic, Lagrangian, LagrangianFunction, Placement};
use piola::numerics::Real;

const MASS: [f64; 2] = [1.0, 0.5];
const LENGTH: [f64; 2] = [1.0, 0.75];
const GRAVITY: f64 = 9.80665;

/// 1. The placement map.
struct Angles;

impl Holonomic for Angles {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = Vector3::new(T::zero(), T::zero(), T::zero());
        for ((mass, length), angle) in MASS.into_iter().zip(LENGTH).zip(q) {
            let ((s, c), length) = (angle.sin_cos(), T::lit(length));
            end += Vector3::new(length * s, T::zero(), -length * c);
            bodies.particle(mass, end);
        }
    }
}

/// 2. L = ½(m₁+m₂) l₁² φ̇₁² + ½ m₂ l₂² φ̇₂² + m₂ l₁ l₂ φ̇₁ φ̇₂ cos(φ₁−φ₂) + (m₁+m₂) g l₁ cos φ₁ + m₂ g l₂ cos φ₂.
struct ByHand;

impl LagrangianFunction for ByHand {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let ([m1, m2], [l1, l2]) = (MASS, LENGTH);
        let half = T::lit(0.5);
        half * T::lit((m1 + m2) * l1 * l1) * v[0] * v[0]
            + half * T::lit(m2 * l2 * l2) * v[1] * v[1]
            + T::lit(m2 * l1 * l2) * v[0] * v[1] * (q[0] - q[1]).cos()
            + T::lit((m1 + m2) * GRAVITY * l1) * q[0].cos()
            + T::lit(m2 * GRAVITY * l2) * q[1].cos()
    }
}

/// 3. Both masses free in the plane, in Cartesian coordinates…
struct Cartesian;

impl Holonomic for Cartesian {
    fn place<T: Real>(&self, x: &[T], _t: T, bodies: &mut impl Placement<T>) {
        for (mass, x) in MASS.into_iter().zip(x.chunks(2)) {
            bodies.particle(mass, Vector3::new(x[0], T::zero(), x[1]));
        }
    }
}

/// …and where they are for the angle of the first rod and the angle at the joint.
#[derive(Clone)]
struct Joints;

impl ChangeOfCoordinates<4> for Joints {
    fn old_coordinates<T: Real>(&self, q: &[T], _t: T) -> [T; 4] {
        let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), (q[0] + q[1]).sin_cos());
        let [l1, l2] = LENGTH.map(T::lit);
        [l1 * s1, -l1 * c1, l1 * s1 + l2 * s2, -l1 * c1 - l2 * c2]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let placed = Lagrangian::of(Angles).with_gravity(GRAVITY);
    let function = Lagrangian::from_function(ByHand);
    let joints = Lagrangian::of(Cartesian).with_gravity(GRAVITY).in_coordinates(Joints);

    println!("    φ₁      φ₂          φ̈₁ by placement         by function          by joints     largest difference");
    let mut worst = 0.0_f64;
    for (q, v) in [
        ([0.1, -0.2], [0.0, 0.0]),
        ([1.0, 2.0], [3.0, -1.0]),
        ([-2.5, 0.5], [0.5, 4.0]),
        ([3.0, 3.1], [-2.0, 2.0]),
        ([1.5, -1.5], [5.0, 5.0]),
    ] {
        let first = placed.acceleration(&q, &v, 0.0)?;
        let second = function.acceleration(&q, &v, 0.0)?;
        let relative = joints.acceleration(&[q[0], q[1] - q[0]], &[v[0], v[1] - v[0]], 0.0)?;
        let third = [relative[0], relative[0] + relative[1]];
        let size = first.amax();
        let difference = |other: [f64; 2]| (0..2).map(|i| (first[i] - other[i]).abs() / size).fold(0.0, f64::max);
        let largest = difference([second[0], second[1]]).max(difference(third));
        println!(
            "{:7.2} {:7.2} {:20.13} {:20.13} {:20.13}     {largest:.1e}",
            q[0], q[1], first[0], second[0], third[0]
        );
        worst = worst.max(largest);

        // Weight and reaction together move each mass as if it were free.
        let mut motions = [Motion::at_rest(); 2];
        PlacementEvaluator::new(2).motions_into(&Angles, &q, &v, first.as_slice(), 0.0, &mut motions, &mut [])?;
        for ((reaction, motion), mass) in placed.reactions(&q, &v, 0.0)?.iter().zip(motions).zip(MASS) {
            let free = particle_acceleration(mass, &(reaction.force() + Vector3::new(0.0, 0.0, -mass * GRAVITY)))?;
            let scale = motion.acceleration.norm() + GRAVITY;
            worst = worst.max((free - motion.acceleration).norm() / scale);
        }
    }
    println!("the formulations differ by at most {worst:.1e} of the largest acceleration");
    assert!(worst < 1e-13, "{worst:e}");
    Ok(())
}
