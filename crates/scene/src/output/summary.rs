//! `summary.json`: the numbers of a run.

use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::model::{PhaseSystem, Scene, System};
use crate::plan::{Item, Method, Plan, method_summary};
use crate::run::{Answers, Drift, Outcome, Run};
use piola_simulation::phase::{BracketQuestion, PhaseAnswers};
use piola_simulation::questions::{MechanismMode, Stability};

/// The numbers of a run.
///
/// A drift is `null` where the invariant is not conserved, or where it is not a finite number.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Summary {
    /// Name of the scene.
    pub name: String,
    /// `completed`, `interrupted` or `failed`.
    pub status: String,
    /// Why the run failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
    /// Name of the method.
    pub method: String,
    /// The method with its order, step or tolerance.
    #[serde(serialize_with = "method_summary")]
    pub method_details: Method,
    /// Why this method.
    pub method_reason: String,
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and rejected.
    pub rejected_steps: u64,
    /// Evaluations of the forces.
    pub force_evaluations: u64,
    /// Wall time of the integration, s.
    pub wall_time_s: f64,
    /// Start, s.
    pub start_s: f64,
    /// Time reached, s.
    pub reached_s: f64,
    /// End as planned, s.
    pub end_s: f64,
    /// Drift of the invariants.
    pub invariants: Value,
    /// Works of the forces of a mechanism at the time reached, J, by name.
    #[serde(rename = "works_J", skip_serializing_if = "Map::is_empty")]
    pub works: Map<String, Value>,
    /// Singular positions of the constraints that a mechanism went through.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub singular_positions: Vec<Value>,
    /// Answers to the questions of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answers: Option<Value>,
    /// Errors against the reference.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<Value>,
    /// Quantities that the plan skipped.
    pub skipped: Vec<Item>,
}

impl Summary {
    /// The summary of a run.
    #[must_use]
    pub fn of(scene: &Scene, plan: &Plan, run: &Run) -> Self {
        let (status, failure) = match &run.outcome {
            Outcome::Completed => ("completed", None),
            Outcome::Interrupted => ("interrupted", None),
            Outcome::Failed(why) => ("failed", Some(why.clone())),
        };
        Self {
            name: scene.name.clone(),
            status: status.to_string(),
            failure,
            method: plan.method.to_string(),
            method_details: plan.method,
            method_reason: plan.reason.clone(),
            steps: run.steps,
            rejected_steps: run.rejected,
            force_evaluations: run.force_evaluations,
            wall_time_s: run.wall_time,
            start_s: plan.start,
            reached_s: run.time,
            end_s: plan.end,
            invariants: invariants(run),
            works: works(run),
            singular_positions: singular_positions(run),
            answers: run.answers.as_ref().map(|found| answers(scene, run, found)),
            reference: reference(run),
            skipped: plan.skipped.clone(),
        }
    }

    /// The summary as JSON text.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Nothing in a summary can fail to serialise: numbers that are not finite become null.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

/// The answers without what their tables hold.
fn answers(scene: &Scene, run: &Run, found: &Answers) -> Value {
    match found {
        Answers::Phase(answers) => {
            let mut told = Map::new();
            if let Some(crossings) = &answers.crossings {
                told.insert("crossings".into(), json!(crossings.len()));
            }
            if let Some(exponent) = answers.exponent {
                told.insert("largest_exponent_1_per_s".into(), json!(exponent));
            }
            if let System::Phase(system) = &scene.system {
                told.extend(phase_structure(system, run, answers));
            }
            Value::Object(told)
        }
        Answers::Mechanism(Err(why)) => json!({ "equilibrium": null, "failure": why }),
        Answers::Mechanism(Ok(answers)) => {
            let names = run.history.coordinate_names.iter().cloned();
            let coordinates: Map<String, Value> = names.zip(answers.coordinates.iter().map(|q| json!(q))).collect();
            let mode = |mode: &MechanismMode| json!({ "angular_frequency_rad_per_s": mode.angular_frequency, "growth_rate_1_per_s": mode.growth_rate });
            json!({
                "equilibrium": coordinates,
                "residual": answers.residual,
                "stability": stability(answers.stability),
                "modes": answers.modes.iter().map(mode).collect::<Vec<_>>(),
            })
        }
    }
}

/// Relative residual up to which a change of variables counts as canonical: rounding of its Jacobian.
const CANONICAL: f64 = 1e-12;

/// Brackets at the start and their largest sizes, and whether the new variables are canonical: `null` if none of the tested instants
/// speaks against it but the run is not complete.
fn phase_structure(system: &PhaseSystem, run: &Run, answers: &PhaseAnswers) -> Map<String, Value> {
    let mut told = Map::new();
    if let Some(start) = answers.brackets.first() {
        let of = |(i, bracket): (usize, &BracketQuestion)| {
            let largest = answers.brackets.iter().map(|row| row[i].abs()).fold(0.0, f64::max);
            (bracket.name.clone(), json!({ "at_start": start[i], "largest_magnitude": largest }))
        };
        let brackets: Map<String, Value> = system.questions.brackets.iter().enumerate().map(of).collect();
        told.insert("brackets".into(), Value::Object(brackets));
    }
    if let Some((t, test)) = answers.canonical {
        let holds = test.relative <= CANONICAL;
        let known = !holds || matches!(run.outcome, Outcome::Completed);
        let worst = json!({
            "is_canonical": known.then_some(holds),
            "largest_relative_residual": test.relative,
            "at_time_s": t,
        });
        told.insert("new_coordinates".into(), worst);
    }
    told
}

/// What becomes of a small disturbance, in words.
#[must_use]
pub fn stability(stability: Stability) -> &'static str {
    match stability {
        Stability::Asymptotic => "asymptotically stable",
        Stability::Stable => "stable",
        Stability::Unstable => "unstable",
        _ => "marginal",
    }
}

fn singular_positions(run: &Run) -> Vec<Value> {
    let told = |(t, name): &(f64, String)| json!({ "time_s": t, "constraint": name });
    run.history.singular_positions.iter().map(told).collect()
}

fn works(run: &Run) -> Map<String, Value> {
    let last = run.history.works.last().into_iter().flatten();
    run.history.work_names.iter().cloned().zip(last.map(|work| json!(work))).collect()
}

fn invariants(run: &Run) -> Value {
    let drift = |drift: Option<Drift>| match drift {
        Some(drift) => json!({ "max_relative_drift": drift.max_relative, "last_relative_drift": drift.last_relative }),
        None => json!({ "max_relative_drift": null, "conserved": false }),
    };
    let mut invariants = json!({
        "energy": drift(run.drifts.energy),
        "momentum": drift(run.drifts.momentum),
        "angular_momentum": drift(run.drifts.angular_momentum),
    });
    if run.drifts.post_newtonian_energy.is_some() {
        invariants["post_newtonian_energy"] = drift(run.drifts.post_newtonian_energy);
    }
    invariants
}

fn reference(run: &Run) -> Option<Value> {
    let errors = run.errors.as_ref()?;
    let by_body: Map<String, Value> = errors
        .bodies
        .iter()
        .map(|body| {
            let errors = json!({
                "max_relative_error": body.largest_relative,
                "max_error_m": body.largest,
                "last_relative_error": body.at.last().map(|last| last.relative),
            });
            (body.name.clone(), errors)
        })
        .collect();
    Some(json!({ "label": errors.label, "max_relative_error": errors.largest_relative, "by_body": by_body }))
}
