//! What a method of the family consists of, and its collocation polynomial.

use super::tables::{FIVE, SEVEN, THREE};

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

/// A method of the family Radau IIA, by its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RadauOrder {
    /// Three stages.
    Five,
    /// Five stages.
    Nine,
    /// Seven stages.
    Thirteen,
}

impl RadauOrder {
    /// All of them, the lowest first.
    pub const ALL: [Self; 3] = [Self::Five, Self::Nine, Self::Thirteen];

    /// The order: 2s − 1 for s stages.
    #[must_use]
    pub const fn value(self) -> u32 {
        match self {
            Self::Five => 5,
            Self::Nine => 9,
            Self::Thirteen => 13,
        }
    }

    /// The coefficients.
    #[must_use]
    #[doc(hidden)]
    pub const fn tableau(self) -> &'static Tableau {
        match self {
            Self::Five => &THREE,
            Self::Nine => &FIVE,
            Self::Thirteen => &SEVEN,
        }
    }

    pub(super) const fn higher(self) -> Self {
        match self {
            Self::Five => Self::Nine,
            Self::Nine | Self::Thirteen => Self::Thirteen,
        }
    }

    pub(super) const fn lower(self) -> Self {
        match self {
            Self::Five | Self::Nine => Self::Five,
            Self::Thirteen => Self::Nine,
        }
    }
}
