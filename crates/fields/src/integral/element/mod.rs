//! Displacements sampled at the nodes of a mesh: forces by virtual work, masses, integrals.
//!
//! The displacement is u = Σ Nₐ uₐ with shape functions Nₐ of degree one (nodes at the vertices) or two (at
//! the midpoints of the edges too). The equation of motion, damped or not, B(4.58), and that of equilibrium,
//! B(4.59), tested with η = Σ Nₐ ηₐ, give forces on the nodes:
//!
//! ```text
//! ρ_κ ü + c u̇ = f + Div P
//! ∫ (ρ_κ ü + c u̇)·η dV = ∫ f·η dV + ∮ g·η dA − ∫ P : ∇η dV       for all η
//! M ü + C u̇ = F,    F_a = ∫ f N_a dV + ∮ g N_a dA − ∫ P ∇N_a dV,    M_ab = ∫ ρ_κ N_a N_b dV
//! ```
//!
//! Nodal vectors are slices of three numbers a node: entry 3a + i is component i at node a. All is generic over
//! the scalar, so that duals give tangents: the derivative of F along δu, without a stiffness matrix.
//!
//! # References
//! B(4.58–4.59), B(4.61). E. Hinton, T. Rock, O. C. Zienkiewicz, *A note on mass lumping*, Earthquake Eng. Struct.
//! Dyn. 4 (1976). I. Fried, *Bounds on the extremal eigenvalues of the finite element stiffness and mass
//! matrices*, J. Sound Vib. 22 (1972).

mod explicit;
mod forces;
mod mass;
mod shape;

pub use explicit::ExplicitMotion;

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant};

use super::TetrahedralMesh;
use super::quadrature::Quadrature;
use crate::FieldsError;
use crate::integrand::{Integrand, RunningIntegral};
use piola_continuum::ContinuumError;
use piola_continuum::DisplacementGradient;
use piola_tensor::internal::rows::Rows;
use shape::{Shape, ShapePoint};

/// Tetrahedra with N nodes each on which displacements are sampled.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, LinearTetrahedra, TetrahedralMesh};
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = LinearTetrahedra::new(TetrahedralMesh::of_cuboid(&unit, [2, 2, 2])?, 1)?;
/// assert_eq!(body.nodes().len(), 27);
/// let mut mass = vec![0.0; 27];
/// body.lumped_mass_into(|_| 6.0, &mut mass)?;
/// assert!((mass.iter().sum::<f64>() - 6.0).abs() < 1e-14);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TetrahedralElements<const N: usize> {
    mesh: TetrahedralMesh,
    nodes: Vec<Vector3<f64>>,
    elements: Vec<[usize; N]>,
    /// ∇λₖ of each element.
    gradients: Vec<[[f64; 3]; 4]>,
    inside: Box<[ShapePoint<N>]>,
    on_faces: [Box<[ShapePoint<N>]>; 4],
}

/// Elements with nodes at the corners.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{LinearTetrahedra, TetrahedralMesh};
/// let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let mesh = TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]])?;
/// assert_eq!(LinearTetrahedra::new(mesh, 1)?.components(), 12); // 4 corners
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub type LinearTetrahedra = TetrahedralElements<4>;

/// Elements with nodes at the corners and at the midpoints of the edges.
///
/// Edges are straight in the reference configuration. Nodes are numbered vertices first, then edges.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{QuadraticTetrahedra, TetrahedralMesh};
/// let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let mesh = TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]])?;
/// assert_eq!(QuadraticTetrahedra::new(mesh, 2)?.components(), 30); // 4 corners and 6 edges
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub type QuadraticTetrahedra = TetrahedralElements<10>;

/// A point of the rule in a body of elements, in the reference configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MaterialPoint {
    /// Its place X, m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub position: Vector3<f64>,
    /// Its share of the volume, m³.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub weight: f64,
    /// The element it lies in.
    pub element: usize,
    /// Its number among all points of the body: where what it remembers is stored.
    pub index: usize,
}

impl LinearTetrahedra {
    /// Linear elements on a mesh, integrated by rules of `degree`.
    ///
    /// Degree 0 is exact for stress, which is constant in an element; 1 for uniform forces per volume; 2 for the
    /// consistent mass of a uniform density.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`].
    pub fn new(mesh: TetrahedralMesh, degree: usize) -> Result<Self, FieldsError> {
        let (nodes, elements) = (mesh.vertices().to_vec(), mesh.tetrahedra().to_vec());
        Self::of_shape(mesh, nodes, elements, degree, shape::linear)
    }
}

impl QuadraticTetrahedra {
    /// Quadratic elements on a mesh, integrated by rules of `degree`.
    ///
    /// Degree 2 is exact for stress linear in ∇u and uniform forces per volume; 4 for the consistent mass of a uniform
    /// density.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`].
    pub fn new(mesh: TetrahedralMesh, degree: usize) -> Result<Self, FieldsError> {
        let edges = mesh.edges();
        let mut nodes = mesh.vertices().to_vec();
        nodes.extend(edges.iter().map(|&[a, b]| (mesh.vertices()[a] + mesh.vertices()[b]) * 0.5));
        let elements = mesh.tetrahedra().iter().map(|tetrahedron| mesh.nodes_of(tetrahedron, &edges)).collect();
        Self::of_shape(mesh, nodes, elements, degree, shape::quadratic)
    }
}

impl<const N: usize> TetrahedralElements<N> {
    fn of_shape(
        mesh: TetrahedralMesh,
        nodes: Vec<Vector3<f64>>,
        elements: Vec<[usize; N]>,
        degree: usize,
        shape: Shape<N>,
    ) -> Result<Self, FieldsError> {
        let quadrature = Quadrature::of_degree(degree)?;
        let gradients = (0..elements.len()).map(|element| barycentric_gradients(&mesh.corners(element))).collect();
        let inside = shape::inside(&quadrature, shape);
        let on_faces = shape::on_faces(&quadrature, shape);
        Ok(Self { mesh, nodes, elements, gradients, inside, on_faces })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &TetrahedralMesh {
        &self.mesh
    }

    /// The places of the nodes in the reference configuration, m.
    #[must_use]
    pub fn nodes(&self) -> &[Vector3<f64>] {
        &self.nodes
    }

    /// The nodes of each element: corners, then midpoints of the edges 01, 12, 02, 03, 13, 23.
    #[must_use]
    pub fn elements(&self) -> &[[usize; N]] {
        &self.elements
    }

    /// The number of components of a nodal vector, 3 × nodes.
    #[must_use]
    pub fn components(&self) -> usize {
        3 * self.nodes.len()
    }

    /// The number of points of the rule in the body: for what a material remembers.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.elements.len() * self.inside.len()
    }

    /// Samples a field of vectors at the nodes.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`].
    ///
    /// # Example
    /// See [`integral`](Self::integral).
    pub fn sample_into<T: Real>(
        &self,
        mut field: impl FnMut(&Vector3<f64>) -> Vector3<T>,
        values: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("nodal vector", values.len(), self.components())?;
        for (node, value) in self.nodes.iter().zip(values.chunks_exact_mut(3)) {
            value.copy_from_slice(field(node).as_slice());
        }
        Ok(())
    }

    /// ∫ h(X, u, ∇u) dV of a nodal field u: norms, energies, momenta.
    ///
    /// The gradient is a plain matrix, `∂u_i/∂X_j` at row i and column j, which may belong to any field, not only to a
    /// displacement.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`], [`FieldsError::IntegrandNotFinite`], the integrand's own.
    pub fn integral<T: Real, V: Integrand<Scalar = T>>(
        &self,
        field: &[T],
        mut integrand: impl FnMut(&MaterialPoint, &Vector3<T>, &nalgebra::Matrix3<T>) -> Result<V, FieldsError>,
    ) -> Result<V, FieldsError> {
        check_length("nodal vector", field.len(), self.components())?;
        let mut integral = RunningIntegral::new();
        for element in 0..self.elements.len() {
            let local = self.local(element, field);
            for number in 0..self.inside.len() {
                let point = self.material_point(element, number);
                let slopes = self.slopes(element, number);
                let value = Vector3::from(value_of(&self.inside[number].values, &local));
                let term = integrand(&point, &value, &from_rows(gradient_of(&slopes, &local)))?;
                integral.add(&term, T::lit(point.weight), &point.position.map(T::lit))?;
            }
        }
        integral.value()
    }

    /// The strain energy ∫ W(∇u) dV.
    ///
    /// # Errors
    /// As [`integral`](Self::integral); [`FieldsError::InvertedElement`] where 0 < det F is violated.
    ///
    /// # Source
    /// B(4.61).
    pub fn strain_energy<T: Real>(
        &self,
        displacement: &[T],
        mut energy: impl FnMut(&MaterialPoint, &DisplacementGradient<T>) -> Result<T, FieldsError>,
    ) -> Result<T, FieldsError> {
        let [total] = self
            .integral(displacement, |point, _, gradient| Ok([energy(point, &checked_gradient(point, *gradient)?)?]))?;
        Ok(total)
    }

    fn material_point(&self, element: usize, number: usize) -> MaterialPoint {
        let shape = &self.inside[number];
        MaterialPoint {
            position: super::mesh::weighted(&shape.share, &self.mesh.corners(element)),
            weight: shape.weight * self.mesh.volumes()[element],
            element,
            index: element * self.inside.len() + number,
        }
    }

    /// ∇Nₐ at a point of the rule.
    fn slopes(&self, element: usize, number: usize) -> [[f64; 3]; N] {
        let gradients = &self.gradients[element];
        self.inside[number].slopes.map(|slopes| {
            let mut gradient = [0.0; 3];
            for (slope, of_share) in slopes.iter().zip(gradients) {
                for (component, &g) in gradient.iter_mut().zip(of_share) {
                    *component += slope * g;
                }
            }
            gradient
        })
    }

    /// The values at the nodes of an element.
    fn local<T: Real>(&self, element: usize, field: &[T]) -> [[T; 3]; N] {
        self.elements[element].map(|node| [field[3 * node], field[3 * node + 1], field[3 * node + 2]])
    }
}

/// The gradients of the barycentric coordinates.
fn barycentric_gradients(corners: &[Vector3<f64>; 4]) -> [[f64; 3]; 4] {
    let edges = [1, 2, 3].map(|i| corners[i] - corners[0]);
    // Rows e_i; the columns of the inverse are the gradients of λ₁, λ₂, λ₃.
    let (inverse, _) = inverse_and_determinant(edges.map(|edge| [edge.x, edge.y, edge.z]));
    let mut gradients = [[0.0; 3]; 4];
    for k in 0..3 {
        for i in 0..3 {
            gradients[k + 1][i] = inverse[i][k];
            gradients[0][i] -= inverse[i][k];
        }
    }
    gradients
}

/// Σ Nₐ uₐ.
fn value_of<T: Real, const N: usize>(values: &[f64; N], local: &[[T; 3]; N]) -> [T; 3] {
    let mut value = [T::lit(0.0); 3];
    for (&shape, at_node) in values.iter().zip(local) {
        for (component, &u) in value.iter_mut().zip(at_node) {
            *component += u * T::lit(shape);
        }
    }
    value
}

/// Σ uₐ ⊗ ∇Nₐ.
fn gradient_of<T: Real, const N: usize>(slopes: &[[f64; 3]; N], local: &[[T; 3]; N]) -> Rows<T> {
    let mut gradient = [[T::lit(0.0); 3]; 3];
    for (slope, at_node) in slopes.iter().zip(local) {
        for (row, &u) in gradient.iter_mut().zip(at_node) {
            for (entry, &s) in row.iter_mut().zip(slope) {
                *entry += u * T::lit(s);
            }
        }
    }
    gradient
}

/// ∇u with 0 < det F, or the element that is turned inside out.
fn checked_gradient<T: Real>(
    point: &MaterialPoint,
    gradient: nalgebra::Matrix3<T>,
) -> Result<DisplacementGradient<T>, FieldsError> {
    DisplacementGradient::new(gradient).map_err(|error| match error {
        ContinuumError::NonPositiveJacobian { determinant } => {
            FieldsError::InvertedElement { element: point.element, volume: determinant * point.weight }
        }
        other => other.into(),
    })
}

fn check_length(quantity: &'static str, found: usize, expected: usize) -> Result<(), FieldsError> {
    if found == expected { Ok(()) } else { Err(FieldsError::WrongLength { quantity, found, expected }) }
}
