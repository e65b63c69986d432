//! Relative tolerances that say where they come from.

use core::fmt;

/// A relative tolerance with its reason.
///
/// # Example
/// ```
/// use piola_testkit::Tol;
/// assert_eq!(Tol::ulps(4.0).value(), 4.0 * f64::EPSILON);
/// assert_eq!(Tol::order(0.5, 3).value(), 0.125);
/// assert_eq!(Tol::ulps_because(1e3, "a thousand steps").to_string(), "2.220e-13 (1000 ulp of f64: a thousand steps)");
/// ```
#[derive(Clone, Copy, Debug)]
#[must_use]
pub struct Tol {
    value: f64,
    reason: Reason,
    /// The product of the condition numbers it was scaled by.
    condition: f64,
}

#[derive(Clone, Copy, Debug)]
enum Reason {
    Ulps { count: f64 },
    UlpsBecause { count: f64, reason: &'static str },
    Ulps32 { count: f64 },
    Order { step: f64, order: i32 },
    Stated { reason: &'static str },
}

impl Tol {
    /// `n` units in the last place of one in f64: n · 2⁻⁵². Beyond 64 say why: [`ulps_because`](Self::ulps_because).
    pub const fn ulps(n: f64) -> Self {
        Self { value: n * f64::EPSILON, reason: Reason::Ulps { count: n }, condition: 1.0 }
    }
    /// `n` units in the last place of one in f64, with the reason why there are more than 64.
    pub const fn ulps_because(n: f64, reason: &'static str) -> Self {
        Self { value: n * f64::EPSILON, reason: Reason::UlpsBecause { count: n, reason }, condition: 1.0 }
    }
    /// `n` units in the last place of one in f32: n · 2⁻²³.
    pub fn ulps32(n: f64) -> Self {
        Self { value: n * f64::from(f32::EPSILON), reason: Reason::Ulps32 { count: n }, condition: 1.0 }
    }
    /// The error of a method of order `p` with step `h`: hᵖ.
    pub fn order(h: f64, p: i32) -> Self {
        Self { value: h.powi(p), reason: Reason::Order { step: h, order: p }, condition: 1.0 }
    }
    /// A tolerance that the specification, the data's provenance or a measurement gives.
    pub const fn stated(value: f64, reason: &'static str) -> Self {
        Self { value, reason: Reason::Stated { reason }, condition: 1.0 }
    }
    /// Scaled by the condition number of the problem.
    pub const fn times(mut self, factor: f64) -> Self {
        self.value *= factor;
        self.condition *= factor;
        self
    }
    /// The larger of two tolerances, with its reason.
    pub fn or(self, other: Self) -> Self {
        if self.value < other.value { other } else { self }
    }
    /// The number itself.
    #[must_use]
    pub const fn value(self) -> f64 {
        self.value
    }
}

impl fmt::Display for Tol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3e} (", self.value)?;
        match self.reason {
            Reason::Ulps { count } => write!(f, "{count} ulp of f64")?,
            Reason::UlpsBecause { count, reason } => write!(f, "{count} ulp of f64: {reason}")?,
            Reason::Ulps32 { count } => write!(f, "{count} ulp of f32")?,
            Reason::Order { step, order } => write!(f, "order {order} at step {step}")?,
            Reason::Stated { reason } => f.write_str(reason)?,
        }
        if (self.condition - 1.0).abs() <= 0.0 {
            f.write_str(")")
        } else {
            write!(f, ", times {:.3e})", self.condition)
        }
    }
}
