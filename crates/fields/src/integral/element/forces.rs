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

    /// Adds the forces of a force per reference volume f, N/m³, on the nodes, ∫ f Nₐ dV, N.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`].
    pub fn add_forces_per_volume<T: Real>(
        &self,
        mut force_per_volume: impl FnMut(&MaterialPoint) -> Vector3<T>,
        forces: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("forces", forces.len(), self.components())?;
        for (element, nodes) in self.elements.iter().enumerate() {
            for (number, shape) in self.inside.iter().enumerate() {
                let point = self.material_point(element, number);
                let force: [T; 3] = force_per_volume(&point).into();
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

#[cfg_attr(not(debug_assertions), inline(always))]
fn add<T: Real>(forces: &mut [T], node: usize, force: [T; 3], weight: T) {
    for (sum, component) in forces[3 * node..3 * node + 3].iter_mut().zip(force) {
        *sum += component * weight;
    }
}
