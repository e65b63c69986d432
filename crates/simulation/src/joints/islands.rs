//! The independent parts of a mechanism: what shares no coordinate, force or constraint.

use super::{Anchor, JointTree, Mechanism, Node};
use crate::constraints::{Constraint, ConstraintKind};
use crate::expression::{Expression, ExpressionNode, Variable};
use crate::forces::{Force, ForceKind, Weighted};

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
        // Only what is here is copied: the joints get new numbers.
        let joints: Vec<usize> = (0..self.tree.joints.len()).filter(|joint| is_here(*joint)).collect();
        let joint_number = |joint: usize| joints.binary_search(&joint).unwrap_or_default();
        let joint_numbers =
            |all: &[usize]| all.iter().copied().filter(|joint| is_here(*joint)).map(joint_number).collect::<Vec<_>>();
        let node = |&joint: &usize| {
            let Node { parent, offset, motion, first, ref children, ref parts } = self.tree.joints[joint];
            Node {
                parent: parent.map(joint_number),
                offset,
                motion,
                first: coordinates.partition_point(|coordinate| *coordinate < first),
                children: joint_numbers(children),
                parts: if has_parts(joint) { parts.clone() } else { Vec::new() },
            }
        };
        let tree = JointTree {
            joints: joints.iter().map(node).collect(),
            roots: joint_numbers(&self.tree.roots),
            freedom: coordinates.len(),
        };
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
            let kind = restricted(kind, &moved, &here, (&numbered, &joint_number))?;
            Some((index, Force { name: name.clone(), kind }))
        };
        let (forces, forces_here): (Vec<usize>, Vec<Force>) = self.forces.iter().enumerate().filter_map(force).unzip();
        let holds_here = |kind: &ConstraintKind| match kind {
            ConstraintKind::Distance { ends, .. } | ConstraintKind::Loop { ends } => here(moved(ends)),
            ConstraintKind::Rolling { centre, .. } => here(moved(core::slice::from_ref(centre))),
            ConstraintKind::Prescribed { coordinate, .. } => here(Some(*coordinate)),
        };
        let constraints: Vec<usize> =
            (0..self.constraints.len()).filter(|i| holds_here(&self.constraints[*i].kind)).collect();
        let mut constraints_here: Vec<Constraint> = constraints.iter().map(|i| self.constraints[*i].clone()).collect();
        for Constraint { kind, .. } in &mut constraints_here {
            match kind {
                ConstraintKind::Prescribed { coordinate, .. } => *coordinate = numbered(*coordinate),
                ConstraintKind::Distance { ends, .. } | ConstraintKind::Loop { ends } => {
                    for end in ends {
                        end.renumber(&joint_number);
                    }
                }
                ConstraintKind::Rolling { centre, .. } => centre.renumber(&joint_number),
            }
        }
        let mechanism = Mechanism {
            tree,
            parts: parts.iter().map(|part| self.parts[*part].clone()).collect(),
            coordinates: coordinates.iter().map(|i| self.coordinates[*i].clone()).collect(),
            angular: coordinates.iter().map(|i| self.angular[*i]).collect(),
            gravity: self.gravity,
            position: coordinates.iter().map(|i| self.position[*i]).collect(),
            velocity: coordinates.iter().map(|i| self.velocity[*i]).collect(),
            forces: forces_here,
            constraints: constraints_here,
            simplify: self.simplify,
            reactions: self.reactions,
            questions: self.questions,
        };
        Island { mechanism, parts, coordinates, forces, constraints }
    }
}

/// What a force is in an island, of its points or coordinates there; nothing where it has none. `moved` gives a coordinate that moves
/// some of the anchors, `here` whether it is of this island.
fn restricted(
    kind: &ForceKind,
    moved: &dyn Fn(&[Anchor]) -> Option<usize>,
    here: &dyn Fn(Option<usize>) -> bool,
    (numbered, joint_number): (&dyn Fn(usize) -> usize, &dyn Fn(usize) -> usize),
) -> Option<ForceKind> {
    let renamed = |expression: &Expression| {
        expression.with_variables(|variable| match variable {
            Variable::Coordinate(i) => Variable::Coordinate(numbered(i)),
            Variable::Conjugate(i) => Variable::Conjugate(numbered(i)),
            Variable::Time => Variable::Time,
        })
    };
    let is_here = |anchor: &Anchor| here(moved(core::slice::from_ref(anchor)));
    let anchored = |anchor: &Anchor| {
        let mut anchor = anchor.clone();
        anchor.renumber(joint_number);
        anchor
    };
    let weighted = |points: &[Weighted]| -> Vec<Weighted> {
        let own = points.iter().filter(|(anchor, _)| is_here(anchor));
        own.map(|(anchor, weight)| (anchored(anchor), *weight)).collect()
    };
    let (acts, kind) = match *kind {
        ForceKind::Spring { ref ends, stiffness, length, damping } => {
            if !here(moved(ends)) {
                return None;
            }
            let ends = ends.each_ref().map(anchored);
            (true, ForceKind::Spring { ends, stiffness, length, damping })
        }
        ForceKind::JointSpring { coordinate, stiffness, rest, damping } => {
            let kind = ForceKind::JointSpring { coordinate: numbered(coordinate), stiffness, rest, damping };
            (here(Some(coordinate)), kind)
        }
        ForceKind::Uniform { ref points, field } => {
            let points = weighted(points);
            (!points.is_empty(), ForceKind::Uniform { points, field })
        }
        ForceKind::Central { ref points, centre, gm } => {
            let points = weighted(points);
            (!points.is_empty(), ForceKind::Central { points, centre, gm })
        }
        ForceKind::Drag { ref points, linear, quadratic, wind } => {
            let points: Vec<Anchor> = points.iter().filter(|point| is_here(point)).map(anchored).collect();
            (!points.is_empty(), ForceKind::Drag { points, linear, quadratic, wind })
        }
        ForceKind::Motor { coordinate, ref force } => {
            (here(Some(coordinate)), ForceKind::Motor { coordinate: numbered(coordinate), force: renamed(force) })
        }
        ForceKind::Potential { ref energy } => {
            (here(variables(energy).next()), ForceKind::Potential { energy: renamed(energy) })
        }
    };
    acts.then_some(kind)
}
