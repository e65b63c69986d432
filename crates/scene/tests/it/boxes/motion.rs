//! Motions of modes beside closed forms.

use core::f64::consts::PI;

use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::{history, in_box, in_rectangle, run};
use crate::support::{assert_small, replaced};

/// ω² = (λ + 2μ) π²/ρ of the mode (1, 0): λ + 2μ = 4, ρ = 2.
const BAR: &str = r#"
[box]
type = "motion"
sides = [1.0, 1.0]
modes = [3, 2]
first_lame_parameter = 2.0
shear_modulus = 1.0
density = 2.0
duration = 2.0
interval = 0.03

[[start]]
type = "mode"
indices = [1, 0]
displacement = [0.01, 0.0]

[[probe]]
name = "middle"
at = [0.5, 0.2]
"#;

fn frequency() -> f64 {
    (4.0 * PI * PI / 2.0_f64).sqrt()
}

/// Times and displacements along x of the only probe.
fn moved(text: &str) -> (Vec<f64>, Vec<f64>) {
    let run = run(text);
    history(in_rectangle(&run)).instants.iter().map(|at| (at.time, at.displacements[0][0])).unzip()
}

#[test]
fn mode_oscillates_with_the_frequency_of_its_eigenvalue() {
    let (times, found) = moved(BAR);
    assert_eq!(times.len(), 68);
    assert_eq!((times[1], times.last().copied()), (0.03, Some(2.0)));
    let expected: Vec<f64> = times.iter().map(|t| 0.01 * (frequency() * t).cos()).collect();
    assert_close("u", &found, &expected, Tol::ulps_because(512.0, "the phase of 68 steps"));
}

#[test]
fn shear_mode_that_starts_with_a_velocity_has_the_second_eigenvalue() {
    let text = replaced(BAR, "indices = [1, 0]\ndisplacement = [0.01, 0.0]", "indices = [0, 2]\nvelocity = [0.3, 0.0]");
    // No sine along y, but one along x of the index 0: this component vanishes. Guided walls have cos x sin y.
    let text = replaced(&text, "type = \"motion\"", "type = \"motion\"\nwalls = \"guided\"");
    let (times, found) = moved(&text);
    let omega = (PI * PI * 4.0 / 2.0_f64).sqrt();
    let expected: Vec<f64> = times.iter().map(|t| 0.3 / omega * (omega * t).sin() * (0.4 * PI).sin()).collect();
    assert_close("u", &found, &expected, Tol::ulps_because(512.0, "the phase of 68 steps"));
}

#[test]
fn drag_damps_as_the_closed_form_says() {
    let (times, found) = moved(&replaced(BAR, "density = 2.0", "density = 2.0\ndrag = 3.0"));
    let gamma = 3.0 / (2.0 * 2.0);
    let omega = (frequency().powi(2) - gamma * gamma).sqrt();
    let at = |t: &f64| 0.01 * (-gamma * t).exp() * ((omega * t).cos() + gamma / omega * (omega * t).sin());
    let expected: Vec<f64> = times.iter().map(at).collect();
    assert_close("u", &found, &expected, Tol::ulps_because(512.0, "the phase of 68 steps"));
}

#[test]
fn ramp_that_ends_leaves_a_free_oscillation() {
    let start = "[[start]]\ntype = \"mode\"\nindices = [1, 0]\ndisplacement = [0.01, 0.0]";
    let load = "[[load]]\ntype = \"mode\"\nindices = [1, 0]\nforce_per_volume = [5.0, 0.0]\nfrom = 0.2\nuntil = 1.0\ncourse = [0.5, 1.0]";
    let (times, found) = moved(&replaced(BAR, start, load));
    // k u + ρ ü = 5 (½ + s/0.8), s = t − 0.2: a particular solution and what makes it begin at rest.
    let (omega, k, slope) = (frequency(), 4.0 * PI * PI, 5.0 / 0.8);
    let ramp = |s: f64| {
        let (sine, cosine) = (omega * s).sin_cos();
        [2.5 * (1.0 - cosine) + slope * (s - sine / omega), 2.5 * omega * sine + slope * (1.0 - cosine)].map(|x| x / k)
    };
    let [u, v] = ramp(0.8);
    let at = |t: &f64| match t - 0.2 {
        s if s <= 0.0 => 0.0,
        s if s <= 0.8 => ramp(s)[0],
        s => u * (omega * (s - 0.8)).cos() + v / omega * (omega * (s - 0.8)).sin(),
    };
    let expected: Vec<f64> = times.iter().map(at).collect();
    assert_close_at_scale(
        "u",
        &found,
        &expected,
        u.abs().max(v.abs() / omega),
        Tol::ulps_because(2048.0, "the phase of 70 steps"),
    );
}

#[test]
fn energy_without_drag_and_loads_is_constant() {
    let text = r#"
[box]
type = "motion"
sides = "[30, 20, 10] mm"
modes = [6, 5, 4]
young_modulus = "1 MPa"
poisson_ratio = 0.3
density = "1000 kg/m^3"
duration = "20 ms"

[[start]]
type = "gaussian"
at = "[10, 12, 5] mm"
radius = "6 mm"
displacement = "[0.1, 0.2, -0.1] mm"
"#;
    let run = run(text);
    let found = history(in_box(&run));
    assert_eq!(found.instants.len(), 201);
    let Some(drift) = found.energy_drift() else { panic!("no drift") };
    assert_small("drift", drift, Tol::ulps_because(512.0, "200 exact steps of a few ulp each"));
    // Energy moves between its two parts.
    assert!(found.instants.iter().any(|at| 0.2 * at.energy() < at.kinetic_energy));
    let damped = super::run(&replaced(text, "duration", "drag = 1000.0\nduration"));
    assert_eq!(history(in_box(&damped)).energy_drift(), None);
}
