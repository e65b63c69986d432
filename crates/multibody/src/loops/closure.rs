//! What can be tied to what.

use crate::error::{MultibodyError, check_finite};
use crate::link::Kind;
use crate::spatial::dot;
use crate::tree::{BodyIndex, FrameIndex, RigidTree};

/// A point of a body, or of the ground.
///
/// # Example
/// ```
/// use piola_multibody::{BodyIndex, BodyPoint};
/// assert_eq!(BodyPoint::new(BodyIndex::GROUND, [1.0, 0.0, 0.0]).at[0], 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPoint {
    /// The body.
    pub body: BodyIndex,
    /// The point in the body's frame, m.
    pub at: [f64; 3],
}

impl BodyPoint {
    /// A point (m) in the frame of a body.
    #[must_use]
    pub const fn new(body: BodyIndex, at: [f64; 3]) -> Self {
        Self { body, at }
    }
}

/// A tie between bodies, frames or coordinates, with as many conditions as it takes freedoms.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum LoopClosure {
    /// Two points coincide: three conditions, in space axes. The multipliers are the force on the first body, N.
    Point {
        /// A point of one body.
        first: BodyPoint,
        /// A point of another.
        second: BodyPoint,
    },
    /// Two axes are parallel: two conditions. With a [`Point`](Self::Point) they make a hinge. The multipliers are moments on
    /// the first body, N m.
    Axis {
        /// One body.
        first: BodyIndex,
        /// A unit vector in its frame.
        first_axis: [f64; 3],
        /// Another body.
        second: BodyIndex,
        /// A unit vector in its frame.
        second_axis: [f64; 3],
    },
    /// Two frames coincide: six conditions, force and moment on the first.
    Frame {
        /// A frame on one body.
        first: FrameIndex,
        /// A frame on another.
        second: FrameIndex,
    },
    /// Two points keep a distance, as at the ends of a massless rod: one condition. The multiplier is the force that
    /// pushes them apart, N.
    Distance {
        /// A point of one body.
        first: BodyPoint,
        /// A point of another.
        second: BodyPoint,
        /// The distance, m.
        length: f64,
    },
    /// `q_follower = ratio q_leader + offset`: gears, and mimic joints of files. The multiplier is the torque on the follower.
    Gear {
        /// The freedom of a joint with one coordinate.
        follower: usize,
        /// The freedom of another.
        leader: usize,
        /// The ratio.
        ratio: f64,
        /// The follower's coordinate where the leader's is zero.
        offset: f64,
    },
    /// A coordinate moves as prescribed. The multiplier is the driving torque or force; its product with the rate is the
    /// power.
    Prescribed {
        /// The freedom of a joint with one coordinate.
        freedom: usize,
        /// Value, rate and second rate at a time (s).
        motion: fn(f64) -> [f64; 3],
    },
}

impl LoopClosure {
    /// The number of conditions.
    #[must_use]
    pub const fn conditions(&self) -> usize {
        match self {
            Self::Point { .. } => 3,
            Self::Axis { .. } => 2,
            Self::Frame { .. } => 6,
            Self::Distance { .. } | Self::Gear { .. } | Self::Prescribed { .. } => 1,
        }
    }

    pub(super) fn check(&self, name: &str, tree: &RigidTree) -> Result<(), MultibodyError> {
        let invalid = |quantity, value, condition| {
            Err(MultibodyError::InvalidClosure { closure: name.to_owned(), quantity, value, condition })
        };
        match *self {
            Self::Point { first, second } | Self::Distance { first, second, .. } => {
                for point in [first, second] {
                    tree.mounted(point.body)?;
                    check_finite("point", &point.at)?;
                }
                match *self {
                    Self::Distance { length, .. } if !(length.is_finite() && 0.0 < length) => {
                        invalid("length", length, "0 < x < ∞")
                    }
                    _ => Ok(()),
                }
            }
            Self::Axis { first, first_axis, second, second_axis } => {
                for (body, axis) in [(first, first_axis), (second, second_axis)] {
                    tree.mounted(body)?;
                    let length = dot(axis, axis).sqrt();
                    if length.is_nan() || 1e-9 < (length - 1.0).abs() {
                        return invalid("length of an axis", length, "|axis| = 1");
                    }
                }
                Ok(())
            }
            Self::Frame { first, second } => {
                tree.mounted_frame(first)?;
                tree.mounted_frame(second)?;
                Ok(())
            }
            Self::Gear { follower, leader, ratio, offset } => {
                check_finite("ratio and offset", &[ratio, offset])?;
                coordinate(tree, follower)?;
                coordinate(tree, leader)?;
                Ok(())
            }
            Self::Prescribed { freedom, .. } => coordinate(tree, freedom).map(|_| ()),
        }
    }
}

/// The coordinate of a freedom that is the rate of one.
pub(super) fn coordinate(tree: &RigidTree, freedom: usize) -> Result<usize, MultibodyError> {
    let link = tree.links.iter().find(|link| link.v == freedom);
    match link {
        Some(link) if !matches!(link.kind, Kind::Spherical | Kind::Free) => Ok(link.q),
        _ => Err(MultibodyError::NoSuchIndex {
            what: "freedom of a joint with one coordinate",
            index: freedom,
            count: tree.freedoms,
        }),
    }
}
