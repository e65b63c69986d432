//! Masses: consistent, lumped, and the step that explicit time integration allows.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;

use super::{TetrahedralElements, check_length, value_of};
use crate::FieldsError;

impl<const N: usize> TetrahedralElements<N> {
    /// Adds the product of the consistent mass with a nodal vector, `Σ_b M_ab a_b` with `M_ab = ∫ ρ_κ N_a N_b dV`.
    ///
    /// With c in place of `ρ_κ` it is the damping of c u̇.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`].
    pub fn add_consistent_mass_product<T: Real>(
        &self,
        mut density: impl FnMut(&Vector3<f64>) -> f64,
        accelerations: &[T],
        product: &mut [T],
    ) -> Result<(), FieldsError> {
        check_length("accelerations", accelerations.len(), self.components())?;
        check_length("product", product.len(), self.components())?;
        for (element, nodes) in self.elements.iter().enumerate() {
            let local = self.local(element, accelerations);
            for (number, shape) in self.inside.iter().enumerate() {
                let point = self.material_point(element, number);
                let weight = point.weight * density(&point.position);
                let acceleration = value_of(&shape.values, &local);
                for (&node, value) in nodes.iter().zip(shape.values) {
                    let weight = T::lit(weight * value);
                    for (sum, component) in product[3 * node..3 * node + 3].iter_mut().zip(acceleration) {
                        *sum += component * weight;
                    }
                }
            }
        }
        Ok(())
    }

    /// The mass of each node: the diagonal of each element's consistent mass, scaled to the element's mass.
    ///
    /// ```text
    /// m_a = Σ_elements  m_e ∫ ρ N_a² dV / Σ_b ∫ ρ N_b² dV
    /// ```
    ///
    /// It keeps the mass and is positive, which the sum of the rows is not at the corners of quadratic elements;
    /// for linear elements of uniform density both are the same. With c in place of `ρ_κ` it lumps the damping.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`]; [`FieldsError::NonPositiveMass`] of an element, or of one of its nodes where
    /// the density changes sign.
    ///
    /// # Source
    /// Hinton, Rock, Zienkiewicz (1976).
    pub fn lumped_mass_into(
        &self,
        mut density: impl FnMut(&Vector3<f64>) -> f64,
        masses: &mut [f64],
    ) -> Result<(), FieldsError> {
        check_length("masses", masses.len(), self.nodes.len())?;
        masses.fill(0.0);
        for (element, nodes) in self.elements.iter().enumerate() {
            let (shares, mass) = self.lumped_shares(element, &mut density);
            let is_positive = shares.iter().all(|&share| 0.0 < share && share.is_finite());
            if !(is_positive && 0.0 < mass && mass.is_finite()) {
                return Err(FieldsError::NonPositiveMass { index: element, mass });
            }
            for (&node, share) in nodes.iter().zip(shares) {
                masses[node] += share * mass;
            }
        }
        Ok(())
    }

    /// The shares of its nodes in the mass of an element, and that mass.
    fn lumped_shares(&self, element: usize, density: &mut impl FnMut(&Vector3<f64>) -> f64) -> ([f64; N], f64) {
        let (mut diagonal, mut mass) = ([0.0; N], 0.0);
        for (number, shape) in self.inside.iter().enumerate() {
            let point = self.material_point(element, number);
            let weight = point.weight * density(&point.position);
            mass += weight;
            for (entry, value) in diagonal.iter_mut().zip(shape.values) {
                *entry += weight * value * value;
            }
        }
        let trace: f64 = diagonal.iter().sum();
        (diagonal.map(|entry| entry / trace), mass)
    }

    /// A step below which explicit motion with lumped masses is stable: 2/ω with a bound ω of all frequencies.
    ///
    /// ```text
    /// ω² ≤ κ max_elements λ_max(A),     A_ab = ∫ ∇N_a·∇N_b dV / √(m_a m_b),  masses of uniform density one
    /// ```
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | κ | `stiffness`: largest eigenvalue of ∂P/∂F over `ρ_κ`; small isotropic strain: `max(3λ + 2μ, 2μ)/ρ_κ` | m²/s² |
    ///
    /// # Errors
    /// [`FieldsError::NotPositive`] unless 0 < κ.
    ///
    /// # Accuracy
    /// `λ_max` is bounded from above by ‖A¹⁶‖^(1/16), at most 4 % more. The frequencies of the body are lower than
    /// those of its elements: on the meshes of the tests the step is 0.7 to 0.8 of the largest stable one.
    ///
    /// # Source
    /// Fried (1972): no frequency of the body exceeds the largest of an element.
    pub fn stable_step(&self, stiffness: f64) -> Result<f64, FieldsError> {
        if !(0.0 < stiffness && stiffness.is_finite()) {
            return Err(FieldsError::NotPositive { quantity: "stiffness", index: 0, value: stiffness });
        }
        let mut largest = 0.0_f64;
        for element in 0..self.elements.len() {
            let (shares, _) = self.lumped_shares(element, &mut |_| 1.0);
            let mut matrix = [[0.0; N]; N];
            for number in 0..self.inside.len() {
                let (slopes, weight) = (self.slopes(element, number), self.inside[number].weight);
                for a in 0..N {
                    for b in 0..N {
                        // The volume stands in the integral and in both masses.
                        matrix[a][b] += weight * dot(slopes[a], slopes[b]) / (shares[a] * shares[b]).sqrt();
                    }
                }
            }
            largest = largest.max(largest_eigenvalue_bound(matrix));
        }
        Ok(2.0 / (stiffness * largest).sqrt())
    }
}

/// An upper bound of the eigenvalues of a symmetric matrix without negative ones: ‖A¹⁶‖^(1/16).
fn largest_eigenvalue_bound<const N: usize>(mut matrix: [[f64; N]; N]) -> f64 {
    let norm = |matrix: &[[f64; N]; N]| matrix.iter().flatten().map(|entry| entry * entry).sum::<f64>().sqrt();
    let (mut bound, mut root) = (1.0, 1.0);
    for _ in 0..4 {
        // The matrix is kept near one so that its powers stay in the range of numbers.
        let size = norm(&matrix);
        if size <= 0.0 {
            return 0.0;
        }
        bound *= size.powf(root);
        root *= 0.5;
        let scaled = matrix.map(|row| row.map(|entry| entry / size));
        matrix = core::array::from_fn(|a| {
            core::array::from_fn(|b| (0..N).map(|k| scaled[a][k] * scaled[k][b]).sum::<f64>())
        });
    }
    bound * norm(&matrix).powf(root)
}
