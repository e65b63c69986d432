//! The plan: which method, why, and what is skipped.

use piola_scene::Plan;

use crate::support::{ORBIT, PAIR, TOP, replaced, scene};

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
    assert_eq!(plan(TOP).method.to_string(), "verner-98");
    assert_eq!(plan(&format!("{TOP}[integrator]\nstep = '1 ms'\n")).method.to_string(), "gauss-legendre-8");
    assert_eq!(plan(ORBIT).method.to_string(), "nystrom-1210");
    assert_eq!(plan(&replaced(ORBIT, "eccentricity = 0.5", "eccentricity = 0.0")).method.to_string(), "composition-8");
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
