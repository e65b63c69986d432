//! The short table at the end of a run.

use core::fmt::Write as _;

use piola_scene::output::stability;
use piola_scene::run::{Answers, Drift, Run};
use piola_scene::{Plan, Scene};

/// Bodies beyond this are left to the tables.
const SHOWN: usize = 20;

/// The table.
pub(crate) fn table(scene: &Scene, plan: &Plan, run: &Run) -> String {
    let mut text = String::new();
    let title = scene.title.as_deref().unwrap_or(&scene.name);
    let _ = writeln!(text, "{title}: {}", plan.system);
    let _ = writeln!(
        text,
        "{}: {} steps, {} evaluations of the forces, {:.3} s\n{}\n",
        plan.method, run.steps, run.force_evaluations, run.wall_time, plan.reason
    );
    if let Some(errors) = &run.errors {
        errors_table(&mut text, errors);
    }
    let _ = writeln!(text, "{:<24}{:>12}{:>12}", "invariant", "largest", "last");
    let mut line = |name: &str, drift: Option<Drift>| {
        if let Some(drift) = drift {
            let _ = writeln!(text, "{name:<24}{:>12.1e}{:>12.1e}", drift.max_relative, drift.last_relative);
        }
    };
    line(if run.history.work_names.is_empty() { "energy" } else { "energy less work" }, run.drifts.energy);
    line("post-Newtonian energy", run.drifts.post_newtonian_energy);
    line("momentum", run.drifts.momentum);
    line("angular momentum", run.drifts.angular_momentum);
    if let Some(answers) = &run.answers {
        answers_table(&mut text, run, answers);
    }
    for (t, name) in run.history.singular_positions.iter().take(SHOWN) {
        let _ =
            writeln!(text, "singular position at {t:.6} s: constraint `{name}` depends on others, motions may branch");
    }
    if let Some(works) = run.history.works.last() {
        let _ = writeln!(text, "\n{:<24}{:>12}", "work of", "J");
        for (name, work) in run.history.work_names.iter().zip(works) {
            let _ = writeln!(text, "{name:<24}{work:>12.4e}");
        }
    }
    if run.drifts.post_newtonian_energy.is_some() {
        text.push_str(
            "The post-Newtonian force depends on velocity: Newton's energy and angular momentum vary with the orbits. The\n\
             post-Newtonian energy is kept but for terms of order m/(M c^2), which a term for one central body leaves out.\n",
        );
    }
    text.push('\n');
    text
}

/// Answers to the questions of a scene.
fn answers_table(text: &mut String, run: &Run, answers: &Answers) {
    text.push('\n');
    match answers {
        Answers::Phase(found) => {
            if let Some(crossings) = &found.crossings {
                let _ = writeln!(text, "{:<24}{:>12}", "crossings of the section", crossings.len());
            }
            if let Some(exponent) = found.exponent {
                let _ = writeln!(text, "{:<24}{exponent:>12.4e} 1/s", "largest exponent");
            }
        }
        Answers::Mechanism(Err(why)) => {
            let _ = writeln!(text, "no equilibrium: {why}");
        }
        Answers::Mechanism(Ok(found)) => {
            let _ = writeln!(text, "{:<24}{:>12}", "equilibrium", stability(found.stability));
            for (name, q) in run.history.coordinate_names.iter().zip(&found.coordinates).take(SHOWN) {
                let _ = writeln!(text, "{name:<24}{q:>12.6}");
            }
            if !found.modes.is_empty() {
                let _ = writeln!(text, "{:<24}{:>12}{:>14}", "mode", "rad/s", "growth 1/s");
            }
            for (number, mode) in found.modes.iter().take(SHOWN).enumerate() {
                let (rate, growth) = (mode.angular_frequency, mode.growth_rate);
                let _ = writeln!(text, "{:<24}{rate:>12.6}{growth:>14.6}", number + 1);
            }
        }
    }
}

/// Relative errors by body, at a few instants when there are few.
fn errors_table(text: &mut String, errors: &piola_scene::run::Errors) {
    /// Instants that fit on a line.
    const COLUMNS: usize = 5;
    let times: Vec<f64> =
        errors.bodies.first().map(|body| body.at.iter().map(|at| at.time).collect()).unwrap_or_default();
    let few = times.len() <= COLUMNS;
    let _ = write!(text, "{:<24}", format!("position beside {}", shortened(&errors.label)));
    if few {
        for time in &times {
            let _ = write!(text, "{:>12}", instant(*time));
        }
    } else {
        let _ = write!(text, "{:>12}", "last");
    }
    let _ = writeln!(text, "{:>12}{:>14}", "largest", "metres");
    for body in errors.bodies.iter().take(SHOWN) {
        let _ = write!(text, "{:<24}", body.name);
        if few {
            for time in &times {
                match body.at.iter().find(|at| at.time.total_cmp(time).is_eq()) {
                    Some(at) => {
                        let _ = write!(text, "{:>12.1e}", at.relative);
                    }
                    None => {
                        let _ = write!(text, "{:>12}", "");
                    }
                }
            }
        } else if let Some(last) = body.at.last() {
            let _ = write!(text, "{:>12.1e}", last.relative);
        }
        let _ = writeln!(text, "{:>12.1e}{:>14.1e}", body.largest_relative, body.largest);
    }
    if SHOWN < errors.bodies.len() {
        let _ = writeln!(text, "and {} more in reference.csv", errors.bodies.len() - SHOWN);
    }
    text.push('\n');
}

fn shortened(label: &str) -> String {
    label.chars().take(40).collect()
}

/// A time in days where it is long.
fn instant(time: f64) -> String {
    if 86_400.0 <= time.abs() { format!("{} d", (time / 86_400.0 * 1e4).round() / 1e4) } else { format!("{time} s") }
}
