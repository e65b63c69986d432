//! Power and work.

use nalgebra::DVector;
use piola_integrators::Tolerance;
use piola_kinematics::BodyVelocity;
use piola_kinematics::placement::PlacementEvaluator;
use piola_lagrangian::{Forces, Lagrangian, PartPower, Workspace};
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
        let tol = Tol::ulps(256.0).times(condition(&system, (&q, &v, t)));
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
        let tol = Tol::ulps(256.0).times(condition(&system, (&q, &v, t)));
        assert_close_at_scale("P", &[balance.total()], &[power], 50.0, tol);
        assert_close_at_scale("constraint", &[balance.moving_constraint], &[along_time.constraint], 50.0, tol);

        // Q_{n+1} of the external forces from the tangent vector along the time.
        let (mut particles, mut bodies) = ([nalgebra::Vector3::zeros(); 2], [BodyVelocity::at_rest()]);
        let mut evaluator = PlacementEvaluator::new(3);
        evaluator.tangent_into(system.system(), &q, t, 3, &mut particles, &mut bodies).unwrap();
        let body = external[1].force.dot(&bodies[0].velocity) + external[1].moment.dot(&bodies[0].angular_velocity);
        let expected = external[0].force.dot(&particles[0]) + body + external[2].force.dot(&particles[1]);
        assert_close_at_scale("external", &[along_time.external], &[expected], 50.0, Tol::ulps(64.0));

        // The applied part alone, W(5.9).
        let applied: Vec<_> = external.iter().zip([1.5, 2.0, 0.5]).map(|(force, mass)| {
            piola_lagrangian::PartForce { force: force.force - mass * nalgebra::Vector3::from(GRAVITY), ..*force }
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

/// A potential V(q, t) alone: dV/dt = −P + ∂V/∂t.
#[test]
fn power_of_a_time_dependent_potential_equals_its_rates() {
    let system = Lagrangian::of(Arm::<false>::new()).with_potential(Spring::<false>);
    let (q, v, t) = ([0.25, 0.5, -0.75], [1.0, -0.5, 0.25], 0.5);
    let balance = system.power_balance(&q, &v, t).unwrap();
    let constants = v.map(Dual::constant);
    let rate = system.energies(&along(&q, &v), &constants, Dual::variable(t)).unwrap().potential.tangent;
    assert_close_at_scale("P", &[balance.potential], &[balance.potential_by_time - rate], 10.0, Tol::ulps(8.0));
    // ∂V/∂t = −2 (q¹ − sin t) cos t − q⁰² sin t
    let by_hand = -2.0 * (0.5 - 0.5_f64.sin()) * 0.5_f64.cos() - 0.0625 * 0.5_f64.sin();
    assert_close("∂V/∂t", &[balance.potential_by_time], &[by_hand], Tol::ulps(8.0));
    assert_close("constraint", &[balance.moving_constraint], &[0.0], Tol::ulps(0.0));
}
