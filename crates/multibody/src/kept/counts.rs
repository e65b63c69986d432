//! How much the last call computed.

use core::fmt;

/// How much the last call of a [`KeptDynamics`](crate::KeptDynamics) computed, of how many links.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DynamicsCounts {
    /// The links of the tree.
    pub links: usize,
    /// Links whose turn and place in the parent were computed, sines and cosines.
    pub places: usize,
    /// Links whose motion was computed from that of the parent.
    pub motions: usize,
    /// Articulated inertias that were reduced by a joint and moved to the parent: of forward dynamics.
    pub inertias: usize,
    /// Links whose forces were summed and moved to the parent.
    pub forces: usize,
    /// Links whose acceleration was computed from that of the parent: of forward dynamics.
    pub accelerations: usize,
}

impl fmt::Display for DynamicsCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { links, places, motions, inertias, forces, accelerations } = self;
        write!(
            f,
            "of {links} links computed: {places} places, {motions} motions, {inertias} articulated inertias, {forces} forces, \
             {accelerations} accelerations"
        )
    }
}
