//! What a body looks like, for pictures.

use piola_kinematics::Attitude;

/// A shape that a file draws for a body.
///
/// # Example
/// ```
/// use piola_kinematics::Attitude;
/// use piola_multibody::{Visual, VisualShape};
/// let shape = VisualShape::Cylinder { radius: 0.1, length: 2.0 };
/// let post = Visual { body: "post".to_owned(), origin: [0.0, 0.0, 1.0], attitude: Attitude::identity(), shape };
/// assert_eq!(post.origin[2], 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Visual {
    /// The body.
    pub body: String,
    /// The middle of the shape in the body's frame, m.
    pub origin: [f64; 3],
    /// The attitude of the shape in the body's frame.
    pub attitude: Attitude<f64>,
    /// The shape.
    pub shape: VisualShape,
}

/// A shape about its middle.
///
/// # Example
/// See [`Visual`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum VisualShape {
    /// A box.
    Box {
        /// Its sides along x, y and z, m.
        sides: [f64; 3],
    },
    /// A cylinder along z.
    Cylinder {
        /// Its radius, m.
        radius: f64,
        /// Its length, m.
        length: f64,
    },
    /// A sphere.
    Sphere {
        /// Its radius, m.
        radius: f64,
    },
    /// A mesh in a file.
    Mesh {
        /// The name that the file gives it. Its scale is not read.
        file: String,
    },
}
