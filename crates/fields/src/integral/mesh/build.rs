//! Meshes of boxes, refined meshes, meshes moved by a map.

use nalgebra::Vector3;

use super::{TetrahedralMesh, sixfold_volume};
use crate::FieldsError;
use crate::integral::Cuboid;

/// The orders in which a path goes along the three axes, with whether the order is even.
const PATHS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([1, 0, 2], false),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
];

/// The edges of an element, as pairs of local vertices.
pub(in crate::integral) const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

/// The eight parts of an element by its corners 0–3 and the midpoints 4–9 of its [`EDGES`]: corners, then the
/// octahedron about the diagonal from midpoint 02 to midpoint 13.
const PARTS: [[usize; 4]; 8] =
    [[0, 4, 6, 7], [4, 1, 5, 8], [6, 5, 2, 9], [7, 8, 9, 3], [4, 6, 7, 8], [4, 6, 8, 5], [6, 7, 8, 9], [6, 8, 5, 9]];

impl TetrahedralMesh {
    /// A box cut into cells, each cut into six tetrahedra around its diagonal.
    ///
    /// # Errors
    /// [`FieldsError::EmptyMesh`] when a count is zero; as [`new`](Self::new) for a box of extreme proportions.
    pub fn of_cuboid(cuboid: &Cuboid, cells: [usize; 3]) -> Result<Self, FieldsError> {
        if cells.contains(&0) {
            return Err(FieldsError::EmptyMesh);
        }
        let counts = cells.map(|count| count + 1);
        let vertex = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
        let mut vertices = Vec::with_capacity(counts[0] * counts[1] * counts[2]);
        for place in grid(counts) {
            let share = |axis: usize| place[axis] as f64 / cells[axis] as f64;
            let (lower, upper) = (cuboid.lower(), cuboid.upper());
            let coordinate = |axis: usize| lower[axis] * (1.0 - share(axis)) + upper[axis] * share(axis);
            vertices.push(Vector3::new(coordinate(0), coordinate(1), coordinate(2)));
        }
        let mut tetrahedra = Vec::with_capacity(6 * cells[0] * cells[1] * cells[2]);
        for cell in grid(cells) {
            for (path, is_even) in PATHS {
                let mut corner = cell;
                let mut corners = [vertex(corner); 4];
                for (step, axis) in path.into_iter().enumerate() {
                    corner[axis] += 1;
                    corners[step + 1] = vertex(corner);
                }
                if !is_even {
                    corners.swap(2, 3);
                }
                tetrahedra.push(corners);
            }
        }
        Self::new(vertices, tetrahedra)
    }

    /// Each element cut into eight at the midpoints of its edges.
    ///
    /// # Errors
    /// As [`new`](Self::new), when the midpoints of extremely small elements coincide.
    pub fn refined(&self) -> Result<Self, FieldsError> {
        let edges = self.edges();
        let mut vertices = self.vertices.clone();
        vertices.extend(edges.iter().map(|&[a, b]| (self.vertices[a] + self.vertices[b]) * 0.5));
        let mut tetrahedra = Vec::with_capacity(8 * self.tetrahedra.len());
        for tetrahedron in &self.tetrahedra {
            let nodes = self.nodes_of(tetrahedron, &edges);
            for part in PARTS {
                let mut part = part.map(|local| nodes[local]);
                if sixfold_volume(&part.map(|vertex| vertices[vertex])) < 0.0 {
                    part.swap(2, 3);
                }
                tetrahedra.push(part);
            }
        }
        Self::new(vertices, tetrahedra)
    }

    /// The mesh whose vertices are moved by a map.
    ///
    /// # Errors
    /// As [`new`](Self::new), when the map turns an element inside out.
    pub fn moved(&self, map: impl FnMut(&Vector3<f64>) -> Vector3<f64>) -> Result<Self, FieldsError> {
        Self::new(self.vertices.iter().map(map).collect(), self.tetrahedra.clone())
    }

    /// All edges, each once with its smaller vertex first, sorted.
    pub(in crate::integral) fn edges(&self) -> Vec<[usize; 2]> {
        let of = |tetrahedron: &[usize; 4]| EDGES.map(|edge| sorted(edge.map(|local| tetrahedron[local])));
        let mut edges: Vec<[usize; 2]> = self.tetrahedra.iter().flat_map(of).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The corners of an element and the nodes on its edges, which are numbered after the vertices.
    pub(in crate::integral) fn nodes_of(&self, tetrahedron: &[usize; 4], edges: &[[usize; 2]]) -> [usize; 10] {
        let mut nodes = [0; 10];
        nodes[..4].copy_from_slice(tetrahedron);
        for (node, edge) in nodes[4..].iter_mut().zip(EDGES) {
            let edge = sorted(edge.map(|local| tetrahedron[local]));
            // Every edge is in the list.
            *node = self.vertices.len() + edges.partition_point(|other| *other < edge);
        }
        nodes
    }
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// All index triples below the counts, the first index fastest.
fn grid(counts: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = counts;
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}
