//! Answers allocate nothing.

use piola_fluids::CarreauYasuda;
use piola_testkit::allocations_in;
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, Estimate, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille,
    ViscometryError,
};

use super::fluids::Normal;

#[test]
fn allocations_of_an_answer_equal_zero() -> Result<(), Box<dyn std::error::Error>> {
    let thinning = CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?;
    let (distances, mut profile) = ([0.0, 0.25, 0.5, 0.75, 1.0], [Estimate::ZERO; 5]);
    let (count, outcome) = allocations_in(|| -> Result<(), ViscometryError> {
        let pipe = Poiseuille::with_discharge(1.0, 0.5, &thinning)?;
        pipe.profile_into(&thinning, &distances, &mut profile)?;
        pipe.stresses(&Normal, 0.5, 0.0)?;
        pipe.validity(&thinning, 1000.0, 2.0)?;
        Channel::with_discharge(1.0, 0.5, &thinning)?.velocity(&thinning, 0.5)?;
        let couette = Couette::with_speed_difference(1.0, 1.25, 0.5, &thinning)?.with_density(1000.0)?;
        couette.stresses(&Normal, 1.125)?;
        PlaneCouette::new(1.0, 0.5)?.stresses(&thinning)?;
        ConeAndPlate::with_torque(1.0, 0.05, 0.5, &thinning)?.thrust(&Normal)?;
        ParallelPlates::with_torque(1.0, 0.05, 0.5, &thinning)?.thrust(&Normal)?;
        Annulus::new(0.5, 1.0, 3.0)?.discharge(&thinning)?;
        FallingFilm::with_discharge(0.5, 1000.0, 9.8, 1.0, &thinning)?;
        Ok(())
    });
    outcome?;
    assert_eq!(count, 0);
    Ok(())
}
