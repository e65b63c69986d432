//! Derivatives with respect to F: a measure evaluated over scalars that carry the directions.
//!
//! A measure is one formula over any scalar; over `F + ε dF` with ε² = 0 it gives its derivative along dF, exact to
//! rounding, and finite where stretches coalesce because every spectral function is.
//!
//! These evaluations are large: unlike the measures themselves they are compiled once for each scalar and called, not
//! inlined at every call.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Dual, Gradient, Real};
use piola_tensor::internal::rows::Rows;

use crate::Deformation;
use crate::deformation::volume::{determinant, volume_change_of_gradient};
use crate::polar::StretchAnalysis;

/// A deformation that carries directions of change.
#[derive(Clone, Copy)]
pub(super) struct Moving<S> {
    gradient: Rows<S>,
    displacement: Rows<S>,
}

impl<S: Real> Moving<S> {
    /// F and ∇u, each entry with what `lift` adds to it at row i and column j.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Real>(deformation: &impl Deformation<T>, lift: impl Fn(T, usize, usize) -> S) -> Self {
        let (f, h) = (deformation.gradient_rows(), deformation.displacement_rows());
        let lifted = |rows: Rows<T>| core::array::from_fn(|i| core::array::from_fn(|j| lift(rows[i][j], i, j)));
        Self { gradient: lifted(f), displacement: lifted(h) }
    }
}

/// F + ε dF.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along<T: Real>(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Moving<Dual<T>> {
    let d = rows_of(direction);
    Moving::of(deformation, |x, i, j| Dual::new(x, d[i][j]))
}

/// F + ε d₁F + η d₂F.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along_both<T: Real>(
    deformation: &impl Deformation<T>,
    first: &Matrix3<T>,
    second: &Matrix3<T>,
) -> Moving<Dual<Dual<T>>> {
    let (a, b) = (rows_of(first), rows_of(second));
    Moving::of(deformation, |x, i, j| Dual::new(Dual::new(x, a[i][j]), Dual::new(b[i][j], T::zero())))
}

/// F with all nine directions, entry (i, A) in place 3i + A.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along_all<T: Real>(deformation: &impl Deformation<T>) -> Moving<Gradient<T, 9>> {
    Moving::of(deformation, |x, i, j| Gradient::variable(x, 3 * i + j))
}

impl<S: Real> Deformation<S> for Moving<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<R: Real>(&self, lift: impl Fn(usize, usize, S) -> R) -> impl Deformation<R> {
        Moving::of(self, |x, i, j| lift(i, j, x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<S> {
        self.gradient
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<S> {
        self.displacement
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> S {
        determinant(self.gradient)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> S {
        volume_change_of_gradient(self.gradient)
    }
}

/// The parts of a symmetric tensor over scalars with nine directions, row by component.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn partials<T: Real>(tensor: crate::Symmetric<Gradient<T, 9>>) -> [[T; 9]; 6] {
    tensor.components.map(|x| x.partials)
}

/// The parts of a general tensor along one direction.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn tangent<T: Real>(rows: Rows<Dual<T>>) -> Matrix3<T> {
    from_rows(rows.map(|row| row.map(|x| x.tangent)))
}

/// The stretches of a deformation that carries directions, compiled once for each kind of scalar.
#[inline(never)]
pub(super) fn moving_analysis<S: Real>(moving: &Moving<S>) -> StretchAnalysis<S> {
    StretchAnalysis::of(moving)
}

/// `derivative_matrix` of a polynomial measure, or all derivatives of one that is made of the stretches.
macro_rules! derivatives_of_measure {
    ($name:ident, whole) => {
        impl<T: Real> $name<T> {
            /// The whole derivative with respect to F: rows 11, 22, 33, 12, 23, 13 (shears not doubled), columns 3i + A for
            /// the entry (i, A) of F.
            #[inline]
            #[must_use]
            pub fn derivative_matrix(deformation: &impl crate::Deformation<T>) -> [[T; 9]; 6] {
                $crate::strain::lines::partials($name::of(&$crate::strain::lines::along_all(deformation)).0)
            }
        }
    };
    ($name:ident) => {
        impl<T: Real> $name<T> {
            /// The derivative along a direction dF; with Ḟ for dF the rate.
            ///
            /// # Accuracy
            /// Finite and accurate where stretches coalesce, too.
            #[inline]
            #[must_use]
            pub fn derivative(
                deformation: &impl crate::Deformation<T>,
                direction: &nalgebra::Matrix3<T>,
            ) -> $crate::Symmetric<T> {
                use $crate::strain::lines::{along, moving_analysis};
                let moving = $name::from_analysis(&moving_analysis(&along(deformation, direction)));
                $crate::Symmetric { components: moving.0.components.map(|x| x.tangent) }
            }

            /// The second derivative along two directions d₁F and d₂F.
            ///
            /// # Accuracy
            /// As [`derivative`](Self::derivative).
            #[inline]
            #[must_use]
            pub fn second_derivative(
                deformation: &impl crate::Deformation<T>,
                first: &nalgebra::Matrix3<T>,
                second: &nalgebra::Matrix3<T>,
            ) -> $crate::Symmetric<T> {
                use $crate::strain::lines::{along_both, moving_analysis};
                let moving = $name::from_analysis(&moving_analysis(&along_both(deformation, first, second)));
                $crate::Symmetric { components: moving.0.components.map(|x| x.tangent.tangent) }
            }

            /// The whole derivative with respect to F: rows 11, 22, 33, 12, 23, 13 (shears not doubled), columns 3i + A for
            /// the entry (i, A) of F.
            #[inline]
            #[must_use]
            pub fn derivative_matrix(deformation: &impl crate::Deformation<T>) -> [[T; 9]; 6] {
                use $crate::strain::lines::{along_all, moving_analysis, partials};
                partials($name::from_analysis(&moving_analysis(&along_all(deformation))).0)
            }
        }
    };
}

pub(super) use derivatives_of_measure;
