//! The types of the tangents.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_tensor::{FourthOrder, Major, PairSymmetric, Symmetry};

use crate::rates::RateOfDeformation;
use crate::stress::rates::{TruesdellRate, UpperConvectedRate};
use crate::{CauchyStress, ContinuumError, KirchhoffStress, Symmetric};

/// A tangent whose major symmetry is that of the law.
macro_rules! symmetric_tangent {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            transparent,
            bound(
                serialize = "Y::Tensor<T>: serde::Serialize",
                deserialize = "Y::Tensor<T>: serde::Deserialize<'de>"
            )
        ))]
        pub struct $name<T: Real = f64, Y: Symmetry = Major>(
            /// The components, Pa, without factors for shears.
            pub Y::Tensor<T>,
        );

        impl<T: Real, Y: Symmetry> $name<T, Y> {
            /// `C_ijkl`, Pa, indices from 0.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn entry(&self, i: usize, j: usize, k: usize, l: usize) -> T {
                self.0.entry(i, j, k, l)
            }

            /// The tangent of the turned body, or of the turned basis: all four indices turned by Q.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
            pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
                Ok(Self(self.0.rotated(rotation)?))
            }
        }
    };
}

symmetric_tangent! {
    /// The material tangent C = ∂S/∂E = 2 ∂S/∂C: Ṡ = C : Ė. Pa.
    ///
    /// Entry `C_ABCD` is the derivative of `S_AB` with respect to `E_CD`, both of the symmetric pairs varied together
    /// and by half each; in [`StiffnessMatrix`](piola_tensor::voigt::StiffnessMatrix) it multiplies engineering shears
    /// as it is.
    ///
    /// # Example
    /// Saint-Venant and Kirchhoff's law S = λ tr E 1 + 2 μ E.
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::stress::tangents::{MaterialTangent, TruesdellTangent};
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let tangent: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// let spatial: TruesdellTangent = tangent.truesdell(&stretch);
    /// assert_eq!(spatial.entry(0, 0, 0, 0), 56.0); // 2⁴ · 7/J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    MaterialTangent
}
symmetric_tangent! {
    /// The tangent c of the upper-convected rate of Kirchhoff's stress, its Lie derivative:
    /// τ̇ − L τ − τ Lᵀ = F Ṡ Fᵀ = c : D. Pa.
    ///
    /// c is the push-forward of ∂S/∂E, J times the [`TruesdellTangent`].
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, stress::tangents::LieTangent};
    /// use piola_tensor::MajorSymmetric;
    /// let lie: LieTangent = LieTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// assert_eq!(lie.truesdell(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).entry(0, 0, 0, 0), 3.5); // 7/J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    LieTangent
}
symmetric_tangent! {
    /// The tangent of Truesdell's rate of Cauchy's stress: Ṫ − L T − T Lᵀ + T tr D = (c/J) : D. Pa.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, stress::tangents::TruesdellTangent};
    /// use piola_tensor::MajorSymmetric;
    /// let truesdell: TruesdellTangent = TruesdellTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// assert_eq!(truesdell.lie(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).entry(0, 0, 0, 0), 14.0); // 7 J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    TruesdellTangent
}
symmetric_tangent! {
    /// The tangent of Jaumann's rate of Kirchhoff's stress, over J: (τ̇ − W τ + τ W)/J = C : D. Pa.
    ///
    /// This is the `DDSDDE` of Abaqus' user materials; of the rate of Cauchy's stress itself see
    /// [`TruesdellTangent::of_cauchy_rate`].
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{CauchyStress, stress::tangents::JaumannTangent};
    /// use piola_tensor::MajorSymmetric;
    /// let jaumann: JaumannTangent = JaumannTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(jaumann.truesdell(&stress).entry(0, 0, 0, 0), -13.0); // 7 − 2·10
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[doc(alias = "DDSDDE")]
    JaumannTangent
}
impl<T: Real, Y: Symmetry> LieTangent<T, Y> {
    /// The upper-convected rate of τ of a rate of deformation D, Pa/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate(&self, rate_of_deformation: &RateOfDeformation<T>) -> UpperConvectedRate<KirchhoffStress<T>> {
        UpperConvectedRate(KirchhoffStress(self.0.contract(&rate_of_deformation.0)))
    }
}

impl<T: Real, Y: Symmetry> TruesdellTangent<T, Y> {
    /// Truesdell's rate of T of a rate of deformation D, Pa/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate(&self, rate_of_deformation: &RateOfDeformation<T>) -> TruesdellRate<CauchyStress<T>> {
        TruesdellRate(CauchyStress(self.0.contract(&rate_of_deformation.0)))
    }
}

impl<T: Real, Y: Symmetry> JaumannTangent<T, Y> {
    /// Jaumann's rate of τ of a rate of deformation D, over J, Pa/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate(&self, rate_of_deformation: &RateOfDeformation<T>) -> Symmetric<T> {
        self.0.contract(&rate_of_deformation.0)
    }
}

/// The tangent A = ∂P/∂F of the first Piola–Kirchhoff stress: Ṗ = A : Ḟ. Pa.
///
/// Entry `A_iAjB` is in row 3i + A and column 3j + B.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
/// use piola_continuum::{DeformationGradient, SecondPiola};
/// use piola_tensor::MajorSymmetric;
/// let material: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
/// let stress = SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
/// let tangent: FirstPiolaTangent = material.first_piola(&stress, &stretch);
/// assert_eq!(tangent.entry(0, 0, 0, 0), 38.0); // S₁₁ + 2² · 7
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(transparent, bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>"))
)]
pub struct FirstPiolaTangent<T: Real = f64>(
    /// The components, Pa.
    pub FourthOrder<T>,
);

impl<T: Real> FirstPiolaTangent<T> {
    /// `A_iAjB`, Pa, indices from 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn entry(&self, i: usize, a: usize, j: usize, b: usize) -> T {
        self.0.entry(i, a, j, b)
    }
}
