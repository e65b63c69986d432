//! Invariants of stresses, and their gradients.

use piola_numerics::Real;

use super::point::Point;
use super::requests::{Quantity, Request};
use crate::stress::{HaighWestergaard, gradients, invariants};
use crate::{CauchyStress, Deformation, Symmetric};

/// What is computed, and for the example one component for 6, 3 and 0 Pa along the axes.
macro_rules! invariants {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] |$stress:ident| $value:expr,
        [$place:literal] = $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::{CauchyStress, DeformationGradient};
        /// let stress = [CauchyStress::new(6.0, 3.0, 0.0, 0.0, 0.0, 0.0)?; 1000];
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($k), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&stress[..], &mut out[..]); // for `batch::evaluate`")]
        /// let any = DeformationGradient::identity();
        #[doc = concat!("assert!((request.at(&any, 7)[", stringify!($place), "] - (", stringify!($expected), ")).abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(stress: S, to: V) -> Request<$name, S, V, 6, $k> {
            Request { quantity: $name, source: stress, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<6, $k> for $name {
            type Input = CauchyStress;
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "stress";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; $k] {
                let $stress = &Symmetric { components };
                $value
            }
        }
    )* };
}

invariants! {
    /// m = ⅓ tr T.
    mean_stress MeanStress [1] |stress| [invariants::mean(stress)], [0] = 3.0;
    /// p = −⅓ tr T, positive where the body is pressed.
    pressure Pressure [1] |stress| [-invariants::mean(stress)], [0] = -3.0;
    /// D = T − m 1.
    deviator Deviator [6] |stress| invariants::deviator(stress).components, [0] = 3.0;
    /// I₁, I₂, I₃: see [`principal_invariants`](invariants::principal_invariants).
    stress_invariants StressInvariants [3] |stress| invariants::principal_invariants(stress), [0] = 9.0;
    /// J₂ = ½ D : D.
    j2 J2 [1] |stress| [invariants::j2(stress)], [0] = 9.0;
    /// J₃ = det D.
    j3 J3 [1] |stress| [invariants::j3(stress)], [0] = 0.0;
    /// √(3 J₂): see [`von_mises`](invariants::von_mises).
    von_mises VonMises [1] |stress| [invariants::von_mises(stress)], [0] = 5.196_152_422_706_632;
    /// √(⅔ J₂): see [`octahedral_shear`](invariants::octahedral_shear).
    octahedral_shear OctahedralShear [1] |stress| [invariants::octahedral_shear(stress)], [0] = 2.449_489_742_783_178;
    /// σ₁ − σ₃: see [`tresca`](invariants::tresca).
    tresca Tresca [1] |stress| [invariants::tresca(stress)], [0] = 6.0;
    /// ½ (σ₁ − σ₃).
    maximum_shear MaximumShear [1] |stress| [invariants::maximum_shear(stress)], [0] = 3.0;
    /// θ ∈ [0, π/3]: see [`lode_angle`](invariants::lode_angle).
    lode_angle LodeAngle [1] |stress| [invariants::lode_angle(stress)], [0] = 0.523_598_775_598_298_9;
    /// The angle from pure shear: see [`lode_angle_from_shear`](invariants::lode_angle_from_shear).
    lode_angle_from_shear LodeAngleFromShear [1] |stress| [invariants::lode_angle_from_shear(stress)],
        [0] = 0.0;
    /// ξ, ρ, θ: see [`HaighWestergaard`].
    haigh_westergaard HaighWestergaardOutput [3] |stress| {
        let HaighWestergaard { hydrostatic, deviatoric, lode_angle } = HaighWestergaard::of(stress);
        [hydrostatic, deviatoric, lode_angle]
    }, [2] = 0.523_598_775_598_298_9;
    /// σ₁ ≥ σ₂ ≥ σ₃: see [`PrincipalStresses`](crate::stress::PrincipalStresses).
    principal_stresses PrincipalStresses [3] |stress| crate::stress::PrincipalStresses::of(stress).values(),
        [0] = 6.0;
    /// ∂J₂/∂T = D.
    j2_gradient J2Gradient [6] |stress| gradients::j2(stress).components, [0] = 3.0;
    /// ∂J₃/∂T = dev(D²).
    j3_gradient J3Gradient [6] |stress| gradients::j3(stress).components, [1] = -6.0;
    /// ∂√(3 J₂)/∂T, the direction of plastic flow: see [`von_mises`](gradients::von_mises).
    von_mises_gradient VonMisesGradient [6] |stress| gradients::von_mises(stress).components, [0] = 0.866_025_403_784_438_6;
    /// ∂θ/∂T: see [`lode_angle`](gradients::lode_angle).
    lode_angle_gradient LodeAngleGradient [6] |stress| gradients::lode_angle(stress).components, [1] = 0.192_450_089_729_875_25;
    /// ∂(σ₁ − σ₃)/∂T: see [`tresca`](gradients::tresca).
    tresca_gradient TrescaGradient [6] |stress| gradients::tresca(stress).components, [0] = 1.0;
}
