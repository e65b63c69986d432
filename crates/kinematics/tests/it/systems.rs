//! Placement maps that several tests use.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody, Solid};
use piola_numerics::Real;

/// A top of 2 kg carried by a turning table; q = Eulerian angles and the distance from the table's axis.
pub(crate) struct TopOnTable {
    pub(crate) top: RigidBody,
    pub(crate) table_speed: f64,
}

impl TopOnTable {
    pub(crate) fn new() -> Self {
        let top = Solid::Cone { radius: 0.5, height: 1.5 }.body(2.0).expect("a cone");
        Self { top, table_speed: 1.5 }
    }
}

impl Holonomic for TopOnTable {
    const TIME_DEPENDENT: bool = true;

    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let turn = T::lit(self.table_speed) * t;
        let (s, c) = turn.sin_cos();
        let attitude = Attitude::about_z(turn).product(Attitude::from_euler_zyz([q[0], q[1], q[2]]));
        let foot = Vector3::new(q[3] * c, q[3] * s, T::zero());
        let arm = attitude.to_space(&Vector3::new(T::zero(), T::zero(), T::lit(1.125)));
        bodies.body(&self.top, foot + arm, attitude);
        bodies.particle(0.25, foot);
    }
}

/// A double pendulum in the plane x–z, which does not depend on time.
pub(crate) struct DoublePendulum {
    pub(crate) length: [f64; 2],
}

impl Holonomic for DoublePendulum {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = Vector3::zeros();
        for (length, &angle) in self.length.iter().zip(q) {
            let (s, c) = angle.sin_cos();
            end += Vector3::new(T::lit(*length) * s, T::zero(), -T::lit(*length) * c);
            bodies.particle(1.0, end);
        }
    }
}
