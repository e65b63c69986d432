//! What a body looks like, for pictures.

use piola_kinematics::Attitude;

/// A shape that a file draws for a body.
///
/// # Example
/// ```
/// use piola_multibody::{Urdf, UrdfOptions, VisualShape};
/// let text = r#"<robot name="post"><link name="post"><visual><origin xyz="0 0 1"/>
///   <geometry><cylinder radius="0.1" length="2"/></geometry></visual></link></robot>"#;
/// let robot = Urdf::parse(text, UrdfOptions::default())?;
/// assert_eq!(robot.visuals[0].shape, VisualShape::Cylinder { radius: 0.1, length: 2.0 });
/// assert_eq!((robot.visuals[0].body.as_str(), robot.visuals[0].origin[2]), ("post", 1.0));
/// # Ok::<(), piola_multibody::MultibodyError>(())
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
    /// A ball.
    Sphere {
        /// Its radius, m.
        radius: f64,
    },
    /// A mesh in a file.
    Mesh {
        /// The name that the file gives it.
        file: String,
    },
}
