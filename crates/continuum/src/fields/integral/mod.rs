//! Integrals over bodies and parts of space, and what they state: resultants, transport, balance, virtual work.

mod balance;
mod element;
mod estimate;
mod integrand;
mod mesh;
mod quadrature;
mod region;
mod resultants;
mod transport;

pub use balance::{EnergyBalance, IntegralBalance, MassBalance, StoredEnergy, strain_energy, stress_power};
pub use element::{ExplicitMotion, LinearTetrahedra, MaterialPoint, QuadraticTetrahedra, TetrahedralElements};
pub use estimate::{AdaptiveQuadrature, Estimate, EstimatedQuadrature};
pub use integrand::Integrand;
pub use mesh::{BoundaryTriangle, TetrahedralMesh};
pub use quadrature::Quadrature;
pub use region::{Ball, Cuboid, Cylinder, Ellipsoid, MovedRegion, Region, SphericalShell, SurfacePoint, VolumePoint};
pub use resultants::{ForceResultants, Resultants};
pub use transport::{Transport, divergence_theorem, tensor_divergence_theorem, transport, transport_of_mass};
