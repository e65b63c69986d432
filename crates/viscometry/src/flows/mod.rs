//! The flows.
//!
//! A flow is numbers: its geometry and its drive. The fluid comes with the question, and a question computes what it returns and nothing
//! else: no profile for a discharge, no normal stresses for a velocity, none at all for a fluid that has none.

mod annulus;
mod channel;
mod cone_and_plate;
mod couette;
mod declaration;
mod falling_film;
mod parallel_plates;
mod plane_couette;
mod poiseuille;
mod turning;
mod wall;

pub use annulus::Annulus;
pub use channel::Channel;
pub use cone_and_plate::ConeAndPlate;
pub use couette::Couette;
pub use falling_film::FallingFilm;
pub use parallel_plates::ParallelPlates;
pub use plane_couette::PlaneCouette;
pub use poiseuille::Poiseuille;

use piola_fluids::ViscometricFluid;

use crate::{Estimate, ViscometryError};

/// Implements the profile of a flow whose velocity depends on one place.
macro_rules! profiles {
    ($($flow:ty),+) => {
        $(impl $flow {
            /// v, m/s, at each of the places, m, into `velocities`.
            ///
            /// # Errors
            /// As [`velocity`](Self::velocity); [`ViscometryError::WrongLength`].
            pub fn profile_into<F: ViscometricFluid + ?Sized>(
                &self,
                fluid: &F,
                places: &[f64],
                velocities: &mut [Estimate],
            ) -> Result<(), ViscometryError> {
                wall::profile(Self::NAME, places, velocities, |place| self.velocity(fluid, place))
            }
        })+
    };
}
profiles!(Channel, Couette, FallingFilm, Poiseuille);
