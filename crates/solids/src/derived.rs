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
    energy_and_first_piola(law, deformation).1
}

/// (W, P): the evaluation for P has W beside it.
#[inline]
#[must_use]
pub fn energy_and_first_piola<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>) {
    let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
    let Gradient { value, partials } = law.energy(&varied);
    (value, FirstPiola(Matrix3::from_fn(|i, j| partials[3 * i + j])))
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
    let (_, stress, tangent) = energy_first_piola_and_tangent(law, deformation);
    (stress, tangent)
}

/// (W, P, ∂P/∂F): the evaluations for ∂P/∂F have W and P beside it.
#[inline]
#[must_use]
pub fn energy_first_piola_and_tangent<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
    let columns: [Gradient<Dual<T>, 9>; 9] =
        core::array::from_fn(|column| second_derivatives(law, deformation, column));
    let components = core::array::from_fn(|row| core::array::from_fn(|column| columns[column].partials[row].tangent));
    let first = &columns[0];
    let stress = Matrix3::from_fn(|i, j| first.partials[3 * i + j].value);
    (first.value.value, FirstPiola(stress), FirstPiolaTangent(FourthOrder { components }))
}

/// W, P and ∂P/∂F of one entry of F: compiled once for each law and scalar.
#[inline(never)]
fn second_derivatives<T: Real, L: Hyperelastic + ?Sized>(
    law: &L,
    deformation: &impl Deformation<T>,
    column: usize,
) -> Gradient<Dual<T>, 9> {
    let varied = deformation.lifted(|i, j, x| {
        let place = 3 * i + j;
        let inner = if place == column { Dual::variable(x) } else { Dual::constant(x) };
        Gradient::<Dual<T>, 9>::variable(inner, place)
    });
    law.energy(&varied)
}
