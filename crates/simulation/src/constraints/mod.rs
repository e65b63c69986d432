//! Constraints on mechanisms, made of data: distances, closed loops, prescribed motions.
//!
//! ```text
//! φ(q, t) = 0        M q̈ + Gᵀ λ = f,   G = ∂φ/∂q
//! ```
//! Multipliers λ are found with the accelerations ([`piola_lagrangian::constraints`]); their signs are turned so that they are
//! the forces of [`Mechanism::condition_names`].

mod kinds;
mod rolling;

pub use kinds::{Constraint, ConstraintKind};
pub(crate) use rolling::{RollingFrame, RollingMechanism};

use piola_lagrangian::constraints::{Constrained, Constraints};
use piola_numerics::Real;

use crate::SimulationError;
use crate::expression::Variable;
use crate::forces::{AppliedForces, MechanismPotential, exists};
use crate::joints::{Anchor, JointTree, Mechanism, finite};

/// All constraints of a mechanism.
///
/// # Example
/// See [`Mechanism::with_constraints`].
#[derive(Debug, Clone, Copy)]
pub struct MechanismConstraints<'m>(pub(crate) &'m Mechanism);

/// The equations of a mechanism with its constraints.
///
/// # Example
/// See [`Mechanism::with_constraints`].
pub type ConstrainedMechanism<'m> =
    Constrained<&'m JointTree, MechanismPotential<'m>, AppliedForces<'m>, MechanismConstraints<'m>>;

impl Mechanism {
    /// The mechanism under these constraints.
    ///
    /// # Errors
    /// [`SimulationError`] where a length is not positive, a coordinate or joint does not exist, or a prescribed motion depends
    /// on coordinates or rates. Where bodies roll: a disc that lies flat at the start, or a rate that is not zero and differs from
    /// the one that follows from the free rates.
    ///
    /// # Example
    /// A mass of 2 kg on a vertical rail, lifted by 3 t²: the drive carries 2 kg (10 + 6) m/s² = 32 N.
    /// ```
    /// use piola_simulation::constraints::{Constraint, ConstraintKind};
    /// use piola_simulation::expression::{Expression, ExpressionNode as Node, Operation, Variable};
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// let lift = Coordinate { name: "lift".into(), angular: false, position: 0.0, velocity: 0.0 };
    /// let motion = JointMotion::Prismatic([0.0, 0.0, 1.0]);
    /// let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![lift] };
    /// let mass = Part { joint: 0, name: "mass".into(), at: [0.0; 3], kind: PartKind::Particle(2.0) };
    /// let motion = Expression::new(vec![
    ///     Node::Constant(3.0),
    ///     Node::Variable(Variable::Time),
    ///     Node::WholePower(1, 2),
    ///     Node::Operation(Operation::Product, 0, 2),
    /// ])?;
    /// let drive = Constraint { name: "drive".into(), kind: ConstraintKind::Prescribed { coordinate: 0, motion } };
    /// let lift = Mechanism::new(vec![joint], vec![mass], [0.0, 0.0, -10.0])?.with_constraints(vec![drive])?;
    /// assert_eq!(lift.condition_names(), ["drive of drive (N)"]);
    /// assert_eq!(-lift.constrained().multipliers(&[0.0], &[0.0], 0.0)?[0], 32.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_constraints(mut self, constraints: Vec<Constraint>) -> Result<Self, SimulationError> {
        let coordinates = self.tree.freedom();
        for Constraint { kind, .. } in &constraints {
            match kind {
                ConstraintKind::Distance { ends, length } => {
                    finite("length", [*length])?;
                    if *length <= 0.0 {
                        return Err(SimulationError::NotPositive { quantity: "length", value: *length });
                    }
                    ends.iter().try_for_each(|end| self.tree.holds(end))?;
                }
                ConstraintKind::Loop { ends } => ends.iter().try_for_each(|end| self.tree.holds(end))?,
                ConstraintKind::Rolling { centre, radius, axis, normal } => {
                    finite("radius", [*radius])?;
                    if *radius <= 0.0 {
                        return Err(SimulationError::NotPositive { quantity: "radius", value: *radius });
                    }
                    for direction in axis.iter().chain([normal]) {
                        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
                        let is_unit = (length - 1.0).abs() <= 1e-12;
                        if !is_unit {
                            return Err(SimulationError::NoUnitVector { quantity: "direction of rolling", length });
                        }
                    }
                    self.tree.holds(centre)?;
                }
                ConstraintKind::Prescribed { coordinate, motion } => {
                    exists("prescribed motion", *coordinate, coordinates)?;
                    let depends = motion.coordinates().max(motion.conjugates());
                    if let Some(coordinate) = depends.checked_sub(1) {
                        return Err(SimulationError::DependsOnCoordinate { quantity: "prescribed motion", coordinate });
                    }
                }
            }
        }
        let rolling = constraints.iter().filter(|constraint| matches!(constraint.kind, ConstraintKind::Rolling { .. }));
        if (1..constraints.len()).contains(&rolling.count()) {
            return Err(SimulationError::RollingWithOthers);
        }
        self.constraints = constraints;
        if self.rolls() {
            self.rolling_start()?;
        }
        Ok(self)
    }

    /// The equations of the mechanism with gravity, its forces and its constraints on coordinates.
    ///
    /// Rolling is no constraint on coordinates and is left out: where a body [rolls](Self::rolls), these are the equations of the
    /// mechanism without its contacts. [`simulate`](crate::motion::simulate) keeps them.
    ///
    /// # Example
    /// See [`with_constraints`](Self::with_constraints).
    #[must_use]
    pub fn constrained(&self) -> ConstrainedMechanism<'_> {
        self.lagrangian().with_constraints(MechanismConstraints(self))
    }

    /// The force of each condition with its unit: the tension of a rod, the force on the first point of a loop, the force or
    /// torque of a drive, the force of the plane on a body that rolls.
    ///
    /// Where conditions depend on each other their forces are not determined. Those with the least sum of squares are recorded.
    ///
    /// # Example
    /// See [`with_constraints`](Self::with_constraints).
    #[must_use]
    pub fn condition_names(&self) -> Vec<String> {
        let names = self.constraints.iter().flat_map(|Constraint { name, kind }| match kind {
            ConstraintKind::Distance { .. } => vec![format!("tension of {name} (N)")],
            ConstraintKind::Loop { .. } | ConstraintKind::Rolling { .. } => {
                ["x", "y", "z"].iter().map(|axis| format!("force of {name} along {axis} (N)")).collect()
            }
            ConstraintKind::Prescribed { coordinate, .. } => {
                let unit = if self.angular.get(*coordinate) == Some(&true) { "N m" } else { "N" };
                vec![format!("drive of {name} ({unit})")]
            }
        });
        names.collect()
    }

    /// Turns multipliers into the forces of [`condition_names`](Self::condition_names).
    pub(crate) fn forces_of_conditions(&self, multipliers: &mut [f64]) {
        let mut first = 0;
        for Constraint { kind, .. } in &self.constraints {
            if matches!(kind, ConstraintKind::Prescribed { .. }) {
                multipliers[first] = -multipliers[first];
            }
            first += kind.conditions();
        }
    }

    /// Whether a constraint moves with time, so that its drive works.
    pub(crate) fn is_driven(&self) -> bool {
        self.constraints.iter().any(|constraint| matches!(constraint.kind, ConstraintKind::Prescribed { .. }))
    }
}

impl ConstraintKind {
    /// The number of conditions φ; none of what holds velocities alone.
    #[must_use]
    pub fn conditions(&self) -> usize {
        match self {
            Self::Distance { .. } | Self::Prescribed { .. } => 1,
            Self::Loop { .. } => 3,
            Self::Rolling { .. } => 0,
        }
    }

    /// The number of its forces in [`Mechanism::condition_names`].
    pub(crate) fn forces(&self) -> usize {
        if matches!(self, Self::Rolling { .. }) { 3 } else { self.conditions() }
    }
}

impl Constraints for MechanismConstraints<'_> {
    // Only prescribed motions do; for others the row of time is zero, and costs an addition a condition.
    const TIME_DEPENDENT: bool = true;

    fn count(&self) -> usize {
        self.0.constraints.iter().map(|constraint| constraint.kind.conditions()).sum()
    }

    fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]) {
        let tree = &self.0.tree;
        let place = |anchor: &Anchor| tree.place_of(anchor, &|i| q[i]);
        let mut first = 0;
        for Constraint { kind, .. } in &self.0.constraints {
            match kind {
                ConstraintKind::Distance { ends, length } => {
                    let [x, y, z] = (place(&ends[1]) - place(&ends[0])).into();
                    let excess = x * x + y * y + z * z - T::lit(length * length);
                    out[first] = excess * T::lit(0.5 / length);
                }
                ConstraintKind::Loop { ends } => {
                    let gap = place(&ends[1]) - place(&ends[0]);
                    for i in 0..3 {
                        out[first + i] = gap[i];
                    }
                }
                ConstraintKind::Rolling { .. } => {}
                ConstraintKind::Prescribed { coordinate, motion } => {
                    let prescribed = motion.evaluate(&|variable| match variable {
                        Variable::Time => t,
                        Variable::Coordinate(_) | Variable::Conjugate(_) => T::zero(), // refused when it is made
                    });
                    out[first] = q[*coordinate] - prescribed;
                }
            }
            first += kind.conditions();
        }
    }

    fn name(&self, constraint: usize) -> Option<&str> {
        let mut first = 0;
        self.0.constraints.iter().find_map(|Constraint { name, kind }| {
            first += kind.conditions();
            (constraint < first).then_some(name.as_str())
        })
    }
}
