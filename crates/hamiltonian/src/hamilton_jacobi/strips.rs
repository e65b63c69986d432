//! Monge strips and characteristic strips of the Hamilton–Jacobi equation.
//!
//! ```text
//! Monge            q′ = H_p,  t′ = 1,  U′ = p·H_p + p_t,  p_t + H(q, p, t) = 0            W(12.3)
//! characteristic   the same, and  p′ = −H_q,  p_t′ = −H_t                                 W(12.4)
//! ```
//!
//! p_t names the slope ∂U/∂t and is no derivative in time. Characteristic strips are the trajectories of Hamilton's
//! equations, one to one.

use piola_integrators::Field;
use piola_numerics::{Dual, Gradient, Real};

use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::partial_derivatives::Slopes;

/// A strip (q, t, U, p, p_t) over a parameter τ, written once for any scalar.
///
/// # Example
/// See [`StripResidual`].
///
/// # Source
/// W(12.3).
pub trait Strip {
    /// The number n of coordinates.
    fn freedom(&self) -> usize;
    /// Writes the 2n + 3 numbers (q, t, U, p, p_t) at τ.
    fn at<T: Real>(&self, tau: T, element: &mut [T]);
}

/// How far a strip is from being a Monge strip and from being a characteristic strip, at one τ.
///
/// The parameter of the strip may be any: the derivatives are compared with t′ times those of W(12.3) and W(12.4).
///
/// # Example
/// The strip of a falling stone, H = p²/2 + 10 q, is characteristic; with p_t changed it is not even Monge.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Strip, StripResidual};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Stone;
/// impl PhaseFunction for Stone {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0] + T::lit(10.0) * q[0]
///     }
/// }
/// struct Fall { slope: f64 }
/// impl Strip for Fall {
///     fn freedom(&self) -> usize {
///         1
///     }
///     fn at<T: Real>(&self, t: T, element: &mut [T]) {
///         element[0] = -T::lit(5.0) * t * t; // q
///         element[1] = t;
///         element[2] = T::lit(100.0 / 3.0) * t * t * t; // U′ = p²/2 − 10 q = 100 t²
///         element[3] = -T::lit(10.0) * t; // p
///         element[4] = T::lit(self.slope); // p_t = −H = 0
///     }
/// }
/// let strip = StripResidual::of(&Stone, &Fall { slope: 0.0 }, 1.0)?;
/// assert!(strip.monge() < 1e-13 && strip.characteristic() < 1e-13);
/// assert_eq!(StripResidual::of(&Stone, &Fall { slope: 2.0 }, 1.0)?.equation, 2.0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(12.3), W(12.4).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StripResidual {
    /// p_t + H.
    pub equation: f64,
    /// U′ − (p·H_p + p_t) t′.
    pub band: f64,
    /// q′ − H_p t′.
    pub direction: Vec<f64>,
    /// p′ + H_q t′.
    pub momentum: Vec<f64>,
    /// p_t′ + H_t t′.
    pub slope: f64,
}

impl StripResidual {
    /// The residuals of a strip at τ.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`] where τ, the strip or H is not finite.
    pub fn of<H: PhaseFunction>(hamiltonian: &H, strip: &impl Strip, tau: f64) -> Result<Self, HamiltonianError> {
        check_finite("τ", &[tau])?;
        let n = strip.freedom();
        let mut element = vec![Dual::constant(0.0); 2 * n + 3];
        strip.at(Dual::variable(tau), &mut element);
        let values: Vec<f64> = element.iter().map(|x| x.value).collect();
        let rates: Vec<f64> = element.iter().map(|x| x.tangent).collect();
        check_finite("strip", &values)?;
        check_finite("derivative of the strip", &rates)?;
        let (p, slope, speed) = (n + 2, values[2 * n + 2], rates[n]);
        let mut slopes = Slopes::new();
        slopes_of(hamiltonian, &mut slopes, (&values[..n], &values[p..p + n], values[n]));
        check_finite("∂H/∂(q, p, t)", &slopes.partials)?;
        let (h_q, rest) = slopes.partials.split_at(n);
        let (h_p, h_t) = (&rest[..n], rest[n]);
        let along: f64 = (0..n).map(|i| values[p + i] * h_p[i]).sum();
        Ok(Self {
            equation: slope + slopes.value,
            band: rates[n + 1] - (along + slope) * speed,
            direction: (0..n).map(|i| rates[i] - h_p[i] * speed).collect(),
            momentum: (0..n).map(|i| rates[p + i] + h_q[i] * speed).collect(),
            slope: rates[2 * n + 2] + h_t * speed,
        })
    }

    /// The largest residual of the conditions of a Monge strip, W(12.3).
    #[must_use]
    pub fn monge(&self) -> f64 {
        self.direction.iter().fold(self.equation.abs().max(self.band.abs()), |m, x| m.max(x.abs()))
    }

    /// The largest residual of the conditions of a characteristic strip, W(12.4) with p_t + H = 0.
    #[must_use]
    pub fn characteristic(&self) -> f64 {
        self.momentum.iter().fold(self.monge().max(self.slope.abs()), |m, x| m.max(x.abs()))
    }
}

/// H and its derivatives by q, p and t, in this order.
pub(super) fn slopes_of<H: PhaseFunction, T: Real>(
    hamiltonian: &H,
    slopes: &mut Slopes<T>,
    (q, p, t): (&[T], &[T], T),
) {
    let n = q.len();
    slopes.of(&q.iter().chain(p).copied().chain([t]), |x| {
        let (t, x) = x.split_last().map_or((Gradient::constant(T::zero()), x), |(t, x)| (*t, x));
        let (q, p) = x.split_at(n);
        hamiltonian.value(q, p, t)
    });
}

/// The characteristic strips of W(12.4) as a field over τ = t − t₀, y = (q, t, U, p, p_t), for any integrator.
///
/// The integrator's time is τ; the time of the mechanics is the component t of the state. p_t + H stays what it is
/// at the start.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::CharacteristicStrip;
/// use piola_hamiltonian::PhaseFunction;
/// use piola_integrators::Field;
/// use piola_numerics::Real;
/// struct Stone;
/// impl PhaseFunction for Stone {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0] + T::lit(10.0) * q[0]
///     }
/// }
/// let mut rate = [0.0; 5];
/// let start = CharacteristicStrip::<_>::start(&Stone, &[2.0], &[3.0], 0.0, 7.0)?; // H = 24.5
/// assert_eq!(start, [2.0, 0.0, 7.0, 3.0, -24.5]);
/// CharacteristicStrip::new(&Stone, 1).rate(0.0, &start, &mut rate)?;
/// assert_eq!(rate, [3.0, 1.0, -15.5, -10.0, 0.0]); // U′ = p q′ − H
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(12.4).
#[derive(Clone, Debug)]
pub struct CharacteristicStrip<'a, H, T = f64> {
    hamiltonian: &'a H,
    freedom: usize,
    slopes: Slopes<T>,
}

impl<'a, H: PhaseFunction, T: Real> CharacteristicStrip<'a, H, T> {
    /// The strips of a Hamiltonian of n degrees of freedom.
    #[must_use]
    pub fn new(hamiltonian: &'a H, freedom: usize) -> Self {
        Self { hamiltonian, freedom, slopes: Slopes::new() }
    }

    /// The element (q, t, U, p, p_t) with p_t = −H(q, p, t) from which a strip starts.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`].
    pub fn start(hamiltonian: &'a H, q: &[T], p: &[T], t: T, u: T) -> Result<Vec<T>, HamiltonianError> {
        check_length("p", q.len(), p.len())?;
        let element: Vec<T> =
            q.iter().copied().chain([t, u]).chain(p.iter().copied()).chain([-hamiltonian.value(q, p, t)]).collect();
        check_finite("strip", &element)?;
        Ok(element)
    }
}

impl<H: PhaseFunction, T: Real> Field<T> for CharacteristicStrip<'_, H, T> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        2 * self.freedom + 3
    }
    fn rate(&mut self, _tau: f64, y: &[T], rate: &mut [T]) -> Result<(), HamiltonianError> {
        let n = self.freedom;
        slopes_of(self.hamiltonian, &mut self.slopes, (&y[..n], &y[n + 2..2 * n + 2], y[n]));
        let (h_q, rest) = self.slopes.partials.split_at(n);
        let mut along = y[2 * n + 2];
        for i in 0..n {
            rate[i] = rest[i];
            along += y[n + 2 + i] * rest[i];
            rate[n + 2 + i] = -h_q[i];
        }
        rate[n] = T::one();
        rate[n + 1] = along;
        rate[2 * n + 2] = -rest[n];
        Ok(())
    }
}
