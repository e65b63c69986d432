//! Newton's and Euler's laws in their forms.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, EulerAngles, Inertia, RigidBody};
use piola_lagrangian::newton_euler::{NewtonEuler, principal_angular_acceleration};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale, strategies};
use proptest::prelude::*;

/// A body that turns about its centre of mass, in Eulerian angles.
struct Turning(RigidBody);
impl Holonomic for Turning {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let origin = Vector3::new(T::zero(), T::zero(), T::zero());
        bodies.body(&self.0, origin, Attitude::from_euler_zyz([q[0], q[1], q[2]]));
    }
}

/// A moment that is constant in the body.
struct Moment(Vector3<f64>);
impl Forces for Moment {
    const MOMENTS: bool = true;
    fn moment_on_body<T: Real>(&self, _part: usize, _attitude: Attitude<T>, _omega: [T; 3], _t: T) -> [T; 3] {
        [T::lit(self.0.x), T::lit(self.0.y), T::lit(self.0.z)]
    }
}

fn body(moments: [f64; 3], [w, x, y, z]: [f64; 4]) -> RigidBody {
    let inertia = Inertia::principal(moments).unwrap().rotated(Attitude { w, x, y, z });
    RigidBody::new(2.0, inertia).unwrap()
}

/// Principal moments that a body can have.
fn moments() -> impl Strategy<Value = [f64; 3]> {
    strategies::vector(3, 0.25..2.0).prop_map(|sums| [sums[0] + sums[1], sums[1] + sums[2], sums[2] + sums[0]])
}

proptest! {
    #[test]
    fn angular_acceleration_in_a_body_basis_equals_that_in_principal_axes(
        moments in moments(),
        rotation in strategies::rotation(),
        omega in strategies::vector(3, -2.0..2.0),
        moment in strategies::vector(3, -2.0..2.0),
    ) {
        let body = body(moments, rotation);
        let laws = NewtonEuler::of(&body).unwrap();
        let axes: Matrix3<f64> = body.inertia().principal_axes().axes;
        let principal = body.inertia().principal_axes().moments;
        let (omega, moment) = (Vector3::from_column_slice(&omega), Vector3::from_column_slice(&moment));
        let actual = laws.angular_acceleration(&moment, &omega);
        let turned = |x: &Vector3<f64>| axes.transpose() * x;
        let expected = axes * principal_angular_acceleration(
            [principal[0], principal[1], principal[2]], &turned(&moment), &turned(&omega)).unwrap();
        let condition = principal.iter().copied().fold(0.0, f64::max) / principal.iter().copied().fold(9.0, f64::min);
        assert_close_at_scale("ω̇", actual.as_slice(), expected.as_slice(), 20.0, Tol::ulps(64.0).times(condition));
        // And back.
        let given_back = laws.moment(&omega, &actual);
        assert_close_at_scale("G", given_back.as_slice(), moment.as_slice(), 20.0, Tol::ulps(64.0).times(condition));
    }

    #[test]
    fn eulerian_accelerations_equal_lagranges_equations(
        moments in moments(),
        rotation in strategies::rotation(),
        theta in strategies::vector(3, -1.0..1.0),
        rates in strategies::vector(3, -2.0..2.0),
        moment in strategies::vector(3, -2.0..2.0),
    ) {
        let theta = [theta[0], 1.5 + theta[1], theta[2]];
        let rates = [rates[0], rates[1], rates[2]];
        let body = body(moments, rotation);
        let moment = Vector3::from_column_slice(&moment);
        let laws = NewtonEuler::of(&body).unwrap();
        let actual = laws.eulerian_accelerations(&EulerAngles::zyz(theta), rates, &moment).unwrap();
        let system = Lagrangian::of(Turning(body)).with_forces(Moment(moment));
        let expected = system.acceleration(&theta, &rates, 0.0).unwrap();
        let tol = Tol::ulps(64.0).times(crate::systems::condition(&system, (&theta, &rates, 0.0)));
        assert_close_at_scale("θ̈", &actual, expected.as_slice(), 20.0, tol);
    }
}

#[test]
fn symmetric_body_keeps_its_axial_spin_to_the_last_bit() {
    let rate: Vector3<f64> =
        principal_angular_acceleration([0.3, 0.3, 0.7], &Vector3::zeros(), &Vector3::new(0.1, 0.7, 1.3)).unwrap();
    assert_eq!(rate.z.to_bits(), 0.0_f64.to_bits());
}
