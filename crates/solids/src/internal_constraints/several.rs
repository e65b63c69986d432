//! The constraints of one material, as what asks for multipliers sees them.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Dual, Gradient, Real};
use piola_tensor::FourthOrder;

use super::{InternalConstraint, Restriction, Rigidity};
use crate::SolidsError;

/// N constraints μₖ(F) = 0 that one material obeys.
///
/// Any [`InternalConstraint`] is one, tuples are several, `()` is none, [`Rigidity`] is six.
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::{Constraints, Incompressibility, Inextensibility};
/// use piola_solids::Fibre;
/// use piola_continuum::DeformationGradient;
/// let corded = (Incompressibility, Inextensibility::along(Fibre::new([1.0, 0.0, 0.0])?));
/// assert_eq!(corded.values(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?), [1.0, 3.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(21.18).
pub trait Constraints<const N: usize> {
    /// μₖ(F).
    #[must_use]
    fn values<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; N];

    /// ∂μₖ/∂F.
    #[must_use]
    fn gradients<T: Real>(&self, deformation: &impl Deformation<T>) -> [Matrix3<T>; N] {
        let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
        self.values(&varied).map(|value| Matrix3::from_fn(|i, j| value.partials[3 * i + j]))
    }

    /// Σ λₖ ∂²μₖ/∂F∂F: what reactions add to ∂P/∂F.
    #[must_use]
    fn curvature<T: Real>(&self, deformation: &impl Deformation<T>, multipliers: [T; N]) -> FourthOrder<T> {
        let column = |place: usize| -> [T; 9] {
            let varied = deformation.lifted(|i, j, x| {
                let inner = if 3 * i + j == place { Dual::variable(x) } else { Dual::constant(x) };
                Gradient::<Dual<T>, 9>::variable(inner, 3 * i + j)
            });
            let values = self.values(&varied);
            core::array::from_fn(|entry| {
                let mut sum = T::zero();
                for (value, multiplier) in values.iter().zip(multipliers) {
                    sum += multiplier * value.partials[entry].tangent;
                }
                sum
            })
        };
        FourthOrder { components: core::array::from_fn(column) }
    }

    /// Each with its value, gradient and reaction, for a [`Combination`](super::Combination).
    ///
    /// # Errors
    /// As [`InternalConstraint::at`].
    fn restrictions(&self, deformation: &impl Deformation<f64>) -> Result<[Restriction; N], SolidsError> {
        let (values, gradients) = (self.values(deformation), self.gradients(deformation));
        let none = Restriction { value: 0.0, gradient: Matrix3::zeros(), reaction: Symmetric::zero() };
        let mut restrictions = [none; N];
        for ((restriction, value), gradient) in restrictions.iter_mut().zip(values).zip(gradients) {
            *restriction = Restriction::of(value, gradient, deformation.gradient_rows())?;
        }
        Ok(restrictions)
    }
}

impl Constraints<0> for () {
    fn values<T: Real>(&self, _deformation: &impl Deformation<T>) -> [T; 0] {
        []
    }
    fn curvature<T: Real>(&self, _deformation: &impl Deformation<T>, _multipliers: [T; 0]) -> FourthOrder<T> {
        FourthOrder { components: [[T::zero(); 9]; 9] }
    }
}

impl<C: InternalConstraint> Constraints<1> for C {
    fn values<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 1] {
        [self.value(deformation)]
    }
    fn gradients<T: Real>(&self, deformation: &impl Deformation<T>) -> [Matrix3<T>; 1] {
        [self.gradient(deformation)]
    }
}

/// In the order of the components of [`Symmetric`].
impl Constraints<6> for Rigidity {
    fn values<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 6] {
        self.value(deformation).components
    }
}

macro_rules! constraints_of_tuple {
    ($count:literal: $($name:ident $place:tt),+) => {
        impl<$($name: InternalConstraint),+> Constraints<$count> for ($($name,)+) {
            fn values<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; $count] {
                [$(self.$place.value(deformation)),+]
            }
            fn gradients<T: Real>(&self, deformation: &impl Deformation<T>) -> [Matrix3<T>; $count] {
                [$(self.$place.gradient(deformation)),+]
            }
        }
    };
}

constraints_of_tuple!(2: A 0, B 1);
constraints_of_tuple!(3: A 0, B 1, C 2);
constraints_of_tuple!(4: A 0, B 1, C 2, D 3);
constraints_of_tuple!(5: A 0, B 1, C 2, D 3, E 4);
constraints_of_tuple!(6: A 0, B 1, C 2, D 3, E 4, F 5);
