//! Generalised potentials, and the integrals of a Lagrangian without time.

use nalgebra::Vector3;
use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_lagrangian::{Holonomic, Lagrangian, LagrangianFunction, Placement, Potential};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::states;

/// A particle of 2 kg in Cartesian coordinates.
struct Particle;
impl Holonomic for Particle {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::new(q[0], q[1], q[2]));
    }
}

/// V = −e E·x cos t − e A·v, A = ½ B × x, of the charge 1.5.
struct Lorentz;
const CHARGE: f64 = 1.5;
const ELECTRIC: [f64; 3] = [0.5, -0.25, 0.125];
const MAGNETIC: [f64; 3] = [1.0, -2.0, 0.5];
impl Potential for Lorentz {
    const VELOCITY_DEPENDENT: bool = true;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let mut sum = T::zero();
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let vector_potential = T::lit(0.5) * (T::lit(MAGNETIC[i]) * q[j] - T::lit(MAGNETIC[j]) * q[i]);
            sum += T::lit(ELECTRIC[k]) * q[k] * t.cos() + vector_potential * v[k];
        }
        -T::lit(CHARGE) * sum
    }
}

proptest! {
    #[test]
    fn force_of_the_electromagnetic_potential_equals_lorentz_force((q, v, t) in states()) {
        let charged = Lagrangian::of(Particle).with_potential(Lorentz);
        let velocity = Vector3::from_column_slice(&v);
        let magnetic = velocity.cross(&Vector3::from(MAGNETIC));
        let force: Vector3<f64> = CHARGE * (Vector3::from(ELECTRIC) * t.cos() + magnetic);
        let acceleration = charged.acceleration(&q, &v, t).unwrap();
        assert_close_at_scale("a", (2.0 * acceleration).as_slice(), force.as_slice(), 5.0, Tol::ulps(16.0));
        // It is the force on the one part, and the magnetic field has no power.
        let reaction = charged.reactions(&q, &v, t).unwrap()[0];
        assert_close_at_scale("f", reaction.force().as_slice(), force.as_slice(), 5.0, Tol::ulps(16.0));
        let balance = charged.power_balance(&q, &v, t).unwrap();
        let power = CHARGE * t.cos() * Vector3::from(ELECTRIC).dot(&velocity);
        assert_close_at_scale("P", &[balance.potential], &[power], 10.0, Tol::ulps(32.0));
    }
}

/// A bead on a hoop that turns evenly: L does not depend on time though the placement does.
struct Hoop;
const TURN: f64 = 3.0;
impl Holonomic for Hoop {
    const TIME_DEPENDENT: bool = true;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let ((s, c), (st, ct)) = (q[0].sin_cos(), (T::lit(TURN) * t).sin_cos());
        bodies.particle(1.0, Vector3::new(s * ct, s * st, -c));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn jacobi_integral_is_conserved_where_energy_is_not((q, v, t) in states()) {
        let hoop = Lagrangian::of(Hoop).with_gravity(9.8);
        let tolerance = Tolerance::relative(1e-13).unwrap();
        let account = hoop.work_account(&q[..1], &v[..1], t..t + 1.3, tolerance).unwrap();
        let h = |q: &[f64], v: &[f64], t: f64| hoop.jacobi_integral(q, v, t).unwrap();
        let (before, after) = (h(&q[..1], &v[..1], t), h(&account.coordinates, &account.velocities, t + 1.3));
        let run = Tol::stated(1e-11, "a hundred times the tolerance of the run");
        assert_close_at_scale("h", &[after], &[before], 10.0, run);
        // h = E₂ − E₀ + V: the energy differs by twice the part of the turning alone, m Ω² sin² q.
        let turning = |q: f64| TURN * TURN * q.sin().powi(2);
        let expected = turning(account.coordinates[0]) - turning(q[0]);
        assert_close_at_scale("E", &[account.energy_change], &[expected], 10.0, run);
        let rate = hoop.time_derivative(&q[..1], &v[..1], t).unwrap();
        assert_close_at_scale("∂L/∂t", &[rate], &[0.0], 10.0, Tol::ulps(8.0));
    }
}

/// L = ½ q² v² − ¼ q⁴: a mass that depends on the place.
struct Quartic;
impl LagrangianFunction for Quartic {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let square = q[0] * q[0];
        T::lit(0.5) * square * v[0] * v[0] - T::lit(0.25) * square * square
    }
}

/// dq/dt = v, (∂²L/∂v∂v) dv/dt = ∂L/∂q − (∂²L/∂q∂v) v.
#[test]
fn first_order_form_equals_the_field_of_the_motion() {
    let quartic = Lagrangian::from_function(Quartic);
    let (q, v): (f64, f64) = (1.5, 0.5);
    let by_hand = (q * v * v - q * q * q - 2.0 * q * v * v) / (q * q);
    let mut rate = [0.0; 2];
    quartic.motion(1).rate(0.0, &[q, v], &mut rate).unwrap();
    assert_close("ẏ", &rate, &[v, by_hand], Tol::ulps(8.0));
    // With u = ½ q² it is L = ½ u̇² − u²: u swings as cos √2 t.
    let mut state = State::new(0.0, vec![1.5, 0.0]).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
    method.integrate_to(&mut quartic.motion(1), &mut state, 0.75).unwrap();
    let u = 0.5 * 1.5 * 1.5 * (0.75 * std::f64::consts::SQRT_2).cos();
    let run = Tol::stated(1e-11, "a hundred times the tolerance of the run");
    assert_close_at_scale("q", &state.values[..1], &[(2.0 * u).sqrt()], 1.0, run);
}
