//! Forces that joints exert themselves: springs, dampers, Coulomb friction.
//!
//! ```text
//! τ = −k (q − q₀) − d v − f tanh(v/w)        for each freedom
//! ```
//!
//! Coulomb friction is regularised: the sign of v is replaced by tanh(v/w), smooth and within 10⁻⁸ of the sign where 10 w < |v|.
//! A joint that ought to stick creeps, slower than w as long as its load is below 0.76 f.

use piola_numerics::Real;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::link::Kind;
use crate::tree::RigidTree;

/// Energy of the springs; power of the dampers and of Coulomb friction: see [`RigidTree::joint_powers`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPowers<T> {
    /// Energy of the springs, Σ ½ k (q − q₀)², J.
    pub spring_energy: T,
    /// Power of the dampers, −Σ d v², W.
    pub damping_power: T,
    /// Power of Coulomb friction, −Σ f v tanh(v/w), W.
    pub friction_power: T,
}

impl RigidTree {
    /// The forces of springs, dampers and Coulomb friction in the joints, from the data of the joints.
    ///
    /// ```text
    /// τ = −k (q − q₀) − d v − f tanh(v/w)
    /// ```
    /// | symbol | argument or field | unit |
    /// |---|---|---|
    /// | q | `q` | m, rad, unit quaternions |
    /// | v | `v` | m/s, rad/s |
    /// | w | `slip_rate` | m/s and rad/s |
    /// | k, q₀ | `stiffness`, `rest` of [`TreeJoint`](crate::TreeJoint) | N/m or N m/rad; m or rad |
    /// | d, f | `damping`, `friction` | N s/m or N m s; N or N m |
    /// | τ | `out` | N, N m |
    ///
    /// URDF and MJCF files fill the data; the forces act only where a caller adds them. Without friction in the tree `slip_rate`
    /// is of no effect.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`]; [`MultibodyError::InvalidSlipRate`] unless
    /// 0 < `slip_rate` < ∞.
    ///
    /// # Accuracy
    /// A few ulp of the largest of the three terms.
    #[doc(alias("passive forces", "dry friction", "frictionloss"))]
    pub fn joint_forces<T: Real>(&self, q: &[T], v: &[T], slip_rate: f64, out: &mut [T]) -> Result<(), MultibodyError> {
        self.check_joint_state(q, v, slip_rate)?;
        check_length("out", self.freedoms, out.len())?;
        self.for_each_freedom(q, v, slip_rate, |freedom, terms| out[freedom] = terms.force);
        Ok(())
    }

    /// The energy of the springs, and the powers of dampers and Coulomb friction under the forces of
    /// [`joint_forces`](Self::joint_forces).
    ///
    /// Kinetic and potential energy with that of the springs change by the two powers and by the power of other forces.
    ///
    /// # Errors
    /// As [`joint_forces`](Self::joint_forces).
    pub fn joint_powers<T: Real>(&self, q: &[T], v: &[T], slip_rate: f64) -> Result<JointPowers<T>, MultibodyError> {
        self.check_joint_state(q, v, slip_rate)?;
        let zero = T::zero();
        let mut powers = JointPowers { spring_energy: zero, damping_power: zero, friction_power: zero };
        self.for_each_freedom(q, v, slip_rate, |_, terms| {
            powers.spring_energy += terms.spring_energy;
            powers.damping_power += terms.damping_power;
            powers.friction_power += terms.friction_power;
        });
        Ok(powers)
    }

    fn check_joint_state<T: Real>(&self, q: &[T], v: &[T], slip_rate: f64) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        check_length("v", self.freedoms, v.len())?;
        if !(0.0 < slip_rate && slip_rate < f64::INFINITY) {
            return Err(MultibodyError::InvalidSlipRate { slip_rate });
        }
        check_finite("q", q)?;
        check_finite("v", v)
    }

    fn for_each_freedom<T: Real>(&self, q: &[T], v: &[T], slip_rate: f64, mut take: impl FnMut(usize, &Terms<T>)) {
        for link in &self.links {
            let joint = &self.joints[link.joint].joint;
            let (stiffness, damping, friction) =
                (T::lit(joint.stiffness), T::lit(joint.damping), T::lit(joint.friction));
            for freedom in link.v..link.v + link.kind.freedoms() {
                let stretch = match link.kind {
                    // Joints with a quaternion have no spring.
                    Kind::Spherical | Kind::Free => T::zero(),
                    _ => q[link.q] - T::lit(joint.rest),
                };
                let rate = v[freedom];
                let slip = if 0.0 < joint.friction { (rate / T::lit(slip_rate)).tanh() } else { T::zero() };
                let terms = Terms {
                    force: -(stiffness * stretch) - damping * rate - friction * slip,
                    spring_energy: T::lit(0.5) * stiffness * stretch * stretch,
                    damping_power: -(damping * rate * rate),
                    friction_power: -(friction * rate * slip),
                };
                take(freedom, &terms);
            }
        }
    }
}

/// What one freedom contributes.
struct Terms<T> {
    force: T,
    spring_energy: T,
    damping_power: T,
    friction_power: T,
}
