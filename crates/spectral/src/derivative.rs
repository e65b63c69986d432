//! Derivatives of sampled fields along an axis, by their modes.

use crate::Precision;
use crate::modal::load;
use crate::passes::{Memory, Plans, save};
use crate::transform::{Direction, Line, WIDTH};
use crate::walls::Parity;
use crate::waves::AxisWaves;

impl<T: Precision, const D: usize> Plans<T, D> {
    /// ∂/∂x of one component along an axis, exact for the sum of modes that interpolates the samples.
    pub(crate) fn differentiate(
        &self,
        waves: &AxisWaves<T>,
        component: usize,
        axis: usize,
        from: &[T],
        into: &mut [T],
        memory: &mut Memory<T>,
    ) {
        let parity = self.walls.parity(component, axis);
        let points = self.points[axis];
        let stride: usize = self.points[axis + 1..].iter().product();
        let (panel, transform) = memory.parts(points);
        let mut along = |panel: &mut [Line<T>]| {
            self.lines[axis].run(Direction::ToModes, parity, panel, transform);
            for (slot, entry) in panel.iter_mut().enumerate() {
                let factor = if waves.is_special(slot) { T::lit(0.0) } else { waves.derivative(slot) };
                let factor = if parity == Parity::Cosine { -factor } else { factor };
                *entry *= Line::splat(factor);
            }
            self.lines[axis].run(Direction::ToSamples, parity.flipped(), panel, transform);
        };
        if stride == 1 {
            for (from, into) in from.chunks(WIDTH * points).zip(into.chunks_mut(WIDTH * points)) {
                for (lane, row) in from.chunks_exact(points).enumerate() {
                    for (entry, value) in panel.iter_mut().zip(row) {
                        entry.0[lane] = *value;
                    }
                }
                along(panel);
                for (lane, row) in into.chunks_exact_mut(points).enumerate() {
                    for (entry, value) in panel.iter().zip(row) {
                        *value = entry.0[lane];
                    }
                }
            }
            return;
        }
        for (from, into) in from.chunks_exact(points * stride).zip(into.chunks_exact_mut(points * stride)) {
            for first in (0..stride).step_by(WIDTH) {
                for (entry, row) in panel.iter_mut().zip(from.chunks_exact(stride)) {
                    *entry = load(row, first);
                }
                along(panel);
                for (entry, row) in panel.iter().zip(into.chunks_exact_mut(stride)) {
                    save(*entry, row, first);
                }
            }
        }
    }
}
