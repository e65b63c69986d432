//! The Monge cone of an equation at a point (x, u): the directions along which solutions through it can touch each
//! other.
//!
//! ```text
//! (x − x₀)ⁱ/Φ_ξᵢ = (u − u₀)/(ξ·Φ_ξ),    Φ(x₀, u₀, ξ) = 0                              W(A.35)
//! ```

use nalgebra::{DMatrix, DVector};
use piola_numerics::Dual;

use super::FirstOrderPde;
use super::determinant::{dot, norm};
use super::partials::Partials;
use super::roots::{Search, zeros};
use crate::CharacteristicsError;
use crate::check::{check_finite, check_length};

/// Residuals, over the magnitude of their terms, above which a covector is not on the cone.
const ON_CONE: f64 = 1e-9;

/// The Monge cone at (x, u), for m variables.
///
/// # Example
/// ```
/// use piola_characteristics::{FirstOrderPde, MongeCone, Search};
/// use piola_numerics::Real;
/// struct Eikonal; // (|ξ|² − 1)/2 = 0: the cone of all directions of slope ±1
/// impl FirstOrderPde for Eikonal {
///     fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
///         T::lit(0.5) * (xi[0] * xi[0] + xi[1] * xi[1] - T::one())
///     }
/// }
/// let cone = MongeCone::new(&Eikonal, &[0.0, 0.0], 0.0)?;
/// let generator = cone.generator_over(&[3.0, 4.0], &[1.0, 0.0])?;
/// assert!((generator.covector[0] - 0.6).abs() < 1e-14 && (generator.u_rate - 1.0).abs() < 1e-14);
/// // All of them along a line of ξ: at ±(0.6, 0.8).
/// let search = Search { from: -10.0, to: 10.0, parts: 20 };
/// let found = cone.generators_along(&[0.0, 0.0], &[0.6, 0.8], search)?;
/// assert!(found.len() == 2 && (found[1].covector[1] - 0.8).abs() < 1e-14);
/// # Ok::<(), piola_characteristics::CharacteristicsError>(())
/// ```
///
/// # Source
/// W(A.11), W(A.35).
#[derive(Clone, Debug)]
pub struct MongeCone<'a, P> {
    equation: &'a P,
    x: Vec<f64>,
    u: f64,
}

/// A generator of the cone, with the rate of its covector along the characteristic.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Generator {
    /// ξ, the tangent plane along the generator.
    pub covector: Vec<f64>,
    /// x′ = Φ_ξ.
    pub x_rate: Vec<f64>,
    /// u′ = ξ·Φ_ξ.
    pub u_rate: f64,
    /// ξ′ = −(ξΦ_u + Φ_x) on the characteristic strip W(A.37).
    pub covector_rate: Vec<f64>,
}

/// By how much a direction (x′, u′) with a tangent plane ξ is not that of a Monge strip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MongeResidual {
    /// Φ over the magnitude Σ|Φ_x x| + |Φ_u u| + Σ|Φ_ξ ξ|.
    pub equation: f64,
    /// The sine of the angle between x′ and Φ_ξ.
    pub direction: f64,
    /// (u′ − ξ·x′)/(|u′| + |ξ||x′|).
    pub strip: f64,
}

impl MongeResidual {
    /// The largest of the three.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.equation.abs().max(self.direction.abs()).max(self.strip.abs())
    }
}

impl<'a, P: FirstOrderPde> MongeCone<'a, P> {
    /// The cone at (x, u).
    ///
    /// # Errors
    /// [`CharacteristicsError::NotFinite`].
    pub fn new(equation: &'a P, x: &[f64], u: f64) -> Result<Self, CharacteristicsError> {
        check_finite("x", x)?;
        check_finite("u", &[u])?;
        Ok(Self { equation, x: x.to_vec(), u })
    }

    fn state(&self, xi: &[f64]) -> Vec<f64> {
        self.x.iter().copied().chain([self.u]).chain(xi.iter().copied()).collect()
    }

    fn check_covector(&self, quantity: &'static str, xi: &[f64]) -> Result<(), CharacteristicsError> {
        check_length(quantity, self.x.len(), xi.len())?;
        check_finite(quantity, xi)
    }

    /// The generator along which the plane ξ touches the cone.
    ///
    /// ```text
    /// x′ = Φ_ξ,    u′ = ξ·Φ_ξ                                                           W(A.35)
    /// ```
    ///
    /// # Errors
    /// [`CharacteristicsError::NoGenerator`] unless Φ(x, u, ξ) = 0; [`CharacteristicsError::WrongLength`],
    /// [`CharacteristicsError::NotFinite`].
    pub fn generator(&self, xi: &[f64]) -> Result<Generator, CharacteristicsError> {
        self.check_covector("ξ", xi)?;
        let m = self.x.len();
        let y = self.state(xi);
        let (mut work, mut rate) = (Partials::new(m), vec![0.0; 2 * m + 1]);
        let value = work.rate_into(self.equation, &y, &mut rate);
        check_finite("∂Φ/∂(x, u, ξ)", &work.gradient)?;
        let magnitude = work.magnitude(&y);
        if value.is_nan() || ON_CONE * magnitude < value.abs() {
            let (direction, residual) = (rate[..m].to_vec(), if 0.0 < magnitude { value / magnitude } else { value });
            return Err(CharacteristicsError::NoGenerator { direction, covector: xi.to_vec(), residual });
        }
        Ok(Generator {
            covector: xi.to_vec(),
            x_rate: rate[..m].to_vec(),
            u_rate: rate[m],
            covector_rate: rate[m + 1..].to_vec(),
        })
    }

    /// All generators whose covectors are ξ = `base` + c `along` with c in the search, in the order of c.
    ///
    /// # Errors
    /// As [`generator`](Self::generator); [`CharacteristicsError::TooFewSamples`] for a search in no parts.
    pub fn generators_along(
        &self,
        base: &[f64],
        along: &[f64],
        search: Search,
    ) -> Result<Vec<Generator>, CharacteristicsError> {
        self.check_covector("base", base)?;
        self.check_covector("along", along)?;
        search.check()?;
        let line = |c: Dual<Dual<f64>>| {
            let lit = |value: f64| Dual::constant(Dual::constant(value));
            let x: Vec<_> = self.x.iter().map(|&x| lit(x)).collect();
            let xi: Vec<_> = base.iter().zip(along).map(|(&b, &a)| lit(b) + c * lit(a)).collect();
            let phi = self.equation.value(&x, lit(self.u), &xi);
            let values = [phi.value.value, phi.value.tangent, phi.tangent.tangent];
            check_finite("Φ", &values).map(|()| values)
        };
        let second = |c| Dual::variable(Dual::variable(c));
        let found = zeros(
            &mut |c| line(second(c)).map(|[value, slope, _]| (value, slope)),
            &mut |c| line(second(c)).map(|[_, slope, curvature]| (slope, curvature)),
            search,
            ON_CONE,
        )?;
        let covector = |c: f64| base.iter().zip(along).map(|(b, a)| b + c * a).collect::<Vec<_>>();
        found.into_iter().map(|c| self.generator(&covector(c))).collect()
    }

    /// The generator over a direction x′, from a guess of its covector.
    ///
    /// ```text
    /// Φ_ξ(x, u, ξ) = λ x′,    Φ(x, u, ξ) = 0
    /// ```
    ///
    /// Newton's iteration for ξ and λ, by the pseudo-inverse: where Φ is linear in ξ the cone is one line, and the
    /// covector nearest to the guess is taken. The direction of the generator may be −x′.
    ///
    /// # Errors
    /// [`CharacteristicsError::NoGenerator`] with the residual where the iteration ends; [`CharacteristicsError::WrongLength`],
    /// [`CharacteristicsError::NotFinite`].
    pub fn generator_over(&self, direction: &[f64], guess: &[f64]) -> Result<Generator, CharacteristicsError> {
        const STEPS: usize = 60;
        self.check_covector("direction", direction)?;
        self.check_covector("guess of ξ", guess)?;
        let m = self.x.len();
        let refused = |covector: &[f64], residual| CharacteristicsError::NoGenerator {
            direction: direction.to_vec(),
            covector: covector.to_vec(),
            residual,
        };
        let length = norm(direction);
        if length <= 0.0 {
            return Err(refused(guess, f64::INFINITY));
        }
        let unit: Vec<f64> = direction.iter().map(|x| x / length).collect();
        let mut xi = guess.to_vec();
        let mut lambda = f64::NAN;
        let mut work = Partials::<Dual<f64>>::new(m);
        let mut relative = f64::INFINITY;
        for _ in 0..STEPS {
            let mut matrix = DMatrix::zeros(m + 1, m + 1);
            let mut residual = DVector::zeros(m + 1);
            let y = self.state(&xi);
            let mut magnitude = 0.0;
            for i in 0..m {
                let one = |j| if j == m + 1 + i { 1.0 } else { 0.0 };
                let dual: Vec<Dual<f64>> = y.iter().enumerate().map(|(j, &y)| Dual::new(y, one(j))).collect();
                residual[m] = work.evaluate(self.equation, &dual).value;
                magnitude = work.magnitude(&dual);
                for j in 0..m {
                    matrix[(j, i)] = work.gradient[m + 1 + j].tangent;
                }
                matrix[(m, i)] = work.gradient[m + 1 + i].value;
                matrix[(i, m)] = -unit[i];
            }
            let slope: Vec<f64> = work.gradient[m + 1..].iter().map(|g| g.value).collect();
            check_finite("∂Φ/∂ξ", &slope)?;
            if lambda.is_nan() {
                lambda = dot(&slope, &unit);
            }
            for i in 0..m {
                residual[i] = slope[i] - lambda * unit[i];
            }
            let across = norm(&residual.as_slice()[..m]);
            let (speed, value) = (norm(&slope), residual[m].abs());
            relative = if 0.0 < speed { across / speed } else { f64::INFINITY };
            relative = relative.max(if 0.0 < magnitude { value / magnitude } else { 0.0 });
            if relative <= 4.0 * f64::EPSILON {
                break;
            }
            // Free of units: ξ by its size, Φ_ξ and λ by |Φ_ξ|, Φ by both.
            let size = Some(norm(&xi)).filter(|&size| 0.0 < size).unwrap_or(1.0);
            let rate = [speed, magnitude / size].into_iter().find(|&rate| 0.0 < rate).unwrap_or(1.0);
            for i in 0..m {
                matrix.view_mut((0, i), (m, 1)).scale_mut(size / rate);
                matrix[(m, i)] /= rate;
                residual[i] /= rate;
            }
            residual[m] /= rate * size;
            let scale = matrix.amax();
            let Ok(step) = matrix.svd(true, true).solve(&residual, 1e-13 * scale) else { break };
            xi.iter_mut().zip(&step).for_each(|(xi, step)| *xi -= size * step);
            lambda -= rate * step[m];
            if !xi.iter().all(|xi| xi.is_finite()) {
                return Err(refused(&xi, relative));
            }
        }
        if relative.is_nan() || ON_CONE < relative {
            return Err(refused(&xi, relative));
        }
        self.generator(&xi)
    }

    /// By how much (x′, u′) with the plane ξ is not the direction of a Monge strip.
    ///
    /// ```text
    /// Φ = 0,    x′ ∥ Φ_ξ,    u′ = ξ·x′                                                    W(A.36)
    /// ```
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`], [`CharacteristicsError::NotFinite`].
    pub fn monge_residual(
        &self,
        x_rate: &[f64],
        u_rate: f64,
        xi: &[f64],
    ) -> Result<MongeResidual, CharacteristicsError> {
        self.check_covector("x′", x_rate)?;
        self.check_covector("ξ", xi)?;
        check_finite("u′", &[u_rate])?;
        let m = self.x.len();
        let y = self.state(xi);
        let mut work = Partials::new(m);
        let value = work.evaluate(self.equation, &y);
        check_finite("∂Φ/∂(x, u, ξ)", &work.gradient)?;
        let share = |part: f64, whole: f64| if 0.0 < whole { part / whole } else { part };
        let slope = &work.gradient[m + 1..];
        let (speed, length) = (norm(slope), norm(x_rate));
        // The part of Φ_ξ across x′.
        let along = share(share(dot(slope, x_rate), length), length);
        let across: Vec<f64> = slope.iter().zip(x_rate).map(|(s, x)| s - along * x).collect();
        Ok(MongeResidual {
            equation: share(value, work.magnitude(&y)),
            direction: share(norm(&across), speed),
            strip: share(u_rate - dot(xi, x_rate), u_rate.abs() + norm(xi) * length),
        })
    }
}
