//! Power and work.

use nalgebra::{DVector, Vector3};
use piola_integrators::Tolerance;
use piola_kinematics::BodyVelocity;
use piola_kinematics::placement::PlacementEvaluator;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, PartPower, Placement, Potential, Workspace};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::*;

fn along(x: &[f64], rate: &[f64]) -> Vec<Dual<f64>> {
    x.iter().zip(rate).map(|(&x, &rate)| Dual::new(x, rate)).collect()
}

proptest! {
    #[test]
    fn rate_of_kinetic_energy_equals_total_power_and_rate_of_energy_equals_what_enters((q, v, t) in states()) {
        let system = everything();
        let a = system.acceleration(&q, &v, t).unwrap();
        let balance = system.power_balance(&q, &v, t).unwrap();
        let (moving, rates) = (along(&q, &v), along(&v, a.as_slice()));
        let energies = system.energies(&moving, &rates, Dual::variable(t)).unwrap();
        let tol = Tol::ulps(8.0).times(condition(&system, (&q, &v, t)));
        let scale = 50.0 + balance.kinetic_energy_rate.abs();
        assert_close_at_scale("dE/dt", &[balance.kinetic_energy_rate], &[energies.kinetic.tangent], scale, tol);
        assert_close_at_scale("P", &[balance.total()], &[energies.kinetic.tangent], scale, tol);
        assert_close_at_scale("residual", &[balance.residual()], &[0.0], scale, tol);

        // E + V − q̇·∂V/∂q̇ with V of gravity and of the spring; its velocity part by hand.
        let slope = |q: &[Dual<f64>], v: &[Dual<f64>], t: Dual<f64>| {
            let half = Dual::constant(0.5);
            half * q[0] * v[1] - half * q[1].sin() * v[2] * v[0] - Dual::constant(0.125) * t * v[2]
        };
        let energy = energies.total() - slope(&moving, &rates, Dual::variable(t));
        assert_close_at_scale("energy", &[balance.energy_rate()], &[energy.tangent], scale, tol);
    }

    #[test]
    fn total_power_equals_generalised_forces_times_velocities_and_component_along_time((q, v, t) in states()) {
        let system = driven();
        let a = system.acceleration(&q, &v, t).unwrap();
        let external = external_forces(&motions(system.system(), (&q, &v, a.as_slice()), t), t);
        let generalised = system.virtual_work(&external, &q, t).unwrap();
        let along_time = system.force_along_time(&q, &v, t).unwrap();
        let power = generalised.dot(&DVector::from_column_slice(&v)) + along_time.total();
        let balance = system.power_balance(&q, &v, t).unwrap();
        let tol = Tol::ulps(8.0).times(condition(&system, (&q, &v, t)));
        assert_close_at_scale("P", &[balance.total()], &[power], 50.0, tol);
        assert_close_at_scale("constraint", &[balance.moving_constraint], &[along_time.constraint], 50.0, tol);

        // Q_{n+1} of the external forces from the tangent vector along the time.
        let (mut particles, mut bodies) = ([Vector3::zeros(); 2], [BodyVelocity::at_rest()]);
        let mut evaluator = PlacementEvaluator::new(3);
        evaluator.tangent_into(system.system(), &q, t, 3, &mut particles, &mut bodies).unwrap();
        let body = external[1].force.dot(&bodies[0].velocity) + external[1].moment.dot(&bodies[0].angular_velocity);
        let expected = external[0].force.dot(&particles[0]) + body + external[2].force.dot(&particles[1]);
        assert_close_at_scale("external", &[along_time.external], &[expected], 50.0, Tol::ulps(64.0));

        // The applied part alone, W(5.9).
        let applied: Vec<_> = external.iter().zip([1.5, 2.0, 0.5]).map(|(force, mass)| {
            piola_lagrangian::PartForce { force: force.force - mass * Vector3::from(GRAVITY), ..*force }
        }).collect();
        let expected = system.virtual_work(&applied, &q, t).unwrap();
        let actual = system.generalised_forces(&q, &v, t).unwrap();
        assert_close_at_scale("Q", actual.as_slice(), expected.as_slice(), 50.0, Tol::ulps(64.0));
    }

    #[test]
    fn powers_of_actuators_sum_to_applied_power((q, v, t) in states()) {
        let system = everything();
        let (mut parts, mut coordinates) = ([PartPower::default(); 3], [0.0; 3]);
        system.actuator_powers_into(&mut Workspace::default(), &q, &v, t, &mut parts, &mut coordinates).unwrap();
        let sum = parts.iter().map(|power| power.force + power.moment).sum::<f64>() + coordinates.iter().sum::<f64>();
        let balance = system.power_balance(&q, &v, t).unwrap();
        assert_close_at_scale("applied", &[sum], &[balance.applied], 20.0, Tol::ulps(32.0));
        let mut forces = [0.0; 3];
        system.forces().generalised(&q, &v, t, &mut forces);
        let expected: Vec<f64> = forces.iter().zip(&v).map(|(force, v)| force * v).collect();
        assert_close("motors", &coordinates, &expected, Tol::ulps(0.0));
        assert_eq!(parts[0].moment.to_bits(), 0.0_f64.to_bits());
    }
}

#[test]
fn change_of_energy_equals_work() {
    let tolerance = Tolerance::relative(1e-13).unwrap();
    let account = everything().work_account(&[0.25, 0.5, -0.75], &[1.0, -0.5, 0.25], 0.0..3.0, tolerance).unwrap();
    let tol = Tol::stated(1e-11, "a hundred times the tolerance of the run");
    assert_close_at_scale("energy", &[account.energy_change], &[account.works.total()], account.energy_scale, tol);
    assert!(account.imbalance() < tol.value(), "{account:?}");
    // Every source has its share.
    for work in [account.works.applied, account.works.moving_constraint, account.works.potential_by_time] {
        assert!(0.01 < work.abs(), "{:?}", account.works);
    }
}

/// A potential V(q, t) alone: dV/dt = −P + ∂V/∂t, and both by hand from
/// V = (q¹ − sin t)² + (q⁰)² (2 + cos t) + cos q².
#[test]
fn power_of_a_time_dependent_potential_equals_its_rates() {
    let system = Lagrangian::of(Arm::<false>::new()).with_potential(Spring::<false>);
    let (q, v, t) = ([0.25, 0.5, -0.75], [1.0, -0.5, 0.25], 0.5);
    let balance = system.power_balance(&q, &v, t).unwrap();
    let constants = v.map(Dual::constant);
    let rate = system.energies(&along(&q, &v), &constants, Dual::variable(t)).unwrap().potential.tangent;
    assert_close_at_scale("P", &[balance.potential], &[balance.potential_by_time - rate], 10.0, Tol::ulps(8.0));
    // P = −∂V/∂q·q̇
    let power =
        -(2.0 * 0.25 * (2.0 + 0.5_f64.cos()) * 1.0 + 2.0 * (0.5 - 0.5_f64.sin()) * -0.5 - (-0.75_f64).sin() * 0.25);
    assert_close("P by hand", &[balance.potential], &[power], Tol::ulps(8.0));
    // ∂V/∂t = −2 (q¹ − sin t) cos t − q⁰² sin t
    let by_hand = -2.0 * (0.5 - 0.5_f64.sin()) * 0.5_f64.cos() - 0.0625 * 0.5_f64.sin();
    assert_close("∂V/∂t", &[balance.potential_by_time], &[by_hand], Tol::ulps(8.0));
    assert_close("constraint", &[balance.moving_constraint], &[0.0], Tol::ulps(0.0));
}

/// A charge e = 2 C of 4 kg in φ = x y t + z² and A = (t y z, x² t², t − y): V = e φ − e A·v.
struct Charge;

impl Holonomic for Charge {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(4.0, Vector3::new(q[0], q[1], q[2]));
    }
}

impl Potential for Charge {
    const VELOCITY_DEPENDENT: bool = true;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let (x, y, z) = (q[0], q[1], q[2]);
        let along = t * y * z * v[0] + x * x * t * t * v[1] + (t - y) * v[2];
        T::lit(2.0) * (x * y * t + z * z - along)
    }
}

/// W(7.9) for the force of Lorentz, e (E + v × B): only E = −∇φ − ∂A/∂t works. At x = (1, 2, ½), v = (3, −1, 2), t = ½
///
/// ```text
/// ∇φ = (y t, x t, 2 z) = (1, ½, 1)       ∂A/∂t = (y z, 2 x² t, 1) = (1, 1, 1)     E = (−2, −3/2, −2)
/// B = (−1, t y, 2 x t² − t z) = (−1, 1, ¼)      v × B = (−9/4, −11/4, 2)          E·v = −17/2
/// ∂V/∂t = e (x y − v·∂A/∂t) = 2 (2 − 4)
/// ```
#[test]
fn power_of_the_force_of_lorentz_equals_that_of_the_electric_field() {
    let system = Lagrangian::of(Charge).with_potential(Charge);
    let (q, v, t) = ([1.0, 2.0, 0.5], [3.0, -1.0, 2.0], 0.5);
    let balance = system.power_balance(&q, &v, t).unwrap();
    // Numbers of a few binary digits: nothing rounds.
    let exact = Tol::ulps(0.0);
    let acceleration = system.acceleration(&q, &v, t).unwrap();
    assert_close("q̈", acceleration.as_slice(), &[-2.125, -2.125, 0.0], exact);
    assert_close("P", &[balance.potential, balance.total(), balance.kinetic_energy_rate], &[-17.0; 3], exact);
    assert_close("∂V/∂t", &[balance.potential_by_time, balance.energy_rate()], &[-4.0; 2], exact);
    let others = [balance.gravity, balance.applied, balance.moving_constraint, balance.residual()];
    assert_close("nothing else", &others, &[0.0; 4], exact);
}

/// A mass of 2 kg that a force 3 cos 2t drives along a line, V = −3 q cos 2t.
struct Swung;

impl Holonomic for Swung {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::new(q[0], T::zero(), T::zero()));
    }
}

impl Potential for Swung {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], t: T) -> T {
        T::lit(-3.0) * q[0] * (T::lit(2.0) * t).cos()
    }
}

/// W(7.9) integrated: q = q₀ + v₀ t + ⅜ (1 − cos 2t), so that with T the end of the run
///
/// ```text
/// ∫ ∂V/∂t dt = 6 ∫ q sin 2t dt = 6 [½ (q₀ + ⅜)(1 − cos 2T) + v₀ (¼ sin 2T − ½ T cos 2T) − (3/32) sin² 2T]
/// ```
#[test]
fn work_of_a_time_dependent_potential_equals_its_closed_form() {
    let system = Lagrangian::of(Swung).with_potential(Swung);
    let (start, speed, end) = (0.5, -1.0, 3.0_f64);
    let account = system.work_account(&[start], &[speed], 0.0..end, Tolerance::relative(1e-13).unwrap()).unwrap();
    let (s, c) = (2.0 * end).sin_cos();
    let parts = [0.5 * (start + 0.375) * (1.0 - c), speed * (0.25 * s - 0.5 * end * c), -0.093_75 * s * s];
    let expected = 6.0 * parts.iter().sum::<f64>();
    let tol = Tol::stated(1e-12, "a few dozen steps of local error 1e-13");
    assert_close("by time", &[account.works.potential_by_time], &[expected], tol);
    assert_close("energy", &[account.energy_change], &[expected], tol);
    let place = start + speed * end + 0.375 * (1.0 - c);
    assert_close("q", &account.coordinates, &[place], tol);
    assert_close("q̇", &account.velocities, &[speed + 0.75 * s], tol);
    assert_close("others", &[account.works.applied, account.works.moving_constraint], &[0.0; 2], Tol::ulps(0.0));
}
