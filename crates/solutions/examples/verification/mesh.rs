//! A structured mesh of hexahedra over a box of reference coordinates.

/// Elements along each coordinate: even, so that every second node is a corner of an element of second order.
pub(crate) const ELEMENTS: usize = 4;
/// Nodes along each coordinate.
pub(crate) const NODES: usize = ELEMENTS + 1;

/// The ranges of the three reference coordinates, m or rad.
pub(crate) type Ranges = [[f64; 2]; 3];

/// The reference coordinates of all nodes: the first coordinate runs fastest.
pub(crate) fn nodes(ranges: &Ranges) -> Vec<[f64; 3]> {
    let along = |range: [f64; 2], k: usize| range[0] + (range[1] - range[0]) * (k as f64 / ELEMENTS as f64);
    let mut nodes = Vec::with_capacity(NODES * NODES * NODES);
    for k in 0..NODES {
        for j in 0..NODES {
            for i in 0..NODES {
                nodes.push([along(ranges[0], i), along(ranges[1], j), along(ranges[2], k)]);
            }
        }
    }
    nodes
}

/// The number of a node.
pub(crate) const fn node(i: usize, j: usize, k: usize) -> usize {
    i + NODES * (j + NODES * k)
}

/// The eight nodes of each element: the face of the lower third coordinate first, counter-clockwise.
pub(crate) fn elements() -> Vec<[usize; 8]> {
    let mut elements = Vec::with_capacity(ELEMENTS * ELEMENTS * ELEMENTS);
    for k in 0..ELEMENTS {
        for j in 0..ELEMENTS {
            for i in 0..ELEMENTS {
                let ring = |k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
                let [[a, b, c, d], [e, f, g, h]] = [ring(k), ring(k + 1)];
                elements.push([a, b, c, d, e, f, g, h]);
            }
        }
    }
    elements
}

/// A quadrilateral of the surface.
pub(crate) struct Face {
    /// The coordinate that is constant on it.
    pub(crate) axis: usize,
    /// Whether it is at the upper end of that coordinate.
    pub(crate) upper: bool,
    /// Its nodes, counter-clockwise seen from outside where the coordinates are right-handed.
    pub(crate) nodes: [usize; 4],
    /// The middle of its range in units of an element.
    middle: [f64; 3],
}

impl Face {
    /// The reference coordinates of its middle.
    pub(crate) fn middle(&self, ranges: &Ranges) -> [f64; 3] {
        core::array::from_fn(|k| {
            let [from, to] = ranges[k];
            from + (to - from) * (self.middle[k] / ELEMENTS as f64)
        })
    }
}

/// All quadrilaterals of the surface.
pub(crate) fn faces() -> Vec<Face> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
        for upper in [false, true] {
            for b in 0..ELEMENTS {
                for a in 0..ELEMENTS {
                    let corner = |da: usize, db: usize| {
                        let mut index = [0; 3];
                        index[axis] = if upper { ELEMENTS } else { 0 };
                        index[second] = a + da;
                        index[third] = b + db;
                        node(index[0], index[1], index[2])
                    };
                    let around = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    let nodes = if upper { around } else { [around[0], around[3], around[2], around[1]] };
                    let mut middle = [0.0; 3];
                    middle[axis] = if upper { ELEMENTS as f64 } else { 0.0 };
                    middle[second] = a as f64 + 0.5;
                    middle[third] = b as f64 + 0.5;
                    faces.push(Face { axis, upper, nodes, middle });
                }
            }
        }
    }
    faces
}
