//! Conversions between measures of stress.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::kinematic::flat;
use super::point::Point;
use super::requests::{Quantity, Request};
use crate::tensor::rows::Rows;
use crate::{
    BiotStress, CauchyStress, BatchError, Deformation, FirstPiola, KirchhoffStress, MandelStress, SecondPiola,
    Symmetric,
};

/// The components of a measure of stress as a batch holds them.
trait Measure<T, const K: usize> {
    fn of_components(components: [T; K]) -> Self;
    fn components(&self) -> [T; K];
}

macro_rules! symmetric {
    ($($name:ident)*) => { $(
        impl<T: Real> Measure<T, 6> for $name<T> {
            #[inline(always)]
            fn of_components(components: [T; 6]) -> Self {
                $name(Symmetric { components })
            }
            #[inline(always)]
            fn components(&self) -> [T; 6] {
                self.0.components
            }
        }
    )* };
}
symmetric!(CauchyStress KirchhoffStress SecondPiola);

macro_rules! general {
    ($($name:ident)*) => { $(
        impl<T: Real> Measure<T, 9> for $name<T> {
            #[inline(always)]
            fn of_components([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Self {
                let rows: Rows<T> = [[a, b, c], [d, e, f], [g, h, i]];
                $name(from_rows(rows))
            }
            #[inline(always)]
            fn components(&self) -> [T; 9] {
                flat(self.rows())
            }
        }
    )* };
}
general!(FirstPiola MandelStress BiotStress);

/// The stress of the examples: a bar with F = diag(2, ½, ½) under 8 Pa.
macro_rules! example {
    (CauchyStress) => {
        "CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?"
    };
    (KirchhoffStress) => {
        "KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?"
    };
    (SecondPiola) => {
        "SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?"
    };
    (FirstPiola) => {
        "FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?"
    };
    (MandelStress) => {
        "MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?"
    };
    (BiotStress) => {
        "BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?"
    };
}

/// The size of that stress in the measure that comes out.
macro_rules! size {
    (CauchyStress) => {
        "8.0"
    };
    (SecondPiola) => {
        "1.0"
    };
    (FirstPiola) => {
        "2.0"
    };
    (BiotStress) => {
        "2.0"
    };
    ($other:ident) => {
        "4.0"
    };
}

/// What a conversion asks of its input beyond that it is finite.
macro_rules! input {
    (any) => {};
    (balanced) => {
        #[inline(always)]
        fn admits<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: &[T; 9]) -> T::Mask {
            FirstPiola::of_components(*input).is_balanced(point)
        }

        fn check_input<T: Real, D: Deformation<T>>(
            &self,
            deformation: &D,
            input: &[T; 9],
        ) -> Result<(), BatchError> {
            FirstPiola::of_components(*input).check_balance(deformation)
        }
    };
}

macro_rules! conversions {
    ($stretch:literal $input:ident: $($(#[$documentation:meta])* $function:ident $name:ident $from:ident [$i:literal] $to:ident [$k:literal]
        |$stress:ident, $point:ident| $value:expr;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// # use nalgebra::Matrix3;
        #[doc = concat!("use piola_continuum::{", ", DeformationGradient, batch, stringify!($from)};")]
        #[doc = concat!("let stress = [", example!($from), "; 1000];")]
        #[doc = concat!("let mut converted = [[0.0_f64; ", stringify!($k), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&stress[..], &mut converted[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
        #[doc = concat!("assert!((request.at(&f, 7)[0] - ", size!($to), ").abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(stress: S, to: V) -> Request<$name, S, V, $i, $k> {
            Request { quantity: $name, source: stress, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$i, $k> for $name {
            type Input = $from;
            type Output = $to;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = stringify!($from);

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; $i]) -> [T; $k] {
                let $stress = $from::<T>::of_components(input);
                let converted: $to<T> = $value;
                converted.components()
            }

            input!($input);
        }
    )* };
}

conversions! { false any:
    /// τ = J T.
    cauchy_to_kirchhoff CauchyToKirchhoff CauchyStress [6] KirchhoffStress [6] |stress, point| stress.kirchhoff(point);
    /// P = T Cof F.
    cauchy_to_first_piola CauchyToFirstPiola CauchyStress [6] FirstPiola [9] |stress, point| stress.first_piola(point);
    /// S = J F⁻¹ T F⁻ᵀ.
    cauchy_to_second_piola CauchyToSecondPiola CauchyStress [6] SecondPiola [6] |stress, point| stress.second_piola(point);
    /// M = Fᵀ T Cof F.
    cauchy_to_mandel CauchyToMandel CauchyStress [6] MandelStress [9] |stress, point| stress.mandel(point);
    /// T = τ/J.
    kirchhoff_to_cauchy KirchhoffToCauchy KirchhoffStress [6] CauchyStress [6] |stress, point| stress.cauchy(point);
    /// P = τ F⁻ᵀ.
    kirchhoff_to_first_piola KirchhoffToFirstPiola KirchhoffStress [6] FirstPiola [9] |stress, point| stress.first_piola(point);
    /// S = F⁻¹ τ F⁻ᵀ.
    kirchhoff_to_second_piola KirchhoffToSecondPiola KirchhoffStress [6] SecondPiola [6] |stress, point| stress.second_piola(point);
    /// M = Fᵀ τ F⁻ᵀ.
    kirchhoff_to_mandel KirchhoffToMandel KirchhoffStress [6] MandelStress [9] |stress, point| stress.mandel(point);
    /// M = Fᵀ P.
    first_piola_to_mandel FirstPiolaToMandel FirstPiola [9] MandelStress [9] |stress, point| stress.mandel(point);
    /// T = F S Fᵀ/J.
    second_piola_to_cauchy SecondPiolaToCauchy SecondPiola [6] CauchyStress [6] |stress, point| stress.cauchy(point);
    /// τ = F S Fᵀ.
    second_piola_to_kirchhoff SecondPiolaToKirchhoff SecondPiola [6] KirchhoffStress [6] |stress, point| stress.kirchhoff(point);
    /// P = F S.
    second_piola_to_first_piola SecondPiolaToFirstPiola SecondPiola [6] FirstPiola [9] |stress, point| stress.first_piola(point);
    /// M = C S.
    second_piola_to_mandel SecondPiolaToMandel SecondPiola [6] MandelStress [9] |stress, point| stress.mandel(point);
    /// P = F⁻ᵀ M.
    mandel_to_first_piola MandelToFirstPiola MandelStress [9] FirstPiola [9] |stress, point| stress.first_piola(point);
    /// T = sym(F⁻ᵀ M Fᵀ)/J.
    mandel_to_cauchy MandelToCauchy MandelStress [9] CauchyStress [6] |stress, point| stress.cauchy(point);
    /// τ = sym(F⁻ᵀ M Fᵀ).
    mandel_to_kirchhoff MandelToKirchhoff MandelStress [9] KirchhoffStress [6] |stress, point| stress.kirchhoff(point);
    /// S = sym(C⁻¹ M).
    mandel_to_second_piola MandelToSecondPiola MandelStress [9] SecondPiola [6] |stress, point| stress.second_piola(point);
}

conversions! { false balanced:
    /// T = sym(P Fᵀ)/J.
    ///
    /// A point where P Fᵀ is not symmetric is a bad one, [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric): by more than 96 ulp of
    /// |P| |F| max(1, |F|³/J), by largest entries.
    first_piola_to_cauchy FirstPiolaToCauchy FirstPiola [9] CauchyStress [6] |stress, point| stress.cauchy(point);
    /// τ = sym(P Fᵀ).
    ///
    /// A point where P Fᵀ is not symmetric is a bad one, [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric): by more than 96 ulp of
    /// |P| |F| max(1, |F|³/J), by largest entries.
    first_piola_to_kirchhoff FirstPiolaToKirchhoff FirstPiola [9] KirchhoffStress [6] |stress, point| stress.kirchhoff(point);
    /// S = sym(F⁻¹ P).
    ///
    /// A point where P Fᵀ is not symmetric is a bad one, [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric): by more than 96 ulp of
    /// |P| |F| max(1, |F|³/J), by largest entries.
    first_piola_to_second_piola FirstPiolaToSecondPiola FirstPiola [9] SecondPiola [6] |stress, point| stress.second_piola(point);
}

conversions! { true any:
    /// Biot's stress Rᵀ T Cof F.
    cauchy_to_biot CauchyToBiot CauchyStress [6] BiotStress [9]
        |stress, point| stress.first_piola(point).biot_of_analysis(&point.stretch());
    /// Biot's stress Rᵀ τ F⁻ᵀ.
    kirchhoff_to_biot KirchhoffToBiot KirchhoffStress [6] BiotStress [9]
        |stress, point| stress.first_piola(point).biot_of_analysis(&point.stretch());
    /// Biot's stress Rᵀ P.
    first_piola_to_biot FirstPiolaToBiot FirstPiola [9] BiotStress [9]
        |stress, point| stress.biot_of_analysis(&point.stretch());
    /// Biot's stress U S, as Rᵀ F S.
    second_piola_to_biot SecondPiolaToBiot SecondPiola [6] BiotStress [9]
        |stress, point| stress.first_piola(point).biot_of_analysis(&point.stretch());
    /// Biot's stress U⁻¹ M, as Rᵀ F⁻ᵀ M.
    mandel_to_biot MandelToBiot MandelStress [9] BiotStress [9]
        |stress, point| stress.first_piola(point).biot_of_analysis(&point.stretch());
    /// T = sym(R Biot Fᵀ)/J.
    biot_to_cauchy BiotToCauchy BiotStress [9] CauchyStress [6]
        |stress, point| stress.first_piola_of_analysis(&point.stretch()).cauchy(point);
    /// τ = sym(R Biot Fᵀ).
    biot_to_kirchhoff BiotToKirchhoff BiotStress [9] KirchhoffStress [6]
        |stress, point| stress.first_piola_of_analysis(&point.stretch()).kirchhoff(point);
    /// P = R Biot.
    biot_to_first_piola BiotToFirstPiola BiotStress [9] FirstPiola [9]
        |stress, point| stress.first_piola_of_analysis(&point.stretch());
    /// S = sym(U⁻¹ Biot), as F⁻¹ R Biot.
    biot_to_second_piola BiotToSecondPiola BiotStress [9] SecondPiola [6]
        |stress, point| stress.first_piola_of_analysis(&point.stretch()).second_piola(point);
    /// M = U Biot, as Fᵀ R Biot.
    biot_to_mandel BiotToMandel BiotStress [9] MandelStress [9]
        |stress, point| stress.first_piola_of_analysis(&point.stretch()).mandel(point);
}
