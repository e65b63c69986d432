//! Homogeneous specimens take the next increment of a point.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_inelastic::{InelasticPoint, StepControl};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{Controls, equilibrium, uniaxial};
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

type Family = fn(f64) -> Result<Controls, SpecimensError>;
/// A name, the test at a drive, and the components of P that vanish.
type Test = (&'static str, Family, &'static [(usize, usize)]);

/// Each test of the homogeneous family, driven over three increments in time.
#[test]
fn free_faces_of_every_homogeneous_test_have_no_stress_over_time() -> Result<(), Box<dyn Error>> {
    let law = reese_govindjee()?;
    let control = StepControl::new(1e-5)?;
    let tol = Tol::stated(1e-9, "the specimen's equilibrium");
    let families: [Test; 4] = [
        ("uniaxial", |x| Controls::uniaxial(1.0 + x), &[(1, 1), (2, 2)]),
        ("equibiaxial", |x| Controls::equibiaxial(1.0 + x), &[(2, 2)]),
        ("planar", |x| Controls::planar(1.0 + x), &[(2, 2)]),
        ("shear", |x| Controls::simple_shear(x, true), &[(2, 2)]),
    ];
    for (name, family, free) in families {
        let mut point = InelasticPoint::new(&law);
        let mut here = DisplacementGradient::zero();
        let mut stresses = Vec::new();
        for drive in [0.15, 0.3, 0.3] {
            here = equilibrium(&point.next(0.5, control), &family(drive)?, &here)?.deformation;
            let to = DeformationGradient::from_rows(here.gradient_rows())?;
            let stress = point.advance(&to, 0.5, &control)?.first_piola.0;
            let found: Vec<f64> = free.iter().map(|place| stress[*place]).collect();
            assert_close_at_scale(name, &found, &vec![0.0; found.len()], stress.amax(), tol);
            stresses.push(stress.amax());
        }
        // Pulled, pulled further, held: the stress rises, then relaxes.
        assert!(stresses[0] < stresses[1] && stresses[2] < stresses[1], "{name}: {stresses:?}");
    }
    Ok(())
}
