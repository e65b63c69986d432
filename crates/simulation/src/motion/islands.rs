//! Independent parts of a mechanism, integrated one after the other, each with steps of its own, and recorded together.

use core::cmp::Ordering;
use core::ops::ControlFlow;

use piola_integrators::{Ending, Report};

use super::checkpoint::{CheckpointKeeper, MotionCheckpoint, Part};
use super::drive::{Driver, Keeper, Observer};
use super::{History, Invariants, Method, MotionRun, PartReaction, Progress, TimeSpan, Timetable, mechanism};
use crate::forces::ForceKind;
use crate::joints::{Island, Mechanism};

/// The islands of a mechanism that a method gains by: several, whose steps adapt.
pub(super) fn of(system: &Mechanism, method: Method) -> Option<Vec<Island>> {
    let adapts = matches!(method, Method::DormandPrince { .. } | Method::Verner { .. });
    let islands = if adapts && system.simplify { system.islands() } else { Vec::new() };
    (1 < islands.len()).then_some(islands)
}

/// Integrates the islands in their order. After one that is stopped or fails the others go on to the last instant that it has recorded,
/// so that the record of all holds these instants. The observer is not asked there, and steps are not counted.
pub(super) fn run(
    system: &Mechanism,
    islands: &[Island],
    method: Method,
    timetable: &Timetable,
    (mut keeper, mut resumed): (Option<Keeper<'_>>, Option<MotionCheckpoint>),
    observer: Observer<'_>,
) -> MotionRun {
    let mut done = resumed.as_mut().map(|checkpoint| core::mem::take(&mut checkpoint.0.body.done)).unwrap_or_default();
    let mut report = done.iter().fold(Report::begin(), |report, part| report.then(part.report));
    let span = timetable.span();
    let mut result = Ok(());
    // The last instant of an island that is stopped or fails.
    let mut until: Option<f64> = None;
    for island in &islands[done.len()..] {
        let (before, steps) = (done.len() as f64, report.steps);
        let mut progress = |one: Progress| {
            if let Some(until) = until {
                return if span.order(one.time, until).is_lt() {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                };
            }
            let fraction = (before + one.fraction) / islands.len() as f64;
            observer(Progress { time: one.time, fraction, steps: steps + one.steps })
        };
        let names = island.mechanism.parts.iter().map(|part| part.name.clone()).collect();
        let keeper: Option<Keeper<'_>> = keeper.as_mut().filter(|_| until.is_none()).map(|(keeper, marks)| {
            let keeper: &mut dyn CheckpointKeeper = &mut **keeper;
            (keeper, marks.clone())
        });
        let mut driver = Driver::new(names, timetable, &mut progress, (keeper, resumed.take())).after(done);
        let one = mechanism::mechanism(&island.mechanism, method, &mut driver);
        let (part, others) = driver.finish();
        if until.is_none() {
            report = report.then(part.report);
            if one.is_err() || part.report.ending == Ending::Stopped {
                until = Some(part.history.times.last().copied().unwrap_or(span.start));
            }
            result = one;
        }
        done = others;
        done.push(part);
    }
    MotionRun::of(together(system, islands, done, report, span), result)
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
    let columns: Vec<Columns> = islands.iter().map(|island| Columns::of(system, island)).collect();
    let rows = columns.iter().zip(&histories);
    history.work_names = system.work_names();
    let works = rows.clone().map(|(columns, own)| (&columns.works, &own.works));
    history.works = sums(history.work_names.len(), recorded, works);
    if system.questions.energies {
        history.energy_names = mechanism::energy_names(system);
        let energies = rows.clone().map(|(columns, own)| (&columns.energies, &own.energies));
        history.energies = sums(history.energy_names.len(), recorded, energies);
    }
    if system.reactions {
        history.condition_names = system.condition_names();
        let conditions = rows.map(|(columns, own)| (&columns.conditions, &own.conditions));
        history.conditions = sums(history.condition_names.len(), recorded, conditions);
    }
    history.singular_positions = histories.iter().flat_map(|own| own.singular_positions.iter().cloned()).collect();
    history.singular_positions.sort_by(|a, b| span.order(a.0, b.0));
    history.singular_positions.truncate(64);
    history.invariants = invariants(&histories, &history.times, span);
    Part { history, report, time }
}

/// The columns that those of an island have in tables of the whole: names need not be unique.
struct Columns {
    works: Vec<usize>,
    energies: Vec<usize>,
    conditions: Vec<usize>,
}

impl Columns {
    fn of(system: &Mechanism, island: &Island) -> Self {
        let forces = |holds: &dyn Fn(&ForceKind) -> bool| -> (Vec<usize>, usize) {
            let all: Vec<usize> = (0..system.forces.len()).filter(|i| holds(&system.forces[*i].kind)).collect();
            let own = island.forces.iter().filter_map(|force| all.iter().position(|other| other == force));
            (own.collect(), all.len())
        };
        let (mut works, working) = forces(&ForceKind::works);
        if island.mechanism.is_driven() {
            works.push(working);
        }
        let mut energies: Vec<usize> = island.parts.iter().flat_map(|part| [2 * part, 2 * part + 1]).collect();
        energies.extend(forces(&ForceKind::stores).0.into_iter().map(|place| 2 * system.parts.len() + place));
        let mut first = 0;
        let firsts = system.constraints.iter().map(|constraint| {
            first += constraint.kind.forces();
            first - constraint.kind.forces()
        });
        let firsts: Vec<usize> = firsts.collect();
        let own = island.constraints.iter().map(|i| firsts[*i]..firsts[*i] + system.constraints[*i].kind.forces());
        Self { works, energies, conditions: own.flatten().collect() }
    }
}

/// Rows of as many numbers, each the sum of those that the islands have for it.
fn sums<'h>(
    count: usize,
    recorded: usize,
    islands: impl Iterator<Item = (&'h Vec<usize>, &'h Vec<Vec<f64>>)>,
) -> Vec<Vec<f64>> {
    if count == 0 {
        return Vec::new();
    }
    let mut sums = vec![vec![0.0; count]; recorded];
    for (columns, rows) in islands {
        for (sum, row) in sums.iter_mut().zip(rows) {
            for (column, value) in columns.iter().zip(row) {
                sum[*column] += value;
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
