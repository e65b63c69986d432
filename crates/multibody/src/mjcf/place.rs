//! Where a frame stands in another.

use nalgebra::Vector3;
use piola_kinematics::Attitude;

use crate::spatial::{add, sub};

/// Origin (m) and attitude of a frame in another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) origin: [f64; 3],
    pub(super) attitude: Attitude<f64>,
}

impl Place {
    pub(super) fn identity() -> Self {
        Self { origin: [0.0; 3], attitude: Attitude::identity() }
    }

    pub(super) fn at(origin: [f64; 3]) -> Self {
        Self { origin, ..Self::identity() }
    }

    /// Components of a vector in the outer frame.
    pub(super) fn turn(&self, vector: [f64; 3]) -> [f64; 3] {
        self.attitude.to_space(&Vector3::from(vector)).into()
    }

    /// A point in the outer frame.
    pub(super) fn point(&self, inner: [f64; 3]) -> [f64; 3] {
        add(self.origin, self.turn(inner))
    }

    /// The place, in the outer frame, of a frame that has the place `inner` in this one.
    pub(super) fn then(&self, inner: &Self) -> Self {
        Self { origin: self.point(inner.origin), attitude: self.attitude.product(inner.attitude) }
    }

    /// The place in this frame of a frame that has the place `outer` beside it.
    pub(super) fn seen(&self, outer: &Self) -> Self {
        let arm = self.attitude.to_body(&Vector3::from(sub(outer.origin, self.origin)));
        Self { origin: arm.into(), attitude: self.attitude.conjugate().product(outer.attitude) }
    }
}

/// The least turn that takes z to a direction of any length but zero.
pub(super) fn turn_of_z(direction: [f64; 3]) -> Attitude<f64> {
    let [x, y, z] = direction;
    let across = x.hypot(y);
    let (axis, angle) = if across <= 1e-10 * z.abs() {
        (Vector3::x(), if z < 0.0 { core::f64::consts::PI } else { 0.0 })
    } else {
        (Vector3::new(-y, x, 0.0), across.atan2(z))
    };
    Attitude::from_axis_angle(&axis, angle).unwrap_or_else(|_| Attitude::identity())
}
