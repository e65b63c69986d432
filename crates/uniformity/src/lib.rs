//! Materially uniform bodies: material connections, dislocations, characteristic metric, residual stress.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod body;
mod burgers;
pub mod connection;
mod curve;
mod error;
mod flatness;
pub mod group;
mod indices;
pub mod isomorphism;
pub mod laminated;
mod map;
mod metric;
mod moebius;
mod noll;
pub mod residual_stress;
mod sampled;
mod transport;

pub use body::{MapOfMetric, MateriallyUniformBody, StressInMotion};
pub use burgers::{BurgersVector, DislocationDensity};
pub use connection::{
    AffineConnection, ConnectionCoefficients, ConnectionCurvature, ConnectionIn, LeviCivita, MaterialConnection,
    MaterialityResidual, Torsion,
};
pub use curve::{PolygonalCurve, ReferenceCurve, RoundCircuit, Segment};
pub use error::UniformityError;
pub use flatness::{CircuitDefects, Flatness, LargestDefect};
pub use group::{LieAlgebra, NominalGroup};
pub use map::{ConstantMap, HomogeneousIn, InverseMap, UniformityMap};
pub use metric::{CharacteristicMetric, MetricGeometry};
pub use moebius::MoebiusCrystal;
pub use noll::NollEquations;
pub use sampled::{SampledUniformityMap, UniformityMapSamples};
pub use transport::TransportedFrame;
