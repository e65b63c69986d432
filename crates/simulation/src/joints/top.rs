//! The heavy symmetric top of one spherical joint, in closed form.
//!
//! ```text
//! S = ½(ψ + φ) = arctan(z/w)     D = ½(ψ − φ) = arctan(x/y)     θ = 2 arctan(√(x²+y²)/√(w²+z²))
//! ```
//! of the attitude (w, x, y, z) by the angles φ, θ, ψ of the joint, z–y–z. Whole turns are those of
//! [`HeavyTop::turns`](piola_kinematics::HeavyTop::turns).

use core::f64::consts::PI;

use nalgebra::Vector3;
use piola_kinematics::{Attitude, EulerAngles, HeavyTop, Inertia};

use super::{JointMotion, Mechanism, PartKind};

/// A mechanism that is a heavy symmetric top, with its motion.
pub(crate) struct ClosedTop {
    motion: HeavyTop,
    /// S and D at the start.
    start: [f64; 2],
    /// Whether the centre of mass is below the joint along its third axis.
    hangs: bool,
}

impl ClosedTop {
    /// Nothing unless one spherical joint carries all parts, which together are one body, symmetric about the third axis of the
    /// joint, on which its centre of mass lies; and unless gravity is along z and acts alone.
    pub(crate) fn of(system: &Mechanism) -> Option<Self> {
        let tree = system.reduction().tree;
        let ([root], true) = (&tree.roots[..], system.forces.is_empty() && system.constraints.is_empty()) else {
            return None;
        };
        let joint = &tree.joints[*root];
        let ([part], [], JointMotion::Spherical) = (&joint.parts[..], &joint.children[..], joint.motion) else {
            return None;
        };
        let (PartKind::Body(body), [x, y, height], [gx, gy, gravity]) = (&part.kind, part.at, system.gravity) else {
            return None;
        };
        let along = |across: [f64; 2], axis: f64| across.iter().all(|x| x.abs() <= 4.0 * f64::EPSILON * axis.abs());
        let theta = [0, 1, 2].map(|i| system.position[i]);
        let rates = [0, 1, 2].map(|i| system.velocity[i]);
        // Angles beyond these are another chart, in which the axis comes back from the vertical as from a wall.
        let in_chart = 0.0 < theta[1] && theta[1] < PI;
        if !(along([x, y], height) && along([gx, gy], gravity) && 0.0 < height.abs() && gravity < 0.0 && in_chart) {
            return None;
        }
        let centre = Vector3::new(0.0, 0.0, height);
        let inertia = Inertia::new(body.inertia().about_offset_point(body.mass(), &centre)).ok()?;
        let omega = EulerAngles::zyz(theta).angular_velocity_in_body(rates);
        let arm = centre * (body.mass() * -gravity);
        let motion = HeavyTop::new(&inertia, arm, Attitude::from_euler_zyz(theta), omega).ok()?;
        let start = [0.5 * (theta[2] + theta[0]), 0.5 * (theta[2] - theta[0])];
        Some(Self { motion, start, hangs: height < 0.0 })
    }

    /// Writes the angles and their rates after `t` seconds; rates that are not numbers in the vertical, where they have no limit.
    pub(crate) fn write(&self, t: f64, state: &mut [f64]) {
        let (attitude, omega) = self.motion.at(t);
        let [sum, difference] = self.motion.turns(t);
        // About the arm, which is the third axis or its opposite.
        let grown = if self.hangs { [difference, -sum] } else { [sum, -difference] };
        let Attitude { w, x, y, z } = attitude;
        let [s, d] = [0, 1].map(|i| {
            let (near, found) = (self.start[i] + grown[i], [z.atan2(w), x.atan2(y)][i]);
            found + PI * ((near - found) / PI).round()
        });
        let theta = [s - d, 2.0 * x.hypot(y).atan2(w.hypot(z)), s + d];
        let rates = EulerAngles::zyz(theta).rates(&omega).map_or([f64::NAN; 3], |found| found.rates);
        state[..3].copy_from_slice(&theta);
        state[3..6].copy_from_slice(&rates);
    }
}

impl Mechanism {
    /// Whether the motion has a closed form: a body on one spherical joint, symmetric about the third axis of the joint, on which
    /// its centre of mass lies, under gravity along −z alone.
    ///
    /// # Example
    /// See [`Method::ClosedForm`](crate::motion::Method::ClosedForm).
    #[must_use]
    pub fn has_closed_form(&self) -> bool {
        ClosedTop::of(self).is_some()
    }
}
