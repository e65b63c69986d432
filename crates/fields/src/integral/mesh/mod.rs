//! Meshes of tetrahedra: checked, with their boundary.
//!
//! Vertices 0, 1, 2, 3 of an element span a positive volume: seen from outside, each face
//! (1 2 3), (0 3 2), (0 1 3), (0 2 1) runs counter-clockwise.

mod build;
mod faces;
mod points;

pub(super) use build::EDGES;
pub(super) use points::{normal_and_area, weighted};

use nalgebra::Vector3;

use crate::FieldsError;
use crate::error::check_finite;

/// A region made of tetrahedra.
///
/// Refused are: numbers that are not finite, vertices that do not exist, that are named twice by one element or
/// that no element names, elements without volume or turned inside out, faces with more than one element on the
/// same side, and meshes without elements.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::TetrahedralMesh;
/// let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let mesh = TetrahedralMesh::new(corners.clone(), vec![[0, 1, 2, 3]])?;
/// assert_eq!(mesh.volume(), 1.0 / 6.0);
/// assert_eq!(mesh.boundary().len(), 4);
/// // Two vertices interchanged turn the element inside out.
/// assert!(TetrahedralMesh::new(corners, vec![[1, 0, 2, 3]]).is_err());
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "WrittenMesh", into = "WrittenMesh"))]
pub struct TetrahedralMesh {
    vertices: Vec<Vector3<f64>>,
    tetrahedra: Vec<[usize; 4]>,
    /// Of the elements, m³.
    volumes: Vec<f64>,
    boundary: Vec<BoundaryTriangle>,
}

/// A triangle of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BoundaryTriangle {
    /// Counter-clockwise seen from outside.
    pub vertices: [usize; 3],
    /// The element that it belongs to.
    pub element: usize,
}

/// A mesh as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct WrittenMesh {
    vertices: Vec<[f64; 3]>,
    tetrahedra: Vec<[usize; 4]>,
}

/// The local vertices of the faces, outward.
pub(super) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

impl TetrahedralMesh {
    /// A mesh from vertices (m) and the four vertices of each element.
    ///
    /// # Errors
    /// [`FieldsError::EmptyMesh`], [`FieldsError::NotFinite`] (index 3 × vertex + coordinate),
    /// [`FieldsError::NoSuchVertex`], [`FieldsError::RepeatedVertex`], [`FieldsError::FlatElement`] when
    /// 6 V ≤ 64 ulp × (longest edge)³, [`FieldsError::InvertedElement`], [`FieldsError::OverlappingElements`],
    /// [`FieldsError::UnusedVertex`].
    pub fn new(vertices: Vec<Vector3<f64>>, tetrahedra: Vec<[usize; 4]>) -> Result<Self, FieldsError> {
        if tetrahedra.is_empty() {
            return Err(FieldsError::EmptyMesh);
        }
        for (index, vertex) in vertices.iter().enumerate() {
            check_finite("vertex", vertex.as_slice()).map_err(|error| match error {
                FieldsError::NotFinite { quantity, index: coordinate, value } => {
                    FieldsError::NotFinite { quantity, index: 3 * index + coordinate, value }
                }
                other => other,
            })?;
        }
        let mut is_used = vec![false; vertices.len()];
        let mut volumes = Vec::with_capacity(tetrahedra.len());
        for (element, tetrahedron) in tetrahedra.iter().enumerate() {
            check_vertices(element, tetrahedron, vertices.len())?;
            volumes.push(checked_volume(element, tetrahedron.map(|vertex| vertices[vertex]))?);
            for &vertex in tetrahedron {
                is_used[vertex] = true;
            }
        }
        if let Some(vertex) = is_used.iter().position(|&used| !used) {
            return Err(FieldsError::UnusedVertex { vertex });
        }
        let boundary = faces::boundary(&tetrahedra)?;
        Ok(Self { vertices, tetrahedra, volumes, boundary })
    }

    /// The vertices, m.
    #[must_use]
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// The vertices of each element.
    #[must_use]
    pub fn tetrahedra(&self) -> &[[usize; 4]] {
        &self.tetrahedra
    }

    /// The triangles of the boundary, outward, in the order of the elements.
    #[must_use]
    pub fn boundary(&self) -> &[BoundaryTriangle] {
        &self.boundary
    }

    /// The volumes of the elements, m³.
    #[must_use]
    pub fn volumes(&self) -> &[f64] {
        &self.volumes
    }

    /// The volume, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        piola_numerics::sums::compensated_sum(&self.volumes)
    }

    /// The corners of an element.
    pub(super) fn corners(&self, element: usize) -> [Vector3<f64>; 4] {
        self.tetrahedra[element].map(|vertex| self.vertices[vertex])
    }
}

fn check_vertices(element: usize, tetrahedron: &[usize; 4], count: usize) -> Result<(), FieldsError> {
    for (place, &vertex) in tetrahedron.iter().enumerate() {
        if count <= vertex {
            return Err(FieldsError::NoSuchVertex { element, vertex, count });
        }
        if tetrahedron[..place].contains(&vertex) {
            return Err(FieldsError::RepeatedVertex { element, vertex });
        }
    }
    Ok(())
}

/// Six times the volume spanned by four points, with sign.
fn sixfold_volume(corners: &[Vector3<f64>; 4]) -> f64 {
    let [a, b, c] = [1, 2, 3].map(|i| corners[i] - corners[0]);
    a.dot(&b.cross(&c))
}

fn checked_volume(element: usize, corners: [Vector3<f64>; 4]) -> Result<f64, FieldsError> {
    let sixfold = sixfold_volume(&corners);
    let edges = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let longest = edges.iter().map(|&(i, j)| (corners[i] - corners[j]).norm()).fold(0.0, f64::max);
    let volume = sixfold / 6.0;
    // Comparisons that fail for NaN, which a volume beyond the range of numbers gives.
    let is_solid = 64.0 * f64::EPSILON * longest.powi(3) < sixfold.abs() && volume.is_finite();
    match (is_solid, 0.0 < sixfold) {
        (true, true) => Ok(volume),
        (true, false) => Err(FieldsError::InvertedElement { element, volume }),
        (false, _) => Err(FieldsError::FlatElement { element, volume, longest_edge: longest }),
    }
}

#[cfg(feature = "serde")]
impl TryFrom<WrittenMesh> for TetrahedralMesh {
    type Error = FieldsError;
    fn try_from(written: WrittenMesh) -> Result<Self, FieldsError> {
        Self::new(written.vertices.into_iter().map(Vector3::from).collect(), written.tetrahedra)
    }
}

#[cfg(feature = "serde")]
impl From<TetrahedralMesh> for WrittenMesh {
    fn from(mesh: TetrahedralMesh) -> Self {
        Self { vertices: mesh.vertices.into_iter().map(Into::into).collect(), tetrahedra: mesh.tetrahedra }
    }
}
