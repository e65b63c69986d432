//! Forces as data.

use crate::expression::Expression;
use crate::joints::Anchor;

/// A force with its name.
///
/// # Example
/// See [`Mechanism::with_forces`](crate::joints::Mechanism::with_forces).
#[derive(Debug, Clone, PartialEq)]
pub struct Force {
    /// Name.
    pub name: String,
    /// What it does.
    pub kind: ForceKind,
}

/// A point with the factor of the force there.
///
/// # Example
/// See [`ForceKind`].
pub type Weighted = (Anchor, f64);

/// Kinds of forces.
///
/// # Example
/// See [`Mechanism::with_forces`](crate::joints::Mechanism::with_forces).
#[derive(Debug, Clone, PartialEq)]
pub enum ForceKind {
    /// A spring with a damper between two points: V = ½ k (r − l)², and −c ṙ along the line.
    Spring {
        /// Its ends.
        ends: [Anchor; 2],
        /// Stiffness k, N/m.
        stiffness: f64,
        /// Length l without force, m.
        length: f64,
        /// Damping c, N s/m.
        damping: f64,
    },
    /// A spring with a damper on one coordinate: V = ½ k (q − r)², and −c q̇.
    JointSpring {
        /// The coordinate.
        coordinate: usize,
        /// Stiffness k, N/m or N m/rad.
        stiffness: f64,
        /// Value r of the coordinate without force, m or rad.
        rest: f64,
        /// Damping c, N s/m or N m s/rad.
        damping: f64,
    },
    /// A uniform field: V = −Σ w f·x.
    Uniform {
        /// Points with their weights w: masses for an acceleration f, 1 for a force.
        points: Vec<Weighted>,
        /// f in space.
        field: [f64; 3],
    },
    /// Attraction by a fixed centre: V = −Σ m μ/|x − c|.
    Central {
        /// Points with their masses m, kg.
        points: Vec<Weighted>,
        /// Centre c, m.
        centre: [f64; 3],
        /// Gravitational parameter μ, m³/s².
        gm: f64,
    },
    /// Drag in a medium: −(c₁ + c₂ |u|) u with u = v − w.
    Drag {
        /// The points on which it acts.
        points: Vec<Anchor>,
        /// Coefficient c₁, kg/s.
        linear: f64,
        /// Coefficient c₂, kg/m.
        quadratic: f64,
        /// Velocity w of the medium, m/s.
        wind: [f64; 3],
    },
    /// A generalised force on one coordinate, N or N m.
    Motor {
        /// The coordinate.
        coordinate: usize,
        /// The force as an expression of coordinates, rates and time.
        force: Expression,
    },
    /// Stored energy V(q, t), J.
    Potential {
        /// The energy as an expression of coordinates and time.
        energy: Expression,
    },
}
