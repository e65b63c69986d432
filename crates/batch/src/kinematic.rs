//! Outputs that need the deformation alone.

use piola_numerics::Real;

use super::point::Point;
use super::requests::{Quantity, Request};
use crate::Deformation;
use crate::strain::{
    AlmansiStrain, GreenStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen, SethHill, SethHillStrain,
    SpatialSethHillStrain, invariants,
};
use crate::tensor::rows::Rows;

/// Nine components by rows.
#[inline(always)]
pub(super) fn flat<T: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> [T; 9] {
    [a, b, c, d, e, f, g, h, i]
}

/// What is computed, and for the example one component at F = diag(2, ½, ½).
macro_rules! kinematic {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] $stretch:literal |$point:ident| $value:expr,
        [$place:literal] = $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($k), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&mut out[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
        #[doc = concat!("assert!((request.at(&f, 7)[", stringify!($place), "] - (", stringify!($expected), ")).abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<V>(to: V) -> Request<$name, (), V, 0, $k> {
            Request { quantity: $name, source: (), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<0, $k> for $name {
            type Input = ();
            type Output = Self;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = "";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, _input: [T; 0]) -> [T; $k] {
                $value
            }
        }
    )* };
}

kinematic! {
    /// J = det F.
    jacobian Jacobian [1] false |point| [point.jacobian()], [0] = 0.5;
    /// J − 1.
    volume_change VolumeChange [1] false |point| [point.volume_change()], [0] = -0.5;
    /// ln J.
    ln_jacobian LnJacobian [1] false |point| [point.ln_jacobian()], [0] = -0.693_147_180_559_945_3;
    /// F⁻¹.
    inverse Inverse [9] false |point| flat(point.inverse_rows()), [0] = 0.5;
    /// Cof F = J F⁻ᵀ.
    cofactor Cofactor [9] false |point| flat(point.cofactor_rows()), [0] = 0.25;
    /// C = Fᵀ F: see [`RightCauchyGreen`].
    right_cauchy_green RightCauchyGreenOutput [6] false |point| RightCauchyGreen::of(point).0.components, [0] = 4.0;
    /// C − 1, without cancellation from ∇u.
    right_cauchy_green_less_one RightCauchyGreenLessOne [6] false |point| RightCauchyGreen::minus_one(point).components,
        [0] = 3.0;
    /// B = F Fᵀ: see [`LeftCauchyGreen`].
    left_cauchy_green LeftCauchyGreenOutput [6] false |point| LeftCauchyGreen::of(point).0.components, [0] = 4.0;
    /// B − 1, without cancellation from ∇u.
    left_cauchy_green_less_one LeftCauchyGreenLessOne [6] false |point| LeftCauchyGreen::minus_one(point).components,
        [0] = 3.0;
    /// E = ½ (C − 1): see [`GreenStrain`].
    green_strain GreenStrainOutput [6] false |point| GreenStrain::of(point).0.components, [0] = 1.5;
    /// e = ½ (1 − B⁻¹): see [`AlmansiStrain`].
    almansi_strain AlmansiStrainOutput [6] false |point| AlmansiStrain::of(point).0.components, [0] = 0.375;
    /// ε = sym ∇u: see [`LinearStrain`].
    linear_strain LinearStrainOutput [6] false |point| LinearStrain::of(point).0.components, [0] = 1.0;
    /// ε as a vector with doubled shears, in Voigt's order 11, 22, 33, 12, 23, 13.
    engineering_strain EngineeringStrain [6] false |point| LinearStrain::of(point).engineering(), [0] = 1.0;
    /// I₁, I₂, I₃ of C, which are those of B: see [`invariants`].
    strain_invariants StrainInvariants [3] false |point| [
        invariants::first(point), invariants::second(point), invariants::third(point)
    ], [0] = 4.5;
    /// I₁ − 3, I₂ − 3, I₃ − 1 of C, without cancellation from ∇u.
    strain_invariants_less_reference StrainInvariantsLessReference [3] false |point| [
        invariants::first_minus_three(point), invariants::second_minus_three(point), invariants::third_minus_one(point)
    ], [0] = 1.5;
    /// J^(−2/3) I₁ − 3 and J^(−4/3) I₂ − 3, without cancellation from ∇u; in the example 4.5 ∛4 − 3.
    isochoric_invariants_less_three IsochoricInvariantsLessThree [2] false |point| [
        invariants::isochoric_first_minus_three(point), invariants::isochoric_second_minus_three(point)
    ], [0] = 4.143_304_733_856_898;
    /// R of F = R U.
    rotation Rotation [9] true |point| flat(point.stretch().rotation()), [0] = 1.0;
    /// U = √C.
    right_stretch RightStretch [6] true |point| point.stretch().right_stretch().components, [0] = 2.0;
    /// U − 1, Biot's strain, without cancellation.
    right_stretch_less_one RightStretchLessOne [6] true |point| point.stretch().right_stretch_less_one().components,
        [0] = 1.0;
    /// U⁻¹.
    inverse_right_stretch InverseRightStretch [6] true |point| point.stretch().inverse_right_stretch().components,
        [0] = 0.5;
    /// V = √B.
    left_stretch LeftStretch [6] true |point| point.stretch().left_stretch().components, [0] = 2.0;
    /// V − 1, without cancellation.
    left_stretch_less_one LeftStretchLessOne [6] true |point| point.stretch().left_stretch_less_one().components,
        [0] = 1.0;
    /// V⁻¹.
    inverse_left_stretch InverseLeftStretch [6] true |point| point.stretch().inverse_left_stretch().components,
        [0] = 0.5;
    /// ln U, Hencky's strain in the reference configuration.
    hencky Hencky [6] true |point| point.stretch().hencky_material().components, [0] = 0.693_147_180_559_945_3;
    /// ln V, Hencky's strain in the deformed configuration.
    hencky_spatial HenckySpatial [6] true |point| point.stretch().hencky_spatial().components,
        [0] = 0.693_147_180_559_945_3;
    /// The principal stretches λ₁ ≥ λ₂ ≥ λ₃.
    principal_stretches PrincipalStretches [3] true |point| point.stretch().principal_stretches(), [0] = 2.0;
    /// ln λ₁ ≥ ln λ₂ ≥ ln λ₃.
    log_principal_stretches LogPrincipalStretches [3] true |point| point.stretch().log_principal_stretches(),
        [0] = 0.693_147_180_559_945_3;
    /// The principal values of E, ½ (λ² − 1), descending.
    principal_green_strains PrincipalGreenStrains [3] true |point| point.stretch().principal_green_strains(),
        [0] = 1.5;
    /// The principal axes of U by rows, in the order of the stretches.
    material_axes MaterialAxes [9] true |point| flat(point.stretch().material_axes()), [1] = 0.0;
    /// The principal axes of V by rows, in the order of the stretches.
    spatial_axes SpatialAxes [9] true |point| flat(point.stretch().spatial_axes()), [1] = 0.0;
}

macro_rules! seth_hill {
    ($($(#[$documentation:meta])* $function:ident $name:ident $strain:ident;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_continuum::strain::SethHill;
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        /// let mut strains = [[0.0_f64; 6]; 1000];
        #[doc = concat!("let request = batch::", stringify!($function), "(SethHill::GREEN, &mut strains[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        /// assert!((request.at(&f, 7)[0] - 1.5).abs() < 1e-15); // ½ (2² − 1)
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<V>(scale: SethHill, to: V) -> Request<$name, (), V, 0, 6> {
            Request { quantity: $name(scale), source: (), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name(SethHill);

        impl Quantity<0, 6> for $name {
            type Input = ();
            type Output = Self;
            const NEEDS_STRETCH: bool = true;
            const INPUT: &'static str = "";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, _input: [T; 0]) -> [T; 6] {
                $strain::from_analysis(&point.stretch(), self.0).tensor.components
            }
        }
    )* };
}

seth_hill! {
    /// (Uᵐ − 1)/m: see [`SethHillStrain`].
    seth_hill_strain SethHillOutput SethHillStrain;
    /// (Vᵐ − 1)/m: see [`SpatialSethHillStrain`].
    seth_hill_strain_spatial SpatialSethHillOutput SpatialSethHillStrain;
}
