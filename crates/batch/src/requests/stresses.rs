//! Conversions between measures of stress, and the equivalent stress.

use piola_continuum::stress::invariants;
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::Symmetric;

use super::quantity;
use crate::BatchError;
use crate::engine::parts::{flat, rows};

/// P of nine components by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn first_piola<T: Real>(components: [T; 9]) -> FirstPiola<T> {
    FirstPiola(from_rows(rows(components)))
}

/// T, τ or S of six components.
macro_rules! symmetric {
    ($name:ident, $components:expr) => {
        $name(Symmetric { components: $components })
    };
}

quantity! {
    /// P = T Cof F.
    ///
    /// # Example
    /// Every request of this family is made and evaluated in the same way.
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola};
    /// let f = [DeformationGradient::diagonal([2.0, 0.5, 0.5])?; 1000];
    /// let stress = [CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?; 1000];
    /// let mut converted = vec![FirstPiola::zero(); 1000];
    /// batch::evaluate(&f[..], batch::cauchy_to_first_piola(&stress[..], &mut converted[..]))?;
    /// assert_eq!(converted[7].0[(0, 0)], 2.0); // a quarter of the area
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    cauchy_to_first_piola(stress: S) CauchyToFirstPiola: CauchyStress [6] => FirstPiola [9], "CauchyStress",
        |point, stress| flat(symmetric!(CauchyStress, stress).first_piola(point).rows());
    /// τ = J T.
    cauchy_to_kirchhoff(stress: S) CauchyToKirchhoff: CauchyStress [6] => KirchhoffStress [6], "CauchyStress",
        |point, stress| symmetric!(CauchyStress, stress).kirchhoff(point).0.components;
    /// S = J F⁻¹ T F⁻ᵀ.
    cauchy_to_second_piola(stress: S) CauchyToSecondPiola: CauchyStress [6] => SecondPiola [6], "CauchyStress",
        |point, stress| symmetric!(CauchyStress, stress).second_piola(point).0.components;
    /// T = τ/J.
    kirchhoff_to_cauchy(stress: S) KirchhoffToCauchy: KirchhoffStress [6] => CauchyStress [6], "KirchhoffStress",
        |point, stress| symmetric!(KirchhoffStress, stress).cauchy(point).0.components;
    /// T = F S Fᵀ/J.
    second_piola_to_cauchy(stress: S) SecondPiolaToCauchy: SecondPiola [6] => CauchyStress [6], "SecondPiola",
        |point, stress| symmetric!(SecondPiola, stress).cauchy(point).0.components;
    /// P = F S.
    second_piola_to_first_piola(stress: S) SecondPiolaToFirstPiola: SecondPiola [6] => FirstPiola [9], "SecondPiola",
        |point, stress| flat(symmetric!(SecondPiola, stress).first_piola(point).rows());
    /// The equivalent stress of von Mises √(3 J₂), Pa: see [`invariants::von_mises`].
    von_mises(stress: S) VonMises: CauchyStress [6] => Self [1], "stress",
        |_, components| [invariants::von_mises(&Symmetric { components })];
}

/// Quantities of P, which must obey the balance of angular momentum.
macro_rules! balanced {
    ($($(#[$documentation:meta])* $function:ident $name:ident $to:ident $method:ident;)*) => { quantity! { $(
        $(#[$documentation])*
        ///
        /// A point where P Fᵀ is not symmetric is a bad one, [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric):
        /// by more than 96 ulp of |P| |F| max(1, |F|³/J), by largest entries.
        $function(stress: S) $name: FirstPiola [9] => $to [6], "FirstPiola",
            |point, stress| first_piola(stress).$method(point).0.components, {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn admits<T: Real, D: Deformation<T>>(&self, point: &crate::Point<T, D>, input: &[T; 9]) -> T::Mask {
                first_piola(*input).is_balanced(point)
            }

            fn check_input<T: Real, D: Deformation<T>>(&self, deformation: &D, input: &[T; 9]) -> Result<(), BatchError> {
                Ok(first_piola(*input).check_balance(deformation)?)
            }
        };
    )* } };
}

balanced! {
    /// T = sym(P Fᵀ)/J.
    first_piola_to_cauchy FirstPiolaToCauchy CauchyStress cauchy;
    /// S = sym(F⁻¹ P).
    first_piola_to_second_piola FirstPiolaToSecondPiola SecondPiola second_piola;
}
