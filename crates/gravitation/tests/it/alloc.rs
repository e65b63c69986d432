//! Sums and steps allocate nothing after set-up.

use piola_gravitation::Gravitation;
use piola_integrators::{Composition, Order, Separable, State};
use piola_testkit::allocations_in;

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
