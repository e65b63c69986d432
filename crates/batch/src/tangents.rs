//! Tangents: push-forward, pull-back, and from one rate to another.

use piola_numerics::Real;

use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use super::{BatchScalar, Destination, Source};
use crate::stress::tangents::{
    CauchyJaumannTangent, CauchyLowerConvectedTangent, CauchyUpperConvectedTangent, FirstPiolaTangent, JaumannTangent,
    LieTangent, LowerConvectedTangent, MaterialTangent, TruesdellTangent,
};
use crate::tensor::{FourthOrder, MajorSymmetric, MinorSymmetric};
use crate::{CauchyStress, Deformation, SecondPiola, Symmetric};

/// Nine rows of nine entries.
#[inline(always)]
pub(super) fn general<T: Real>(entries: [T; 81]) -> FourthOrder<T> {
    let mut tensor = FourthOrder::zero();
    let mut k = 0;
    while k < 81 {
        tensor.components[k / 9][k % 9] = entries[k];
        k += 1;
    }
    tensor
}

/// The entries of nine rows of nine.
#[inline(always)]
fn entries<T: Real>(tensor: &FourthOrder<T>) -> [T; 81] {
    let mut entries = [T::zero(); 81];
    let mut k = 0;
    while k < 81 {
        entries[k] = tensor.components[k / 9][k % 9];
        k += 1;
    }
    entries
}

/// The entries of six rows of six.
#[inline(always)]
pub(super) fn slots<T: Real>(tensor: &MinorSymmetric<T>) -> [T; 36] {
    let mut slots = [T::zero(); 36];
    let mut k = 0;
    while k < 36 {
        slots[k] = tensor.components[k / 6][k % 6];
        k += 1;
    }
    slots
}

/// One tangent of another.
macro_rules! tangents {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident $method:ident $to:ident;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<S, V>(tangent: S, to: V) -> Request<$name, S, V, 21, 21> {
            Request { quantity: $name, source: tangent, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<21, 21> for $name {
            type Input = $from;
            type Output = $to;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = stringify!($from);

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, components: [T; 21]) -> [T; 21] {
                $from::<T>(MajorSymmetric { components }).$method(point).0.components
            }
        }
    )* };
}

tangents! {
    /// c = `F_iA F_jB F_kC F_lD C_ABCD`, the push-forward of ∂S/∂E: see [`MaterialTangent::lie`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (material, mut spatial) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::push_forward_tangent(&material[..], &mut spatial[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 48.0); // 2⁴ × 3
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    push_forward_tangent PushForwardTangent MaterialTangent lie LieTangent;
    /// c/J: see [`MaterialTangent::truesdell`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (material, mut spatial) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::truesdell_tangent(&material[..], &mut spatial[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 24.0); // 2⁴ × 3/J
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    truesdell_tangent TruesdellTangentOutput MaterialTangent truesdell TruesdellTangent;
    /// c/J of c: see [`LieTangent::truesdell`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (lie, mut truesdell) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::lie_to_truesdell_tangent(&lie[..], &mut truesdell[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 1.5);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    lie_to_truesdell_tangent LieToTruesdellTangent LieTangent truesdell TruesdellTangent;
    /// ∂S/∂E of c, the pull-back: see [`LieTangent::material`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([0.5, 1.0, 1.0])?];
    /// let (lie, mut material) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::pull_back_tangent(&lie[..], &mut material[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 48.0); // 2⁴ × 3
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    pull_back_tangent PullBackTangent LieTangent material MaterialTangent;
    /// ∂S/∂E of c/J: see [`TruesdellTangent::material`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([0.5, 1.0, 1.0])?];
    /// let (spatial, mut material) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::truesdell_to_material_tangent(&spatial[..], &mut material[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 24.0); // J × 2⁴ × 3
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    truesdell_to_material_tangent TruesdellToMaterialTangent TruesdellTangent material MaterialTangent;
    /// c of c/J: see [`TruesdellTangent::lie`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (truesdell, mut lie) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// let request = batch::truesdell_to_lie_tangent(&truesdell[..], &mut lie[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 6.0);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    truesdell_to_lie_tangent TruesdellToLieTangent TruesdellTangent lie LieTangent;
}

/// A tangent of a stress and another tangent.
macro_rules! with_stress {
    ($($(#[$documentation:meta])* $function:ident $name:ident $stress:ident $from:ident [$i:literal => $k:literal] $to:ty,
        |$t:ident, $tangent:ident, $point:ident| $value:expr, $components:expr;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<S, C, V>(stress: S, tangent: C, to: V) -> Request<$name, (S, C), V, $i, $k> {
            Request { quantity: $name, source: (stress, tangent), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$i, $k> for $name {
            type Input = ($stress, $from);
            type Output = $to;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = concat!(stringify!($stress), " and ", stringify!($from));

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; $i]) -> [T; $k] {
                let $t = &$stress(Symmetric { components: part(&input, 0) });
                let $tangent = $from::<T>(MajorSymmetric { components: part(&input, 6) });
                $components(&$value.0)
            }
        }
    )* };
}

/// The components of a tensor with major symmetry.
#[inline(always)]
fn major<T: Real>(tensor: &MajorSymmetric<T>) -> [T; 21] {
    tensor.components
}

with_stress! {
    /// ∂P/∂F of S and ∂S/∂E: see [`MaterialTangent::first_piola`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let stress = [SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (material, mut nominal) = ([MajorSymmetric::isotropic(1.0, 3.0)], [[0.0; 81]]);
    /// let request = batch::first_piola_tangent(&stress[..], &material[..], &mut nominal[..]);
    /// assert_eq!(request.at(&f[0], 0)[0], 38.0); // S₁₁ + 2² · 7
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    first_piola_tangent FirstPiolaTangentOutput SecondPiola MaterialTangent [27 => 81] FirstPiolaTangent,
        |stress, tangent, point| tangent.first_piola(stress, point), entries;
    /// The tangent of Jaumann's rate of τ, over J (`DDSDDE` of Abaqus), of T and c/J: see [`TruesdellTangent::jaumann`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (truesdell, mut jaumann) = ([MajorSymmetric::isotropic(1.0, 3.0)], [MajorSymmetric::zero()]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::jaumann_tangent(&stress[..], &truesdell[..], &mut jaumann[..]);
    /// assert_eq!(request.at(&any, 0)[0], 27.0); // 7 + 2 T₁₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    jaumann_tangent JaumannTangentOutput CauchyStress TruesdellTangent [27 => 21] JaumannTangent,
        |stress, tangent, _point| tangent.jaumann(stress), major;
    /// c/J of T and the tangent of Jaumann's rate of τ, over J: see [`JaumannTangent::truesdell`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (jaumann, mut truesdell) = ([MajorSymmetric::isotropic(1.0, 3.0)], [MajorSymmetric::zero()]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::jaumann_to_truesdell_tangent(&stress[..], &jaumann[..], &mut truesdell[..]);
    /// assert_eq!(request.at(&any, 0)[0], -13.0); // 7 − 2 T₁₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    jaumann_to_truesdell_tangent JaumannToTruesdellTangent CauchyStress JaumannTangent [27 => 21] TruesdellTangent,
        |stress, tangent, _point| tangent.truesdell(stress), major;
    /// The tangent of the lower-convected rate of τ, over J, of T and c/J: see [`TruesdellTangent::lower_convected`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (truesdell, mut lower) = ([MajorSymmetric::isotropic(1.0, 3.0)], [MajorSymmetric::zero()]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::lower_convected_tangent(&stress[..], &truesdell[..], &mut lower[..]);
    /// assert_eq!(request.at(&any, 0)[0], 47.0); // 7 + 4 T₁₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    lower_convected_tangent LowerConvectedTangentOutput CauchyStress TruesdellTangent [27 => 21] LowerConvectedTangent,
        |stress, tangent, _point| tangent.lower_convected(stress), major;
    /// The tangent of Jaumann's rate of T itself, of T and c/J, 36 entries: see [`JaumannTangent::cauchy`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (truesdell, mut jaumann) = ([MajorSymmetric::isotropic(1.0, 3.0)], [[0.0; 36]]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::cauchy_jaumann_tangent(&stress[..], &truesdell[..], &mut jaumann[..]);
    /// let entries = request.at(&any, 0);
    /// assert_eq!((entries[0], entries[1], entries[6]), (17.0, -9.0, 1.0)); // less T ⊗ 1
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    cauchy_jaumann_tangent CauchyJaumannTangentOutput CauchyStress TruesdellTangent [27 => 36] CauchyJaumannTangent,
        |stress, tangent, _point| tangent.jaumann(stress).cauchy(stress), slots;
    /// The tangent of the upper-convected rate of T itself, of T and c/J, 36 entries: see
    /// [`TruesdellTangent::cauchy_upper_convected`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (truesdell, mut upper) = ([MajorSymmetric::isotropic(1.0, 3.0)], [[0.0; 36]]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::cauchy_upper_convected_tangent(&stress[..], &truesdell[..], &mut upper[..]);
    /// assert_eq!(request.at(&any, 0)[0], -3.0); // 7 − T₁₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    cauchy_upper_convected_tangent CauchyUpperConvectedTangentOutput CauchyStress TruesdellTangent [27 => 36]
        CauchyUpperConvectedTangent, |stress, tangent, _point| tangent.cauchy_upper_convected(stress), slots;
    /// The tangent of the lower-convected rate of T itself, of T and c/J, 36 entries: see
    /// [`LowerConvectedTangent::cauchy`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// use piola_tensor::MajorSymmetric;
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
    /// let (truesdell, mut lower) = ([MajorSymmetric::isotropic(1.0, 3.0)], [[0.0; 36]]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::cauchy_lower_convected_tangent(&stress[..], &truesdell[..], &mut lower[..]);
    /// assert_eq!(request.at(&any, 0)[0], 37.0); // 47 − T₁₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    cauchy_lower_convected_tangent CauchyLowerConvectedTangentOutput CauchyStress TruesdellTangent [27 => 36]
        CauchyLowerConvectedTangent, |stress, tangent, _point| tangent.lower_convected(stress).cauchy(stress), slots;
}

/// ∂S/∂E of S and ∂P/∂F, 36 entries: see [`FirstPiolaTangent::material`].
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, SecondPiola};
/// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
/// let stress = [SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
/// let (mut nominal, mut material) = ([[0.0_f64; 81]], [[0.0_f64; 36]]);
/// nominal[0][0] = 38.0;
/// let request = batch::material_tangent(&stress[..], &nominal[..], &mut material[..]);
/// assert!((request.at(&f[0], 0)[0] - 7.0).abs() < 1e-14); // (38 − S₁₁)/2²
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn material_tangent<S, C, V>(stress: S, tangent: C, to: V) -> Request<MaterialTangentOutput, (S, C), V, 87, 36> {
    Request { quantity: MaterialTangentOutput, source: (stress, tangent), to }
}

/// The output of [`material_tangent`].
#[derive(Clone, Copy, Debug)]
pub struct MaterialTangentOutput;

impl Quantity<87, 36> for MaterialTangentOutput {
    type Input = (SecondPiola, FirstPiolaTangent);
    type Output = MaterialTangent;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "SecondPiola and FirstPiolaTangent";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; 87]) -> [T; 36] {
        let stress = SecondPiola(Symmetric { components: part(&input, 0) });
        slots(&FirstPiolaTangent(general(part(&input, 6))).material(&stress, point).0)
    }
}

impl<Q, T: BatchScalar> Destination<Q, T, 36> for &mut [MinorSymmetric<T>] {
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
        for (row, values) in self[index].components.iter_mut().zip(components.as_chunks::<6>().0) {
            *row = *values;
        }
    }
}

impl<T: BatchScalar> Source<FirstPiolaTangent, T, 81> for &[FirstPiolaTangent<T>] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[inline(always)]
    fn point(&self, index: usize) -> [T; 81] {
        entries(&self[index].0)
    }
}

impl<Q, T: BatchScalar> Source<Q, T, 21> for &[MajorSymmetric<T>] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[inline(always)]
    fn point(&self, index: usize) -> [T; 21] {
        self[index].components
    }
}

impl<Q, T: BatchScalar> Destination<Q, T, 21> for &mut [MajorSymmetric<T>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[inline(always)]
    fn put(&mut self, index: usize, components: [T; 21]) {
        self[index] = MajorSymmetric { components };
    }
}

macro_rules! typed {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 21> for &[$name<T>] {
            #[inline(always)]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; 21] {
                self[index].0.components
            }
        }

        impl<T: BatchScalar> Destination<$name, T, 21> for &mut [$name<T>] {
            #[inline(always)]
            fn count(&self) -> usize {
                self.len()
            }
            #[inline(always)]
            fn split(self, middle: usize) -> (Self, Self) {
                self.split_at_mut(middle)
            }
            #[inline(always)]
            fn put(&mut self, index: usize, components: [T; 21]) {
                self[index] = $name(MajorSymmetric { components });
            }
        }
    )* };
}
typed!(MaterialTangent LieTangent TruesdellTangent JaumannTangent LowerConvectedTangent);

/// All 81 entries of ∂P/∂F, those of a pair of indices `iA` a row.
impl<T: BatchScalar> Destination<FirstPiolaTangent, T, 81> for &mut [FirstPiolaTangent<T>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[inline(always)]
    fn put(&mut self, index: usize, components: [T; 81]) {
        let entries = &mut self[index].0.components;
        for (row, values) in entries.iter_mut().zip(components.as_chunks::<9>().0) {
            *row = *values;
        }
    }
}
