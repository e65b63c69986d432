//! Specimens of viscoelastic solids: jumps, relaxation and creep against closed forms.

use piola_continuum::DisplacementGradient;
use piola_solids::memory::{Prony, PronyTerm, Scaled, Viscoelastic, ViscoelasticState};
use piola_solids::{Hyperelastic, IncompressibleSolid, MooneyRivlin, SaintVenantKirchhoff, SolidsError, isochoric};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{Control, Controls, HomogeneousState, equilibrium, uniaxial};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

/// What relaxes of the stress of fast loading, and its time, s.
const SHARE: f64 = 0.6;
const TIME: f64 = 2.0;

fn relaxing<L: Hyperelastic + Clone>(law: L) -> Viscoelastic<Scaled<L>, L> {
    let series = Prony::new(vec![PronyTerm { weight: SHARE, time: TIME }]).expect("a series");
    Viscoelastic::relaxing(law, series).expect("a share below 1")
}

/// The specimen at the end of a step, which is taken.
fn taken<L: Hyperelastic + Clone>(
    solid: &Viscoelastic<Scaled<L>, L>,
    state: &mut ViscoelasticState,
    duration: f64,
    controls: &Controls,
    start: &DisplacementGradient,
) -> HomogeneousState {
    let step = solid.prony().step(duration).expect("a duration");
    let found = equilibrium(&solid.response(state, &step).expect("its own"), controls, start).expect("a state");
    solid.advance(state, &found.deformation, &step);
    found
}

fn bar_of_force(force: f64) -> Controls {
    Controls::axial([Control::FirstPiola(force), Control::FREE, Control::FREE]).expect("controls")
}

#[test]
fn fast_and_slow_loading_equal_the_law_and_what_remains_of_it() {
    let law = MooneyRivlin::stress_free(0.4, 0.2, 1.5).expect("parameters");
    let solid = relaxing(law);
    let remaining = Scaled::new(law, 1.0 - SHARE).expect("a share");
    let start = DisplacementGradient::zero();
    for force in [1.3, -0.7, 1e-9] {
        let pulled = bar_of_force(force);
        for (duration, expected) in
            [(0.0, equilibrium(&law, &pulled, &start)), (1e300, equilibrium(&remaining, &pulled, &start))]
        {
            let expected = expected.expect("a state").deformation;
            let found = taken(&solid, &mut solid.at_rest(), duration, &pulled, &start);
            assert_eq!(found.steps, 1, "the tangent of the step is consistent");
            let scale = expected.matrix().amax();
            let name = format!("∇u of {force} in {duration} s");
            let tolerance = Tol::stated(1e-14, "both end below 1e-11 of a quadratic iteration");
            assert_close_at_scale(
                &name,
                found.deformation.matrix().as_slice(),
                expected.matrix().as_slice(),
                scale,
                tolerance,
            );
        }
    }
}

#[test]
fn an_incompressible_bar_that_is_held_relaxes_by_the_series() {
    let (mu, stretch) = (0.8, 1.7_f64);
    let solid = relaxing(IncompressibleSolid::new(isochoric::NeoHookean::new(mu).expect("μ")));
    let held = Controls::uniaxial(stretch).expect("controls");
    let mut state = solid.at_rest();
    let mut bar = taken(&solid, &mut state, 0.0, &held, &DisplacementGradient::zero());
    let mut time = 0.0_f64;
    for duration in [0.0, 0.1, 0.4, 1.5, 30.0] {
        bar = taken(&solid, &mut state, duration, &held, &bar.deformation);
        time += duration;
        let remains = 1.0 - SHARE + SHARE * (-time / TIME).exp();
        let force = mu * (stretch - stretch.powi(-2)) * remains;
        let tolerance = Tol::stated(4e-15, "the sides' stretch and the pressure end at rounding");
        assert_close("P", &[bar.first_piola.0[(0, 0)]], &[force], tolerance);
        assert_close_at_scale("sides", &[bar.cauchy.0.components[1]], &[0.0], mu, tolerance);
    }
}

#[test]
fn small_strain_relaxes_with_the_modulus_of_the_series() {
    // λ = 2, μ = 1: E = 8/3.
    let solid = relaxing(SaintVenantKirchhoff::new(2.0, 1.0).expect("constants"));
    let strain = 1e-9;
    let held = Controls::axial([Control::Displacement(strain), Control::FREE, Control::FREE]).expect("controls");
    let mut state = solid.at_rest();
    let mut bar = taken(&solid, &mut state, 0.0, &held, &DisplacementGradient::zero());
    for step in 1..=4_u8 {
        bar = taken(&solid, &mut state, 0.7, &held, &bar.deformation);
        let remains = 1.0 - SHARE + SHARE * (-0.7 * f64::from(step) / TIME).exp();
        let tolerance = Tol::stated(4e-9, "strain squared, of which the law makes four times as much");
        assert_close("P", &[bar.first_piola.0[(0, 0)]], &[8.0 / 3.0 * strain * remains], tolerance);
        assert_close("ν", &[-bar.deformation.matrix()[(1, 1)]], &[strain / 3.0], tolerance);
    }
}

/// `ε(t) = σ/E₀ (1 − g e^(−t/τ_c))/(1 − g)`, `τ_c = τ/(1 − g)`.
#[test]
fn creep_converges_to_the_closed_form_by_the_square_of_the_step() {
    let solid = relaxing(SaintVenantKirchhoff::new(2.0, 1.0).expect("constants"));
    let (strain, end) = (1e-9, 3.0);
    let pulled = bar_of_force(8.0 / 3.0 * strain);
    let exact = strain * (1.0 - SHARE * (-end * (1.0 - SHARE) / TIME).exp()) / (1.0 - SHARE);
    let error = |count: u32| {
        let mut state = solid.at_rest();
        let mut bar = taken(&solid, &mut state, 0.0, &pulled, &DisplacementGradient::zero());
        for _ in 0..count {
            bar = taken(&solid, &mut state, end / f64::from(count), &pulled, &bar.deformation);
        }
        (bar.deformation.matrix()[(0, 0)] - exact) / exact
    };
    for count in [16, 32, 64] {
        let ratio = error(count) / error(2 * count);
        assert!((ratio - 4.0).abs() < 0.05, "{count} steps: {ratio}");
    }
    assert!(error(64).abs() < 1e-4, "{:e}", error(64));
}

#[test]
fn states_and_steps_of_others_and_limits_are_refused() {
    let gent = IncompressibleSolid::new(isochoric::Gent::new(1.0, 2.0).expect("Jₘ"));
    let (solid, none) = (relaxing(gent), Prony::new(Vec::new()).expect("no terms"));
    let other = Viscoelastic::relaxing(gent, none).expect("nothing relaxes");
    let step = solid.prony().step(0.5).expect("a step");
    let foreign = solid.response(&other.at_rest(), &step).map(|_| ());
    assert!(matches!(foreign, Err(SolidsError::OutOfBounds { parameter: "number of overstresses", .. })));
    let (state, foreign) = (solid.at_rest(), other.prony().step(0.5).expect("a step"));
    let foreign = solid.response(&state, &foreign).map(|_| ());
    assert!(matches!(foreign, Err(SolidsError::OutOfBounds { parameter: "number of terms", .. })));
    let response = solid.response(&state, &step).expect("its own");
    assert!(uniaxial(&response, 1.5).is_ok());
    let beyond = uniaxial(&response, 4.0);
    let stopped = matches!(beyond, Err(SpecimensError::NotConverged { share, .. }) if 0.0 < share && share < 1.0);
    assert!(stopped, "{beyond:?}");
}
