//! Universal motions of incompressible isotropic solids: families whose constants depend on time and whose acceleration has
//! a potential; radial oscillations.
//!
//! ```text
//! a = −grad ζ        T = T_static − ρ ζ 1        div T = ρ a
//! ```
//! ζ here is the potential of the acceleration; p = `p_static` + ρ ζ.
//!
//! | motion | type |
//! |---|---|
//! | a block is bent, family 1 | [`MovingBlock`] |
//! | a sector is straightened, family 2, W(25.35–25.39) | [`MovingSector`] |
//! | a tube is inflated, stretched and twisted, family 3 | [`MovingTube`] |
//! | a sphere is inflated, family 4 | [`MovingSphere`] |
//! | a sector is sheared azimuthally, family 5 | [`MovingShear`] |
//! | a tube or a shell oscillates under a constant pressure | [`RadialOscillation`] |
//!
//! All but the last are a [`MovingFamily`]; what depends on time is a history over any scalar, so that rates are exact. The
//! families 1, 2, 3 and 5 have a potential only if their constants satisfy conditions, which each type states: its stress is
//! refused with the condition that is violated. Family 0 in motion is in [`homogeneous`](crate::homogeneous).
//!
//! # Source
//! W(25.30–25.39); C. Truesdell, Arch. Rational Mech. Anal. 11 (1962) 106.

mod block;
mod cylinder;
mod moving;
mod oscillation;
mod sector;
mod shear;
mod sphere;
mod tube;

pub use block::{BlockHistory, MovingBlock};
pub use moving::{AsMovingMotion, MovingFamily, NamedCondition};
pub use oscillation::{Orbit, Oscillator, RadialOscillation, RadialState, RestState};
pub use sector::{MovingSector, SectorHistory};
pub use shear::{MovingShear, ShearHistory};
pub use sphere::{MovingSphere, SphereHistory};
pub use tube::{MovingTube, TubeHistory};
