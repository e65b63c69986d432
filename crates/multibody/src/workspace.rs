//! The memory of the passes, made once for a tree.

use piola_numerics::Real;

use crate::error::MultibodyError;
use crate::freedoms::{DENSE, EIGHT, Eight, FOUR, is_plain};
use crate::link::Pair;
use crate::spatial::{Matrix, Symmetric, Vector};
use crate::tree::RigidTree;

/// Of a link in inverse dynamics: all in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkForces<T> {
    /// What the link's turn keeps.
    pub(crate) turn: Matrix<T>,
    /// The origin in the parent's frame.
    pub(crate) origin: Vector<T>,
    pub(crate) w: Vector<T>,
    pub(crate) alpha: Vector<T>,
    /// Of the origin, with gravity as an acceleration of the ground.
    pub(crate) a: Vector<T>,
    /// [α]× + [ω]×².
    pub(crate) gradient: Matrix<T>,
    /// Of the joint, about the origin.
    pub(crate) moment: Vector<T>,
    pub(crate) force: Vector<T>,
}

/// Of a link in forward dynamics: all in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkArticulation<T> {
    pub(crate) turn: Matrix<T>,
    pub(crate) origin: Vector<T>,
    pub(crate) w: Vector<T>,
    /// Accelerations at v̇ = 0.
    pub(crate) bias: Pair<T>,
    /// The moment and force at v̇ = 0 that the link needs; then its acceleration, angular and of the origin.
    pub(crate) needed: Pair<T>,
    /// What the children add to the inertia.
    pub(crate) j: Symmetric<T>,
    pub(crate) h: Matrix<T>,
    pub(crate) m: Symmetric<T>,
}

/// Of a link, in space axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkInSpace<T> {
    /// Takes components in the link's axes to space.
    pub(crate) axes: Matrix<T>,
    pub(crate) origin: Vector<T>,
    pub(crate) w: Vector<T>,
    /// Of the origin.
    pub(crate) velocity: Vector<T>,
    pub(crate) alpha: Vector<T>,
    /// Of the origin.
    pub(crate) acceleration: Vector<T>,
}

/// The inertia, the momentum and the forces of a link with all beyond it, in space axes about a reference point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Composite<T> {
    pub(crate) mass: T,
    pub(crate) moment: Vector<T>,
    pub(crate) inertia: Symmetric<T>,
    /// Σ (−[ω]× Σ − [h]× [v]×).
    pub(crate) velocity_product: Matrix<T>,
    pub(crate) momentum: Vector<T>,
    pub(crate) torque: Vector<T>,
    pub(crate) force: Vector<T>,
}

/// A column of space-fixed vectors for each freedom: components lie apart, so that lanes run along the freedoms.
#[derive(Clone, Debug)]
pub(crate) struct Rows<T> {
    pub(crate) rows: Vec<T>,
    pub(crate) stride: usize,
}

impl<T: Real> Rows<T> {
    fn new(rows: usize, freedoms: usize) -> Self {
        Self { rows: vec![T::zero(); rows * freedoms], stride: freedoms }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn row(&self, row: usize) -> &[T] {
        &self.rows[row * self.stride..(row + 1) * self.stride]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn put(&mut self, row: usize, freedom: usize, value: Vector<T>) {
        let from = row * self.stride + freedom;
        self.rows[from] = value[0];
        self.rows[from + self.stride] = value[1];
        self.rows[from + 2 * self.stride] = value[2];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn get(&self, row: usize, freedom: usize) -> Vector<T> {
        let from = row * self.stride + freedom;
        [self.rows[from], self.rows[from + self.stride], self.rows[from + 2 * self.stride]]
    }
}

/// The memory that evaluations of a tree need; after it is made, they allocate nothing.
///
/// # Example
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
/// let tree = builder.build()?;
/// let mut work = tree.workspace();
/// let mut acceleration = [0.0_f64];
/// // Released from the horizontal: g/l = 19.62 rad/s².
/// tree.forward_dynamics(&mut work, &[0.0], &[0.0], &[0.0], &mut acceleration)?;
/// assert!((acceleration[0] - 19.62).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreeWorkspace<T> {
    /// The ground, then the links.
    pub(crate) forces: Vec<LinkForces<T>>,
    pub(crate) articulation: Vec<LinkArticulation<T>>,
    pub(crate) space: Vec<LinkInSpace<T>>,
    pub(crate) composite: Vec<Composite<T>>,
    /// Articulated inertia times S D⁻¹, for each freedom.
    pub(crate) gains: Vec<Pair<T>>,
    /// D⁻¹ of each elementary joint.
    pub(crate) inverses: Vec<T>,
    /// Vectors in space for each freedom: see the modules that fill them.
    pub(crate) rows: Rows<T>,
    /// One number for each freedom.
    pub(crate) column: Vec<T>,
    /// Forces, then accelerations, of the links for several columns.
    pub(crate) column_states: Vec<ColumnState<T>>,
    /// Several columns for each freedom.
    pub(crate) column_values: Vec<[T; COLUMNS]>,
    pub(crate) column_vectors: Vec<ColumnVectors<T>>,
    /// Sines and cosines of the coordinates, eight and eight.
    pub(crate) turns: Vec<Eight<T, 2>>,
    /// S of the freedoms in space about the reference point, eight and eight.
    pub(crate) subspaces: Vec<Eight<T, 6>>,
    /// The same, freedom after freedom.
    pub(crate) motions: Vec<[T; 6]>,
    /// u₁ = 𝕀 S of each freedom and, for derivatives, the angular part of its u₄.
    pub(crate) felt: Vec<Eight<T, 9>>,
    pub(crate) vectors: Vec<FreedomVectors<T>>,
    pub(crate) dense: Dense<T>,
}

/// Memory for M⁻¹ and its products, for trees of up to [`DENSE`] freedoms. Matrices are stored by rows.
#[derive(Clone, Debug)]
pub(crate) struct Dense<T> {
    /// Sums on the way to the ground, for each freedom.
    pub(crate) sums: Vec<Eight<T, 6>>,
    /// U and D⁻¹ U.
    pub(crate) upper: Vec<Eight<T, 1>>,
    pub(crate) scaled: Vec<Eight<T, 1>>,
    pub(crate) inverse: Vec<Eight<T, 1>>,
    pub(crate) columns: Vec<[T; FOUR]>,
}

/// Of a freedom in derivatives, in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreedomVectors<T> {
    /// Ψ̈ and the angular part of Ψ̇, which meet u₁ and u₄ of the freedoms beyond.
    pub(crate) across_by_q: [T; 9],
    /// Ψ̇ + Ṡ and the angular part of S, which meet the same.
    pub(crate) across_by_v: [T; 9],
    /// u₁ and the angular part of u₄.
    pub(crate) felt: [T; 9],
    /// u₂ and u₃, which meet S of the freedoms nearer to the ground.
    pub(crate) second: [T; 6],
    pub(crate) third: [T; 6],
}

/// Columns that are solved at once.
pub(crate) const COLUMNS: usize = 8;

/// Six components of several columns.
pub(crate) type ColumnState<T> = [[T; COLUMNS]; 6];

/// S and Y of a freedom in space axes about the reference point, angular parts first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColumnVectors<T> {
    pub(crate) subspace: [T; 6],
    pub(crate) gain: [T; 6],
}

/// Numbers for each freedom in [`TreeWorkspace::rows`].
pub(crate) const ROWS: usize = 12;

impl<T: Real> Dense<T> {
    fn new(n: usize) -> Self {
        let matrix = || Eight::zeros(n * n.next_multiple_of(EIGHT));
        Self {
            sums: Eight::zeros(n),
            upper: matrix(),
            scaled: matrix(),
            inverse: matrix(),
            columns: vec![[T::zero(); FOUR]; n],
        }
    }
}

impl RigidTree {
    /// Memory for evaluations of this tree over any scalar.
    #[must_use]
    pub fn workspace<T: Real>(&self) -> TreeWorkspace<T> {
        let (states, n) = (self.links.len() + 1, self.freedoms);
        let (vector, matrix, symmetric) = ([T::zero(); 3], [[T::zero(); 3]; 3], [T::zero(); 6]);
        let (pair, s, nine) = ((vector, vector), symmetric, [T::zero(); 9]);
        let freedom = FreedomVectors { across_by_q: nine, across_by_v: nine, felt: nine, second: s, third: s };
        let forces = LinkForces {
            turn: matrix,
            origin: vector,
            w: vector,
            alpha: vector,
            a: vector,
            gradient: matrix,
            moment: vector,
            force: vector,
        };
        let articulation = LinkArticulation {
            turn: matrix,
            origin: vector,
            w: vector,
            bias: pair,
            needed: pair,
            j: symmetric,
            h: matrix,
            m: symmetric,
        };
        let mut axes = matrix;
        (axes[0][0], axes[1][1], axes[2][2]) = (T::one(), T::one(), T::one());
        let space =
            LinkInSpace { axes, origin: vector, w: vector, velocity: vector, alpha: vector, acceleration: vector };
        let composite = Composite {
            mass: T::zero(),
            moment: vector,
            inertia: symmetric,
            velocity_product: matrix,
            momentum: vector,
            torque: vector,
            force: vector,
        };
        TreeWorkspace {
            forces: vec![forces; states],
            articulation: vec![articulation; states],
            space: vec![space; states],
            composite: vec![composite; states],
            gains: vec![pair; n],
            inverses: vec![T::zero(); self.squares],
            rows: Rows::new(ROWS, n),
            column: vec![T::zero(); n],
            column_states: vec![[[T::zero(); COLUMNS]; 6]; states],
            column_values: vec![[T::zero(); COLUMNS]; n],
            column_vectors: vec![ColumnVectors { subspace: symmetric, gain: symmetric }; n],
            turns: Eight::zeros(self.coordinates),
            subspaces: Eight::zeros(n),
            motions: vec![symmetric; n],
            felt: Eight::zeros(n),
            vectors: vec![freedom; n],
            dense: Dense::new(if is_plain::<T>() && n <= DENSE { n } else { 0 }),
        }
    }

    /// Refuses a workspace of another tree.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn check_workspace<T>(&self, work: &TreeWorkspace<T>) -> Result<(), MultibodyError> {
        let [expected, found] = [self.links.len(), work.forces.len() - 1];
        if expected == found && work.gains.len() == self.freedoms && work.inverses.len() == self.squares {
            return Ok(());
        }
        Err(MultibodyError::OtherWorkspace { expected, found })
    }
}
