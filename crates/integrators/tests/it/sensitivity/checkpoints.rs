//! Memory and steps made again.

use piola_integrators::{AdjointSensitivity, DormandPrincePair, ObjectiveGradient, State, VernerPair};

use super::{Driven, Kepler, Mixed, adjoint, coefficients, fixed, method};

/// The fewest steps made again for so many steps, with so many states: by the recursion.
fn fewest(length: usize, states: usize, known: &mut Vec<Vec<Option<u64>>>) -> u64 {
    if length <= 1 {
        return 0;
    }
    if states == 1 {
        return (length * (length - 1) / 2) as u64;
    }
    let states = states.min(length);
    if let Some(known) = known[length][states] {
        return known;
    }
    let best =
        (1..length).map(|m| m as u64 + fewest(length - m, states - 1, known) + fewest(m, states, known)).min().unwrap();
    known[length][states] = Some(best);
    best
}

/// Steps made again after a run of so many steps, with so many states kept beside the start.
fn expected(steps: usize, checkpoints: usize, known: &mut Vec<Vec<Option<u64>>>) -> u64 {
    let capacity = checkpoints + 1;
    let mut spacing = 1;
    while capacity < steps.div_ceil(spacing) {
        spacing *= 2;
    }
    if capacity == 1 {
        spacing = steps;
    }
    let kept: Vec<usize> = (0..steps).step_by(spacing).collect();
    let mut total = 0;
    for (place, &start) in kept.iter().enumerate() {
        let end = kept.get(place + 1).copied().unwrap_or(steps);
        // Those at its end and after it are free by then.
        let free = capacity - (place + 1);
        total += fewest(end - start, 1 + free, known);
    }
    total
}

#[test]
fn steps_made_again_are_the_fewest_for_the_states_kept() {
    let p = [1.0];
    for steps in [1_usize, 2, 7, 33, 100] {
        let mut known = vec![vec![None; steps + 2]; steps + 1];
        for checkpoints in [0, 1, 2, 3, 5, 10, 31, 99, 1000] {
            let end = 0.03125 * steps as f64;
            let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 1.0]).unwrap();
            let mut method = AdjointSensitivity::new(fixed::<DormandPrincePair, f64>(0.03125), checkpoints);
            method.integrate_to(&Kepler, &p, &mut state, end).unwrap();
            assert_eq!(method.steps(), steps);
            assert!(method.kept_states() <= (checkpoints + 1).min(steps));
            let mut gradient = ObjectiveGradient::default();
            method.gradient(&Kepler, &Mixed, &mut gradient).unwrap();
            let first = gradient.clone();
            assert_eq!(gradient.replayed_steps, expected(steps, checkpoints, &mut known), "{steps} by {checkpoints}");
            if steps <= (checkpoints + 1) * (checkpoints + 1) {
                assert!(10 * gradient.replayed_steps <= 21 * steps as u64);
            }
            // Once more, from the start alone.
            method.gradient(&Kepler, &Mixed, &mut gradient).unwrap();
            assert_eq!(gradient.replayed_steps, fewest(steps, checkpoints + 1, &mut known));
            assert_eq!(ObjectiveGradient { replayed_steps: first.replayed_steps, ..gradient }, first);
            assert!(method.kept_states() <= checkpoints + 1);
        }
    }
}

#[test]
fn gradient_has_the_same_bits_for_any_number_of_states_kept() {
    let field = Driven { coefficients: 5 };
    let p = coefficients(5);
    let run = |checkpoints| {
        let inputs = (&[0.0, 0.0][..], &p[..]);
        let gradient = adjoint(method::<VernerPair, f64>(1e-12), checkpoints, &field, &Mixed, inputs, 40.0);
        (gradient.replayed_steps, ObjectiveGradient { replayed_steps: 0, ..gradient })
    };
    let (none_again, all_kept) = run(1000);
    assert_eq!(none_again, 0);
    for checkpoints in [0, 1, 2, 5, 17] {
        let (again, gradient) = run(checkpoints);
        assert_eq!(gradient, all_kept);
        assert!(0 < again);
    }
}
