//! Stresses and tangents of other measures from P and ∂P/∂F, in lanes: one formula for all laws.
//!
//! ```text
//! S = sym(F⁻¹ P)      T = F S Fᵀ/J of P: sym(P Fᵀ)/J      ∂S/∂E = F⁻¹ F⁻¹ (∂P/∂F − 1 ⊗ S)      c/J = F F F F ∂S/∂E /J
//! ```

use piola::batch::{Point, Quantity};
use piola::continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola::continuum::{Deformation, FirstPiola};
use piola::numerics::Real;
use piola::numerics::linear::matrix3::from_rows;
use piola::tensor::FourthOrder;

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
fn tangent<T: Real>(numbers: &[T; 54]) -> FirstPiolaTangent<T> {
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
fn material<T: Real>(numbers: &[T; 54], deformation: &impl Deformation<T>) -> MaterialTangent<T> {
    let stress = stress(numbers).second_piola(deformation);
    MaterialTangent(tangent(numbers).material(&stress, deformation).0.major_part())
}

macro_rules! quantities {
    ($($(#[$about:meta])* $name:ident [$i:literal => $k:literal], |$point:ident, $numbers:ident| $value:expr;)*) => { $(
        $(#[$about])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name;

        impl Quantity<$i, $k> for $name {
            type Input = ();
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "first Piola-Kirchhoff stress";

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, $numbers: [T; $i]) -> [T; $k] {
                $value
            }
        }
    )* };
}

quantities! {
    /// T of P: 11, 22, 33, 12, 23, 13.
    CauchyOfFirstPiola [9 => 6], |point, numbers| stress(&numbers).kirchhoff(point).cauchy(point).0.components;
    /// S of P: 11, 22, 33, 12, 23, 13.
    SecondPiolaOfFirstPiola [9 => 6], |point, numbers| stress(&numbers).second_piola(point).0.components;
    /// ∂S/∂E of P and ∂P/∂F: the upper triangle of 6×6 entries by rows.
    MaterialOfFirstPiola [54 => 21], |point, numbers| material(&numbers, point).0.components;
    /// c/J of P and ∂P/∂F.
    TruesdellOfFirstPiola [54 => 21], |point, numbers| material(&numbers, point).truesdell(point).0.components;
    /// Jaumann's tangent of P and ∂P/∂F.
    JaumannOfFirstPiola [54 => 21], |point, numbers| {
        let stress = stress(&numbers).kirchhoff(point).cauchy(point);
        material(&numbers, point).truesdell(point).jaumann(&stress).0.components
    };
}

/// All 81 entries of ∂P/∂F of P and the upper triangle.
pub(crate) fn square(numbers: &[f64; 54]) -> [f64; 81] {
    let mut entries = [0.0; 81];
    for (index, entry) in entries.iter_mut().enumerate() {
        *entry = numbers[9 + place(index / 9, index % 9)];
    }
    entries
}

/// All nine components by rows of a symmetric tensor in the order 11, 22, 33, 12, 23, 13.
pub(crate) const fn all_nine([a, b, c, d, e, f]: [f64; 6]) -> [f64; 9] {
    [a, d, f, d, b, e, f, e, c]
}
