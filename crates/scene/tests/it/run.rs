//! Runs: accuracy of the scenes that come with the program, interruption, failure, files.

use core::ops::ControlFlow;
use std::path::Path;

use piola_scene::output::{self, Folder, Summary};
use piola_scene::run::{self, Outcome, Run};
use piola_scene::{Plan, Scene};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::support::{ORBIT, PAIR, TOP, assert_small, replaced, scene};

fn complete(scene: &Scene) -> Run {
    let run = run::run(scene, &Plan::of(scene), |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn supplied(name: &str, settings: &[&str]) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    Scene::load(&path, &settings).unwrap_or_else(|error| panic!("{error}"))
}

fn energy_drift(run: &Run) -> f64 {
    run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative)
}

#[test]
fn solar_system_with_relativity_is_within_the_model_error_of_the_ephemeris() {
    let run = complete(&supplied("solar-system.toml", &[]));
    let errors = run.errors.unwrap_or_else(|| panic!("no errors"));
    assert_eq!(errors.bodies.len(), 10);
    for body in errors.bodies {
        let bound = if body.name == "moon" { 1.5e-6 } else { 3e-8 };
        let tolerance = Tol::stated(bound, "asteroids, tides and figures of bodies in ten years");
        assert_small(&body.name, body.largest_relative, tolerance);
    }
}

#[test]
fn solar_system_without_relativity_equals_a_newtonian_integration_in_extended_precision() {
    let settings = ["gravity.post_newtonian=false", "reference.file=data/solar-system-newtonian.csv"];
    let run = complete(&supplied("solar-system.toml", &settings));
    for body in &run.errors.as_ref().unwrap_or_else(|| panic!("no errors")).bodies {
        assert_small(&body.name, body.largest, Tol::stated(0.2, "m; the reference is known to 8.3e-2 m"));
    }
    let drifts = [run.drifts.energy, run.drifts.momentum, run.drifts.angular_momentum];
    for drift in drifts {
        let drift = drift.map_or(f64::NAN, |drift| drift.max_relative);
        assert_small("drift", drift, Tol::ulps(9.0));
    }
}

#[test]
fn kepler_with_eccentricity_near_one_stays_at_the_floor_of_doubles() {
    let run = complete(&supplied("kepler.toml", &[]));
    assert_small(
        "energy",
        energy_drift(&run),
        Tol::stated(4e-12, "a part of an ulp a step, 170 steps in each of 1000 turns"),
    );
    let error = run.errors.map_or(f64::NAN, |errors| errors.largest_relative);
    assert_small("place", error, Tol::stated(2e-7, "the drift of the energy times 3/2 n t, largest at the pericentre"));
}

#[test]
fn mechanisms_equal_their_references() {
    for (name, bound) in
        [("double-pendulum.toml", 3.4e-9), ("heavy-top.toml", 1e-11), ("spherical-pendulum.toml", 1e-11)]
    {
        let run = complete(&supplied(name, &[]));
        let error = run.errors.as_ref().map_or(f64::NAN, |errors| errors.largest_relative);
        assert_small(name, error, Tol::stated(bound, "1e-14 times the sensitivity to the start, or 1e-11"));
        assert_small(name, energy_drift(&run), Tol::stated(1e-12, "the tolerance 1e-15 of each of a thousand steps"));
    }
}

#[test]
fn every_method_comes_to_the_same_result() {
    let methods = [
        "composition-4",
        "composition-6",
        "composition-8",
        "gauss-legendre-4",
        "gauss-legendre-6",
        "gauss-legendre-8",
        "dormand-prince-853",
        "verner-98",
        "nystrom-86",
        "nystrom-1210",
    ];
    for method in methods {
        let text = replaced(ORBIT, "eccentricity = 0.5", "eccentricity = 0.2");
        let text = format!("{text}[integrator]\nmethod = \"{method}\"\n");
        let run = complete(&scene(&text));
        let error = run.errors.map_or(f64::NAN, |errors| errors.largest_relative);
        assert_small(
            method,
            error,
            Tol::stated(1e-6, "order 4 with 400 steps a turn: h⁴ times a constant and two turns"),
        );
    }
}

#[test]
fn symplectic_and_adaptive_mechanisms_agree() {
    let fixed = complete(&scene(&format!("{TOP}[integrator]\nstep = '1 ms'\n")));
    let adaptive = complete(&scene(TOP));
    let last = |run: &Run| run.history.coordinates.last().cloned().unwrap_or_default();
    for (a, b) in last(&fixed).iter().zip(last(&adaptive)) {
        let tolerance = Tol::stated(1e-10, "h⁸ of 60 rad/s and 1 ms, times the turns");
        assert_close_at_scale("q or q̇", &[*a], &[b], 1.0, tolerance);
    }
    assert_small("energy", energy_drift(&fixed), Tol::stated(1e-12, "h⁸ of 60 rad/s and 1 ms"));
}

#[test]
fn bodies_run_forward_and_then_backwards_are_where_they_started() {
    for method in ["auto", "composition-8", "gauss-legendre-8"] {
        let there = format!("{PAIR}[integrator]\nmethod = \"{method}\"\n");
        let forward = complete(&scene(&there));
        let (Some(places), Some(velocities)) = (forward.history.positions.last(), forward.history.velocities.last())
        else {
            panic!("{method}: nothing was recorded")
        };
        let mut back = replaced(&there, "end = \"10 s\"", "start = \"10 s\"\nend = \"0 s\"");
        for (old, new) in ["[1.0, 0.0, 0.0]", "[-1.0, 0.0, 0.0]"].into_iter().zip(places) {
            back = replaced(&back, old, &format!("{new:?}"));
        }
        for (old, new) in ["[0.0, 0.5, 0.0]", "[0.0, -0.5, 0.0]"].into_iter().zip(velocities) {
            back = replaced(&back, old, &format!("{new:?}"));
        }
        let scene = scene(&back);
        let plan = Plan::of(&scene);
        let backwards = complete(&scene);
        // With a fixed step the steps are those of the way there.
        assert!(plan.steps.is_none_or(|steps| steps == backwards.steps && steps == forward.steps), "{method}");
        assert_eq!(backwards.history.times.len(), forward.history.times.len());
        assert!(backwards.history.times.is_sorted_by(|a, b| b < a), "{method}");
        let last = backwards.history.positions.last().map(|places| places.concat()).unwrap_or_default();
        let tolerance = Tol::stated(1e-10, "the tolerance 1e-12 of each of some fifty steps there and back");
        assert_close(method, &last, &[1.0, 0.0, 0.0, -1.0, 0.0, 0.0], tolerance);
    }
}

#[test]
fn top_run_forward_and_then_backwards_is_where_it_started() {
    for integrator in ["", "[integrator]\nstep = \"1 ms\"\n"] {
        let there = format!("{TOP}{integrator}");
        let forward = complete(&scene(&there));
        let (first, last) = (&forward.history.coordinates[0], forward.history.coordinates.last());
        let (angles, rates) = last.map(|last| last.split_at(3)).unwrap_or_default();
        let back = replaced(&there, "\"[0, 30, 0] deg\"", &format!("{angles:?}"));
        let back = replaced(&back, "\"[0, 0, 60] rad/s\"", &format!("{rates:?}"));
        let back = replaced(&back, "end = \"1 s\"", "start = \"1 s\"\nend = \"0 s\"");
        let backwards = complete(&scene(&back));
        let last = backwards.history.coordinates.last().cloned().unwrap_or_default();
        // Angles in rad up to 60 and rates in rad/s up to 60 are known alike.
        assert_close(integrator, &last, first, Tol::stated(1e-11, "1e-15 a step times the turns of 60 rad"));
    }
}

#[test]
fn run_before_the_start_equals_the_closed_form_and_is_written() {
    let text = replaced(ORBIT, "revolutions = 2", "end = \"-10 s\"");
    let scene = scene(&format!("{text}[output]\nsamples = 5\n"));
    let plan = Plan::of(&scene);
    let mut done = 0.0;
    let run = run::run(&scene, &plan, |progress| {
        assert!(done < progress.fraction && progress.fraction <= 1.0 && progress.time < 0.0);
        done = progress.fraction;
        ControlFlow::Continue(())
    });
    assert_eq!((&run.outcome, run.time), (&Outcome::Completed, -10.0));
    assert_eq!(run.history.times, [0.0, -2.5, -5.0, -7.5, -10.0]);
    let errors = run.errors.as_ref().map_or(f64::NAN, |errors| errors.largest_relative);
    assert_close("error of places", &[errors], &[0.0], Tol::stated(1e-11, "as forward in time"));
    let folder = folder("before");
    let written = output::write(&folder, &scene, &plan, &run, &Summary::of(&scene, &plan, &run));
    assert!(written.failures.is_empty());
    // What was written is a reference for the same run.
    let text = replaced(&text, "closed_form = \"kepler\"", "file = \"trajectory.csv\"");
    std::fs::write(folder.path().join("scene.toml"), text).unwrap_or_else(|error| panic!("{error}"));
    let again = Scene::load(&folder.path().join("scene.toml"), &[]).unwrap_or_else(|error| panic!("{error}"));
    let run = complete(&again);
    assert!(run.errors.as_ref().is_some_and(|errors| errors.bodies[0].at.len() == 5), "{:?}", run.errors);
    let figure = output::write(&folder, &again, &Plan::of(&again), &run, &Summary::of(&again, &Plan::of(&again), &run));
    assert!(figure.failures.is_empty());
    let svg = std::fs::read_to_string(folder.path().join("error.svg")).unwrap_or_default();
    assert!(!svg.contains("could not be drawn") && !svg.contains("NaN") && svg.contains("<circle"), "{svg}");
    let _ = std::fs::remove_dir_all(folder.path());
}

fn folder(name: &str) -> Folder {
    let path = std::env::temp_dir().join(format!("piola-run-{}-{name}", std::process::id()));
    Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn interrupted_run_writes_what_it_has() {
    let scene = scene(PAIR);
    let plan = Plan::of(&scene);
    let mut steps = 0;
    let run = run::run(&scene, &plan, |progress| {
        steps += 1;
        assert!(0.0 < progress.fraction && progress.fraction <= 1.0);
        if steps == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((run.outcome.clone(), run.steps), (Outcome::Interrupted, 5));
    assert!(1 < run.history.times.len() && run.history.times.len() < plan.instants);
    let summary = Summary::of(&scene, &plan, &run);
    assert_eq!(summary.status, "interrupted");
    assert!(summary.reached_s < summary.end_s);
    let folder = folder("interrupted");
    let written = output::write(&folder, &scene, &plan, &run, &summary);
    assert!(written.failures.is_empty());
    assert_eq!(written.files.len(), plan.files.len());
    let _ = std::fs::remove_dir_all(folder.path());
}

#[test]
fn failed_run_keeps_its_history_and_says_why() {
    // Two bodies at rest fall onto each other.
    let text = replaced(PAIR, "[0.0, 0.5, 0.0]", "[0.0, 0.0, 0.0]");
    let scene = scene(&replaced(&text, "[0.0, -0.5, 0.0]", "[0.0, 0.0, 0.0]"));
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    assert!(matches!(&run.outcome, Outcome::Failed(why) if why.contains("advances t = ")), "{:?}", run.outcome);
    // They meet after π/√2 · (r³/2Gm)^½ …: before the end at any rate.
    assert!(0.0 < run.time && run.time < plan.end && 0 < run.steps);
    assert!(1 < run.history.times.len());
    let summary = Summary::of(&scene, &plan, &run);
    assert_eq!(summary.status, "failed");
    assert!(summary.failure.is_some());
}

#[test]
fn summary_has_the_promised_fields() {
    let scene = scene(ORBIT);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    let summary: serde_json::Value =
        serde_json::from_str(&Summary::of(&scene, &plan, &run).to_json()).unwrap_or_else(|error| panic!("{error}"));
    for number in ["steps", "force_evaluations", "wall_time_s"] {
        assert!(summary[number].is_number(), "{number} of {summary}");
    }
    for text in ["name", "method"] {
        assert!(summary[text].is_string(), "{text} of {summary}");
    }
    for invariant in ["energy", "momentum", "angular_momentum"] {
        assert!(summary["invariants"][invariant].get("max_relative_drift").is_some(), "{invariant} of {summary}");
    }
    assert!(summary["reference"]["max_relative_error"].is_number());
    assert!(summary["reference"]["by_body"]["comet"]["max_relative_error"].is_number());
    assert!(summary["skipped"].as_array().is_some_and(|skipped| !skipped.is_empty()));
}

#[test]
fn one_file_that_cannot_be_written_does_not_lose_the_others() {
    let scene = scene(ORBIT);
    let plan = Plan::of(&scene);
    let run = complete(&scene);
    let folder = folder("blocked");
    // A folder stands where a file should.
    std::fs::create_dir_all(folder.path().join("trajectory.csv/x")).unwrap_or_else(|error| panic!("{error}"));
    let written = output::write(&folder, &scene, &plan, &run, &Summary::of(&scene, &plan, &run));
    assert_eq!(written.failures.len(), 1);
    assert_eq!(written.files.len(), plan.files.len() - 1);
    let left: Vec<_> = std::fs::read_dir(folder.path()).into_iter().flatten().filter_map(Result::ok).collect();
    assert!(left.iter().all(|entry| !entry.file_name().to_string_lossy().contains(".tmp")));
    let _ = std::fs::remove_dir_all(folder.path());
}

#[test]
fn figures_are_whole_svg_documents() {
    for text in [PAIR, TOP, ORBIT] {
        let scene = scene(text);
        let plan = Plan::of(&scene);
        let run = complete(&scene);
        let folder = folder(&format!("figures-{}", scene.names()[0]));
        let written = output::write(&folder, &scene, &plan, &run, &Summary::of(&scene, &plan, &run));
        for path in written.files.iter().filter(|path| path.extension().is_some_and(|e| e == "svg")) {
            let svg = std::fs::read_to_string(path).unwrap_or_default();
            assert!(svg.starts_with("<svg width=\"") && svg.trim_end().ends_with("</svg>"), "{}", path.display());
            assert!(!svg.contains("could not be drawn") && !svg.contains("NaN"), "{}", path.display());
        }
        let _ = std::fs::remove_dir_all(folder.path());
    }
}

#[test]
fn trajectory_of_a_run_is_a_reference_without_error() {
    let path = std::env::temp_dir().join(format!("piola-again-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let first = scene(PAIR);
    let plan = Plan::of(&first);
    let run = complete(&first);
    let _ = output::write(&folder, &first, &plan, &run, &Summary::of(&first, &plan, &run));
    let text = format!("{PAIR}[reference]\nfile = \"trajectory.csv\"\n");
    std::fs::write(path.join("scene.toml"), text).unwrap_or_else(|error| panic!("{error}"));
    let again = Scene::load(&path.join("scene.toml"), &[]).unwrap_or_else(|error| panic!("{error}"));
    let errors = complete(&again).errors.map_or(f64::NAN, |errors| errors.largest_relative);
    // The run lands on every instant now instead of giving it by dense output.
    assert_small("places", errors, Tol::stated(1e-9, "dense output of order seven between steps of order eight"));
    let _ = std::fs::remove_dir_all(path);
}
