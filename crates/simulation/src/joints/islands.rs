//! The independent parts of a mechanism: what shares no coordinate, force or constraint.

use super::{Anchor, Mechanism};
use crate::constraints::{Constraint, ConstraintKind};
use crate::expression::{Expression, ExpressionNode, Variable};
use crate::forces::{Force, ForceKind};

/// A part of a mechanism that moves by itself.
///
/// # Example
/// See [`Mechanism::islands`].
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Island {
    /// The part by itself.
    pub mechanism: Mechanism,
    /// Its particles and bodies, by their index in the whole.
    pub parts: Vec<usize>,
    /// Its coordinates, by their index in the whole.
    pub coordinates: Vec<usize>,
    /// Its forces, by their index in the whole.
    pub(crate) forces: Vec<usize>,
    /// Its constraints, by their index in the whole.
    pub(crate) constraints: Vec<usize>,
}

/// Which joint carries what moves, and which island that belongs to.
struct Grouping {
    /// The first moving joint on the path from the ground to each joint.
    carriers: Vec<Option<usize>>,
    /// The joint that owns each coordinate.
    owners: Vec<usize>,
    /// A joint of the same island, the joint itself at the end.
    leaders: Vec<usize>,
}

impl Grouping {
    fn of(system: &Mechanism) -> Self {
        let joints = &system.tree.joints;
        let mut carriers = vec![None; joints.len()];
        let mut owners = vec![0; system.tree.freedom];
        let mut stack: Vec<usize> = system.tree.roots.clone();
        while let Some(joint) = stack.pop() {
            let node = &joints[joint];
            let above = node.parent.and_then(|parent| carriers[parent]);
            carriers[joint] = above.or_else(|| (0 < node.motion.freedom()).then_some(joint));
            owners[node.first..node.first + node.motion.freedom()].fill(joint);
            stack.extend(&node.children);
        }
        let mut grouping = Self { carriers, owners, leaders: (0..joints.len()).collect() };
        for Force { kind, .. } in &system.forces {
            match kind {
                ForceKind::Spring { ends, .. } => grouping.unite_ends(system, ends),
                // On one coordinate, or on each point by itself.
                ForceKind::JointSpring { .. }
                | ForceKind::Uniform { .. }
                | ForceKind::Central { .. }
                | ForceKind::Drag { .. } => {}
                ForceKind::Motor { coordinate, force } => grouping.unite(variables(force).chain([*coordinate])),
                ForceKind::Potential { energy } => grouping.unite(variables(energy)),
            }
        }
        for Constraint { kind, .. } in &system.constraints {
            match kind {
                ConstraintKind::Distance { ends, .. } | ConstraintKind::Loop { ends } => {
                    grouping.unite_ends(system, ends);
                }
                ConstraintKind::Rolling { .. } | ConstraintKind::Prescribed { .. } => {}
            }
        }
        grouping
    }

    fn unite_ends(&mut self, system: &Mechanism, ends: &[Anchor; 2]) {
        self.unite(ends.iter().flat_map(|end| system.tree.coordinates_of(end)));
    }

    fn unite(&mut self, mut coordinates: impl Iterator<Item = usize>) {
        let Some(first) = coordinates.next() else { return };
        for other in coordinates {
            let (one, other) = (self.island(first), self.island(other));
            self.leaders[one.max(other)] = one.min(other);
        }
    }

    /// The leader of the island of a coordinate.
    fn island(&self, coordinate: usize) -> usize {
        let mut joint = self.carriers[self.owners[coordinate]].unwrap_or_default();
        while self.leaders[joint] != joint {
            joint = self.leaders[joint];
        }
        joint
    }
}

/// The coordinates in an expression, by themselves or by their rates.
fn variables(expression: &Expression) -> impl Iterator<Item = usize> + '_ {
    expression.nodes().iter().filter_map(|node| match node {
        ExpressionNode::Variable(Variable::Coordinate(i) | Variable::Conjugate(i)) => Some(*i),
        _ => None,
    })
}

impl Mechanism {
    /// The parts of the mechanism that share no coordinate, force or constraint: each moves as if the others were not there. What
    /// stands still is in the first one. A force on many points acts in each on its own points.
    ///
    /// # Example
    /// Two pendulums side by side.
    /// ```
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// let joint = |name: &str| Joint {
    ///     parent: None,
    ///     offset: [0.0; 3],
    ///     motion: JointMotion::Revolute([0.0, 1.0, 0.0]),
    ///     coordinates: vec![Coordinate { name: name.into(), angular: true, position: 0.1, velocity: 0.0 }],
    /// };
    /// let bob = |joint: usize| {
    ///     Part { joint, name: joint.to_string(), at: [0.0, 0.0, -1.0], kind: PartKind::Particle(1.0) }
    /// };
    /// let two = Mechanism::new(vec![joint("left"), joint("right")], vec![bob(0), bob(1)], [0.0, 0.0, -9.81])?;
    /// let islands = two.islands();
    /// assert_eq!(islands.len(), 2);
    /// assert_eq!((&islands[1].parts, &islands[1].mechanism.coordinates), (&vec![1], &vec!["right".to_string()]));
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    #[must_use]
    pub fn islands(&self) -> Vec<Island> {
        let grouping = Grouping::of(self);
        let mut leaders: Vec<usize> = (0..self.tree.freedom).map(|coordinate| grouping.island(coordinate)).collect();
        let of_coordinates = leaders.clone();
        leaders.sort_unstable();
        leaders.dedup();
        if leaders.len() < 2 {
            let (parts, coordinates) = ((0..self.parts.len()).collect(), (0..self.tree.freedom).collect());
            let (forces, constraints) = ((0..self.forces.len()).collect(), (0..self.constraints.len()).collect());
            return vec![Island { mechanism: self.clone(), parts, coordinates, forces, constraints }];
        }
        // The island of each coordinate, and of each joint: that of the ground is the first one.
        let place = |leader: usize| leaders.iter().position(|other| *other == leader).unwrap_or_default();
        let of_coordinates: Vec<usize> = of_coordinates.into_iter().map(place).collect();
        let of_joints: Vec<Option<usize>> = grouping
            .carriers
            .iter()
            .map(|carrier| carrier.map(|carrier| of_coordinates[self.tree.joints[carrier].first]))
            .collect();
        (0..leaders.len()).map(|island| self.island(island, &of_coordinates, &of_joints)).collect()
    }

    fn island(&self, island: usize, of_coordinates: &[usize], of_joints: &[Option<usize>]) -> Island {
        let coordinates: Vec<usize> =
            (0..of_coordinates.len()).filter(|coordinate| of_coordinates[*coordinate] == island).collect();
        let numbered =
            |coordinate: usize| coordinates.iter().position(|other| *other == coordinate).unwrap_or_default();
        let is_here = |joint: usize| of_joints[joint].is_none_or(|other| other == island);
        let has_parts = |joint: usize| of_joints[joint].unwrap_or(0) == island;
        let mut mechanism = self.clone();
        let Mechanism { tree, .. } = &mut mechanism;
        tree.freedom = coordinates.len();
        tree.roots.retain(|root| is_here(*root));
        for (joint, node) in tree.joints.iter_mut().enumerate() {
            node.children.retain(|child| is_here(*child));
            node.first = coordinates.iter().filter(|coordinate| **coordinate < node.first).count();
            if !has_parts(joint) {
                node.parts.clear();
            }
        }
        let mut parts = Vec::new();
        let (mut stack, mut next): (Vec<usize>, usize) = (self.tree.roots.iter().rev().copied().collect(), 0);
        while let Some(joint) = stack.pop() {
            let node = &self.tree.joints[joint];
            if has_parts(joint) {
                parts.extend(next..next + node.parts.len());
            }
            next += node.parts.len();
            stack.extend(node.children.iter().rev());
        }
        // What moves with no coordinate is in the first island.
        let here = |coordinate: Option<usize>| coordinate.map_or(0, |coordinate| of_coordinates[coordinate]) == island;
        let moved = |anchors: &[Anchor]| anchors.iter().flat_map(|anchor| self.tree.coordinates_of(anchor)).next();
        let force = |(index, Force { name, kind }): (usize, &Force)| {
            let kind = restricted(kind, &moved, &here, &numbered)?;
            Some((index, Force { name: name.clone(), kind }))
        };
        let forces;
        (forces, mechanism.forces) = self.forces.iter().enumerate().filter_map(force).unzip();
        let holds_here = |kind: &ConstraintKind| match kind {
            ConstraintKind::Distance { ends, .. } | ConstraintKind::Loop { ends } => here(moved(ends)),
            ConstraintKind::Rolling { centre, .. } => here(moved(core::slice::from_ref(centre))),
            ConstraintKind::Prescribed { coordinate, .. } => here(Some(*coordinate)),
        };
        let constraints: Vec<usize> =
            (0..self.constraints.len()).filter(|i| holds_here(&self.constraints[*i].kind)).collect();
        mechanism.constraints = constraints.iter().map(|i| self.constraints[*i].clone()).collect();
        for Constraint { kind, .. } in &mut mechanism.constraints {
            if let ConstraintKind::Prescribed { coordinate, .. } = kind {
                *coordinate = numbered(*coordinate);
            }
        }
        mechanism.parts = parts.iter().map(|part| self.parts[*part].clone()).collect();
        mechanism.coordinates = coordinates.iter().map(|i| self.coordinates[*i].clone()).collect();
        mechanism.angular = coordinates.iter().map(|i| self.angular[*i]).collect();
        mechanism.position = coordinates.iter().map(|i| self.position[*i]).collect();
        mechanism.velocity = coordinates.iter().map(|i| self.velocity[*i]).collect();
        Island { mechanism, parts, coordinates, forces, constraints }
    }
}

/// What a force is in an island, of its points or coordinates there; nothing where it has none. `moved` gives a coordinate that moves
/// some of the anchors, `here` whether it is of this island.
fn restricted(
    kind: &ForceKind,
    moved: &dyn Fn(&[Anchor]) -> Option<usize>,
    here: &dyn Fn(Option<usize>) -> bool,
    numbered: &dyn Fn(usize) -> usize,
) -> Option<ForceKind> {
    let renamed = |expression: &Expression| {
        expression.with_variables(|variable| match variable {
            Variable::Coordinate(i) => Variable::Coordinate(numbered(i)),
            Variable::Conjugate(i) => Variable::Conjugate(numbered(i)),
            Variable::Time => Variable::Time,
        })
    };
    let is_here = |anchor: &Anchor| here(moved(core::slice::from_ref(anchor)));
    let mut kind = kind.clone();
    let acts = match &mut kind {
        ForceKind::Spring { ends, .. } => here(moved(ends)),
        ForceKind::JointSpring { coordinate, .. } => {
            let acts = here(Some(*coordinate));
            *coordinate = numbered(*coordinate);
            acts
        }
        ForceKind::Uniform { points, .. } | ForceKind::Central { points, .. } => {
            points.retain(|(anchor, _)| is_here(anchor));
            !points.is_empty()
        }
        ForceKind::Drag { points, .. } => {
            points.retain(is_here);
            !points.is_empty()
        }
        ForceKind::Motor { coordinate, force } => {
            let acts = here(Some(*coordinate));
            (*coordinate, *force) = (numbered(*coordinate), renamed(force));
            acts
        }
        ForceKind::Potential { energy } => {
            let acts = here(variables(energy).next());
            *energy = renamed(energy);
            acts
        }
    };
    acts.then_some(kind)
}
