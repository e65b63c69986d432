//! Advice: what it promises of runs on problems that were not measured, and what it refuses.

use piola_integrators::{
    Advice, AdvisedMethod, Character, Composition, DormandPrince853, GaussLegendre16, GaussRadau15, IntegratorsError,
    Nystrom86, Nystrom1210, Order, State, Tolerance, Verner98, advise,
};

use crate::problems::{FIGURE_EIGHT, kepler, kepler_at, three_bodies};

/// Runs an advised method on bodies that attract each other, for so many turns of a period.
macro_rules! follow {
    ($advice:expr, $field:expr, $state:expr, $period:expr, $turns:expr) => {{
        let Advice { method, tolerance, steps_per_turn, .. } = $advice;
        let tolerance = Tolerance::relative(tolerance.unwrap_or(0.5)).unwrap();
        let end = $period * $turns;
        match method {
            AdvisedMethod::DormandPrince853 => DormandPrince853::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::Verner98 => Verner98::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::Nystrom86 => Nystrom86::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::Nystrom1210 => Nystrom1210::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::GaussLegendre16 => GaussLegendre16::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::GaussRadau15 if $advice.tolerance.is_none() => {
                GaussRadau15::to_rounding().integrate_to($field, $state, end)
            }
            AdvisedMethod::GaussRadau15 => GaussRadau15::new(tolerance).integrate_to($field, $state, end),
            AdvisedMethod::Composition8 => Composition::new(Order::Eight, $period / steps_per_turn.unwrap())
                .unwrap()
                .integrate_to($field, $state, end),
            other => panic!("{other} is not for these equations"),
        }
        .unwrap()
    }};
}

fn error(actual: &[f64], expected: &[f64]) -> f64 {
    actual.iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
}

#[test]
fn advised_runs_reach_the_error_asked_for_within_a_factor_of_ten() {
    let tau = core::f64::consts::TAU;
    let mut compared = 0;
    for exponent in [4, 6, 8, 10, 11] {
        let asked = 10_f64.powi(-exponent);
        for (eccentricity, turns) in [(0.2, 10.0), (0.45, 10.0), (0.3, 40.0), (0.8, 10.0), (0.95, 5.0)] {
            for character in
                [Character::of_first_order(), Character::of_positions(), Character::of_positions().over_any_scalar()]
            {
                let character = if 0.5 < eccentricity { character.with_uneven_steps() } else { character };
                let advice = advise(&character.for_turns(turns).unwrap(), asked).unwrap();
                let start = kepler_at(eccentricity, 0.0);
                let mut state = State::new(0.0, start.to_vec()).unwrap();
                let report = follow!(&advice, &mut kepler(), &mut state, tau, turns);
                // Relative to the largest position and velocity, as the advice.
                let found = error(&state.values[..2], &start[..2]) / (1.0 + eccentricity);
                assert!(found < 10.0 * asked, "e = {eccentricity}, {turns} turns, {asked:e}: {found:e} by {advice}");
                // Where no measured method reaches the error, nothing is predicted.
                if let Some(predicted) = advice.evaluations {
                    let (found, ratio) = (report.evaluations, report.evaluations as f64 / predicted);
                    assert!((0.3..3.0).contains(&ratio), "e = {eccentricity}: {found} evaluations for {advice}");
                    compared += 1;
                }
            }
        }
    }
    assert!(65 <= compared, "{compared} of 75");
}

#[test]
fn advice_for_several_bodies_holds_for_the_figure_eight() {
    let period = 6.325_913_98;
    let character = Character::of_positions().for_turns(3.0).unwrap();
    let reference = {
        let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
        GaussRadau15::to_rounding().integrate_to(&mut three_bodies(), &mut state, 3.0 * period).unwrap();
        state.values
    };
    for asked in [1e-5, 1e-7, 1e-9, 1e-11] {
        let advice = advise(&character, asked).unwrap();
        let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
        follow!(&advice, &mut three_bodies(), &mut state, period, 3.0);
        let found = error(&state.values, &reference);
        assert!(found < 10.0 * asked, "{asked:e}: {found:e} by {advice}");
    }
}

#[test]
fn the_character_decides() {
    let method = |character: Character| advise(&character, 1e-9).unwrap().method;
    assert_eq!(method(Character::stiff()), AdvisedMethod::RadauIia);
    assert_eq!(method(Character::of_group()), AdvisedMethod::AdaptiveMuntheKaas);
    assert_eq!(method(Character::of_planets(false)), AdvisedMethod::WisdomHolman);
    assert_eq!(method(Character::of_planets(true)), AdvisedMethod::HybridSymplectic);
    assert_eq!(method(Character::of_colliding_bodies()), AdvisedMethod::Regularised);
    // A field in f64 alone is never given to lanes.
    for character in [Character::of_first_order(), Character::of_second_order(), Character::of_positions()] {
        assert_ne!(method(character), AdvisedMethod::GaussLegendre16);
        assert_ne!(method(character.with_uneven_steps()), AdvisedMethod::GaussLegendre16);
    }
    // Beyond what any method reaches, the one that leaves rounding alone.
    let fine = advise(&Character::of_positions().with_uneven_steps(), 1e-18).unwrap();
    assert_eq!((fine.method, fine.tolerance), (AdvisedMethod::GaussRadau15, None));
}

#[test]
fn longer_runs_and_dearer_evaluations_cost_more() {
    let short = Character::of_positions();
    let of = |character: Character| advise(&character, 1e-8).unwrap();
    let (one, other) = (of(short), of(short.for_turns(100.0).unwrap()));
    assert!(10.0 * one.evaluations.unwrap() < other.evaluations.unwrap());
    assert!(other.tolerance < one.tolerance);
    let dear = of(short.with_evaluation_time(1e-3).unwrap());
    assert!(0.5e-3 * dear.evaluations.unwrap() < dear.seconds.unwrap());
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let character = Character::of_positions();
    for asked in [0.0, -1.0, 1.0, 2.0] {
        let advice = advise(&character, asked);
        assert_eq!(advice, Err(IntegratorsError::InvalidTolerance { relative: asked, absolute: 0.0 }));
    }
    let not_finite = advise(&character, f64::NAN);
    assert!(matches!(not_finite, Err(IntegratorsError::NotFinite { quantity: "error", .. })));
    let none = character.for_turns(0.0);
    assert_eq!(none, Err(IntegratorsError::NotPositive { quantity: "turns", value: 0.0 }));
    let backwards = character.with_evaluation_time(-1e-9);
    assert_eq!(backwards, Err(IntegratorsError::NotPositive { quantity: "seconds", value: -1e-9 }));
    assert!(character.for_turns(f64::INFINITY).is_err());
}
