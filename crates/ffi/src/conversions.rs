//! Stresses and tangents of other measures from P and ∂P/∂F, in lanes: one formula for all laws.
//!
//! ```text
//! S = sym(F⁻¹ P)      T = F S Fᵀ/J of P: sym(P Fᵀ)/J      ∂S/∂E = F⁻¹ F⁻¹ (∂P/∂F − 1 ⊗ S)      c/J = F F ∂P/∂F /J − 1 ⊗̄ T
//! ```

use piola::continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola::continuum::{Deformation, DeformationGradient, FirstPiola};
use piola::numerics::Real;
use piola::numerics::linear::matrix3::from_rows;
use piola::tensor::{FourthOrder, MajorSymmetric, MinorSymmetric, PairSymmetric};

use crate::stages::Stage;

/// The place of entry (r, s), r ≤ s, in the upper triangle of 9×9 entries by rows.
const fn place(r: usize, s: usize) -> usize {
    let (r, s) = if r <= s { (r, s) } else { (s, r) };
    9 * r - r * (r + 1) / 2 + s
}

/// P of nine numbers by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn stress<T: Real>(numbers: &[T]) -> FirstPiola<T> {
    FirstPiola(from_rows([
        [numbers[0], numbers[1], numbers[2]],
        [numbers[3], numbers[4], numbers[5]],
        [numbers[6], numbers[7], numbers[8]],
    ]))
}

/// ∂P/∂F of its upper triangle, which follows the nine numbers of P.
#[cfg_attr(not(debug_assertions), inline(always))]
fn tangent<T: Real>(numbers: &[T; 55]) -> FirstPiolaTangent<T> {
    let mut components = [[T::zero(); 9]; 9];
    let mut r = 0;
    while r < 9 {
        let mut s = 0;
        while s < 9 {
            components[r][s] = numbers[9 + place(r, s)];
            s += 1;
        }
        r += 1;
    }
    FirstPiolaTangent(FourthOrder { components })
}

/// ∂S/∂E with the symmetry of a law that has an energy.
#[cfg_attr(not(debug_assertions), inline(always))]
fn material<T: Real>(numbers: &[T; 55], deformation: &impl Deformation<T>) -> MaterialTangent<T> {
    let stress = stress(numbers).second_piola(deformation);
    MaterialTangent(tangent(numbers).material(&stress, deformation).0.major_part())
}

/// The upper triangle of a tangent with the symmetry of a law that has an energy.
#[cfg_attr(not(debug_assertions), inline(always))]
fn upper<T: Real>(tangent: &MinorSymmetric<T>) -> [T; 21] {
    MajorSymmetric::from_slots(&tangent.components).components
}

macro_rules! conversions {
    ($($(#[$about:meta])* $name:ident [$i:literal => $k:literal], |$f:ident, $numbers:ident| $value:expr;)*) => { $(
        $(#[$about])*
        pub(crate) struct $name;

        impl Stage<$i, $k> for $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at<T: Real>(&self, $f: &DeformationGradient<T>, $numbers: [T; $i]) -> [T; $k] {
                $value
            }
        }
    )* };
}

conversions! {
    /// T of P: 11, 22, 33, 12, 23, 13.
    CauchyOfFirstPiola [10 => 6], |f, numbers| stress(&numbers).kirchhoff(f).cauchy(f).0.components;
    /// S of P: 11, 22, 33, 12, 23, 13.
    SecondPiolaOfFirstPiola [10 => 6], |f, numbers| stress(&numbers).second_piola(f).0.components;
    /// ∂S/∂E of P and ∂P/∂F: the upper triangle of 6×6 entries by rows.
    MaterialOfFirstPiola [55 => 21], |f, numbers| material(&numbers, f).0.components;
    /// c/J of P and ∂P/∂F.
    TruesdellOfFirstPiola [55 => 21], |f, numbers| {
        let stress = stress(&numbers).kirchhoff(f).cauchy(f);
        upper(&tangent(&numbers).spatial(&stress, f).0)
    };
    /// Jaumann's tangent of P and ∂P/∂F.
    JaumannOfFirstPiola [55 => 21], |f, numbers| {
        let stress = stress(&numbers).kirchhoff(f).cauchy(f);
        upper(&tangent(&numbers).spatial(&stress, f).jaumann(&stress).0)
    };
}

/// Where the 81 entries of ∂P/∂F by rows stand behind P in its upper triangle.
pub(crate) const SQUARE: [usize; 81] = {
    let mut places = [0; 81];
    let mut index = 0;
    while index < 81 {
        places[index] = 9 + place(index / 9, index % 9);
        index += 1;
    }
    places
};

/// Where the nine components by rows of a symmetric tensor stand in 11, 22, 33, 12, 23, 13.
pub(crate) const ALL_NINE: [usize; 9] = [0, 3, 5, 3, 1, 4, 5, 4, 2];

/// Nine components as they are.
pub(crate) const BY_ROWS: [usize; 9] = [0, 1, 2, 3, 4, 5, 6, 7, 8];
