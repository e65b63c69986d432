//! Isotropic laws W(I₁, I₂, J): the stress and both tangents once, for all of them.
//!
//! ```text
//! P = s F⁻ᵀ + (2 w₁ + 4 w₂)(F − F⁻ᵀ) + 2 w₂ F ((I₁ − 3) 1 − (C − 1))
//! s = 2 w₁ + 4 w₂ + J w_J        wₐ = ∂W/∂Iₐ,  w_J = ∂W/∂J
//! ```
//! It is `2 w₁ F + 2 w₂ F (I₁ 1 − C) + J w_J F⁻ᵀ`, ordered so that each term is as small as the strain: at the reference
//! every one vanishes, if the law's *residual* s does. A law gives s without cancellation, from I₁ − 3, I₂ − 3 and J − 1.

use piola_continuum::strain::{invariants, kernels};
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::tensor::FourthOrder;
use piola_continuum::tensor::rows::{
    Rows, cofactor, difference, double_contraction, product, product_transposed, scaled, sum, transpose,
};
use piola_continuum::{Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::linear::matrix3::{determinant, from_rows};
use piola_numerics::{Mask, Real};

use crate::ConstitutiveError;
use crate::elementary::excess_over_given;

/// I₁ − 3, I₂ − 3, J − 1 and J of a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<T> {
    /// I₁ − 3 of C.
    pub first: T,
    /// I₂ − 3 of C; zero where the law does not use it.
    pub second: T,
    /// J − 1.
    pub change: T,
    /// J.
    pub jacobian: T,
}

/// First derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<T> {
    /// ∂W/∂I₁, Pa.
    pub first: T,
    /// ∂W/∂I₂, Pa.
    pub second: T,
    /// s = 2 ∂W/∂I₁ + 4 ∂W/∂I₂ + J ∂W/∂J, Pa, without cancellation: what a stress-free law has none of at the reference.
    pub residual: T,
}

/// Second derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures<T> {
    /// ∂²W/∂I₁².
    pub first_first: T,
    /// ∂²W/∂I₁∂I₂.
    pub first_second: T,
    /// ∂²W/∂I₂².
    pub second_second: T,
    /// ∂²W/∂I₁∂J.
    pub first_volume: T,
    /// ∂²W/∂I₂∂J.
    pub second_volume: T,
    /// ∂²W/∂J².
    pub volume_volume: T,
}

impl<T: Real> Curvatures<T> {
    /// Those of a law whose only curvature is that of the volume.
    #[inline(always)]
    #[must_use]
    pub fn of_volume(volume_volume: T) -> Self {
        let o = T::zero();
        Self { first_first: o, first_second: o, second_second: o, first_volume: o, second_volume: o, volume_volume }
    }
}

/// An isotropic energy W(I₁, I₂, J) with its derivatives in closed form.
pub trait InvariantEnergy {
    /// Whether W depends on I₂; what that needs is compiled out otherwise.
    const SECOND: bool;
    /// Whether another second derivative than ∂²W/∂J² is not zero.
    const CURVED: bool;
    /// See [`Hyperelastic::REFUSED_IS_NOT_FINITE`](super::Hyperelastic::REFUSED_IS_NOT_FINITE).
    const REFUSED_IS_NOT_FINITE: bool = false;

    /// W less W of the reference, J/m³, without cancellation: see [`first_excess`] and [`second_excess`].
    #[must_use]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;

    /// W of the reference as the formula is printed, J/m³.
    #[must_use]
    fn reference_energy(&self) -> f64 {
        0.0
    }

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`ConstitutiveError::BeyondLimit`]; most laws have no limit.
    #[inline(always)]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        Ok(())
    }

    /// Whether the body keeps its volume.
    #[must_use]
    fn is_incompressible(&self) -> bool {
        false
    }

    /// Its first derivatives.
    #[must_use]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T>;

    /// Its second derivatives.
    #[must_use]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T>;

    /// Both, with what they share computed once.
    #[inline(always)]
    #[must_use]
    fn slopes_and_curvatures<T: Real>(&self, invariants: &Invariants<T>) -> (Slopes<T>, Curvatures<T>) {
        (self.slopes(invariants), self.curvatures(invariants))
    }
}

/// Strains with components up to this size take the forms in which everything is as small as the strain.
const SMALL: f64 = 0.25;

/// The invariants that a law uses.
#[inline(always)]
#[must_use]
pub fn invariants_of<T: Real, L: InvariantEnergy>(_law: &L, deformation: &impl Deformation<T>) -> Invariants<T> {
    Invariants {
        first: invariants::first_minus_three(deformation),
        second: if L::SECOND { invariants::second_minus_three(deformation) } else { T::zero() },
        change: deformation.volume_change(),
        jacobian: deformation.jacobian(),
    }
}

/// I₁ − 3 − 2 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₁ − 3 − 2 (J − 1) = H : H − 2 i₂(H) − 2 det H,   H = ∇u
/// ```
#[inline(always)]
#[must_use]
pub fn first_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let two = T::lit(2.0);
    double_contraction(h, h) - two * beyond_trace(h)
        + two * excess_over_given(deformation.volume_change(), deformation.ln_jacobian())
}

/// I₂ − 3 − 4 ln J, never negative and of second order in the strain, without cancellation.
///
/// ```text
/// I₂ − 3 − 4 (J − 1) = 2 H : H + i₂(G) − 4 i₂(H) − 4 det H,   G = C − 1,  H = ∇u
/// ```
#[inline(always)]
#[must_use]
pub fn second_excess<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let [a, b, c, d, e, f] = kernels::right_cauchy_green_minus_one(h).components;
    let second = (a * b - d * d) + (b * c - e * e) + (a * c - f * f);
    two * double_contraction(h, h) + second - four * beyond_trace(h)
        + four * excess_over_given(deformation.volume_change(), deformation.ln_jacobian())
}

/// i₂(H) + det H = det(1 + H) − 1 − tr H.
#[inline(always)]
fn beyond_trace<T: Real>(h: Rows<T>) -> T {
    let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
    (minor(0, 1) + minor(1, 2) + minor(0, 2)) + determinant(h)
}

/// |∇u|² up to which everything is computed from ∇u: stretches differ from 1 by less than 0.87 then.
const NEAR: f64 = 0.75;

/// What stress and tangent share.
struct Kinematics<T: Real> {
    /// F.
    gradient: Rows<T>,
    /// C − 1.
    change: Symmetric<T>,
    cofactor: Rows<T>,
    invariants: Invariants<T>,
    /// F − Cof F where ∇u is small, computed from ∇u; F − F⁻ᵀ elsewhere.
    beyond: Rows<T>,
    near: T::Mask,
}

impl<T: Real> Kinematics<T> {
    /// Errors are relative to the strain or to |∇u|², as a stress needs it: those of the invariants themselves, as an
    /// energy needs it, are those of [`invariants_of`].
    #[inline(always)]
    fn of<L: InvariantEnergy>(deformation: &impl Deformation<T>) -> Self {
        let (one, two) = (T::one(), T::lit(2.0));
        let gradient = deformation.gradient_rows();
        let h = deformation.displacement_rows();
        let change = kernels::right_cauchy_green_minus_one(h);
        let [a, b, c, ..] = change.components;
        let first = a + b + c;
        let trace = h[0][0] + h[1][1] + h[2][2];
        // |∇u|² = I₁ − 3 − 2 tr ∇u; NaN is not near.
        let near = (first - two * trace).at_most(T::lit(NEAR));

        // Cof F = (1 + tr H) 1 − Hᵀ + Cof H, J = 1 + tr H + i₂(H) + det H, F − Cof F = H + Hᵀ − (tr H) 1 − Cof H.
        let m = cofactor(h);
        let second_trace = m[0][0] + m[1][1] + m[2][2];
        let bend = second_trace + (h[0][0] * m[0][0] + h[0][1] * m[0][1] + h[0][2] * m[0][2]);
        let volume = trace + bend;
        let k = |i: usize| (trace - h[i][i]) + m[i][i];
        let minors = [
            [k(0), m[0][1] - h[1][0], m[0][2] - h[2][0]],
            [m[1][0] - h[0][1], k(1), m[1][2] - h[2][1]],
            [m[2][0] - h[0][2], m[2][1] - h[1][2], k(2)],
        ];
        let (x, y, z) = (h[0][1] + h[1][0], h[1][2] + h[2][1], h[0][2] + h[2][0]);
        let d = |i: usize| (h[i][i] + h[i][i]) - trace - m[i][i];
        let beyond =
            [[d(0), x - m[0][1], z - m[0][2]], [x - m[1][0], d(1), y - m[1][2]], [z - m[2][0], y - m[2][1], d(2)]];
        let second =
            if L::SECOND { two * (two * trace + second_trace) + double_contraction(minors, minors) } else { T::zero() };
        let closed = Self {
            gradient,
            change,
            cofactor: [
                [one + minors[0][0], minors[0][1], minors[0][2]],
                [minors[1][0], one + minors[1][1], minors[1][2]],
                [minors[2][0], minors[2][1], one + minors[2][2]],
            ],
            invariants: Invariants { first, second, change: volume, jacobian: one + volume },
            beyond,
            near,
        };
        if near.all() { closed } else { closed.with_far::<L>(deformation) }
    }

    /// With what is far from the reference, where it is.
    #[inline(always)]
    fn with_far<L: InvariantEnergy>(self, deformation: &impl Deformation<T>) -> Self {
        let jacobian = deformation.jacobian();
        let change = jacobian - T::one();
        let plain_cofactor = cofactor(self.gradient);
        let inverse_transpose = scaled(plain_cofactor, jacobian.recip());
        // I₂ = Cof F : Cof F.
        let second =
            if L::SECOND { double_contraction(plain_cofactor, plain_cofactor) - T::lit(3.0) } else { T::zero() };
        // F − F⁻ᵀ = F⁻ᵀ (C − 1) where that is small, as for large rotations.
        let small = largest_modulus(&self.change).at_most(T::lit(SMALL));
        let mut plain = difference(self.gradient, inverse_transpose);
        if small.any() {
            plain = select(small, product(inverse_transpose, self.change.rows()), plain);
        }
        let (near, closed) = (self.near, self.invariants);
        Self {
            cofactor: select(near, self.cofactor, plain_cofactor),
            invariants: Invariants {
                first: closed.first,
                second: T::select(near, closed.second, second),
                change: T::select(near, closed.change, change),
                jacobian: T::select(near, closed.jacobian, jacobian),
            },
            beyond: select(near, self.beyond, plain),
            ..self
        }
    }

    /// P = k (F − Cof F) + (s + k (J − 1))/J Cof F + 2 w₂ F ((I₁ − 3) 1 − (C − 1)),  k = 2 w₁ + 4 w₂.
    #[inline(always)]
    fn first_piola<L: InvariantEnergy>(&self, slopes: &Slopes<T>) -> Rows<T> {
        let (two, four) = (T::lit(2.0), T::lit(4.0));
        let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
        let mut pressure = slopes.residual + stiffness * self.invariants.change;
        if !self.near.all() {
            pressure = T::select(self.near, pressure, slopes.residual);
        }
        let stress =
            sum(scaled(self.beyond, stiffness), scaled(self.cofactor, pressure * self.invariants.jacobian.recip()));
        if !L::SECOND {
            return stress;
        }
        let [a, b, c, ..] = self.change.components;
        let inner = (Symmetric::identity() * (a + b + c) - self.change) * (two * slopes.second);
        sum(stress, product(self.gradient, inner.rows()))
    }
}

/// P, see the [module](self).
///
/// # Accuracy
/// A few ulp of its own norm × the condition number of F.
#[inline(always)]
#[must_use]
pub fn first_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let kinematics = Kinematics::of::<L>(deformation);
    let slopes = law.slopes(&kinematics.invariants);
    FirstPiola(from_rows(kinematics.first_piola::<L>(&slopes)))
}

#[inline(always)]
fn largest_modulus<T: Real>(a: &Symmetric<T>) -> T {
    let [a, b, c, d, e, f] = a.components;
    let (a, b, c, d, e, f) = (a.abs(), b.abs(), c.abs(), d.abs(), e.abs(), f.abs());
    let larger = |a: T, b: T| T::select(a.less_than(b), b, a);
    larger(larger(larger(a, b), larger(c, d)), larger(e, f))
}

#[inline(always)]
fn select<T: Real>(mask: T::Mask, a: Rows<T>, b: Rows<T>) -> Rows<T> {
    let entry = |i: usize, j: usize| T::select(mask, a[i][j], b[i][j]);
    let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
    [row(0), row(1), row(2)]
}

/// τ = s 1 + (2 w₁ + 4 w₂)(B − 1) + 2 w₂ B ((I₁ − 3) 1 − (B − 1)).
#[inline(always)]
#[must_use]
pub fn kirchhoff<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let change = kernels::left_cauchy_green_minus_one(deformation.displacement_rows());
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = Symmetric::identity() * slopes.residual + change * stiffness;
    if !L::SECOND {
        return KirchhoffStress(stress);
    }
    // B (i 1 − G) = (1 + G)(i 1 − G) = i 1 + (i − 1) G − G².
    let square = Symmetric::upper_triangle(product(change.rows(), change.rows()));
    let i = invariants.first;
    let inner = Symmetric::identity() * i + change * (i - T::one()) - square;
    KirchhoffStress(stress + inner * (two * slopes.second))
}

/// S = s C⁻¹ + (2 w₁ + 4 w₂)(1 − C⁻¹) + 2 w₂ ((I₁ − 3) 1 − (C − 1)).
#[inline(always)]
#[must_use]
pub fn second_piola<T: Real, L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> SecondPiola<T> {
    let invariants = invariants_of(law, deformation);
    let slopes = law.slopes(&invariants);
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    let inverse = scaled(transpose(deformation.cofactor_rows()), invariants.jacobian.recip());
    let inverse_square = Symmetric::upper_triangle(product(inverse, transpose(inverse)));
    let change = kernels::right_cauchy_green_minus_one(deformation.displacement_rows());
    // 1 − C⁻¹ = C⁻¹ (C − 1) where that is small.
    let small = largest_modulus(&change).at_most(T::lit(SMALL));
    let plain = Symmetric::identity() - inverse_square;
    let beyond = if small.any() {
        let exact = Symmetric::upper_triangle(product(inverse_square.rows(), change.rows()));
        let choose = |k: usize| T::select(small, exact.components[k], plain.components[k]);
        Symmetric { components: [choose(0), choose(1), choose(2), choose(3), choose(4), choose(5)] }
    } else {
        plain
    };
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let stress = inverse_square * slopes.residual + beyond * stiffness;
    if !L::SECOND {
        return SecondPiola(stress);
    }
    SecondPiola(stress + (Symmetric::identity() * invariants.first - change) * (two * slopes.second))
}

/// ∂P/∂F, 45 entries and their mirror images.
///
/// ```text
/// A = w₁ ∂²I₁ + w₂ ∂²I₂ + w_J ∂²J + Σ wₐᵦ ∂Iₐ ⊗ ∂Iᵦ
/// ∂I₁ = 2F        ∂I₂ = 2 (I₁ F − F C)        ∂J = Cof F        ∂²I₁ = 2 δᵢⱼ δ_AB        ∂²J = εᵢⱼₖ ε_ABC F_kC
/// ∂²I₂ = 2 (I₁ δᵢⱼ δ_AB + F_iA F_jB + εᵢⱼₖ ε_ABC Cof_kC − δᵢⱼ C_AB − Bᵢⱼ δ_AB)
/// ```
#[inline(always)]
#[must_use]
pub fn first_piola_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    let kinematics = Kinematics::of::<L>(deformation);
    let (slopes, curvatures) = law.slopes_and_curvatures(&kinematics.invariants);
    tangent::<T, L>(&slopes, &curvatures, &kinematics)
}

/// (P, ∂P/∂F), the invariants, slopes and Cof F computed once.
#[inline(always)]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    let kinematics = Kinematics::of::<L>(deformation);
    let (slopes, curvatures) = law.slopes_and_curvatures(&kinematics.invariants);
    let stress = FirstPiola(from_rows(kinematics.first_piola::<L>(&slopes)));
    (stress, tangent::<T, L>(&slopes, &curvatures, &kinematics))
}

/// (S, ∂S/∂E), from P and ∂P/∂F.
#[inline(always)]
#[must_use]
pub fn second_piola_and_tangent<T: Real, L: InvariantEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (SecondPiola<T>, MaterialTangent<T>) {
    let (nominal, tangent) = first_piola_and_tangent(law, deformation);
    let stress = nominal.second_piola(deformation);
    (stress, MaterialTangent(tangent.material(&stress, deformation).0.major_part()))
}

#[inline(always)]
fn flat<T: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> [T; 9] {
    [a, b, c, d, e, f, g, h, i]
}

/// α a.
#[inline(always)]
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
#[inline(always)]
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
#[inline(always)]
fn tangent<T: Real, L: InvariantEnergy>(
    slopes: &Slopes<T>,
    curvatures: &Curvatures<T>,
    kinematics: &Kinematics<T>,
) -> FirstPiolaTangent<T> {
    let (one, two, four) = (T::one(), T::lit(2.0), T::lit(4.0));
    let invariants = &kinematics.invariants;
    let (f, k) = (flat(kinematics.gradient), flat(kinematics.cofactor));
    let stiffness = if L::SECOND { two * slopes.first + four * slopes.second } else { two * slopes.first };
    let volume = (slopes.residual - stiffness) * invariants.jacobian.recip();
    let w = two * slopes.second;
    let alternating = if L::SECOND { combined(volume, &f, w, &k) } else { multiple(volume, &f) };

    // F ⊗ u + Cof F ⊗ v + g ⊗ z.
    let mut u = f;
    let mut v = multiple(curvatures.volume_volume, &k);
    let (mut g, mut z) = (f, f);
    let [a, b, c, ..] = kinematics.change.components;
    let trace = a + b + c;
    if L::CURVED {
        let mixed = two * curvatures.first_volume;
        v = combined(curvatures.volume_volume, &k, mixed, &f);
        u = combined(if L::SECOND { w } else { T::zero() } + four * curvatures.first_first, &f, mixed, &k);
        if L::SECOND {
            // ∂I₂ = 2 F ((2 + I₁ − 3) 1 − (C − 1)).
            let inner = (Symmetric::identity() * (two + trace) - kinematics.change) * two;
            g = flat(product(kinematics.gradient, inner.rows()));
            u = combined(one, &u, two * curvatures.first_second, &g);
            v = combined(one, &v, curvatures.second_volume, &g);
            z = combined(curvatures.second_second, &g, two * curvatures.first_second, &f);
            z = combined(one, &z, curvatures.second_volume, &k);
        }
    } else if L::SECOND {
        u = multiple(w, &f);
    }

    // w (I₁ δᵢⱼ δ_AB − δᵢⱼ C_AB − Bᵢⱼ δ_AB).
    let right = kinematics.change * w;
    let left = Symmetric::upper_triangle(product_transposed(kinematics.gradient, kinematics.gradient)) * w;
    let (right, left) = (right.rows(), left.rows());
    let diagonal = two * slopes.first + if L::SECOND { w * (two + trace) } else { T::zero() };

    // Written out: in a loop the compiler would decide at run time which terms an entry has.
    let mut entries = [[T::zero(); 9]; 9];
    macro_rules! row {
        ($r:literal: $($s:literal)+) => { $(
            let (i, p, j, q) = ($r / 3, $r % 3, $s / 3, $s % 3);
            let mut entry = k[$r] * v[$s];
            if L::SECOND || L::CURVED {
                entry += f[$r] * u[$s];
            }
            if L::SECOND && L::CURVED {
                entry += g[$r] * z[$s];
            }
            if i == j && p == q {
                entry += diagonal;
            }
            if L::SECOND && i == j {
                entry -= right[p][q];
            }
            if L::SECOND && p == q {
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
    row!(0: 0 1 2 3 4 5 6 7 8);
    row!(1: 1 2 3 4 5 6 7 8);
    row!(2: 2 3 4 5 6 7 8);
    row!(3: 3 4 5 6 7 8);
    row!(4: 4 5 6 7 8);
    row!(5: 5 6 7 8);
    row!(6: 6 7 8);
    row!(7: 7 8);
    row!(8: 8);
    FirstPiolaTangent(FourthOrder { components: entries })
}

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of invariants, the parameters of a generic one in brackets first.
macro_rules! hyperelastic_of_invariants {
    ([$($generics:tt)*] $law:ty) => {
        impl<$($generics)*> $crate::solids::Hyperelastic for $law {
            const REFUSED_IS_NOT_FINITE: bool =
                <$law as $crate::solids::invariant::InvariantEnergy>::REFUSED_IS_NOT_FINITE;

            #[inline(always)]
            fn energy<T: piola_numerics::Real>(&self, deformation: &impl piola_continuum::Deformation<T>) -> T {
                $crate::solids::invariant::InvariantEnergy::energy(self, deformation)
            }
            fn reference_energy(&self) -> f64 {
                $crate::solids::invariant::InvariantEnergy::reference_energy(self)
            }
            #[inline(always)]
            fn check<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> Result<(), $crate::ConstitutiveError> {
                $crate::solids::invariant::InvariantEnergy::check(self, deformation)
            }
            fn is_incompressible(&self) -> bool {
                $crate::solids::invariant::InvariantEnergy::is_incompressible(self)
            }
            #[inline(always)]
            fn first_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::FirstPiola<T> {
                $crate::solids::invariant::first_piola(self, deformation)
            }
            #[inline(always)]
            fn second_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::SecondPiola<T> {
                $crate::solids::invariant::second_piola(self, deformation)
            }
            #[inline(always)]
            fn kirchhoff<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::KirchhoffStress<T> {
                $crate::solids::invariant::kirchhoff(self, deformation)
            }
            #[inline(always)]
            fn first_piola_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::stress::tangents::FirstPiolaTangent<T> {
                $crate::solids::invariant::first_piola_tangent(self, deformation)
            }
            #[inline(always)]
            fn first_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                $crate::solids::invariant::first_piola_and_tangent(self, deformation)
            }
            #[inline(always)]
            fn second_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
                $crate::solids::invariant::second_piola_and_tangent(self, deformation)
            }
            #[inline(always)]
            fn cauchy_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
                let (stress, tangent) = $crate::solids::invariant::second_piola_and_tangent(self, deformation);
                (stress.cauchy(deformation), tangent.truesdell(deformation))
            }
        }
    };
    ($law:ty) => {
        $crate::solids::invariant::hyperelastic_of_invariants!([] $law);
    };
}
pub(super) use hyperelastic_of_invariants;
