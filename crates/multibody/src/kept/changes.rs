//! What differs from the last call, link by link.

use piola_numerics::Real;

use crate::tree::RigidTree;

/// Of a link, or the ground.
#[derive(Clone, Copy, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a question of its own")]
pub(super) struct Change {
    /// Its own coordinates differ.
    pub(super) place: bool,
    /// Its motion differs: one of the numbers that give it, on the way from the ground.
    pub(super) motion: bool,
    /// The place of a link beyond it differs.
    pub(super) shape: bool,
    /// The forces that it needs differ: its motion, or what is given to it or beyond it.
    pub(super) force: bool,
    /// Its acceleration under forces differs.
    pub(super) acceleration: bool,
}

/// The arguments of the last call, and what differs from them.
#[derive(Clone, Debug)]
pub(super) struct Changes<T> {
    arguments: [Vec<T>; 3],
    /// Whether the results of the last call are there.
    pub(super) is_there: bool,
    /// The ground, which stays, then the links.
    pub(super) links: Vec<Change>,
}

impl<T: Real> Changes<T> {
    pub(super) fn of(tree: &RigidTree) -> Self {
        let vector = vec![T::zero(); tree.freedoms];
        Self {
            arguments: [vec![T::zero(); tree.coordinates], vector.clone(), vector],
            is_there: false,
            links: vec![Change::default(); tree.links.len() + 1],
        }
    }

    /// Compares q, v and a third argument with the last ones and stores them. The third one is an acceleration, which moves what is
    /// beyond, or a force, which does not.
    pub(super) fn compare(&mut self, tree: &RigidTree, given: [&[T]; 3], third_moves: bool) {
        let Self { arguments, is_there, links } = self;
        for (i, link) in tree.links.iter().enumerate() {
            let n = link.kind.freedoms();
            let differs = |k: usize, from: usize, count: usize| {
                let own = from..from + count;
                !*is_there || given[k][own.clone()] != arguments[k][own]
            };
            let place = differs(0, link.q, link.kind.coordinates());
            let third = differs(2, link.v, n);
            let motion = place || differs(1, link.v, n) || third_moves && third || links[link.parent].motion;
            links[i + 1] = Change { place, motion, force: motion || third, ..Change::default() };
        }
        for (i, link) in tree.links.iter().enumerate().rev() {
            let Change { place, shape, force, .. } = links[i + 1];
            let parent = &mut links[link.parent];
            parent.shape |= place || shape;
            parent.force |= force;
        }
        // No link moves the ground.
        links[0] = Change::default();
        for (i, link) in tree.links.iter().enumerate() {
            links[i + 1].acceleration = links[i + 1].force || links[link.parent].acceleration;
        }
        for (stored, given) in arguments.iter_mut().zip(given) {
            stored.copy_from_slice(given);
        }
    }
}
