//! Methods of integration.

use core::fmt;

use piola_integrators::Order;

/// A method of integration with its step or tolerance.
///
/// # Example
/// ```
/// use piola_integrators::Order;
/// use piola_simulation::motion::Method;
/// let method = Method::GaussLegendre { order: Order::Eight, step: 0.01 };
/// assert_eq!(method.to_string(), "gauss-legendre-8");
/// assert_eq!(method.step(), Some(0.01));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Explicit symplectic composition.
    Composition {
        /// Order.
        order: Order,
        /// Longest step, s.
        step: f64,
    },
    /// Gauss–Legendre collocation, symplectic.
    GaussLegendre {
        /// Order.
        order: Order,
        /// Longest step, s.
        step: f64,
    },
    /// Adaptive Runge–Kutta of order 8(5,3).
    DormandPrince {
        /// Relative tolerance of a step.
        tolerance: f64,
    },
    /// Adaptive Runge–Kutta of order 9(8).
    Verner {
        /// Relative tolerance of a step.
        tolerance: f64,
    },
    /// Adaptive Nyström of order 8(6), for forces that depend on positions alone.
    Nystrom86 {
        /// Relative tolerance of a step.
        tolerance: f64,
    },
    /// Adaptive Nyström of order 12(10), for forces that depend on positions alone.
    Nystrom1210 {
        /// Relative tolerance of a step.
        tolerance: f64,
    },
    /// Kepler's closed form at every instant, without steps: for bodies on ellipses about a fixed centre.
    ClosedForm,
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Composition { order, .. } => write!(f, "composition-{}", order.value()),
            Self::GaussLegendre { order, .. } => write!(f, "gauss-legendre-{}", order.value()),
            Self::DormandPrince { .. } => f.write_str("dormand-prince-853"),
            Self::Verner { .. } => f.write_str("verner-98"),
            Self::Nystrom86 { .. } => f.write_str("nystrom-86"),
            Self::Nystrom1210 { .. } => f.write_str("nystrom-1210"),
            Self::ClosedForm => f.write_str("closed-form"),
        }
    }
}

impl Method {
    /// The longest step of a method of fixed step, s.
    #[must_use]
    pub fn step(&self) -> Option<f64> {
        match self {
            Self::Composition { step, .. } | Self::GaussLegendre { step, .. } => Some(*step),
            Self::DormandPrince { .. }
            | Self::Verner { .. }
            | Self::Nystrom86 { .. }
            | Self::Nystrom1210 { .. }
            | Self::ClosedForm => None,
        }
    }
}
