//! One member: its scene is run and the numbers of its end are kept.

use core::ops::ControlFlow;

use piola_scene::model::System;
use piola_scene::plan::Method;
use piola_scene::run::{self, Outcome, Run};
use piola_scene::studies::{self, StudyPlan};
use piola_scene::{Plan, Scene, SceneFile};
use serde_json::Value;

/// The numbers of a member.
///
/// # Example
/// See [`Ensemble`](crate::Ensemble).
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Member {
    /// Its number, from 0.
    pub member: u64,
    /// Why the member failed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub failure: Option<String>,
    /// The values of the [columns](crate::Ensemble::columns), in SI units; NaN for a quantity that the member lacks.
    #[serde(with = "numbers")]
    pub values: Vec<f64>,
}

impl Member {
    pub(crate) fn failed(member: u64, why: &str, columns: usize) -> Self {
        // One line of a table.
        let first = why.lines().next().unwrap_or_default().to_owned();
        Self { member, failure: Some(first), values: vec![f64::NAN; columns] }
    }
}

/// JSON has no NaN: such numbers are written as `null`.
mod numbers {
    use serde::{Deserialize as _, Deserializer, Serialize as _, Serializer};

    pub(super) fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
        let finite = |x: &f64| x.is_finite().then_some(*x);
        values.iter().map(finite).collect::<Vec<_>>().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
        let values = Vec::<Option<f64>>::deserialize(deserializer)?;
        Ok(values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
    }
}

/// The names of a scene's columns. A study is run once, because only its results name them.
pub(crate) fn columns(scene: &SceneFile) -> Vec<String> {
    match scene {
        SceneFile::Motion(scene) => {
            // The names stand in the record from the first step on.
            let run = run::run(scene, &Plan::brief(scene), |_| ControlFlow::Break(()));
            motion(&run).into_iter().map(|(name, _)| name).collect()
        }
        SceneFile::Study(study) => of_study(study, &|| false).1.into_iter().map(|(name, _)| name).collect(),
    }
}

type Named = Vec<(String, f64)>;

/// The last state, energy, drifts and the work of a motion.
fn motion(run: &Run) -> Named {
    let history = &run.history;
    let mut named: Named = vec![("time (s)".to_owned(), run.time)];
    if let Some(coordinates) = history.coordinates.last() {
        let names = &history.coordinate_names;
        let rates = names.iter().map(|name| format!("rate of {name}"));
        named.extend(names.iter().cloned().chain(rates).zip(coordinates.iter().copied()));
    } else {
        let state = |kind: [&str; 3], unit: &str, vectors: Option<&Vec<[f64; 3]>>| -> Named {
            let bodies = history.names.iter().zip(vectors.into_iter().flatten());
            bodies
                .flat_map(|(name, vector)| {
                    kind.into_iter().zip(*vector).map(move |(axis, x)| (format!("{name} {axis} ({unit})"), x))
                })
                .collect()
        };
        named.extend(state(["x", "y", "z"], "m", history.positions.last()));
        named.extend(state(["vx", "vy", "vz"], "m/s", history.velocities.last()));
    }
    named.push(("energy (J)".to_owned(), history.invariants.last().map_or(f64::NAN, |last| last.energy)));
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    named.push(("largest relative change of energy".to_owned(), drift));
    if let Some(errors) = &run.errors {
        named.push(("largest relative error".to_owned(), errors.largest_relative));
    }
    named.extend([
        ("steps".to_owned(), run.steps as f64),
        ("evaluations of the forces".to_owned(), run.force_evaluations as f64),
    ]);
    named
}

/// How a study ended, and the numbers of its results.
fn of_study(study: &piola_scene::Study, stop: &dyn Fn() -> bool) -> (Outcome, Named) {
    let run = studies::run(study, |_| going(stop));
    let summary = run.summary(&StudyPlan::of(study));
    let value: Value = serde_json::from_str(&summary).unwrap_or_default();
    let mut named = Named::new();
    collect("", &value["results"], &mut named);
    (run.outcome, named)
}

/// The numbers of a tree, by their paths; lists that are long are left out.
fn collect(path: &str, value: &Value, named: &mut Named) {
    /// Longer lists are curves, not results.
    const MOST: usize = 16;
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Number(number) => named.push((path.to_owned(), number.as_f64().unwrap_or(f64::NAN))),
        Value::Object(fields) => fields.iter().for_each(|(key, value)| collect(&below(key), value, named)),
        Value::Array(list) if list.len() <= MOST => {
            list.iter().enumerate().for_each(|(index, value)| collect(&below(&index.to_string()), value, named));
        }
        _ => {}
    }
}

fn going(stop: &dyn Fn() -> bool) -> ControlFlow<()> {
    if stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Runs a scene and keeps its numbers; none if it was stopped.
pub(crate) fn compute(member: u64, scene: &SceneFile, columns: &[String], stop: &dyn Fn() -> bool) -> Option<Member> {
    match scene {
        SceneFile::Motion(scene) => {
            let run = run::run(scene, &Plan::brief(scene), |_| going(stop));
            let named = motion(&run);
            kept(member, run.outcome, &named, columns)
        }
        SceneFile::Study(study) => {
            let (outcome, named) = of_study(study, stop);
            kept(member, outcome, &named, columns)
        }
    }
}

/// Whether scenes of an ensemble may go together: bodies that attract each other, by a method of fixed steps.
pub(crate) fn may_go_together(scene: &SceneFile) -> bool {
    let SceneFile::Motion(scene) = scene else { return false };
    matches!(scene.system, System::Gravitation(_)) && matches!(Plan::brief(scene).method, Method::Composition { .. })
}

fn motion_of((_, scene): &(u64, SceneFile)) -> Option<&Scene> {
    match scene {
        SceneFile::Motion(scene) => Some(scene),
        SceneFile::Study(_) => None,
    }
}

/// [`compute`] of several scenes at once; none if they cannot go together, or one fails or was stopped.
pub(crate) fn compute_together(
    scenes: &[(u64, SceneFile)],
    columns: &[String],
    stop: &dyn Fn() -> bool,
) -> Option<Vec<Member>> {
    let motions: Vec<&Scene> = scenes.iter().map(motion_of).collect::<Option<_>>()?;
    let plans: Vec<Plan> = motions.iter().map(|scene| Plan::brief(scene)).collect();
    let runs = run::run_together(&motions, &plans, stop)?;
    scenes
        .iter()
        .zip(runs)
        .map(|((member, _), run)| kept(*member, run.outcome.clone(), &motion(&run), columns))
        .collect()
}

/// The numbers of a member, if it was not stopped.
fn kept(member: u64, outcome: Outcome, named: &[(String, f64)], columns: &[String]) -> Option<Member> {
    // Mostly each stands where the first member has it.
    let of = |(place, name): (usize, &String)| {
        let there = named.get(place).filter(|(other, _)| other == name);
        let found = there.or_else(|| named.iter().find(|(other, _)| other == name));
        found.map_or(f64::NAN, |(_, value)| *value)
    };
    let failure = match outcome {
        Outcome::Completed => None,
        Outcome::Interrupted => return None,
        Outcome::Failed(why) => Some(why.lines().next().unwrap_or_default().to_owned()),
    };
    Some(Member { member, failure, values: columns.iter().enumerate().map(of).collect() })
}
