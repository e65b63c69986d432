//! The extended tube of Kaliske and Heinrich.

use piola_numerics::internal::{excess_of_exponential, excess_over_logarithm};
use piola_numerics::{Real, parameters};
use piola_solids::isochoric::Isochoric;
use piola_solids::volumetric::Volumetric;
use piola_solids::{Compressible, IncompressibleSolid, SolidsError};

use super::limit::{check_below, within};
use crate::{EnergyOfStretches, OfStretches, Sum};

parameters! {
    SolidsError;
    /// The extended tube of Kaliske and Heinrich: cross-links whose chains have an end, and tubes that entanglements make around chains.
    ///
    /// ```text
    /// W = ½ Gc ((1 − δ²) x/(1 − δ² x) + ln(1 − δ² x)) + 2 Ge/β² (λ₁^(−β) + λ₂^(−β) + λ₃^(−β) − 3)      x = I₁ − 3
    /// ```
    /// The shear modulus of the reference is Gc (1 − 2 δ²) + Ge. [`incompressible`](Self::incompressible) and
    /// [`compressible`](Self::compressible) make laws of it, the [`Sum`] of a [`CrosslinkedNetwork`] and an [`EntanglementTube`].
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | Gc | `crosslink_modulus` | Pa | 0 < Gc |
    /// | δ | `inextensibility` | 1 | 0 ≤ δ, 2 δ² < 1; δ² x stays below 1 |
    /// | Ge | `confinement_modulus` | Pa | 0 ≤ Ge |
    /// | β | `exponent` | 1 | 10⁻⁶ ≤ β; below that the term is Ge Σ ln² λₐ |
    ///
    /// # Accuracy
    /// A few ulp × 1/(1 − δ² x), for small strain too.
    ///
    /// # Errors
    /// `check` of the laws refuses 1/δ² ≤ x; without it energy, stresses and tangents are NaN there.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::rubber::ExtendedTube;
    /// use piola_solids::Hyperelastic;
    /// let law = ExtendedTube::new(2.0, 0.5, 4.0, 2.0)?.incompressible();
    /// // x = k² = 1: Gc (0.75/0.75² − 0.25/0.75) k = 2, and Ge k = 4 for β = 2, where Σ λₐ⁻² = I₂.
    /// let shear: f64 = law.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3];
    /// assert!((shear - 6.0).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// M. Kaliske and G. Heinrich, Rubber Chem. Technol. 72 (1999) 602–632.
    pub struct ExtendedTube("extended tube") {
        /// Gc, Pa.
        crosslink_modulus as "gc": "0 < Gc" => 0.0 < crosslink_modulus,
        /// δ.
        inextensibility as "delta":
            "0 ≤ δ, 2 δ² < 1" => 0.0 <= inextensibility && 2.0 * inextensibility * inextensibility < 1.0,
        /// Ge, Pa.
        confinement_modulus as "ge": "0 ≤ Ge" => 0.0 <= confinement_modulus,
        /// β.
        exponent as "beta": "1e-6 ≤ β" => 1e-6 <= exponent,
    }
}

/// The extended tube that keeps its volume.
type IncompressibleTube = Sum<IncompressibleSolid<CrosslinkedNetwork>, OfStretches<EntanglementTube<false>>>;
/// The extended tube with an energy of its volume.
type CompressibleTube<U> = Sum<Compressible<CrosslinkedNetwork, U>, OfStretches<EntanglementTube<true>>>;

impl ExtendedTube {
    /// The cross-linked network.
    #[must_use]
    pub const fn network(&self) -> CrosslinkedNetwork {
        CrosslinkedNetwork { modulus: self.crosslink_modulus, inextensibility: self.inextensibility }
    }

    pub(super) const fn tube<const ISOCHORIC: bool>(&self) -> EntanglementTube<ISOCHORIC> {
        EntanglementTube { modulus: self.confinement_modulus, exponent: self.exponent }
    }

    /// The law of a body that keeps its volume, without excess pressure.
    #[must_use]
    pub const fn incompressible(&self) -> IncompressibleTube {
        Sum(IncompressibleSolid::new(self.network()), OfStretches(self.tube()))
    }

    /// The law with an energy of the volume, and W of J^(−1/3) F.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] where the bulk modulus U″(1) is negative.
    pub fn compressible<U: Volumetric>(&self, volumetric: U) -> Result<CompressibleTube<U>, SolidsError> {
        Ok(Sum(Compressible::checked(self.network(), volumetric)?, OfStretches(self.tube())))
    }

    /// The shear modulus of the reference, Gc (1 − 2 δ²) + Ge, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.network().shear_modulus() + self.confinement_modulus
    }
}

/// The energy of the cross-links of an [`ExtendedTube`], of I₁.
///
/// # Example
/// ```
/// use piola_laws::rubber::ExtendedTube;
/// use piola_solids::isochoric::Isochoric;
/// let network = ExtendedTube::new(2.0, 0.5, 4.0, 2.0)?.network();
/// assert_eq!(network.shear_modulus(), 1.0); // Gc (1 − 2 δ²)
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrosslinkedNetwork {
    modulus: f64,
    inextensibility: f64,
}

/// ½ Gc ((1 − δ²) x/(1 − δ² x) + ln(1 − δ² x)) of x = I₁ − 3, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn crosslinked_network<T: Real>(modulus: T, inextensibility: T, first: T) -> T {
    let square = inextensibility * inextensibility;
    let share = square * first;
    let left = T::one() - share;
    // ln(1 − z) = −z − (−z − ln(1 − z)).
    let energy = (T::one() - square) * first / left - share - excess_over_logarithm(-share);
    within(share, T::one(), T::lit(0.5) * modulus * energy)
}

impl Isochoric for CrosslinkedNetwork {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        crosslinked_network(T::lit(self.modulus), T::lit(self.inextensibility), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let square = self.inextensibility * self.inextensibility;
        let share = T::lit(square) * first;
        let inverse = (T::one() - share).recip();
        let slope = T::lit(0.5 * self.modulus) * inverse * (T::lit(1.0 - square) * inverse - T::lit(square));
        [within(share, T::one(), slope), T::zero()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, _second: T) -> [T; 3] {
        let square = self.inextensibility * self.inextensibility;
        let share = T::lit(square) * first;
        let inverse = (T::one() - share).recip();
        let inner = T::lit(2.0 * (1.0 - square)) * inverse - T::lit(square);
        let curvature = T::lit(0.5 * self.modulus * square) * (inverse * inverse) * inner;
        [within(share, T::one(), curvature), T::zero(), T::zero()]
    }

    fn check(&self, first: f64, _second: f64) -> Result<(), SolidsError> {
        let square = self.inextensibility * self.inextensibility;
        if 0.0 < square { check_below(ExtendedTube::NAME, "I1 − 3", first, 1.0 / square) } else { Ok(()) }
    }
}

/// The energy of the tubes of an [`ExtendedTube`], of the principal stretches; of J^(−1/3) F if `ISOCHORIC`.
///
/// # Example
/// ```
/// use piola_laws::EnergyOfStretches;
/// use piola_laws::rubber::ExtendedTube;
/// let law = ExtendedTube::new(2.0, 0.5, 4.0, 1.0)?.incompressible();
/// let part: f64 = law.1.0.part(2.0_f64.ln());
/// assert!((part - 8.0 * (0.5 - 1.0 + 2.0_f64.ln())).abs() < 1e-15); // 2 Ge/β² (λ^(−β) − 1 + β ln λ)
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EntanglementTube<const ISOCHORIC: bool> {
    modulus: f64,
    exponent: f64,
}

/// 2 Ge/β² (e^(−β x) − 1 + β x) of x = ln λ, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn tube<T: Real>(modulus: T, exponent: T, logarithm: T) -> T {
    T::lit(2.0) * modulus / (exponent * exponent) * excess_of_exponential(-(exponent * logarithm))
}

impl<const ISOCHORIC: bool> EnergyOfStretches for EntanglementTube<ISOCHORIC> {
    const ISOCHORIC: bool = ISOCHORIC;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, logarithm: T) -> T {
        tube(T::lit(self.modulus), T::lit(self.exponent), logarithm)
    }
}
