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
    /// A closed form at every instant, without steps: Kepler's for bodies on ellipses about a fixed centre, Lagrange's for a
    /// mechanism that [has it](crate::joints::Mechanism::has_closed_form).
    ///
    /// Where the axis of a top passes exactly through the vertical, its first and third angles each jump by π; their rates are NaN
    /// at an instant of the passage itself.
    ///
    /// # Example
    /// A top that nutates: its energy is kept without a step.
    /// ```
    /// use piola_kinematics::{Inertia, RigidBody};
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// use piola_simulation::motion::{Method, System, TimeSpan, Timetable, simulate};
    /// use std::ops::ControlFlow;
    /// let angle = |name: &str, position, velocity| Coordinate { name: name.into(), angular: true, position, velocity };
    /// let coordinates = vec![angle("a", 0.0, 0.0), angle("b", 0.5, 0.0), angle("c", 0.0, 60.0)];
    /// let tip = Joint { parent: None, offset: [0.0; 3], motion: JointMotion::Spherical, coordinates };
    /// let body = RigidBody::new(1.0, Inertia::principal([0.75, 0.75, 0.25])?)?;
    /// let body = Part { joint: 0, name: "top".into(), at: [0.0, 0.0, 0.5], kind: PartKind::Body(body) };
    /// let top = Mechanism::new(vec![tip], vec![body], [0.0, 0.0, -9.81])?;
    /// assert!(top.has_closed_form());
    /// let timetable = Timetable::new(TimeSpan { start: 0.0, end: 5.0 }, 11, &[]);
    /// let system = System::Mechanism(Box::new(top));
    /// let run = simulate(&system, Method::ClosedForm, &timetable, &mut |_| ControlFlow::Continue(()));
    /// assert_eq!((run.steps, run.force_evaluations), (10, 0));
    /// assert!(run.history.drifts().energy.is_some_and(|drift| drift.max_relative < 1e-13));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
