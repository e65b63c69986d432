//! Parameters of a fluid as a list, and its shear stress as a formula of them, for fits.

/// A fluid of `N` numbers whose shear stress is one formula of them and of the shear rate.
///
/// Fits evaluate it over differentiable parameters; the fluid's own [`shear_stress`](super::ViscometricFluid::shear_stress) is the same
/// function at its own.
pub trait Parameters<const N: usize>: Sized {
    /// The names of the parameters, in order.
    const NAMES: [&'static str; N];

    /// The parameters, in order.
    fn parameters(&self) -> [f64; N];

    /// From the parameters, in order, within their bounds.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`](crate::FluidsError::NotFinite),
    /// [`FluidsError::OutOfBounds`](crate::FluidsError::OutOfBounds).
    fn from_parameters(parameters: [f64; N]) -> Result<Self, crate::FluidsError>;

    /// τ, Pa, of parameters that may carry derivatives, for 0 ≤ `shear_rate`, 1/s.
    fn shear_stress_of<T: piola_numerics::Real>(parameters: [T; N], shear_rate: T) -> T;
}

/// Lists the parameters of a fluid in the order of its constructor, and states its shear stress as a formula of them.
macro_rules! listed {
    ($fluid:ident<$count:literal>: $($name:ident),+; |$parameters:pat_param, $shear_rate:ident| $stress:expr) => {
        impl Parameters<$count> for $fluid {
            const NAMES: [&'static str; $count] = [$(stringify!($name)),+];

            fn parameters(&self) -> [f64; $count] {
                [$(self.$name),+]
            }

            fn from_parameters([$($name),+]: [f64; $count]) -> Result<Self, crate::FluidsError> {
                Self::new($($name),+)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn shear_stress_of<T: Real>($parameters: [T; $count], $shear_rate: T) -> T {
                $stress
            }
        }
    };
}
pub(crate) use listed;
