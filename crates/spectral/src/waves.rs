//! Wave numbers and weights of the slots along one axis.

use crate::Precision;
use crate::grid::{BoxGrid, PointLocation};
use crate::transform::WIDTH;
use crate::walls::Parity;

/// Wave numbers and weights of the slots along one axis, padded to whole panels.
#[derive(Clone, Debug)]
pub(crate) struct AxisWaves<T> {
    /// iπ/L.
    pub(crate) wave: Vec<T>,
    /// 2/n where the mode is kept, else 0: n/2 is what the transforms there and back multiply by.
    pub(crate) weight: Vec<T>,
    points: usize,
    first: f64,
    scale: f64,
    highest: usize,
    location: PointLocation,
}

impl<T: Precision> AxisWaves<T> {
    /// All modes up to index `highest` are kept.
    pub(crate) fn new<const D: usize>(grid: &BoxGrid<D>, axis: usize, highest: usize) -> Self {
        let points = grid.points()[axis];
        let first = grid.first_wave_number(axis);
        let scale = 2.0 / grid.intervals(axis) as f64;
        let slots = points.next_multiple_of(WIDTH);
        let wave = (0..slots).map(|slot| T::lit(first * slot.max(usize::from(points <= slot)) as f64)).collect();
        let weight =
            (0..slots).map(|slot| T::lit(if slot < points && slot <= highest { scale } else { 0.0 })).collect();
        Self { wave, weight, points, first, scale, highest, location: grid.location() }
    }

    /// True where a sine has another index than a cosine, or no mode.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn is_special(&self, slot: usize) -> bool {
        slot == 0 || (self.location == PointLocation::Nodes && slot + 1 == self.points)
    }

    /// The index of the mode in a slot: `None` where there is none.
    pub(crate) fn index(&self, slot: usize, parity: Parity) -> Option<usize> {
        match (parity, self.location) {
            (Parity::Sine, PointLocation::Nodes) if self.is_special(slot) => None,
            (Parity::Sine, PointLocation::Cells) if slot == 0 => Some(self.points),
            _ => Some(slot),
        }
    }

    /// The weight of an index.
    pub(crate) fn weight_of(&self, index: usize) -> T {
        T::lit(if index <= self.highest { self.scale } else { 0.0 })
    }

    /// The wave number of an index.
    pub(crate) fn wave_of(&self, index: usize) -> T {
        T::lit(self.first * index as f64)
    }

    /// What a derivative multiplies the result of a transform by, with the transform back.
    pub(crate) fn derivative(&self, slot: usize) -> T {
        T::lit(self.scale * self.first * slot as f64)
    }

    /// What the result of a transform to modes must be multiplied by to give the amplitude of an index.
    pub(crate) fn amplitude(&self, index: usize, parity: Parity) -> f64 {
        let is_end = match self.location {
            PointLocation::Cells => index == 0 || index == self.points,
            PointLocation::Nodes => parity == Parity::Cosine && (index == 0 || index + 1 == self.points),
        };
        if is_end { 0.5 * self.scale } else { self.scale }
    }
}
