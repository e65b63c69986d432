//! The rate of the stress of a mode along a motion.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::internal::rows::product;

use crate::differential::{
    ExponentialPhanThienTanner, Giesekus, LinearPhanThienTanner, Mode, NetworkMode, OldroydB, Slipping,
    UpperConvectedMaxwell,
};

/// A mode of a differential fluid in motion: its relaxation R(τ), and the rate of its stress.
///
/// ```text
/// λ (τ̇ − L τ − τ Lᵀ) + R(τ) = 2 ηₚ D
/// ```
/// A polymer that [slips](Mode::slip) is carried by L − ξ D in place of L.
pub trait StressRate: Mode {
    /// R(τ), Pa.
    #[must_use]
    fn relaxing<T: Real>(&self, stress: &Symmetric<T>) -> Symmetric<T>;

    /// τ̇, Pa/s, of a particle.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn stress_rate<T: Real>(&self, stress: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let drawn =
            velocity_gradient.rate_of_deformation().0 * T::lit(2.0 * self.polymer_viscosity()) - self.relaxing(stress);
        drawn * T::lit(self.time().recip()) + convected(stress, &carrying(self, velocity_gradient))
    }
}

/// L − ξ D.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn carrying<M: Mode, T: Real>(mode: &M, velocity_gradient: &VelocityGradient<T>) -> VelocityGradient<T> {
    if mode.slip() <= 0.0 {
        return *velocity_gradient;
    }
    // Entry by entry: L less ξ D would lose the digits of a stretching that hardly draws.
    let (half, l) = (T::lit(0.5 * mode.slip()), velocity_gradient.rows());
    let (along, across) = (T::lit(1.0 - mode.slip()), T::lit(1.0 - 0.5 * mode.slip()));
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = l;
    VelocityGradient(from_rows([
        [along * xx, across * xy - half * yx, across * xz - half * zx],
        [across * yx - half * xy, along * yy, across * yz - half * zy],
        [across * zx - half * xz, across * zy - half * yz, along * zz],
    ]))
}

/// L τ + τ Lᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn convected<T: Real>(stress: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
    Symmetric::sum_with_transpose(product(velocity_gradient.rows(), stress.rows()))
}

macro_rules! relaxing {
    ($([$($generic:tt)*] $mode:ty: |$of:ident, $stress:ident| $relaxing:expr);+ $(;)?) => {
        $(impl $($generic)* StressRate for $mode {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn relaxing<T: Real>(&self, $stress: &Symmetric<T>) -> Symmetric<T> {
                let $of = self;
                $relaxing
            }
        })+
    };
}

relaxing! {
    [] UpperConvectedMaxwell: |_mode, stress| *stress;
    [] OldroydB: |_mode, stress| *stress;
    [] Giesekus: |mode, stress|
        *stress + stress.square() * T::lit(mode.mobility() * mode.time() / mode.polymer_viscosity());
    [] LinearPhanThienTanner: |mode, stress| broken(mode, stress);
    [] ExponentialPhanThienTanner: |mode, stress| broken(mode, stress);
    [<M: NetworkMode + StressRate>] Slipping<M>: |mode, stress| mode.network().relaxing(stress);
}

/// f τ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn broken<M: NetworkMode, T: Real>(mode: &M, stress: &Symmetric<T>) -> Symmetric<T> {
    let modulus = mode.polymer_viscosity() / mode.time();
    *stress * mode.breaking(stress.trace() * T::lit(modulus.recip()))
}
