//! The relative deformation gradient, and the tensors of Rivlin–Ericksen and White–Metzner.
//!
//! ```text
//! Fₜ(τ) = F(τ) F(t)⁻¹,   Cₜ = Fₜᵀ Fₜ          the present configuration is the reference
//! Aₙ = dⁿ Cₜ(τ)/dτⁿ,   Bₙ = −dⁿ Cₜ⁻¹(τ)/dτⁿ     at τ = t;   A₁ = B₁ = 2D
//! ```
//! Both come from the gradients of velocity, acceleration and so on, Lₙ = F⁽ⁿ⁾F⁻¹, without differentiation:
//!
//! ```text
//! Aₙ = Σ (n over k) Lₖᵀ Lₙ₋ₖ,    Mₙ = −Σ (n over k) Lₖ Mₙ₋ₖ from k = 1,    Bₙ = −Σ (n over k) Mₖ Mₙ₋ₖᵀ,    L₀ = M₀ = 1
//! ```

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_tensor::internal::rows::{Rows, difference, identity, product, scaled, sum, transpose};

use super::VelocityGradient;
use super::kernels::transported;
use crate::measures::symmetric_measure;
use crate::strain::kernels::right_cauchy_green_minus_one;
use crate::{ContinuumError, Deformation, DisplacementGradient, Symmetric};

/// The relative deformation gradient Fₜ(τ) = F(τ) F(t)⁻¹: from the present configuration to that at τ.
///
/// It is a [`Deformation`], stored as Fₜ − 1 so that the recent past keeps its digits; strains and stretches of it
/// are those of any other.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::RelativeDeformation};
/// let now = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
/// let then = DeformationGradient::new(Matrix3::from_diagonal_element(1.0))?;
/// let past = RelativeDeformation::of(&now, &then)?;
/// assert_eq!(past.right_cauchy_green().components[0], 0.25); // half as long, a quarter as C
/// assert_eq!(past.inverse_right_cauchy_green().components[0], 4.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
/// # Source
/// W(14.22–14.23), W(19.9).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        transparent,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct RelativeDeformation<T = f64> {
    /// Fₜ(τ) − 1.
    pub displacement: DisplacementGradient<T>,
}

impl<T: Real> RelativeDeformation<T> {
    /// From the deformations now, at t, and then, at τ.
    ///
    /// ```text
    /// Fₜ(τ) − 1 = (∇u(τ) − ∇u(t)) F(t)⁻¹
    /// ```
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], where the quotient leaves the range of numbers.
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F(t).
    pub fn of(now: &impl Deformation<T>, then: &impl Deformation<T>) -> Result<Self, ContinuumError> {
        let change = difference(then.displacement_rows(), now.displacement_rows());
        Self::of_displacement(product(change, inverse_and_determinant(now.gradient_rows()).0))
    }

    /// From Fₜ(τ) − 1.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NonPositiveJacobian`].
    pub fn of_displacement(rows: Rows<T>) -> Result<Self, ContinuumError> {
        Ok(Self { displacement: DisplacementGradient::new(from_rows(rows))? })
    }

    /// Fₜ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn gradient(&self) -> Matrix3<T> {
        from_rows(self.gradient_rows())
    }

    /// Cₜ = Fₜᵀ Fₜ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_cauchy_green(&self) -> Symmetric<T> {
        Symmetric::identity() + self.right_cauchy_green_change()
    }

    /// Cₜ − 1 = H + Hᵀ + Hᵀ H with H = Fₜ − 1, without cancellation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_cauchy_green_change(&self) -> Symmetric<T> {
        let h = self.displacement_rows();
        right_cauchy_green_minus_one(h)
    }

    /// Cₜ⁻¹ = Fₜ⁻¹ Fₜ⁻ᵀ, Finger's tensor of the history.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn inverse_right_cauchy_green(&self) -> Symmetric<T> {
        let inverse = inverse_and_determinant(self.gradient_rows()).0;
        Symmetric::gram(inverse)
    }
}

impl<T: Real> Deformation<T> for RelativeDeformation<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        self.displacement.lifted(lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        self.displacement.gradient_rows()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        self.displacement.displacement_rows()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.displacement.jacobian()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.displacement.volume_change()
    }
}

symmetric_measure! {
    /// A tensor of Rivlin and Ericksen, Aₙ = dⁿ Cₜ/dτⁿ at τ = t, 1/sⁿ; A₁ = 2D.
    ///
    /// ```text
    /// Aₙ₊₁ = Ȧₙ + Aₙ L + Lᵀ Aₙ
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::rates::{RivlinEricksen, steady_gradients, VelocityGradient};
    /// // Simple shear v₂ = k x₁ with k = 3: A₁ = k (e₁e₂ + e₂e₁), A₂ = 2k² e₁e₁, A₃ = 0.
    /// let shear = VelocityGradient::new(Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let [a1, a2, a3] = RivlinEricksen::of_gradients(&steady_gradients::<_, 3>(&shear));
    /// assert_eq!(a1.0.components, [0.0, 0.0, 0.0, 3.0, 0.0, 0.0]);
    /// assert_eq!(a2.0.components, [18.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    /// assert_eq!(a3.0.components, [0.0; 6]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    /// # Source
    /// R. S. Rivlin & J. L. Ericksen, *J. Rational Mech. Anal.* 4 (1955).
    RivlinEricksen, "Rivlin-Ericksen tensor"
}

symmetric_measure! {
    /// A tensor of White and Metzner, Bₙ = −dⁿ Cₜ⁻¹/dτⁿ at τ = t, 1/sⁿ; B₁ = 2D.
    ///
    /// ```text
    /// Bₙ₊₁ = Ḃₙ − L Bₙ − Bₙ Lᵀ
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::rates::{steady_gradients, VelocityGradient, WhiteMetzner};
    /// // Simple shear v₂ = k x₁ with k = 3: B₂ = −2k² e₂e₂.
    /// let shear = VelocityGradient::new(Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let [b1, b2] = WhiteMetzner::of_gradients(&steady_gradients::<_, 2>(&shear));
    /// assert_eq!(b1.0.components[3], 3.0);
    /// assert_eq!(b2.0.components, [0.0, -18.0, 0.0, 0.0, 0.0, 0.0]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    WhiteMetzner, "White-Metzner tensor"
}

/// The gradients L₁ = grad v, L₂ = grad a, … of a motion with a steady velocity gradient: Lₙ = Lⁿ.
#[must_use]
pub fn steady_gradients<T: Real, const N: usize>(velocity_gradient: &VelocityGradient<T>) -> [Matrix3<T>; N] {
    let l = velocity_gradient.rows();
    let mut power = identity();
    core::array::from_fn(|_| {
        power = product(power, l);
        from_rows(power)
    })
}

/// The gradients L₁ = grad v, L₂ = grad a, … from the velocity gradient and its material derivatives L, L̇, L̈, ….
///
/// ```text
/// Lₙ₊₁ = Σ (n over k) L⁽ᵏ⁾ Lₙ₋ₖ,     L₂ = L̇ + L²
/// ```
#[must_use]
pub fn gradients_of_rates<T: Real, const N: usize>(rates: &[Matrix3<T>; N]) -> [Matrix3<T>; N] {
    let mut gradients = [identity::<T>(); N];
    for n in 0..N {
        // L⁽ⁿ⁾ L₀, then the terms with L₁ … Lₙ.
        let mut next = rows_of(&rates[n]);
        for k in 0..n {
            next = sum(next, scaled(product(rows_of(&rates[k]), gradients[n - k - 1]), binomial(n, k)));
        }
        gradients[n] = next;
    }
    gradients.map(from_rows)
}

/// (n over k).
fn binomial<T: Real>(n: usize, k: usize) -> T {
    T::lit((0..k).fold(1.0, |value, i| value * (n - i) as f64 / (i + 1) as f64))
}

/// Σ (n over k) xₖᵀ xₙ₋ₖ with x₀ = 1, for n from 1.
fn squares<T: Real, const N: usize>(x: &[Rows<T>; N]) -> [Symmetric<T>; N] {
    core::array::from_fn(|index| {
        let n = index + 1;
        let mut total = Symmetric::sum_with_transpose(x[index]);
        for k in 1..n {
            let term = product(transpose(x[k - 1]), x[n - k - 1]);
            total += Symmetric::symmetric_part(term) * binomial::<T>(n, k);
        }
        total
    })
}

impl<T: Real> RivlinEricksen<T> {
    /// A₁ = 2D.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first(velocity_gradient: &VelocityGradient<T>) -> Self {
        Self(Symmetric::sum_with_transpose(velocity_gradient.rows()))
    }

    /// Aₙ₊₁ = Ȧₙ + Aₙ L + Lᵀ Aₙ from Aₙ and its material derivative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn next(&self, rate: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Self {
        Self(*rate + transported(transpose(velocity_gradient.rows()), &self.0))
    }

    /// A₁ … Aₙ from the gradients L₁ = grad v, L₂ = grad a, ….
    #[must_use]
    pub fn of_gradients<const N: usize>(gradients: &[Matrix3<T>; N]) -> [Self; N] {
        squares(&gradients.map(|l| rows_of(&l))).map(Self)
    }
}

impl<T: Real> WhiteMetzner<T> {
    /// B₁ = 2D.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first(velocity_gradient: &VelocityGradient<T>) -> Self {
        Self(Symmetric::sum_with_transpose(velocity_gradient.rows()))
    }

    /// Bₙ₊₁ = Ḃₙ − L Bₙ − Bₙ Lᵀ from Bₙ and its material derivative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn next(&self, rate: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Self {
        Self(*rate - transported(velocity_gradient.rows(), &self.0))
    }

    /// B₁ … Bₙ from the gradients L₁ = grad v, L₂ = grad a, ….
    #[must_use]
    pub fn of_gradients<const N: usize>(gradients: &[Matrix3<T>; N]) -> [Self; N] {
        let l = gradients.map(|l| rows_of(&l));
        let mut inverse = [identity::<T>(); N];
        for index in 0..N {
            let n = index + 1;
            let mut next = l[index];
            for k in 1..n {
                next = sum(next, scaled(product(l[k - 1], inverse[n - k - 1]), binomial(n, k)));
            }
            inverse[index] = scaled(next, -T::one());
        }
        squares(&inverse.map(transpose)).map(|square| Self(-square))
    }
}
