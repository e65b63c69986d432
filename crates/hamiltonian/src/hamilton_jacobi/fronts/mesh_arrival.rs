//! The part of a folded mesh that has arrived first.
//!
//! Triangles past a caustic arrive late; so does everything connected to them up to the self-intersection.

use std::collections::BTreeMap;

use super::{InitialFront, Mesh, WaveFront};
use crate::PhaseFunction;

/// A point in space, or a difference of two.
type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl<H: PhaseFunction + Sync, C: InitialFront<3, 2> + Sync> WaveFront<'_, H, C, 3, 2> {
    /// The triangles of the front that have arrived first: without those of which a ray has touched a caustic, and
    /// without all that hang together with them up to where the front cuts through itself. The front itself keeps all
    /// its sheets.
    ///
    /// Triangles that the front cuts are kept whole, so that the seam is exact to one edge;
    /// [`refine`](WaveFront::refine) first. Where two distant parts of one front cut each other without any caustic both
    /// are kept.
    ///
    /// # Example
    /// A part of a sphere that goes through its focus has been everywhere before:
    /// ```
    /// use piola_hamiltonian::hamilton_jacobi::{InitialFront, WaveFront};
    /// use piola_hamiltonian::PhaseFunction;
    /// use piola_numerics::Real;
    /// struct Even; // H = |p|
    /// impl PhaseFunction for Even {
    ///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
    ///         (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt()
    ///     }
    /// }
    /// struct Sphere;
    /// impl InitialFront<3, 2> for Sphere {
    ///     fn at<T: Real>(&self, [a, b]: [T; 2]) -> [T; 3] {
    ///         [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]
    ///     }
    /// }
    /// let mut front = WaveFront::surface(&Even, &Sphere, (-1.0, 1.0), [(0.5, 1.0), (0.0, 1.0)], [4, 4])?;
    /// assert_eq!(front.first_arrival().len(), 18);
    /// front.advance(1.5, 4)?;
    /// assert!(front.first_arrival().is_empty());
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    #[must_use]
    pub fn first_arrival(&self) -> Vec<[usize; 3]> {
        let Mesh::Triangles(triangles) = &self.mesh else { return Vec::new() };
        let corners = |t: &[usize; 3]| t.map(|i| self.rays[i].coordinates());
        let places: Vec<[Point; 3]> = triangles.iter().map(corners).collect();
        let cut = cut_triangles(triangles, &places);
        let mut late: Vec<bool> = triangles.iter().map(|t| t.iter().any(|&i| 0 < self.rays[i].caustics())).collect();
        let mut edges = BTreeMap::<(usize, usize), Vec<usize>>::new();
        for (index, &[a, b, c]) in triangles.iter().enumerate() {
            for (i, j) in [(a, b), (b, c), (c, a)] {
                edges.entry((i.min(j), i.max(j))).or_default().push(index);
            }
        }
        let mut waiting: Vec<usize> = (0..triangles.len()).filter(|&i| late[i]).collect();
        while let Some(index) = waiting.pop() {
            let [a, b, c] = triangles[index];
            for (i, j) in [(a, b), (b, c), (c, a)] {
                for &other in edges.get(&(i.min(j), i.max(j))).into_iter().flatten() {
                    if !late[other] && !cut[other] {
                        late[other] = true;
                        waiting.push(other);
                    }
                }
            }
        }
        triangles.iter().zip(late).filter(|(_, late)| !late).map(|(&triangle, _)| triangle).collect()
    }
}

/// Which triangles are cut by another one that shares no corner with them.
fn cut_triangles(triangles: &[[usize; 3]], places: &[[Point; 3]]) -> Vec<bool> {
    let low = |i: usize, axis: usize| places[i].iter().fold(f64::INFINITY, |m, p| m.min(p[axis]));
    let high = |i: usize, axis: usize| places[i].iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[axis]));
    let boxes: Vec<[(f64, f64); 3]> =
        (0..places.len()).map(|i| [0, 1, 2].map(|axis| (low(i, axis), high(i, axis)))).collect();
    let meet = |i: usize, j: usize| (0..3).all(|k| boxes[i][k].0 <= boxes[j][k].1 && boxes[j][k].0 <= boxes[i][k].1);
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&i, &j| boxes[i][0].0.total_cmp(&boxes[j][0].0));
    let mut cut = vec![false; places.len()];
    let mut active: Vec<usize> = Vec::new();
    for i in order {
        active.retain(|&j| boxes[i][0].0 <= boxes[j][0].1);
        for &j in &active {
            let apart = !triangles[i].iter().any(|corner| triangles[j].contains(corner));
            if apart && !(cut[i] && cut[j]) && meet(i, j) && intersect(&places[i], &places[j]) {
                cut[i] = true;
                cut[j] = true;
            }
        }
        active.push(i);
    }
    cut
}

/// Two triangles cut each other when an edge of one passes through the other.
fn intersect(a: &[Point; 3], b: &[Point; 3]) -> bool {
    let through = |edges: &[Point; 3], face: &[Point; 3]| (0..3).any(|i| passes(edges[i], edges[(i + 1) % 3], face));
    through(a, b) || through(b, a)
}

/// Whether the segment from a to b passes through a triangle.
fn passes(a: Point, b: Point, [u, v, w]: &[Point; 3]) -> bool {
    let (first, second, along) = (minus(*v, *u), minus(*w, *u), minus(b, a));
    let normal = cross(first, second);
    let denominator = dot(normal, along);
    let part = dot(normal, minus(*u, a)) / denominator;
    if !(0.0 <= part && part <= 1.0) {
        return false;
    }
    let place = [a[0] + part * along[0], a[1] + part * along[1], a[2] + part * along[2]];
    let offset = minus(place, *u);
    let square = dot(normal, normal);
    let (s, t) = (dot(cross(offset, second), normal) / square, dot(cross(first, offset), normal) / square);
    0.0 <= s && 0.0 <= t && s + t <= 1.0
}
