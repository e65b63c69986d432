//! Tangents against exact second derivatives of two energies, and round trips.

use piola_continuum::stress::tangents::ObjectiveRate::{
    GreenNaghdi, Jaumann, Logarithmic, LowerConvected, UpperConvected,
};
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient};
use piola_tensor::{Major, Minor, PairSymmetric};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{all, deformation, flat, rotation};
use super::energies::{FIBRES, first_piola, green, material, second_piola};

/// |F|² |F⁻¹|² ≤ 12² for the stretches drawn, and the derivatives' own rounding.
const ROUND_TRIP: f64 = 4096.0;

fn material_tangent(deformation: &DeformationGradient, fibres: f64) -> MaterialTangent {
    let tangent = material(&green(deformation.gradient_rows()), fibres);
    MaterialTangent(tangent.major_symmetric().expect("an energy has symmetric second derivatives"))
}

fn cauchy(deformation: &DeformationGradient, fibres: f64) -> CauchyStress {
    second_piola(&green(deformation.gradient_rows()), fibres).cauchy(deformation)
}

const CANCELLED: Tol =
    Tol::ulps_because(2048.0, "two factors F and a stress whose terms cancel, stretches from 1/2 to 2");
const PUSHED: Tol = Tol::ulps_because(256.0, "four factors F, stretches from 1/2 to 2, and a rotation");
const FIRST_PIOLA: Tol = Tol::ulps_because(256.0, "two factors F, stretches from 1/2 to 2, and a rotation");
const SPUN: Tol = Tol::ulps_because(1024.0, "four factors F and the spin of the stretches, of 1/2 to 2");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn first_piola_tangent_of_the_material_one_equals_second_derivatives_in_f(d in deformation()) {
        for fibres in FIBRES {
            let stress = second_piola(&green(d.gradient_rows()), fibres);
            let converted = material_tangent(&d, fibres).first_piola(&stress, &d);
            let expected = first_piola(d.gradient_rows(), fibres).1;
            assert_close("dP/dF", &flat(&converted.0), &flat(&expected), CANCELLED);
            let back = FirstPiolaTangent(expected).material(&stress, &d);
            let size = back.0.norm();
            assert_close_at_scale("dS/dE", &all(&back.0), &all(&material_tangent(&d, fibres).0), size, Tol::ulps(ROUND_TRIP));
        }
    }

    #[test]
    fn conversions_of_tangents_commute_and_return(d in deformation()) {
        for fibres in FIBRES {
            let (c, stress) = (material_tangent(&d, fibres), cauchy(&d, fibres));
            let truesdell = c.truesdell(&d);
            let close = |what: &str, a: &dyn Fn() -> Vec<f64>, b: Vec<f64>| {
                assert_close(what, &a(), &b, Tol::ulps(ROUND_TRIP));
            };
            close("material", &|| all(&truesdell.material(&d).0), all(&c.0));
            close("Lie", &|| all(&truesdell.lie(&d).0), all(&c.lie(&d).0));
            let jaumann = truesdell.jaumann(&stress);
            close("Jaumann", &|| all(&jaumann.truesdell(&stress).0), all(&truesdell.0));
            for rate in [UpperConvected, Jaumann, LowerConvected, GreenNaghdi, Logarithmic] {
                let there = truesdell.of_kirchhoff_rate(rate, &stress, &d);
                let back = || all(&TruesdellTangent::from_kirchhoff_rate(&there, rate, &stress, &d).0);
                close("of Kirchhoff", &back, all(&truesdell.0));
                let there = truesdell.of_cauchy_rate(rate, &stress, &d);
                let back = || all(&TruesdellTangent::from_cauchy_rate(&there, rate, &stress, &d).0);
                close("of Cauchy", &back, all(&truesdell.0));
            }
        }
    }

    #[test]
    fn tangents_of_the_turned_body_are_the_turned_tangents(d in deformation(), q in rotation()) {
        let turned = DeformationGradient::new(q * d.matrix()).expect("0 < det F");
        for fibres in FIBRES {
            let c = material_tangent(&d, fibres);
            let stress = second_piola(&green(d.gradient_rows()), fibres);
            let of_turned = c.truesdell(&turned);
            let rotated = c.truesdell(&d).rotated(&q).expect("a rotation");
            assert_close("Truesdell", &all(&of_turned.0), &all(&rotated.0), PUSHED);
            let converted = c.first_piola(&stress, &turned);
            let rotated = c.first_piola(&stress, &d).rotated(&q).expect("a rotation");
            assert_close("∂P/∂F", &flat(&converted.0), &flat(&rotated.0), FIRST_PIOLA);
            let before = cauchy(&d, fibres);
            let after = before.rotated(&q).expect("a rotation");
            let after = c.truesdell(&turned).of_kirchhoff_rate(GreenNaghdi, &after, &turned);
            let before = c.truesdell(&d).of_kirchhoff_rate(GreenNaghdi, &before, &d).rotated(&q).expect("a rotation");
            assert_close("Green–Naghdi", &all(&after), &all(&before), SPUN);
        }
    }

    #[test]
    fn tangents_without_the_claim_of_major_symmetry_are_the_same(d in deformation()) {
        let (c, stress) = (material_tangent(&d, 3.0), cauchy(&d, 3.0));
        let general: MaterialTangent<f64, Minor> = MaterialTangent(c.0.minor());
        let (major, minor) = (c.truesdell(&d).jaumann(&stress), general.truesdell(&d).jaumann(&stress));
        assert_close("tangent", &all(&minor.0), &all(&major.0), Tol::ulps(64.0));
        let second = second_piola(&green(d.gradient_rows()), 3.0);
        let (a, b) = (c.first_piola(&second, &d), general.first_piola(&second, &d));
        prop_assert_eq!(a, b);
        let _: MaterialTangent<f64, Major> = c;
    }
}
