//! Constraints of scenes: rods, loops and drives, and mistakes at their places.

use core::ops::ControlFlow;

use piola_scene::Plan;
use piola_scene::run::{self, Outcome};
use piola_testkit::{Tol, assert_close};

use crate::support::{TOP, assert_mistake, replaced, report, scene};

/// A crank that turns evenly, a rod and a slider.
const SLIDER: &str = r#"
[mechanism]

[parameters]
speed = "3 rad/s"

[[joint]]
name = "crank"
type = "revolute"
axis = [0, -1, 0]

[[joint]]
name = "rail"
type = "prismatic"
axis = [1, 0, 0]
displacement = "50 cm"

[[particle]]
name = "pin"
joint = "crank"
mass = "1 kg"
at = "[0, 0, 20] cm"

[[particle]]
name = "slider"
joint = "rail"
mass = "4 kg"

[[constraint]]
name = "rod"
type = "distance"
from = "pin"
to = "slider"
length = "60 cm"

[[constraint]]
name = "engine"
type = "prescribed"
coordinate = "crank"
motion = "speed * t"

[time]
end = "2 s"

[output]
reactions = true
samples = 11
"#;

#[test]
fn a_slider_follows_its_crank_and_the_drive_does_the_work() {
    let scene = scene(SLIDER);
    let plan = Plan::of(&scene);
    for name in ["works.csv", "reactions.csv", "constraints.csv"] {
        assert!(plan.files.contains(&name.to_string()), "{name}");
    }
    let told = plan.to_string();
    assert!(told.contains("0 degrees of freedom are left") && told.contains("constraint `rod`"), "{told}");
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    let mut compared = 0;
    for (t, state) in run.history.times.iter().zip(&run.history.coordinates) {
        // The pin at ⅕ (−sin, cos) of the angle, the slider on the line z = 0.
        let (sine, cosine) = (3.0 * t).sin_cos();
        let reach = (0.36 - 0.04 * cosine * cosine).sqrt();
        assert_close("slider", &[state[1]], &[-0.2 * sine + reach], Tol::stated(1e-13, "of one projection"));
        compared += 1;
    }
    assert_eq!(compared, 11);
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-12, "the tolerance 1e-15 times some hundred steps"));
    assert_eq!(run.history.condition_names, ["tension of rod (N)", "drive of engine (N m)"]);
}

#[test]
fn mistakes_in_constraints_are_shown_at_their_places() {
    assert_mistake(
        &replaced(SLIDER, "speed * t", "speed * t * crank"),
        "\"speed * t * crank\"",
        &["depends on a coordinate"],
    );
    assert_mistake(
        &replaced(SLIDER, "speed * t", "speed * t^2"),
        "\"speed * t^2\"",
        &["`motion` is", "instead of a pure number"],
    );
    assert_mistake(&replaced(SLIDER, "from = \"pin\"", "from = \"pen\""), "\"pen\"", &["did you mean `pin`?"]);
    assert_mistake(
        &replaced(SLIDER, "length = \"60 cm\"", "length = 0.0"),
        "0.0\n\n[[constraint]]",
        &["greater than zero"],
    );
    assert_mistake(
        &replaced(SLIDER, "from = \"pin\"", "from = \"slider\""),
        "\"slider\"\nlength",
        &["both ends are on one body"],
    );
    let fixed = replaced(SLIDER, "[output]", "[integrator]\nmethod = \"gauss-legendre-8\"\n[output]");
    assert_mistake(&fixed, "\"gauss-legendre-8\"", &["a fixed step with constraints", "dormand-prince-853"]);
    let stepped = replaced(SLIDER, "[output]", "[integrator]\nstep = 0.01\n[output]");
    assert_mistake(&stepped, "0.01\n[output]", &["a fixed step with constraints"]);
    let free = format!("{}\n[output]\nreactions = true\n", crate::support::PAIR);
    assert_mistake(&free, "true", &["`reactions` of a scene without joints", "in a [mechanism]"]);
    let study = "[wavefront]\ntype = 'point'\nlength = 1.0\n[[medium]]\ntype = 'uniform'\n[output]\nreactions = true\n";
    assert_mistake(study, "true", &["`reactions` of a scene without joints"]);
    // A rod that reaches nowhere: the scene is valid, the plan says so, and the run does not start.
    let short = scene(&replaced(SLIDER, "60 cm", "1 mm"));
    let plan = Plan::of(&short);
    assert!(plan.to_string().contains("no start is found"), "{plan}");
    let why = run::trial(&short, &plan).err().unwrap_or_default();
    assert!(why.contains("rod") || why.contains("constraint"), "{why}");
    assert!(
        report(&replaced(SLIDER, "name = \"engine\"", "name = \"rod\""))
            .to_string()
            .contains("the name `rod` is taken")
    );
}

#[test]
fn reactions_of_a_top_that_stands_are_its_weight() {
    let still = replaced(TOP, "rates = \"[0, 0, 60] rad/s\"", "rates = [0.0, 0.0, 0.0]");
    let upright = replaced(&still, "\"[0, 30, 0] deg\"", "\"[0, 90, 0] deg\"");
    let hanging = replaced(&upright, "[time]", "[output]\nreactions = true\nsamples = 2\n[time]");
    let scene = scene(&hanging);
    let run = run::run(&scene, &Plan::of(&scene), |_| ControlFlow::Continue(()));
    // It lies level: it starts to fall with a = g m l²/(m l² + I) at its centre, and the tip carries m (g − a).
    let fall = 9.80665 * 0.25 / (0.25 + 0.75);
    let held = run.history.reactions[0][0];
    assert_close("force", &held.force, &[0.0, 0.0, 9.80665 - fall], Tol::stated(1e-14, "of terms of size ten"));
}

#[test]
fn the_summary_names_singular_positions_that_a_parallelogram_goes_through() {
    let crank = |name: &str, at: f64| {
        format!(
            "[[joint]]\nname = '{name}'\ntype = 'revolute'\naxis = [0, -1, 0]\noffset = [{at:?}, 0.0, 0.0]\nangle = 0.5\n\
             rate = 1.0\n[[particle]]\nname = '{name} pin'\njoint = '{name}'\nmass = 1.0\nat = [1.0, 0.0, 0.0]\n"
        )
    };
    let text = format!(
        "[mechanism]\ngravity = [0.0, 0.0, 0.0]\n{}{}[[constraint]]\nname = 'rod'\ntype = 'distance'\nfrom = 'left pin'\n\
         to = 'right pin'\n[time]\nend = 4.0\n[integrator]\ntolerance = 1e-10\n",
        crank("left", 0.0),
        crank("right", 2.0)
    );
    let scene = scene(&text);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    let told = piola_scene::output::Summary::of(&scene, &plan, &run).singular_positions;
    assert!(told.len() == 1 && told[0]["constraint"] == "rod" && told[0]["time_s"].is_number(), "{told:?}");
}

#[test]
fn all_columns_of_a_record_count_against_memory() {
    let damper = |i: u32| {
        format!("[[force]]\nname = 'd{i}'\ntype = 'torsion-spring'\ncoordinate = 'crank'\ntorsional_damping = 1.0\n")
    };
    let many: String = (0..97).map(damper).collect();
    // 97 works and that of the drive, 2 places, 2 coordinates with rates, 2 reactions, and the forces of 2 constraints: 122.
    let text = replaced(&format!("{SLIDER}{many}"), "samples = 11", "samples = 1000000");
    assert_mistake(&text, "1000000", &["1000000 samples of 122 numbers", "at most 245901"]);
}
