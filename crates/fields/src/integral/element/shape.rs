//! Shape functions of tetrahedra in barycentric coordinates.
//!
//! ```text
//! linear      N_a = λ_a                       at the corners
//! quadratic   N_a = λ_a (2 λ_a − 1)           at the corners,   N_ab = 4 λ_a λ_b at the midpoints of the edges
//! ```

use crate::integral::Quadrature;
use crate::integral::mesh::{EDGES, FACES};

/// The shape functions and their slopes ∂Nₐ/∂λₖ at a point of the rule in an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShapePoint<const N: usize> {
    pub(super) share: [f64; 4],
    pub(super) values: [f64; N],
    pub(super) slopes: [[f64; 4]; N],
    /// Share of the volume, or of the area of a face.
    pub(super) weight: f64,
}

/// Gives values and slopes at barycentric coordinates.
pub(super) type Shape<const N: usize> = fn([f64; 4]) -> ([f64; N], [[f64; 4]; N]);

pub(super) fn linear(share: [f64; 4]) -> ([f64; 4], [[f64; 4]; 4]) {
    let mut slopes = [[0.0; 4]; 4];
    for (a, slope) in slopes.iter_mut().enumerate() {
        slope[a] = 1.0;
    }
    (share, slopes)
}

pub(super) fn quadratic(share: [f64; 4]) -> ([f64; 10], [[f64; 4]; 10]) {
    let (mut values, mut slopes) = ([0.0; 10], [[0.0; 4]; 10]);
    for (a, &l) in share.iter().enumerate() {
        values[a] = l * (2.0 * l - 1.0);
        slopes[a][a] = 4.0 * l - 1.0;
    }
    for (edge, [a, b]) in EDGES.into_iter().enumerate() {
        values[4 + edge] = 4.0 * share[a] * share[b];
        slopes[4 + edge][a] = 4.0 * share[b];
        slopes[4 + edge][b] = 4.0 * share[a];
    }
    (values, slopes)
}

/// The shape functions at the points of the rule inside an element.
pub(super) fn inside<const N: usize>(quadrature: &Quadrature, shape: Shape<N>) -> Box<[ShapePoint<N>]> {
    let point = |&(share, weight): &([f64; 4], f64)| {
        let (values, slopes) = shape(share);
        ShapePoint { share, values, slopes, weight }
    };
    quadrature.tetrahedron.iter().map(point).collect()
}

/// The shape functions at the points of the rule on each face.
pub(super) fn on_faces<const N: usize>(quadrature: &Quadrature, shape: Shape<N>) -> [Box<[ShapePoint<N>]>; 4] {
    FACES.map(|face| {
        let point = |(on_face, weight): &([f64; 3], f64)| {
            let mut share = [0.0; 4];
            for (&local, &l) in face.iter().zip(on_face) {
                share[local] = l;
            }
            let (values, slopes) = shape(share);
            ShapePoint { share, values, slopes, weight: *weight }
        };
        quadrature.triangle.iter().map(point).collect()
    })
}
