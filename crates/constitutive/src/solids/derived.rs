//! Stresses and tangents as exact derivatives of an energy.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::tensor::FourthOrder;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::{Dual, Gradient, Real};

use super::Hyperelastic;

/// P = ∂W/∂F by one evaluation with nine directions.
#[inline]
#[must_use]
pub fn first_piola<T: Real, L: Hyperelastic + ?Sized>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
    let slopes = law.energy(&varied).partials;
    FirstPiola(Matrix3::from_fn(|i, j| slopes[3 * i + j]))
}

/// ∂P/∂F = ∂²W/∂F∂F, a column at a time.
#[inline]
#[must_use]
pub fn first_piola_tangent<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    first_piola_and_tangent(law, deformation).1
}

/// (P, ∂P/∂F): the evaluations for ∂P/∂F have P beside it.
#[inline]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    let columns: [[Dual<T>; 9]; 9] = core::array::from_fn(|column| second_derivatives(law, deformation, column));
    let components = core::array::from_fn(|row| core::array::from_fn(|column| columns[column][row].tangent));
    let stress = Matrix3::from_fn(|i, j| columns[0][3 * i + j].value);
    (FirstPiola(stress), FirstPiolaTangent(FourthOrder { components }))
}

/// P and ∂P/∂F of one entry of F: compiled once for each law and scalar.
#[inline(never)]
fn second_derivatives<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
    column: usize,
) -> [Dual<T>; 9] {
    let varied = deformation.lifted(|i, j, x| {
        let place = 3 * i + j;
        let inner = if place == column { Dual::variable(x) } else { Dual::constant(x) };
        Gradient::<Dual<T>, 9>::variable(inner, place)
    });
    law.energy(&varied).partials
}
