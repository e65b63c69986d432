//! Errors against a reference.

use super::History;
use crate::model::{ClosedForm, ReferenceKind, Scene};

/// Errors of all bodies.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Errors {
    /// Name of the reference.
    pub label: String,
    /// The largest relative error of any body.
    pub largest_relative: f64,
    /// Errors by body; a body that distances are measured from is not among them.
    pub bodies: Vec<BodyErrors>,
}

/// Errors of one body.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BodyErrors {
    /// Index of the body.
    pub body: usize,
    /// Name of the body.
    pub name: String,
    /// The largest error of position, m.
    pub largest: f64,
    /// The largest relative error of position.
    pub largest_relative: f64,
    /// Errors at each instant.
    pub at: Vec<ErrorAt>,
}

/// The error of a position at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorAt {
    /// Time, s.
    pub time: f64,
    /// `|x − x_ref|`, m.
    pub error: f64,
    /// With a body c to measure from, `|(x − c) − (x_ref − c_ref)| / |x_ref − c_ref|`; otherwise the error over the largest distance
    /// of the reference from the origin, or over the semi-major axis with the closed form.
    pub relative: f64,
}

/// Positions of the reference at one recorded instant.
type Known = Vec<(usize, [f64; 3])>;

pub(super) fn errors(scene: &Scene, history: &History) -> Option<Errors> {
    let reference = scene.reference.as_ref()?;
    let known: Vec<(usize, Known)> = match &reference.kind {
        ReferenceKind::Table(table) => table
            .times
            .iter()
            .zip(&table.positions)
            .filter_map(|(t, known)| {
                // Recorded instants stand within rounding of the reference's.
                let (near, slack) = (t - scene.time.direction() * scene.time.slack(), scene.time.slack());
                let record = history.times.partition_point(|time| scene.time.order(*time, near).is_lt());
                history.times.get(record).filter(|time| (*time - t).abs() <= slack)?;
                Some((record, known.clone()))
            })
            .collect(),
        ReferenceKind::ClosedForm(ClosedForm::Kepler(motions)) => history
            .times
            .iter()
            .enumerate()
            .map(|(record, t)| {
                let at = |motion: &piola_gravitation::kepler::KeplerMotion| motion.position(t - scene.time.start);
                (record, motions.iter().map(at).enumerate().collect())
            })
            .collect(),
    };
    let overall = known.iter().flat_map(|(_, known)| known).map(|(_, x)| distance(*x, [0.0; 3])).fold(0.0, f64::max);
    // The relative error of one position; `None` where the reference lacks the body to measure from.
    let relative = |record: usize, body: usize, expected: [f64; 3], known: &Known| {
        let position = history.positions[record][body];
        let scale = match (reference.relative_to, &reference.kind) {
            (Some(centre), _) => {
                let (_, origin) = known.iter().find(|(other, _)| *other == centre)?;
                let moved = difference(history.positions[record][centre], *origin);
                let error = distance(difference(position, expected), moved);
                return Some(error / distance(expected, *origin));
            }
            (None, ReferenceKind::ClosedForm(ClosedForm::Kepler(motions))) => motions[body].semi_major_axis(),
            (None, ReferenceKind::Table(_)) => overall,
        };
        Some(distance(position, expected) / scale)
    };
    let mut bodies: Vec<BodyErrors> = Vec::new();
    for (body, name) in history.names.iter().enumerate() {
        if reference.relative_to == Some(body) {
            continue;
        }
        let mut at = Vec::new();
        for (record, known) in &known {
            let Some((_, expected)) = known.iter().find(|(other, _)| *other == body) else { continue };
            let Some(relative) = relative(*record, body, *expected, known) else { continue };
            let error = distance(history.positions[*record][body], *expected);
            at.push(ErrorAt { time: history.times[*record], error, relative });
        }
        if at.is_empty() {
            continue;
        }
        let largest = |pick: fn(&ErrorAt) -> f64| at.iter().map(pick).fold(0.0, larger);
        bodies.push(BodyErrors {
            body,
            name: name.clone(),
            largest: largest(|e| e.error),
            largest_relative: largest(|e| e.relative),
            at,
        });
    }
    let largest_relative = bodies.iter().map(|body| body.largest_relative).fold(0.0, larger);
    Some(Errors { label: reference.label.clone(), largest_relative, bodies })
}

/// The larger of two; what is not a number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b < a { a } else { b }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    difference(a, b).iter().map(|x| x * x).sum::<f64>().sqrt()
}
