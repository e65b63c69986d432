//! Homogeneous solids: volume, centre of mass and inertia in closed form.
//!
//! ```text
//! I = ∫ (|r|² 1 − r⊗r) dμ,   r from the centre of mass                    W(2.33)
//! ```
//!
//! | solid | placed | principal moments / M |
//! |---|---|---|
//! | cuboid a×b×c | edges along x, y, z, origin at the centre | (b²+c²)/12, (c²+a²)/12, (a²+b²)/12 |
//! | cylinder R, h | axis z, origin at the centre | R²/4 + h²/12 (twice), R²/2 |
//! | hollow cylinder r < R, h | axis z, origin at the centre | (R²+r²)/4 + h²/12 (twice), (R²+r²)/2 |
//! | capsule R, h | axis z, origin at the centre; h between the centres of its caps | of its parts, see below |
//! | torus R, a | axis z, origin at the centre; a ≤ R the radius of the tube | R²/2 + 5a²/8 (twice), R² + 3a²/4 |
//! | sphere R | origin at the centre | 2R²/5 |
//! | spherical shell R | origin at the centre, no thickness | 2R²/3 |
//! | cone R, h | apex at the origin, axis +z, base at z = h | 3R²/20 + 3h²/80 (twice), 3R²/10 |
//! | ellipsoid a, b, c | semi-axes along x, y, z, origin at the centre | (b²+c²)/5, (c²+a²)/5, (a²+b²)/5 |
//! | disc R | normal z, origin at the centre, no thickness | R²/4 (twice), R²/2 |
//! | tetrahedron | by its vertices | – |
//!
//! The parts of a capsule are a cylinder of mass m and two half balls of mass n together, m : n = h : 4R/3:
//! m(R²/4 + h²/12) + n(2R²/5 + h²/4 + 3hR/8) across, mR²/2 + 2nR²/5 about the axis.
//!
//! A thin rod has no attitude about its own axis and is no rigid body here (see [`Inertia`]); use
//! [`thin_rod`], whose three particles move as the rod does.

use nalgebra::{Matrix3, Vector3};

use crate::error::{KinematicsError, finite};
use crate::inertia::{Inertia, point_inertia};
use crate::rigid_body::RigidBody;
use crate::system::ParticleSystem;

/// A homogeneous solid, lengths in m; the [module](self) says how each is placed in its body axes.
///
/// # Example
/// ```
/// use piola_kinematics::solids::Solid;
/// let ball = Solid::Sphere { radius: 0.5 };
/// assert_eq!(ball.inertia(10.0)?.matrix()[(0, 0)], 1.0); // 2/5 · 10 · ¼
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum Solid {
    /// A rectangular block.
    #[doc(alias("box", "rectangular block"))]
    Cuboid {
        /// Lengths of the edges along x, y, z.
        edges: [f64; 3],
    },
    /// A circular cylinder.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height along z.
        height: f64,
    },
    /// A circular cylinder with a coaxial hole all through.
    HollowCylinder {
        /// Radius of the hole.
        inner_radius: f64,
        /// Radius.
        outer_radius: f64,
        /// Height along z.
        height: f64,
    },
    /// A cylinder with half balls on both ends.
    Capsule {
        /// Radius of the cylinder and the caps.
        radius: f64,
        /// Height of the cylinder alone, along z.
        height: f64,
    },
    /// A ring of circular cross-section.
    Torus {
        /// Radius of the ring's centre line.
        radius: f64,
        /// Radius of the cross-section.
        tube_radius: f64,
    },
    /// A ball.
    #[doc(alias = "ball")]
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A sphere of negligible thickness, its mass on the surface.
    #[doc(alias = "hollow sphere")]
    SphericalShell {
        /// Radius.
        radius: f64,
    },
    /// A circular cone.
    Cone {
        /// Radius of the base.
        radius: f64,
        /// Height from apex to base.
        height: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Semi-axes along x, y, z.
        semi_axes: [f64; 3],
    },
    /// A circular plate of negligible thickness.
    Disc {
        /// Radius.
        radius: f64,
    },
    /// A tetrahedron.
    Tetrahedron {
        /// Corners, in body components.
        vertices: [[f64; 3]; 4],
    },
}

impl Solid {
    /// The volume it encloses (m³); zero for a disc.
    ///
    /// # Errors
    /// [`KinematicsError::NonPositiveSize`], [`KinematicsError::NoVolume`], [`KinematicsError::NotFinite`].
    pub fn volume(&self) -> Result<f64, KinematicsError> {
        use core::f64::consts::PI;
        self.check()?;
        Ok(match *self {
            Self::Cuboid { edges: [a, b, c] } => a * b * c,
            Self::Cylinder { radius, height } => PI * radius * radius * height,
            Self::HollowCylinder { inner_radius, outer_radius, height } => {
                PI * (outer_radius - inner_radius) * (outer_radius + inner_radius) * height
            }
            Self::Capsule { radius, height } => PI * radius * radius * (height + 4.0 / 3.0 * radius),
            Self::Torus { radius, tube_radius } => 2.0 * PI * PI * radius * tube_radius * tube_radius,
            Self::Sphere { radius } | Self::SphericalShell { radius } => 4.0 / 3.0 * PI * radius * radius * radius,
            Self::Cone { radius, height } => PI * radius * radius * height / 3.0,
            Self::Ellipsoid { semi_axes: [a, b, c] } => 4.0 / 3.0 * PI * a * b * c,
            Self::Disc { .. } => 0.0,
            Self::Tetrahedron { vertices } => tetrahedron_volume(&vertices),
        })
    }

    /// The centre of mass in the axes in which the solid is placed (m).
    ///
    /// # Errors
    /// As [`volume`](Solid::volume).
    pub fn centre_of_mass(&self) -> Result<Vector3<f64>, KinematicsError> {
        self.check()?;
        Ok(match *self {
            Self::Cone { height, .. } => Vector3::new(0.0, 0.0, 0.75 * height),
            Self::Tetrahedron { vertices } => vertices.map(Vector3::from).iter().sum::<Vector3<f64>>() * 0.25,
            _ => Vector3::zeros(),
        })
    }

    /// The inertia tensor about the centre of mass for a total mass (kg).
    ///
    /// # Errors
    /// As [`volume`](Solid::volume) and [`RigidBody::new`].
    ///
    /// # Accuracy
    /// A few ulps; no cancellation, also for a tetrahedron far from the origin of its vertices.
    ///
    /// # Source
    /// W(2.33), integrated.
    pub fn inertia(&self, mass: f64) -> Result<Inertia, KinematicsError> {
        crate::error::positive_mass(mass)?;
        self.check()?;
        let diagonal = |x: f64, y: f64, z: f64| Inertia::principal([mass * x, mass * y, mass * z]);
        match *self {
            Self::Cuboid { edges: [a, b, c] } => {
                let (a, b, c) = (a * a / 12.0, b * b / 12.0, c * c / 12.0);
                diagonal(b + c, c + a, a + b)
            }
            Self::Cylinder { radius, height } => {
                let across = radius * radius / 4.0 + height * height / 12.0;
                diagonal(across, across, radius * radius / 2.0)
            }
            Self::HollowCylinder { inner_radius, outer_radius, height } => {
                let squares = inner_radius * inner_radius + outer_radius * outer_radius;
                let across = squares / 4.0 + height * height / 12.0;
                diagonal(across, across, squares / 2.0)
            }
            Self::Capsule { radius, height } => {
                let share = height / (height + 4.0 / 3.0 * radius);
                let (m, n) = (share, 1.0 - share);
                let square = radius * radius;
                let caps = 0.4 * square + 0.25 * height * height + 0.375 * height * radius;
                let across = m * (square / 4.0 + height * height / 12.0) + n * caps;
                diagonal(across, across, m * square / 2.0 + n * 0.4 * square)
            }
            Self::Torus { radius, tube_radius } => {
                let (ring, tube) = (radius * radius, tube_radius * tube_radius);
                let across = 0.5 * ring + 0.625 * tube;
                diagonal(across, across, ring + 0.75 * tube)
            }
            Self::Sphere { radius } => {
                let moment = 0.4 * radius * radius;
                diagonal(moment, moment, moment)
            }
            Self::SphericalShell { radius } => {
                let moment = 2.0 / 3.0 * radius * radius;
                diagonal(moment, moment, moment)
            }
            Self::Cone { radius, height } => {
                let across = 0.15 * radius * radius + 0.0375 * height * height;
                diagonal(across, across, 0.3 * radius * radius)
            }
            Self::Ellipsoid { semi_axes: [a, b, c] } => {
                let (a, b, c) = (a * a / 5.0, b * b / 5.0, c * c / 5.0);
                diagonal(b + c, c + a, a + b)
            }
            Self::Disc { radius } => {
                let across = radius * radius / 4.0;
                diagonal(across, across, radius * radius / 2.0)
            }
            Self::Tetrahedron { vertices } => {
                // About the centre ∫r⊗r dμ = (m/20) Σ a⊗a over the corners a: four particles of m/20.
                let centre = self.centre_of_mass()?;
                let corners = vertices.map(|v| point_inertia(mass / 20.0, &(Vector3::from(v) - centre)));
                Inertia::new(corners.iter().sum::<Matrix3<f64>>())
            }
        }
    }

    /// The rigid body of the given mass (kg); its axes are those in which the solid is placed.
    ///
    /// # Errors
    /// As [`inertia`](Solid::inertia).
    pub fn body(&self, mass: f64) -> Result<RigidBody, KinematicsError> {
        RigidBody::new(mass, self.inertia(mass)?)
    }

    /// 0 < every length, 0 < volume of a tetrahedron, all finite.
    fn check(&self) -> Result<(), KinematicsError> {
        match self {
            Self::Cuboid { edges } => positive("edge", edges),
            Self::Ellipsoid { semi_axes } => positive("semi-axis", semi_axes),
            Self::Sphere { radius } | Self::SphericalShell { radius } | Self::Disc { radius } => {
                positive("radius", &[*radius])
            }
            Self::HollowCylinder { inner_radius, outer_radius, height } => {
                positive("inner radius", &[*inner_radius])?;
                positive("outer radius", &[*outer_radius])?;
                positive("height", &[*height])?;
                positive("outer radius less inner radius", &[outer_radius - inner_radius])
            }
            Self::Torus { radius, tube_radius } => {
                positive("radius", &[*radius])?;
                positive("tube radius", &[*tube_radius])?;
                if *radius < *tube_radius {
                    let quantity = "radius less tube radius";
                    return Err(KinematicsError::NonPositiveSize { quantity, value: radius - tube_radius });
                }
                Ok(())
            }
            Self::Cylinder { radius, height } | Self::Cone { radius, height } | Self::Capsule { radius, height } => {
                positive("radius", &[*radius])?;
                positive("height", &[*height])
            }
            Self::Tetrahedron { vertices } => {
                finite("vertices", vertices.as_flattened())?;
                let longest = vertices[1..]
                    .iter()
                    .map(|v| (Vector3::from(*v) - Vector3::from(vertices[0])).norm())
                    .fold(0.0, f64::max);
                let volume = tetrahedron_volume(vertices);
                if volume <= FLAT * longest * longest * longest {
                    return Err(KinematicsError::NoVolume { volume });
                }
                Ok(())
            }
        }
    }
}

/// Volumes below this multiple of the cubed length are zero to rounding.
pub(crate) const FLAT: f64 = 16.0 * f64::EPSILON;

/// |(b−a)·(c−a)×(d−a)|/6.
fn tetrahedron_volume(vertices: &[[f64; 3]; 4]) -> f64 {
    let [a, b, c, d] = vertices.map(Vector3::from);
    (b - a).dot(&(c - a).cross(&(d - a))).abs() / 6.0
}

fn positive(quantity: &'static str, values: &[f64]) -> Result<(), KinematicsError> {
    for (index, &value) in values.iter().enumerate() {
        if !value.is_finite() {
            return Err(KinematicsError::NotFinite { quantity, index, value });
        }
        if value <= 0.0 {
            return Err(KinematicsError::NonPositiveSize { quantity, value });
        }
    }
    Ok(())
}

/// Three particles (kg, m) that move as a uniform thin rod from `start` to `end`: m/6 at each end and 2m/3
/// in the middle have its mass, centre of mass and inertia m ℓ²/12.
///
/// # Errors
/// [`KinematicsError::NonPositiveMass`], [`KinematicsError::NotFinite`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::solids::thin_rod;
/// let rod = thin_rod(12.0, &Vector3::zeros(), &Vector3::new(2.0, 0.0, 0.0))?;
/// let about_centre: f64 = rod.iter().map(|(m, x)| m * (x.x - 1.0).powi(2)).sum();
/// assert_eq!(about_centre, 4.0); // 12 · 2²/12
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
pub fn thin_rod(
    mass: f64,
    start: &Vector3<f64>,
    end: &Vector3<f64>,
) -> Result<[(f64, Vector3<f64>); 3], KinematicsError> {
    crate::error::positive_mass(mass)?;
    for (quantity, point) in [("start", start), ("end", end)] {
        finite(quantity, point.as_slice())?;
    }
    let tip = mass / 6.0;
    Ok([(tip, *start), (4.0 * tip, start * 0.5 + end * 0.5), (tip, *end)])
}

/// The rigid body made of fixed particles or enclosed by a mesh, with the place of its centre of mass.
///
/// # Example
/// See [`body_of_particles`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PlacedBody {
    /// The body; its axes are parallel to those of the given positions.
    pub body: RigidBody,
    /// Its centre of mass in those axes (m).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub centre_of_mass: Vector3<f64>,
}

/// The rigid body made of particles with fixed mutual positions (kg, m).
///
/// # Errors
/// As [`ParticleSystem::new`] and [`Inertia::new`]: particles on one line are no rigid body.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::solids::body_of_particles;
/// let corners = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y()];
/// let cross = body_of_particles(&[1.0; 4], &corners)?;
/// assert_eq!(cross.body.inertia().principal_moments(), [2.0, 2.0, 4.0]);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(2.33).
pub fn body_of_particles(masses: &[f64], positions: &[Vector3<f64>]) -> Result<PlacedBody, KinematicsError> {
    // The velocities do not matter: the positions stand in for them.
    let system = ParticleSystem::new(masses, positions, positions)?;
    let inertia = Inertia::new(system.inertia_about_centre_of_mass())?;
    Ok(PlacedBody { body: RigidBody::new(system.mass(), inertia)?, centre_of_mass: system.centre_of_mass() })
}
