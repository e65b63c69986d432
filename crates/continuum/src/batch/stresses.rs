//! Conversions between measures of stress, and their invariants.

use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Lanes, Real};

use super::kinematic::flat;
use super::point::Point;
use super::requests::{Quantity, Request};
use super::{BatchScalar, Destination};
use crate::spectral::decompose;
use crate::stress::invariants;
use crate::tensor::rows::Rows;
use crate::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, MandelStress, SecondPiola, Symmetric};

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
general!(FirstPiola MandelStress);

macro_rules! conversions {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident [$i:literal] $method:ident $to:ident [$k:literal];)*) => { $(
        $(#[$documentation])*
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
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = stringify!($from);

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; $i]) -> [T; $k] {
                $from::<T>::of_components(input).$method(point).components()
            }
        }
    )* };
}

conversions! {
    /// τ = J T.
    cauchy_to_kirchhoff CauchyToKirchhoff CauchyStress [6] kirchhoff KirchhoffStress [6];
    /// P = T Cof F.
    cauchy_to_first_piola CauchyToFirstPiola CauchyStress [6] first_piola FirstPiola [9];
    /// S = J F⁻¹ T F⁻ᵀ.
    cauchy_to_second_piola CauchyToSecondPiola CauchyStress [6] second_piola SecondPiola [6];
    /// M = Fᵀ T Cof F.
    cauchy_to_mandel CauchyToMandel CauchyStress [6] mandel MandelStress [9];
    /// T = τ/J.
    kirchhoff_to_cauchy KirchhoffToCauchy KirchhoffStress [6] cauchy CauchyStress [6];
    /// P = τ F⁻ᵀ.
    kirchhoff_to_first_piola KirchhoffToFirstPiola KirchhoffStress [6] first_piola FirstPiola [9];
    /// S = F⁻¹ τ F⁻ᵀ.
    kirchhoff_to_second_piola KirchhoffToSecondPiola KirchhoffStress [6] second_piola SecondPiola [6];
    /// M = Fᵀ τ F⁻ᵀ.
    kirchhoff_to_mandel KirchhoffToMandel KirchhoffStress [6] mandel MandelStress [9];
    /// T = sym(P Fᵀ)/J.
    first_piola_to_cauchy FirstPiolaToCauchy FirstPiola [9] cauchy CauchyStress [6];
    /// τ = sym(P Fᵀ).
    first_piola_to_kirchhoff FirstPiolaToKirchhoff FirstPiola [9] kirchhoff KirchhoffStress [6];
    /// S = sym(F⁻¹ P).
    first_piola_to_second_piola FirstPiolaToSecondPiola FirstPiola [9] second_piola SecondPiola [6];
    /// M = Fᵀ P.
    first_piola_to_mandel FirstPiolaToMandel FirstPiola [9] mandel MandelStress [9];
    /// T = F S Fᵀ/J.
    second_piola_to_cauchy SecondPiolaToCauchy SecondPiola [6] cauchy CauchyStress [6];
    /// τ = F S Fᵀ.
    second_piola_to_kirchhoff SecondPiolaToKirchhoff SecondPiola [6] kirchhoff KirchhoffStress [6];
    /// P = F S.
    second_piola_to_first_piola SecondPiolaToFirstPiola SecondPiola [6] first_piola FirstPiola [9];
    /// M = C S.
    second_piola_to_mandel SecondPiolaToMandel SecondPiola [6] mandel MandelStress [9];
    /// P = F⁻ᵀ M.
    mandel_to_first_piola MandelToFirstPiola MandelStress [9] first_piola FirstPiola [9];
}

macro_rules! invariants {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] |$stress:ident| $value:expr;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<S, V>(stress: S, to: V) -> Request<$name, S, V, 6, $k> {
            Request { quantity: $name, source: stress, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<6, $k> for $name {
            type Input = CauchyStress;
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "stress";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; $k] {
                let $stress = &Symmetric { components };
                $value
            }
        }
    )* };
}

invariants! {
    /// m = ⅓ tr T.
    mean_stress MeanStress [1] |stress| [invariants::mean(stress)];
    /// D = T − m 1.
    deviator Deviator [6] |stress| invariants::deviator(stress).components;
    /// √(3 J₂): see [`von_mises`](invariants::von_mises).
    von_mises VonMises [1] |stress| [invariants::von_mises(stress)];
    /// σ₁ − σ₃: see [`tresca`](invariants::tresca).
    tresca Tresca [1] |stress| [invariants::tresca(stress)];
    /// θ ∈ [0, π/3]: see [`lode_angle`](invariants::lode_angle).
    lode_angle LodeAngle [1] |stress| [invariants::lode_angle(stress)];
    /// σ₁ ≥ σ₂ ≥ σ₃: see [`PrincipalStresses`](crate::stress::PrincipalStresses).
    principal_stresses PrincipalStresses [3] |stress| crate::stress::PrincipalStresses::of(stress).values();
}

/// Eigenvalues and eigenvectors of a symmetric tensor: see [`decompose`].
///
/// The vectors go out as nine components, one vector a row.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, batch};
/// let (mut values, mut vectors) = ([[0.0_f64; 3]], [[[0.0_f64; 3]; 3]]);
/// let tensors = [Symmetric::diagonal([1.0, 3.0, 2.0])];
/// batch::evaluate(batch::Undeformed(1), batch::eigenpairs(&tensors[..], &mut values[..], &mut vectors[..]))?;
/// assert!((values[0][0] - 3.0).abs() < 2e-15 && (vectors[0][0][1].abs() - 1.0).abs() < 1e-15);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[must_use]
pub fn eigenpairs<S, V, W>(tensor: S, values: V, vectors: W) -> Request<Eigenpairs, S, (V, W), 6, 12> {
    Request { quantity: Eigenpairs, source: tensor, to: (values, vectors) }
}

/// The output of [`eigenpairs`].
#[derive(Clone, Copy, Debug)]
pub struct Eigenpairs;

impl Quantity<6, 12> for Eigenpairs {
    type Input = Symmetric;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; 12] {
        let decomposition = decompose(&Symmetric { components });
        let ([x, y, z], [a, b, c, d, e, f, g, h, i]) = (decomposition.values, flat(decomposition.vectors));
        [x, y, z, a, b, c, d, e, f, g, h, i]
    }
}

/// Values and vectors apart.
impl<T, V, W> Destination<Eigenpairs, T, 12> for (V, W)
where
    T: BatchScalar,
    V: Destination<Eigenpairs, T, 3>,
    W: Destination<Eigenpairs, T, 9>,
{
    fn count(&self) -> usize {
        // Both are checked: a pair is as long as both parts, and no batch as long as neither.
        let (values, vectors) = (self.0.count(), self.1.count());
        if values == vectors { values } else { usize::MAX }
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        let ((a, b), (c, d)) = (self.0.split(middle), self.1.split(middle));
        ((a, c), (b, d))
    }
    #[inline(always)]
    fn put(&mut self, index: usize, [x, y, z, a, b, c, d, e, f, g, h, i]: [T; 12]) {
        self.0.put(index, [x, y, z]);
        self.1.put(index, [a, b, c, d, e, f, g, h, i]);
    }
    #[inline(always)]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: [Lanes<T, N>; 12]) {
        let [x, y, z, a, b, c, d, e, f, g, h, i] = values;
        self.0.store(first, count, [x, y, z]);
        self.1.store(first, count, [a, b, c, d, e, f, g, h, i]);
    }
}
