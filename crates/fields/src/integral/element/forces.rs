//! Forces on the nodes, by virtual work.

use nalgebra::Vector3;
use piola_continuum::{DisplacementGradient, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::internal::rows::apply;

use super::{MaterialPoint, TetrahedralElements, check_length, checked_gradient, gradient_of};
use crate::FieldsError;
use crate::integral::mesh::{FACES, normal_and_area, weighted};
use crate::integral::{BoundaryTriangle, SurfacePoint};

impl<const N: usize> TetrahedralElements<N> {
    /// Adds the forces of stress on the nodes, −∫ P ∇Nₐ dV.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | u | `displacement` | 3 × nodes | m |
    /// | P(X, ∇u) | `stress` | 3×3 | Pa |
    /// | F | `forces` | 3 × nodes | N |
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`]; [`FieldsError::InvertedElement`] where 0 < det F is violated (its
    /// volume is the point's share times det F); [`FieldsError::NotFinite`]; the stress's own. What was added
    /// before an error stays added.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_fields::integral::{Cuboid, LinearTetrahedra, TetrahedralMesh};
    /// use piola_continuum::{DisplacementGradient, FirstPiola};
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let body = LinearTetrahedra::new(TetrahedralMesh::of_cuboid(&unit, [2, 2, 2])?, 0)?;
    /// let (rest, mut forces) = (vec![0.0; body.components()], vec![0.0; body.components()]);
    /// let tension = |_: &_, _: &DisplacementGradient| Ok(FirstPiola(nalgebra::Matrix3::from_diagonal_element(1.0)));
    /// body.add_stress_forces(&rest, tension, &mut forces)?;
    /// // Uniform stress leaves the node in the middle alone: Div P = 0.
    /// assert!(forces[3 * 13..3 * 14].iter().all(|force| force.abs() < 1e-15));
    /// # Ok::<(), piola_fields::FieldsError>(())
    /// ```
    ///
    /// # Source
    /// B(4.58–4.59) in weak form.
    pub fn add_stress_forces<T: Real>(
        &self,
        displacement: &[T],
        mut stress: impl FnMut(&MaterialPoint, &DisplacementGradient<T>) -> Result<FirstPiola<T>, FieldsError>,
        forces: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("displacement", displacement.len(), self.components())?;
        check_length("forces", forces.len(), self.components())?;
        for (element, nodes) in self.elements.iter().enumerate() {
            let local = self.local(element, displacement);
            for number in 0..self.inside.len() {
                let point = self.material_point(element, number);
                let slopes = self.slopes(element, number);
                let gradient = checked_gradient(&point, from_rows(gradient_of(&slopes, &local)))?;
                let stress = stress(&point, &gradient)?.rows();
                let weight = T::lit(-point.weight);
                for (&node, slope) in nodes.iter().zip(slopes) {
                    let force = apply(stress, slope.map(T::lit));
                    add(forces, node, force, weight);
                }
            }
        }
        Ok(())
    }

    /// Adds the forces of a density of force per reference volume on the nodes, ∫ f Nₐ dV, N.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_fields::integral::{LinearTetrahedra, MaterialPoint, TetrahedralMesh};
    /// let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    /// let body = LinearTetrahedra::new(TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]])?, 1)?;
    /// let mut forces = vec![0.0_f64; body.components()];
    /// body.add_body_forces(|_: &MaterialPoint| Vector3::new(0.0, 0.0, -24.0), &mut forces)?;
    /// assert!((forces[2] + 1.0).abs() < 1e-15); // a quarter of 24 · 1/6
    /// # Ok::<(), piola_fields::FieldsError>(())
    /// ```
    pub fn add_body_forces<T: Real>(
        &self,
        mut density: impl FnMut(&MaterialPoint) -> Vector3<T>,
        forces: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("forces", forces.len(), self.components())?;
        for (element, nodes) in self.elements.iter().enumerate() {
            for (number, shape) in self.inside.iter().enumerate() {
                let point = self.material_point(element, number);
                let force: [T; 3] = density(&point).into();
                for (&node, value) in nodes.iter().zip(shape.values) {
                    add(forces, node, force, T::lit(point.weight * value));
                }
            }
        }
        Ok(())
    }

    /// Adds the forces of tractions per reference area on the nodes, ∮ g Nₐ dA, N, with g = P N for a stress P.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_fields::integral::{LinearTetrahedra, SurfacePoint, TetrahedralMesh};
    /// let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    /// let body = LinearTetrahedra::new(TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]])?, 1)?;
    /// let mut forces = vec![0.0_f64; body.components()];
    /// // Pull on the face z = 0 only.
    /// let pull = |point: &SurfacePoint<f64>| if point.normal.z == -1.0 { -Vector3::z() * 6.0 } else { Vector3::zeros() };
    /// body.add_tractions(pull, &mut forces)?;
    /// assert!((forces[2] + 1.0).abs() < 1e-15 && forces[11] == 0.0); // a third of 6 · ½; none on the tip
    /// # Ok::<(), piola_fields::FieldsError>(())
    /// ```
    pub fn add_tractions<T: Real>(
        &self,
        mut traction: impl FnMut(&SurfacePoint<f64>) -> Vector3<T>,
        forces: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("forces", forces.len(), self.components())?;
        for (face, triangle) in self.mesh.boundary().iter().enumerate() {
            let corners = self.mesh.corners(triangle.element);
            let (normal, area) = normal_and_area(&triangle.vertices.map(|vertex| self.mesh.vertices()[vertex]));
            for shape in &self.on_faces[self.side(triangle)] {
                let (position, weight) = (weighted(&shape.share, &corners), shape.weight * area);
                let force: [T; 3] = traction(&SurfacePoint { position, normal, weight, face }).into();
                for (&node, value) in self.elements[triangle.element].iter().zip(shape.values) {
                    add(forces, node, force, T::lit(weight * value));
                }
            }
        }
        Ok(())
    }

    /// Which face of its element a boundary triangle is.
    fn side(&self, triangle: &BoundaryTriangle) -> usize {
        let corners = &self.mesh.tetrahedra()[triangle.element];
        let is_it = |face: &[usize; 3]| face.iter().zip(triangle.vertices).all(|(&local, v)| corners[local] == v);
        // The triangle was made from one of the four.
        FACES.iter().position(is_it).unwrap_or(0)
    }
}

#[inline(always)]
fn add<T: Real>(forces: &mut [T], node: usize, force: [T; 3], weight: T) {
    for (sum, component) in forces[3 * node..3 * node + 3].iter_mut().zip(force) {
        *sum += component * weight;
    }
}
