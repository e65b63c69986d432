//! Integrals over bodies and parts of space, and what they state: resultants, transport, balance, virtual work.

mod estimate;
mod integrand;
mod mesh;
mod quadrature;
mod region;

pub use estimate::{AdaptiveQuadrature, Estimate, EstimatedQuadrature};
pub use integrand::Integrand;
pub use mesh::{BoundaryTriangle, TetrahedralMesh};
pub use quadrature::Quadrature;
pub use region::{Ball, Cuboid, Cylinder, Ellipsoid, Region, SphericalShell, SurfacePoint, VolumePoint};
