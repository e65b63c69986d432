//! Fluids: reference values, identities, limits and refusals.

#[cfg(feature = "motions")]
mod alloc;
#[cfg(feature = "serde")]
mod any;
mod batch;
#[cfg(feature = "motions")]
mod differential;
mod elastic;
mod extremes;
mod golden;
#[cfg(feature = "motions")]
mod histories;
#[cfg(feature = "motions")]
mod kbkz;
#[cfg(feature = "fields")]
mod navier_stokes;
#[cfg(feature = "motions")]
mod nonlinear;
mod references;
mod refusals;
#[cfg(feature = "motions")]
mod responses;
mod shear;
#[cfg(feature = "motions")]
mod steady;
#[cfg(feature = "motions")]
mod stokesian;
#[cfg(feature = "motions")]
mod stresses;
#[cfg(feature = "motions")]
mod temperature;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
