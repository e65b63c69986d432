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

use piola_numerics::Lanes;
use rustfft::num_complex::Complex;

use crate::Precision;
use crate::grid::PointLocation;
use crate::walls::Parity;

use cosine::CosinePlan;
use library::LibraryPlan;
use nodal::NodalPlan;

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

    /// From samples to modes.
    #[inline(always)]
    pub(crate) fn to_modes(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut TransformMemory<T>) {
        match &self.method {
            Method::Cells(plan) => plan.to_modes(parity, panel, &mut memory.lines),
            Method::Nodes(plan) => plan.run(parity, panel, &mut memory.lines),
            Method::Library(plan) => plan.to_modes(parity, panel, &mut memory.complex),
        }
    }

    /// From modes to samples, with index 0 (and N at nodes) of cosines, and index n of sines at cells, counted half.
    #[inline(always)]
    pub(crate) fn to_samples(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut TransformMemory<T>) {
        match &self.method {
            Method::Cells(plan) => plan.to_samples(parity, panel, &mut memory.lines),
            Method::Nodes(plan) => plan.run(parity, panel, &mut memory.lines),
            Method::Library(plan) => plan.to_samples(parity, panel, &mut memory.complex),
        }
    }
}

#[cfg(test)]
mod tests;
