//! The objective rates.

use piola_numerics::Real;
use piola_tensor::internal::rows::{Rows, transpose};

use super::material_rate::MaterialRate;
use crate::rates::kernels::transported;
use crate::rates::{LogarithmicSpin, PolarSpin, Spin, VelocityGradient};
use crate::{CauchyStress, Deformation, KirchhoffStress, SecondPiola, Symmetric};

/// A symmetric measure of stress whose components refer to space on both sides.
pub trait SpatialStress<T: Real>: Copy {
    /// The measure with these components.
    #[must_use]
    fn of_tensor(tensor: Symmetric<T>) -> Self;
    /// The components.
    #[must_use]
    fn tensor(&self) -> Symmetric<T>;
}

impl<T: Real> SpatialStress<T> for CauchyStress<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_tensor(tensor: Symmetric<T>) -> Self {
        Self(tensor)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tensor(&self) -> Symmetric<T> {
        self.0
    }
}

impl<T: Real> SpatialStress<T> for KirchhoffStress<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_tensor(tensor: Symmetric<T>) -> Self {
        Self(tensor)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tensor(&self) -> Symmetric<T> {
        self.0
    }
}

/// A rate by which a spatial tensor is carried: A with T° = Ṫ − A T − T Aᵀ.
pub trait Carrier<T: Real> {
    /// A, 1/s.
    #[must_use]
    fn carrier_rows(&self) -> Rows<T>;
}

macro_rules! carrier {
    ($($name:ident)*) => { $(
        impl<T: Real> Carrier<T> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn carrier_rows(&self) -> Rows<T> {
                self.rows()
            }
        }
    )* };
}
carrier!(Spin PolarSpin LogarithmicSpin VelocityGradient);

macro_rules! carried_rate {
    ($(#[$documentation:meta])* $name:ident, $carrier:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[repr(transparent)]
        pub struct $name<S>(
            /// The components, Pa/s.
            pub S,
        );

        impl<S> $name<S> {
            /// From the stress, its material derivative and what carries it.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn of<T: Real>(stress: &S, rate: &MaterialRate<S>, carrier: &$carrier<T>) -> Self
            where
                S: SpatialStress<T>,
            {
                Self(S::of_tensor(rate.0.tensor() - transported(carrier.carrier_rows(), &stress.tensor())))
            }

            /// The material derivative of which this is the objective rate.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn material<T: Real>(&self, stress: &S, carrier: &$carrier<T>) -> MaterialRate<S>
            where
                S: SpatialStress<T>,
            {
                MaterialRate(S::of_tensor(self.0.tensor() + transported(carrier.carrier_rows(), &stress.tensor())))
            }
        }
        connected!($name);
    };
}

/// τ° = J (T° + T tr D) and back.
macro_rules! connected {
    ($name:ident) => {
        impl<T: Real> $name<CauchyStress<T>> {
            /// The same rate of Kirchhoff's stress: τ° = J (T° + T tr D).
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn kirchhoff(
                &self,
                stress: &CauchyStress<T>,
                deformation: &impl Deformation<T>,
                velocity_gradient: &VelocityGradient<T>,
            ) -> $name<KirchhoffStress<T>> {
                let total = self.0.0 + stress.0 * velocity_gradient.divergence();
                $name(KirchhoffStress(total * deformation.jacobian()))
            }
        }
        impl<T: Real> $name<KirchhoffStress<T>> {
            /// The same rate of Cauchy's stress: T° = (τ° − τ tr D)/J.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn cauchy(
                &self,
                stress: &KirchhoffStress<T>,
                deformation: &impl Deformation<T>,
                velocity_gradient: &VelocityGradient<T>,
            ) -> $name<CauchyStress<T>> {
                let difference = self.0.0 - stress.0 * velocity_gradient.divergence();
                $name(CauchyStress(difference * deformation.jacobian().recip()))
            }
        }
    };
}

carried_rate! {
    /// Jaumann's (Zaremba's) rate T° = Ṫ − W T + T W: the rate seen in axes that turn with the spin W.
    ///
    /// In simple shear at a constant rate it makes a hypoelastic stress oscillate, because the axes never stop turning.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::{CauchyStress, rates::Spin, stress::rates::{JaumannRate, MaterialRate}};
    /// // A pull along x, turning rigidly about z at 1 rad/s: Ṫ = W T − T W, and the objective rate is zero.
    /// let pull = CauchyStress::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let rate = MaterialRate(CauchyStress::new(0.0, 0.0, 0.0, 5.0, 0.0, 0.0)?);
    /// let spin = Spin::new(Vector3::z())?;
    /// assert_eq!(JaumannRate::of(&pull, &rate, &spin).0, CauchyStress::zero());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    JaumannRate, Spin
}
carried_rate! {
    /// Green and Naghdi's rate T° = Ṫ − Ω T + T Ω with the polar spin Ω = Ṙ Rᵀ: R (Rᵀ T R)˙ Rᵀ.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::{CauchyStress, rates::PolarSpin, stress::rates::{GreenNaghdiRate, MaterialRate}};
    /// let pull = CauchyStress::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let still = MaterialRate(CauchyStress::zero());
    /// let rate = GreenNaghdiRate::of(&pull, &still, &PolarSpin::new(Vector3::z())?);
    /// assert_eq!(rate.0, CauchyStress::new(0.0, 0.0, 0.0, -5.0, 0.0, 0.0)?); // the body turns under a fixed stress
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    GreenNaghdiRate, PolarSpin
}
carried_rate! {
    /// The logarithmic rate T° = Ṫ − Ω T + T Ω with the spin Ω for which (ln V)° = D.
    ///
    /// The one corotational rate with which the simplest hypoelastic law, τ° = λ (tr D) 1 + 2μ D, is elastic, and even
    /// hyperelastic in ln V. H. Xiao, O. T. Bruhns & A. Meyers, *Acta Mech.* 124 (1997).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::{KirchhoffStress, rates::LogarithmicSpin, stress::rates::{LogarithmicRate, MaterialRate}};
    /// let stress = KirchhoffStress::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let rate = MaterialRate(KirchhoffStress::new(0.0, 0.0, 0.0, 5.0, 0.0, 0.0)?);
    /// let spin = LogarithmicSpin::new(Vector3::z())?;
    /// assert_eq!(LogarithmicRate::of(&stress, &rate, &spin).0, KirchhoffStress::zero());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    LogarithmicRate, LogarithmicSpin
}
carried_rate! {
    /// Oldroyd's upper-convected rate T° = Ṫ − L T − T Lᵀ: F (F⁻¹ T F⁻ᵀ)˙ Fᵀ, the Lie derivative.
    ///
    /// Of Kirchhoff's stress it is F Ṡ Fᵀ, see [`of_second_piola`](UpperConvectedRate::of_second_piola).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{CauchyStress, rates::VelocityGradient, stress::rates::{MaterialRate, UpperConvectedRate}};
    /// // T = 1 in steady shear: its upper-convected rate is −2D.
    /// let unit = CauchyStress::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)?;
    /// let shear = VelocityGradient::new(Matrix3::new(0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let rate = UpperConvectedRate::of(&unit, &MaterialRate(CauchyStress::zero()), &shear);
    /// assert_eq!(rate.0, CauchyStress::new(0.0, 0.0, 0.0, -2.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    UpperConvectedRate, VelocityGradient
}

/// Cotter and Rivlin's lower-convected rate T° = Ṫ + Lᵀ T + T L: F⁻ᵀ (Fᵀ T F)˙ F⁻¹.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{CauchyStress, rates::VelocityGradient, stress::rates::{LowerConvectedRate, MaterialRate}};
/// // T = 1 in steady shear: its lower-convected rate is 2D.
/// let unit = CauchyStress::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)?;
/// let shear = VelocityGradient::new(Matrix3::new(0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
/// let rate = LowerConvectedRate::of(&unit, &MaterialRate(CauchyStress::zero()), &shear);
/// assert_eq!(rate.0, CauchyStress::new(0.0, 0.0, 0.0, 2.0, 0.0, 0.0)?);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(transparent)]
pub struct LowerConvectedRate<S>(
    /// The components, Pa/s.
    pub S,
);
connected!(LowerConvectedRate);

impl<S> LowerConvectedRate<S> {
    /// From the stress, its material derivative and the velocity gradient.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of<T: Real>(stress: &S, rate: &MaterialRate<S>, velocity_gradient: &VelocityGradient<T>) -> Self
    where
        S: SpatialStress<T>,
    {
        let carried = transported(transpose(velocity_gradient.rows()), &stress.tensor());
        Self(S::of_tensor(rate.0.tensor() + carried))
    }

    /// The material derivative of which this is the objective rate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material<T: Real>(&self, stress: &S, velocity_gradient: &VelocityGradient<T>) -> MaterialRate<S>
    where
        S: SpatialStress<T>,
    {
        let carried = transported(transpose(velocity_gradient.rows()), &stress.tensor());
        MaterialRate(S::of_tensor(self.0.tensor() - carried))
    }
}

/// Truesdell's rate T° = Ṫ − L T − T Lᵀ + T tr L = J⁻¹ F Ṡ Fᵀ of Cauchy's stress.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{CauchyStress, rates::VelocityGradient, stress::rates::{MaterialRate, TruesdellRate}};
/// // A pressure kept while the body grows by 3 × 1/s in volume: −2 + 3 = 1 times the stress.
/// let pressure = CauchyStress::new(-4.0, -4.0, -4.0, 0.0, 0.0, 0.0)?;
/// let growth = VelocityGradient::new(Matrix3::identity())?;
/// let rate = TruesdellRate::of(&pressure, &MaterialRate(CauchyStress::zero()), &growth);
/// assert_eq!(rate.0, pressure);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(transparent)]
pub struct TruesdellRate<S>(
    /// The components, Pa/s.
    pub S,
);

impl<T: Real> TruesdellRate<CauchyStress<T>> {
    /// From the stress, its material derivative and the velocity gradient.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(
        stress: &CauchyStress<T>,
        rate: &MaterialRate<CauchyStress<T>>,
        velocity_gradient: &VelocityGradient<T>,
    ) -> Self {
        Self(CauchyStress(rate.0.0 - transported(half_less_divergence(velocity_gradient), &stress.0)))
    }

    /// The material derivative of which this is the objective rate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material(
        &self,
        stress: &CauchyStress<T>,
        velocity_gradient: &VelocityGradient<T>,
    ) -> MaterialRate<CauchyStress<T>> {
        MaterialRate(CauchyStress(self.0.0 + transported(half_less_divergence(velocity_gradient), &stress.0)))
    }

    /// J times this rate: the upper-convected rate of Kirchhoff's stress.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn upper_convected(&self, deformation: &impl Deformation<T>) -> UpperConvectedRate<KirchhoffStress<T>> {
        UpperConvectedRate(KirchhoffStress(self.0.0 * deformation.jacobian()))
    }
}

/// L − ½ (tr L) 1, so that A T + T Aᵀ = L T + T Lᵀ − T tr L without forming the larger terms.
#[cfg_attr(not(debug_assertions), inline(always))]
fn half_less_divergence<T: Real>(velocity_gradient: &VelocityGradient<T>) -> Rows<T> {
    let mut l = velocity_gradient.rows();
    let half = T::lit(0.5) * velocity_gradient.divergence();
    l[0][0] -= half;
    l[1][1] -= half;
    l[2][2] -= half;
    l
}

impl<T: Real> UpperConvectedRate<KirchhoffStress<T>> {
    /// F Ṡ Fᵀ, from the rate of the second Piola–Kirchhoff stress.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_second_piola(rate: &MaterialRate<SecondPiola<T>>, deformation: &impl Deformation<T>) -> Self {
        let f = deformation.gradient_rows();
        let pushed = rate.0.0.congruence(f);
        Self(KirchhoffStress(pushed))
    }
}
