//! The homogeneous solid inside a closed triangle mesh: volume, centre of mass and inertia, exactly.
//!
//! By the divergence theorem an integral over the inside is one over the surface, and for moments up to the
//! second a sum over triangles. With corners a, b, c of a triangle from an origin o, seen from outside
//! counter-clockwise, and d = a·(b−a)×(c−a), six times the signed volume of its pyramid on o:
//!
//! ```text
//! V = Σ d/6      ∫ x dV = Σ d/24 (a + b + c)
//! ∫ x⊗x dV = Σ d/120 (a⊗a + b⊗b + c⊗c + s⊗s),   s = a + b + c
//! I = M/V (tr S 1 − S),   S = ∫ r⊗r dV about the centre of mass             W(2.33)
//! ```
//!
//! The origin is a mean of the vertices first and then the centre of mass itself, so that neither the place of
//! the mesh nor the theorem of parallel axes takes digits away; sums are compensated.
//!
//! Cavities are meshes too: their triangles, turned towards the cavity, go into the same list. That surfaces
//! do not cross each other is not checked; where they do, space is counted as often as it is wound around.
//!
//! # References
//! W(2.33).

use nalgebra::{Matrix3, Vector3};
use piola_numerics::sums::CompensatedSum;

use crate::error::{KinematicsError, finite};
use crate::inertia::Inertia;
use crate::rigid_body::RigidBody;
use crate::solids::{FLAT, PlacedBody};
use crate::vector::first_non_finite;

/// A homogeneous solid bounded by triangles.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::mesh::MeshSolid;
/// // The corner of a unit cube: a sixth of its volume.
/// let vertices = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let corner = MeshSolid::new(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// assert!((corner.volume() - 1.0 / 6.0).abs() <= f64::EPSILON);
/// assert!((corner.centre_of_mass() - Vector3::repeat(0.25)).amax() <= f64::EPSILON);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(2.33).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSolid {
    volume: f64,
    surface_area: f64,
    centre_of_mass: Vector3<f64>,
    /// S/V: the mean of r⊗r about the centre of mass.
    mean_squares: Matrix3<f64>,
}

impl MeshSolid {
    /// The solid inside a mesh: vertices (m) and triangles of three indices each, counter-clockwise seen from
    /// outside. For set-up: allocates.
    ///
    /// Several shells and shells that touch along edges are allowed, as long as every edge is passed as often
    /// in one direction as in the other.
    ///
    /// # Errors
    /// * [`NotFinite`](KinematicsError::NotFinite) for a coordinate, with the index 3 vertex + component;
    /// * [`MeshIndex`](KinematicsError::MeshIndex) for an index without vertex;
    /// * [`MeshTriangle`](KinematicsError::MeshTriangle) for a triangle that has one vertex twice;
    /// * [`MeshNotClosed`](KinematicsError::MeshNotClosed) for an edge that some triangle lacks a neighbour at;
    /// * [`MeshOrientation`](KinematicsError::MeshOrientation) for an edge that two neighbours pass in the same
    ///   direction: one of them is turned inside out;
    /// * [`NoVolume`](KinematicsError::NoVolume) when the volume is zero to rounding;
    /// * [`MeshInverted`](KinematicsError::MeshInverted) when it is negative: all triangles are inside out.
    ///
    /// # Accuracy
    /// A few ulps of the moments of a convex solid, wherever it is; the coordinates themselves are taken as
    /// exact.
    pub fn new(vertices: &[Vector3<f64>], triangles: &[[usize; 3]]) -> Result<Self, KinematicsError> {
        for (vertex, position) in vertices.iter().enumerate() {
            if let Some((component, value)) = first_non_finite(position.as_slice()) {
                return Err(KinematicsError::NotFinite { quantity: "vertices", index: 3 * vertex + component, value });
            }
        }
        check_indices(vertices.len(), triangles)?;
        check_edges(triangles)?;
        let largest = triangles.as_flattened().iter().map(|&i| vertices[i]).fold(None, |box_, x| {
            let (low, high) = box_.unwrap_or((x, x));
            Some((low.inf(&x), high.sup(&x)))
        });
        let Some((low, high)) = largest else {
            return Err(KinematicsError::NoVolume { volume: 0.0 });
        };
        // Halves first: the sum of two large numbers may leave the range.
        let origin = low * 0.5 + high * 0.5;
        let first = Moments::about(&origin, &Vector3::zeros(), vertices, triangles);
        let extent = (high * 0.5 - low * 0.5).amax() * 2.0;
        let volume = first.volume();
        finite("volume of the mesh", &[volume])?;
        if volume.abs() <= FLAT * extent * extent * extent {
            return Err(KinematicsError::NoVolume { volume });
        }
        if volume < 0.0 {
            return Err(KinematicsError::MeshInverted { volume });
        }
        let centre = first.centre();
        let second = Moments::about(&origin, &centre, vertices, triangles);
        let solid = Self {
            volume: second.volume(),
            surface_area: second.area.value(),
            centre_of_mass: origin + (centre + second.centre()),
            mean_squares: second.mean_squares(),
        };
        // Fifth powers of the size leave the range of numbers long before it does.
        finite("volume of the mesh", &[solid.volume])?;
        finite("surface area of the mesh", &[solid.surface_area])?;
        finite("centre of mass of the mesh", solid.centre_of_mass.as_slice())?;
        finite("moments of the mesh", solid.mean_squares.as_slice())?;
        Ok(solid)
    }

    /// The volume enclosed (m³).
    #[inline]
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// The area of all triangles (m²).
    #[inline]
    #[must_use]
    pub fn surface_area(&self) -> f64 {
        self.surface_area
    }

    /// The centre of mass in the axes of the vertices (m).
    #[inline]
    #[must_use]
    pub fn centre_of_mass(&self) -> Vector3<f64> {
        self.centre_of_mass
    }

    /// The inertia tensor about the centre of mass for a total mass (kg), in the axes of the vertices.
    ///
    /// # Errors
    /// As [`RigidBody::new`] and [`Inertia::new`].
    ///
    /// # Source
    /// W(2.33).
    pub fn inertia(&self, mass: f64) -> Result<Inertia, KinematicsError> {
        crate::error::positive_mass(mass)?;
        let s = self.mean_squares * mass;
        let (xx, yy, zz) = (s[(0, 0)], s[(1, 1)], s[(2, 2)]);
        let beside = |i: usize, j: usize| -s[(i, j)];
        Inertia::new(Matrix3::new(
            yy + zz,
            beside(0, 1),
            beside(0, 2),
            beside(0, 1),
            zz + xx,
            beside(1, 2),
            beside(0, 2),
            beside(1, 2),
            xx + yy,
        ))
    }

    /// The rigid body of the given mass (kg), with the place of its centre of mass.
    ///
    /// # Errors
    /// As [`inertia`](MeshSolid::inertia).
    pub fn body(&self, mass: f64) -> Result<PlacedBody, KinematicsError> {
        Ok(PlacedBody { body: RigidBody::new(mass, self.inertia(mass)?)?, centre_of_mass: self.centre_of_mass })
    }
}

/// 6 V, 24 ∫x dV, 120 ∫x⊗x dV (upper triangle) and the area, about one origin.
struct Moments {
    volume: CompensatedSum<f64>,
    first: [CompensatedSum<f64>; 3],
    second: [CompensatedSum<f64>; 6],
    area: CompensatedSum<f64>,
}

/// Row and column of the six sums of second moments.
const UPPER: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

impl Moments {
    fn about(
        origin: &Vector3<f64>,
        centre: &Vector3<f64>,
        vertices: &[Vector3<f64>],
        triangles: &[[usize; 3]],
    ) -> Self {
        let zero = CompensatedSum::new();
        let mut sums = Self { volume: zero, first: [zero; 3], second: [zero; 6], area: zero };
        for triangle in triangles {
            let [a, b, c] = triangle.map(|index| (vertices[index] - origin) - centre);
            let normal = (b - a).cross(&(c - a));
            let d = a.dot(&normal);
            let s = a + b + c;
            sums.volume.add(d);
            sums.area.add(0.5 * normal.norm());
            for (sum, component) in sums.first.iter_mut().zip(s.iter()) {
                sum.add(d * component);
            }
            for (sum, (i, j)) in sums.second.iter_mut().zip(UPPER) {
                sum.add(d * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]));
            }
        }
        sums
    }

    fn volume(&self) -> f64 {
        self.volume.value() / 6.0
    }

    fn centre(&self) -> Vector3<f64> {
        Vector3::from(self.first.map(CompensatedSum::value)) / (4.0 * self.volume.value())
    }

    fn mean_squares(&self) -> Matrix3<f64> {
        let mut mean = Matrix3::zeros();
        for (sum, (i, j)) in self.second.iter().zip(UPPER) {
            mean[(i, j)] = sum.value() / (20.0 * self.volume.value());
            mean[(j, i)] = mean[(i, j)];
        }
        mean
    }
}

fn check_indices(vertices: usize, triangles: &[[usize; 3]]) -> Result<(), KinematicsError> {
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        for (corner, index) in [a, b, c].into_iter().enumerate() {
            if vertices <= index {
                return Err(KinematicsError::MeshIndex { triangle, corner, index, vertices });
            }
        }
        if a == b || b == c || c == a {
            return Err(KinematicsError::MeshTriangle { triangle, vertices: [a, b, c] });
        }
    }
    Ok(())
}

/// Every edge is passed as often in one direction as in the other: the surface has no boundary.
fn check_edges(triangles: &[[usize; 3]]) -> Result<(), KinematicsError> {
    // (edge, whether it is passed from the larger to the smaller index, triangle), like edges side by side.
    let mut passages = Vec::with_capacity(3 * triangles.len());
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        passages.extend([(a, b), (b, c), (c, a)].map(|(from, to)| ((from.min(to), from.max(to)), to < from, triangle)));
    }
    passages.sort_unstable();
    for at_edge in passages.chunk_by(|a, b| a.0 == b.0) {
        let down = at_edge.iter().filter(|passage| passage.1).count();
        let up = at_edge.len() - down;
        if up == down {
            continue;
        }
        let more = up < down;
        let mut passing = at_edge.iter().filter(|passage| passage.1 == more).map(|passage| passage.2);
        let (edge, first, second) = (at_edge[0].0, passing.next(), passing.next());
        // An even number of triangles at the edge would fit together, were they turned the same way.
        return Err(match (first, second) {
            (Some(first), Some(second)) if at_edge.len() % 2 == 0 => {
                KinematicsError::MeshOrientation { edge, triangles: (first, second) }
            }
            (first, _) => KinematicsError::MeshNotClosed { edge, triangle: first.unwrap_or(0) },
        });
    }
    Ok(())
}
