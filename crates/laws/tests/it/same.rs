//! A law of one's own answers as the built-in one of the same formula.

use core::error::Error;

use piola_continuum::{DeformationGradient, DisplacementGradient};
use piola_numerics::{Lanes, Real};
use piola_solids::Hyperelastic;
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::zoo::{self, Visit};

/// Random deformations with stretches between 0.7 and 1.5.
fn deformations(count: usize) -> Vec<DeformationGradient> {
    let mut random = Random::new(20);
    let stretch = |random: &mut Random| (0.4 * random.symmetric()).exp();
    let one = |random: &mut Random| {
        let stretches = [stretch(random), stretch(random), stretch(random)];
        let f = with_stretches(&random.rotation(), stretches, &random.rotation());
        DeformationGradient::from_rows(f).expect("0 < det F")
    };
    (0..count).map(|_| one(&mut random)).collect()
}

struct Same;

impl Visit for Same {
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        built_in: &B,
    ) -> Result<(), Box<dyn Error>> {
        let what = |quantity: &str| format!("{name} by {way}: {quantity}");
        let tol = Tol::ulps_because(256.0, "two orders of summation of some hundred terms");
        for f in deformations(20) {
            assert_close(&what("W"), &[own.energy(&f)], &[built_in.energy(&f)], tol);
            let (stress, tangent) = own.first_piola_and_tangent(&f);
            let (expected, expected_tangent) = built_in.first_piola_and_tangent(&f);
            let scale = expected_tangent.0.components.concat().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            assert_close_at_scale(&what("P"), stress.0.as_slice(), expected.0.as_slice(), scale, tol);
            assert_close_at_scale(&what("P alone"), own.first_piola(&f).0.as_slice(), stress.0.as_slice(), scale, tol);
            let entries = |tangent: [[f64; 9]; 9]| tangent.concat();
            assert_close(&what("∂P/∂F"), &entries(tangent.0.components), &entries(expected_tangent.0.components), tol);
            let (stress, tangent) = own.second_piola_and_tangent(&f);
            let (expected, expected_tangent) = built_in.second_piola_and_tangent(&f);
            assert_close_at_scale(&what("S"), &stress.0.components, &expected.0.components, scale, tol);
            assert_close(&what("∂S/∂E"), &tangent.0.components, &expected_tangent.0.components, tol);
            let (own, built_in) = (own.kirchhoff(&f).0.components, built_in.kirchhoff(&f).0.components);
            assert_close_at_scale(&what("τ"), &own, &built_in, scale, tol);
        }
        Ok(())
    }
}

#[test]
fn answers_of_own_laws_equal_those_of_built_in_ones() -> Result<(), Box<dyn Error>> {
    zoo::each(&mut Same)
}

struct SmallStrain;

impl Visit for SmallStrain {
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        built_in: &B,
    ) -> Result<(), Box<dyn Error>> {
        if (name, way) == ("neo_hookean", "general") {
            // Its terms are of first order: μ (tr E − ln J).
            return Ok(());
        }
        let tol = Tol::stated(1e-13, "the stress keeps its digits at small strain");
        let mut random = Random::new(21);
        for exponent in [3, 6, 9, 12, 15, 16] {
            for _ in 0..5 {
                let h = random.matrix().map(|row| row.map(|x| x * 10.0_f64.powi(-exponent)));
                let f = DisplacementGradient::from_rows(h)?;
                let what = format!("{name} by {way} at 1e-{exponent}");
                let expected = built_in.first_piola(&f).0;
                assert_close(&what, own.first_piola(&f).0.as_slice(), expected.as_slice(), tol);
                assert_close(&what, own.first_piola_and_tangent(&f).0.0.as_slice(), expected.as_slice(), tol);
                let expected = built_in.second_piola(&f).0.components;
                assert_close(&what, &own.second_piola(&f).0.components, &expected, tol);
                assert_close(&what, &[own.energy(&f)], &[built_in.energy(&f)], tol);
            }
        }
        Ok(())
    }
}

#[test]
fn stresses_of_own_laws_at_small_strain_equal_those_of_built_in_ones_in_all_digits() -> Result<(), Box<dyn Error>> {
    zoo::each(&mut SmallStrain)
}

struct InLanes;

impl Visit for InLanes {
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        _built_in: &B,
    ) -> Result<(), Box<dyn Error>> {
        let tol = Tol::ulps_because(64.0, "elementary functions of lanes within 2 ulp");
        let points = deformations(4);
        let rows = |i: usize, j: usize| Lanes([0, 1, 2, 3].map(|lane: usize| points[lane].matrix()[(i, j)]));
        let f = DeformationGradient::new(nalgebra::Matrix3::from_fn(rows))?;
        let (stress, tangent) = own.first_piola_and_tangent(&f);
        for (lane, point) in points.iter().enumerate() {
            let (alone, tangent_alone) = own.first_piola_and_tangent(point);
            let of_lane = |x: &Lanes<f64, 4>| x.primal(lane);
            let entries: Vec<f64> = tangent.0.components.concat().iter().map(of_lane).collect();
            assert_close(&format!("{name} by {way}: ∂P/∂F"), &entries, &tangent_alone.0.components.concat(), tol);
            let scale = entries.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let entries: Vec<f64> = stress.0.iter().map(of_lane).collect();
            assert_close_at_scale(&format!("{name} by {way}: P"), &entries, alone.0.as_slice(), scale, tol);
        }
        Ok(())
    }
}

#[test]
fn own_laws_in_lanes_equal_themselves_at_single_points() -> Result<(), Box<dyn Error>> {
    zoo::each(&mut InLanes)
}
