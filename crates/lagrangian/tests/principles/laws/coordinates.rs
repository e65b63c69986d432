//! Systems in other coordinates.

use nalgebra::{DMatrix, DVector};
use piola_lagrangian::{ChangeOfCoordinates, Forces, InCoordinates, Lagrangian};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::*;

/// `q_i = r_i + Σ a_ij sin(r_j + t) + b_i r_i²`: a smooth change, invertible where the slopes stay below one.
#[derive(Clone, Debug)]
struct Wavy {
    waves: Vec<f64>,
    bends: Vec<f64>,
}

impl ChangeOfCoordinates<3> for Wavy {
    const TIME_DEPENDENT: bool = true;
    fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; 3] {
        let sines = [(new[0] + t).sin(), (new[1] + t).sin(), (new[2] + t).sin()];
        core::array::from_fn(|i| {
            let mut sum = new[i] + T::lit(self.bends[i]) * new[i] * new[i];
            for (j, &sine) in sines.iter().enumerate() {
                sum += T::lit(self.waves[3 * i + j]) * sine;
            }
            sum
        })
    }
}

fn changes() -> impl Strategy<Value = Wavy> {
    use piola_testkit::strategies::vector;
    (vector(9, -0.2..0.2), vector(3, -0.1..0.1)).prop_map(|(waves, bends)| Wavy { waves, bends })
}

/// ∂q/∂r.
fn jacobian(change: &Wavy, r: &[f64], t: f64) -> DMatrix<f64> {
    DMatrix::from_fn(3, 3, |i, j| change.tangent(r, t, j)[i])
}

proptest! {
    #[test]
    fn inertia_metric_is_a_positive_definite_covariant_tensor(change in changes(), (r, _, t) in states()) {
        let slopes = jacobian(&change, &r, t);
        let q = change.old_coordinates(&r, t);
        let expected = slopes.transpose() * driven().inertia_metric(&q, t).unwrap() * &slopes;
        let metric = Lagrangian::of(InCoordinates::new(Arm::<true>::new(), change)).inertia_metric(&r, t).unwrap();
        assert_close("symmetric", metric.as_slice(), metric.transpose().as_slice(), Tol::ulps(0.0));
        prop_assert!(metric.clone().cholesky().is_some(), "positive definite: {metric}");
        let condition = condition_of(&slopes);
        assert_close("metric", metric.as_slice(), expected.as_slice(), Tol::ulps(32.0).times(condition));
    }

    #[test]
    fn generalised_forces_are_a_covector_and_accelerations_transform_with_second_derivatives(
        change in changes(), (r, rates, t) in states(),
    ) {
        let old = everything();
        let new = everything().in_coordinates(change.clone());
        let slopes = jacobian(&change, &r, t);
        let still = change.old_motion(&r, &rates, &[0.0; 3], t);
        let (q, v) = (still.map(|q| q.value), still.map(|q| q.rate));
        let forces = new.generalised_forces(&r, &rates, t).unwrap();
        let expected = slopes.transpose() * old.generalised_forces(&q, &v, t).unwrap();
        assert_close_at_scale("Q", forces.as_slice(), expected.as_slice(), 20.0, Tol::ulps(64.0));

        let second_rates = new.acceleration(&r, &rates, t).unwrap();
        let actual = change.old_motion(&r, &rates, second_rates.as_slice(), t).map(|q| q.second_rate);
        let expected = old.acceleration(&q, &v, t).unwrap();
        let tol = Tol::ulps(64.0).times(condition(&new, (&r, &rates, t)) * condition(&old, (&q, &v, t)));
        assert_close_at_scale("q̈", &actual, expected.as_slice(), 50.0, tol);
        // q̈ = (∂q/∂r) r̈ + what is left at r̈ = 0
        let left = DVector::from_iterator(3, still.map(|q| q.second_rate));
        let by_slopes = &slopes * &second_rates + left;
        assert_close_at_scale("slopes", &actual, by_slopes.as_slice(), 50.0, Tol::ulps(64.0));

        // The covariant acceleration is a vector, of a change that holds still.
        let bends: Vec<f64> = change.bends.clone();
        let still = Steady(Wavy { waves: change.waves, bends });
        let (old, new) = (Lagrangian::of(Arm::<false>::new()), Lagrangian::of(Arm::<false>::new()));
        let new = new.in_coordinates(still.clone());
        let moved = still.old_motion(&r, &rates, &[0.5, -1.0, 2.0], 0.0);
        let [q, v, a] = [moved.map(|q| q.value), moved.map(|q| q.rate), moved.map(|q| q.second_rate)];
        let covariant = new.covariant_acceleration(&r, &rates, &[0.5, -1.0, 2.0], 0.0).unwrap();
        let actual = DMatrix::from_fn(3, 3, |i, j| still.tangent(&r, 0.0, j)[i]) * covariant;
        let expected = old.covariant_acceleration(&q, &v, &a, 0.0).unwrap();
        let tol = Tol::ulps(64.0).times(condition(&new, (&r, &rates, 0.0)) * condition(&old, (&q, &v, 0.0)));
        assert_close_at_scale("Dq̇/Dt", actual.as_slice(), expected.as_slice(), 50.0, tol);
    }

    #[test]
    fn energies_and_momenta_of_the_changed_system_equal_those_of_the_old(
        change in changes(), (r, rates, t) in states(),
    ) {
        let old = everything();
        let moved = change.old_motion(&r, &rates, &[0.0; 3], t);
        let (q, v) = (moved.map(|q| q.value), moved.map(|q| q.rate));
        let slopes = jacobian(&change, &r, t);
        let new = everything().in_coordinates(change);
        let (actual, expected) = (new.energies(&r, &rates, t).unwrap(), old.energies(&q, &v, t).unwrap());
        let scale = 50.0 + expected.kinetic;
        assert_close_at_scale("E", &[actual.kinetic], &[expected.kinetic], scale, Tol::ulps(16.0));
        assert_close_at_scale("V", &[actual.potential], &[expected.potential], scale, Tol::ulps(16.0));
        let expected = slopes.transpose() * old.momenta(&q, &v, t).unwrap();
        let actual = new.momenta(&r, &rates, t).unwrap();
        assert_close_at_scale("p", actual.as_slice(), expected.as_slice(), scale, Tol::ulps(64.0));
    }
}

/// The change as it is at the time zero.
#[derive(Clone)]
struct Steady(Wavy);
impl ChangeOfCoordinates<3> for Steady {
    fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 3] {
        self.0.old_coordinates(new, T::zero())
    }
}

/// Fewer new coordinates than old ones: a constraint more.
#[derive(Clone)]
struct Locked;
impl ChangeOfCoordinates<3> for Locked {
    fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 3] {
        [T::lit(0.25), new[0], new[1]]
    }
}

#[test]
fn locked_coordinate_equals_constrained_equations() {
    let system = Lagrangian::of(Arm::<false>::new()).with_gravity(9.8);
    let locked = Lagrangian::of(Arm::<false>::new()).with_gravity(9.8).in_coordinates(Locked);
    let (q, v) = ([0.25, 0.5, -0.75], [0.0, -0.5, 0.25]);
    let a = locked.acceleration(&q[1..], &v[1..], 0.0).unwrap();
    // The equations of the old system, with the lock's force on the first coordinate alone.
    let force = system.driving_forces(&q, &v, &[0.0, a[0], a[1]], 0.0).unwrap();
    assert_close_at_scale("free", &force.as_slice()[1..], &[0.0, 0.0], 50.0, Tol::ulps(64.0));
    assert!(1.0 < force[0].abs(), "the lock holds");
    let mut none = [0.0; 2];
    InCoordinates::<_, _, 3>::new(Push::<true>, Locked).generalised(&q[1..], &v[1..], 0.0, &mut none);
    let mut all = [0.0; 3];
    Push::<true>.generalised(&q, &v, 0.0, &mut all);
    assert_close("pulled back", &none, &all[1..], Tol::ulps(0.0));
}
