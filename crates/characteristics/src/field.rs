//! The characteristic system, alone and with its variational equations.

use piola_integrators::Field;
use piola_numerics::linear::lu;
use piola_numerics::{Dual, Real};

use super::FirstOrderPde;
use super::determinant::determinant;
use super::partials::Partials;
use crate::CharacteristicsError;

/// The characteristic system of an equation, y = (x, u, ξ) with 2m + 1 components, for any integrator and any scalar.
///
/// ```text
/// x′ = Φ_ξ,    u′ = ξ·Φ_ξ,    ξ′ = −(ξ Φ_u + Φ_x)                                        W(A.38)
/// ```
///
/// The derivatives of Φ are exact; Φ itself is an integral W(A.20), whose drift is what the integrator leaves. Over
/// [`Lanes`](piola_numerics::Lanes) several characteristics advance at once.
///
/// # Errors
/// None of its own; integrators refuse rates that are not finite.
///
/// # Example
/// ```
/// use piola_characteristics::{CharacteristicField, FirstOrderPde};
/// use piola_integrators::Field;
/// use piola_numerics::Real;
/// struct Product; // ξ₁ ξ₂ − u = 0
/// impl FirstOrderPde for Product {
///     fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
///         xi[0] * xi[1] - u
///     }
/// }
/// let mut rate = [0.0; 5];
/// CharacteristicField::new(&Product, 2).rate(0.0, &[0.0, 1.0, 6.0, 2.0, 3.0], &mut rate)?;
/// assert_eq!(rate, [3.0, 2.0, 12.0, 2.0, 3.0]); // x′ = (ξ₂, ξ₁), u′ = 2 ξ₁ ξ₂, ξ′ = ξ
/// # Ok::<(), piola_characteristics::CharacteristicsError>(())
/// ```
///
/// # Source
/// W(A.19), W(A.38).
#[derive(Clone, Debug)]
pub struct CharacteristicField<'a, P, T = f64> {
    equation: &'a P,
    variables: usize,
    work: Partials<T>,
}

impl<'a, P: FirstOrderPde, T: Real> CharacteristicField<'a, P, T> {
    /// The characteristics of an equation in m variables.
    #[must_use]
    pub fn new(equation: &'a P, variables: usize) -> Self {
        Self { equation, variables, work: Partials::new(variables) }
    }
}

impl<P: FirstOrderPde, T: Real> Field<T> for CharacteristicField<'_, P, T> {
    type Error = CharacteristicsError;
    fn dimension(&self) -> usize {
        2 * self.variables + 1
    }
    fn rate(&mut self, _s: f64, y: &[T], rate: &mut [T]) -> Result<(), CharacteristicsError> {
        self.work.rate_into(self.equation, y, rate);
        Ok(())
    }
    /// Those of x, of u and of ξ are apart; u has at least that of ξ·x.
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_strip(self.variables, y, magnitudes);
    }
}

/// The largest |value| of several scalars, over all lanes.
fn largest<T: Real>(values: &[T]) -> f64 {
    values.iter().flat_map(|x| (0..T::LANES).map(|lane| x.primal(lane).abs())).fold(0.0, f64::max)
}

fn magnitudes_of_strip<T: Real>(m: usize, y: &[T], magnitudes: &mut [f64]) {
    let (x, xi) = (largest(&y[..m]), largest(&y[m + 1..=2 * m]));
    magnitudes[..m].fill(x);
    magnitudes[m] = largest(&y[m..=m]).max(x * xi);
    magnitudes[m + 1..=2 * m].fill(xi);
}

/// A characteristic with its neighbours: y = (x, u, ξ; ∂(x, u, ξ)/∂τ₁; …), for any integrator and any scalar.
///
/// ```text
/// y₀′ = f(y₀),    yₐ′ = ∂f/∂y (y₀) yₐ    a = 1 … k
/// ```
///
/// f is the characteristic system W(A.38); the variational equations are exact, by dual numbers. With k = m − 1
/// tangents to an initial manifold, det(x_s, x_τ) is the Jacobian of the ray map (s, τ) ↦ x: see
/// [`determinant`](Self::determinant).
///
/// Of an equation that is [linear in ξ](FirstOrderPde::QUASILINEAR) the state has ξ = 0 and ξ_τ = 0 in their places,
/// and u′ = −Φ.
///
/// # Example
/// ```
/// use piola_characteristics::{FirstOrderPde, RayField};
/// use piola_integrators::{DormandPrince853, State, Tolerance};
/// use piola_numerics::Real;
/// struct Burgers; // ∂u/∂t + u ∂u/∂q = 0 in x = (t, q)
/// impl FirstOrderPde for Burgers {
///     fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
///         xi[0] + u * xi[1]
///     }
/// }
/// // u = −q at t = 0: all rays meet at t = 1. The ray of q = 1/2 and its tangent to the line t = 0:
/// let ray = vec![0.0, 0.5, -0.5, -0.5, -1.0, 0.0, 1.0, -1.0, -1.0, 0.0];
/// let (mut field, mut state) = (RayField::new(&Burgers, 2, 1), State::new(0.0, ray)?);
/// DormandPrince853::new(Tolerance::relative(1e-13)?).integrate_to(&mut field, &mut state, 0.75)?;
/// assert!((field.determinant(&state.values) - 0.25).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(A.22), W(A.38), W(A.43).
#[derive(Clone, Debug)]
pub struct RayField<'a, P, T = f64> {
    pub(super) equation: &'a P,
    pub(super) variables: usize,
    tangents: usize,
    work: Partials<Dual<T>>,
    state: Vec<Dual<T>>,
    dual_rate: Vec<Dual<T>>,
    rates: Vec<T>,
    matrix: Vec<T>,
    dual_matrix: Vec<Dual<T>>,
}

impl<'a, P: FirstOrderPde, T: Real> RayField<'a, P, T> {
    /// Characteristics of an equation in m variables with k tangents each, 0 < k.
    #[must_use]
    pub fn new(equation: &'a P, variables: usize, tangents: usize) -> Self {
        let n = 2 * variables + 1;
        Self {
            equation,
            variables,
            tangents,
            work: Partials::new(variables),
            state: vec![Dual::constant(T::zero()); n],
            dual_rate: vec![Dual::constant(T::zero()); n],
            rates: vec![T::zero(); n * (1 + tangents)],
            matrix: vec![T::zero(); variables * variables],
            dual_matrix: vec![Dual::constant(T::zero()); variables * variables],
        }
    }

    /// ξ = ∇u where the characteristics go without it: of u_s and u_τ by the ray map. Infinite, as f64::MAX, where that
    /// has no inverse.
    pub(super) fn covector(&mut self, y: &[T]) -> Vec<T> {
        let (m, n) = (self.variables, 2 * self.variables + 1);
        let mut rates = core::mem::take(&mut self.rates);
        self.rate_into(y, &mut rates);
        let (mut matrix, mut xi) = (vec![T::zero(); m * m], vec![rates[m]; m]);
        for i in 0..m {
            matrix[i * m] = rates[i];
            for a in 1..m {
                matrix[a + i * m] = y[a * n + i];
                xi[a] = y[a * n + m];
            }
        }
        self.rates = rates;
        let mut exchanges = vec![0; m];
        let solved = lu::factor_in_place(&mut matrix, &mut exchanges)
            .and_then(|()| lu::solve_in_place(&matrix, &exchanges, &mut xi));
        if solved.is_err() {
            xi.fill(T::lit(f64::MAX));
        }
        xi
    }

    /// Writes all rates; Φ is returned.
    pub(super) fn rate_into(&mut self, y: &[T], rate: &mut [T]) -> T {
        let n = 2 * self.variables + 1;
        let mut value = T::zero();
        for a in 1..=self.tangents {
            for i in 0..n {
                self.state[i] = Dual::new(y[i], y[a * n + i]);
            }
            value = self.work.ray_rate_into(self.equation, &self.state, &mut self.dual_rate).value;
            for i in 0..n {
                rate[a * n + i] = self.dual_rate[i].tangent;
            }
        }
        for i in 0..n {
            rate[i] = self.dual_rate[i].value;
        }
        value
    }

    /// The Jacobian of the ray map, det(x_s, x_τ₁, …), of a state with k = m − 1 tangents.
    ///
    /// ```text
    /// det ∂(x¹, …, xᵐ)/∂(s, τ¹, …, τᵐ⁻¹),    x_s = Φ_ξ
    /// ```
    ///
    /// For m = 2 it is x¹_s x²_τ − x²_s x¹_τ.
    pub fn determinant(&mut self, y: &[T]) -> T {
        let (m, n) = (self.variables, 2 * self.variables + 1);
        for i in 0..n {
            self.state[i] = Dual::constant(y[i]);
        }
        self.work.ray_rate_into(self.equation, &self.state, &mut self.dual_rate);
        for i in 0..m {
            self.matrix[i] = self.dual_rate[i].value;
            for a in 1..m {
                self.matrix[a * m + i] = y[a * n + i];
            }
        }
        determinant(&mut self.matrix, m)
    }

    /// The Jacobian of the ray map and its derivative along the ray, exact.
    pub fn determinant_and_slope(&mut self, y: &[T]) -> Dual<T> {
        let (m, n) = (self.variables, 2 * self.variables + 1);
        let mut rates = core::mem::take(&mut self.rates);
        self.rate_into(y, &mut rates);
        for i in 0..n {
            self.state[i] = Dual::new(y[i], rates[i]);
        }
        self.work.ray_rate_into(self.equation, &self.state, &mut self.dual_rate);
        for i in 0..m {
            self.dual_matrix[i] = self.dual_rate[i];
            for a in 1..m {
                self.dual_matrix[a * m + i] = Dual::new(y[a * n + i], rates[a * n + i]);
            }
        }
        self.rates = rates;
        determinant(&mut self.dual_matrix, m)
    }
}

impl<P: FirstOrderPde, T: Real> Field<T> for RayField<'_, P, T> {
    type Error = CharacteristicsError;
    fn dimension(&self) -> usize {
        (2 * self.variables + 1) * (1 + self.tangents)
    }
    fn rate(&mut self, _s: f64, y: &[T], rate: &mut [T]) -> Result<(), CharacteristicsError> {
        self.rate_into(y, rate);
        Ok(())
    }
    /// Those of x_τ and ξ_τ are apart for each tangent; u_τ has at least that of ξ·x_τ, and ξ_τ that of ξ where x
    /// changes by its own magnitude.
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        let (m, n) = (self.variables, 2 * self.variables + 1);
        magnitudes_of_strip(m, y, magnitudes);
        let (x, xi) = (magnitudes[0], magnitudes[n - 1]);
        for (tangent, magnitudes) in y[n..].chunks(n).zip(magnitudes[n..].chunks_mut(n)) {
            let (x_tau, xi_tau) = (largest(&tangent[..m]), largest(&tangent[m + 1..]));
            let turned = if 0.0 < x { xi * (x_tau / x) } else { 0.0 };
            magnitudes[..m].fill(x_tau);
            magnitudes[m] = largest(&tangent[m..=m]).max(xi * x_tau);
            magnitudes[m + 1..].fill(xi_tau.max(turned));
        }
    }
}
