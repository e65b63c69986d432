//! Singular positions: conditions that are independent elsewhere depend on each other there.
//!
//! ```text
//! G₁ = R G₀        R = G₁G₀ᵀ (G₀G₀ᵀ)⁻¹        yᵀR = −λ yᵀ,  0 < λ:  yᵀG₀ and yᵀG₁ are opposite
//! ```
//!
//! G₀ and G₁ are the gradients of the independent conditions at two states, one row for each. At a singular position a
//! combination yᵀG vanishes. A motion that stays on the smooth branch comes out with it reversed, so that two states on
//! both sides of the position show it, however long the step between them is. The eigenvalues of R do not depend on the
//! axes or units in which the conditions are written. Those that are negative are found by Newton's method for the sign of
//! a matrix, X ← (X + X⁻¹)/2.
//!
//! Reference: N. J. Higham, *Functions of Matrices*, SIAM 2008, chapter 5.

use piola_numerics::internal::dot;
use piola_numerics::linear::{ldlt, lu};

/// How many positions a motion lists.
const LISTED: usize = 64;

/// Steps of Newton's method: some ten for eigenvalues from 0.01 to 100.
const MOST_ITERATIONS: usize = 20;

/// The change in a step of Newton's method, which squares it, below which the sign is known well enough.
const CONVERGED: f64 = 1e-4;

/// A singular position that a motion under constraints, or of a closed loop, went through.
///
/// # Example
/// ```
/// use piola_kinematics::SingularPosition;
/// let aligned = SingularPosition { t: 0.25, condition: 1 };
/// assert_eq!(aligned.t, 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularPosition {
    /// The time, s: by linear interpolation between the states on both sides.
    pub t: f64,
    /// The condition that depends on others there, by its index among those of the system.
    pub condition: usize,
}

/// The singular positions of a motion, found between accepted states.
#[derive(Clone, Debug)]
pub struct Passages {
    /// Gradients at the last accepted state with the full number of independent conditions.
    before: Vec<f64>,
    t_before: Option<f64>,
    /// The same for a state that is not yet accepted, and what lies between.
    next: Vec<f64>,
    t_next: Option<f64>,
    between: Option<SingularPosition>,
    passed_by: bool,
    /// Rᵀ, then its sign; the inverse of that, and a factor.
    sign: Vec<f64>,
    inverse: Vec<f64>,
    factor: Vec<f64>,
    exchanges: Vec<usize>,
    /// y, and yᵀG at both states.
    weights: Vec<f64>,
    combined: [Vec<f64>; 2],
    listed: Vec<SingularPosition>,
    count: usize,
}

impl Passages {
    /// Memory for gradients of conditions by n coordinates.
    #[must_use]
    pub fn of(conditions: usize, n: usize) -> Self {
        let size = conditions * n;
        Self {
            before: vec![0.0; size],
            t_before: None,
            next: vec![0.0; size],
            t_next: None,
            between: None,
            passed_by: false,
            sign: vec![0.0; conditions * conditions],
            inverse: vec![0.0; conditions * conditions],
            factor: vec![0.0; conditions * conditions],
            exchanges: vec![0; conditions],
            weights: vec![0.0; conditions],
            combined: [vec![0.0; n], vec![0.0; n]],
            listed: Vec::with_capacity(LISTED),
            count: 0,
        }
    }

    /// Forgets all states and positions.
    pub fn clear(&mut self) {
        (self.t_before, self.t_next, self.between, self.passed_by) = (None, None, None, false);
        self.listed.clear();
        self.count = 0;
    }

    /// The first positions that accepted steps went through.
    #[must_use]
    pub fn listed(&self) -> &[SingularPosition] {
        &self.listed
    }

    /// How many positions accepted steps went through.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.count
    }

    /// Whether a position lies between the last accepted state and one that may be accepted.
    #[must_use]
    pub const fn is_between(&self) -> bool {
        self.between.is_some()
    }

    /// The state at a time, if it is accepted, is too close to a singular position to be looked at.
    pub fn pass_by(&mut self, t: f64) {
        (self.t_next, self.between, self.passed_by) = (Some(t), None, true);
    }

    /// Looks at the gradients of a state that may be accepted. `order` holds the independent conditions.
    pub fn look(&mut self, gradients: &[f64], n: usize, order: &[usize], t: f64) -> Option<SingularPosition> {
        self.next.copy_from_slice(gradients);
        (self.t_next, self.passed_by) = (Some(t), false);
        self.between = self.t_before.and_then(|start| {
            self.find_combination(n, order)?;
            let [first, last] = &self.combined;
            let (along, of_first, of_last) = (dot(first, last), dot(first, first).sqrt(), dot(last, last).sqrt());
            // Reversed, and not only turned.
            (along < -0.5 * of_first * of_last).then(|| {
                let size = |k: usize| (self.weights[k] * norm(row(&self.before, order[k], n))).abs();
                let most = (0..order.len()).fold(0, |most, k| if size(most) < size(k) { k } else { most });
                let t = start + (t - start) * (of_first / (of_first + of_last));
                SingularPosition { t, condition: order[most] }
            })
        });
        self.between
    }

    /// The state at a time was accepted, if it is the one that was looked at.
    pub fn accept(&mut self, t: f64) -> bool {
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

    /// Finds the combination that is reversed between both states; nothing where there is none.
    fn find_combination(&mut self, n: usize, order: &[usize]) -> Option<()> {
        let m = order.len();
        let Self { before, next, sign, inverse, factor, exchanges, weights, combined, .. } = self;
        let (sign, inverse, factor) = (&mut sign[..m * m], &mut inverse[..m * m], &mut factor[..m * m]);
        for (a, &of_a) in order.iter().enumerate() {
            for (b, &of_b) in order.iter().enumerate() {
                let other = row(before, of_b, n);
                factor[a + b * m] = dot(row(before, of_a, n), other);
                sign[b + a * m] = dot(row(next, of_a, n), other);
            }
        }
        ldlt::factor_in_place(factor, m).ok()?;
        let mut apart = 0.0_f64;
        for (a, column) in sign.chunks_exact_mut(m.max(1)).enumerate() {
            ldlt::solve_in_place(factor, m, column).ok()?;
            let off = |b: usize, x: f64| (x - if a == b { 1.0 } else { 0.0 }).abs();
            apart = apart.max(column.iter().enumerate().map(|(b, &x)| off(b, x)).sum());
        }
        if apart < 1.0 {
            // |R − 1| < 1: no eigenvalue is negative.
            return None;
        }
        for _ in 0..MOST_ITERATIONS {
            factor.copy_from_slice(sign);
            lu::factor_in_place(factor, &mut exchanges[..m]).ok()?;
            inverse.fill(0.0);
            let (mut change, mut size) = (0.0_f64, 0.0_f64);
            for (a, column) in inverse.chunks_exact_mut(m).enumerate() {
                column[a] = 1.0;
                lu::solve_in_place(factor, &exchanges[..m], column).ok()?;
            }
            for (x, y) in sign.iter_mut().zip(&*inverse) {
                (change, size) = (change.max((*x - y).abs()), size.max(x.abs()));
                *x = 0.5 * (*x + y);
            }
            if change <= CONVERGED * size {
                break;
            }
        }
        // The projector (1 − sign)/2: the row of it that is largest on the diagonal.
        let share = |a: usize| 0.5 * (1.0 - sign[a * (m + 1)]);
        let most = (0..m).fold(0, |most, a| if share(most) < share(a) { a } else { most });
        if (0..m).map(share).sum::<f64>() < 0.5 {
            return None;
        }
        let weights = &mut weights[..m];
        for (b, (weight, &x)) in weights.iter_mut().zip(&sign[most * m..(most + 1) * m]).enumerate() {
            *weight = 0.5 * (if b == most { 1.0 } else { 0.0 } - x);
        }
        let [first, last] = combined;
        combine(weights, before, order, first);
        combine(weights, next, order, last);
        Some(())
    }
}

fn row(gradients: &[f64], condition: usize, n: usize) -> &[f64] {
    &gradients[condition * n..(condition + 1) * n]
}

fn norm(row: &[f64]) -> f64 {
    dot(row, row).sqrt()
}

/// The combination `Σ x_k g_k`.
fn combine(weights: &[f64], gradients: &[f64], order: &[usize], out: &mut [f64]) {
    let n = out.len();
    out.fill(0.0);
    for (&weight, &condition) in weights.iter().zip(order) {
        for (out, g) in out.iter_mut().zip(row(gradients, condition, n)) {
            *out += weight * g;
        }
    }
}
