//! Energies, centre of mass and centroidal momentum.
//!
//! ```text
//! T = ½ Σ ω·I ω + m |ẋ|²        V = −Σ m g·c        h = (angular momentum about the centre of mass; momentum) = A_G v
//! ```
//!
//! Bodies that are fixed to the ground count in none of these. Reflected inertias of motors count in the kinetic energy.

use piola_numerics::Real;

use crate::error::{MultibodyError, all_finite, check_length};
use crate::space::{
    SUBSPACE, add_inertia, add_pairs, force_cross, momentum, motion_at, own_inertia, pass_accelerations,
    pass_subspaces, reference, row_pair,
};
use crate::spatial::{add, cross, dot, lit, lit_symmetric, scaled, sub, symmetric_times, times, transposed_times};
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// Kinetic and potential energy, J.
///
/// # Example
/// See [`RigidTree::tree_energies`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeEnergies<T> {
    /// ½ vᵀ M v.
    pub kinetic: T,
    /// −Σ m g·c, zero where all centres of mass are at the height of the origin of space.
    pub potential: T,
}

/// Centre of mass of a tree, and its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassCentre<T> {
    /// Mass of all bodies that can move, kg.
    pub mass: f64,
    /// Position, m.
    pub position: [T; 3],
    /// Velocity, m/s.
    pub velocity: [T; 3],
}

/// Momentum of a tree in space axes, or its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentroidalMomentum<T> {
    /// Angular momentum about the centre of mass, kg m²/s.
    pub angular: [T; 3],
    /// Momentum, kg m/s.
    pub linear: [T; 3],
}

impl RigidTree {
    /// Kinetic and potential energy.
    ///
    /// # Errors
    /// As [`forward_velocities`](Self::forward_velocities).
    ///
    /// # Example
    /// A particle of 2 kg at 0.5 m, horizontal, at 4 rad/s: ½ m l² ω² = 4 J.
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
    /// let tree = builder.build()?;
    /// let energies = tree.tree_energies(&mut tree.workspace(), &[0.0], &[4.0])?;
    /// assert_eq!((energies.kinetic, energies.potential), (4.0, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias("kinetic energy", "potential energy"))]
    pub fn tree_energies<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
    ) -> Result<TreeEnergies<T>, MultibodyError> {
        self.forward_velocities(work, q, v)?;
        let gravity = lit(self.gravity);
        let (mut twice, mut potential) = (T::zero(), T::zero());
        for (link, state) in self.links.iter().zip(&work.space[1..]) {
            let (mass, h) = (T::lit(link.mass), times(state.axes, lit(link.moment)));
            let w = transposed_times(state.axes, state.w);
            // About the origin: m |v|² + 2 v·(ω × h) + ω·I ω.
            twice += mass * dot(state.velocity, state.velocity)
                + T::lit(2.0) * dot(state.velocity, cross(state.w, h))
                + dot(w, symmetric_times(lit_symmetric(link.inertia), w));
            potential -= dot(gravity, add(scaled(mass, state.origin), h));
        }
        for (&armature, &v) in self.armature.iter().zip(v) {
            twice += T::lit(armature) * v * v;
        }
        Ok(TreeEnergies { kinetic: T::lit(0.5) * twice, potential })
    }

    /// The centre of mass and its velocity.
    ///
    /// # Errors
    /// As [`forward_velocities`](Self::forward_velocities).
    pub fn mass_centre<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
    ) -> Result<MassCentre<T>, MultibodyError> {
        self.forward_velocities(work, q, v)?;
        let (mut moment, mut momentum) = ([T::zero(); 3], [T::zero(); 3]);
        for (link, state) in self.links.iter().zip(&work.space[1..]) {
            let (mass, h) = (T::lit(link.mass), times(state.axes, lit(link.moment)));
            moment = add(moment, add(scaled(mass, state.origin), h));
            momentum = add(momentum, add(scaled(mass, state.velocity), cross(state.w, h)));
        }
        let mass = self.total_mass();
        let inverse = T::lit(mass.recip());
        Ok(MassCentre { mass, position: scaled(inverse, moment), velocity: scaled(inverse, momentum) })
    }

    /// Momentum and angular momentum about the centre of mass.
    ///
    /// # Errors
    /// As [`forward_velocities`](Self::forward_velocities).
    pub fn centroidal_momentum<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
    ) -> Result<CentroidalMomentum<T>, MultibodyError> {
        self.forward_velocities(work, q, v)?;
        self.composites(work);
        let reference = reference(&work.space);
        let mut sum = ([T::zero(); 3], [T::zero(); 3]);
        for (i, link) in self.links.iter().enumerate() {
            let mut own = work.composite[0];
            own_inertia(link, &work.space[i + 1], reference, &mut own);
            let motion = motion_at(&work.space[i + 1], reference);
            sum = add_pairs(sum, momentum(own.mass, own.moment, own.inertia, motion));
        }
        let centre = self.centre_from_reference(work);
        Ok(CentroidalMomentum { angular: sub(sum.0, cross(centre, sum.1)), linear: sum.1 })
    }

    /// The rate of the centroidal momentum: the moment about the centre of mass, and the force, of all that acts from
    /// outside, with gravity.
    ///
    /// # Errors
    /// As [`forward_accelerations`](Self::forward_accelerations).
    pub fn centroidal_momentum_rate<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
    ) -> Result<CentroidalMomentum<T>, MultibodyError> {
        check_length("a", self.freedoms, a.len())?;
        crate::error::check_finite("a", a)?;
        self.forward_velocities(work, q, v)?;
        pass_accelerations(self, &mut work.space, v, a);
        self.composites(work);
        let reference = reference(&work.space);
        let mut sum = ([T::zero(); 3], [T::zero(); 3]);
        for (i, link) in self.links.iter().enumerate() {
            let state = &work.space[i + 1];
            let mut own = work.composite[0];
            own_inertia(link, state, reference, &mut own);
            let motion = motion_at(state, reference);
            // Spatial acceleration: the classical one less ω × v, at the reference point.
            let linear = sub(state.acceleration, cross(state.w, state.velocity));
            let acceleration = (state.alpha, add(linear, cross(sub(state.origin, reference), state.alpha)));
            let h = momentum(own.mass, own.moment, own.inertia, motion);
            sum = add_pairs(sum, momentum(own.mass, own.moment, own.inertia, acceleration));
            sum = add_pairs(sum, force_cross(motion, h));
        }
        let centre = self.centre_from_reference(work);
        Ok(CentroidalMomentum { angular: sub(sum.0, cross(centre, sum.1)), linear: sum.1 })
    }

    /// The centroidal momentum matrix `A_G`, 6×n: angular rows, then linear ones. `out` holds 6 n entries, (i, j) at `i + 6 j`.
    ///
    /// # Errors
    /// As [`forward_kinematics`](Self::forward_kinematics).
    pub fn centroidal_momentum_matrix<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", 6 * self.freedoms, out.len())?;
        self.forward_kinematics(work, q)?;
        pass_subspaces(self, &work.space, &mut work.rows);
        self.composites(work);
        let centre = self.centre_from_reference(work);
        for (i, link) in self.links.iter().enumerate() {
            let beyond = &work.composite[i + 1];
            for j in link.v..link.v + link.kind.freedoms() {
                let (angular, linear) =
                    momentum(beyond.mass, beyond.moment, beyond.inertia, row_pair(&work.rows, SUBSPACE, j));
                out[6 * j..6 * j + 3].copy_from_slice(&sub(angular, cross(centre, linear)));
                out[6 * j + 3..6 * j + 6].copy_from_slice(&linear);
            }
        }
        if all_finite(out) { Ok(()) } else { crate::error::check_finite("out", out) }
    }

    /// Inertias of links with all beyond them, about the reference point; that of the tree is at 0.
    pub(crate) fn composites<T: Real>(&self, work: &mut TreeWorkspace<T>) {
        let reference = reference(&work.space);
        let TreeWorkspace { space, composite, .. } = work;
        composite[0].mass = T::zero();
        composite[0].moment = [T::zero(); 3];
        composite[0].inertia = [T::zero(); 6];
        for (i, link) in self.links.iter().enumerate() {
            own_inertia(link, &space[i + 1], reference, &mut composite[i + 1]);
        }
        for (i, link) in self.links.iter().enumerate().rev() {
            let child = composite[i + 1];
            add_inertia(&mut composite[link.parent], &child);
        }
    }

    /// From the reference point to the centre of mass; composites must be there.
    fn centre_from_reference<T: Real>(&self, work: &TreeWorkspace<T>) -> [T; 3] {
        scaled(T::lit(self.total_mass().recip()), work.composite[0].moment)
    }
}
