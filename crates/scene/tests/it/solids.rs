//! Studies of solids beside closed forms, and their mistakes.

use core::f64::consts::PI;
use std::ops::ControlFlow;

use piola_scene::run::Outcome;
use piola_scene::studies::balloon::BalloonCurve;
use piola_scene::studies::bending::BendingCurve;
use piola_scene::studies::dislocation::BurgersCircuits;
use piola_scene::studies::laminated_tube::TubeStresses;
use piola_scene::studies::torsion::RodCurves;
use piola_scene::studies::{self, Findings, SolidFindings, SolidStudy, StudyPlan, StudyRun, Subject};
use piola_testkit::{Tol, assert_close};

use crate::support::{assert_mistake, assert_small, replaced, study};

const NEO: &str = "[law]\ntype = \"neo-hookean\"\nshear_modulus = \"2 Pa\"\n";
const MOONEY: &str = "[law]\ntype = \"mooney-rivlin\"\nc10 = 0.75\nc01 = 0.25\n";

const BALLOON: &str = "[balloon]\ninner_radius = \"1 m\"\nouter_radius = \"1.0001 m\"\nstretch = [1.0, 8.0]\n";
const ROD: &str = "[torsion]\nouter_radius = 1.5\ntwist = \"0.4 rad/m\"\n";
const BLOCK: &str = "[bending]\nthickness = 0.5\nlength = 2.0\nheight = 3.0\nangle = \"90 deg\"\n";
const SCREWS: &str = "[dislocation]\ntype = \"uniform\"\ndensity = \"0.5 1/m\"\nradii = [0.5, 2.0]\n";
const TUBE: &str = "[laminated_tube]\ninner_radius = 1.0\ninner_pressure = 0.3\n";
const LAYERS: &str = "[[layer]]\nthickness = 0.4\nhoop_growth = 1.1\n[[layer]]\nthickness = 0.6\n";

fn run(text: &str) -> StudyRun {
    let run = studies::run(&study(text), |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn solid(run: StudyRun) -> SolidFindings {
    match run.findings {
        Findings::Solid(found) => found,
        other => panic!("{other:?}"),
    }
}

fn balloon(text: &str) -> BalloonCurve {
    match solid(run(text)) {
        SolidFindings::Balloon(found) => found,
        other => panic!("{other:?}"),
    }
}

fn rod(text: &str) -> RodCurves {
    match solid(run(text)) {
        SolidFindings::Torsion(found) => found,
        other => panic!("{other:?}"),
    }
}

fn block(text: &str) -> BendingCurve {
    match solid(run(text)) {
        SolidFindings::Bending(found) => found,
        other => panic!("{other:?}"),
    }
}

fn screws(text: &str) -> BurgersCircuits {
    match solid(run(text)) {
        SolidFindings::Dislocation(found) => found,
        other => panic!("{other:?}"),
    }
}

fn tube(text: &str) -> TubeStresses {
    match solid(run(text)) {
        SolidFindings::LaminatedTube(found) => found,
        other => panic!("{other:?}"),
    }
}

#[test]
fn pressure_of_a_thin_balloon_is_that_of_the_membrane() {
    let found = balloon(&format!("{BALLOON}{NEO}"));
    let membrane = |stretch: f64| 2.0 * 2.0 * 1e-4 * (stretch.recip() - stretch.powi(-7));
    let tolerance = Tol::stated(4e-4, "terms of the thickness over the radius, 1e-4");
    for point in found.curve.iter().filter(|point| 1.05 < point.parameter) {
        assert_close("pressure", &[point.load], &[membrane(point.parameter)], tolerance);
    }
    let limit = 7.0_f64.powf(1.0 / 6.0);
    assert_eq!(found.limits.len(), 1);
    assert_close("limit", &[found.limits[0].parameter, found.limits[0].load], &[limit, membrane(limit)], tolerance);
    // Without a pressure the states are the limit points.
    assert_eq!(found.states, found.limits);
}

#[test]
fn pressure_of_a_wall_without_thickness_is_that_of_the_membrane() {
    let text = replaced(BALLOON, "1.0001 m", "1.25 m");
    let Subject::Solid(SolidStudy::Balloon(neo)) = study(&format!("{text}{NEO}")).subject else { panic!("a balloon") };
    let Subject::Solid(SolidStudy::Balloon(mooney)) = study(&format!("{text}{MOONEY}")).subject else {
        panic!("a balloon")
    };
    for stretch in [0.8_f64, 1.0, 1.5, 4.0] {
        // p = 2 (t/r) (λ⁻¹ − λ⁻⁷) (2 C₁₀ + 2 C₀₁ λ²) with t/r = 1/4.
        let shape = 0.5 * (stretch.recip() - stretch.powi(-7));
        let by_hand = [2.0 * shape, (1.5 + 0.5 * stretch * stretch) * shape];
        let found = [neo.thin_wall_pressure(stretch), mooney.thin_wall_pressure(stretch)];
        assert_close("pressure", &found, &by_hand, Tol::ulps(32.0));
    }
}

#[test]
fn three_balloons_carry_one_pressure_and_the_middle_one_is_unstable() {
    let law = "[law]\ntype = \"mooney-rivlin\"\nc10 = \"0.5 MPa\"\nc01 = \"0.03 MPa\"\n";
    let shell = "[balloon]\ninner_radius = \"50 mm\"\nouter_radius = \"50.5 mm\"\nstretch = [1.0, 12.0]\n";
    let found = balloon(&format!("{shell}pressure = \"11 kPa\"\n{law}"));
    assert_eq!((found.limits.len(), found.states.len(), found.stresses.len()), (2, 3, 3));
    let slopes: Vec<bool> = found.states.iter().map(|state| 0.0 < state.slope).collect();
    assert_eq!(slopes, [true, false, true]);
    for (state, stresses) in found.states.iter().zip(&found.stresses) {
        let tolerance = Tol::stated(1e-9, "1e-13 of the hoop stress, 1e4 times the pressure");
        assert_close("pressure", &[state.load], &[11e3], tolerance);
        let faces = [stresses[0].stress[0], stresses[stresses.len() - 1].stress[0]];
        assert_close("faces", &[faces[0] / -11e3, faces[1]], &[1.0, 0.0], tolerance);
    }
}

#[test]
fn torque_and_thrust_of_a_mooney_rod_are_rivlins() {
    let found = rod(&format!("{ROD}{MOONEY}"));
    let (c10, c01, radius) = (0.75, 0.25, 1.5_f64);
    for state in &found.states[1..] {
        let twist = state.held.twist;
        // M = (π/2) 2 (C₁₀ + C₀₁) ψ a⁴ and N = −(π/2) (C₁₀ + 2 C₀₁) ψ² a⁴.
        let torque = 0.5 * PI * 2.0 * (c10 + c01) * twist * radius.powi(4);
        let force = -0.5 * PI * (c10 + 2.0 * c01) * twist * twist * radius.powi(4);
        let tolerance = Tol::stated(1e-12, "of the quadrature, 1e-13 of the moduli");
        assert_close("loads", &[state.held.torque, state.held.axial_force], &[torque, force], tolerance);
        // Second order: λ − 1 = (C₁₀ + 2 C₀₁) ψ² a²/(12 (C₁₀ + C₀₁)), and terms of ψ⁴.
        let square = (twist * radius).powi(2);
        let elongation = (c10 + 2.0 * c01) / (12.0 * (c10 + c01)) * square;
        let found = (state.pulled.axial_stretch - 1.0 - elongation).abs();
        assert!(found <= square * square, "{found:e} at {twist}");
    }
}

#[test]
fn faces_of_a_twisted_tube_are_free_and_its_states_carry_the_torque() {
    let text = replaced(ROD, "twist", "inner_radius = 0.5\naxial_force = \"3 N\"\ntorque = \"1.5 N m\"\ntwist");
    let found = rod(&format!("{text}{MOONEY}"));
    let tolerance = Tol::stated(1e-10, "residual of Newton's iteration");
    assert_eq!(found.under_torque.len(), 1);
    assert_close("torque", &[found.under_torque[0].load], &[1.5], tolerance);
    for state in &found.states {
        assert_close("force", &[state.pulled.axial_force], &[3.0], tolerance);
    }
    let stresses = &found.stresses[0].1;
    assert_small("inner face", stresses[0].stress[0], tolerance);
    assert_small("outer face", stresses[stresses.len() - 1].stress[0], tolerance);
}

#[test]
fn moment_of_a_neo_hookean_block_is_its_closed_form() {
    let found = block(&format!("{BLOCK}{NEO}"));
    let (mu, thickness, length, height) = (2.0, 0.5, 2.0, 3.0);
    for (angle, state) in found.angles.iter().zip(&found.states) {
        // λ_θ = k r, T_rr = W(k r) − W(k r₁), W = ½ μ (λ² + λ⁻² − 2); M/h = ½ W₁ (r₂² − r₁²) − ∫ W r dr.
        let k = angle / length;
        let half = thickness / k;
        let outer = (half + (half * half + k.powi(-4)).sqrt()).sqrt();
        let inner = (k * k * outer).recip();
        let energy = |r: f64| 0.5 * mu * ((k * r).powi(2) + (k * r).powi(-2) - 2.0);
        let integral = 0.5
            * mu
            * (0.25 * k * k * (outer.powi(4) - inner.powi(4)) + (outer / inner).ln() / (k * k)
                - (outer * outer - inner * inner));
        let by_hand = height * (0.5 * energy(inner) * (outer * outer - inner * inner) - integral);
        // Forces without resultant about a distant axis: (L/(α t))² of a rounding error, here and there.
        let tolerance = Tol::stated(1e-10, "64 ulp of terms (4/α)⁴ times the moment, at the largest angles less");
        let radii = Tol::stated(1e-12, "the root of a difference of radii");
        if 0.1 < *angle {
            assert_close("radii", &state.radii, &[inner, outer], radii);
            assert_close("moment", &[state.moment], &[by_hand], tolerance);
        }
    }
    // ⅓ μ h t³ α/L where strains are small.
    let small = mu / 3.0 * height * f64::powi(thickness, 3) * found.angles[0] / length;
    assert_close("small", &[found.states[0].moment], &[small], Tol::stated(1e-3, "squares of the strain"));
    let stresses = &found.stresses[0];
    let tolerance = Tol::stated(1e-12, "1e-13 of the hoop stress");
    assert_small("inner face", stresses[0].stress[0], tolerance);
    assert_small("outer face", stresses[stresses.len() - 1].stress[0], tolerance);
}

#[test]
fn moment_of_a_state_is_the_one_that_is_asked_for() {
    let free = block(&format!("{BLOCK}{NEO}"));
    let half = free.states[49].moment;
    let found = block(&format!("{BLOCK}moment = {half:?}\n{NEO}"));
    let tolerance = Tol::stated(1e-9, "the moment's rounding over its slope");
    assert_close("angle", &[found.shown[0]], &[free.angles[49]], tolerance);
}

#[test]
fn burgers_vector_of_even_screws_is_density_times_area() {
    for centre in ["[0.0, 0.0]", "[1.5, -2.0]"] {
        let found = screws(&format!("{SCREWS}centre = {centre}\n"));
        let tolerance = Tol::stated(1e-12, "tolerance of the quadrature");
        for (circuit, radius) in found.circuits.iter().zip([0.5, 2.0]) {
            let by_hand = [0.0, 0.0, 0.5 * PI * radius * radius];
            assert_close("b", &circuit.burgers, &by_hand, tolerance);
            assert_eq!(circuit.closed_form, Some(by_hand[2]));
        }
        let gap = found.in_crystal[found.in_crystal.len() - 1];
        assert_close(
            "development",
            &gap,
            &[0.0, 0.0, 2.0 * PI],
            Tol::stated(1e-9, "tolerance of the transport, 96 arcs"),
        );
        assert_small("holonomy", found.holonomy, Tol::stated(1e-9, "tolerance of the transport, 96 arcs"));
        for at in &found.torsion {
            // α₃₃ = ½ everywhere, and no edges; the torsion of a crystal is minus its density.
            assert_close("density", &[at.screw, at.edge], &[0.5, 0.0], Tol::ulps(64.0));
            assert!(0.5 <= at.torsion * (1.0 + 1e-12));
        }
        assert!(found.of_crystal.is_some_and(|report| !report.is_flat()));
    }
    let none = screws(&replaced(SCREWS, "0.5 1/m", "0 1/m"));
    assert!(none.of_crystal.is_some_and(|report| report.is_flat()));
    assert!(none.of_isotropic_solid.is_some_and(|report| report.is_flat()));
}

#[test]
fn burgers_vector_of_a_core_grows_to_that_of_all_its_screws() {
    let text = replaced(SCREWS, "\"uniform\"\ndensity = \"0.5 1/m\"", "\"core\"\nburgers = 0.3\ncore_radius = 0.5");
    let found = screws(&text);
    // Half of them within the radius of the core.
    let by_hand = [0.15, 0.3 * 4.0 / 4.25];
    let tolerance = Tol::stated(1e-12, "tolerance of the quadrature");
    assert_close("b", &[found.circuits[0].burgers[2], found.circuits[1].burgers[2]], &by_hand, tolerance);
    assert_close("axis", &[found.torsion[0].screw], &[0.3 / (PI * 0.25)], Tol::ulps(64.0));
    // Apart from the axis a crystal without a closed form has none.
    let aside = screws(&format!("{text}centre = [1.0, 0.0]\n"));
    assert!(aside.circuits.iter().all(|circuit| circuit.closed_form.is_none()));
}

#[test]
fn pressure_of_a_homogeneous_tube_is_its_closed_form() {
    let found = tube(&format!("{TUBE}{NEO}{LAYERS}"));
    let Some(state) = &found.homogeneous else { panic!("no state") };
    let [inner, outer] = [state.radii[0] / 1.0, state.radii[1] / 2.0];
    let pressure = 2.0 * ((inner / outer).ln() + 0.5 * (outer.powi(-2) - inner.powi(-2)));
    let tolerance = Tol::stated(1e-10, "residual of the search");
    assert_close("pressure", &[pressure, state.axial_stretch], &[0.3, 1.0], tolerance);
    let faces = [state.stresses[0].stress[0], state.stresses[state.stresses.len() - 1].stress[0]];
    assert_close("faces", &faces, &[-0.3, 0.0], Tol::stated(1e-8, "the last particle is 1e-9 of a layer inside"));
}

#[test]
fn axial_force_of_a_homogeneous_tube_is_its_closed_form() {
    let found = tube(&format!("{TUBE}{NEO}{LAYERS}"));
    let Some(state) = &found.homogeneous else { panic!("no state") };
    let ([inner, outer], [first, last]) = (state.radii, [1.0_f64, 2.0]);
    // r² − R² = c and T_zz − T_rr = μ (1 − R²/r²): N/π = p r_i² + μ c ln(r_o R_i/(r_i R_o)).
    let square = inner * inner - first * first;
    let by_hand = PI * (0.3 * inner * inner + 2.0 * square * (outer * first / (inner * last)).ln());
    assert_close("force", &[state.axial_force], &[by_hand], Tol::stated(1e-9, "residual of the search"));
}

#[test]
fn residual_stress_has_no_resultants() {
    let found = tube(&format!("{TUBE}{NEO}{LAYERS}"));
    let Some(rest) = &found.at_rest else { panic!("no state") };
    let tolerance = Tol::stated(1e-8, "residual of Newton's iteration, and particles 1e-9 of a layer inside");
    let last = rest.stresses.len() - 1;
    assert_close("faces", &[rest.stresses[0].stress[0], rest.stresses[last].stress[0]], &[0.0; 2], tolerance);
    assert_small("axial force", rest.axial_force, tolerance);
    // ∫ T_θθ dr = 0 by the trapezoidal rule.
    let hoop: f64 = rest
        .stresses
        .windows(2)
        .map(|pair| 0.5 * (pair[0].stress[1] + pair[1].stress[1]) * (pair[1].radius - pair[0].radius))
        .sum();
    assert_small("hoop force", hoop, Tol::stated(1e-4, "the square of a step of the rule, 1/48 of the wall"));
    let [least, largest] = rest.hoop_stresses();
    assert!(least < -0.05 && 0.05 < largest, "{least} {largest}");
}

#[test]
fn growth_that_is_everywhere_the_same_leaves_no_stress() {
    let growth = "hoop_growth = 1.1\naxial_growth = 1.1\nradial_growth = 1.1\n";
    let text = format!("{TUBE}{NEO}[[layer]]\nthickness = 0.4\n{growth}[[layer]]\nthickness = 0.6\n{growth}");
    let found = tube(&text);
    let (Some(rest), Some(loaded), Some(other)) = (&found.at_rest, &found.loaded, &found.homogeneous) else {
        panic!("no states")
    };
    let tolerance = Tol::stated(1e-8, "residual of Newton's iteration");
    assert_close("size", &[rest.radii[0], rest.radii[1], rest.axial_stretch], &[1.1, 2.2, 1.1], tolerance);
    assert!(rest.stresses.iter().flat_map(|at| at.stress).all(|t| t.abs() < 1e-8));
    // The same tube, larger: the same stresses under the same pressure.
    for (grown, plain) in loaded.stresses.iter().zip(&other.stresses) {
        assert_close("stress", &grown.stress, &plain.stress, tolerance);
    }
}

#[test]
fn studies_of_solids_write_what_they_plan() {
    for text in [
        format!("{BALLOON}{NEO}"),
        format!("{ROD}{MOONEY}"),
        format!("{BLOCK}{NEO}"),
        SCREWS.to_string(),
        format!("{TUBE}{NEO}{LAYERS}"),
    ] {
        let study = study(&text);
        let plan = StudyPlan::of(&study);
        let folder = std::env::temp_dir().join(format!("piola-solids-{}-{}", plan.files[1], std::process::id()));
        let prepared = match piola_scene::output::Folder::prepare(&folder) {
            Ok(prepared) => prepared,
            Err(error) => panic!("{error}"),
        };
        let run = studies::run(&study, |_| ControlFlow::Continue(()));
        let written = run.write(&prepared, &study, &plan);
        assert!(written.failures.is_empty() && written.files.len() == plan.files.len(), "{written:?}");
        for file in &written.files {
            let text = std::fs::read_to_string(file).unwrap_or_default();
            assert!(text.len() > 100 && !text.contains("could not be drawn"), "{}", file.display());
            let is_number = |word: &str| !matches!(word, "NaN" | "inf" | "-inf");
            assert!(text.split([',', ' ', '\n']).all(is_number), "{}", file.display());
        }
        assert!(run.summary(&plan).contains("\"status\": \"completed\""));
        let _ = std::fs::remove_dir_all(&folder);
        // Stopped at once, it keeps what it has.
        let stopped = studies::run(&study, |_| ControlFlow::Break(()));
        assert_eq!(stopped.outcome, Outcome::Interrupted);
    }
}

#[test]
fn mistakes_of_laws_are_shown_at_their_places() {
    assert_mistake(BALLOON, "[balloon]", &["[balloon] without a law", "[law]"]);
    let text = format!("{BALLOON}{NEO}").replace("neo-hookean", "neohookean");
    assert_mistake(&text, "\"neohookean\"", &["did you mean `neo-hookean`?"]);
    let text = format!("{BALLOON}{NEO}").replace("2 Pa", "-2 Pa");
    assert_mistake(&text, "\"-2 Pa\"", &["negative", "greater than zero", "Pa"]);
    let text = format!("{BALLOON}{NEO}").replace("2 Pa", "2 m");
    assert_mistake(&text, "\"2 m\"", &["the dimension length"]);
    let text = format!("{BALLOON}{MOONEY}").replace("0.25", "-0.75");
    assert_mistake(&text, "0.75", &["Mooney", "0 < C10 + C01"]);
    let text = format!("{BALLOON}{MOONEY}limit = 3.0\n");
    assert_mistake(&text, "limit", &["`limit` is no key of a mooney-rivlin law", "`limit` is of type gent"]);
    let text = format!("{SCREWS}{NEO}");
    assert_mistake(&text, "[law]", &["[law] in a scene of [dislocation]", "no such table"]);
    let text = format!("{TUBE}{NEO}");
    assert_mistake(&text, "[laminated_tube]", &["[laminated_tube] without a layer"]);
    let text = format!("{ROD}{NEO}[[layer]]\nthickness = 1.0\n");
    assert_mistake(&text, "[[layer]]", &["[[layer]] in a scene of [torsion]", "[law]"]);
}

#[test]
fn loads_and_shapes_that_no_state_has_are_refused_with_the_limit() {
    let thin = format!("{BALLOON}pressure = \"1 Pa\"\n{NEO}");
    // 2 · 2 Pa · 1e-4 (λ⁻¹ − λ⁻⁷) at λ = 7^(1/6): 2.48e-4 Pa.
    let words = ["no state carries the pressure", "beyond the limit point 2.47", "at most 2.47", "stretch"];
    assert_mistake(&thin, "\"1 Pa\"", &words);
    let reversed = replaced(BALLOON, "1.0001 m", "0.9 m");
    let words = ["the outer radius 0.9 m is not above the inner radius 1 m", "more than 1 m", "the inner radius"];
    assert_mistake(&format!("{reversed}{NEO}"), "\"0.9 m\"", &words);
    let text = replaced(BALLOON, "[1.0, 8.0]", "[2.0, 1.0]");
    assert_mistake(&format!("{text}{NEO}"), "[2.0, 1.0]", &["two increasing numbers"]);
    let gent = "[law]\ntype = \"gent\"\nshear_modulus = 1.0\nlimit = 30.0\n";
    // 2 λ² + λ⁻⁴ − 3 = 30 at λ = √(33/2 − λ⁻⁴/2) = 4.0618.
    assert_mistake(&format!("{BALLOON}{gent}"), "[1.0, 8.0]", &["Gent", "stretches below 4.0617"]);
    let text = format!("{ROD}torque = \"100 N m\"\n{NEO}");
    assert_mistake(
        &text,
        "\"100 N m\"",
        &["no state carries the torque", "is not reached", "another range of the twist"],
    );
    let text = replaced(&format!("{ROD}{gent}"), "0.4 rad/m", "40 rad/m");
    assert_mistake(&text, "\"40 rad/m\"", &["Gent", "a twist below 3.6"]);
    let text = format!("{BLOCK}moment = \"100 N m\"\n{NEO}");
    assert_mistake(&text, "\"100 N m\"", &["no state carries the moment", "at most"]);
    let text = replaced(&format!("{BLOCK}{NEO}"), "90 deg", "400 deg");
    assert_mistake(&text, "\"400 deg\"", &["the ends overlap", "at most a full turn"]);
    assert_mistake(&replaced(SCREWS, "0.5, 2.0", "0.5, 0.0"), "[0.5, 0.0]", &["a circuit of radius 0 m"]);
    let text = replaced(&format!("{TUBE}{NEO}{LAYERS}"), "0.3", "5.0");
    assert_mistake(&text, "5.0", &["does not carry 5 Pa up to the stretch 2", "or a larger `stretch`"]);
    // 2 h (c₁ + 2 c₂ I + 3 c₃ I²)(1 − λ⁻⁴) with I = λ² + λ⁻² − 2 has its maximum 1.39939e-4 at λ = 1.55352.
    let thin = replaced(TUBE, "inner_pressure = 0.3", "inner_pressure = 2e-4\nstretch = 3.0");
    let yeoh = "[law]\ntype = \"yeoh\"\nc1 = 1.0\nc2 = -0.1\nc3 = 0.005\n[[layer]]\nthickness = 1e-4\n";
    let words = ["does not carry 0.0002 Pa: it is beyond the limit point 1.399", "e-4 Pa, at the stretch 1.553"];
    assert_mistake(&format!("{thin}{yeoh}"), "2e-4", &words);
    let text = replaced(&format!("{TUBE}{NEO}{LAYERS}"), "inner_pressure = 0.3", "inner_pressure = 0.3\nstretch = 0.5");
    assert_mistake(&text, "0.5\n", &["a largest stretch of 0.5", "greater than 1"]);
}
