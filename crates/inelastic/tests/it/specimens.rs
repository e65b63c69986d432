//! Homogeneous specimens take the next increment of a point.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient};
use piola_inelastic::{InelasticPoint, StepControl};
use piola_specimens::homogeneous::uniaxial;
use piola_testkit::{Tol, assert_close_at_scale};

use super::paths::{reese_govindjee, viscoplastic};

#[test]
fn sides_of_a_bar_of_the_next_increment_are_free_of_stress() -> Result<(), Box<dyn Error>> {
    let tol = Tol::stated(1e-9, "the specimen's equilibrium");
    let law = reese_govindjee()?;
    let mut point = InelasticPoint::new(&law);
    for stretch in [1.2, 1.4, 1.1] {
        let bar = uniaxial(&point.next(0.25, StepControl::default()), stretch)?;
        let to = DeformationGradient::from_rows(bar.deformation.gradient_rows())?;
        let stress = point.advance(&to, 0.25, &StepControl::default())?.first_piola.0;
        let sides = [stress[(1, 1)], stress[(2, 2)], stress[(0, 1)], stress[(1, 2)]];
        assert_close_at_scale("P", &sides, &[0.0; 4], stress[(0, 0)].abs(), tol);
    }
    let law = viscoplastic(0.0)?;
    let point = InelasticPoint::new(&law);
    let bar = uniaxial(&point.next(0.25, StepControl::one_step()), 1.2)?;
    let stress = bar.first_piola.0;
    assert_close_at_scale("P", &[stress[(1, 1)], stress[(2, 2)]], &[0.0; 2], stress[(0, 0)].abs(), tol);
    Ok(())
}
