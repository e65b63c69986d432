//! The tangent of a law of invariants, put together from its four kinds of terms.

use piola_continuum::Symmetric;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_numerics::Real;
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::{Rows, product, product_transposed};

use super::energy::{Curvatures, InvariantEnergy, Slopes};
use super::kinematics::InvariantKinematics;

#[cfg_attr(not(debug_assertions), inline(always))]
fn flat<T: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> [T; 9] {
    [a, b, c, d, e, f, g, h, i]
}

/// α a.
#[cfg_attr(not(debug_assertions), inline(always))]
fn multiple<T: Real>(alpha: T, a: &[T; 9]) -> [T; 9] {
    let mut multiple = [T::zero(); 9];
    let mut r = 0;
    while r < 9 {
        multiple[r] = alpha * a[r];
        r += 1;
    }
    multiple
}

/// α a + β b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn combined<T: Real>(alpha: T, a: &[T; 9], beta: T, b: &[T; 9]) -> [T; 9] {
    let mut sum = [T::zero(); 9];
    let mut r = 0;
    while r < 9 {
        sum[r] = alpha * a[r] + beta * b[r];
        r += 1;
    }
    sum
}

/// The four kinds of terms: dyads of F, Cof F and ∂I₂; ε ε of F and Cof F; C and B; the diagonal.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn tangent<T: Real, L: InvariantEnergy>(
    slopes: &Slopes<T>,
    curvatures: &Curvatures<T>,
    kinematics: &InvariantKinematics<T>,
) -> FirstPiolaTangent<T> {
    if L::SECOND {
        if L::CURVED {
            sum_of_terms::<T, true, true>(slopes, curvatures, kinematics)
        } else {
            sum_of_terms::<T, true, false>(slopes, curvatures, kinematics)
        }
    } else if L::CURVED {
        sum_of_terms::<T, false, true>(slopes, curvatures, kinematics)
    } else {
        sum_of_terms::<T, false, false>(slopes, curvatures, kinematics)
    }
}

/// ∂P/∂F of a law that depends on I₂, or not, and has curvatures besides ∂²W/∂J², or not.
// Without optimisation a function of its own: each of seven methods of each law would hold two copies of it.
#[cfg_attr(not(debug_assertions), inline(always))]
#[cfg_attr(debug_assertions, inline(never))]
#[must_use]
pub fn sum_of_terms<T: Real, const SECOND: bool, const CURVED: bool>(
    slopes: &Slopes<T>,
    curvatures: &Curvatures<T>,
    kinematics: &InvariantKinematics<T>,
) -> FirstPiolaTangent<T> {
    let (one, two, four) = (T::one(), T::lit(2.0), T::lit(4.0));
    let invariants = &kinematics.invariants;
    let (f, k) = (flat(kinematics.gradient), flat(kinematics.cofactor));
    let volume = slopes.volume * invariants.jacobian.recip();
    let w = two * slopes.second;
    let alternating = if SECOND { combined(volume, &f, w, &k) } else { multiple(volume, &f) };

    // F ⊗ u + Cof F ⊗ v + g ⊗ z.
    let mut u = f;
    let mut v = multiple(curvatures.volume_volume, &k);
    let (mut g, mut z) = (f, f);
    // I₁ 1 − C is this times 1 less the change.
    let trace = two * kinematics.shift + kinematics.trace();
    if CURVED {
        let mixed = two * curvatures.first_volume;
        v = combined(curvatures.volume_volume, &k, mixed, &f);
        u = combined(if SECOND { w } else { T::zero() } + four * curvatures.first_first, &f, mixed, &k);
        if SECOND {
            // ∂I₂ = 2 F (I₁ 1 − C).
            let inner = (Symmetric::identity() * trace - kinematics.change) * two;
            g = flat(product(kinematics.gradient, inner.rows()));
            u = combined(one, &u, two * curvatures.first_second, &g);
            v = combined(one, &v, curvatures.second_volume, &g);
            z = combined(curvatures.second_second, &g, two * curvatures.first_second, &f);
            z = combined(one, &z, curvatures.second_volume, &k);
        }
    } else if SECOND {
        u = multiple(w, &f);
    }

    // w (I₁ δᵢⱼ δ_AB − δᵢⱼ C_AB − Bᵢⱼ δ_AB).
    let right = kinematics.change * w;
    let left = Symmetric::upper_triangle(product_transposed(kinematics.gradient, kinematics.gradient)) * w;
    let (right, left) = (right.rows(), left.rows());
    let diagonal = two * slopes.first + if SECOND { w * trace } else { T::zero() };

    // Written out: in a loop the compiler would decide at run time which terms an entry has.
    let mut entries = [[T::zero(); 9]; 9];
    macro_rules! row {
        ($r:literal: $($s:literal)+) => { $(
            let (i, p, j, q) = ($r / 3, $r % 3, $s / 3, $s % 3);
            let mut entry = k[$r] * v[$s];
            if SECOND || CURVED {
                entry += f[$r] * u[$s];
            }
            if SECOND && CURVED {
                entry += g[$r] * z[$s];
            }
            if i == j && p == q {
                entry += diagonal;
            }
            if SECOND && i == j {
                entry -= right[p][q];
            }
            if SECOND && p == q {
                entry -= left[i][j];
            }
            if i != j && p != q {
                let term = alternating[12 - 3 * (i + j) - (p + q)];
                // ε is 1 where the second index follows the first in turn.
                if ((j + 3 - i) % 3 == 1) == ((q + 3 - p) % 3 == 1) {
                    entry += term;
                } else {
                    entry -= term;
                }
            }
            entries[$r][$s] = entry;
            entries[$s][$r] = entry;
        )+ };
    }
    rows_of_upper_triangle!(row);
    FirstPiolaTangent(FourthOrder { components: entries })
}
