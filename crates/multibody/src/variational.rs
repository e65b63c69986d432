//! A symplectic method in the coordinates of the tree, linear in the links.
//!
//! The discrete Lagrangian is that of the midpoint, and steps of it are composed to a higher order:
//!
//! ```text
//! q̄ = q₀ + h v̄/2        p₀ + h/2 (∂L/∂q + τ) = M v̄        q₁ = q₀ + h v̄        p₁ = M v̄ + h/2 (∂L/∂q + τ)        at (q̄, v̄)
//! p = S·h        ∂L/∂q = S·(g − v_λ ×* h)        h, g: momentum and weight of a link with all beyond it
//! ```
//!
//! Momenta and ∂L/∂q need one pass each way. Newton's corrections take M alone as the derivative, by articulated bodies, so that
//! an iteration is linear in the links too.
//!
//! # References
//! J. E. Marsden & M. West, *Discrete mechanics and variational integrators*, Acta Numerica 10 (2001) 357; J. Lee, C. K. Liu,
//! F. C. Park & S. S. Srinivasa, *A linear-time variational integrator for multibody systems*, WAFR (2016).

use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_integrators::internal::compensated_add;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::forward_dynamics;
use crate::slopes::momenta_and_slopes;
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// Most corrections of one step.
const MOST_CORRECTIONS: usize = 60;

/// A variational method of fixed step for a tree whose joints have one coordinate a freedom.
///
/// # Accuracy
/// The error of a run falls as h to the power of the order. Without forces that do work the energy does not drift: it oscillates
/// within a bound that falls likewise. Sums are compensated.
///
/// # Example
/// A pendulum of 1 m let go from the horizontal keeps its energy, 0, within 10⁻¹² of m g l.
/// ```
/// use piola_integrators::Order;
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint, VariationalTree};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(1.0, [1.0, 0.0, 0.0])?)?;
/// let tree = builder.build()?;
/// let mut method = VariationalTree::new(&tree, Order::Eight, 0.01)?;
/// let (mut q, mut v) = ([0.0], [0.0]);
/// method.run(&mut q, &mut v, 1000)?;
/// let energies = tree.tree_energies(&mut tree.workspace(), &q, &v)?;
/// assert!((energies.kinetic + energies.potential).abs() < 1e-12 * 9.81);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("symplectic", "discrete mechanics"))]
#[derive(Clone, Debug)]
pub struct VariationalTree<'a> {
    tree: &'a RigidTree,
    order: Order,
    step: f64,
    work: TreeWorkspace<f64>,
    middle: Vec<f64>,
    rate: Vec<f64>,
    p: Vec<f64>,
    p_carry: Vec<f64>,
    q_carry: Vec<f64>,
    momenta: Vec<f64>,
    slopes: Vec<f64>,
    tau: Vec<f64>,
    correction: Vec<f64>,
    zero: Vec<f64>,
    iterations: usize,
}

impl<'a> VariationalTree<'a> {
    /// The method of an order with a step (s).
    ///
    /// # Errors
    /// [`MultibodyError::NeedsPlainCoordinates`] for spherical and free joints; [`MultibodyError::NotFinite`] for a step that
    /// is zero or not finite.
    pub fn new(tree: &'a RigidTree, order: Order, step: f64) -> Result<Self, MultibodyError> {
        if let Some(&link) = tree.quaternions.first() {
            return Err(MultibodyError::NeedsPlainCoordinates { joint: tree.joint_of(&tree.links[link]) });
        }
        check_finite("step", &[step])?;
        check_finite("1/step", &[step.recip()])?;
        let vector = vec![0.0; tree.freedoms];
        Ok(Self {
            tree,
            order,
            step,
            work: tree.workspace(),
            middle: vector.clone(),
            rate: vector.clone(),
            p: vector.clone(),
            p_carry: vector.clone(),
            q_carry: vector.clone(),
            momenta: vector.clone(),
            slopes: vector.clone(),
            tau: vector.clone(),
            correction: vector.clone(),
            zero: vector,
            iterations: 0,
        })
    }

    /// Steps without forces besides gravity.
    ///
    /// # Errors
    /// As [`run_under`](Self::run_under).
    pub fn run(&mut self, q: &mut [f64], v: &mut [f64], steps: usize) -> Result<(), MultibodyError> {
        let unforced = |_t: f64, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0);
        self.run_under(q, v, steps, unforced, |_, _, _| ControlFlow::Continue(()))
    }

    /// Steps under forces τ(t, q, v), with t from 0; the observer sees t, q and v after each step and may stop the run.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NoInertia`];
    /// [`MultibodyError::NoConvergence`] where a step is too long. The state then stands at the last complete step.
    pub fn run_under(
        &mut self,
        q: &mut [f64],
        v: &mut [f64],
        steps: usize,
        mut forces: impl FnMut(f64, &[f64], &[f64], &mut [f64]),
        mut observer: impl FnMut(f64, &[f64], &[f64]) -> ControlFlow<()>,
    ) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        check_length("q", n, q.len())?;
        check_length("v", n, v.len())?;
        check_finite("q", q)?;
        check_finite("v", v)?;
        self.rate.copy_from_slice(v);
        momenta_and_slopes(self.tree, &mut self.work.forces, q, v, &mut self.p, &mut self.slopes);
        self.p_carry.fill(0.0);
        self.q_carry.fill(0.0);
        let mut now = q.to_vec();
        for step in 0..steps {
            let mut t = self.step * step as f64;
            now.copy_from_slice(q);
            for share in self.order.substeps() {
                let h = share * self.step;
                self.substep(&mut now, t, h, &mut forces)?;
                t += h;
            }
            // v = M⁻¹ p
            self.momenta.copy_from_slice(&self.p);
            let momenta = core::mem::take(&mut self.momenta);
            let result = self.solve(&now, &momenta);
            self.momenta = momenta;
            result?;
            q.copy_from_slice(&now);
            v.copy_from_slice(&self.correction);
            if observer(self.step * (step + 1) as f64, q, v).is_break() {
                break;
            }
        }
        Ok(())
    }

    /// Newton's corrections since the method was made.
    #[must_use]
    pub const fn iterations(&self) -> usize {
        self.iterations
    }

    fn substep(
        &mut self,
        q: &mut [f64],
        t: f64,
        h: f64,
        forces: &mut impl FnMut(f64, &[f64], &[f64], &mut [f64]),
    ) -> Result<(), MultibodyError> {
        let (mut before, mut stalls) = (f64::INFINITY, 0);
        let size = q.iter().fold(1.0_f64, |size, q| size.max(q.abs()));
        for count in 0.. {
            for ((middle, &q), &rate) in self.middle.iter_mut().zip(&*q).zip(&self.rate) {
                *middle = q + 0.5 * h * rate;
            }
            let states = &mut self.work.forces;
            momenta_and_slopes(self.tree, states, &self.middle, &self.rate, &mut self.momenta, &mut self.slopes);
            forces(t + 0.5 * h, &self.middle, &self.rate, &mut self.tau);
            for i in 0..self.p.len() {
                self.slopes[i] = 0.5 * h * (self.slopes[i] + self.tau[i]);
                self.momenta[i] = self.p[i] + self.slopes[i] - self.momenta[i];
            }
            let residual = core::mem::take(&mut self.momenta);
            let middle = core::mem::take(&mut self.middle);
            let result = self.solve(&middle, &residual);
            self.momenta = residual;
            self.middle = middle;
            result?;
            self.iterations += 1;
            let mut largest = 0.0_f64;
            let mut scale = 0.0_f64;
            for (rate, &correction) in self.rate.iter_mut().zip(&self.correction) {
                *rate += correction;
                largest = largest.max(correction.abs());
                scale = scale.max(rate.abs());
            }
            if !largest.is_finite() || count == MOST_CORRECTIONS {
                return Err(MultibodyError::NoConvergence { correction: largest * h.abs() });
            }
            // At rounding, which M⁻¹ makes larger, corrections no longer fall.
            if 0.5 * before <= largest {
                stalls += 1;
            }
            let moved = largest * h.abs() / size;
            let is_rounding = |stalls: i32, bound: f64| stalls != 0 && moved <= bound;
            if largest <= 2.0 * f64::EPSILON * scale
                || is_rounding(stalls, 4096.0 * f64::EPSILON)
                || is_rounding(stalls / 3, 1e-9)
            {
                break;
            }
            before = largest;
        }
        // What is left of the residual, of the size of rounding, is taken into the momenta: p₁ = p₀ + h (∂L/∂q + τ).
        for i in 0..q.len() {
            compensated_add(&mut q[i], &mut self.q_carry[i], h * self.rate[i]);
            compensated_add(&mut self.p[i], &mut self.p_carry[i], 2.0 * self.slopes[i]);
        }
        Ok(())
    }

    /// M(q)⁻¹ times a vector, to `correction`.
    fn solve(&mut self, q: &[f64], right: &[f64]) -> Result<(), MultibodyError> {
        let tree = self.tree;
        forward_dynamics::pass_outwards(tree, &mut self.work.articulation, q, &self.zero);
        self.work.articulation[0].needed = ([0.0; 3], [0.0; 3]);
        let is_positive = forward_dynamics::pass_inwards(tree, &mut self.work, right, &mut self.correction);
        if !is_positive {
            if q.iter().any(|q| !q.is_finite()) {
                return Err(MultibodyError::NoConvergence { correction: f64::INFINITY });
            }
            tree.explain_inertia(&self.work)?;
        }
        forward_dynamics::pass_accelerations(tree, &mut self.work.articulation, &self.work.gains, &mut self.correction);
        Ok(())
    }
}
