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
//! | a sector is straightened, family 2, W(25.35–25.39) | [`MovingSector`] |
//! | a tube is inflated and stretched, family 3 | [`MovingTube`] |
//! | a sphere is inflated, family 4 | [`MovingSphere`] |
//! | a tube or a shell oscillates under a constant pressure | [`RadialOscillation`] |
//!
//! All but the last are a [`MovingFamily`]; what depends on time is a history over any scalar, so that rates are exact.
//!
//! # Source
//! W(25.30–25.39); C. Truesdell, Arch. Rational Mech. Anal. 11 (1962) 106.

mod moving;
mod oscillation;
mod sector;
mod sphere;
mod tube;

pub use moving::{AsMovingMotion, MovingFamily};
pub use oscillation::{Orbit, Oscillator, RadialOscillation, RadialState, RestState};
pub use sector::{MovingSector, SectorHistory};
pub use sphere::{MovingSphere, SphereHistory};
pub use tube::{MovingTube, TubeHistory};
