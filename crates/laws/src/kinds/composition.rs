//! P and ∂P/∂F of given slopes and curvatures of W: one composition for all laws of I₁, I₂ and J.
//!
//! A library that offers many laws computes in three passes: the invariants, slopes and curvatures of the law, this composition. It is
//! compiled once instead of into the kernel of each law. The formulas are those of the laws themselves; terms of a law that does not
//! depend on I₂, or has no curvature, are zero.

use piola_continuum::Deformation;
use piola_continuum::internal::strain::MODERATE;
use piola_numerics::internal::Lanewise;
use piola_numerics::{Mask, Real};
use piola_solids::internal::composition::{InvariantKinematics, square, sum_of_terms};
use piola_solids::internal::packed::{self, joined};
use piola_solids::invariant::{Curvatures, Invariants, Slopes};

/// I₁ − 3, I₂ − 3, J − 1 and the rest as stresses need them: errors are relative to the strain.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn invariants<T: Real>(deformation: &impl Deformation<T>) -> Invariants<T> {
    let (f, h) = (deformation.gradient_rows(), deformation.displacement_rows());
    InvariantKinematics::with_invariants::<true>(f, h, deformation.jacobian()).invariants
}

/// Of F and ∇u, which are moderate; the last number tells whether they are.
struct Near;

/// Of F, ∇u and J.
struct Any;

#[cfg_attr(not(debug_assertions), inline(always))]
const fn slopes<T: Copy>([first, second, residual, volume]: [T; 4]) -> Slopes<T> {
    Slopes { first, second, residual, volume }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn stress<T: Real>(kinematics: &InvariantKinematics<T>, given: [T; 4]) -> [T; 9] {
    packed::of_stress(kinematics.stress::<true>(&slopes(given)))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn both<T: Real>(kinematics: &InvariantKinematics<T>, given: [T; 10]) -> [T; 54] {
    let [p, q, r, s, first_first, first_second, second_second, first_volume, second_volume, volume_volume] = given;
    let slopes = slopes([p, q, r, s]);
    let curvatures =
        Curvatures { first_first, first_second, second_second, first_volume, second_volume, volume_volume };
    let entries = sum_of_terms::<T, true, true>(&slopes, &curvatures, kinematics).0.components;
    packed::of_both(kinematics.stress::<true>(&slopes), &entries)
}

// Written out: loops within the loop over lanes would keep that from becoming vectors.

impl Lanewise<22, 10> for Near {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 22]) -> [T; 10] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, w, x, y, z] = inputs;
        let [gradient, displacement] = packed::gradients([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]);
        let kinematics = InvariantKinematics::closed::<true>(gradient, displacement);
        let [a, b, c, d, e, f, g, h, i] = stress(&kinematics, [w, x, y, z]);
        [a, b, c, d, e, f, g, h, i, square(&kinematics, displacement)]
    }
}

impl Lanewise<28, 55> for Near {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 28]) -> [T; 55] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, w, x, y, z, aa, bb, cc, dd, ee, ff] = inputs;
        let [gradient, displacement] = packed::gradients([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]);
        let kinematics = InvariantKinematics::closed::<true>(gradient, displacement);
        packed::with_one_more(
            both(&kinematics, [w, x, y, z, aa, bb, cc, dd, ee, ff]),
            square(&kinematics, displacement),
        )
    }
}

impl Lanewise<23, 9> for Any {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 23]) -> [T; 9] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, w, x, y, z, jacobian] = inputs;
        let [gradient, displacement] = packed::gradients([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]);
        stress(&InvariantKinematics::with_invariants::<true>(gradient, displacement, jacobian), [w, x, y, z])
    }
}

impl Lanewise<29, 54> for Any {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 29]) -> [T; 54] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, w, x, y, z, aa, bb, cc, dd, ee, ff, jacobian] =
            inputs;
        let [gradient, displacement] = packed::gradients([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]);
        both(
            &InvariantKinematics::with_invariants::<true>(gradient, displacement, jacobian),
            [w, x, y, z, aa, bb, cc, dd, ee, ff],
        )
    }
}

/// P by rows of ∂W/∂I₁, ∂W/∂I₂, s and J ∂W/∂J, as [`Slopes`] has them.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola<T: Real>(deformation: &impl Deformation<T>, given: [T; 4]) -> [T; 9] {
    let inputs: [T; 22] = joined(&packed::of_deformation(deformation), &given);
    let [a, b, c, d, e, f, g, h, i, square] = T::lanewise(&Near, inputs);
    if square.at_most(T::lit(MODERATE)).all() {
        return [a, b, c, d, e, f, g, h, i];
    }
    T::lanewise(&Any, joined(&inputs, &[deformation.jacobian()]))
}

/// P and the upper triangle of ∂P/∂F of the slopes and the six second derivatives, as [`Curvatures`] has them.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_and_upper_triangle<T: Real>(deformation: &impl Deformation<T>, given: [T; 10]) -> [T; 54] {
    let inputs: [T; 28] = joined(&packed::of_deformation(deformation), &given);
    let (near, square) = packed::without_last(T::lanewise(&Near, inputs));
    if square.at_most(T::lit(MODERATE)).all() {
        return near;
    }
    T::lanewise(&Any, joined(&inputs, &[deformation.jacobian()]))
}
