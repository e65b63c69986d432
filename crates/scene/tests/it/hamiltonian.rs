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
fn stars_are_integrated_symplectically_and_cross_their_section() {
    let (plan, run) = complete(STARS);
    assert_eq!(plan.method.to_string(), "composition-8");
    assert!(plan.reason.contains("H = T(p) + V(q)"), "{}", plan.reason);
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-13, "rounding of two thousand steps"));
    let Some(Answers::Phase(answers)) = &run.answers else { panic!("{:?}", run.answers) };
    assert!(10 < answers.crossings.len(), "{}", answers.crossings.len());
    for (_, point) in &answers.crossings {
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
    assert!(report(bare).to_string().contains("[hamiltonian] without coordinates"));
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
