//! The boundary of a mesh: faces that belong to one element only.

use super::{BoundaryTriangle, FACES};
use crate::FieldsError;

/// Boundary triangles in the order of the elements.
///
/// A face of two elements has one on either side: they see it in opposite orientation.
pub(super) fn boundary(tetrahedra: &[[usize; 4]]) -> Result<Vec<BoundaryTriangle>, FieldsError> {
    let mut faces = Vec::with_capacity(4 * tetrahedra.len());
    for (element, tetrahedron) in tetrahedra.iter().enumerate() {
        for (side, face) in FACES.iter().enumerate() {
            let vertices = face.map(|local| tetrahedron[local]);
            let mut sorted = vertices;
            sorted.sort_unstable();
            faces.push((sorted, element, side, is_even(vertices)));
        }
    }
    faces.sort_unstable();
    let mut boundary = Vec::new();
    for group in faces.chunk_by(|a, b| a.0 == b.0) {
        match *group {
            [(_, element, side, _)] => boundary.push((element, side)),
            [(_, _, _, first), (_, _, _, second)] if first != second => {}
            [(face, first, ..), (_, second, ..), ..] => {
                return Err(FieldsError::OverlappingElements { face, elements: [first, second] });
            }
            [] => {}
        }
    }
    boundary.sort_unstable();
    let triangle = |(element, side): (usize, usize)| {
        let vertices: [usize; 3] = FACES[side].map(|local| tetrahedra[element][local]);
        BoundaryTriangle { vertices, element }
    };
    Ok(boundary.into_iter().map(triangle).collect())
}

/// Whether three different numbers are an even permutation of themselves sorted.
fn is_even([a, b, c]: [usize; 3]) -> bool {
    (a < b) == ((b < c) == (a < c))
}
