//! Compatibility of a field of metrics by its curvature.

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant};
use piola_numerics::{Gradient, Mask, Real};
use piola_tensor::Symmetric;
use piola_tensor::TensorError;
use piola_tensor::internal::rows::{Rows, double_contraction, product};

use crate::FieldsError;
use crate::error::check_finite;
use crate::field::{Field, check_point};
use crate::frames::Material;
use crate::motion::kernels::twice_variables;
use crate::residual::Residual;

/// A symmetric residual with the sums of the moduli of its terms, component by component.
///
/// # Example
/// ```
/// use piola_continuum::Symmetric;
/// use piola_fields::compatibility::SymmetricResidual;
/// let scale = Symmetric::diagonal([4.0, 0.0, 0.0]);
/// let residual = SymmetricResidual { value: Symmetric::diagonal([1.0, 0.0, 0.0]), scale };
/// assert_eq!(residual.relative(), 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: piola_numerics::Real + serde::Serialize",
        deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"
    ))
)]
pub struct SymmetricResidual<T = f64> {
    /// The sums of the terms.
    pub value: Symmetric<T>,
    /// The sums of their moduli.
    pub scale: Symmetric<T>,
}

impl<T: Real> SymmetricResidual<T> {
    /// The largest component divided by the largest scale, ∈ [0, 1]; zero when all terms are.
    #[must_use]
    pub fn relative(&self) -> T {
        let largest = |s: &Symmetric<T>| s.components.iter().fold(T::zero(), |largest, x| largest.max(x.abs()));
        Residual { value: largest(&self.value), scale: largest(&self.scale) }.relative()
    }

    /// From its entries, if they are finite.
    pub(super) fn of(quantity: &'static str, entry: impl Fn(usize, usize) -> Residual<T>) -> Result<Self, FieldsError> {
        let entries = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)];
        check_finite(quantity, &entries.map(|entry| entry.value))?;
        let (value, scale) = (entries.map(|entry| entry.value), entries.map(|entry| entry.scale));
        Ok(Self { value: Symmetric { components: value }, scale: Symmetric { components: scale } })
    }
}

/// The Riemann curvature of a field of metrics C(X): zero where C = `FᵀF` of a deformation, W(24.20).
///
/// ```text
/// R_ABCD = ½(∂_B∂_C C_AD + ∂_A∂_D C_BC − ∂_A∂_C C_BD − ∂_B∂_D C_AC) + C⁻¹_PQ (Γ_P,BC Γ_Q,AD − Γ_P,BD Γ_Q,AC)
/// Γ_P,AB = ½(∂_A C_PB + ∂_B C_PA − ∂_P C_AB)
/// Ric_AB = C⁻¹_CD R_CADB        R = tr(C⁻¹ Ric)        G_AB = Ric_AB − ½ R C_AB
/// ```
///
/// Signs: R₁₂₁₂ and Ric are positive on spheres. In three dimensions the six independent components are those of
/// `N^KL = −¼ e_KAB e_LCD R_ABCD` (e the permutation symbol), which is det C times Einstein's tensor with upper
/// indices and tends to inc ε for C = 1 + 2ε.
///
/// # Example
/// The metric (1 + ¼|X|²)⁻² 1 is that of the unit sphere in four dimensions: its scalar curvature is 6.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::{Field, Material, compatibility::Curvature};
/// use piola_numerics::Real;
/// struct Sphere;
/// impl Field for Sphere {
///     type Value = Symmetric;
///     fn at<T: Real>(&self, particle: &Vector3<T>, _time: T) -> Symmetric<T> {
///         let [x, y, z] = (*particle).into();
///         let factor = (T::lit(1.0) + T::lit(0.25) * (x * x + y * y + z * z)).powi(-2);
///         Symmetric::diagonal([factor; 3])
///     }
/// }
/// let curvature = Curvature::of_metric(&Material(Sphere), &Vector3::zeros(), 0.0)?;
/// assert_eq!(curvature.scalar(), 6.0);
/// assert_eq!(curvature.riemann(0, 1, 0, 1), 1.0);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: piola_numerics::Real + serde::Serialize",
        deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"
    ))
)]
pub struct Curvature<T = f64> {
    /// `N^KL = −¼ e_KAB e_LCD R_ABCD`, 1/m², with its scale: the incompatibility of the metric.
    pub residual: SymmetricResidual<T>,
    /// C.
    pub metric: Symmetric<T>,
}

impl<T: Real> Curvature<T> {
    /// Of a metric C(X, t) at a particle.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | C(X, t) | `metric` | 3×3 symmetric, positive definite | – |
    /// | X, t | `reference`, `t` | 3, scalar | m, s |
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; [`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite) where C is not positive definite.
    pub fn of_metric(
        metric: &Material<impl Field<Value = Symmetric>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<Self, FieldsError> {
        check_point(reference, t)?;
        let field = with_second_partials(metric, reference, t);
        let c: Rows<T> = field.map(|row| row.map(|entry| entry.value.value));
        check_metric(&c)?;
        let inverse = inverse_and_determinant(c).0;
        let half = T::lit(0.5);
        let slope = |a: usize, b: usize, along: usize| field[a][b].value.partials[along];
        // Γ_P,AB as [P][A][B].
        let gamma: [Rows<T>; 3] = [0, 1, 2].map(|p: usize| {
            let entry = |a: usize, b: usize| half * (slope(p, b, a) + slope(p, a, b) - slope(a, b, p));
            [0, 1, 2].map(|a: usize| [0, 1, 2].map(|b: usize| entry(a, b)))
        });
        let second = |a: usize, b: usize, c: usize, d: usize| field[c][d].partials[a].partials[b];
        let residual = SymmetricResidual::of("curvature", |k, l| {
            let ((a, b), (c, d)) = (PAIRS[k], PAIRS[l]);
            let mut sum = second_differences(PAIRS[k], PAIRS[l], -half, second);
            for p in 0..3 {
                for q in 0..3 {
                    sum = sum.plus(-(inverse[p][q] * gamma[p][b][c] * gamma[q][a][d]));
                    sum = sum.plus(inverse[p][q] * gamma[p][b][d] * gamma[q][a][c]);
                }
            }
            sum
        })?;
        Ok(Self { residual, metric: Symmetric::upper_triangle(c) })
    }

    /// `R_ABCD`, 1/m², indices from 0; an index of 3 or more gives zero.
    #[must_use]
    pub fn riemann(&self, a: usize, b: usize, c: usize, d: usize) -> T {
        let n = self.residual.value.rows();
        let mut sum = T::zero();
        for (k, &first) in PAIRS.iter().enumerate() {
            for (l, &second) in PAIRS.iter().enumerate() {
                // R_ABCD = −e_KAB e_LCD N^KL
                sum -= n[k][l] * T::lit(sign(first, (a, b)) * sign(second, (c, d)));
            }
        }
        sum
    }

    /// Einstein's tensor `G_AB = Ric_AB − ½ R C_AB`, 1/m².
    #[must_use]
    pub fn einstein(&self) -> Symmetric<T> {
        let c = self.metric.rows();
        let lowered = product(product(c, self.residual.value.rows()), c);
        let reciprocal = determinant(c).recip();
        Symmetric::symmetric_part(lowered.map(|row| row.map(|entry| entry * reciprocal)))
    }

    /// The scalar curvature `R = C⁻¹_AB Ric_AB`, 1/m².
    #[must_use]
    pub fn scalar(&self) -> T {
        // tr G = R − 3/2 R, and tr G = N : C/det C.
        let c = self.metric.rows();
        T::lit(-2.0) * double_contraction(self.residual.value.rows(), c) / determinant(c)
    }

    /// Ricci's tensor `Ric_AB`, 1/m²: zero where C is compatible, and only there.
    #[must_use]
    pub fn ricci(&self) -> Symmetric<T> {
        let (einstein, half) = (self.einstein().components, T::lit(0.5) * self.scalar());
        let metric = self.metric.components;
        Symmetric { components: core::array::from_fn(|i| einstein[i] + half * metric[i]) }
    }
}

/// The pairs of indices that belong to the index of an axial vector: 23, 31, 12.
pub(super) const PAIRS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// +1 for the same pair, −1 for the pair exchanged, 0 for another.
fn sign(pair: (usize, usize), other: (usize, usize)) -> f64 {
    if pair == other {
        1.0
    } else if pair == (other.1, other.0) {
        -1.0
    } else {
        0.0
    }
}

/// `factor (∂_B∂_C g_AD + ∂_A∂_D g_BC − ∂_A∂_C g_BD − ∂_B∂_D g_AC)`, `second(a, b, c, d) = ∂_a∂_b g_cd`.
pub(super) fn second_differences<T: Real>(
    (a, b): (usize, usize),
    (c, d): (usize, usize),
    factor: T,
    second: impl Fn(usize, usize, usize, usize) -> T,
) -> Residual<T> {
    let sum = Residual::zero().plus(factor * second(b, c, a, d)).plus(factor * second(a, d, b, c));
    sum.plus(-(factor * second(a, c, b, d))).plus(-(factor * second(b, d, a, c)))
}

/// A symmetric field with its first and second derivatives, by rows.
pub(super) fn with_second_partials<T: Real>(
    field: &Material<impl Field<Value = Symmetric>>,
    reference: &Vector3<T>,
    t: T,
) -> Rows<Gradient<Gradient<T, 3>, 3>> {
    field.0.at(&twice_variables(reference), Gradient::constant(Gradient::constant(t))).rows()
}

/// The leading minors of a metric are positive in every lane.
fn check_metric<T: Real>(c: &Rows<T>) -> Result<(), FieldsError> {
    check_finite("C", c.as_flattened())?;
    let minors = [c[0][0], c[0][0] * c[1][1] - c[0][1] * c[1][0], determinant(*c)];
    for (index, minor) in minors.into_iter().enumerate() {
        if !T::zero().less_than(minor).all() {
            let lane = (0..T::LANES).find(|&lane| minor.primal(lane) <= 0.0).unwrap_or(0);
            return Err(TensorError::NotPositiveDefinite {
                quantity: "C",
                order: index + 1,
                minor: minor.primal(lane),
                scale: 1.0,
            }
            .into());
        }
    }
    Ok(())
}
