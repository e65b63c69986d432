//! Meshes of the parameters of an initial manifold: segments, triangles, tetrahedra and so on.

use std::collections::BTreeMap;

use super::{CauchyProblem, FirstOrderPde, InitialManifold};
use crate::CharacteristicsError;
use crate::check::check_length;

/// The interval of one parameter of an initial manifold, cut into equal parts to begin with.
///
/// # Example
/// See [`CauchyProblem::solve`](crate::CauchyProblem::solve).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParameterInterval {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The number of parts, at least one.
    pub parts: usize,
}

impl<P: FirstOrderPde, M: InitialManifold> CauchyProblem<'_, P, M> {
    pub(super) fn check_intervals(&self, intervals: &[ParameterInterval]) -> Result<(), CharacteristicsError> {
        check_length("intervals of τ", self.data.variables - 1, intervals.len())?;
        for &ParameterInterval { from, to, parts } in intervals {
            if !(from < to && from.is_finite() && to.is_finite()) {
                return Err(CharacteristicsError::InvalidInterval { quantity: "τ", from, to });
            }
            if parts == 0 {
                return Err(CharacteristicsError::TooFewSamples { found: 0, needed: 1 });
            }
        }
        Ok(())
    }
}

/// The grid of the ends of all parts, in an order in which every point but the first has a neighbour before it.
#[derive(Clone, Debug)]
pub(super) struct Walk<'i> {
    intervals: &'i [ParameterInterval],
}

impl<'i> Walk<'i> {
    pub(super) const fn new(intervals: &'i [ParameterInterval]) -> Self {
        Self { intervals }
    }
    pub(super) fn len(&self) -> usize {
        self.intervals.iter().map(|interval| interval.parts + 1).product()
    }
    fn digits(&self, mut index: usize) -> Vec<usize> {
        let mut digits = Vec::with_capacity(self.intervals.len());
        for interval in self.intervals {
            digits.push(index % (interval.parts + 1));
            index /= interval.parts + 1;
        }
        digits
    }
    pub(super) fn parameters(&self, index: usize) -> Vec<f64> {
        let share = |(digit, interval): (usize, &ParameterInterval)| {
            let share = digit as f64 / interval.parts as f64;
            if digit == interval.parts { interval.to } else { interval.from + share * (interval.to - interval.from) }
        };
        self.digits(index).into_iter().zip(self.intervals).map(share).collect()
    }
    /// The neighbours of a point that come before it.
    pub(super) fn all_before(&self, index: usize) -> impl Iterator<Item = usize> + use<'_, 'i> {
        let mut stride = 1;
        self.digits(index).into_iter().zip(self.intervals).filter_map(move |(digit, interval)| {
            let before = if 0 < digit { Some(index - stride) } else { None };
            stride *= interval.parts + 1;
            before
        })
    }
    pub(super) fn before(&self, index: usize) -> Option<usize> {
        self.all_before(index).next()
    }

    /// Segments of a curve, triangles of a surface, simplices of m corners for more parameters.
    pub(super) fn simplices(&self) -> Vec<Vec<usize>> {
        match self.intervals {
            [line] => (0..line.parts).map(|i| vec![i, i + 1]).collect(),
            [first, second] => {
                let row = first.parts + 1;
                let mut triangles = Vec::with_capacity(2 * first.parts * second.parts);
                for j in 0..second.parts {
                    for i in 0..first.parts {
                        let corner = j * row + i;
                        // The diagonals alternate, so that no direction is preferred.
                        if (i + j) % 2 == 0 {
                            triangles.push(vec![corner, corner + 1, corner + row + 1]);
                            triangles.push(vec![corner, corner + row + 1, corner + row]);
                        } else {
                            triangles.push(vec![corner, corner + 1, corner + row]);
                            triangles.push(vec![corner + 1, corner + row + 1, corner + row]);
                        }
                    }
                }
                triangles
            }
            _ => self.along_diagonals(),
        }
    }

    /// Each box cut into (m − 1)! simplices, one for each order in which its edges lead from its lowest corner to its
    /// highest. Boxes side by side cut their common side alike.
    fn along_diagonals(&self) -> Vec<Vec<usize>> {
        let mut strides = Vec::with_capacity(self.intervals.len());
        let mut stride = 1;
        for interval in self.intervals {
            strides.push(stride);
            stride *= interval.parts + 1;
        }
        let mut orders = Vec::new();
        permute(&mut strides, 0, &mut orders);
        let mut simplices = Vec::new();
        for corner in 0..self.len() {
            if self.digits(corner).iter().zip(self.intervals).all(|(&digit, interval)| digit < interval.parts) {
                simplices.extend(orders.iter().map(|order| {
                    let mut simplex = vec![corner];
                    let mut last = corner;
                    for stride in order {
                        last += stride;
                        simplex.push(last);
                    }
                    simplex
                }));
            }
        }
        simplices
    }
}

/// All orders of the values from `first` on, the earlier ones kept.
fn permute(values: &mut [usize], first: usize, orders: &mut Vec<Vec<usize>>) {
    if values.len() <= first {
        orders.push(values.to_vec());
    }
    for i in first..values.len() {
        values.swap(first, i);
        permute(values, first + 1, orders);
        values.swap(first, i);
    }
}

/// The edges of simplices, each once, in order.
pub(super) fn edges(simplices: &[Vec<usize>]) -> Vec<(usize, usize)> {
    let mut edges: Vec<(usize, usize)> = Vec::new();
    for simplex in simplices {
        for (i, &a) in simplex.iter().enumerate() {
            edges.extend(simplex[i + 1..].iter().map(|&b| (a.min(b), a.max(b))));
        }
    }
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Cuts simplices at the middles of edges: segments in two, triangles in two, three or four, others in two again and
/// again. Neighbours agree, since they share the middles and the order in which edges are cut: the longest first.
pub(super) fn cut(
    simplices: &[Vec<usize>],
    middles: &BTreeMap<(usize, usize), usize>,
    length: impl Fn((usize, usize)) -> f64,
) -> Vec<Vec<usize>> {
    let middle = |a: usize, b: usize| middles.get(&(a.min(b), a.max(b))).copied();
    let mut result = Vec::with_capacity(simplices.len() + 2 * middles.len());
    for simplex in simplices {
        match simplex[..] {
            [a, b] => match middle(a, b) {
                Some(c) => result.extend([vec![a, c], vec![c, b]]),
                None => result.push(vec![a, b]),
            },
            [a, b, c] => cut_triangle([a, b, c], [middle(a, b), middle(b, c), middle(c, a)], &mut result),
            _ => {
                let mut order: Vec<(usize, usize)> = edges(core::slice::from_ref(simplex));
                order.retain(|edge| middles.contains_key(edge));
                // Stable: edges of one length stay in the order of their ends, whichever simplex they are seen from.
                order.sort_by(|&a, &b| length(b).total_cmp(&length(a)));
                let mut pieces = vec![simplex.clone()];
                for (a, b) in order {
                    let Some(middle) = middle(a, b) else { continue };
                    for piece in core::mem::take(&mut pieces) {
                        if piece.contains(&a) && piece.contains(&b) {
                            let with = |end: usize| piece.iter().map(|&i| if i == end { middle } else { i }).collect();
                            pieces.extend([with(b), with(a)]);
                        } else {
                            pieces.push(piece);
                        }
                    }
                }
                result.extend(pieces);
            }
        }
    }
    result
}

fn cut_triangle([a, b, c]: [usize; 3], middles: [Option<usize>; 3], result: &mut Vec<Vec<usize>>) {
    match middles {
        [None, None, None] => result.push(vec![a, b, c]),
        [Some(ab), None, None] => result.extend([vec![a, ab, c], vec![ab, b, c]]),
        [Some(ab), Some(bc), None] => result.extend([vec![a, ab, c], vec![ab, bc, c], vec![ab, b, bc]]),
        [Some(ab), Some(bc), Some(ca)] => {
            result.extend([vec![a, ab, ca], vec![ab, b, bc], vec![bc, c, ca], vec![ab, bc, ca]]);
        }
        // The same, seen from another corner.
        [ab, bc, ca] => cut_triangle([b, c, a], [bc, ca, ab], result),
    }
}
