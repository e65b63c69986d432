//! Identities of whole motions.

use piola_integrators::{DormandPrince853, Field, GaussLegendre, Order, State, Tolerance};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::rigid_motion::{RigidRotation, Torque};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, LagrangianFunction, Potential, Workspace};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};

use crate::any::{Law, for_all_systems};

const ADAPTIVE: Tol = Tol::stated(1e-10, "adaptive steps at a relative tolerance of 1e-13, over one second");

struct Canonical;
impl Law for Canonical {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let method = || DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
        let mut direct = State::new(t, [q, v].concat()).unwrap();
        method().integrate_to(&mut lagrangian.motion(n), &mut direct, t + 0.5).unwrap();

        let momenta = lagrangian.momenta(q, v, t).unwrap();
        // dH = (−∂L/∂q, q̇): the differences of H, and the velocities that the momenta were made of.
        let energy = |q: &[f64]| vec![lagrangian.hamiltonian(q, momenta.as_slice(), t).unwrap()];
        let along = |i: usize| (0..n).map(|j| f64::from(u8::from(i == j))).collect::<Vec<_>>();
        let slopes: Vec<f64> = (0..n).map(|i| difference_quotient(energy, q, &along(i))[0]).collect();
        let differential = lagrangian.hamiltonian_differential(q, momenta.as_slice(), t).unwrap();
        let (scale, differences) = (energy(q)[0].abs().max(10.0), Tol::stated(1e-8, "sixth-order differences"));
        assert_close_at_scale(name, &differential.as_slice()[..n], &slopes, scale, differences);
        assert_close_at_scale(name, &differential.as_slice()[n..], v, 1.0, ADAPTIVE);

        let mut canonical = State::new(t, [q, momenta.as_slice()].concat()).unwrap();
        method().integrate_to(&mut lagrangian.canonical_motion(n), &mut canonical, t + 0.5).unwrap();
        assert_close_at_scale(name, &canonical.values[..n], &direct.values[..n], 1.0, ADAPTIVE.times(10.0));
        let momenta = lagrangian.momenta(&direct.values[..n], &direct.values[n..], t + 0.5).unwrap();
        let size = momenta.amax().max(1.0);
        assert_close_at_scale(name, &canonical.values[n..], momenta.as_slice(), size, ADAPTIVE.times(10.0));
    }
}

#[test]
fn canonical_motion_equals_motion() {
    for_all_systems(&Canonical, &[0.25, -0.5, 0.75, 0.125, -0.25, 0.5], &[1.0, -0.5, 0.25, 0.75, 0.5, -1.0], 0.25);
}

/// L = −√(1 − v²) + q: a relativistic particle under a constant force, p = p₀ + t.
struct Relativistic;
impl LagrangianFunction for Relativistic {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        q[0] - (T::one() - v[0] * v[0]).sqrt()
    }
}

#[test]
fn relativistic_momentum_equals_impulse() {
    let particle = Lagrangian::from_function(Relativistic);
    let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
    GaussLegendre::new(Order::Eight, 0.25)
        .unwrap()
        .integrate_to(&mut particle.canonical_motion(1), &mut state, 8.0)
        .unwrap();
    // p = t, q = √(1 + t²) − 1
    let expected = [65.0_f64.sqrt() - 1.0, 8.0];
    assert_close_at_scale("q, p", &state.values, &expected, 1.0, Tol::order(0.25, 8).times(1e-3));
    let mut velocity = [0.0];
    for momentum in [1e-8, 0.5, 2.0, 100.0, 1e4] {
        particle.velocities_into(&mut Workspace::default(), &[0.0], &[momentum], 0.0, &mut velocity).unwrap();
        let expected = momentum / 1.0_f64.hypot(momentum);
        // ∂p/∂v grows as p³, so that a momentum of 1e4 is known from a velocity to few digits; the velocity is.
        assert_close_at_scale("v", &velocity, &[expected], 0.0, Tol::ulps(8.0));
    }
}

#[test]
fn momenta_are_inverted_in_single_precision() {
    let particle = Lagrangian::from_function(Relativistic);
    let mut velocity = [0.0_f32];
    particle.velocities_into(&mut Workspace::default(), &[0.0], &[0.75], 0.0, &mut velocity).unwrap();
    assert_close_at_scale("v", &[f64::from(velocity[0])], &[0.6], 1.0, Tol::ulps32(4.0));
}

/// A moment that turns with the body and a moment of the field that does not.
struct Driven;
impl Torque for Driven {
    fn moment<T: Real>(&self, t: T, attitude: Attitude<T>, omega: nalgebra::Vector3<T>) -> nalgebra::Vector3<T> {
        let field = attitude.to_body(&nalgebra::Vector3::new(T::zero(), T::one(), t.cos()));
        nalgebra::Vector3::new(field.x - omega.x, field.y, T::lit(0.5) * field.z)
    }
}

#[test]
fn driven_rotation_equals_lagranges_equations_in_eulerian_angles() {
    struct Pivot(RigidBody);
    impl Holonomic for Pivot {
        fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl piola_kinematics::Placement<T>) {
            let origin = nalgebra::Vector3::new(T::zero(), T::zero(), T::zero());
            bodies.body(&self.0, origin, Attitude::from_euler_zyz([q[0], q[1], q[2]]));
        }
    }
    struct OnBody;
    impl Forces for OnBody {
        const MOMENTS: bool = true;
        fn moment_on_body<T: Real>(&self, _part: usize, attitude: Attitude<T>, omega: [T; 3], t: T) -> [T; 3] {
            Driven.moment(t, attitude, omega.into()).into()
        }
    }
    let body = RigidBody::new(1.0, Inertia::principal([1.0, 2.0, 2.5]).unwrap()).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
    // From rest.
    let start = Attitude::from_euler_zyz([0.5, 1.25, -0.25]);
    let mut rotation = State::new(0.0, vec![start.w, start.x, start.y, start.z, 0.0, 0.0, 0.0]).unwrap();
    method.integrate_to(&mut RigidRotation::driven(&body, Driven).unwrap(), &mut rotation, 1.0).unwrap();
    let lagrangian = Lagrangian::of(Pivot(body)).with_forces(OnBody);
    let mut angles = State::new(0.0, vec![0.5, 1.25, -0.25, 0.0, 0.0, 0.0]).unwrap();
    method.integrate_to(&mut lagrangian.motion(3), &mut angles, 1.0).unwrap();
    let end = Attitude::from_euler_zyz([angles.values[0], angles.values[1], angles.values[2]]);
    assert_close_at_scale("attitude", &rotation.values[..4], &[end.w, end.x, end.y, end.z], 1.0, ADAPTIVE);
}

#[test]
fn run_equals_motion_and_estimates_its_error() {
    let pendulum = Lagrangian::of(crate::systems::DoublePendulum { mass: [1.0, 1.0], length: [1.0, 1.0] })
        .with_uniform_gravity([0.0, -9.8125, 0.0]);
    let mut exact = State::new(0.0, vec![0.25, -0.125, 0.0, 0.0]).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-14).unwrap());
    method.integrate_to(&mut pendulum.motion(2), &mut exact, 10.0).unwrap();
    let run_to = |tolerance| pendulum.integrate(&[0.25, -0.125], &[0.0, 0.0], 0.0..10.0, tolerance).unwrap();
    let run = run_to(Tolerance::relative(1e-9).unwrap());
    // The tolerance is relative, or absolute alone.
    for run in [&run, &run_to(Tolerance::new(0.0, 1e-9).unwrap())] {
        let error = run.last().0.iter().zip(&exact.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(0.5 * error <= run.error_estimate() && run.error_estimate() <= 2.0 * error, "{error:e}");
    }
    let (q, v) = run.last();
    assert_eq!(run.times().len() as u64, run.steps() + 1);
    assert_eq!(run.coordinates(0), Some(&[0.25, -0.125][..]));
    assert_eq!((run.velocities(run.times().len() - 1), run.coordinates(run.times().len())), (Some(v), None));
    // Backwards it comes home.
    let back = pendulum.integrate(q, v, 10.0..0.0, Tolerance::relative(1e-12).unwrap()).unwrap();
    assert_close_at_scale("start", back.last().0, &[0.25, -0.125], 1.0, Tol::stated(1e-7, "the tolerance there"));
}

#[test]
fn state_of_motion_is_second_order() {
    let pendulum = Lagrangian::of(crate::systems::Chain { links: 3 }).with_gravity(1.0);
    let motion = pendulum.motion::<f64>(3);
    assert!(Field::<f64>::is_second_order(&motion));
    assert_eq!(Field::<f64>::dimension(&pendulum.canonical_motion::<f64>(3)), 6);
}
