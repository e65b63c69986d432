//! What must be refused, and how it is named.

use piola_lagrangian::constraints::{Constrained, Constraints};
use piola_lagrangian::{ConstraintError, LagrangianError};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use crate::systems::{Drive, Spring, System, Ties, mechanism};

fn particles(ties: Ties) -> Constrained<System, Spring, Drive, Ties> {
    mechanism(System::Particles { last_has_mass: true }, [0.0; 3], 0.0).with_constraints(ties)
}

#[test]
fn contradicting_constraints_are_named_with_what_is_left() {
    // x + y = 1, z = 0 and x + y + 2 z = 1.25.
    let rows = vec![vec![1.0, 0.0, 1.0, 1.0, 0.0], vec![0.0, 0.0, 0.0, 0.0, 1.0], vec![1.25, 0.0, 1.0, 1.0, 2.0]];
    let error = particles(Ties::Linear(rows)).assemble(&[0.0; 3], &[0.0; 3], 0.0).unwrap_err();
    let LagrangianError::Constraint(ConstraintError::Inconsistent { residual, combination, constraint, .. }) = error
    else {
        panic!("{error}")
    };
    // Any one of the three may be said to contradict the others; their combination vanishes but for 1/4.
    let mut weights = combination.clone();
    weights[constraint] = -1.0;
    let unit = -1.0 / weights[2];
    let weights: Vec<f64> = weights.iter().map(|w| w * unit).collect();
    assert_close("combination", &weights, &[1.0, 2.0, -1.0], Tol::ulps(64.0));
    assert_close(
        "contradiction",
        &[(residual * unit).abs()],
        &[0.25],
        Tol::stated(1e-9, "what is left of the damping"),
    );
}

#[test]
fn constraints_that_move_apart_are_contradicting() {
    // x = t and 2 x = 3 t: at t = 0 the positions agree, the rates do not.
    let rows = vec![vec![0.0, 1.0, 1.0, 0.0, 0.0], vec![0.0, 3.0, 2.0, 0.0, 0.0]];
    let error = particles(Ties::Linear(rows)).assemble(&[0.0; 3], &[0.0; 3], 0.0).unwrap_err();
    let LagrangianError::Constraint(ConstraintError::Inconsistent { constraint: 1, residual, combination, .. }) = error
    else {
        panic!("{error}")
    };
    assert_close("combination", &combination, &[2.0, 0.0], Tol::ulps(8.0));
    assert_close("rate", &[residual], &[-1.0], Tol::stated(1e-9, "what is left of the damping"));
}

#[test]
fn links_too_short_to_meet_are_refused() {
    struct TooShort([(usize, f64); 6]);
    impl Constraints for TooShort {
        fn count(&self) -> usize {
            8
        }
        fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]) {
            for (out, (i, x)) in out.iter_mut().zip(self.0) {
                *out = q[i] - T::lit(x);
            }
            Ties::Distances(vec![(0, 1, 1.0), (1, 2, 1.0)]).residuals(q, t, &mut out[6..]);
        }
        fn name(&self, constraint: usize) -> Option<&str> {
            (6 <= constraint).then_some("link")
        }
    }
    // Two links of 1 m between points 5 m apart.
    let pins = [(0, 0.0), (1, 0.0), (2, 0.0), (6, 5.0), (7, 0.0), (8, 0.0)];
    let lagrangian = mechanism(System::Particles { last_has_mass: true }, [0.0; 3], 0.0);
    let system = lagrangian.with_constraints(TooShort(pins));
    let guess = [0.0, 0.0, 0.0, 2.5, 1.0, 0.5, 5.0, 0.0, 0.0];
    let error = system.assemble(&guess, &[0.0; 9], 0.0).unwrap_err();
    let refused = matches!(
        error,
        LagrangianError::Constraint(ConstraintError::NotAssembled { .. } | ConstraintError::Inconsistent { .. })
    );
    assert!(refused, "{error}");
}

#[test]
fn motion_without_inertia_that_the_constraints_leave_is_named() {
    let tied = Ties::Linear(vec![vec![0.0, 0.0, 1.0, 1.0, 0.0]]); // nothing of z, which has no mass
    let system = mechanism(System::Particles { last_has_mass: false }, [0.0; 3], 0.0).with_constraints(tied);
    let error = system.acceleration(&[0.0; 3], &[0.0; 3], 0.0).unwrap_err();
    let LagrangianError::SingularMetric { coordinate: 2, direction, .. } = error else { panic!("{error}") };
    assert_close("direction", &direction, &[0.0, 0.0, 1.0], Tol::ulps(1.0));
}

#[test]
fn time_in_constraints_must_be_declared() {
    struct Belt;
    impl Constraints for Belt {
        fn count(&self) -> usize {
            1
        }
        fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]) {
            out[0] = q[0] - t;
        }
        fn name(&self, _constraint: usize) -> Option<&str> {
            Some("belt")
        }
    }
    let lagrangian = mechanism(System::Particles { last_has_mass: true }, [0.0; 3], 0.0);
    let error = lagrangian.with_constraints(Belt).assemble(&[0.0; 3], &[0.0; 3], 0.0).unwrap_err();
    assert_eq!(error.to_string(), "constraint 0 (belt) depends on time: declare `const TIME_DEPENDENT: bool = true`");
}

#[test]
fn values_that_are_not_finite_are_refused_by_name() {
    let rows = vec![vec![0.0, 0.0, 1.0, 0.0, 0.0]];
    let system = particles(Ties::Linear(rows));
    let named = |q: [f64; 3], v: [f64; 3]| match system.acceleration(&q, &v, 0.0).unwrap_err() {
        LagrangianError::NotFinite { quantity, index, .. } => (quantity, index),
        error => panic!("{error}"),
    };
    assert_eq!(named([0.0, f64::NAN, 0.0], [0.0; 3]), ("q", 1));
    assert_eq!(named([0.0; 3], [0.0, 0.0, f64::INFINITY]), ("q̇", 2));
    assert!(system.acceleration(&[0.0; 3], &[0.0; 2], 0.0).is_err());
    assert!(system.assemble(&[0.0; 3], &[f64::NAN, 0.0, 0.0], 0.0).is_err());
    assert!(piola_lagrangian::constraints::Rattle::new(0.0).is_err());
}
