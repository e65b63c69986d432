//! Push-forward and pull-back of vectors and tensors: see [`transport`].

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use super::kinematic::flat;
use super::point::Point;
use super::requests::{Quantity, Request};
use crate::tensor::transport;
use crate::{Deformation, Symmetric};

/// What is carried; for the example, its first component at F = diag(2, ½, ½) where it was one.
macro_rules! carried {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] |$point:ident, $input:ident| $value:expr, $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        #[doc = concat!("let (ones, mut carried) = ([[1.0_f64; ", stringify!($k), "]; 1000], [[0.0_f64; ", stringify!($k), "]; 1000]);")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&ones[..], &mut carried[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        #[doc = concat!("assert!((request.at(&f, 7)[0] - ", stringify!($expected), ").abs() < 1e-15);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(from: S, to: V) -> Request<$name, S, V, $k, $k> {
            Request { quantity: $name, source: from, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$k, $k> for $name {
            type Input = Self;
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "vector or tensor";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, $input: [T; $k]) -> [T; $k] {
                $value
            }
        }
    )* };
}

carried! {
    /// F v: a line element carried by the body.
    push_vector PushVector [3] |point, v| transport::push_vector(point, &Vector3::from(v)).into(), 2.0;
    /// F⁻¹ v.
    pull_vector PullVector [3] |point, v| transport::pull_vector(point, &Vector3::from(v)).into(), 0.5;
    /// F⁻ᵀ v: a gradient with respect to X as one with respect to x.
    push_covector PushCovector [3] |point, v| transport::push_covector(point, &Vector3::from(v)).into(), 0.5;
    /// Fᵀ v.
    pull_covector PullCovector [3] |point, v| transport::pull_covector(point, &Vector3::from(v)).into(), 2.0;
    /// n da = Cof F N dA (Nanson): an element of area, as the vector along its normal with its size.
    push_area PushArea [3] |point, v| point.area_element(Vector3::from(v)).into(), 0.25;
    /// N dA = J⁻¹ Fᵀ n da, the way back of [`push_area`].
    pull_area PullArea [3] |point, v| {
        let carried: [T; 3] = transport::pull_covector(point, &Vector3::from(v)).into();
        let jacobian = point.jacobian();
        [carried[0] / jacobian, carried[1] / jacobian, carried[2] / jacobian]
    }, 4.0;
    /// J f of a body force f per deformed volume, as one per reference volume: see
    /// [`reference_body_force`](crate::stress::reference_body_force).
    pull_body_force PullBodyForce [3]
        |point, v| crate::stress::reference_body_force(point, &Vector3::from(v)).into(), 0.5;
    /// F A Fᵀ.
    push_contravariant PushContravariant [6]
        |point, a| transport::push_contravariant(point, &Symmetric { components: a }).components, 4.0;
    /// F⁻¹ A F⁻ᵀ.
    pull_contravariant PullContravariant [6]
        |point, a| transport::pull_contravariant(point, &Symmetric { components: a }).components, 0.25;
    /// F⁻ᵀ A F⁻¹.
    push_covariant PushCovariant [6]
        |point, a| transport::push_covariant(point, &Symmetric { components: a }).components, 0.25;
    /// Fᵀ A F.
    pull_covariant PullCovariant [6]
        |point, a| transport::pull_covariant(point, &Symmetric { components: a }).components, 4.0;
    /// F A F⁻¹ of a general tensor by rows.
    push_mixed PushMixed [9] |point, a| {
        let [a, b, c, d, e, f, g, h, i] = a;
        flat(rows_of(&transport::push_mixed(point, &from_rows([[a, b, c], [d, e, f], [g, h, i]]))))
    }, 1.0;
    /// F⁻¹ A F of a general tensor by rows.
    pull_mixed PullMixed [9] |point, a| {
        let [a, b, c, d, e, f, g, h, i] = a;
        flat(rows_of(&transport::pull_mixed(point, &from_rows([[a, b, c], [d, e, f], [g, h, i]]))))
    }, 1.0;
}
