//! Forces are checked once, when a mechanism gets them.

use super::{Force, ForceKind};
use crate::SimulationError;
use crate::expression::Expression;
use crate::joints::{Anchor, Mechanism, finite};

impl Mechanism {
    /// The mechanism with these forces besides gravity.
    ///
    /// # Errors
    /// [`SimulationError`] where a number is not finite, a stiffness, length or coefficient is negative, a coordinate does not
    /// exist, or a stored energy depends on rates.
    ///
    /// # Example
    /// A block of 2 kg on a rail and a spring of 8 N/m, 1 m from its rest: q̈ = −4 m/s².
    /// ```
    /// use piola_simulation::forces::{Force, ForceKind};
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// let slide = Coordinate { name: "slide".into(), angular: false, position: 1.0, velocity: 0.0 };
    /// let motion = JointMotion::Prismatic([1.0, 0.0, 0.0]);
    /// let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![slide] };
    /// let block = Part { joint: 0, name: "block".into(), at: [0.0; 3], kind: PartKind::Particle(2.0) };
    /// let kind = ForceKind::JointSpring { coordinate: 0, stiffness: 8.0, rest: 0.0, damping: 0.5 };
    /// let spring = Force { name: "spring".into(), kind };
    /// let block = Mechanism::new(vec![joint], vec![block], [0.0; 3])?.with_forces(vec![spring])?;
    /// assert_eq!(block.lagrangian().acceleration(&[1.0], &[0.0], 0.0)?[0], -4.0);
    /// assert_eq!(block.lagrangian().energies(&[1.0], &[0.0], 0.0)?.potential, 4.0);
    /// assert_eq!(block.forces[0].kind.power(&block.tree, &[1.0], &[2.0], 0.0), -2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_forces(mut self, forces: Vec<Force>) -> Result<Self, SimulationError> {
        let coordinates = self.tree.freedom();
        for force in &forces {
            check(&force.kind, coordinates)?;
            for anchor in force.kind.anchors() {
                self.tree.holds(anchor)?;
            }
        }
        self.forces = forces;
        Ok(self)
    }
}

impl ForceKind {
    fn anchors(&self) -> Vec<&Anchor> {
        match self {
            Self::Spring { ends, .. } => ends.iter().collect(),
            Self::Uniform { points, .. } | Self::Central { points, .. } => {
                points.iter().map(|(anchor, _)| anchor).collect()
            }
            Self::Drag { points, .. } => points.iter().collect(),
            Self::JointSpring { .. } | Self::Motor { .. } | Self::Potential { .. } => Vec::new(),
        }
    }
}

fn check(kind: &ForceKind, coordinates: usize) -> Result<(), SimulationError> {
    match kind {
        ForceKind::Spring { stiffness, length, damping, .. } => {
            not_negative([("stiffness", *stiffness), ("length", *length), ("damping", *damping)])
        }
        ForceKind::JointSpring { coordinate, stiffness, rest, damping } => {
            exists("joint spring", *coordinate, coordinates)?;
            finite("rest", [*rest])?;
            not_negative([("stiffness", *stiffness), ("damping", *damping)])
        }
        ForceKind::Uniform { points, field } => {
            finite("field", *field)?;
            finite("weight", points.iter().map(|(_, weight)| *weight))
        }
        ForceKind::Central { points, centre, gm } => {
            finite("centre", *centre)?;
            finite("gm", [*gm])?;
            finite("mass", points.iter().map(|(_, mass)| *mass))
        }
        ForceKind::Drag { linear, quadratic, wind, .. } => {
            finite("wind", *wind)?;
            not_negative([("linear drag", *linear), ("quadratic drag", *quadratic)])
        }
        ForceKind::Motor { coordinate, force } => {
            exists("motor", *coordinate, coordinates)?;
            in_coordinates("force", force, coordinates)
        }
        ForceKind::Potential { energy } => {
            in_coordinates("energy", energy, coordinates)?;
            match energy.conjugates().checked_sub(1) {
                Some(coordinate) => Err(SimulationError::DependsOnRate { quantity: "energy", coordinate }),
                None => Ok(()),
            }
        }
    }
}

/// Whether the variables of an expression are those of a system of so many coordinates.
pub(crate) fn in_coordinates(
    quantity: &'static str,
    expression: &Expression,
    coordinates: usize,
) -> Result<(), SimulationError> {
    let most = expression.coordinates().max(expression.conjugates());
    most.checked_sub(1).map_or(Ok(()), |last| exists(quantity, last, coordinates))
}

pub(crate) fn exists(quantity: &'static str, coordinate: usize, coordinates: usize) -> Result<(), SimulationError> {
    if coordinate < coordinates {
        Ok(())
    } else {
        Err(SimulationError::NoSuchCoordinate { quantity, coordinate, coordinates })
    }
}

fn not_negative<const N: usize>(quantities: [(&'static str, f64); N]) -> Result<(), SimulationError> {
    for (quantity, value) in quantities {
        finite(quantity, [value])?;
        if value < 0.0 {
            return Err(SimulationError::Negative { quantity, value });
        }
    }
    Ok(())
}
