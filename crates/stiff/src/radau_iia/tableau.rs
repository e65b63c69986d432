//! What a method of the family consists of, and its collocation polynomial.

/// The largest number of stages.
pub(super) const MOST_STAGES: usize = 7;

/// The coefficients of s stages. Matrices are stored along their rows.
#[derive(Debug)]
pub struct Tableau {
    /// c₁ … cₛ = 1.
    pub nodes: &'static [f64],
    /// The real eigenvalue γ of A⁻¹.
    pub real: f64,
    /// α and β of the pairs α ± iβ of eigenvalues of A⁻¹.
    pub pairs: &'static [[f64; 2]],
    /// A.
    pub matrix: &'static [f64],
    /// T: the real eigenvector, then real and imaginary part for each pair.
    pub transformation: &'static [f64],
    /// T⁻¹.
    pub inverse: &'static [f64],
    /// d: f(t, y) + M Σ dᵢ Zᵢ / h is the defect of the collocation polynomial at the start of the step.
    pub defect: &'static [f64],
}

impl Tableau {
    /// The number of stages.
    #[must_use]
    pub const fn stages(&self) -> usize {
        self.nodes.len()
    }

    /// The weights of Z₁ … Zₛ in the collocation polynomial at θ = (t − t₀)/h, which vanishes at θ = 0.
    pub(super) fn weights_at(&self, theta: f64) -> [f64; MOST_STAGES] {
        let mut weights = [0.0; MOST_STAGES];
        for (j, (weight, cj)) in weights.iter_mut().zip(self.nodes).enumerate() {
            *weight = theta / cj;
            for (k, ck) in self.nodes.iter().enumerate() {
                if k != j {
                    *weight *= (theta - ck) / (cj - ck);
                }
            }
        }
        weights
    }
}
