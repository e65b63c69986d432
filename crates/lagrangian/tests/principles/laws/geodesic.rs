//! Geodesics and the covariant acceleration.

use nalgebra::{DVector, Vector3};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_lagrangian::{Holonomic, Lagrangian, Placement};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::*;

/// A particle of 1 kg on a surface: the sphere of 2 m, in polar angle and azimuth, or the cylinder of 2 m, in azimuth
/// and height.
enum Surface {
    Sphere,
    Cylinder,
}

impl Holonomic for Surface {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let two = T::lit(2.0);
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), q[1].sin_cos());
        bodies.particle(
            1.0,
            match self {
                Self::Sphere => Vector3::new(two * s * cp, two * s * sp, two * c),
                Self::Cylinder => Vector3::new(two * c, two * s, q[1]),
            },
        );
    }
}

const RUN: Tol = Tol::stated(1e-11, "a hundred times the tolerance of the run");

fn tolerance() -> Tolerance {
    Tolerance::relative(1e-13).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn geodesics_of_the_sphere_equal_great_circles(polar in 0.75..2.25_f64, turn in -3.0..3.0_f64, arc in 0.5..2.0_f64) {
        let sphere = Lagrangian::of(Surface::Sphere);
        // North, and east over sin θ, of one metre each.
        let (heading_north, heading_east) = turn.sin_cos();
        let north = Vector3::new(-polar.cos(), 0.0, polar.sin());
        let heading = north * heading_north + Vector3::y() * heading_east;
        let start = Vector3::new(polar.sin(), 0.0, polar.cos());
        let direction = [-heading_north, heading_east / polar.sin()];
        let expected = 2.0 * (start * (arc / 2.0).cos() + heading * (arc / 2.0).sin());
        prop_assume!(expected.z.abs() < 1.9); // away from the poles of the chart
        let end = sphere.geodesic(&[polar, 0.0], &direction, arc, 0.0, tolerance()).unwrap();
        let [theta, phi] = [end.coordinates[0], end.coordinates[1]];
        let actual = 2.0 * Vector3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        // Near a pole the chart magnifies errors by 1/sin θ along the way; the circle's nearest point to it bounds them.
        let nearest = start.cross(&heading).z.abs().max(0.05);
        assert_close_at_scale("end", actual.as_slice(), expected.as_slice(), 2.0, RUN.times(1.0 / nearest));
        assert_close_at_scale("length", &[end.length_error], &[0.0], 1.0, RUN.times(1.0 / nearest));
    }

    #[test]
    fn covariant_acceleration_equals_christoffel_form_and_raised_force((q, v, _) in states()) {
        let system = Lagrangian::of(Arm::<false>::new()).with_uniform_gravity(GRAVITY).with_forces(Push::<true>);
        let a = [0.5, -1.0, 2.0];
        let velocity = DVector::from_column_slice(&v);
        let symbols = system.christoffel_second(&q, 0.0).unwrap();
        let expected: Vec<f64> = (0..3).map(|i| a[i] + velocity.dot(&(&symbols[i] * &velocity))).collect();
        let actual = system.covariant_acceleration(&q, &v, &a, 0.0).unwrap();
        let tol = Tol::ulps(8.0).times(condition(&system, (&q, &v, 0.0)));
        assert_close_at_scale("Γ", actual.as_slice(), &expected, 20.0, tol);

        // Along the motion it is the force with its index raised: of what is applied and of gravity.
        let motion = system.acceleration(&q, &v, 0.0).unwrap();
        let covariant = system.covariant_acceleration(&q, &v, motion.as_slice(), 0.0).unwrap();
        let bare = Lagrangian::of(system.system());
        let force = system.generalised_forces(&q, &v, 0.0).unwrap() + system.coordinate_gradient(&q, &v, 0.0).unwrap()
            - bare.coordinate_gradient(&q, &v, 0.0).unwrap();
        let raised = system.raise(&q, force.as_slice(), 0.0).unwrap();
        assert_close_at_scale("Q", covariant.as_slice(), raised.as_slice(), 20.0, tol);
        let lowered = system.lower(&q, raised.as_slice(), 0.0).unwrap();
        assert_close_at_scale("lowered", lowered.as_slice(), force.as_slice(), 20.0, tol);
    }
}

#[test]
fn geodesics_of_the_cylinder_equal_helices() {
    let cylinder = Lagrangian::of(Surface::Cylinder);
    let end = cylinder.geodesic(&[0.25, -1.0], &[0.3, 0.8], 5.0, 0.0, tolerance()).unwrap();
    // 0.6 of the length around, 0.8 up.
    let expected = [0.25 + 0.6 * 5.0 / 2.0, -1.0 + 0.8 * 5.0];
    assert_close_at_scale("end", &end.coordinates, &expected, 1.0, Tol::ulps(16.0));
    assert_close_at_scale("direction", &end.direction, &[0.3, 0.8], 1.0, Tol::ulps(16.0));
}

#[test]
fn motion_without_forces_equals_geodesic_with_constant_energy() {
    let arm = Lagrangian::of(Arm::<false>::new());
    let (q, v) = ([0.25, 0.5, -0.75], [1.0, -0.5, 0.25]);
    let energy = arm.energies(&q, &v, 0.0).unwrap().kinetic;
    let mut state = State::new(0.0, [q, v].concat()).unwrap();
    DormandPrince853::new(tolerance()).integrate_to(&mut arm.motion(3), &mut state, 2.0).unwrap();
    // The speed is √(2E): after two seconds the arc has the length 2 √(2E).
    let speed = (2.0 * energy).sqrt();
    let end = arm.geodesic(&q, &v, 2.0 * speed, 0.0, tolerance()).unwrap();
    assert_close_at_scale("q", &end.coordinates, &state.values[..3], 1.0, RUN);
    let velocities: Vec<f64> = end.direction.iter().map(|direction| speed * direction).collect();
    assert_close_at_scale("q̇", &velocities, &state.values[3..], 1.0, RUN);
    let kept = arm.energies(&end.coordinates, &velocities, 0.0).unwrap().kinetic;
    assert_close_at_scale("E", &[kept], &[energy], 0.0, RUN);
}
