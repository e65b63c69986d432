//! Rates of the deformation, of strains and of stresses.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use super::kinematic::flat;
use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use super::sources::by_rows;
use super::{BatchScalar, Source};
use crate::rates::strain::GreenStrainRate;
use crate::rates::{
    AccelerationGradient, GradientRate, GradientSecondRate, GreenNaghdiRate, JaumannRate, LogarithmicRate,
    LowerConvectedRate, MaterialRate, StretchRates, RateOfDeformation, TruesdellRate, UpperConvectedRate, VelocityGradient,
    strain,
};
use crate::strain::SethHill;
use crate::tensor::rows::Rows;
use crate::{CauchyStress, Deformation, KirchhoffStress, Symmetric};

#[inline(always)]
fn rows<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Rows<T> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

macro_rules! typed {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 9> for &[$name<T>] {
            #[inline(always)]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; 9] {
                by_rows(&self[index].0)
            }
        }
    )* };
}
typed!(GradientRate VelocityGradient GradientSecondRate AccelerationGradient);

macro_rules! symmetric {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 6> for &[$name<T>] {
            #[inline(always)]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; 6] {
                self[index].0.components
            }
        }
    )* };
}
symmetric!(RateOfDeformation GreenStrainRate);

/// What is computed from Ḟ or L; for the example one component at F = diag(2, ½, ½), where both are 4 e₁ ⊗ e₁.
macro_rules! rates {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident [$k:literal] $stretch:literal
        |$point:ident, $rate:ident| $value:expr, [$place:literal] = $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        #[doc = concat!("use piola_continuum::{DeformationGradient, batch, rates::", stringify!($from), "};")]
        #[doc = concat!("let rate = [", stringify!($from), "::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?; 1000];")]
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($k), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&rate[..], &mut out[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        #[doc = concat!("assert!((request.at(&f, 7)[", stringify!($place), "] - ", stringify!($expected), ").abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(rate: S, to: V) -> Request<$name, S, V, 9, $k> {
            Request { quantity: $name, source: rate, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<9, $k> for $name {
            type Input = $from;
            type Output = Self;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = stringify!($from);

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; 9]) -> [T; $k] {
                let $rate = &$from(from_rows(rows(input)));
                $value
            }
        }
    )* };
}

rates! {
    /// L = Ḟ F⁻¹, 1/s: see [`VelocityGradient`].
    velocity_gradient VelocityGradientOutput GradientRate [9] false
        |point, rate| flat(VelocityGradient::of(point, rate).rows()), [0] = 2.0;
    /// Ḟ = L F, 1/s: see [`GradientRate`].
    gradient_rate GradientRateOutput VelocityGradient [9] false
        |point, l| flat(GradientRate::of(point, l).rows()), [0] = 8.0;
    /// D = sym L, 1/s, of L.
    stretching StretchingOutput VelocityGradient [6] false |_point, l| l.stretching().0.components, [0] = 4.0;
    /// The axial vector of W = skew L, 1/s, of L: half the vorticity.
    spin SpinOutput VelocityGradient [3] false |_point, l| l.spin().tensor().axial, [2] = 0.0;
    /// J̇ = Cof F : Ḟ, 1/s.
    jacobian_rate JacobianRate GradientRate [1] false |point, rate| [strain::jacobian_rate(point, rate)], [0] = 1.0;
    /// Ċ = Ḟᵀ F + Fᵀ Ḟ, 1/s.
    right_cauchy_green_rate RightCauchyGreenRateOutput GradientRate [6] false
        |point, rate| strain::right_cauchy_green_rate(point, rate).0.components, [0] = 16.0;
    /// Ḃ = Ḟ Fᵀ + F Ḟᵀ, 1/s.
    left_cauchy_green_rate LeftCauchyGreenRateOutput GradientRate [6] false
        |point, rate| strain::left_cauchy_green_rate(point, rate).0.components, [0] = 16.0;
    /// Ė = ½ Ċ, 1/s.
    green_rate GreenRateOutput GradientRate [6] false
        |point, rate| strain::green_rate(point, rate).0.components, [0] = 8.0;
    /// ė = ½ (Lᵀ B⁻¹ + B⁻¹ L), 1/s, of L.
    almansi_rate AlmansiRateOutput VelocityGradient [6] false
        |point, l| strain::almansi_rate(point, l).0.components, [0] = 1.0;
    /// U̇, 1/s: see [`StretchRates`].
    right_stretch_rate RightStretchRate GradientRate [6] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).right_stretch().components, [0] = 4.0;
    /// V̇, 1/s.
    left_stretch_rate LeftStretchRate GradientRate [6] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).left_stretch().components, [0] = 4.0;
    /// (ln U)˙, 1/s.
    hencky_rate HenckyRate GradientRate [6] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).hencky_material().components, [0] = 2.0;
    /// (ln V)˙, 1/s.
    hencky_rate_spatial HenckyRateSpatial GradientRate [6] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).hencky_spatial().components, [0] = 2.0;
    /// Ṙ, 1/s.
    rotation_rate RotationRate GradientRate [9] true
        |point, rate| flat(rows_of(&StretchRates::of_analysis(point.stretch(), rate).rotation())), [1] = 0.0;
    /// The axial vector of Ṙ Rᵀ, 1/s, the spin of Green and Naghdi's rate.
    polar_spin PolarSpinOutput GradientRate [3] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).polar_spin().tensor().axial, [2] = 0.0;
    /// The axial vector of Rᵀ Ṙ, 1/s, the spin of R in the reference configuration.
    material_spin MaterialSpinOutput GradientRate [3] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).material_spin().tensor().axial, [2] = 0.0;
    /// tr L = div v, 1/s, of L.
    divergence DivergenceOutput VelocityGradient [1] false |_point, l| [l.divergence()], [0] = 4.0;
    /// curl v, 1/s, of L: twice the axial vector of W.
    vorticity VorticityOutput VelocityGradient [3] false |_point, l| l.spin().vorticity().into(), [2] = 0.0;
    /// The gradient of the acceleration F̈ F⁻¹, 1/s², of F̈: see [`AccelerationGradient`].
    acceleration_gradient AccelerationGradientOutput GradientSecondRate [9] false
        |point, rate| flat(AccelerationGradient::of(point, rate).rows()), [0] = 2.0;
    /// F̈, 1/s², of the gradient of the acceleration: see [`GradientSecondRate`].
    gradient_second_rate GradientSecondRateOutput AccelerationGradient [9] false
        |point, gradient| flat(gradient.gradient_second_rate(point).rows()), [0] = 8.0;
    /// The axial vector of the logarithmic spin, 1/s.
    logarithmic_spin LogarithmicSpinOutput GradientRate [3] true
        |point, rate| StretchRates::of_analysis(point.stretch(), rate).logarithmic_spin().tensor().axial, [2] = 0.0;
}

/// Rates of a stress from it, another rate of it and L; for the example one component at F = diag(2, ½, ½) under
/// 5 e₁ ⊗ e₁, the other rate 0 and L = 4 e₁ ⊗ e₁.
macro_rules! objective {
    ($($(#[$documentation:meta])* $function:ident $name:ident $measure:ident $stretch:literal
        |$point:ident, $stress:ident, $rate:ident, $l:ident| $value:expr, $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        #[doc = concat!("use piola_continuum::{", ", DeformationGradient, batch, rates::VelocityGradient, stringify!($measure)};")]
        #[doc = concat!("let stress = [", stringify!($measure), "::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0)?; 1000];")]
        #[doc = concat!("let (still, mut out) = ([", stringify!($measure), "::zero(); 1000], [[0.0_f64; 6]; 1000]);")]
        /// let growing = [VelocityGradient::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?; 1000];
        #[doc = concat!("let request = batch::", stringify!($function), "(&stress[..], &still[..], &growing[..], &mut out[..]);")]
        /// // for `batch::evaluate`, which writes
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        #[doc = concat!("assert!((request.at(&f, 7)[0] - (", stringify!($expected), ")).abs() < 1e-13);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, R, L, V>(
            stress: S,
            stress_rate: R,
            velocity_gradient: L,
            to: V,
        ) -> Request<$name, (S, R, L), V, 21, 6> {
            Request { quantity: $name, source: (stress, stress_rate, velocity_gradient), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<21, 6> for $name {
            type Input = ($measure, $measure, VelocityGradient);
            type Output = Self;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = "stress, its rate and velocity gradient";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; 21]) -> [T; 6] {
                let $stress = &$measure(Symmetric { components: part(&input, 0) });
                let $rate = &MaterialRate($measure(Symmetric { components: part(&input, 6) }));
                let $l = &VelocityGradient(from_rows(rows(part(&input, 12))));
                $value.0.0.components
            }
        }
    )* };
}

objective! {
    /// Jaumann's rate Ṫ − W T + T W of Cauchy's stress, Pa/s: see [`JaumannRate`].
    jaumann_rate JaumannRateOutput CauchyStress false |_point, stress, rate, l| JaumannRate::of(stress, rate, &l.spin()), 0.0;
    /// Truesdell's rate Ṫ − L T − T Lᵀ + T tr L, Pa/s: see [`TruesdellRate`].
    truesdell_rate TruesdellRateOutput CauchyStress false |_point, stress, rate, l| TruesdellRate::of(stress, rate, l), -20.0;
    /// The upper-convected rate Ṫ − L T − T Lᵀ, Pa/s: see [`UpperConvectedRate`].
    upper_convected_rate UpperConvectedRateOutput CauchyStress false
        |_point, stress, rate, l| UpperConvectedRate::of(stress, rate, l), -40.0;
    /// The lower-convected rate Ṫ + Lᵀ T + T L, Pa/s: see [`LowerConvectedRate`].
    lower_convected_rate LowerConvectedRateOutput CauchyStress false
        |_point, stress, rate, l| LowerConvectedRate::of(stress, rate, l), 40.0;
    /// Green and Naghdi's rate, with the spin Ṙ Rᵀ, Pa/s: see [`GreenNaghdiRate`].
    green_naghdi_rate GreenNaghdiRateOutput CauchyStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        GreenNaghdiRate::of(stress, rate, &rates.polar_spin())
    }, 0.0;
    /// The logarithmic rate, Pa/s: see [`LogarithmicRate`].
    logarithmic_rate LogarithmicRateOutput CauchyStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        LogarithmicRate::of(stress, rate, &rates.logarithmic_spin())
    }, 0.0;
    /// Jaumann's rate τ̇ − W τ + τ W of Kirchhoff's stress, Pa/s: see [`JaumannRate`].
    kirchhoff_jaumann_rate KirchhoffJaumannRate KirchhoffStress false
        |_point, stress, rate, l| JaumannRate::of(stress, rate, &l.spin()), 0.0;
    /// The upper-convected rate τ̇ − L τ − τ Lᵀ of Kirchhoff's stress, its Lie derivative, J times Truesdell's rate of
    /// Cauchy's, Pa/s: see [`UpperConvectedRate`].
    kirchhoff_upper_convected_rate KirchhoffUpperConvectedRate KirchhoffStress false
        |_point, stress, rate, l| UpperConvectedRate::of(stress, rate, l), -40.0;
    /// The lower-convected rate τ̇ + Lᵀ τ + τ L of Kirchhoff's stress, Pa/s: see [`LowerConvectedRate`].
    kirchhoff_lower_convected_rate KirchhoffLowerConvectedRate KirchhoffStress false
        |_point, stress, rate, l| LowerConvectedRate::of(stress, rate, l), 40.0;
    /// Green and Naghdi's rate of Kirchhoff's stress, Pa/s: see [`GreenNaghdiRate`].
    kirchhoff_green_naghdi_rate KirchhoffGreenNaghdiRate KirchhoffStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        GreenNaghdiRate::of(stress, rate, &rates.polar_spin())
    }, 0.0;
    /// The logarithmic rate of Kirchhoff's stress, Pa/s: see [`LogarithmicRate`].
    kirchhoff_logarithmic_rate KirchhoffLogarithmicRate KirchhoffStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        LogarithmicRate::of(stress, rate, &rates.logarithmic_spin())
    }, 0.0;
    /// Ṫ of Jaumann's rate, Pa/s: see [`JaumannRate::material`].
    jaumann_to_material_rate JaumannToMaterialRate CauchyStress false
        |_point, stress, rate, l| JaumannRate(rate.0).material(stress, &l.spin()), 0.0;
    /// Ṫ of Truesdell's rate, Pa/s: see [`TruesdellRate::material`].
    truesdell_to_material_rate TruesdellToMaterialRate CauchyStress false
        |_point, stress, rate, l| TruesdellRate(rate.0).material(stress, l), 20.0;
    /// Ṫ of the upper-convected rate, Pa/s: see [`UpperConvectedRate::material`].
    upper_convected_to_material_rate UpperConvectedToMaterialRate CauchyStress false
        |_point, stress, rate, l| UpperConvectedRate(rate.0).material(stress, l), 40.0;
    /// Ṫ of the lower-convected rate, Pa/s: see [`LowerConvectedRate::material`].
    lower_convected_to_material_rate LowerConvectedToMaterialRate CauchyStress false
        |_point, stress, rate, l| LowerConvectedRate(rate.0).material(stress, l), -40.0;
    /// Ṫ of Green and Naghdi's rate, Pa/s: see [`GreenNaghdiRate::material`].
    green_naghdi_to_material_rate GreenNaghdiToMaterialRate CauchyStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        GreenNaghdiRate(rate.0).material(stress, &rates.polar_spin())
    }, 0.0;
    /// Ṫ of the logarithmic rate, Pa/s: see [`LogarithmicRate::material`].
    logarithmic_to_material_rate LogarithmicToMaterialRate CauchyStress true |point, stress, rate, l| {
        let rates = StretchRates::of_analysis(point.stretch(), &GradientRate::of(point, l));
        LogarithmicRate(rate.0).material(stress, &rates.logarithmic_spin())
    }, 0.0;
    /// τ̇ = J (Ṫ + T tr L) of Ṫ, Pa/s: see [`MaterialRate::kirchhoff`].
    cauchy_to_kirchhoff_rate CauchyToKirchhoffRate CauchyStress false
        |point, stress, rate, l| rate.kirchhoff(stress, point, l), 10.0;
}

/// The rates of the strains of Seth and Hill, which along dF are their derivatives.
macro_rules! seth_hill {
    ($($(#[$documentation:meta])* $function:ident $name:ident $rate:ident;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_batch as batch;
        /// use piola_continuum::{DeformationGradient, rates::GradientRate, strain::SethHill};
        /// let rate = [GradientRate::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?; 1000];
        /// let mut out = [[0.0_f64; 6]; 1000];
        #[doc = concat!("let request = batch::", stringify!($function), "(SethHill::GREEN, &rate[..], &mut out[..]);")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        /// assert!((request.at(&f, 7)[0] - 8.0).abs() < 1e-14); // λ λ̇
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(scale: SethHill, rate: S, to: V) -> Request<$name, S, V, 9, 6> {
            Request { quantity: $name(scale), source: rate, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name(SethHill);

        impl Quantity<9, 6> for $name {
            type Input = GradientRate;
            type Output = Self;
            const NEEDS_STRETCH: bool = true;
            const INPUT: &'static str = "GradientRate";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; 9]) -> [T; 6] {
                let rate = GradientRate(from_rows(rows(input)));
                StretchRates::of_analysis(point.stretch(), &rate).$rate(&self.0).components
            }
        }
    )* };
}

seth_hill! {
    /// The rate of (Uᵐ − 1)/m, 1/s: see [`StretchRates::material_function`].
    seth_hill_rate SethHillRate material_function;
    /// The rate of (Vᵐ − 1)/m, 1/s: see [`StretchRates::spatial_function`].
    seth_hill_spatial_rate SethHillSpatialRate spatial_function;
}
