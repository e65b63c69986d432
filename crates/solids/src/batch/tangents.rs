//! Requests of the tangent: whole, its upper triangle, or its product with a direction.

use nalgebra::Matrix3;
use piola_batch::{Point, Quantity, Refusal, Request};
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::requests::{answered, flat, quantities};
use crate::Hyperelastic;

/// The entries (r, s) with r ≤ s of the 9×9 array, by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn upper<T: Real>(tangent: &FirstPiolaTangent<T>) -> [T; 45] {
    let [a, b, c, d, e, f, g, h, i] = tangent.0.components;
    [
        a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], c[2],
        c[3], c[4], c[5], c[6], c[7], c[8], d[3], d[4], d[5], d[6], d[7], d[8], e[4], e[5], e[6], e[7], e[8], f[5],
        f[6], f[7], f[8], g[6], g[7], g[8], h[7], h[8], i[8],
    ]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn square<T: Real>(tangent: &FirstPiolaTangent<T>) -> [T; 81] {
    let mut entries = [T::zero(); 81];
    let mut r = 0;
    while r < 9 {
        let mut s = 0;
        while s < 9 {
            entries[9 * r + s] = tangent.0.components[r][s];
            s += 1;
        }
        r += 1;
    }
    entries
}

quantities! {
    /// The 45 entries of ∂P/∂F that major symmetry leaves: those of row r and column s with r ≤ s, by rows, where the
    /// pair iA has the number r = 3 i + A.
    pub first_piola_tangent FirstPiolaTangentOf [45 knows] FirstPiolaTangentOf<'static, ()>, |law, point| upper(&law.first_piola_tangent(point));
    /// All 81 entries of ∂P/∂F: see [`Hyperelastic::first_piola_tangent`].
    pub first_piola_tangent_square FirstPiolaTangentSquareOf [81 knows] FirstPiolaTangent,
        |law, point| square(&law.first_piola_tangent(point));
    /// The 21 components of ∂S/∂E, the upper triangle by rows of the 6×6 array over the pairs 11, 22, 33, 12, 23, 13 without
    /// factors for shears, as in [`MajorSymmetric`](piola_tensor::MajorSymmetric): see
    /// [`Hyperelastic::material_tangent`].
    pub material_tangent MaterialTangentOf [21] MaterialTangentOf<'static, ()>,
        |law, point| law.material_tangent(point).0.components;
    /// The 21 components of c/J, which takes D to the Truesdell rate of T, in the order of [`material_tangent`]: see
    /// [`Hyperelastic::truesdell_tangent`].
    pub truesdell_tangent TruesdellTangentOf [21] TruesdellTangentOf<'static, ()>,
        |law, point| law.truesdell_tangent(point).0.components;
}

/// (∂P/∂F) : δF of a direction δF at each point: see [`Hyperelastic::first_piola_derivative`].
///
/// A direction so large that the answer is beyond the range of numbers is not refused: the answer is then not finite.
#[must_use]
pub fn first_piola_derivative<L: Hyperelastic + Sync, S, V>(
    law: &L,
    direction: S,
    to: V,
) -> Request<FirstPiolaDerivativeOf<'_, L>, S, V, 9, 9> {
    Request::new(FirstPiolaDerivativeOf(law), direction, to)
}

/// The output of [`first_piola_derivative`].
#[derive(Debug)]
pub struct FirstPiolaDerivativeOf<'a, L>(&'a L);

impl<L> Clone for FirstPiolaDerivativeOf<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L> Copy for FirstPiolaDerivativeOf<'_, L> {}

impl<L: Hyperelastic + Sync> Quantity<9, 9> for FirstPiolaDerivativeOf<'_, L> {
    type Input = Matrix3<f64>;
    type Output = FirstPiola;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "direction of the derivative";

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, direction: [T; 9]) -> [T; 9] {
        let [a, b, c, d, e, f, g, h, i] = direction;
        flat(&self.0.first_piola_derivative(point, &from_rows([[a, b, c], [d, e, f], [g, h, i]])))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, value: &[T; 9]) -> T::Mask {
        answered(self.0, point, value)
    }

    fn check<T: Real, D: Deformation<T>>(&self, deformation: &D) -> Result<(), Refusal> {
        self.0.check(deformation).map_err(Refusal::new)
    }
}
