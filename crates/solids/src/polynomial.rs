//! The general polynomial of the invariants.

use piola_continuum::Deformation;
use piola_continuum::strain::invariants;
use piola_numerics::Real;

use super::integer_powers::{power, power_curvature, power_slope};
use super::invariant::{
    Curvatures, InvariantEnergy, Invariants, Slopes, first_excess_beside, hyperelastic_of_invariants,
    second_excess_beside, volume_excess,
};
use crate::SolidsError;
use crate::error::{check_bound, check_finite};

const LAW: &str = "polynomial";

/// C (I₁ − 3)^r (I₂ − 3)^s (I₃ − 1)^t.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PolynomialTerm {
    /// r.
    pub first: u8,
    /// s.
    pub second: u8,
    /// t.
    pub third: u8,
    /// `C_rst`, Pa.
    pub coefficient: f64,
}

/// The isotropic solid as a polynomial of the invariants, as many terms as are given.
///
/// ```text
/// W = Σ C_rst (I₁ − 3)^r (I₂ − 3)^s (I₃ − 1)^t,   C_000 = 0
/// ```
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | r, s, t | `first`, `second`, `third` of a term | 1 | 0 < r + s + t |
/// | `C_rst` | `coefficient` of a term | Pa | finite |
///
/// The reference is free of stress if C₁₀₀ + 2 C₀₁₀ + C₀₀₁ = 0, which [`stress_free`](Self::stress_free) asks for; the
/// shear modulus is 2 (C₁₀₀ + C₀₁₀) then, which is positive, and the bulk modulus is not negative. Whether the law is stable
/// elsewhere is for the checks in `piola_specimens`.
///
/// # Accuracy
/// P, S, τ relative 1e-13 down to ∇u = 1e-16 where the reference is free of stress; tangents a few ulp of their
/// norm, or of the largest term.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, Polynomial, PolynomialTerm};
/// use piola_continuum::DeformationGradient;
/// let term = |first, second, third, coefficient| PolynomialTerm { first, second, third, coefficient };
/// let solid = Polynomial::stress_free(vec![term(1, 0, 0, 0.5), term(0, 0, 1, -0.5), term(0, 0, 2, 1.0)])?;
/// assert_eq!(solid.cauchy(&DeformationGradient::simple_shear(0.5)?).0.components[3], 0.5); // 2 C₁₀₀ k
/// let terms = Polynomial::saint_venant_kirchhoff(1.0, 2.0)?;
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// assert_eq!(terms.second_piola(&bar).0.components[0], 7.5); // (λ + 2 μ) E₁₁
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.63), B(4.67).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<PolynomialTerm>", into = "Vec<PolynomialTerm>"))]
pub struct Polynomial {
    /// The terms of degree 2 and more.
    curved: Vec<PolynomialTerm>,
    /// C₁₀₀, C₀₁₀, C₀₀₁, Pa.
    linear: [f64; 3],
    /// 2 (C₁₀₀ + 2 C₀₁₀ + C₀₀₁), Pa.
    residual: f64,
}

impl Polynomial {
    /// From its terms; the reference carries the stress 2 (C₁₀₀ + 2 C₀₁₀ + C₀₀₁) 1.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] where there are no terms or one is constant, or where a
    /// reference without stress has a modulus of shear 2 (C₁₀₀ + C₀₁₀) that is not positive, or a negative one of volume.
    pub fn new(terms: Vec<PolynomialTerm>) -> Result<Self, SolidsError> {
        check_bound(LAW, "terms", terms.len() as f64, "0 < number of terms", !terms.is_empty())?;
        for term in &terms {
            check_finite(LAW, "coefficient", term.coefficient)?;
            let degree = f64::from(term.first) + f64::from(term.second) + f64::from(term.third);
            check_bound(LAW, "degree", degree, "0 < r + s + t", 0.0 < degree)?;
        }
        let law = Self::unchecked(terms);
        if law.is_stress_free() {
            law.check_reference()?;
        }
        Ok(law)
    }

    /// From any terms, as they are: also such as no stable solid has, for parts of a sum or for a search. A constant is left out.
    #[must_use]
    pub fn unchecked(terms: Vec<PolynomialTerm>) -> Self {
        let mut linear = [0.0; 3];
        for term in &terms {
            match (term.first, term.second, term.third) {
                (1, 0, 0) => linear[0] += term.coefficient,
                (0, 1, 0) => linear[1] += term.coefficient,
                (0, 0, 1) => linear[2] += term.coefficient,
                _ => {}
            }
        }
        let mut curved = terms;
        curved.retain(|term| 1 < u32::from(term.first) + u32::from(term.second) + u32::from(term.third));
        Self { curved, linear, residual: 2.0 * (linear[0] + 2.0 * linear[1] + linear[2]) }
    }

    /// From terms with C₁₀₀ + 2 C₀₁₀ + C₀₀₁ = 0, up to 4 ulp of the largest of them.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`SolidsError::OutOfBounds`] where the reference has stress.
    pub fn stress_free(terms: Vec<PolynomialTerm>) -> Result<Self, SolidsError> {
        let law = Self::new(terms)?;
        check_bound(LAW, "C100 + 2 C010 + C001", 0.5 * law.residual, "C100 + 2 C010 + C001 = 0", law.is_stress_free())?;
        Ok(Self { residual: 0.0, ..law })
    }

    /// True if the reference is free of stress, within rounding of the terms of degree 1.
    fn is_stress_free(&self) -> bool {
        let largest = self.linear.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        self.residual.abs() <= 16.0 * f64::EPSILON * largest
    }

    /// Refuses a reference without stress that is not stable.
    fn check_reference(&self) -> Result<(), SolidsError> {
        let shear = self.linear[0] + self.linear[1];
        check_bound(LAW, "C100 + C010", shear, "0 < C100 + C010 (half the shear modulus)", 0.0 < shear)?;
        let bulk = self.bulk_modulus();
        // Of terms that cancel something is left.
        let size = self.linear.iter().chain(self.curved.iter().map(|term| &term.coefficient));
        let rounding = 64.0 * f64::EPSILON * size.fold(0.0_f64, |largest, x| largest.max(x.abs()));
        check_bound(LAW, "∂²W/∂J²", bulk, "0 ≤ ∂²W/∂J² of a dilatation", -rounding <= bulk)
    }

    /// ∂²W/∂J² of a dilatation of the reference, Pa: I₁ − 3 = 2 c − ⅓ c², I₂ − 3 = 4 c + ⅔ c², I₃ − 1 = 2 c + c² with c = J − 1, to
    /// the second order.
    fn bulk_modulus(&self) -> f64 {
        let [a, b, c] = self.linear;
        let linear = -2.0 / 3.0 * a + 4.0 / 3.0 * b + 2.0 * c;
        let quadratic = self
            .curved
            .iter()
            .filter(|term| u32::from(term.first) + u32::from(term.second) + u32::from(term.third) == 2);
        // Each factor grows with 2 c, that of I₂ with 4 c.
        linear + quadratic.map(|term| 8.0 * term.coefficient * f64::from(1_u32 << term.second)).sum::<f64>()
    }

    /// The solid of St. Venant and Kirchhoff: C₁₀₀ = μ, C₂₀₀ = (λ + 2 μ)/8, C₀₁₀ = −μ/2.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    ///
    /// # Source
    /// B(4.67).
    pub fn saint_venant_kirchhoff(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, mu) = (first_lame_parameter, shear_modulus);
        let term = |first, second, coefficient| PolynomialTerm { first, second, third: 0, coefficient };
        Self::stress_free(vec![term(1, 0, mu), term(2, 0, 0.125 * (lambda + 2.0 * mu)), term(0, 1, -0.5 * mu)])
    }

    /// The terms, those of degree 1 first.
    #[must_use]
    pub fn terms(&self) -> Vec<PolynomialTerm> {
        let [first, second, third] = self.linear;
        let linear = [(1, 0, 0, first), (0, 1, 0, second), (0, 0, 1, third)];
        linear
            .into_iter()
            .filter(|term| 0.0 < term.3.abs())
            .map(|(first, second, third, coefficient)| PolynomialTerm { first, second, third, coefficient })
            .chain(self.curved.iter().copied())
            .collect()
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<PolynomialTerm>> for Polynomial {
    type Error = SolidsError;

    /// Free of stress in the reference where the coefficients say so.
    fn try_from(terms: Vec<PolynomialTerm>) -> Result<Self, SolidsError> {
        let law = Self::new(terms)?;
        Ok(if law.is_stress_free() { Self { residual: 0.0, ..law } } else { law })
    }
}

#[cfg(feature = "serde")]
impl From<Polynomial> for Vec<PolynomialTerm> {
    fn from(law: Polynomial) -> Self {
        law.terms()
    }
}

impl InvariantEnergy for Polynomial {
    const SECOND: bool = true;
    const CURVED: bool = true;

    /// Linear terms by I₁ − 3 − 2 ln J, I₂ − 3 − 4 ln J and I₃ − 1 − 2 ln J, the rest as it stands.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let (two, change, excess) = (T::lit(2.0), deformation.volume_change(), volume_excess(deformation));
        let z = change * (change + two);
        let (x, y) = (invariants::first_minus_three(deformation), invariants::second_minus_three(deformation));
        let mut sum = T::lit(self.linear[0]) * first_excess_beside(deformation, excess)
            + T::lit(self.linear[1]) * second_excess_beside(deformation, excess)
            + T::lit(self.linear[2]) * (change * change + two * excess);
        if self.residual != 0.0 {
            sum += T::lit(self.residual) * deformation.ln_jacobian();
        }
        for term in &self.curved {
            sum += T::lit(term.coefficient) * power(x, term.first) * power(y, term.second) * power(z, term.third);
        }
        sum
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let (two, four) = (T::lit(2.0), T::lit(4.0));
        let (x, y) = (invariants.first, invariants.second);
        let z = invariants.change * (invariants.change + two);
        // The slopes of what is curved: zero at the reference.
        let [mut first, mut second, mut third] = [T::zero(); 3];
        for &PolynomialTerm { first: r, second: s, third: t, coefficient } in &self.curved {
            let c = T::lit(coefficient);
            let (xr, ys, zt) = (power(x, r), power(y, s), power(z, t));
            first += c * power_slope(x, r) * ys * zt;
            second += c * xr * power_slope(y, s) * zt;
            third += c * xr * ys * power_slope(z, t);
        }
        let whole = third + T::lit(self.linear[2]);
        Slopes {
            first: T::lit(self.linear[0]) + first,
            second: T::lit(self.linear[1]) + second,
            // J ∂W/∂J = 2 J² ∂W/∂I₃ = 2 ∂W/∂I₃ + 2 (I₃ − 1) ∂W/∂I₃.
            residual: two * first + four * second + two * third + two * z * whole + T::lit(self.residual),
            volume: two * (invariants.jacobian * invariants.jacobian) * whole,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        let two = T::lit(2.0);
        let (x, y) = (invariants.first, invariants.second);
        let z = invariants.change * (invariants.change + two);
        let mut slope = T::lit(self.linear[2]);
        let [mut xx, mut xy, mut yy, mut xz, mut yz, mut zz] = [T::zero(); 6];
        for &PolynomialTerm { first: r, second: s, third: t, coefficient } in &self.curved {
            let c = T::lit(coefficient);
            let (p, q, u) = (power(x, r), power(y, s), power(z, t));
            let (dp, dq, du) = (power_slope(x, r), power_slope(y, s), power_slope(z, t));
            slope += c * p * q * du;
            xx += c * power_curvature(x, r) * q * u;
            xy += c * dp * dq * u;
            yy += c * p * power_curvature(y, s) * u;
            xz += c * dp * q * du;
            yz += c * p * dq * du;
            zz += c * p * q * power_curvature(z, t);
        }
        let rate = two * invariants.jacobian;
        Curvatures {
            first_first: xx,
            first_second: xy,
            second_second: yy,
            first_volume: xz * rate,
            second_volume: yz * rate,
            volume_volume: zz * (rate * rate) + two * slope,
        }
    }
}

hyperelastic_of_invariants!(Polynomial);
