//! Transforms of the lines of a grid between samples and modes, several lines at once.
//!
//! A panel holds eight lines: entry m has the samples m of all of them, one in each lane. The transforms are not
//! normalised: there and back multiplies by half the number of intervals.
//!
//! Slots: index i of sines and cosines is in slot i. At cells, slot 0 of sines holds index n. At nodes, slots 0 and N of
//! sines hold nothing.

mod cosine;
mod fft;
mod library;
mod nodal;
mod precision;

use piola_numerics::{Kernel, Lanes};
use rustfft::num_complex::Complex;

use crate::grid::PointLocation;
use crate::walls::Parity;
pub use precision::Precision;

use cosine::CosinePlan;
use library::LibraryPlan;
use nodal::NodalPlan;

/// Which way a transform goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    /// From samples to modes.
    ToModes,
    /// From modes to samples.
    ToSamples,
}

/// Lines that are transformed together.
pub(crate) const WIDTH: usize = 8;

/// The samples of all lines of a panel at one point.
pub(crate) type Line<T> = Lanes<T, WIDTH>;

/// The memory of a transform.
#[derive(Clone, Debug)]
pub(crate) struct TransformMemory<T> {
    lines: Vec<Line<T>>,
    complex: Vec<Complex<T>>,
}

impl<T> TransformMemory<T> {
    /// None yet: plans make it as large as they need.
    pub(crate) fn new() -> Self {
        Self { lines: Vec::new(), complex: Vec::new() }
    }
}

/// The planned transform of lines along one axis.
#[derive(Clone, Debug)]
pub(crate) struct LinePlan<T> {
    method: Method<T>,
}

#[derive(Clone, Debug)]
enum Method<T> {
    Cells(CosinePlan<T>),
    Nodes(NodalPlan<T>),
    Library(LibraryPlan<T>),
}

impl<T: Precision> LinePlan<T> {
    /// Plans transforms of lines of `points` samples.
    pub(crate) fn new(points: usize, location: PointLocation) -> Self {
        let in_lanes = match location {
            PointLocation::Cells => CosinePlan::new(points).map(Method::Cells),
            PointLocation::Nodes => NodalPlan::new(points - 1).map(Method::Nodes),
        };
        Self { method: in_lanes.unwrap_or_else(|| Method::Library(LibraryPlan::new(points, location))) }
    }

    /// Makes the memory large enough for this plan.
    pub(crate) fn prepare(&self, memory: &mut TransformMemory<T>) {
        let (lines, complex) = match &self.method {
            Method::Cells(plan) => (plan.scratch(), 0),
            Method::Nodes(plan) => (plan.scratch(), 0),
            Method::Library(plan) => (0, plan.scratch()),
        };
        let zero = T::lit(0.0);
        memory.lines.resize(lines.max(memory.lines.len()), Line::splat(zero));
        memory.complex.resize(complex.max(memory.complex.len()), Complex::new(zero, zero));
    }

    /// From samples to modes; or back, with index 0 (and N at nodes) of cosines, and index n of sines at cells, counted half.
    pub(crate) fn run(
        &self,
        direction: Direction,
        parity: Parity,
        panel: &mut [Line<T>],
        memory: &mut TransformMemory<T>,
    ) {
        match (&self.method, direction) {
            (Method::Library(plan), Direction::ToModes) => plan.to_modes(parity, panel, &mut memory.complex),
            (Method::Library(plan), Direction::ToSamples) => plan.to_samples(parity, panel, &mut memory.complex),
            _ => T::transform(InLanes { plan: self, direction, parity, panel, memory: &mut memory.lines }),
        }
    }
}

/// A transform of a panel in the processor's widest lanes.
///
/// The precisions run it in code that is compiled here, once for each, and not where a solver is used.
#[derive(Debug)]
pub struct InLanes<'a, T> {
    plan: &'a LinePlan<T>,
    direction: Direction,
    parity: Parity,
    panel: &'a mut [Line<T>],
    memory: &'a mut [Line<T>],
}

impl<T: Precision> Kernel for InLanes<'_, T> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self { plan, direction, parity, panel, memory } = self;
        match (&plan.method, direction) {
            (Method::Cells(plan), Direction::ToModes) => plan.to_modes(parity, panel, memory),
            (Method::Cells(plan), Direction::ToSamples) => plan.to_samples(parity, panel, memory),
            (Method::Nodes(plan), _) => plan.run(parity, panel, memory),
            (Method::Library(_), _) => {}
        }
    }
}

#[cfg(test)]
mod tests;
