//! What of a folded front has arrived first.
//!
//! Behind a cusp of a caustic a front crosses itself; between the two passages of the crossing lies the swallow-tail. It
//! is cut off at the crossing, and so is every ray that has touched a caustic: beyond it its action is no longer the
//! least (Jacobi).

use super::{FrontRay, InitialFront, Mesh, WaveFront};
use crate::PhaseFunction;

/// A connected part of a front that has arrived first.
///
/// # Example
/// See [`WaveFront::first_arrival`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArrivedPiece {
    /// Its points, in the order of the front; crossings are points too.
    pub points: Vec<[f64; 2]>,
    /// The ray at each point; none at a crossing.
    pub rays: Vec<Option<usize>>,
}

/// A crossing of segments i < j at the parts s and t of them.
#[derive(Clone, Copy, Debug)]
struct SelfCrossing {
    first: (usize, f64),
    second: (usize, f64),
    place: [f64; 2],
}

impl<H: PhaseFunction + Sync, C: InitialFront<2, 1> + Sync> WaveFront<'_, H, C, 2, 1> {
    /// The parts of the front that have arrived first: without swallow-tails, and without rays that have touched a
    /// caustic. The front itself keeps all its sheets.
    ///
    /// Crossings are those of the polyline, exact to the square of its spacing; [`refine`](WaveFront::refine) first. A
    /// loop without any caustic in it, where two distant arms of one front cross, is kept: which of its sides came
    /// first the front alone does not tell.
    #[must_use]
    pub fn first_arrival(&self) -> Vec<ArrivedPiece> {
        let closed = matches!(self.mesh, Mesh::Polyline { period: Some(_) });
        let count = self.rays.len();
        // A closed front is opened where it is farthest from all caustics.
        let opening = if closed { opening(&self.rays) } else { 0 };
        let length = if closed { count + 1 } else { count };
        let ray = |i: usize| (opening + i) % count;
        let points: Vec<[f64; 2]> = (0..length).map(|i| self.rays[ray(i)].coordinates()).collect();
        let touched = |i: usize| 0 < self.rays[ray(i)].caustics();
        let mut crossings = crossings(&points);
        crossings.retain(|c| (c.first.0 + 1..=c.second.0).any(touched));
        crossings.sort_by(|a, b| a.first.0.cmp(&b.first.0).then(a.first.1.total_cmp(&b.first.1)));
        let mut pieces = Vec::new();
        let mut piece = ArrivedPiece { points: Vec::new(), rays: Vec::new() };
        let (mut i, mut cut) = (0, crossings.iter().peekable());
        while i < length {
            if touched(i) {
                finish(&mut pieces, &mut piece);
            } else {
                piece.points.push(points[i]);
                piece.rays.push(Some(ray(i)));
            }
            // Crossings within a loop that has been cut off are gone with it.
            while cut.next_if(|c| c.first.0 < i).is_some() {}
            let mut next = i + 1;
            if let Some(crossing) = cut.next_if(|c| c.first.0 == i) {
                // Of loops that begin in one segment the first one holds the others.
                if !touched(i) {
                    piece.points.push(crossing.place);
                    piece.rays.push(None);
                }
                next = crossing.second.0 + 1;
            }
            i = next;
        }
        finish(&mut pieces, &mut piece);
        pieces
    }
}

fn finish(pieces: &mut Vec<ArrivedPiece>, piece: &mut ArrivedPiece) {
    if 1 < piece.points.len() {
        pieces.push(piece.clone());
    }
    piece.points.clear();
    piece.rays.clear();
}

/// The ray in the middle of the longest run of rays that have touched no caustic.
fn opening<const N: usize, const M: usize>(rays: &[FrontRay<N, M>]) -> usize {
    let (mut best, mut run) = ((0, 0), 0);
    for i in 0..2 * rays.len() {
        run = if rays[i % rays.len()].caustics() == 0 { run + 1 } else { 0 };
        if best.0 < run && run <= rays.len() {
            best = (run, i + 1 - run.div_ceil(2));
        }
    }
    best.1 % rays.len().max(1)
}

/// All crossings of a polyline with itself, neighbours apart.
fn crossings(points: &[[f64; 2]]) -> Vec<SelfCrossing> {
    let segment = |i: usize| (points[i], points[i + 1]);
    let left = |i: usize| points[i][0].min(points[i + 1][0]);
    let right = |i: usize| points[i][0].max(points[i + 1][0]);
    let mut order: Vec<usize> = (0..points.len().saturating_sub(1)).collect();
    order.sort_by(|&i, &j| left(i).total_cmp(&left(j)));
    let mut found = Vec::new();
    let mut active: Vec<usize> = Vec::new();
    for i in order {
        active.retain(|&j| left(i) <= right(j));
        for &j in &active {
            let (first, second) = (i.min(j), i.max(j));
            if first + 1 < second
                && let Some((s, t, place)) = crossing(segment(first), segment(second))
            {
                found.push(SelfCrossing { first: (first, s), second: (second, t), place });
            }
        }
        active.push(i);
    }
    found
}

/// Where two segments cross, in parts of each.
fn crossing((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> Option<(f64, f64, [f64; 2])> {
    let (u, v, w) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]], [c[0] - a[0], c[1] - a[1]]);
    let cross = |x: [f64; 2], y: [f64; 2]| x[0] * y[1] - x[1] * y[0];
    let denominator = cross(u, v);
    let (s, t) = (cross(w, v) / denominator, cross(w, u) / denominator);
    let inside = |x: f64| 0.0 <= x && x < 1.0;
    (inside(s) && inside(t)).then(|| (s, t, [a[0] + s * u[0], a[1] + s * u[1]]))
}
