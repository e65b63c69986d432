//! A symplectic method in the coordinates of the tree, linear in the links.
//!
//! The discrete Lagrangian is that of the midpoint, and steps of it are composed to a higher order:
//!
//! ```text
//! q̄ = q₀ + h v̄/2        p₀ + h/2 (∂L/∂q + τ) = M v̄        q₁ = q₀ + h v̄        p₁ = M v̄ + h/2 (∂L/∂q + τ)        at (q̄, v̄)
//! p = S·h        ∂L/∂q = S·(g − v_λ ×* h)        h, g: momentum and weight of a link with all beyond it
//! ```
//!
//! Rotations R of spherical and free joints go along exponentials, with X = h ω̄, μ = ∂L/∂ω and s = ∂L/∂R + τ in the child's axes:
//!
//! ```text
//! R̄ = R₀ exp X/2        R₁ = R₀ exp X        t = tan(|X|/4)/|X|
//! p₀ + h/2 (s + t X × s) = dexp⁻¹(−X) μ        p₁ = p₀ + h (s − ω̄ × μ)
//! ```
//!
//! These are the discrete Euler–Lagrange equations of the same midpoint, with variations R⁻¹ δR at both ends. The position of a
//! free joint is a plain coordinate in space: its momentum is R μ_v, and the derivative by R loses v × μ_v, because v = Rᵀ ẋ. So the
//! method stays variational, hence symplectic, and keeps momenta exactly where the Lagrangian has their symmetry.
//!
//! Momenta and ∂L/∂q need one pass each way. Newton's corrections take M alone as the derivative, by articulated bodies, so that
//! an iteration is linear in the links too.
//!
//! # References
//! T. Lee, M. Leok & N. H. McClamroch, *Lie group variational integrators for the full body problem*, Comput. Methods Appl. Mech.
//! Engrg. 196 (2007) 2907; J. E. Marsden & M. West, *Discrete mechanics and variational integrators*, Acta Numerica 10 (2001)
//! 357; J. Lee, C. K. Liu, F. C. Park & S. S. Srinivasa, *A linear-time variational integrator for multibody systems*, WAFR
//! (2016).

use core::ops::ControlFlow;

use nalgebra::Vector3;
use piola_geometric::{LieGroup, Rotations};
use piola_integrators::Order;
use piola_integrators::internal::compensated_add;
use piola_kinematics::Attitude;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::forward_dynamics;
use crate::link::{Kind, Link};
use crate::slopes::momenta_and_slopes;
use crate::spatial::{add, cross, dot, scaled, sub};
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// Most corrections of one step.
const MOST_CORRECTIONS: usize = 60;

/// A variational method of fixed step for a tree.
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
    /// Velocities, those of free joints in space axes.
    rate: Vec<f64>,
    /// Velocities as the tree has them.
    velocity: Vec<f64>,
    /// Of free joints in space axes, as the rates.
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
    /// [`MultibodyError::NotFinite`] for a step that is zero or not finite.
    pub fn new(tree: &'a RigidTree, order: Order, step: f64) -> Result<Self, MultibodyError> {
        check_finite("step", &[step])?;
        check_finite("1/step", &[step.recip()])?;
        let vector = vec![0.0; tree.freedoms];
        Ok(Self {
            tree,
            order,
            step,
            work: tree.workspace(),
            middle: vec![0.0; tree.coordinates],
            rate: vector.clone(),
            velocity: vector.clone(),
            p: vector.clone(),
            p_carry: vector.clone(),
            q_carry: vec![0.0; tree.coordinates],
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
        check_length("q", self.tree.coordinates, q.len())?;
        check_length("v", n, v.len())?;
        check_finite("q", q)?;
        check_finite("v", v)?;
        self.tree.check_quaternions(q)?;
        self.rate.copy_from_slice(v);
        momenta_and_slopes(self.tree, &mut self.work.forces, q, v, &mut self.p, &mut self.slopes);
        for link in free(self.tree) {
            turn(attitude_of(link, q), &mut self.rate[link.v + 3..link.v + 6]);
            turn(attitude_of(link, q), &mut self.p[link.v + 3..link.v + 6]);
        }
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
            for link in free(self.tree) {
                turn(attitude_of(link, &now).conjugate(), &mut self.momenta[link.v + 3..link.v + 6]);
            }
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
            self.go_to_middle(q, h);
            let states = &mut self.work.forces;
            momenta_and_slopes(self.tree, states, &self.middle, &self.velocity, &mut self.momenta, &mut self.slopes);
            forces(t + 0.5 * h, &self.middle, &self.velocity, &mut self.tau);
            for i in 0..self.p.len() {
                self.slopes[i] = 0.5 * h * (self.slopes[i] + self.tau[i]);
            }
            let tree = self.tree;
            for &index in &tree.quaternions {
                self.trivialise(&tree.links[index], h);
            }
            for link in tree.links.iter().filter(|link| link.kind.freedoms() == 1) {
                self.momenta[link.v] = self.p[link.v] + self.slopes[link.v] - self.momenta[link.v];
            }
            let residual = core::mem::take(&mut self.momenta);
            let middle = core::mem::take(&mut self.middle);
            let result = self.solve(&middle, &residual);
            self.momenta = residual;
            self.middle = middle;
            result?;
            self.iterations += 1;
            for link in free(self.tree) {
                turn(attitude_of(link, &self.middle), &mut self.correction[link.v + 3..link.v + 6]);
            }
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
        for i in 0..self.p.len() {
            compensated_add(&mut self.p[i], &mut self.p_carry[i], 2.0 * self.slopes[i]);
        }
        for link in &self.tree.links {
            let (first, rate) = (link.q, &self.rate[link.v..link.v + link.kind.freedoms()]);
            let is_turned = matches!(link.kind, Kind::Spherical | Kind::Free);
            if is_turned {
                let (q, carry) = (&mut q[first..first + 4], &mut self.q_carry[first..first + 4]);
                Rotations.advance(q, carry, &[h * rate[0], h * rate[1], h * rate[2]]);
                Rotations.renormalise(q, carry);
            }
            let plain = if is_turned { first + 4..first + link.kind.coordinates() } else { first..first + 1 };
            let rate = if is_turned { &rate[3..] } else { rate };
            for (i, rate) in plain.zip(rate) {
                compensated_add(&mut q[i], &mut self.q_carry[i], h * rate);
            }
        }
        Ok(())
    }

    /// The configuration in the middle of a step, and the velocities there as the tree has them.
    fn go_to_middle(&mut self, q: &[f64], h: f64) {
        self.middle.copy_from_slice(q);
        self.velocity.copy_from_slice(&self.rate);
        for link in &self.tree.links {
            let (first, rate) = (link.q, &self.rate[link.v..link.v + link.kind.freedoms()]);
            if !matches!(link.kind, Kind::Spherical | Kind::Free) {
                self.middle[first] += 0.5 * h * rate[0];
                continue;
            }
            let half = [0.5 * h * rate[0], 0.5 * h * rate[1], 0.5 * h * rate[2]];
            Rotations.advance(&mut self.middle[first..first + 4], &mut [0.0; 4], &half);
            if link.kind == Kind::Free {
                for k in 0..3 {
                    self.middle[first + 4 + k] += 0.5 * h * rate[3 + k];
                }
                turn(attitude_of(link, &self.middle).conjugate(), &mut self.velocity[link.v + 3..link.v + 6]);
            }
        }
    }

    /// Of a joint with a quaternion: what is left of the equation of the step, in the child's axes, to `momenta`, and half the
    /// change of its momentum to `slopes`. These hold ∂L/∂v and h/2 times ∂L/∂q + τ before.
    fn trivialise(&mut self, link: &Link, h: f64) {
        let v = link.v;
        let three = |values: &[f64], from: usize| [values[from], values[from + 1], values[from + 2]];
        let (rate, mu) = (three(&self.rate, v), three(&self.momenta, v));
        let mut half_slope = three(&self.slopes, v);
        if link.kind == Kind::Free {
            let (velocity, linear) = (three(&self.velocity, v + 3), three(&self.momenta, v + 3));
            half_slope = sub(half_slope, scaled(0.5 * h, cross(velocity, linear)));
            // In space axes the position is a plain coordinate; its residual goes back to the child's.
            let attitude = attitude_of(link, &self.middle);
            turn(attitude, &mut self.slopes[v + 3..v + 6]);
            let mut before = three(&self.p, v + 3);
            for (before, slope) in before.iter_mut().zip(&self.slopes[v + 3..v + 6]) {
                *before += slope;
            }
            turn(attitude.conjugate(), &mut before);
            self.momenta[v + 3..v + 6].copy_from_slice(&sub(before, linear));
        }
        let x = scaled(h, rate);
        let angle = dot(x, x).sqrt();
        // tan(|X|/4)/|X|
        let t = if angle < 1e-8 { 0.25 } else { (0.25 * angle).tan() / angle };
        let mut seen = mu;
        Rotations.inverse_differential(&x, &mut seen);
        let known = add(three(&self.p, v), add(half_slope, scaled(t, cross(x, half_slope))));
        let left = sub(known, seen);
        // To second order dexp(−X) of it, which makes it a residual of μ.
        let left = sub(left, scaled(0.5, cross(x, left)));
        self.momenta[v..v + 3].copy_from_slice(&left);
        self.slopes[v..v + 3].copy_from_slice(&sub(half_slope, scaled(0.5 * h, cross(rate, mu))));
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

/// The links of free joints.
fn free(tree: &RigidTree) -> impl Iterator<Item = &Link> {
    tree.quaternions.iter().map(|&index| &tree.links[index]).filter(|link| link.kind == Kind::Free)
}

/// The attitude of a link behind a joint with a quaternion.
fn attitude_of(link: &Link, q: &[f64]) -> Attitude<f64> {
    Attitude { w: q[link.q], x: q[link.q + 1], y: q[link.q + 2], z: q[link.q + 3] }
}

/// Turns a vector to the outer axes.
fn turn(attitude: Attitude<f64>, vector: &mut [f64]) {
    let turned = attitude.to_space(&Vector3::new(vector[0], vector[1], vector[2]));
    vector.copy_from_slice(turned.as_slice());
}
