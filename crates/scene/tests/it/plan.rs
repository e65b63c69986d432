//! The plan: which method, why, and what is skipped.

use piola_scene::Plan;

use crate::support::{ORBIT, PAIR, TOP, assert_mistake, assert_small, replaced, scene};
use piola_testkit::Tol;

fn plan(text: &str) -> Plan {
    Plan::of(&scene(text))
}

fn skips(plan: &Plan, what: &str) -> bool {
    plan.skipped.iter().any(|item| item.what == what && !item.why.is_empty())
}

#[test]
fn what_is_off_is_skipped_with_its_reason() {
    let plan = plan(PAIR);
    for what in ["softening", "post-Newtonian term", "attitudes", "collisions", "error against reference"] {
        assert!(skips(&plan, what), "{what}: {plan}");
    }
}

#[test]
fn what_is_on_is_computed() {
    let plan = plan(&replaced(PAIR, "softening = 0.0", "softening = 1.0\npost_newtonian = true"));
    for what in ["softening", "post-Newtonian term"] {
        assert!(!skips(&plan, what) && plan.computed.iter().any(|item| item.what == what), "{what}: {plan}");
    }
}

#[test]
fn figures_and_tables_that_are_not_asked_for_are_not_written() {
    let plan = plan(&format!("{PAIR}[output]\nfigures = false\ntables = false\n"));
    assert!(skips(&plan, "figures") && skips(&plan, "tables"), "{plan}");
    assert_eq!(plan.files, ["summary.json"]);
}

#[test]
fn method_follows_from_the_forces() {
    let heavy = replaced(PAIR, "gm = \"1 m^3/s^2\"", "gm = 1e6");
    assert_eq!(plan(&heavy).method.to_string(), "composition-8");
    assert_eq!(plan(PAIR).method.to_string(), "nystrom-1210");
    let coarse = format!("{PAIR}[integrator]\ntolerance = 1e-4\n");
    assert_eq!(plan(&coarse).method.to_string(), "nystrom-86");
    let both = replaced(PAIR, "softening = 0.0", "post_newtonian = true");
    assert_eq!(plan(&both).method.to_string(), "verner-98");
    let tight = format!("{ORBIT}[integrator]\ntolerance = 1e-12\n");
    assert_eq!(plan(&tight).method.to_string(), "nystrom-1210");
    let relativistic = replaced(&heavy, "softening = 0.0", "post_newtonian = true");
    assert_eq!(plan(&relativistic).method.to_string(), "gauss-legendre-8");
    assert_eq!(plan(TOP).method.to_string(), "closed-form");
    assert_eq!(plan(&format!("{TOP}[integrator]\ntolerance = 1e-13\n")).method.to_string(), "verner-98");
    assert_eq!(plan(&format!("{TOP}[integrator]\ntolerance = 1e-12\n")).method.to_string(), "dormand-prince-853");
    assert_eq!(plan(&format!("{TOP}[integrator]\nstep = '1 ms'\n")).method.to_string(), "gauss-legendre-8");
    assert_eq!(plan(ORBIT).method.to_string(), "nystrom-1210");
    assert_eq!(plan(&replaced(ORBIT, "eccentricity = 0.5", "eccentricity = 0.0")).method.to_string(), "composition-8");
}

#[test]
fn ellipses_are_taken_from_their_closed_form_unless_something_speaks_against_it() {
    let alone = replaced(ORBIT, "[reference]\nclosed_form = \"kepler\"\n", "");
    let planned = plan(&alone);
    assert_eq!(planned.method.to_string(), "closed-form");
    assert!(skips(&planned, "forces and steps"), "{planned}");
    let json = serde_json::to_value(&planned).unwrap_or_default();
    assert!(json["method"]["order"].is_null(), "{json}");
    // A run that is compared with the closed form, one with a step or a tolerance, and one past a hyperbola integrate.
    let of_elements = "semi_major_axis = 1.0\neccentricity = 0.5";
    let fast = replaced(&alone, of_elements, "position = [1, 0, 0]\nvelocity = [0, 2, 0]")
        .replace("revolutions = 2", "end = 3.0");
    for text in [ORBIT.to_string(), format!("{alone}[integrator]\ntolerance = 1e-9\n"), fast] {
        assert_ne!(plan(&text).method.to_string(), "closed-form", "{text}");
    }
    let compared = plan(ORBIT).reason;
    assert!(compared.starts_with("integrated because the reference is the closed form itself"), "{compared}");
    // Beyond 2⁵³ turns the closed form would give finite nonsense.
    let long = plan(&replaced(&alone, "revolutions = 2", "revolutions = 1e13")).reason;
    assert!(long.starts_with("integrated because the closed form takes at most 1e12 turns"), "{long}");
}

#[test]
fn a_closed_form_evaluates_no_force_and_agrees_with_an_integration() {
    let text = replaced(ORBIT, "eccentricity = 0.5", "eccentricity = 0.9");
    let closed = scene(&format!("{text}[integrator]\nmethod = 'closed-form'\n"));
    let run = piola_scene::run::run(&closed, &Plan::of(&closed), |_| core::ops::ControlFlow::Continue(()));
    assert_eq!((run.outcome, run.force_evaluations), (piola_scene::run::Outcome::Completed, 0));
    let instants = run.history.times.len();
    assert_eq!((run.steps, run.rejected), (instants as u64 - 1, 0));
    let integrated = scene(&text);
    let integrated =
        piola_scene::run::run(&integrated, &Plan::of(&integrated), |_| core::ops::ControlFlow::Continue(()));
    let size = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    let (mut places, mut speeds) = (0.0_f64, 0.0_f64);
    for i in 0..instants {
        places = places.max(size(run.history.positions[i][0], integrated.history.positions[i][0]));
        speeds = speeds.max(size(run.history.velocities[i][0], integrated.history.velocities[i][0]));
    }
    let why = "the integration's error after two revolutions, greatest near the pericentre, where the speed is 4.4";
    assert_small("places", places, Tol::stated(2e-12, why));
    assert_small("velocities", speeds, Tol::stated(2e-10, why));
}

#[test]
fn a_closed_form_is_refused_where_there_is_none() {
    let of = |text: &str, more: &str| format!("{text}[integrator]\nmethod = 'closed-form'\n{more}");
    let foreign =
        ["the closed form in a scene that is not of [central] or [mechanism]", "a symmetric top, or another method"];
    assert_mistake(&of(PAIR, ""), "'closed-form'", &foreign);
    for (key, line) in [("step", "step = 0.125\n"), ("tolerance", "tolerance = 0.125\n")] {
        let found = format!("`{key}` with the method closed-form");
        assert_mistake(&of(ORBIT, line), "0.125", &[&found, "neither step nor tolerance: a closed form has no steps"]);
    }
}

#[test]
fn a_top_is_taken_from_its_closed_form_and_another_body_is_integrated() {
    let planned = plan(TOP);
    assert!(skips(&planned, "accelerations and steps"), "{planned}");
    let closed = format!("{TOP}[integrator]\nmethod = 'closed-form'\n");
    let run = |text: &str| {
        let scene = scene(text);
        piola_scene::run::run(&scene, &Plan::of(&scene), |_| core::ops::ControlFlow::Continue(()))
    };
    let (found, expected) = (run(&closed), run(&format!("{TOP}[integrator]\ntolerance = 1e-14\n")));
    assert_eq!((found.outcome, found.force_evaluations), (piola_scene::run::Outcome::Completed, 0));
    assert!(0 < expected.force_evaluations);
    for (found, expected) in found.history.coordinates.iter().zip(&expected.history.coordinates) {
        let why = "of the integration over ten turns";
        piola_testkit::assert_close("angles and rates", found, expected, Tol::stated(1e-11, why));
    }
    let lopsided = replaced(&closed, "inertia = [0.75, 0.75, 0.25]", "inertia = [0.75, 0.7, 0.25]");
    assert_mistake(&lopsided, "'closed-form'", &["the mechanism has no closed form", "symmetric about the third axis"]);
}

#[test]
fn what_steps_do_not_see_is_skipped_with_its_reason() {
    let more = "[[joint]]\nname = 'wall'\ntype = 'fixed'\n[[joint]]\nname = 'other'\ntype = 'revolute'\naxis = [0, 1, 0]\n\
                [[joint]]\nname = 'rod'\nparent = 'other'\ntype = 'fixed'\noffset = [0, 0, -1]\n\
                [[particle]]\nname = 'nail'\njoint = 'wall'\nmass = 1\n[[particle]]\nname = 'bob'\njoint = 'rod'\nmass = 1\n";
    let planned = plan(&format!("{TOP}{more}"));
    assert_eq!(planned.method.to_string(), "verner-98");
    let still = planned.skipped.iter().find(|item| item.what == "parts that stand still");
    assert!(still.is_some_and(|item| item.why.ends_with("nail")), "{planned}");
    for what in ["fixed joints", "influence of independent parts on each other"] {
        assert!(skips(&planned, what), "{what}: {planned}");
    }
    assert!(planned.computed.iter().any(|item| item.what == "2 independent parts"), "{planned}");
    let whole = plan(&format!("{TOP}{more}[integrator]\nsimplify = false\n"));
    assert!(skips(&whole, "simplifications"), "{whole}");
}

#[test]
fn every_method_can_be_asked_for() {
    for word in &piola_scene::schema::METHODS {
        let plan = plan(&format!("{ORBIT}[integrator]\nmethod = \"{}\"\n", word.name));
        assert!(word.name == "auto" || plan.method.to_string() == word.name, "{plan}");
        assert!(!plan.reason.is_empty());
    }
}

#[test]
fn planned_steps_equal_steps_taken() {
    let text = format!("{ORBIT}[integrator]\nmethod = 'composition-8'\nstep = '0.01 s'\n[output]\nsamples = 37\n");
    let scene = scene(&text);
    let plan = Plan::of(&scene);
    let run = piola_scene::run::run(&scene, &plan, |_| core::ops::ControlFlow::Continue(()));
    assert_eq!(plan.steps, Some(run.steps));
}

#[test]
fn equations_are_two_for_each_coordinate_and_six_for_each_body() {
    for (text, count) in [(TOP, 6), (PAIR, 12), (ORBIT, 6)] {
        let plan = plan(text);
        assert_eq!(plan.equations, count);
        assert!(plan.to_string().contains(&format!("{count} equations of first order")), "{plan}");
    }
}

#[test]
fn plan_is_told_as_text_and_as_json() {
    let plan = plan(PAIR);
    let text = plan.to_string();
    for word in ["2 bodies attracting each other", "skipped", "nystrom-1210", "summary.json"] {
        assert!(text.contains(word), "{text}");
    }
    let json = serde_json::to_value(&plan).unwrap_or_default();
    assert_eq!(json["method"]["name"], "nystrom-1210");
    assert!(json["skipped"][0]["why"].is_string(), "{json}");
}

#[test]
fn the_predicted_cost_counts_every_independent_part() {
    // The second pendulum is a thousand times as fast as the first one.
    let text = "
[mechanism]
[[joint]]
name = 'slow'
type = 'revolute'
axis = [0, 1, 0]
angle = 0.3
[[joint]]
name = 'fast'
type = 'revolute'
axis = [0, 1, 0]
angle = 0.3
[[particle]]
name = 'a'
joint = 'slow'
at = [0, 0, -1000]
mass = 1
[[particle]]
name = 'b'
joint = 'fast'
at = [0, 0, -1e-3]
mass = 1
[time]
end = 20
[output]
samples = 3
";
    let scene = scene(text);
    let plan = Plan::of(&scene);
    let run = piola_scene::run::run(&scene, &plan, |_| core::ops::ControlFlow::Continue(()));
    let cost = piola_scene::run::trial(&scene, &plan).map_or(f64::NAN, |cost| cost.force_evaluations);
    let ratio = cost / run.force_evaluations as f64;
    assert!((0.5..2.0).contains(&ratio), "{cost} of {}", run.force_evaluations);
}
