//! Radial oscillations: energy, period, phase portrait, existence.

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow;

use piola_integrators::{Crossing, DormandPrince853, Event, EventAction, State, Tolerance};
use piola_solids::isochoric::{Gent, Isochoric, MooneyRivlin, NeoHookean};
use piola_solutions::dynamics::{RadialOscillation, RadialState};
use piola_solutions::families::Orientation;
use piola_solutions::loads::{Ends, Shell, SphereInflation, Tube, TubeInflation};
use piola_solutions::{LoadCurve, SolutionsError};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::fixtures::integral;

/// The energy of a tube, J/m of present length, by the test's own integral.
fn energy_of_tube(law: &impl Isochoric, outer: f64, stretch: f64) -> f64 {
    let stored = |s: f64| {
        let hoop = ((s * s + stretch * stretch - 1.0) / (s * s)).sqrt();
        let first = hoop * hoop + 1.0 / (hoop * hoop) - 2.0;
        law.energy(first, first) * s
    };
    TAU * integral(1.0, outer, stored)
}

#[test]
fn radial_oscillation_keeps_its_energy_and_its_period_is_that_of_the_quadrature() {
    let law = MooneyRivlin::new(0.4, 0.1).expect("law");
    let outer = 1.5;
    let body = TubeInflation { tube: Tube::new(1.0, outer).expect("tube"), law: &law, ends: Ends::Stretch(1.0) };
    for (stretch, rate, pressure) in [(1.5, 0.0, 0.0), (1.0, 0.6, 0.1), (0.6, 0.0, 0.0), (1.0, 0.0, 0.2)] {
        let mut motion = RadialOscillation { body, density: 1.3, pressure };
        let start = RadialState { stretch, rate };
        let orbit = motion.orbit(start, (0.01, 50.0)).expect("orbit");
        let energy = |stretch: f64, rate: f64| {
            let inertia = TAU * 1.3 * stretch * stretch * 0.5 * ((outer * outer - 1.0) / (stretch * stretch)).ln_1p();
            0.5 * inertia * rate * rate + energy_of_tube(&law, outer, stretch) - pressure * PI * stretch * stretch
        };
        let before = energy(stretch, rate);
        let mut state = State::new(0.0, vec![stretch, rate]).expect("state");
        let mut method = DormandPrince853::new(Tolerance::relative(1e-13).expect("tolerance"));
        method.integrate_to(&mut motion, &mut state, orbit.period).expect("run");
        let (end, speed) = (state.values[0], state.values[1]);
        let scale = before.abs() + energy_of_tube(&law, outer, orbit.turning_points[1]);
        assert_close_at_scale(
            "energy",
            &[energy(end, speed)],
            &[before],
            scale,
            Tol::stated(1e-11, "some hundred steps at 1e-13"),
        );
        // After one period of the quadrature the motion is back: δt = δλ/λ̇ or δλ̇/λ̈.
        let acceleration = motion.acceleration(start).expect("acceleration");
        let tol = Tol::stated(1e-10, "the bound of the specification");
        assert_close_at_scale("λ", &[end], &[stretch], 1.0, tol);
        assert_close_at_scale("λ̇", &[speed], &[rate], orbit.period * acceleration.abs(), tol);
    }
}

#[test]
fn kinetic_energy_equals_the_integral_over_the_wall() {
    let law = NeoHookean::new(1.0).expect("law");
    let (inner, outer, axial, density) = (0.5_f64, 0.8_f64, 1.25, 2.5);
    let state = RadialState { stretch: 1.6, rate: 0.7 };
    // r and ṙ of the inner face.
    let (r, speed) = (inner * state.stretch, inner * state.rate);
    // Every cylinder and every sphere keeps its flux: s ṡ = r ṙ and s² ṡ = r² ṙ.
    let tube = TubeInflation { tube: Tube::new(inner, outer).expect("tube"), law: &law, ends: Ends::Stretch(axial) };
    let wall = (r * r + (outer * outer - inner * inner) / axial).sqrt();
    let of_tube = integral(r, wall, |s: f64| 0.5 * density * (r * speed / s).powi(2) * TAU * s);
    let shell = Shell::new(inner, outer).expect("shell");
    let shell = SphereInflation { shell, law: &law, orientation: Orientation::Kept };
    let wall = (r.powi(3) + outer.powi(3) - inner.powi(3)).cbrt();
    let of_shell = integral(r, wall, |s: f64| 0.5 * density * (r * r * speed / (s * s)).powi(2) * 2.0 * TAU * s * s);
    let found = [
        RadialOscillation { body: tube, density, pressure: 0.0 }.kinetic_energy(state).expect("tube"),
        RadialOscillation { body: shell, density, pressure: 0.0 }.kinetic_energy(state).expect("shell"),
    ];
    assert_close("½ ∫ ρ v² dV", &found, &[of_tube, of_shell], Tol::ulps(64.0));
}

#[test]
fn period_between_events_equals_the_quadrature() {
    let law = Gent::new(1.0, 20.0).expect("law");
    let shell = Shell::new(1.0, 1.4).expect("shell");
    let body = SphereInflation { shell, law: &law, orientation: Orientation::Kept };
    let mut motion = RadialOscillation { body, density: 2.0, pressure: 0.1 };
    let start = RadialState { stretch: 1.0, rate: 0.0 };
    let orbit = motion.orbit(start, (0.01, 10.0)).expect("orbit");
    let mut state = State::new(0.0, vec![1.0, 0.0]).expect("state");
    let mut times = Vec::new();
    // λ̇ falls through zero at the largest stretch.
    let event = Event::new(Crossing::Falling, EventAction::Report, |_t, y| y[1]);
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).expect("tolerance"));
    method
        .integrate_with_events(
            &mut motion,
            &mut state,
            3.2 * orbit.period,
            &mut [event],
            |occurrence| {
                times.push(occurrence.time);
                ControlFlow::Continue(())
            },
            |_step| ControlFlow::Continue(()),
        )
        .expect("run");
    assert_eq!(times.len(), 3, "{times:?}");
    let tol = Tol::stated(1e-10, "the bound of the specification");
    assert_close("period", &[times[1] - times[0], times[2] - times[1]], &[orbit.period; 2], tol);
}

#[test]
fn small_oscillation_of_a_thin_shell_has_the_period_of_its_membrane() {
    let law = NeoHookean::new(1.0).expect("law");
    let thickness = 1e-4;
    let shell = Shell::new(1.0, 1.0 + thickness).expect("shell");
    let body = SphereInflation { shell, law: &law, orientation: Orientation::Kept };
    let free = RadialOscillation { body, density: 1.0, pressure: 0.0 };
    let rest = free.equilibria((0.5, 1.5)).expect("equilibria");
    assert_eq!(rest.len(), 1);
    // ρ h ẍ = −12 μ h x/R²: ω² = 12 μ/(ρ R²).
    let period = TAU / 12.0_f64.sqrt();
    assert_close(
        "period",
        &[rest[0].small_period.expect("stable")],
        &[period],
        Tol::stated(4.0 * thickness, "thickness"),
    );
    let orbit = free.orbit(RadialState { stretch: 1.0 + 1e-6, rate: 0.0 }, (0.5, 1.5)).expect("orbit");
    assert_close(
        "small orbit",
        &[orbit.period],
        &[rest[0].small_period.expect("stable")],
        Tol::stated(1e-6, "amplitude"),
    );
}

#[test]
fn sudden_pressure_beyond_the_limit_lets_no_motion_return() {
    let law = NeoHookean::new(1.0).expect("law");
    let body =
        SphereInflation { shell: Shell::new(1.0, 1.2).expect("shell"), law: &law, orientation: Orientation::Kept };
    let with = |pressure: f64| RadialOscillation { body, density: 1.0, pressure };
    let limit = with(0.0).limit_of_sudden_pressure((1.0, 20.0)).expect("search").expect("a maximum");
    let slow = body.limit_points((1.0, 20.0)).expect("limits")[0];
    assert!(limit.load < slow.load, "suddenly less than slowly");
    let start = RadialState { stretch: 1.0, rate: 0.0 };
    assert!(with(0.999 * limit.load).orbit(start, (0.1, 40.0)).is_ok());
    let gone = with(1.001 * limit.load).orbit(start, (0.1, 40.0));
    assert!(matches!(gone, Err(SolutionsError::NotPeriodic { .. })), "{gone:?}");
    // Under a pressure below the limit of slow inflation there is a centre and a saddle.
    let rest = with(0.9 * limit.load).equilibria((1.0, 30.0)).expect("equilibria");
    assert_eq!(rest.iter().map(|rest| rest.small_period.is_some()).collect::<Vec<_>>(), [true, false]);
    // A tube of this rubber always returns from outside.
    let tube = TubeInflation { tube: Tube::new(1.0, 1.2).expect("tube"), law: &law, ends: Ends::Stretch(1.0) };
    let tube = RadialOscillation { body: tube, density: 1.0, pressure: 0.0 };
    assert!(tube.limit_of_sudden_pressure((1.0, 20.0)).expect("search").is_none());
}

#[test]
fn phase_portrait_is_symmetric_and_its_rates_are_those_of_the_motion() {
    let law = NeoHookean::new(1.0).expect("law");
    let body =
        SphereInflation { shell: Shell::new(1.0, 1.3).expect("shell"), law: &law, orientation: Orientation::Kept };
    let mut motion = RadialOscillation { body, density: 1.0, pressure: 0.0 };
    let start = RadialState { stretch: 1.0, rate: 0.5 };
    let orbit = motion.orbit(start, (0.1, 10.0)).expect("orbit");
    let mut method = DormandPrince853::new(Tolerance::relative(1e-12).expect("tolerance"));
    let mut state = State::new(0.0, vec![1.0, 0.5]).expect("state");
    for share in [0.1, 0.3, 0.6] {
        method.integrate_to(&mut motion, &mut state, share * orbit.period).expect("run");
        let rate = motion.rate_at(start, state.values[0]).expect("rate").expect("on the orbit");
        assert_close_at_scale("λ̇", &[rate], &[state.values[1].abs()], 0.5, Tol::stated(1e-9, "integrated at 1e-12"));
    }
    assert_eq!(motion.rate_at(start, 1.01 * orbit.turning_points[1]).expect("rate"), None);
}
