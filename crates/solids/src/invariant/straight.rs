//! Stress and tangent of laws of straight code: a loop over the lanes.
//!
//! The law is copied: its parameters are then in registers. Behind a reference the loop would read them from memory, and the
//! compiler makes vectors of so short a loop only where it knows that nothing read is written, which it gives up to find out
//! where many numbers are written.

use nalgebra::Matrix3;
use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::internal::Lanewise;
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Dual, Mask, Real};
use piola_tensor::internal::rows::Rows;

use super::energy::InvariantEnergy;
use super::kinematics::InvariantKinematics;
use super::tangent::tangent;
use crate::packed;

/// P of F and ∇u, which are moderate.
struct Near<L>(L);

/// P of F, ∇u and J.
struct Any<L>(L);

/// (∂P/∂F) : δF of F and ∇u, which are moderate, and δF.
struct NearAlong<L>(L);

#[cfg_attr(not(debug_assertions), inline(always))]
fn stress<T: Real, L: InvariantEnergy>(law: &L, kinematics: &InvariantKinematics<T>) -> [T; 9] {
    let slopes = law.slopes(&kinematics.invariants);
    packed::of_stress(kinematics.first_piola::<L>(&slopes))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn both<T: Real, L: InvariantEnergy>(law: &L, kinematics: &InvariantKinematics<T>) -> [T; 54] {
    let (slopes, curvatures) = law.slopes_and_curvatures(&kinematics.invariants);
    let entries = tangent::<T, L>(&slopes, &curvatures, kinematics).0.components;
    packed::of_both(kinematics.first_piola::<L>(&slopes), &entries)
}

/// |∇u|² = tr (C − 1) − 2 tr ∇u, as it tells what is moderate.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn square<T: Real>(kinematics: &InvariantKinematics<T>, h: Rows<T>) -> T {
    kinematics.invariants.first - T::lit(2.0) * (h[0][0] + h[1][1] + h[2][2])
}

impl<L: InvariantEnergy> Lanewise<18, 10> for Near<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 10] {
        let [f, h] = packed::gradients(inputs);
        let kinematics = InvariantKinematics::near::<L>(f, h);
        let [a, b, c, d, e, g, i, j, k] = stress(&self.0, &kinematics);
        [a, b, c, d, e, g, i, j, k, square(&kinematics, h)]
    }
}

impl<L: InvariantEnergy> Lanewise<18, 55> for Near<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 55] {
        let [f, h] = packed::gradients(inputs);
        let kinematics = InvariantKinematics::near::<L>(f, h);
        packed::with_one_more(both(&self.0, &kinematics), square(&kinematics, h))
    }
}

impl<L: InvariantEnergy> Lanewise<19, 9> for Any<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 19]) -> [T; 9] {
        let ([f, h], jacobian) = packed::gradients_and_jacobian(inputs);
        stress(&self.0, &InvariantKinematics::of::<L>(f, h, jacobian))
    }
}

impl<L: InvariantEnergy> Lanewise<19, 54> for Any<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 19]) -> [T; 54] {
        let ([f, h], jacobian) = packed::gradients_and_jacobian(inputs);
        both(&self.0, &InvariantKinematics::of::<L>(f, h, jacobian))
    }
}

impl<L: InvariantEnergy> Lanewise<27, 10> for NearAlong<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 27]) -> [T; 10] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, last] = inputs;
        let gradient = along([[a, b, c], [d, e, f], [g, h, i]], [[s, t, u], [v, w, x], [y, z, last]]);
        let displacement = [[j, k, l], [m, n, o], [p, q, r]];
        let varied = along(displacement, [[s, t, u], [v, w, x], [y, z, last]]);
        let kinematics = InvariantKinematics::near::<L>(gradient, varied);
        let [a, b, c, d, e, f, g, h, i] = stress(&self.0, &kinematics);
        let square = square(&kinematics, varied).value;
        [a.tangent, b.tangent, c.tangent, d.tangent, e.tangent, f.tangent, g.tangent, h.tangent, i.tangent, square]
    }
}

/// Entries that grow in a direction.
#[cfg_attr(not(debug_assertions), inline(always))]
fn along<T: Real>([x, y, z]: Rows<T>, [u, v, w]: Rows<T>) -> Rows<Dual<T>> {
    [
        [Dual::new(x[0], u[0]), Dual::new(x[1], u[1]), Dual::new(x[2], u[2])],
        [Dual::new(y[0], v[0]), Dual::new(y[1], v[1]), Dual::new(y[2], v[2])],
        [Dual::new(z[0], w[0]), Dual::new(z[1], w[1]), Dual::new(z[2], w[2])],
    ]
}

/// (∂P/∂F) : δF, the stress over dual numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola_derivative<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
    direction: &Matrix3<T>,
) -> FirstPiola<T> {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = packed::of_deformation(deformation);
    let [[s, t, u], [v, w, x], [y, z, last]] = rows_of(direction);
    let inputs = [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, last];
    let [a, b, c, d, e, f, g, h, i, square] = T::lanewise(&NearAlong(law.clone()), inputs);
    if square.at_most(T::lit(kernels::MODERATE)).all() {
        return packed::stress([a, b, c, d, e, f, g, h, i]);
    }
    let varied = deformation.lifted(|i, j, x| Dual::new(x, direction[(i, j)]));
    FirstPiola(first_piola(law, &varied).0.map(|x| x.tangent))
}

/// P; not finite in its first component where F is no deformation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let inputs = packed::of_deformation(deformation);
    let [a, b, c, d, e, f, g, h, i, square] = T::lanewise(&Near(law.clone()), inputs);
    if square.at_most(T::lit(kernels::MODERATE)).all() {
        return packed::stress([a, b, c, d, e, f, g, h, i]);
    }
    let jacobian = deformation.jacobian();
    let mut any = T::lanewise(&Any(law.clone()), packed::with_jacobian(inputs, jacobian));
    any[0] = existing(jacobian, any[0]);
    packed::stress(any)
}

/// P and the upper triangle of ∂P/∂F; neither is finite in its first component where F is no deformation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola_and_upper_triangle<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> [T; 54] {
    let inputs = packed::of_deformation(deformation);
    let (near, square) = packed::without_last(T::lanewise(&Near(law.clone()), inputs));
    if square.at_most(T::lit(kernels::MODERATE)).all() {
        return near;
    }
    let jacobian = deformation.jacobian();
    let mut any = T::lanewise(&Any(law.clone()), packed::with_jacobian(inputs, jacobian));
    any[0] = existing(jacobian, any[0]);
    any[9] = existing(jacobian, any[9]);
    any
}

/// The value where 0 < det F < ∞, NaN elsewhere.
#[cfg_attr(not(debug_assertions), inline(always))]
fn existing<T: Real>(jacobian: T, value: T) -> T {
    let exists = T::zero().less_than(jacobian) & jacobian.is_finite();
    if exists.all() { value } else { T::select(exists, value, T::lit(f64::NAN)) }
}
