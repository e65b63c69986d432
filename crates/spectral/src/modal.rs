//! The solution for each wave number: two or three linear equations, solved by their structure.
//!
//! ```text
//! u = f/(−κ_t) + q (q·f)/q² (1/(−κ_l) − 1/(−κ_t))
//! ```
//! `κ_l` and `κ_t` are the eigenvalues along and across the wave vector q. No eigenfunction is formed.

use piola_numerics::Lanes;

use crate::Precision;
use crate::operator::BoxOperator;
use crate::transform::{Line, WIDTH};
use crate::walls::Walls;
use crate::waves::AxisWaves;

/// The modes of a grid with an operator.
#[derive(Clone, Debug)]
pub(crate) struct Modes<T, const D: usize> {
    pub(crate) axes: [AxisWaves<T>; D],
    pub(crate) walls: Walls,
    /// The compliance across q, times q^(2 order), and what that along q exceeds it by.
    compliances: [T; 2],
    is_plate: bool,
}

impl<T: Precision, const D: usize> Modes<T, D> {
    pub(crate) fn new(axes: [AxisWaves<T>; D], walls: Walls, operator: &BoxOperator) -> Self {
        let [along, across] = operator.stiffnesses;
        // 1/along − 1/across without cancellation beyond that of the difference itself.
        let compliances = [T::lit(1.0 / across), T::lit((across - along) / (along * across))];
        Self { axes, walls, compliances, is_plate: operator.order == 2 }
    }

    /// Solves for the modes of a panel: index i along axis 0 runs over the entries, `row` is the index along the middle
    /// axis of three, and the lanes are the indices `first`, `first` + 1, … along the last axis.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn solve_panel(&self, row: usize, first: usize, panels: &mut [&mut [Line<T>]; D]) {
        let outer = &self.axes[0];
        let last = &self.axes[D - 1];
        let points = panels[0].len();
        let lanes = |of: &[T]| Line::load(&of[first..first + WIDTH], T::lit(0.0));
        let (wave, weight) = (lanes(&last.wave), lanes(&last.weight));
        let is_row_special = D == 3 && self.axes[1].is_special(row);
        let (row_wave, row_weight) = if D == 3 {
            (Line::splat(self.axes[1].wave[row]), Line::splat(self.axes[1].weight[row]))
        } else {
            (Line::splat(T::lit(0.0)), Line::splat(T::lit(1.0)))
        };
        let has_special_lanes = (first..first + WIDTH).any(|slot| last.is_special(slot));
        let across = row_wave * row_wave + wave * wave;
        let weight = row_weight * weight;
        let [transverse, difference] = self.compliances.map(Line::splat);
        let one = Line::splat(T::lit(1.0));
        for i in 0..points {
            let outer_wave = Line::splat(outer.wave[i]);
            let mut q = [outer_wave; D];
            q[D - 1] = wave;
            if D == 3 {
                q[1] = row_wave;
            }
            let force: [Line<T>; D] = [0, 1, 2].map(|c| panels[c.min(D - 1)][i])[..D].try_into().unwrap_or([one; D]);
            let inverse = one / (outer_wave * outer_wave + across);
            let mut along = q[0] * force[0] + q[1] * force[1];
            if D == 3 {
                along += q[2] * force[2];
            }
            let mut factor = Line::splat(outer.weight[i]) * weight * inverse;
            if self.is_plate {
                factor *= inverse;
            }
            let along = difference * along * inverse;
            let mut result = force;
            for c in 0..D {
                result[c] = factor * (transverse * force[c] + along * q[c]);
            }
            let is_special = is_row_special || outer.is_special(i);
            if !(is_special || has_special_lanes) {
                for c in 0..D {
                    panels[c][i] = result[c];
                }
                continue;
            }
            for lane in 0..WIDTH {
                let slot = first + lane;
                if is_special || last.is_special(slot) {
                    let force = force.map(|force| force.0[lane]);
                    let mut slots = [i; D];
                    slots[D - 1] = slot;
                    if D == 3 {
                        slots[1] = row;
                    }
                    let solution = self.solve_one(slots, force);
                    for c in 0..D {
                        result[c].0[lane] = solution[c];
                    }
                }
            }
            for c in 0..D {
                panels[c][i] = result[c];
            }
        }
    }

    /// The indices of a component's mode in these slots.
    pub(crate) fn indices(&self, component: usize, slots: [usize; D]) -> Option<[usize; D]> {
        let mut indices = slots;
        for (axis, index) in indices.iter_mut().enumerate() {
            *index = self.axes[axis].index(slots[axis], self.walls.parity(component, axis))?;
        }
        Some(indices)
    }

    /// Solves where indices vanish or are the highest: the components in these slots need not belong to the same mode.
    pub(crate) fn solve_one(&self, slots: [usize; D], force: [T; D]) -> [T; D] {
        let zero = T::lit(0.0);
        let mut indices = [[NO_MODE; D]; D];
        for (component, own) in indices.iter_mut().enumerate() {
            for (axis, index) in own.iter_mut().enumerate() {
                let parity = self.walls.parity(component, axis);
                *index = self.axes[axis].index(slots[axis], parity).unwrap_or(NO_MODE);
            }
        }
        let [transverse, difference] = self.compliances;
        let mut result = [zero; D];
        for (component, own) in indices.iter().enumerate() {
            if own.contains(&NO_MODE) {
                continue;
            }
            let (mut q, mut squared, mut weight, mut along) = ([zero; D], zero, T::lit(1.0), zero);
            for axis in 0..D {
                q[axis] = self.axes[axis].wave_of(own[axis]);
                squared += q[axis] * q[axis];
                weight *= self.axes[axis].weight_of(own[axis]);
            }
            // Components of the same mode are coupled.
            for (other, indices) in indices.iter().enumerate() {
                if indices == own {
                    along += q[other] * force[other];
                }
            }
            let inverse = T::lit(1.0) / squared;
            let factor = if self.is_plate { weight * inverse * inverse } else { weight * inverse };
            result[component] =
                factor * (transverse * force[component] + difference * (along * inverse) * q[component]);
        }
        result
    }
}

/// In the place of an index where a sine vanishes.
const NO_MODE: usize = usize::MAX;

/// The entries of lanes that are loaded from a row that may end before them.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn load<T: Precision>(row: &[T], first: usize) -> Line<T> {
    match row.get(first..first + WIDTH) {
        Some(whole) => {
            let mut values = [T::lit(0.0); WIDTH];
            values.copy_from_slice(whole);
            Lanes(values)
        }
        None => Line::load(&row[first..], T::lit(0.0)),
    }
}
