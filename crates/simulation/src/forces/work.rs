//! The power of forces: what enters or leaves the energy.

use super::{Force, ForceKind, drag, rate_of_distance, reader, velocity};
use crate::expression::Variable;
use crate::joints::{JointTree, Mechanism};

impl ForceKind {
    /// Whether it may take energy or give it.
    #[must_use]
    pub fn works(&self) -> bool {
        match self {
            Self::Spring { damping, .. } | Self::JointSpring { damping, .. } => 0.0 < *damping,
            Self::Drag { .. } | Self::Motor { .. } => true,
            Self::Potential { energy } => energy.depends_on_time(),
            Self::Uniform { .. } | Self::Central { .. } => false,
        }
    }

    /// The power that it brings into the system, W: negative of a damper.
    #[must_use]
    pub fn power(&self, tree: &JointTree, q: &[f64], v: &[f64], t: f64) -> f64 {
        match self {
            Self::Spring { ends, damping, .. } if 0.0 < *damping => {
                let rate = rate_of_distance(tree, ends, q, v);
                -damping * rate * rate
            }
            Self::JointSpring { coordinate, damping, .. } => -damping * v[*coordinate] * v[*coordinate],
            Self::Drag { points, linear, quadratic, wind } => {
                let power = |anchor| {
                    let velocity = velocity(tree, anchor, q, v);
                    let force = drag(velocity, *linear, *quadratic, *wind);
                    force[0] * velocity[0] + force[1] * velocity[1] + force[2] * velocity[2]
                };
                points.iter().map(power).sum()
            }
            Self::Motor { coordinate, force } => force.evaluate(&reader(q, v, t)) * v[*coordinate],
            Self::Potential { energy } if energy.depends_on_time() => {
                energy.partial(Variable::Time, &reader(q, v, t)).tangent
            }
            Self::Spring { .. } | Self::Uniform { .. } | Self::Central { .. } | Self::Potential { .. } => 0.0,
        }
    }
}

impl Mechanism {
    /// Names of the works that are integrated with the motion: of forces, then `prescribed motion` of all drives together.
    #[must_use]
    pub fn work_names(&self) -> Vec<String> {
        let forces = working(&self.forces).into_iter().map(|i| self.forces[i].name.clone());
        forces.chain(self.is_driven().then(|| "prescribed motion".to_string())).collect()
    }
}

impl Mechanism {
    /// The number of works.
    pub(crate) fn work_count(&self) -> usize {
        self.forces.iter().filter(|force| force.kind.works()).count() + usize::from(self.is_driven())
    }
}

/// The forces that work, by index.
pub(crate) fn working(forces: &[Force]) -> Vec<usize> {
    (0..forces.len()).filter(|&i| forces[i].kind.works()).collect()
}
