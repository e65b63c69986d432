//! Passes over the grid: transforms within slabs of equal first index, and along the first axis with the solution between.
//!
//! Memory is the limit, so each pass does all that it can with the lines it has loaded: a slab of a box fits the cache
//! beside a core and is transformed along both of its axes; the lines along the first axis are transformed, solved for and
//! transformed back in one go. Eight lines lie side by side in the lanes of a panel.

use piola_numerics::{Kernel, dispatch};

use crate::Precision;
use crate::error::SpectralError;
use crate::modal::{Modes, load};
use crate::transform::{Direction, Line, LinePlan, TransformMemory, WIDTH};
use crate::walls::Walls;

/// Panels that a pass along the first axis loads together. Its rows lie far apart: four lines of the cache from each at
/// once take half of the time of one line at once. All of them stay in the cache beside a core.
const GROUP: usize = 4;

/// What a pass along the first axis does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Task {
    /// To modes.
    Analyse,
    /// To modes, the solution for each, to samples.
    Solve,
    /// To samples.
    Synthesise,
}

/// Planned transforms along all axes.
#[derive(Clone, Debug)]
pub(crate) struct Plans<T, const D: usize> {
    pub(crate) lines: [LinePlan<T>; D],
    pub(crate) points: [usize; D],
    pub(crate) walls: Walls,
}

/// The memory of one thread.
#[derive(Clone, Debug)]
pub(crate) struct Memory<T> {
    panels: Vec<Line<T>>,
    transform: TransformMemory<T>,
}

impl<T> Memory<T> {
    /// A panel and the memory of its transforms.
    pub(crate) fn parts(&mut self, points: usize) -> (&mut [Line<T>], &mut TransformMemory<T>) {
        (&mut self.panels[..points], &mut self.transform)
    }
}

impl<T: Precision, const D: usize> Plans<T, D> {
    /// The samples of a slab: a plane of a box, or up to eight lines of a rectangle.
    fn slab(&self) -> usize {
        if D == 3 { self.points[1] * self.points[2] } else { WIDTH * self.points[1] }
    }

    /// Columns along the first axis that are treated as one piece of work.
    fn piece(&self) -> usize {
        if D == 3 { self.points[D - 1] } else { 8 * WIDTH }
    }

    pub(crate) fn memory(&self) -> Memory<T> {
        let zero = T::lit(0.0);
        let longest = self.points.iter().copied().max().unwrap_or(0);
        let mut transform = TransformMemory::new();
        for plan in &self.lines {
            plan.prepare(&mut transform);
        }
        Memory { panels: vec![Line::splat(zero); D * GROUP * longest], transform }
    }

    /// Transforms within slabs. With `name`, refuses samples that are not finite.
    pub(crate) fn pass_in_slabs(
        &self,
        component: usize,
        direction: Direction,
        field: &mut [T],
        name: Option<&'static str>,
        memory: &mut Memory<T>,
    ) -> Result<(), SpectralError> {
        let slab = self.slab();
        #[cfg(feature = "rayon")]
        if self.is_parallel() {
            use rayon::prelude::*;
            return field
                .par_chunks_mut(slab)
                .enumerate()
                .map_init(
                    || self.memory(),
                    |memory, (index, samples)| {
                        self.one_slab(component, direction, samples, name.map(|name| (name, index * slab)), memory)
                    },
                )
                .reduce(|| Ok(()), Result::and);
        }
        for (index, samples) in field.chunks_mut(slab).enumerate() {
            self.one_slab(component, direction, samples, name.map(|name| (name, index * slab)), memory)?;
        }
        Ok(())
    }

    fn one_slab(
        &self,
        component: usize,
        direction: Direction,
        samples: &mut [T],
        named: Option<(&'static str, usize)>,
        memory: &mut Memory<T>,
    ) -> Result<(), SpectralError> {
        if let Some((quantity, offset)) = named
            && !dispatch(AllFinite(samples))
        {
            let position = samples.iter().position(|value| !value.primal(0).is_finite()).unwrap_or(0);
            let value = samples[position].primal(0);
            return Err(SpectralError::NotFinite { quantity, index: offset + position, value });
        }
        dispatch(Slab { plans: self, component, direction, samples, memory });
        Ok(())
    }

    /// Transforms along the first axis, and solves.
    pub(crate) fn pass_along_first(
        &self,
        task: Task,
        modes: &Modes<T, D>,
        fields: [&mut [T]; D],
        memory: &mut Memory<T>,
    ) {
        #[cfg(feature = "rayon")]
        if self.is_parallel() {
            use rayon::prelude::*;
            let per_slab = self.points[1..].iter().product::<usize>();
            let pieces = per_slab.div_ceil(self.piece());
            // The pieces of rows that each piece of work owns, by component and first index.
            let mut owned: Vec<[Vec<&mut [T]>; D]> =
                (0..pieces).map(|_| std::array::from_fn(|_| Vec::with_capacity(self.points[0]))).collect();
            for (component, field) in fields.into_iter().enumerate() {
                for slab in field.chunks_mut(per_slab) {
                    for (owned, row) in owned.iter_mut().zip(slab.chunks_mut(self.piece())) {
                        owned[component].push(row);
                    }
                }
            }
            owned.into_par_iter().enumerate().for_each_init(
                || self.memory(),
                |memory, (piece, mut rows)| {
                    let rows = Pieces { rows: &mut rows };
                    dispatch(Columns { plans: self, task, modes, piece, rows, memory });
                },
            );
            return;
        }
        let per_slab = self.points[1..].iter().product::<usize>();
        let mut fields = fields;
        for piece in 0..per_slab.div_ceil(self.piece()) {
            let start = piece * self.piece();
            let end = (start + self.piece()).min(per_slab);
            let rows = Strided { fields: &mut fields, per_slab, start, end };
            dispatch(Columns { plans: self, task, modes, piece, rows, memory });
        }
    }

    /// Enough points to be worth the threads.
    #[cfg(feature = "rayon")]
    fn is_parallel(&self) -> bool {
        PARALLEL_POINTS <= self.points.iter().product() && 1 < rayon::current_num_threads()
    }
}

/// Points from which on, with feature `rayon`, all cores share the work.
#[cfg(feature = "rayon")]
const PARALLEL_POINTS: usize = 1 << 14;

struct AllFinite<'a, T>(&'a [T]);

impl<T: Precision> Kernel for AllFinite<'_, T> {
    type Output = bool;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> bool {
        let zero = T::lit(0.0);
        // x·0 is zero for numbers and NaN for the rest.
        let mut sum = Line::splat(zero);
        for first in (0..self.0.len()).step_by(WIDTH) {
            sum += load(self.0, first) * Line::splat(zero);
        }
        sum.0.iter().all(|sum| *sum == zero)
    }
}

struct Slab<'a, T, const D: usize> {
    plans: &'a Plans<T, D>,
    component: usize,
    direction: Direction,
    samples: &'a mut [T],
    memory: &'a mut Memory<T>,
}

impl<T: Precision, const D: usize> Kernel for Slab<'_, T, D> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let plans = self.plans;
        let last = plans.points[D - 1];
        let transform = &mut self.memory.transform;
        let panel = &mut self.memory.panels[..last];
        let parity = plans.walls.parity(self.component, D - 1);
        for rows in self.samples.chunks_mut(WIDTH * last) {
            gather_rows(rows, last, panel);
            plans.lines[D - 1].run(self.direction, parity, panel, transform);
            scatter_rows(panel, last, rows);
        }
        if D == 3 {
            let rows = plans.points[1];
            let panel = &mut self.memory.panels[..rows];
            let parity = plans.walls.parity(self.component, 1);
            for first in (0..last).step_by(WIDTH) {
                for (entry, row) in panel.iter_mut().zip(self.samples.chunks_exact(last)) {
                    *entry = load(row, first);
                }
                plans.lines[1].run(self.direction, parity, panel, transform);
                for (entry, row) in panel.iter().zip(self.samples.chunks_exact_mut(last)) {
                    save(*entry, row, first);
                }
            }
        }
    }
}

/// Up to eight rows side by side; eight whole rows by squares, which machines with wide registers transpose in them.
#[cfg_attr(not(debug_assertions), inline(always))]
fn gather_rows<T: Precision>(rows: &[T], length: usize, panel: &mut [Line<T>]) {
    let squares = whole_squares(rows.len(), length);
    let (whole, _) = panel.as_chunks_mut::<WIDTH>();
    for (square, entries) in whole.iter_mut().enumerate().take(squares) {
        let records = std::array::from_fn(|lane| &rows[lane * length..(lane + 1) * length].as_chunks().0[square]);
        Line::gather::<WIDTH, 1>(records, entries);
    }
    for (lane, row) in rows.chunks_exact(length).enumerate() {
        for (entry, value) in panel.iter_mut().zip(row).skip(squares * WIDTH) {
            entry.0[lane] = *value;
        }
    }
}

/// The inverse of [`gather_rows`].
#[cfg_attr(not(debug_assertions), inline(always))]
fn scatter_rows<T: Precision>(panel: &[Line<T>], length: usize, rows: &mut [T]) {
    let squares = whole_squares(rows.len(), length);
    let (whole, _) = panel.as_chunks::<WIDTH>();
    for (square, entries) in whole.iter().enumerate().take(squares) {
        let mut rest = &mut *rows;
        let records = std::array::from_fn(|_| {
            let (row, after) = std::mem::take(&mut rest).split_at_mut(length);
            rest = after;
            &mut row.as_chunks_mut().0[square]
        });
        Line::scatter::<WIDTH, 1>(entries, records);
    }
    for (lane, row) in rows.chunks_exact_mut(length).enumerate() {
        for (entry, value) in panel.iter().zip(row).skip(squares * WIDTH) {
            *value = entry.0[lane];
        }
    }
}

/// How many squares each of eight whole rows has; none where rows are missing.
#[cfg_attr(not(debug_assertions), inline(always))]
fn whole_squares(samples: usize, length: usize) -> usize {
    if samples == WIDTH * length { length / WIDTH } else { 0 }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn save<T: Precision>(entry: Line<T>, row: &mut [T], first: usize) {
    match row.get_mut(first..first + WIDTH) {
        Some(whole) => whole.copy_from_slice(&entry.0),
        None => entry.store(&mut row[first..]),
    }
}

/// The rows of a piece of columns.
trait Rows<T> {
    fn row(&mut self, component: usize, index: usize) -> &mut [T];
}

struct Strided<'a, 'f, T, const D: usize> {
    fields: &'a mut [&'f mut [T]; D],
    per_slab: usize,
    start: usize,
    end: usize,
}

impl<T, const D: usize> Rows<T> for Strided<'_, '_, T, D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn row(&mut self, component: usize, index: usize) -> &mut [T] {
        let offset = index * self.per_slab;
        &mut self.fields[component][offset + self.start..offset + self.end]
    }
}

#[cfg(feature = "rayon")]
struct Pieces<'a, 'f, T, const D: usize> {
    rows: &'a mut [Vec<&'f mut [T]>; D],
}

#[cfg(feature = "rayon")]
impl<T, const D: usize> Rows<T> for Pieces<'_, '_, T, D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn row(&mut self, component: usize, index: usize) -> &mut [T] {
        self.rows[component][index]
    }
}

struct Columns<'a, T, R, const D: usize> {
    plans: &'a Plans<T, D>,
    task: Task,
    modes: &'a Modes<T, D>,
    piece: usize,
    rows: R,
    memory: &'a mut Memory<T>,
}

impl<T: Precision, R: Rows<T>, const D: usize> Kernel for Columns<'_, T, R, D> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self { plans, task, modes, piece, mut rows, memory } = self;
        let points = plans.points[0];
        let width = rows.row(0, 0).len();
        let plan = &plans.lines[0];
        for start in (0..width).step_by(GROUP * WIDTH) {
            let group = (width - start).div_ceil(WIDTH).min(GROUP);
            for component in 0..D {
                let parity = plans.walls.parity(component, 0);
                let panels = &mut memory.panels[component * GROUP * points..][..group * points];
                for index in 0..points {
                    let row = rows.row(component, index);
                    for (k, panel) in panels.chunks_exact_mut(points).enumerate() {
                        panel[index] = load(row, start + k * WIDTH);
                    }
                }
                if task != Task::Synthesise {
                    for panel in panels.chunks_exact_mut(points) {
                        plan.run(Direction::ToModes, parity, panel, &mut memory.transform);
                    }
                }
            }
            if task == Task::Solve {
                for k in 0..group {
                    let mut panels = memory.panels.chunks_exact_mut(points).skip(k).step_by(GROUP);
                    let mut panels = std::array::from_fn(|_| panels.next().unwrap_or_default());
                    let first = start + k * WIDTH;
                    let (row, first) = if D == 3 { (piece, first) } else { (0, piece * plans.piece() + first) };
                    modes.solve_panel(row, first, &mut panels);
                }
            }
            for component in 0..D {
                let parity = plans.walls.parity(component, 0);
                let panels = &mut memory.panels[component * GROUP * points..][..group * points];
                if task != Task::Analyse {
                    for panel in panels.chunks_exact_mut(points) {
                        plan.run(Direction::ToSamples, parity, panel, &mut memory.transform);
                    }
                }
                for index in 0..points {
                    let row = rows.row(component, index);
                    for (k, panel) in panels.chunks_exact(points).enumerate() {
                        save(panel[index], row, start + k * WIDTH);
                    }
                }
            }
        }
    }
}
