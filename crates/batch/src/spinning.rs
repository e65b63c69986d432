//! Tangents of the rates that turn with the stretch, of rates of Cauchy's stress, and the ways back.

use piola_numerics::Real;

use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use super::tangents::{general, slots};
use super::{BatchScalar, Destination, Source};
use crate::rates::strain::GreenStrainRate;
use crate::rates::{GradientRate, RateOfDeformation};
use crate::stress::tangents::{
    CauchyGreenNaghdiTangent, CauchyJaumannTangent, CauchyLogarithmicTangent, CauchyLowerConvectedTangent,
    CauchyUpperConvectedTangent, FirstPiolaTangent, GreenNaghdiTangent, JaumannTangent, LieTangent, LogarithmicTangent,
    LowerConvectedTangent, MaterialTangent, TruesdellTangent,
};
use crate::tensor::{MajorSymmetric, MinorSymmetric, PairSymmetric};
use crate::{CauchyStress, Deformation, FirstPiola, SecondPiola, Symmetric};

/// Six rows of six.
#[inline(always)]
fn minor<T: Real, const TOTAL: usize>(input: &[T; TOTAL], at: usize) -> MinorSymmetric<T> {
    let mut tensor = MinorSymmetric::zero();
    let mut k = 0;
    while k < 36 {
        tensor.components[k / 6][k % 6] = input[at + k];
        k += 1;
    }
    tensor
}

#[inline(always)]
fn major<T: Real, const TOTAL: usize>(input: &[T; TOTAL], at: usize) -> MajorSymmetric<T> {
    MajorSymmetric { components: part(input, at) }
}

/// A tangent of Cauchy's stress and another tangent; for the example the first entry where nothing is stretched, of
/// T = 10 e₁ ⊗ e₁ and the tangent λ 1 ⊗ 1 + 2μ 1 with λ = 1, μ = 3.
macro_rules! with_stress {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident $symmetry:ident [$i:literal => $k:tt] $to:ident
        $stretch:literal |$t:ident, $tangent:ident, $point:ident| $value:expr, $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_tensor::{MajorSymmetric, MinorSymmetric};
        /// use piola_batch as batch;
        /// use piola_continuum::{CauchyStress, DeformationGradient};
        /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?; 3];
        #[doc = with_stress!(tangents $symmetry)]
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($k), "]; 3];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&stress[..], &tangents[..], &mut out[..]);")]
        /// let f = DeformationGradient::identity();
        #[doc = concat!("assert!((request.at(&f, 2)[0] - (", stringify!($expected), ")).abs() < 1e-13);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, C, V>(stress: S, tangent: C, to: V) -> Request<$name, (S, C), V, $i, $k> {
            Request { quantity: $name, source: (stress, tangent), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$i, $k> for $name {
            type Input = (CauchyStress, $from);
            type Output = $to;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = concat!("CauchyStress and ", stringify!($from));

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; $i]) -> [T; $k] {
                let $t = &CauchyStress(Symmetric { components: part(&input, 0) });
                let $tangent = &with_stress!(typed $symmetry $from input);
                with_stress!(written $k, $value.0)
            }
        }
    )* };
    (tangents major) => { "let tangents = [MajorSymmetric::isotropic(1.0, 3.0); 3];" };
    (tangents minor) => { "let tangents = [MinorSymmetric::from(MajorSymmetric::isotropic(1.0, 3.0)); 3];" };
    (typed major $from:ident $input:ident) => { $from::<T>(major(&$input, 6)) };
    (typed minor $from:ident $input:ident) => { $from(minor(&$input, 6)) };
    (written 21, $value:expr) => { $value.components };
    (written 36, $value:expr) => { slots(&$value) };
}

/// Tangents of 36 entries: as they are read, and where batches find and leave them.
macro_rules! minor_tangents {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 36> for &[$name<T>] {
            #[inline(always)]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; 36] {
                slots(&self[index].0)
            }
        }

        impl<T: BatchScalar> Destination<$name, T, 36> for &mut [$name<T>] {
            #[inline(always)]
            fn count(&self) -> usize {
                self.len()
            }
            #[inline(always)]
            fn split(self, middle: usize) -> (Self, Self) {
                self.split_at_mut(middle)
            }
            #[inline(always)]
            fn put(&mut self, index: usize, components: [T; 36]) {
                self[index] = $name(minor(&components, 0));
            }
        }
    )* };
}
minor_tangents!(
    GreenNaghdiTangent LogarithmicTangent CauchyJaumannTangent CauchyUpperConvectedTangent CauchyLowerConvectedTangent
    CauchyGreenNaghdiTangent CauchyLogarithmicTangent
);

impl<Q, T: BatchScalar> Source<Q, T, 36> for &[MinorSymmetric<T>] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[inline(always)]
    fn point(&self, index: usize) -> [T; 36] {
        slots(&self[index])
    }
}

with_stress! {
    /// The tangent of Green and Naghdi's rate of τ, over J, of T and c/J, 36 entries: see
    /// [`JaumannTangent::green_naghdi`].
    green_naghdi_tangent GreenNaghdiTangentOutput TruesdellTangent major [27 => 36] GreenNaghdiTangent true
        |t, c, point| c.jaumann(t).green_naghdi_of_analysis(t, point, point.stretch()), 27.0;
    /// The tangent of the logarithmic rate of τ, over J, of T and c/J, 36 entries: see [`JaumannTangent::logarithmic`].
    logarithmic_tangent LogarithmicTangentOutput TruesdellTangent major [27 => 36] LogarithmicTangent true
        |t, c, point| c.jaumann(t).logarithmic_of_analysis(t, point, point.stretch()), 27.0;
    /// The tangent of Green and Naghdi's rate of T itself, of T and c/J, 36 entries: see [`GreenNaghdiTangent::cauchy`].
    cauchy_green_naghdi_tangent CauchyGreenNaghdiTangentOutput TruesdellTangent major [27 => 36] CauchyGreenNaghdiTangent
        true |t, c, point| c.jaumann(t).green_naghdi_of_analysis(t, point, point.stretch()).cauchy(t), 17.0;
    /// The tangent of the logarithmic rate of T itself, of T and c/J, 36 entries: see [`LogarithmicTangent::cauchy`].
    cauchy_logarithmic_tangent CauchyLogarithmicTangentOutput TruesdellTangent major [27 => 36] CauchyLogarithmicTangent
        true |t, c, point| c.jaumann(t).logarithmic_of_analysis(t, point, point.stretch()).cauchy(t), 17.0;
    /// The tangent of Jaumann's rate of τ, over J, of T and that of Green and Naghdi's rate: see
    /// [`GreenNaghdiTangent::jaumann`].
    green_naghdi_to_jaumann_tangent GreenNaghdiToJaumannTangent GreenNaghdiTangent minor [42 => 36] JaumannTangent true
        |t, c, point| c.jaumann_of_analysis(t, point, point.stretch()), 7.0;
    /// The tangent of Jaumann's rate of τ, over J, of T and that of the logarithmic rate: see
    /// [`LogarithmicTangent::jaumann`].
    logarithmic_to_jaumann_tangent LogarithmicToJaumannTangent LogarithmicTangent minor [42 => 36] JaumannTangent true
        |t, c, point| c.jaumann_of_analysis(t, point, point.stretch()), 7.0;
    /// c/J of T and the tangent of the lower-convected rate of τ, over J: see [`LowerConvectedTangent::truesdell`].
    lower_convected_to_truesdell_tangent LowerConvectedToTruesdellTangent LowerConvectedTangent major [27 => 21]
        TruesdellTangent false |t, c, _point| c.truesdell(t), -33.0;
    /// From the tangent of Jaumann's rate of T itself to that of τ, over J: see [`CauchyJaumannTangent::kirchhoff`].
    cauchy_jaumann_to_jaumann_tangent CauchyJaumannToJaumannTangent CauchyJaumannTangent minor [42 => 36] JaumannTangent
        false |t, c, _point| c.kirchhoff(t), 17.0;
    /// From the tangent of the upper-convected rate of T itself to c/J: see [`CauchyUpperConvectedTangent::truesdell`].
    cauchy_upper_convected_to_truesdell_tangent CauchyUpperConvectedToTruesdellTangent CauchyUpperConvectedTangent minor
        [42 => 36] TruesdellTangent false |t, c, _point| c.truesdell(t), 17.0;
    /// From the tangent of the lower-convected rate of T itself to that of τ, over J: see
    /// [`CauchyLowerConvectedTangent::kirchhoff`].
    cauchy_lower_convected_to_lower_convected_tangent CauchyLowerConvectedToLowerConvectedTangent
        CauchyLowerConvectedTangent minor [42 => 36] LowerConvectedTangent false |t, c, _point| c.kirchhoff(t), 17.0;
    /// From the tangent of Green and Naghdi's rate of T itself to that of τ, over J: see
    /// [`CauchyGreenNaghdiTangent::kirchhoff`].
    cauchy_green_naghdi_to_green_naghdi_tangent CauchyGreenNaghdiToGreenNaghdiTangent CauchyGreenNaghdiTangent minor
        [42 => 36] GreenNaghdiTangent false |t, c, _point| c.kirchhoff(t), 17.0;
    /// From the tangent of the logarithmic rate of T itself to that of τ, over J: see
    /// [`CauchyLogarithmicTangent::kirchhoff`].
    cauchy_logarithmic_to_logarithmic_tangent CauchyLogarithmicToLogarithmicTangent CauchyLogarithmicTangent minor
        [42 => 36] LogarithmicTangent false |t, c, _point| c.kirchhoff(t), 17.0;
}

/// c/J of S and ∂P/∂F, 36 entries: see [`FirstPiolaTangent::truesdell`].
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, SecondPiola};
/// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
/// let stress = [SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
/// let (mut nominal, mut spatial) = ([[0.0_f64; 81]], [[0.0_f64; 36]]);
/// nominal[0][0] = 38.0;
/// let request = batch::first_piola_to_truesdell_tangent(&stress[..], &nominal[..], &mut spatial[..]);
/// assert!((request.at(&f[0], 0)[0] - 56.0).abs() < 1e-13); // 2⁴ (38 − S₁₁)/2²/J
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn first_piola_to_truesdell_tangent<S, C, V>(
    stress: S,
    tangent: C,
    to: V,
) -> Request<FirstPiolaToTruesdellTangent, (S, C), V, 87, 36> {
    Request { quantity: FirstPiolaToTruesdellTangent, source: (stress, tangent), to }
}

/// The output of [`first_piola_to_truesdell_tangent`].
#[derive(Clone, Copy, Debug)]
pub struct FirstPiolaToTruesdellTangent;

impl Quantity<87, 36> for FirstPiolaToTruesdellTangent {
    type Input = (SecondPiola, FirstPiolaTangent);
    type Output = TruesdellTangent;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "SecondPiola and FirstPiolaTangent";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; 87]) -> [T; 36] {
        let stress = SecondPiola(Symmetric { components: part(&input, 0) });
        slots(&FirstPiolaTangent(general(part(&input, 6))).truesdell(&stress, point).0)
    }
}

/// What a tangent makes of a rate; for the example the first component of λ tr A 1 + 2μ A with λ = 1, μ = 3 and
/// A = e₁ ⊗ e₁.
macro_rules! rates {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident $rate:ident $to:ty;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::{DeformationGradient, Symmetric};
        /// use piola_tensor::MajorSymmetric;
        /// let (tangent, rate) = ([MajorSymmetric::isotropic(1.0, 3.0); 3], [Symmetric::diagonal([1.0, 0.0, 0.0]); 3]);
        /// let mut out = [[0.0_f64; 6]; 3];
        #[doc = concat!("let request = batch::", stringify!($function), "(&tangent[..], &rate[..], &mut out[..]);")]
        /// assert_eq!(request.at(&DeformationGradient::identity(), 2), [7.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        /// ```
        #[must_use]
        pub fn $function<C, R, V>(tangent: C, rate: R, to: V) -> Request<$name, (C, R), V, 27, 6> {
            Request { quantity: $name, source: (tangent, rate), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<27, 6> for $name {
            type Input = ($from, $rate);
            type Output = $to;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = concat!(stringify!($from), " and ", stringify!($rate));

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 27]) -> [T; 6] {
                let rate = Symmetric { components: part(&input, 21) };
                major(&input, 0).contract(&rate).components
            }
        }
    )* };
}

rates! {
    /// Ṡ = C : Ė, Pa/s: see [`MaterialTangent::rate`].
    rate_of_material_tangent RateOfMaterialTangent MaterialTangent GreenStrainRate SecondPiola;
    /// The upper-convected rate of τ, c : D, Pa/s: see [`LieTangent::rate`].
    rate_of_lie_tangent RateOfLieTangent LieTangent RateOfDeformation Self;
    /// Truesdell's rate of T, (c/J) : D, Pa/s: see [`TruesdellTangent::rate`].
    rate_of_truesdell_tangent RateOfTruesdellTangent TruesdellTangent RateOfDeformation Self;
    /// Jaumann's rate of τ, over J, Pa/s: see [`JaumannTangent::rate`].
    rate_of_jaumann_tangent RateOfJaumannTangent JaumannTangent RateOfDeformation Self;
    /// The lower-convected rate of τ, over J, Pa/s: see [`LowerConvectedTangent::rate`].
    rate_of_lower_convected_tangent RateOfLowerConvectedTangent LowerConvectedTangent RateOfDeformation Self;
}

/// Ṗ = A : Ḟ, Pa/s: see [`FirstPiolaTangent::rate`].
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_batch as batch;
/// use piola_continuum::DeformationGradient;
/// let (mut tangent, rate) = ([[0.0; 81]], [Matrix3::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)]);
/// tangent[0][0] = 2.0;
/// let mut out = [[0.0; 9]];
/// let request = batch::rate_of_first_piola_tangent(&tangent[..], &rate[..], &mut out[..]);
/// assert_eq!(request.at(&DeformationGradient::identity(), 0)[0], 10.0);
/// ```
#[must_use]
pub fn rate_of_first_piola_tangent<C, R, V>(
    tangent: C,
    rate: R,
    to: V,
) -> Request<RateOfFirstPiolaTangent, (C, R), V, 90, 9> {
    Request { quantity: RateOfFirstPiolaTangent, source: (tangent, rate), to }
}

/// The output of [`rate_of_first_piola_tangent`].
#[derive(Clone, Copy, Debug)]
pub struct RateOfFirstPiolaTangent;

impl Quantity<90, 9> for RateOfFirstPiolaTangent {
    type Input = (FirstPiolaTangent, GradientRate);
    type Output = FirstPiola;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "FirstPiolaTangent and rate of F";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 90]) -> [T; 9] {
        let [a, b, c, d, e, f, g, h, i] = part(&input, 81);
        let rate = general(part(&input, 0)).contract([[a, b, c], [d, e, f], [g, h, i]]);
        super::kinematic::flat(rate)
    }
}
