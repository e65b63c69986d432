//! Multipliers: a factorisation that reveals the rank, and the solution of least norm.

use piola_numerics::linear::ldlt;

use super::ClosedTree;
use crate::derivatives::{gains_in_space, solve_columns};
use crate::error::{MultibodyError, check_length};
use crate::workspace::TreeWorkspace;

/// The share of a condition's own inertia, 1 where it is independent, below which it is taken to depend on others.
const LEAST_SHARE: f64 = 1e-10;

/// The same for as many conditions as are independent at other positions: where rounding hides the share.
const LEAST_SHARE_OF_USUAL: f64 = 1e-13;

/// The share of its usual inertia below which the gradient of a condition has vanished: the square of 10⁻¹⁰.
const VANISHED: f64 = 1e-20;

/// By how much conditions that depend on others may contradict them, of the terms of their right-hand sides.
const CONSISTENT: f64 = 1e-7;

/// The memory of evaluations of a tree with closures, and their last results.
#[derive(Clone, Debug)]
pub struct LoopWorkspace {
    pub(super) tree: TreeWorkspace<f64>,
    /// A column of n for each condition.
    pub(super) gradients: Vec<f64>,
    /// M⁻¹ Gᵀ.
    pub(super) columns: Vec<f64>,
    pub(super) residuals: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) gamma: Vec<f64>,
    pub(super) right: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
    /// G M⁻¹ Gᵀ with unit diagonal, its factor, and the square of that.
    matrix: Vec<f64>,
    factor: Vec<f64>,
    square: Vec<f64>,
    pub(super) scales: Vec<f64>,
    /// The largest diagonal entries of G M⁻¹ Gᵀ so far.
    pub(super) largest: Vec<f64>,
    shares: Vec<f64>,
    order: Vec<usize>,
    short: Vec<f64>,
    pub(super) rank: usize,
    /// The number of conditions that are independent at other positions of the motion; 0 where it is not known.
    pub(super) usual_rank: usize,
    /// Whether the state satisfies the closures, so that its rank can be told from it.
    pub(super) is_closed: bool,
    pub(super) zero: Vec<f64>,
    pub(super) part: Vec<f64>,
    pub(super) step: Vec<f64>,
    /// The state before a projection.
    pub(super) start_q: Vec<f64>,
    pub(super) start_v: Vec<f64>,
}

impl LoopWorkspace {
    /// The multipliers of the last accelerations, one a condition.
    #[must_use]
    pub fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    /// The residuals of the closures at the last evaluation, one a condition.
    #[must_use]
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// The conditions that do not depend on others, at the last evaluation.
    #[must_use]
    pub const fn rank(&self) -> usize {
        self.rank
    }

    /// The least share of the inertia of an independent condition that is its own, of the largest inertia it has had, and the
    /// condition. The share is 0 at a singular position, where fewer conditions are independent than usually.
    pub(super) fn least_share(&self) -> (f64, usize) {
        if self.rank < self.usual_rank {
            return (0.0, self.order[self.rank]);
        }
        let share = |i: usize| self.shares[i] / (self.scales[i] * self.scales[i] * self.largest[i]);
        self.independent().iter().fold(
            (1.0, 0),
            |(least, weakest), &i| {
                if share(i) < least { (share(i), i) } else { (least, weakest) }
            },
        )
    }

    /// The independent conditions, those with the largest share of their own first.
    pub(super) fn independent(&self) -> &[usize] {
        &self.order[..self.rank]
    }

    /// The conditions that depend on others, at the last evaluation.
    #[must_use]
    pub fn redundant(&self) -> &[usize] {
        &self.order[self.rank..]
    }
}

impl ClosedTree {
    /// Memory for evaluations.
    #[must_use]
    pub fn workspace(&self) -> LoopWorkspace {
        let (n, m) = (self.tree.freedoms, self.conditions);
        LoopWorkspace {
            tree: self.tree.workspace(),
            gradients: vec![0.0; n * m],
            columns: vec![0.0; n * m],
            residuals: vec![0.0; m],
            rates: vec![0.0; m],
            gamma: vec![0.0; m],
            right: vec![0.0; m],
            multipliers: vec![0.0; m],
            matrix: vec![0.0; m * m],
            factor: vec![0.0; m * m],
            square: vec![0.0; m * m],
            scales: vec![0.0; m],
            largest: vec![0.0; m],
            shares: vec![0.0; m],
            order: (0..m).collect(),
            short: vec![0.0; m],
            rank: m,
            usual_rank: 0,
            is_closed: true,
            zero: vec![0.0; n],
            part: vec![0.0; n],
            step: vec![0.0; n],
            start_q: vec![0.0; self.tree.coordinates],
            start_v: vec![0.0; n],
        }
    }

    /// The accelerations under generalised forces with all closures kept; the multipliers stand in the workspace.
    ///
    /// The closures must hold for q and v: see [`project`](Self::project).
    ///
    /// # Errors
    /// As [`RigidTree::forward_dynamics`](crate::RigidTree::forward_dynamics);
    /// [`MultibodyError::Contradiction`] where conditions that depend on each other ask for different accelerations.
    ///
    /// # Accuracy
    /// A few ulp times the condition numbers of M and of the independent part of G M⁻¹ Gᵀ.
    pub fn accelerations(
        &self,
        work: &mut LoopWorkspace,
        q: &[f64],
        v: &[f64],
        tau: &[f64],
        t: f64,
        out: &mut [f64],
    ) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        self.tree.forward_dynamics(&mut work.tree, q, v, tau, out)?;
        let zero = core::mem::take(&mut work.zero);
        let result = self.evaluate(work, q, v, &zero, t);
        work.zero = zero;
        result?;
        self.factorise(work);
        let mut size = 0.0_f64;
        for (i, right) in work.right.iter_mut().enumerate() {
            let (mut free, mut terms) = (0.0, work.gamma[i].abs());
            for (g, a) in work.gradients[i * n..(i + 1) * n].iter().zip(&*out) {
                free += g * a;
                terms += (g * a).abs();
            }
            *right = work.gamma[i] - free;
            size = size.max(terms * work.scales[i]);
        }
        self.solve(work, size)?;
        for (column, &multiplier) in work.columns.chunks_exact(n.max(1)).zip(&work.multipliers) {
            for (out, &x) in out.iter_mut().zip(column) {
                *out += multiplier * x;
            }
        }
        crate::error::check_finite("out", out)
    }

    /// The generalised forces Gᵀ λ of the closures after [`accelerations`](Self::accelerations).
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn closure_forces(&self, work: &LoopWorkspace, out: &mut [f64]) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        check_length("out", n, out.len())?;
        out.fill(0.0);
        for (gradient, &multiplier) in work.gradients.chunks_exact(n.max(1)).zip(&work.multipliers) {
            for (out, &g) in out.iter_mut().zip(gradient) {
                *out += multiplier * g;
            }
        }
        Ok(())
    }

    /// M⁻¹ Gᵀ, and the factor of G M⁻¹ Gᵀ, from articulated inertias and gradients that are there.
    pub(super) fn factorise(&self, work: &mut LoopWorkspace) {
        let (n, m) = (self.tree.freedoms, self.conditions);
        gains_in_space(&self.tree, &mut work.tree, true);
        work.columns.copy_from_slice(&work.gradients);
        solve_columns(&self.tree, &mut work.tree, &mut [&mut work.columns[..]], &[1.0], m);
        for i in 0..m {
            for j in 0..m {
                let gradient = &work.gradients[i * n..(i + 1) * n];
                let column = &work.columns[j * n..(j + 1) * n];
                work.matrix[i * m + j] = gradient.iter().zip(column).map(|(g, x)| g * x).sum();
            }
        }
        for i in 0..m {
            let diagonal = work.matrix[i * m + i];
            work.largest[i] = work.largest[i].max(diagonal);
            let is_there = VANISHED * work.largest[i] < diagonal;
            work.scales[i] = if is_there { diagonal.sqrt().recip() } else { 0.0 };
            work.shares[i] = if is_there { 1.0 } else { 0.0 };
            work.order[i] = i;
        }
        for i in 0..m {
            for j in 0..m {
                work.matrix[i * m + j] *= work.scales[i] * work.scales[j];
            }
        }
        // Cholesky's factor, the condition with the largest share next.
        work.factor.fill(0.0);
        work.rank = 0;
        let (most, least) = match (work.usual_rank, work.is_closed) {
            (0, _) => (m, [LEAST_SHARE; 2]),
            (_, true) => (m, [LEAST_SHARE_OF_USUAL, LEAST_SHARE]),
            (usual, false) => (usual, [LEAST_SHARE_OF_USUAL; 2]),
        };
        for k in 0..most {
            let best = (k..m)
                .fold(k, |best, i| if work.shares[work.order[best]] < work.shares[work.order[i]] { i } else { best });
            work.order.swap(k, best);
            let pivot = work.order[k];
            if work.shares[pivot] < least[usize::from(work.usual_rank <= k)] {
                break;
            }
            work.rank = k + 1;
            let root = work.shares[pivot].sqrt();
            work.factor[pivot * m + k] = root;
            for &i in &work.order[k + 1..] {
                let known: f64 = (0..k).map(|j| work.factor[i * m + j] * work.factor[pivot * m + j]).sum();
                let entry = (work.matrix[i * m + pivot] - known) / root;
                work.factor[i * m + k] = entry;
                work.shares[i] -= entry * entry;
            }
        }
    }

    /// The multipliers of least norm for the right-hand side in the workspace.
    ///
    /// `size` is that of the terms of the right-hand side, by which contradictions are measured.
    pub(super) fn solve(&self, work: &mut LoopWorkspace, size: f64) -> Result<(), MultibodyError> {
        let (m, rank) = (self.conditions, work.rank);
        for (right, scale) in work.right.iter_mut().zip(&work.scales) {
            *right *= scale;
        }
        // λ = L (Lᵀ L)⁻² Lᵀ r, with L of m × rank.
        let (factor, square) = (&work.factor, &mut work.square[..rank * rank]);
        for i in 0..rank {
            work.short[i] = (0..m).map(|k| factor[k * m + i] * work.right[k]).sum();
            for j in 0..rank {
                square[i + j * rank] = (0..m).map(|k| factor[k * m + i] * factor[k * m + j]).sum();
            }
        }
        ldlt::factor_in_place(square, rank).map_err(MultibodyError::Numerics)?;
        for _ in 0..2 {
            ldlt::solve_in_place(square, rank, &mut work.short[..rank]).map_err(MultibodyError::Numerics)?;
        }
        for i in 0..m {
            work.multipliers[i] = (0..rank).map(|j| factor[i * m + j] * work.short[j]).sum();
        }
        // Near a singular position, and where the closures hold only within the error of a stage, conditions may disagree.
        let compared = if work.is_closed && work.usual_rank <= rank { rank } else { m };
        for &condition in &work.order[compared..] {
            let met: f64 = (0..m).map(|j| work.matrix[condition * m + j] * work.multipliers[j]).sum();
            let excess = work.right[condition] - met;
            if CONSISTENT * size < excess.abs() {
                return Err(MultibodyError::Contradiction {
                    closure: self.closure_of(condition).to_owned(),
                    condition,
                    excess,
                });
            }
        }
        for (multiplier, scale) in work.multipliers.iter_mut().zip(&work.scales) {
            *multiplier *= scale;
        }
        Ok(())
    }
}
