//! Derivatives of a motion, without checks: each is one pass over the differentiable scalar that it needs.

use nalgebra::Vector3;
use piola_numerics::{Dual, Gradient, Jet, Real};
use piola_tensor::internal::rows::Rows;

use super::Motion;

/// The three coordinates as variables.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn variables<T: Real>(x: &Vector3<T>) -> Vector3<Gradient<T, 3>> {
    Vector3::new(Gradient::variable(x[0], 0), Gradient::variable(x[1], 1), Gradient::variable(x[2], 2))
}

/// The coordinates as variables of first and second derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn twice_variables<T: Real>(x: &Vector3<T>) -> Vector3<Gradient<Gradient<T, 3>, 3>> {
    variables(&variables(x))
}

/// v = ∂x/∂t.
#[inline]
pub(crate) fn velocity<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> Vector3<T> {
    motion.place(&reference.map(Dual::constant), Dual::variable(t)).map(|x| x.tangent)
}

/// a = ∂²x/∂t².
#[inline]
pub(crate) fn acceleration<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> Vector3<T> {
    motion.place(&reference.map(Jet::<T, 0>::constant), Jet::time(t)).map(|x| x.second_rate)
}

/// (v, a).
#[inline]
pub(crate) fn velocity_and_acceleration<T: Real>(
    motion: &(impl Motion + ?Sized),
    reference: &Vector3<T>,
    t: T,
) -> (Vector3<T>, Vector3<T>) {
    let x = motion.place(&reference.map(Jet::<T, 0>::constant), Jet::time(t));
    (x.map(|x| x.rate), x.map(|x| x.second_rate))
}

/// (x, F).
#[inline]
pub(crate) fn place_and_gradient<T: Real>(
    motion: &(impl Motion + ?Sized),
    reference: &Vector3<T>,
    t: T,
) -> (Vector3<T>, Rows<T>) {
    let x = motion.place(&variables(reference), Gradient::constant(t));
    (x.map(|x| x.value), [x[0].partials, x[1].partials, x[2].partials])
}

/// F = ∂x/∂X.
#[inline]
pub(crate) fn gradient<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> Rows<T> {
    place_and_gradient(motion, reference, t).1
}

/// ∇u = ∂u/∂X.
#[inline]
pub(crate) fn displacement_gradient<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> Rows<T> {
    let u = motion.displacement(&variables(reference), Gradient::constant(t));
    [u[0].partials, u[1].partials, u[2].partials]
}

/// (F, Ḟ).
#[inline]
pub(crate) fn gradient_and_rate<T: Real>(
    motion: &(impl Motion + ?Sized),
    reference: &Vector3<T>,
    t: T,
) -> (Rows<T>, Rows<T>) {
    let reference = variables(&reference.map(Dual::constant));
    let x = motion.place(&reference, Gradient::constant(Dual::variable(t)));
    let parts = |part: fn(&Dual<T>) -> T| [0, 1, 2].map(|i: usize| [0, 1, 2].map(|a: usize| part(&x[i].partials[a])));
    (parts(|f| f.value), parts(|f| f.tangent))
}

/// F̈.
#[inline]
pub(crate) fn gradient_second_rate<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> Rows<T> {
    let reference = variables(&reference.map(Jet::<T, 0>::constant));
    let x = motion.place(&reference, Gradient::constant(Jet::time(t)));
    [0, 1, 2].map(|i: usize| x[i].partials.map(|f| f.second_rate))
}

/// `∂²xᵢ/∂X_A∂X_B`, as `[i][A][B]`.
#[inline]
pub(crate) fn second_gradient<T: Real>(motion: &(impl Motion + ?Sized), reference: &Vector3<T>, t: T) -> [Rows<T>; 3] {
    let t = Gradient::constant(Gradient::constant(t));
    let x = motion.place(&twice_variables(reference), t);
    [0, 1, 2].map(|i: usize| x[i].partials.map(|f| f.partials))
}
