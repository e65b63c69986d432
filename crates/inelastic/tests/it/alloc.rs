//! No update allocates.

use core::error::Error;
use core::hint::black_box;

use piola_continuum::DeformationGradient;
use piola_inelastic::{InelasticPoint, StepControl};
use piola_testkit::allocations_in;

use super::paths::{bergstrom_boyce, kinematic, mullins, viscoplastic};

#[test]
fn allocations_in_updates_equal_zero() -> Result<(), Box<dyn Error>> {
    let to = DeformationGradient::simple_shear(0.25)?;
    let (flowing, plastic, damaged, back) = (bergstrom_boyce()?, viscoplastic(0.0)?, mullins()?, kinematic(0.0)?);
    let (count, ()) = allocations_in(|| {
        let _ = black_box(InelasticPoint::new(&flowing).advance(&to, 0.1, &StepControl::default()));
        let _ = black_box(InelasticPoint::new(&plastic).advance(&to, 0.1, &StepControl::one_step()));
        let _ = black_box(InelasticPoint::new(&back).advance(&to, 0.1, &StepControl::one_step()));
        let _ = black_box(InelasticPoint::new(&damaged).advance(&to, 0.1, &StepControl::default()));
        let _ = black_box(InelasticPoint::new(&flowing).advance_stress(&to, 0.1, &StepControl::default()));
    });
    assert_eq!(count, 0);
    Ok(())
}
