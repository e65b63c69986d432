//! Outputs that need the deformation alone.

use piola_numerics::Real;

use super::point::Point;
use super::requests::{Quantity, Request};
use crate::Deformation;
use crate::strain::{AlmansiStrain, GreenStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen};
use crate::tensor::rows::Rows;

/// Nine components by rows.
#[inline(always)]
pub(super) fn flat<T: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> [T; 9] {
    [a, b, c, d, e, f, g, h, i]
}

macro_rules! kinematic {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] $stretch:literal |$point:ident| $value:expr;)*) => { $(
        $(#[$documentation])*
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
    jacobian Jacobian [1] false |point| [point.jacobian()];
    /// J − 1.
    volume_change VolumeChange [1] false |point| [point.volume_change()];
    /// ln J.
    ln_jacobian LnJacobian [1] false |point| [point.ln_jacobian()];
    /// F⁻¹.
    inverse Inverse [9] false |point| flat(point.inverse_rows());
    /// Cof F = J F⁻ᵀ.
    cofactor Cofactor [9] false |point| flat(point.cofactor_rows());
    /// C = Fᵀ F: see [`RightCauchyGreen`].
    right_cauchy_green RightCauchyGreenOutput [6] false |point| RightCauchyGreen::of(point).0.components;
    /// B = F Fᵀ: see [`LeftCauchyGreen`].
    left_cauchy_green LeftCauchyGreenOutput [6] false |point| LeftCauchyGreen::of(point).0.components;
    /// E = ½ (C − 1): see [`GreenStrain`].
    green_strain GreenStrainOutput [6] false |point| GreenStrain::of(point).0.components;
    /// e = ½ (1 − B⁻¹): see [`AlmansiStrain`].
    almansi_strain AlmansiStrainOutput [6] false |point| AlmansiStrain::of(point).0.components;
    /// ε = sym ∇u: see [`LinearStrain`].
    linear_strain LinearStrainOutput [6] false |point| LinearStrain::of(point).0.components;
    /// R of F = R U.
    rotation Rotation [9] true |point| flat(point.stretch().rotation());
    /// U = √C.
    right_stretch RightStretch [6] true |point| point.stretch().right_stretch().components;
    /// U − 1, without cancellation.
    right_stretch_less_one RightStretchLessOne [6] true |point| point.stretch().right_stretch_less_one().components;
    /// V = √B.
    left_stretch LeftStretch [6] true |point| point.stretch().left_stretch().components;
    /// V − 1, without cancellation.
    left_stretch_less_one LeftStretchLessOne [6] true |point| point.stretch().left_stretch_less_one().components;
    /// ln U, Hencky's strain in the reference configuration.
    hencky Hencky [6] true |point| point.stretch().hencky_material().components;
    /// ln V, Hencky's strain in the deformed configuration.
    hencky_spatial HenckySpatial [6] true |point| point.stretch().hencky_spatial().components;
    /// The principal stretches λ₁ ≥ λ₂ ≥ λ₃.
    principal_stretches PrincipalStretches [3] true |point| point.stretch().principal_stretches();
    /// ln λ₁ ≥ ln λ₂ ≥ ln λ₃.
    log_principal_stretches LogPrincipalStretches [3] true |point| point.stretch().log_principal_stretches();
    /// The principal axes of U by rows, in the order of the stretches.
    material_axes MaterialAxes [9] true |point| flat(point.stretch().material_axes());
    /// The principal axes of V by rows, in the order of the stretches.
    spatial_axes SpatialAxes [9] true |point| flat(point.stretch().spatial_axes());
}
