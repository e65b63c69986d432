//! Stiffness of anisotropic bodies, from engineering constants or components.

use nalgebra::{Matrix3, Matrix6};
use piola_numerics::linear::matrix3::{cross, from_rows, inverse_and_determinant};
use piola_tensor::{MajorSymmetric, PairSymmetric};

use super::Fibre;
use crate::SolidsError;
use crate::error::{check_bound, check_finite};

const LAW: &str = "stiffness";

/// A positive definite quadratic form of strains: A : C : A > 0 for every symmetric A.
///
/// In Pa it is the stiffness of a linear law or of St. Venant and Kirchhoff's; without unit, the exponents of
/// [`Fung`](super::Fung). Written as the 6×6 array of its components `C_ijkl` over 11, 22, 33, 12, 23, 13.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_solids::{EngineeringConstants, Stiffness};
/// use piola_tensor::PairSymmetric;
/// let wood = EngineeringConstants { young: [12.0, 1.0, 0.5], poisson: [0.0, 0.0, 0.0], shear: [0.8, 0.1, 0.7] };
/// let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
/// let turned = Stiffness::orthotropic(&wood, &quarter_turn)?;
/// assert_eq!(turned.tensor().entry(1, 1, 1, 1), 12.0); // the grain is along 2
/// assert!(Stiffness::orthotropic(&EngineeringConstants { young: [-1.0, 1.0, 1.0], ..wood }, &quarter_turn).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// Bounds: B. M. Lempriere, AIAA J. 6 (1968) 2226–2227.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "MajorSymmetric", into = "MajorSymmetric"))]
pub struct Stiffness {
    tensor: MajorSymmetric,
}

/// The nine constants of an orthotropic body in its own axes.
///
/// | symbol | field | order | bounds |
/// |---|---|---|---|
/// | E | `young`, Pa | 1, 2, 3 | 0 < Eᵢ |
/// | νᵢⱼ, the contraction along j under tension along i | `poisson` | 12, 23, 13 | νᵢⱼ² < Eᵢ/Eⱼ, and 0 < Δ |
/// | G | `shear`, Pa | 12, 23, 13 | 0 < Gᵢⱼ |
///
/// ```text
/// νⱼᵢ/Eⱼ = νᵢⱼ/Eᵢ        Δ = 1 − ν₁₂ ν₂₁ − ν₂₃ ν₃₂ − ν₁₃ ν₃₁ − 2 ν₂₁ ν₃₂ ν₁₃
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EngineeringConstants {
    /// E₁, E₂, E₃, Pa.
    pub young: [f64; 3],
    /// ν₁₂, ν₂₃, ν₁₃.
    pub poisson: [f64; 3],
    /// G₁₂, G₂₃, G₁₃, Pa.
    pub shear: [f64; 3],
}

/// The five constants of a body that is isotropic across a direction.
///
/// | symbol | field | bounds |
/// |---|---|---|
/// | `E_a`, `E_t` | `young_along`, `young_across`, Pa | 0 < E |
/// | `ν_at`, the contraction across under tension along | `poisson_along` | `2 ν_at² < (1 − ν_tt) E_a/E_t` |
/// | `ν_tt` | `poisson_across` | `−1 < ν_tt < 1` |
/// | `G_at` | `shear_along`, Pa | `0 < G_at` |
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct TransverseConstants {
    /// `E_a` along the direction, Pa.
    pub young_along: f64,
    /// `E_t` across it, Pa.
    pub young_across: f64,
    /// `ν_at`.
    pub poisson_along: f64,
    /// `ν_tt`.
    pub poisson_across: f64,
    /// `G_at`, Pa.
    pub shear_along: f64,
}

impl Stiffness {
    /// From the components.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] with the first pivot of C that is not positive.
    pub fn new(tensor: MajorSymmetric) -> Result<Self, SolidsError> {
        // In an orthonormal basis of symmetric tensors: shears count √2.
        let mut m = tensor.slots();
        for (i, row) in m.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                check_finite(LAW, "C", *entry)?;
                let shears = usize::from(2 < i) + usize::from(2 < j);
                *entry *= [1.0, core::f64::consts::SQRT_2, 2.0][shears];
            }
        }
        for k in 0..6 {
            let scale = tensor.slots()[k][k].abs() * 64.0 * f64::EPSILON;
            check_bound(LAW, "pivot of C", m[k][k], "0 < A : C : A", scale < m[k][k])?;
            for i in k + 1..6 {
                let factor = m[i][k] / m[k][k];
                let pivot = m[k];
                for (entry, above) in m[i].iter_mut().zip(pivot).skip(k + 1) {
                    *entry -= factor * above;
                }
            }
        }
        Ok(Self { tensor })
    }

    /// From the 6×6 matrix σ = M ε with engineering shears, in the order 11, 22, 33, 12, 23, 13.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`SolidsError::Continuum`] unless M is symmetric to rounding.
    pub fn from_matrix(matrix: &Matrix6<f64>) -> Result<Self, SolidsError> {
        Self::new(MajorSymmetric::from_matrix(matrix)?)
    }

    /// λ 1 ⊗ 1 + 2 μ identity.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn isotropic(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, mu) = (first_lame_parameter, shear_modulus);
        check_bound(LAW, "shear_modulus", mu, "0 < μ", 0.0 < mu)?;
        check_bound(LAW, "first_lame_parameter", lambda, "0 < λ + ⅔ μ", 0.0 < lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { tensor: MajorSymmetric::isotropic(lambda, mu) })
    }

    /// The three constants of a cubic crystal in its axes, the columns of `axes`.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] unless 0 < c₄₄, 0 < c₁₁ − c₁₂ and 0 < c₁₁ + 2 c₁₂;
    /// [`SolidsError::Continuum`] unless `axes` is a rotation.
    pub fn cubic(c11: f64, c12: f64, c44: f64, axes: &Matrix3<f64>) -> Result<Self, SolidsError> {
        check_bound(LAW, "c44", c44, "0 < c44", 0.0 < c44)?;
        check_bound(LAW, "c12", c12, "c12 < c11", c12 < c11)?;
        check_bound(LAW, "c11", c11, "0 < c11 + 2 c12", 0.0 < c11 + 2.0 * c12)?;
        let normal = [[c11, c12, c12], [c12, c11, c12], [c12, c12, c11]];
        Ok(Self { tensor: of_blocks(&normal, [c44; 3]).rotated(axes)? })
    }

    /// From the nine constants and the axes of the body, the columns of `axes`.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] naming the constant;
    /// [`SolidsError::Continuum`] unless `axes` is a rotation.
    pub fn orthotropic(constants: &EngineeringConstants, axes: &Matrix3<f64>) -> Result<Self, SolidsError> {
        let EngineeringConstants { young: [e1, e2, e3], poisson: [n12, n23, n13], shear } = *constants;
        for (name, modulus) in [("E1", e1), ("E2", e2), ("E3", e3)] {
            check_bound(LAW, name, modulus, "0 < E", 0.0 < modulus)?;
        }
        for (name, modulus) in [("G12", shear[0]), ("G23", shear[1]), ("G13", shear[2])] {
            check_bound(LAW, name, modulus, "0 < G", 0.0 < modulus)?;
        }
        check_bound(LAW, "nu12", n12, "nu12² < E1/E2", n12 * n12 < e1 / e2)?;
        check_bound(LAW, "nu23", n23, "nu23² < E2/E3", n23 * n23 < e2 / e3)?;
        check_bound(LAW, "nu13", n13, "nu13² < E1/E3", n13 * n13 < e1 / e3)?;
        let (n21, n32, n31) = (n12 * e2 / e1, n23 * e3 / e2, n13 * e3 / e1);
        let delta = 1.0 - n12 * n21 - n23 * n32 - n13 * n31 - 2.0 * n21 * n32 * n13;
        let bound = "0 < 1 − nu12 nu21 − nu23 nu32 − nu13 nu31 − 2 nu21 nu32 nu13";
        check_bound(LAW, "determinant of the compliance", delta, bound, 4.0 * f64::EPSILON < delta)?;
        let compliance =
            [[1.0 / e1, -n12 / e1, -n13 / e1], [-n12 / e1, 1.0 / e2, -n23 / e2], [-n13 / e1, -n23 / e2, 1.0 / e3]];
        let (normal, _) = inverse_and_determinant(compliance);
        Ok(Self { tensor: of_blocks(&normal, shear).rotated(axes)? })
    }

    /// From the five constants and the direction of the fibres.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] naming the constant.
    pub fn transversely_isotropic(constants: &TransverseConstants, fibre: Fibre) -> Result<Self, SolidsError> {
        let TransverseConstants { young_along, young_across, poisson_along, poisson_across, shear_along } = *constants;
        check_bound(LAW, "young_along", young_along, "0 < E_a", 0.0 < young_along)?;
        check_bound(LAW, "young_across", young_across, "0 < E_t", 0.0 < young_across)?;
        check_bound(LAW, "shear_along", shear_along, "0 < G_at", 0.0 < shear_along)?;
        let inside = -1.0 < poisson_across && poisson_across < 1.0;
        check_bound(LAW, "poisson_across", poisson_across, "−1 < nu_tt < 1", inside)?;
        let limit = (1.0 - poisson_across) * young_along / young_across;
        let holds = 2.0 * poisson_along * poisson_along < limit;
        check_bound(LAW, "poisson_along", poisson_along, "2 nu_at² < (1 − nu_tt) E_a/E_t", holds)?;
        let across = young_across / (2.0 * (1.0 + poisson_across));
        Self::orthotropic(
            &EngineeringConstants {
                young: [young_along, young_across, young_across],
                poisson: [poisson_along, poisson_across, poisson_along],
                shear: [shear_along, across, shear_along],
            },
            &frame_along(fibre),
        )
    }

    /// The components.
    #[must_use]
    pub const fn tensor(&self) -> &MajorSymmetric {
        &self.tensor
    }
}

/// C of the normal block and the shears 12, 23, 13.
fn of_blocks(normal: &[[f64; 3]; 3], [g12, g23, g13]: [f64; 3]) -> MajorSymmetric {
    let [[a, b, c], [_, d, e], [_, _, f]] = *normal;
    let o = 0.0;
    MajorSymmetric { components: [a, b, c, o, o, o, d, e, o, o, o, f, o, o, o, g12, o, o, g23, o, g13] }
}

/// A right-handed frame whose first axis, the first column, is that of the fibre.
fn frame_along(fibre: Fibre) -> Matrix3<f64> {
    let a = fibre.direction();
    // The axis of coordinates that is farthest from the fibre.
    let mut least = 0;
    for k in 1..3 {
        if a[k].abs() < a[least].abs() {
            least = k;
        }
    }
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let b = cross(a, axis);
    let length = b.iter().map(|x| x * x).sum::<f64>().sqrt();
    let b = b.map(|x| x / length);
    from_rows([a, b, cross(a, b)]).transpose()
}

impl TryFrom<MajorSymmetric> for Stiffness {
    type Error = SolidsError;

    fn try_from(tensor: MajorSymmetric) -> Result<Self, SolidsError> {
        Self::new(tensor)
    }
}

impl From<Stiffness> for MajorSymmetric {
    fn from(stiffness: Stiffness) -> Self {
        stiffness.tensor
    }
}
