//! Singular positions: conditions that are independent elsewhere depend on each other there.
//!
//! ```text
//! e_k = g_k − Σ_{j<k} (g_k·e_j / e_j·e_j) e_j
//! ```
//!
//! e_k is the part of the gradient of condition k that the conditions before it do not have. At a singular position it
//! vanishes. A motion that stays on the smooth branch comes out with e_k reversed, so that two states on both sides of the
//! position show it, however long the step between them is.

/// How many positions a motion lists.
const LISTED: usize = 64;

/// A singular position that a motion went through.
///
/// # Example
/// See [`ClosedMotion`](crate::ClosedMotion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularPosition {
    /// The time, s: by linear interpolation between the states on both sides.
    pub t: f64,
    /// The condition that depends on others there; [`ClosedTree::closure_of`](crate::ClosedTree::closure_of) names its closure.
    pub condition: usize,
}

/// The singular positions of a motion, found between accepted states.
#[derive(Clone, Debug)]
pub(super) struct Passages {
    /// Gradients at the last accepted state with the full number of independent conditions.
    before: Vec<f64>,
    t_before: Option<f64>,
    /// The same for a state that is not yet accepted, and what lies between.
    next: Vec<f64>,
    t_next: Option<f64>,
    between: Option<SingularPosition>,
    passed_by: bool,
    /// What is left of the gradients, one after the other, at both states.
    left: [Vec<f64>; 2],
    listed: Vec<SingularPosition>,
    count: usize,
}

impl Passages {
    pub(super) fn of(size: usize) -> Self {
        Self {
            before: vec![0.0; size],
            t_before: None,
            next: vec![0.0; size],
            t_next: None,
            between: None,
            passed_by: false,
            left: [vec![0.0; size], vec![0.0; size]],
            listed: Vec::with_capacity(LISTED),
            count: 0,
        }
    }

    /// Forgets all states and positions.
    pub(super) fn clear(&mut self) {
        (self.t_before, self.t_next, self.between, self.passed_by) = (None, None, None, false);
        self.listed.clear();
        self.count = 0;
    }

    pub(super) fn listed(&self) -> &[SingularPosition] {
        &self.listed
    }

    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// The state at a time, if it is accepted, is too close to a singular position to be looked at.
    pub(super) fn pass_by(&mut self, t: f64) {
        (self.t_next, self.between, self.passed_by) = (Some(t), None, true);
    }

    /// Looks at the gradients of a state that may be accepted. `order` holds the independent conditions.
    pub(super) fn look(&mut self, gradients: &[f64], n: usize, order: &[usize], t: f64) -> Option<SingularPosition> {
        self.next.copy_from_slice(gradients);
        (self.t_next, self.passed_by) = (Some(t), false);
        self.between = self.t_before.and_then(|start| {
            let [first, last] = &mut self.left;
            leave(&self.before, n, order, first);
            leave(&self.next, n, order, last);
            let rows = first.chunks_exact(n.max(1)).zip(last.chunks_exact(n.max(1)));
            order.iter().zip(rows).find_map(|(&condition, (e, f))| {
                let (along, of_e, of_f) = (inner(e, f), inner(e, e).sqrt(), inner(f, f).sqrt());
                // Reversed, and not only turned.
                (along < -0.5 * of_e * of_f)
                    .then(|| SingularPosition { t: start + (t - start) * (of_e / (of_e + of_f)), condition })
            })
        });
        self.between
    }

    /// The state at a time was accepted, if it is the one that was looked at.
    pub(super) fn accept(&mut self, t: f64) -> bool {
        if self.t_next.take_if(|next| (*next - t).abs() <= 0.0).is_none() {
            return false;
        }
        if core::mem::take(&mut self.passed_by) {
            return true;
        }
        core::mem::swap(&mut self.before, &mut self.next);
        self.t_before = Some(t);
        if let Some(position) = self.between.take() {
            self.count += 1;
            if self.listed.len() < LISTED {
                self.listed.push(position);
            }
        }
        true
    }
}

/// What is left of each gradient after those before it in the order.
fn leave(gradients: &[f64], n: usize, order: &[usize], out: &mut [f64]) {
    for (k, &condition) in order.iter().enumerate() {
        let (known, rest) = out.split_at_mut(k * n);
        let row = &mut rest[..n];
        row.copy_from_slice(&gradients[condition * n..(condition + 1) * n]);
        for other in known.chunks_exact(n.max(1)) {
            let squared = inner(other, other);
            if 0.0 < squared {
                let share = inner(row, other) / squared;
                for (x, y) in row.iter_mut().zip(other) {
                    *x -= share * y;
                }
            }
        }
    }
}

fn inner(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}
