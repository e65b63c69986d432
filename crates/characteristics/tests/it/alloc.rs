//! Evaluations and steps allocate nothing.

use piola_characteristics::{CharacteristicField, RayField};
use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_testkit::allocations_in;

use super::systems::{Bent, Eikonal};

#[test]
fn evaluations_and_steps_allocate_nothing() {
    let start = vec![0.3, 0.1, 0.2, 0.4, 0.8, 1.0, 0.1, 0.05, -0.3, 0.2];
    let mut rate = [0.0; 10];
    let mut alone = CharacteristicField::<_, f64>::new(&Bent, 2);
    let mut ray = RayField::new(&Bent, 2, 1);
    let mut space = RayField::new(&Eikonal, 3, 2);
    let state_in_space = [0.1; 21];
    let mut rate_in_space = [0.0; 21];
    let mut method = DormandPrince853::new(Tolerance::relative(1e-10).unwrap());
    let mut state = State::new(0.0, start.clone()).unwrap();
    let mut evaluate = || {
        alone.rate(0.0, &start[..5], &mut rate[..5]).unwrap();
        ray.rate(0.0, &start, &mut rate).unwrap();
        let determinant = ray.determinant_and_slope(&start);
        assert!((ray.determinant(&start) - determinant.value).abs() < 1e-15);
        space.rate(0.0, &state_in_space, &mut rate_in_space).unwrap();
        space.determinant_and_slope(&state_in_space);
        let end = state.time + 1.0;
        method.integrate_to(&mut ray, &mut state, end).unwrap();
    };
    evaluate();
    assert_eq!(allocations_in(evaluate).0, 0);
}
