//! Brackets, fields and maps of the usual sizes allocate nothing.

use piola_hamiltonian::{HamiltonianField, PhaseFunction, PhaseMap, PolarCoordinates, poisson_bracket};
use piola_integrators::{GaussLegendre, Order, State};
use piola_numerics::Real;
use piola_testkit::allocations_in;

use super::systems::{AnyFunction, Kepler};

#[test]
fn brackets_maps_and_steps_allocate_nothing() {
    let (k, h) = (AnyFunction([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]), AnyFunction([0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1]));
    let (q, p) = ([0.3, 0.4], [0.5, 0.6]);
    let (count, value) = allocations_in(|| poisson_bracket(&k, &h, &q, &p, 0.0));
    assert_eq!((count, value.is_ok()), (0, true));
    let mut new = [0.0; 4];
    let (count, mapped) = allocations_in(|| PolarCoordinates.map(&q, &p, 0.0, &mut new));
    assert_eq!((count, mapped), (0, Ok(())));
    let kepler = Kepler { mass: 1.0, strength: 1.0 };
    let mut field = HamiltonianField::new(&kepler, 3);
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.1]).unwrap();
    let mut method = GaussLegendre::new(Order::Six, 0.05).unwrap();
    method.integrate_to(&mut field, &mut state, 0.05).unwrap();
    let (count, report) = allocations_in(|| method.integrate_to(&mut field, &mut state, 50.05).map(|r| r.steps));
    assert_eq!((count, report.unwrap()), (0, 1000));
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
