//! Rates of the polar decomposition F = R U = V R, of ln U and ln V, and the spins that come with them.
//!
//! In the principal frame, axes qₖ of U and their images nₖ = R qₖ, with Âₖₗ = nₖ · Ḟ qₗ and S = diag(λₖ):
//!
//! ```text
//! Ḟ = R (RᵀṘ U + U̇) = (V̇ + V ṘRᵀ) R
//! S Ω + Ω S = Â − Âᵀ          Ωₖₗ = (Âₖₗ − Âₗₖ)/(λₖ + λₗ),   of RᵀṘ along q and of ṘRᵀ along n
//! Û̇ = sym Â − ½ (Ω S − S Ω)   of U̇ along q                  (ln U)˙ₖₗ = ln[λₖ, λₗ] Û̇ₖₗ
//! V̂̇ = sym Â + ½ (Ω S − S Ω)   of V̇ along n                  ln[a, b] = (ln a − ln b)/(a − b)
//! ```
//! Nothing is divided by a gap of the stretches, and F is not inverted. These solve U̇ U + U U̇ = Ċ and
//! V̇ V + V V̇ = Ḃ, and agree with L by
//!
//! ```text
//! L = ṘRᵀ + R U̇ U⁻¹ Rᵀ = V̇ V⁻¹ + V ṘRᵀ V⁻¹,     ṘRᵀ = W − R skew(U̇ U⁻¹) Rᵀ
//! ```
//! W(14.24–14.25); at F = 1 they are Ṙ = W and U̇ = V̇ = D, W(14.26–14.29).
//!
//! | spin | is the rate of turning of | equals |
//! |---|---|---|
//! | [`Spin`](super::Spin) W | the body, on the average | ½ curl v |
//! | [`PolarSpin`] | R, in space | Ṙ Rᵀ |
//! | [`MaterialSpin`] | R, in the reference configuration | Rᵀ Ṙ |
//! | [`LogarithmicSpin`] | axes in which the rate of ln V is D | ṘRᵀ + Σ (1/x − 1/sinh x) Dₖₗ, x = ln λₖ/λₗ |
//! | [`MaterialTwirl`], [`SpatialTwirl`] | the principal axes of U, of V | only for distinct stretches |

use core::fmt;

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{dot, from_rows};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::Skew;
use piola_tensor::internal::rows::{Rows, apply, product, product_transposed, transpose};
use piola_tensor::spectral::{IsotropicFunction, Logarithm, derivative, tensor_function};

use super::logarithmic_excess::LogarithmicExcess;
use super::principal_frame::{along, second_difference, spin_of};
use super::spins::{LogarithmicSpin, MaterialSpin, MaterialTwirl, PolarSpin, SpatialTwirl};
use super::{GradientRate, VelocityGradient};
use crate::polar::StretchAnalysis;
use crate::{ContinuumError, Deformation, Symmetric};

/// Rates of R, U, V, ln U and ln V. Each method computes one of them from a shared analysis.
///
/// # Accuracy
/// With κ = 1 + λ₁/(λ₂ + λ₃), within 8 ulp × κ: U̇ and V̇ of |Ḟ|, the spins of R of |Ḟ|/(λ₂ + λ₃); within
/// 8 ulp × (1 + λ₁/λ₃): (ln U)˙, (ln V)˙ and the logarithmic spin of |Ḟ|/λ₃. Whatever the gaps of the stretches,
/// however small the strain, and tested up to stretch ratios of 10⁶ beside twice the precision.
///
/// # Derivatives
/// Over scalars with derivatives all but the twirls have theirs, up to the fourth order, finite at coalescence.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::{GradientRate, StretchRates}};
/// // Twice as long along 1, growing there at 3 and turning about 3 at 1 rad/s: Ḟ = W F + diag(3, 0, 0).
/// let f = DeformationGradient::new(Matrix3::new(2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))?;
/// let rate = GradientRate::new(Matrix3::new(3.0, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
/// let rates = StretchRates::of(&f, &rate);
/// assert_eq!(rates.right_stretch().components, [3.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// assert_eq!(rates.hencky_material().components[0], 1.5);
/// assert_eq!(rates.polar_spin().axial.z, 1.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
/// # Source
/// W(14.24–14.26).
#[derive(Clone, Copy)]
pub struct StretchRates<T: Real = f64> {
    analysis: StretchAnalysis<T>,
    /// qₖ and nₖ by rows, and U along q.
    axes: Rows<T>,
    turned: Rows<T>,
    stretch: [T; 6],
    /// Âₖₗ = nₖ · Ḟ qₗ.
    rate: Rows<T>,
    /// The axial vector of Ω.
    spin: [T; 3],
}

/// What it was made from; a mask of lanes need not be printable.
impl<T: Real> fmt::Debug for StretchRates<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = f.debug_struct("StretchRates");
        fields.field("axes", &self.axes).field("stretch", &self.stretch).field("rate", &self.rate);
        fields.field("spin", &self.spin).finish_non_exhaustive()
    }
}

impl<T: Real> StretchRates<T> {
    /// From F (or ∇u) and Ḟ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> Self {
        Self::of_analysis(StretchAnalysis::of(deformation), rate)
    }

    /// From an analysis of F that is at hand, and Ḟ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_analysis(analysis: StretchAnalysis<T>, rate: &GradientRate<T>) -> Self {
        let (axes, turned, stretch) = analysis.in_frame();
        let rate = product(turned, product_transposed(rate.rows(), axes));
        let spin = spin_of(&stretch, Skew::difference_from_transpose(rate).axial);
        Self { analysis, axes, turned, stretch, rate, spin }
    }

    /// The analysis of F: R, U, V, stretches and axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn analysis(&self) -> &StretchAnalysis<T> {
        &self.analysis
    }

    /// U̇, with U̇ U + U U̇ = Ċ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_stretch(&self) -> Symmetric<T> {
        along(&self.axes, self.right_in_frame())
    }

    /// V̇, with V̇ V + V V̇ = Ḃ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn left_stretch(&self) -> Symmetric<T> {
        along(&self.turned, self.mean_in_frame() + self.half_commutator())
    }

    /// Ṙ = R (Rᵀ Ṙ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rotation(&self) -> Matrix3<T> {
        let spin = Skew { axial: self.spin }.rows();
        from_rows(product(transpose(self.turned), product(spin, self.axes)))
    }

    /// Ṙ Rᵀ, the spin of Green and Naghdi's rate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn polar_spin(&self) -> PolarSpin<T> {
        PolarSpin::of_axial(apply(transpose(self.turned), self.spin))
    }

    /// Rᵀ Ṙ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material_spin(&self) -> MaterialSpin<T> {
        MaterialSpin::of_axial(apply(transpose(self.axes), self.spin))
    }

    /// (ln U)˙.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn hencky_material(&self) -> Symmetric<T> {
        self.material_function(&Logarithm)
    }

    /// (ln V)˙ = R (ln U)˙ Rᵀ + Ω ln V − ln V Ω with Ω = Ṙ Rᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn hencky_spatial(&self) -> Symmetric<T> {
        self.spatial_function(&Logarithm)
    }

    /// f(U)˙ for a function f of the stretch, such as a measure of strain: Σ f[λₖ, λₗ] U̇ₖₗ along the axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        along(&self.axes, self.function_in_frame(f))
    }

    /// f(V)˙ = R f(U)˙ Rᵀ + Ω f(V) − f(V) Ω with Ω = Ṙ Rᵀ, for a function f of the stretch.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spatial_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let turned = along(&self.turned, self.function_in_frame(f));
        let spin = self.polar_spin().rows();
        turned + Symmetric::sum_with_transpose(product(spin, self.analysis.spatial_function(f).rows()))
    }

    /// L = Ḟ F⁻¹ = Ḟ Rᵀ V⁻¹, at hand without another inverse.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn velocity_gradient(&self) -> VelocityGradient<T> {
        let inverse = self.analysis.inverse_left_stretch().rows();
        let turned_rate = product(transpose(self.turned), product(self.rate, self.turned));
        VelocityGradient::trusted(product(turned_rate, inverse))
    }

    /// The spin Ω^log for which (ln V)˙ − Ω ln V + ln V Ω = D.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn logarithmic_spin(&self) -> LogarithmicSpin<T> {
        // Ω^log − ṘRᵀ = Σ (x g(x²))ₖₗ Dₖₗ, x = hₖ − hₗ: with the commutator of h = dev ln V and D, which is skew of
        // axial vector a, and the tensor Q = 2 (h:h) 1 − 3 h² of principal values (hₖ − hₗ)², it is g(Q) a. So no
        // axes are needed, and Q is as regular as ln V.
        let hencky = self.analysis.hencky_spatial();
        let third = hencky.trace() * T::lit(1.0 / 3.0);
        let h = hencky - Symmetric::identity() * third;
        let stretching = self.velocity_gradient().rate_of_deformation();
        let commutator = Skew::commutator(&h, &stretching.0).axial;
        let square = Symmetric::upper_triangle(product(h.rows(), h.rows()));
        let gaps = Symmetric::identity() * (T::lit(2.0) * square.trace()) - square * T::lit(3.0);
        let excess = tensor_function(&LogarithmicExcess, &gaps).apply(commutator);
        let polar = self.polar_spin().axial;
        LogarithmicSpin::of_axial([polar[0] + excess[0], polar[1] + excess[1], polar[2] + excess[2]])
    }

    /// The twirl of the principal axes of U.
    ///
    /// ```text
    /// Ωₖₗ = U̇ₖₗ/(λₗ − λₖ)
    /// ```
    ///
    /// # Errors
    /// [`ContinuumError::CoalescentStretches`], in any lane, when two stretches agree to rounding: their axes have
    /// no rate.
    ///
    /// # Accuracy
    /// Within a few ulp × λ₁ over the least gap of the stretches, squared for the axes themselves.
    pub fn material_twirl(&self) -> Result<MaterialTwirl<T>, ContinuumError> {
        let axes = self.analysis.material_axes();
        let [a, b, c] = self.distinct_stretches()?;
        let rate = self.right_stretch();
        let component = |i: usize, j: usize| dot(axes[i], rate.apply(axes[j]));
        // The axial components are Ω₃₂, Ω₁₃, Ω₂₁.
        let spin = [component(1, 2) / (b - c), component(0, 2) / (c - a), component(0, 1) / (a - b)];
        Ok(MaterialTwirl::of_axial(apply(transpose(axes), spin)))
    }

    /// The twirl of the principal axes of V: that of the axes of U, turned, and Ṙ Rᵀ.
    ///
    /// # Errors
    /// As [`material_twirl`](Self::material_twirl).
    pub fn spatial_twirl(&self) -> Result<SpatialTwirl<T>, ContinuumError> {
        let twirl = self.material_twirl()?.axial;
        let turned = apply(self.analysis.rotation(), [twirl[0], twirl[1], twirl[2]]);
        let polar = self.polar_spin().axial;
        Ok(SpatialTwirl::of_axial([turned[0] + polar[0], turned[1] + polar[1], turned[2] + polar[2]]))
    }

    /// The rates of the principal stretches, λ̇ₖ = N̂ₖ · U̇ N̂ₖ, in their order.
    ///
    /// # Errors
    /// As [`material_twirl`](Self::material_twirl): coalescent stretches may part at different rates forward and
    /// backward.
    pub fn principal_stretches(&self) -> Result<[T; 3], ContinuumError> {
        self.distinct_stretches()?;
        let axes = self.analysis.material_axes();
        let rate = self.right_stretch();
        Ok(axes.map(|axis| dot(axis, rate.apply(axis))))
    }

    fn distinct_stretches(&self) -> Result<[T; 3], ContinuumError> {
        let stretches = self.analysis.principal_stretches();
        let [a, b, c] = stretches;
        let gap = (a - b).min(b - c);
        let least = a * T::lit(4.0 * unit_in_last_place::<T>());
        if least.less_than(gap).all() {
            return Ok(stretches);
        }
        let lane = (0..T::LANES).find(|&lane| gap.primal(lane) <= least.primal(lane)).unwrap_or(0);
        Err(ContinuumError::CoalescentStretches { stretches: stretches.map(|x| x.primal(lane)) })
    }

    /// ½ (Â + Âᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean_in_frame(&self) -> Symmetric<T> {
        Symmetric::symmetric_part(self.rate)
    }

    /// ½ (Ω S − S Ω) = sym(Ω S).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn half_commutator(&self) -> Symmetric<T> {
        let stretch = Symmetric { components: self.stretch }.rows();
        Symmetric::symmetric_part(product(Skew { axial: self.spin }.rows(), stretch))
    }

    /// U̇ along q.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn right_in_frame(&self) -> Symmetric<T> {
        self.mean_in_frame() - self.half_commutator()
    }

    /// f(U)˙ along q.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn function_in_frame<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let rate = self.right_in_frame();
        if T::ORDER != 0 {
            return derivative(f, &Symmetric { components: self.stretch }, &rate);
        }
        // Df(Λ + N)[H]ₖₗ = f[λₖ, λₗ] Hₖₗ + Σ f[λₖ, λₘ, λₗ] (Nₖₘ Hₘₗ + Hₖₘ Nₘₗ), N the rounding off the diagonal.
        let [a, b, c, n, p, r] = self.stretch;
        let [xx, yy, zz, xy, yz, xz] = rate.components;
        let (aa, bb, cc) = (f.divided_difference(a, a), f.divided_difference(b, b), f.divided_difference(c, c));
        let (ab, bc, ac) = (f.divided_difference(a, b), f.divided_difference(b, c), f.divided_difference(a, c));
        let (aab, abb) = (second_difference(f, [a, a, b], aa, ab, ab), second_difference(f, [a, b, b], ab, bb, ab));
        let (bbc, bcc) = (second_difference(f, [b, b, c], bb, bc, bc), second_difference(f, [b, c, c], bc, cc, bc));
        let (aac, acc) = (second_difference(f, [a, a, c], aa, ac, ac), second_difference(f, [a, c, c], ac, cc, ac));
        let abc = second_difference(f, [a, b, c], ab, bc, ac);
        let two = T::lit(2.0);
        Symmetric::new(
            aa * xx + two * (aab * (n * xy) + aac * (r * xz)),
            bb * yy + two * (abb * (n * xy) + bbc * (p * yz)),
            cc * zz + two * (acc * (r * xz) + bcc * (p * yz)),
            ab * xy + (aab * (xx * n) + abb * (n * yy) + abc * (r * yz + xz * p)),
            bc * yz + (bbc * (yy * p) + bcc * (p * zz) + abc * (n * xz + xy * r)),
            ac * xz + (aac * (xx * r) + acc * (r * zz) + abc * (n * yz + xy * p)),
        )
    }
}
