//! Evaluations and steps allocate nothing after set-up.

use piola_dynamics::gravitation::Gravitation;
use piola_dynamics::hamiltonian::{HamiltonianField, PhaseFunction};
use piola_dynamics::lagrangian::{Forces, Holonomic, Lagrangian, Potential, Workspace};
use piola_integrators::{Composition, Field, GaussLegendre, Order, Separable, State};
use piola_numerics::Real;
use piola_testkit::allocations_in;

use crate::any::{Law, for_all_systems};

struct NoAllocation;
impl Law for NoAllocation {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let mut work = Workspace::default();
        let (mut out, mut metric, mut rate) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; 2 * n]);
        let state = [q, v].concat();
        let (mut motion, mut canonical) = (lagrangian.motion(n), lagrangian.canonical_motion(n));
        let mut all = || {
            lagrangian.acceleration_into(&mut work, q, v, t, &mut out).unwrap();
            lagrangian.energies_with(&mut work, q, v, t).unwrap();
            lagrangian.inertia_metric_into(&mut work, q, t, &mut metric).unwrap();
            lagrangian.momenta_into(&mut work, q, v, t, &mut out).unwrap();
            lagrangian.velocities_into(&mut work, q, v, t, &mut out).unwrap();
            motion.rate(t, &state, &mut rate).unwrap();
            canonical.rate(t, &state, &mut rate).unwrap();
        };
        all();
        let (count, ()) = allocations_in(all);
        assert_eq!(count, 0, "{name}");
    }
}

#[test]
fn evaluations_allocate_nothing() {
    for_all_systems(&NoAllocation, &[0.25, -0.5, 0.75, 0.125, -0.25, 0.5], &[1.0, -0.5, 0.25, 0.75, 0.5, -1.0], 0.25);
}

#[test]
fn attraction_allocates_nothing() {
    for n in [2, 11, 14, 100] {
        let mut bodies = Gravitation::new(vec![1.0; n]).unwrap();
        let places: Vec<f64> = (0..3 * n).map(|i| (i * i) as f64).collect();
        let mut force = vec![0.0; 3 * n];
        let (count, ()) = allocations_in(|| bodies.force(0.0, &places, &mut force).unwrap());
        assert_eq!(count, 0, "{n} bodies");
    }
}

#[test]
fn million_steps_of_three_bodies_allocate_nothing() {
    let mut bodies = Gravitation::new(vec![1.0, 1e-3, 1e-3]).unwrap();
    let start = bodies
        .state(
            &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            &[[0.0; 3], [0.0, 1.0, 0.0], [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0]],
        )
        .unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let mut method = Composition::new(Order::Two, 1e-3).unwrap();
    method.integrate_to(&mut bodies, &mut state, 1e-3).unwrap();
    let (count, report) = allocations_in(|| method.integrate_to(&mut bodies, &mut state, 1000.001).unwrap());
    assert_eq!((count, report.steps), (0, 1_000_000));
}

#[test]
fn implicit_steps_of_a_hamiltonian_allocate_nothing() {
    struct Pendulum;
    impl PhaseFunction for Pendulum {
        fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
            T::lit(0.5) * p[0] * p[0] - q[0].cos()
        }
    }
    let mut field = HamiltonianField::new(&Pendulum, 1);
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut method = GaussLegendre::new(Order::Eight, 0.125).unwrap();
    method.integrate_to(&mut field, &mut state, 0.125).unwrap();
    let (count, _) = allocations_in(|| method.integrate_to(&mut field, &mut state, 10.0).unwrap());
    assert_eq!(count, 0);
}
