//! Unit normals of surfaces, of the deformed and of the reference body.

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::dot;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::scale::{largest, power_of_two_scale, square_root};

use crate::ContinuumError;
use crate::error::check_finite;

/// The vector scaled to length one, or why it has no direction.
fn direction<T: Real>(vector: &Vector3<T>) -> Result<[T; 3], ContinuumError> {
    let v = [vector[0], vector[1], vector[2]];
    check_finite("normal", &v)?;
    let size = largest(v);
    if !T::zero().less_than(size).all() {
        return Err(ContinuumError::ZeroNormal);
    }
    Ok(normalized(v))
}

/// v/|v|, NaN for v = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn normalized<T: Real>(v: [T; 3]) -> [T; 3] {
    let (scale, _) = power_of_two_scale(largest(v));
    let v = [v[0] * scale, v[1] * scale, v[2] * scale];
    let length = square_root(dot(v, v));
    [v[0] / length, v[1] / length, v[2] / length]
}

macro_rules! unit_normal {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(transparent)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(
            feature = "serde",
            serde(
                try_from = "[T; 3]",
                into = "[T; 3]",
                bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
            )
        )]
        pub struct $name<T = f64> {
            components: [T; 3],
        }

        impl<T: Real> $name<T> {
            /// The direction of a vector of any length.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`]; [`ContinuumError::ZeroNormal`] for the zero vector, in any lane.
            ///
            /// # Accuracy
            /// 2 ulp, for vectors of any size.
            pub fn new(vector: Vector3<T>) -> Result<Self, ContinuumError> {
                direction(&vector).map(|components| Self { components })
            }

            /// From components that a kernel has normalised.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) const fn trusted(components: [T; 3]) -> Self {
                Self { components }
            }

            /// The components.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub const fn components(&self) -> [T; 3] {
                self.components
            }

            /// As a vector of length one.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn vector(&self) -> Vector3<T> {
                Vector3::from(self.components)
            }
        }

        /// The normal of the other side.
        impl<T: Real> core::ops::Neg for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                let [x, y, z] = self.components;
                Self { components: [-x, -y, -z] }
            }
        }

        impl<T: Real> TryFrom<[T; 3]> for $name<T> {
            type Error = ContinuumError;
            /// As [`new`](Self::new); components of length one to 4 ulp are kept to the last bit.
            fn try_from(components: [T; 3]) -> Result<Self, ContinuumError> {
                let normal = direction(&Vector3::from(components))?;
                let tolerance = T::lit(4.0 * piola_numerics::sums::unit_in_last_place::<T>());
                let unit = (dot(components, components) - T::one()).abs().at_most(tolerance);
                Ok(Self { components: if unit.all() { components } else { normal } })
            }
        }

        impl<T> From<$name<T>> for [T; 3] {
            fn from(normal: $name<T>) -> Self {
                normal.components
            }
        }
    };
}

unit_normal! {
    /// The unit normal n of a surface in the deformed body, outward from the part on which the traction acts.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::UnitNormal;
    /// let normal = UnitNormal::new(Vector3::new(0.0, 3.0, 4.0))?;
    /// assert_eq!(normal.components(), [0.0, 0.6, 0.8]);
    /// assert!(UnitNormal::new(Vector3::<f64>::zeros()).is_err());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    UnitNormal
}
unit_normal! {
    /// The unit normal N of a surface in the reference body.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::ReferenceNormal;
    /// assert_eq!(ReferenceNormal::new(Vector3::new(0.0, 3.0, 4.0))?.components(), [0.0, 0.6, 0.8]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ReferenceNormal
}

#[cfg(feature = "glam")]
piola_tensor::internal::glam_vectors!(UnitNormal, ContinuumError, |normal| normal.components);
#[cfg(feature = "glam")]
piola_tensor::internal::glam_vectors!(ReferenceNormal, ContinuumError, |normal| normal.components);
