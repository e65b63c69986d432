//! The configurations of a tree as a Lie group, for the methods that never leave it.

use piola_geometric::{LieGroup, RigidMotions, Rotations, Translations};
use piola_numerics::Real;

use crate::link::Kind;
use crate::tree::RigidTree;

/// The product of the groups of all joints: numbers, rotations, rigid motions. Its algebra is the space of v.
///
/// # Example
/// ```
/// use piola_geometric::LieGroup;
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeGroup, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let ball = BodyInertia::new(1.0, [0.0; 3], [[0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.4]])?;
/// builder.attach(BodyIndex::GROUND, TreeJoint::new("free", JointKind::Free), "ball", ball)?;
/// let tree = builder.build()?;
/// let group = TreeGroup(&tree);
/// assert_eq!((LieGroup::<f64>::element_length(&group), LieGroup::<f64>::dimension(&group)), (7, 6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TreeGroup<'a>(
    /// The tree.
    pub &'a RigidTree,
);

/// Calls a method of the group of a link's joint.
macro_rules! with_group {
    ($link:expr, $group:ident => $call:expr) => {
        match $link.kind {
            Kind::Spherical => {
                let $group = &Rotations;
                $call
            }
            Kind::Free => {
                let $group = &RigidMotions;
                $call
            }
            _ => {
                let $group = &Translations(1);
                $call
            }
        }
    };
}

impl<T: Real> LieGroup<T> for TreeGroup<'_> {
    fn element_length(&self) -> usize {
        self.0.coordinates
    }
    fn dimension(&self) -> usize {
        self.0.freedoms
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        for link in &self.0.links {
            let q = link.q..link.q + link.kind.coordinates();
            let displacement = &displacement[link.v..link.v + link.kind.freedoms()];
            with_group!(link, group => group.advance(&mut element[q.clone()], &mut carry[q], displacement));
        }
    }
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]) {
        for link in &self.0.links {
            let v = link.v..link.v + link.kind.freedoms();
            with_group!(link, group => group.inverse_differential(&displacement[v.clone()], &mut velocity[v]));
        }
    }
    fn renormalise(&self, element: &mut [T], carry: &mut [T]) {
        for link in &self.0.links {
            let q = link.q..link.q + link.kind.coordinates();
            with_group!(link, group => group.renormalise(&mut element[q.clone()], &mut carry[q]));
        }
    }
    /// One for angles and for displacements.
    fn magnitudes(&self, _element: &[T], magnitudes: &mut [f64]) {
        magnitudes.fill(1.0);
    }
    fn defect(&self, element: &[T]) -> Option<(usize, f64)> {
        self.0.links.iter().find_map(|link| {
            let element = &element[link.q..link.q + link.kind.coordinates()];
            let found = with_group!(link, group => group.defect(element));
            found.map(|(index, defect)| (index + link.q, defect))
        })
    }
}
