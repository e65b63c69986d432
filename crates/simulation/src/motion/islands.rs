//! Independent parts of a mechanism, integrated one after the other, each with steps of its own, and recorded together.

use core::cmp::Ordering;
use core::ops::ControlFlow;

use piola_integrators::{Ending, Report};

use super::checkpoint::{CheckpointKeeper, MotionCheckpoint, Part};
use super::drive::{Driver, Keeper, Observer};
use super::{History, Invariants, Method, MotionRun, PartReaction, Progress, TimeSpan, Timetable, mechanism};
use crate::joints::{Island, Mechanism};

/// The islands of a mechanism that a method gains by: several, whose steps adapt.
pub(super) fn of(system: &Mechanism, method: Method) -> Option<Vec<Island>> {
    let adapts = matches!(method, Method::DormandPrince { .. } | Method::Verner { .. });
    let islands = if adapts && system.simplify { system.islands() } else { Vec::new() };
    (1 < islands.len()).then_some(islands)
}

/// Integrates the islands in their order. After one that is stopped or fails the others record their start alone: the record of all
/// holds the instants that each has reached.
pub(super) fn run(
    system: &Mechanism,
    islands: &[Island],
    method: Method,
    timetable: &Timetable,
    (mut keeper, mut resumed): (Option<Keeper<'_>>, Option<MotionCheckpoint>),
    observer: Observer<'_>,
) -> MotionRun {
    let mut done = resumed.as_mut().map(|checkpoint| core::mem::take(&mut checkpoint.body.done)).unwrap_or_default();
    let mut report = done.iter().fold(Report::begin(), |report, part| report.then(part.report));
    let (mut result, mut halted) = (Ok(()), false);
    for island in &islands[done.len()..] {
        let (before, steps) = (done.len() as f64, report.steps);
        let mut progress = |one: Progress| {
            if halted {
                return ControlFlow::Break(());
            }
            let fraction = (before + one.fraction) / islands.len() as f64;
            observer(Progress { time: one.time, fraction, steps: steps + one.steps })
        };
        let names = island.mechanism.parts.iter().map(|part| part.name.clone()).collect();
        let keeper: Option<Keeper<'_>> = keeper.as_mut().filter(|_| !halted).map(|(keeper, marks)| {
            let keeper: &mut dyn CheckpointKeeper = &mut **keeper;
            (keeper, marks.clone())
        });
        let mut driver = Driver::new(names, timetable, &mut progress, (keeper, resumed.take())).after(done);
        let one = mechanism::mechanism(&island.mechanism, method, &mut driver);
        let (part, others) = driver.finish();
        if !halted {
            report = report.then(part.report);
        }
        halted |= one.is_err() || part.report.ending == Ending::Stopped;
        result = result.and(one);
        done = others;
        done.push(part);
    }
    MotionRun::of(together(system, islands, done, report, timetable.span()), result)
}

/// Islands as one.
fn together(system: &Mechanism, islands: &[Island], done: Vec<Part>, report: Report, span: TimeSpan) -> Part {
    let time = done.iter().map(|part| part.time).min_by(|a, b| span.order(*a, *b)).unwrap_or(span.start);
    let mut history = History {
        names: system.parts.iter().map(|part| part.name.clone()).collect(),
        coordinate_names: system.coordinates.clone(),
        ..History::default()
    };
    let recorded = done.iter().map(|part| part.history.times.len()).min().unwrap_or_default();
    let histories: Vec<History> = done.into_iter().map(|part| part.history).collect();
    history.times = histories.first().map(|history| history.times[..recorded].to_vec()).unwrap_or_default();
    let (parts, n) = (system.parts.len(), system.coordinates.len());
    history.positions = vec![vec![[0.0; 3]; parts]; recorded];
    history.coordinates = vec![vec![0.0; 2 * n]; recorded];
    let held = if system.reactions { recorded } else { 0 };
    history.reactions = vec![vec![PartReaction { force: [0.0; 3], moment: [0.0; 3] }; parts]; held];
    for (island, own) in islands.iter().zip(&histories) {
        let m = island.coordinates.len();
        for record in 0..recorded {
            for (part, place) in island.parts.iter().zip(&own.positions[record]) {
                history.positions[record][*part] = *place;
            }
            for (i, coordinate) in island.coordinates.iter().enumerate() {
                history.coordinates[record][*coordinate] = own.coordinates[record][i];
                history.coordinates[record][n + coordinate] = own.coordinates[record][m + i];
            }
            for (part, reaction) in island.parts.iter().zip(own.reactions.get(record).into_iter().flatten()) {
                history.reactions[record][*part] = *reaction;
            }
        }
    }
    history.work_names = system.work_names();
    history.works = sums(&history.work_names, &histories, recorded, |own| (&own.work_names, &own.works));
    if system.questions.energies {
        history.energy_names = mechanism::energy_names(system);
        history.energies = sums(&history.energy_names, &histories, recorded, |own| (&own.energy_names, &own.energies));
    }
    if system.reactions {
        history.condition_names = system.condition_names();
        history.conditions =
            sums(&history.condition_names, &histories, recorded, |own| (&own.condition_names, &own.conditions));
    }
    history.singular_positions = histories.iter().flat_map(|own| own.singular_positions.iter().cloned()).collect();
    history.singular_positions.sort_by(|a, b| span.order(a.0, b.0));
    history.singular_positions.truncate(64);
    history.invariants = invariants(&histories, &history.times, span);
    Part { history, report, time }
}

/// Rows of numbers with names, each the sum of those of its name.
fn sums(
    names: &[String],
    histories: &[History],
    recorded: usize,
    of: impl for<'h> Fn(&'h History) -> (&'h Vec<String>, &'h Vec<Vec<f64>>),
) -> Vec<Vec<f64>> {
    if names.is_empty() {
        return Vec::new();
    }
    let mut sums = vec![vec![0.0; names.len()]; recorded];
    for own in histories {
        let (own_names, rows) = of(own);
        for (column, name) in own_names.iter().enumerate() {
            let Some(place) = names.iter().position(|other| other == name) else { continue };
            for (sum, row) in sums.iter_mut().zip(rows) {
                sum[place] += row[column];
            }
        }
    }
    sums
}

/// The invariants of all islands at each instant, each at the end of the step of its own that the instant falls into; the time is
/// the last of these.
fn invariants(histories: &[History], times: &[f64], span: TimeSpan) -> Vec<Invariants> {
    let mut places = vec![0; histories.len()];
    let mut all: Vec<Invariants> = Vec::with_capacity(times.len());
    for (record, &instant) in times.iter().enumerate() {
        let mut moved = record == 0;
        let mut sum: Option<Invariants> = None;
        for (own, place) in histories.iter().zip(&mut places) {
            let passed = |at: &Invariants| span.order(at.time, instant).is_lt();
            while own.invariants.get(*place).is_some_and(passed) && *place + 1 < own.invariants.len() {
                *place += 1;
                moved = true;
            }
            let Some(one) = own.invariants.get(*place) else { continue };
            sum = Some(sum.map_or(*one, |sum| Invariants {
                time: if span.order(sum.time, one.time) == Ordering::Less { one.time } else { sum.time },
                energy: sum.energy + one.energy,
                work: sum.work + one.work,
                energy_scale: sum.energy_scale + one.energy_scale,
                ..sum
            }));
        }
        all.extend(sum.filter(|_| moved));
    }
    all
}
