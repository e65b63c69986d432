//! Scenes of Hamiltonians and questions: what the planner chooses, what is answered, what is refused.

use core::ops::ControlFlow;

use piola_scene::Plan;
use piola_scene::output::{self, Folder, Summary};
use piola_scene::run::{self, Answers, Outcome, Run};
use piola_testkit::{Tol, assert_close};

use crate::support::{PAIR, assert_mistake, replaced, report, scene};

/// Hénon's and Heiles' stars.
const STARS: &str = r#"
[hamiltonian]
energy = "(px^2 + py^2 + x^2 + y^2)/2 + lambda*(x^2*y - y^3/3)"

[parameters]
lambda = 1.0

[[coordinate]]
name = "x"
momentum = "px"
momentum_at_start = 0.4

[[coordinate]]
name = "y"
momentum = "py"
start = 0.1

[questions]
section = "x"
crossings = 20
exponent = true

[time]
end = "100 s"

[output]
samples = 101
"#;

fn complete(text: &str) -> (Plan, Run) {
    let scene = scene(text);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    (plan, run)
}

#[test]
fn stars_are_integrated_by_their_accelerations_and_cross_their_section() {
    let (plan, run) = complete(STARS);
    assert_eq!(plan.method.to_string(), "nystrom-86");
    assert!(plan.reason.contains("H = T(p) + V(q) with T of second degree"), "{}", plan.reason);
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close(
        "drift",
        &[drift],
        &[0.0],
        Tol::stated(1e-13, "the tolerance 1e-12 of a step: the step adapts, and its error is mostly far smaller"),
    );
    let Some(Answers::Phase(answers)) = &run.answers else { panic!("{:?}", run.answers) };
    let crossings = answers.crossings.as_deref().unwrap_or_default();
    assert!(10 < crossings.len(), "{}", crossings.len());
    for (_, point) in crossings {
        let [x, y, px, py] = point[..] else { panic!("{point:?}") };
        let energy = (px * px + py * py + x * x + y * y) / 2.0 + x * x * y - y * y * y / 3.0;
        let start = 0.08 + 0.005 - 0.001 / 3.0;
        assert_close("energy", &[energy], &[start], Tol::stated(1e-11, "the tolerance 1e-12 times some hundred steps"));
        assert!(x.abs() < 1e-11 && 0.0 < px);
    }
    // Regular at this energy: the estimate falls as ln t/t.
    assert!(answers.exponent.is_some_and(|exponent| exponent.abs() < 0.1), "{:?}", answers.exponent);
}

#[test]
fn a_hamiltonian_that_is_no_sum_takes_an_adaptive_method() {
    let (plan, _) = complete(&replaced(STARS, "+ lambda*", "+ 0.01*x*py + lambda*"));
    assert!(plan.reason.contains("H is no sum"), "{}", plan.reason);
    let stepped = replaced(
        &replaced(STARS, "+ lambda*", "+ 0.01*x*py + lambda*"),
        "[output]",
        "[integrator]\nstep = 0.05\n[output]",
    );
    assert_eq!(complete(&stepped).0.method.to_string(), "gauss-legendre-8");
}

#[test]
fn all_files_of_a_hamiltonian_are_written() {
    let scene = scene(STARS);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    let folder = std::env::temp_dir().join(format!("piola-hamiltonian-{}", std::process::id()));
    let folder_of_results = Folder::prepare(&folder).unwrap_or_else(|error| panic!("{error}"));
    let summary = Summary::of(&scene, &plan, &run);
    let written = output::write(&folder_of_results, &scene, &plan, &run, &summary);
    assert_eq!((written.files.len(), written.failures.len()), (plan.files.len(), 0), "{:?}", plan.files);
    let read =
        |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(read("coordinates.csv").starts_with("time_s,x,y,px,py\n0.0,0.0,0.1,0.4,0.0\n"));
    assert!(read("section.csv").lines().count() <= 21 && read("exponent.csv").lines().count() == 401);
    assert!(read("phase.svg").starts_with("<svg") && read("section.svg").contains("</svg>"));
    assert!(read("summary.json").contains("largest_exponent_1_per_s"));
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn mistakes_in_hamiltonians_are_shown_at_their_places() {
    assert_mistake(&replaced(STARS, "+ lambda*", "+ lamda*"), "\"(px^2", &["did you mean `lambda`?"]);
    assert_mistake(&replaced(STARS, "lambda = 1.0", "lambda = \"1 m\""), "lambda = \"1 m\"", &["`lambda` has a unit"]);
    assert_mistake(&replaced(STARS, "section = \"x\"", "section = \"2 [m] * x\""), "\"2 [m]", &["a number has a unit"]);
    assert_mistake(&replaced(STARS, "momentum = \"py\"", "momentum = \"px\""), "\"px\"\nstart", &["`px` is taken"]);
    let modes = replaced(STARS, "exponent = true", "modes = true");
    assert_mistake(&modes, "true", &["`modes` is no question to this scene", "a scene of [mechanism]"]);
    let pair = format!("{PAIR}\n[questions]\nexponent = true\n");
    assert!(report(&pair).to_string().contains("[questions] in a scene of [gravity]"));
    let reference = format!("{STARS}\n[reference]\nclosed_form = 'kepler'\n");
    assert!(report(&reference).to_string().contains("[reference] in a scene of [hamiltonian]"));
    let bare = "[hamiltonian]\nenergy = '1'\n[time]\nend = 1\n";
    assert_mistake(bare, "[hamiltonian]", &["[hamiltonian] without coordinates"]);
    let backwards = replaced(STARS, "end = \"100 s\"", "end = \"-100 s\"");
    assert_mistake(&backwards, "true", &["`exponent` of a run backwards in time", "an end after the start"]);
}

#[test]
fn a_hamiltonian_that_is_not_defined_fails_at_its_start() {
    let text = replaced(STARS, "+ lambda*", "+ ln(y - 1) + lambda*");
    let scene = scene(&text);
    let why = run::trial(&scene, &Plan::of(&scene)).err().unwrap_or_default();
    assert!(why.contains("`hamiltonian at the start` is NaN"), "{why}");
}

#[test]
fn a_mechanism_answers_for_its_equilibrium_and_energies() {
    // A pendulum of 1 m with a damper: λ² + 0.4 λ + g = 0.
    let asked = "
[mechanism]
[[joint]]
name = 'turn'
type = 'revolute'
axis = [0, -1, 0]
angle = 0.3
[[particle]]
name = 'bob'
joint = 'turn'
mass = 2.0
at = [0.0, 0.0, -1.0]
[[force]]
name = 'damper'
type = 'torsion-spring'
coordinate = 'turn'
torsional_damping = 0.8
[time]
end = 1.0
[questions]
modes = true
energies = true
";
    let (plan, run) = complete(asked);
    assert!(plan.files.contains(&"energies.csv".to_string()) && plan.files.contains(&"modes.csv".to_string()));
    assert_eq!(run.history.energy_names, ["kinetic energy of bob (J)", "weight of bob (J)"]);
    let Some(Answers::Mechanism(Ok(found))) = &run.answers else { panic!("{:?}", run.answers) };
    assert_close("equilibrium", &found.coordinates, &[0.0], Tol::ulps(8.0));
    let mode = &found.modes[0];
    let expected = [-0.2, (9.80665_f64 - 0.04).sqrt()];
    assert_close("mode", &[mode.growth_rate, mode.angular_frequency], &expected, Tol::ulps(64.0));
    let summary = Summary::of(&scene(asked), &plan, &run).to_json();
    assert!(summary.contains("asymptotically stable"), "{summary}");
    let tie = "[[constraint]]\nname = 'it'\ntype = 'prescribed'\ncoordinate = 'turn'\nmotion = 't/1[s]'\n[questions]";
    assert_mistake(&replaced(asked, "[questions]", tie), "true\n", &["under a [[constraint]]"]);
}

/// A coordinate q with the momentum p under H.
fn single(energy: &str, start: f64, momentum: f64) -> String {
    format!(
        "[hamiltonian]\nenergy = \"{energy}\"\n[[coordinate]]\nname = 'q'\nmomentum = 'p'\nstart = {start:?}\n\
         momentum_at_start = {momentum:?}\n[time]\nend = 40.0\n[output]\nsamples = 11\n"
    )
}

#[test]
fn the_form_of_a_hamiltonian_decides_on_its_method() {
    let quarter = core::f64::consts::FRAC_PI_2;
    for (text, method) in [
        (single("p^2/2 + q^4", 0.001, 1.0), "nystrom-86"),
        (single("p^2/2 - cos(q)", quarter, 0.0), "nystrom-86"),
        (single("p^2/2 + 0.5*p - cos(q)", 0.3, 0.0), "nystrom-86"),
        (single("cosh(p) - cos(q)", 1.0, 0.0), "verner-98"),
        (single("p^2*(2 + cos(q))/2", 1.0, 0.5), "verner-98"),
        (single("p^2/2 - cos(q)*cos(t)", 1.0, 0.0), "verner-98"),
    ] {
        let (plan, run) = complete(&text);
        assert_eq!(plan.method.to_string(), method, "{text}");
        let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
        assert_close("drift", &[drift], &[0.0], Tol::stated(1e-11, "the larger tolerance, 1e-12, times ten"));
    }
    let fixed = format!("{}[integrator]\nmethod = 'composition-8'\n", single("p^2/2 - cos(q)", 1.0, 0.0));
    let (plan, _) = complete(&fixed);
    let step = plan.method.step().unwrap_or_default();
    let expected = core::f64::consts::TAU / 100.0;
    assert_close(
        "step",
        &[step],
        &[expected],
        Tol::stated(1e-2, "of the nearest step of the trial to the lowest place"),
    );
}

#[test]
fn an_orbit_of_kepler_runs_with_the_method_that_is_chosen() {
    let text = "
[hamiltonian]
energy = \"(px^2+py^2)/2 - 1/sqrt(x^2+y^2)\"
[[coordinate]]
name = 'x'
momentum = 'px'
start = 0.9
[[coordinate]]
name = 'y'
momentum = 'py'
momentum_at_start = 1.1055415967851332
[time]
end = 6.283185307179586
[output]
samples = 3
";
    let (plan, run) = complete(text);
    assert_eq!(plan.method.to_string(), "nystrom-86");
    let [start, half, end] = &run.history.coordinates[..] else { panic!("three instants") };
    let tolerance = Tol::stated(1e-11, "the tolerance 1e-12 over a turn, and its dense output");
    assert_close("after a period", end, start, tolerance);
    assert_close("apocentre", &half[..2], &[-1.1, 0.0], tolerance);
}

#[test]
fn the_summary_tells_what_was_asked_and_nothing_else() {
    let answers = |text: &str| {
        let (plan, run) = complete(text);
        Summary::of(&scene(text), &plan, &run).answers.unwrap_or_default()
    };
    let exponent = answers(&replaced(STARS, "section = \"x\"\ncrossings = 20\n", ""));
    assert!(exponent.get("crossings").is_none() && exponent["largest_exponent_1_per_s"].is_number(), "{exponent}");
    let section = answers(&replaced(STARS, "section = \"x\"\ncrossings = 20\nexponent = true", "section = \"x - 9\""));
    assert!(section["crossings"] == 0 && section.get("largest_exponent_1_per_s").is_none(), "{section}");
}

/// A plane oscillator with brackets and axes turned by 30°.
const OSCILLATOR: &str = r#"
[hamiltonian]
energy = "(px^2 + py^2 + x^2 + y^2)/2"

[[coordinate]]
name = "x"
momentum = "px"
start = 1.0

[[coordinate]]
name = "y"
momentum = "py"
momentum_at_start = 0.5

[[bracket]]
name = "rate of L"
first = "x*py - y*px"

[[bracket]]
name = "L with A"
first = "x*py - y*px"
second = "x^2 + px^2 - y^2 - py^2"

[[new_coordinate]]
name = "u"
coordinate = "(sqrt(3)*x + y)/2"
momentum = "(sqrt(3)*px + py)/2"

[[new_coordinate]]
name = "v"
coordinate = "(sqrt(3)*y - x)/2"
momentum = "(sqrt(3)*py - px)/2"

[time]
end = "10 s"

[output]
samples = 41
"#;

#[test]
fn brackets_along_an_orbit_equal_their_closed_forms() {
    let (plan, run) = complete(OSCILLATOR);
    assert!(plan.files.contains(&"brackets.csv".to_string()), "{plan}");
    let Some(Answers::Phase(answers)) = &run.answers else { panic!("{:?}", run.answers) };
    assert_eq!(answers.brackets.len(), 41);
    for (state, bracket) in run.history.coordinates.iter().zip(&answers.brackets) {
        let [x, y, px, py] = state[..] else { panic!("{state:?}") };
        // L generates rotations: {L, x² + pₓ² − y² − p_y²} = 4 (x y + pₓ p_y).
        assert_close("{L, H}", &bracket[..1], &[0.0], Tol::ulps(8.0));
        assert_close("{L, A}", &bracket[1..], &[4.0 * (x * y + px * py)], Tol::ulps(16.0));
    }
    let summary = Summary::of(&scene(OSCILLATOR), &plan, &run).to_json();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(summary["answers"]["brackets"]["L with A"]["at_start"], 0.0);
    assert_eq!(summary["answers"]["new_coordinates"]["is_canonical"], true);
}

#[test]
fn a_change_of_variables_that_is_not_canonical_is_told() {
    // v stretched by two alone: the worst entry is that of y and p_y, 1/4 + 2·3/4 = 7/4 instead of 1.
    let stretched = replaced(OSCILLATOR, "(sqrt(3)*y - x)/2", "sqrt(3)*y - x");
    let (plan, run) = complete(&stretched);
    let summary = Summary::of(&scene(&stretched), &plan, &run).to_json();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(summary["answers"]["new_coordinates"]["is_canonical"], false);
    let residual = summary["answers"]["new_coordinates"]["largest_relative_residual"].as_f64();
    // 7/4 − 1 over the sum of magnitudes, 7/4.
    assert_close("residual", &[residual.unwrap_or(f64::NAN)], &[3.0 / 7.0], Tol::ulps(8.0));
}

#[test]
fn a_bracket_that_fails_leaves_its_values_until_then_and_the_other_answers() {
    // √(5.05 − t) is not defined from 5.25 s on, the instant 21.
    let undefined = replaced(OSCILLATOR, "second = \"x^2 + px^2 - y^2 - py^2\"", "second = \"sqrt(5.05 - t)*x\"");
    let asked = replaced(&undefined, "[time]", "[questions]\nsection = \"x\"\nexponent = true\n\n[time]");
    let scene = scene(&asked);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = &run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.starts_with("a bracket at 5.25 s: "), "{why}");
    let Some(Answers::Phase(answers)) = &run.answers else { panic!("{:?}", run.answers) };
    assert_eq!(answers.brackets.len(), 21);
    assert!(answers.exponent.is_some());
    // x = cos t passes zero upwards at 3π/2 only.
    assert_eq!(answers.crossings.as_ref().map(Vec::len), Some(1));
    let summary = Summary::of(&scene, &plan, &run).answers.unwrap_or_default();
    assert_eq!((&summary["crossings"], &summary["new_coordinates"]["is_canonical"]), (&1.into(), &().into()));
}

#[test]
fn a_bracket_that_is_not_defined_fails_by_name_and_mistakes_are_placed() {
    let undefined = replaced(OSCILLATOR, "second = \"x^2 + px^2 - y^2 - py^2\"", "second = \"1/y\"");
    let scene = scene(&undefined);
    let run = run::run(&scene, &Plan::of(&scene), |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.contains("a bracket at 0 s") && why.contains("{K, H}"), "{why}");
    let one = OSCILLATOR.rfind("[[new_coordinate]]").unwrap_or_default();
    let end = OSCILLATOR.find("[time]").unwrap_or_default();
    let short = format!("{}{}", &OSCILLATOR[..one], &OSCILLATOR[end..]);
    assert_mistake(&short, "[[new_coordinate]]", &["1 new coordinates of 2 old ones", "2 [[new_coordinate]]"]);
    let twice = replaced(OSCILLATOR, "name = \"L with A\"", "name = \"rate of L\"");
    assert!(report(&twice).to_string().contains("the name `rate of L` is taken"), "{}", report(&twice));
    let unknown = replaced(OSCILLATOR, "x^2 + px^2 - y^2 - py^2", "z^2");
    assert!(report(&unknown).to_string().contains("`z`"), "{}", report(&unknown));
    let foreign = format!("{PAIR}[[bracket]]\nname = \"b\"\nfirst = \"x\"\n");
    assert!(report(&foreign).to_string().contains("[[bracket]] in a scene of [gravity]"), "{}", report(&foreign));
}
