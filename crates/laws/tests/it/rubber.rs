//! Laws of rubber and foam: `testdata/golden/rubber_laws.json`, identities, refusals.

use core::error::Error;
use core::hint::black_box;

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_laws::rubber::{
    AnyRubber, Carroll, ExtendedTube, FoamTerm, Hyperfoam, LopezPamies, RubberShape, VanDerWaals,
};
use piola_laws::{OfStretches, examine};
use piola_numerics::{Lanes, Real};
use piola_solids::isochoric::{ArrudaBoyce, Isochoric, MooneyRivlin, NeoHookean};
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, Hyperelastic, IncompressibleSolid, SolidsError, derived};
use piola_testkit::golden::{self, matrix, number};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale};
use serde_json::Value;

type Fallible = Result<(), Box<dyn Error>>;

/// The laws of the golden file, with the energy ½ κ (J − 1)² of the volume.
fn law(name: &str, params: &Value) -> Result<AnyRubber, Box<dyn Error>> {
    let p = |name: &str| number(&params[name]);
    let volume = || Ok::<_, SolidsError>(Some(Quadratic::new(p("kappa"))?.into()));
    Ok(match name {
        "carroll" => AnyRubber::of_shape(Carroll::new(p("a"), p("b"), p("c"))?, volume()?)?,
        "lopez_pamies" => {
            let shape = LopezPamies::new(p("mu1"), p("alpha1"), p("mu2"), p("alpha2"))?;
            AnyRubber::of_shape(shape, volume()?)?
        }
        "van_der_waals" => AnyRubber::of_shape(VanDerWaals::new(p("mu"), p("locking"), p("a"), p("beta"))?, volume()?)?,
        "extended_tube" => AnyRubber::of_tube(ExtendedTube::new(p("gc"), p("delta"), p("ge"), p("beta"))?, volume()?)?,
        _ => foam(&params["terms"])?.into(),
    })
}

fn foam(terms: &Value) -> Result<Hyperfoam, SolidsError> {
    let term = |row: Vec<f64>| FoamTerm { modulus: row[0], exponent: row[1], poisson_ratio: row[2] };
    Hyperfoam::new(&matrix(terms).into_iter().map(term).collect::<Vec<_>>())
}

/// All laws, with the parameters of the golden file.
fn all() -> Result<Vec<(String, AnyRubber)>, Box<dyn Error>> {
    let mut found: Vec<(String, AnyRubber)> = Vec::new();
    for case in golden::load("rubber_laws").cases {
        let name = golden::text(&case["law"]);
        if found.iter().all(|(other, _)| other != name) {
            found.push((name.to_owned(), law(name, &case["params"])?));
        }
    }
    assert_eq!(found.len(), 5);
    Ok(found)
}

#[test]
fn rubber_and_foam_equal_reference() -> Fallible {
    let cases = golden::load("rubber_laws").cases;
    assert_eq!(cases.len(), 20);
    for case in cases {
        let (id, name, output) = (golden::text(&case["id"]), golden::text(&case["law"]), &case["output"]);
        let law = law(name, &case["params"])?;
        let rows = matrix(&case["input"]["F"]);
        let f = DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])))?;
        assert_eq!(law.check(&f), Ok(()), "{id}");
        let (energy, stress, tangent) = law.energy_first_piola_and_tangent(&f);
        let sums = Tol::ulps(64.0);
        // F keeps strains of 1e-6 to some ten digits.
        let small = Tol::stated(4e-10, "F of a strain of 1e-6 has lost six digits of it");
        let of_stress = if id.ends_with("small") { small } else { sums };
        assert_close(&format!("{id}: W"), &[energy], &[number(&output["W"])], of_stress);
        let expected = matrix(&output["P"]).concat();
        assert_close(&format!("{id}: P"), stress.0.transpose().as_slice(), &expected, of_stress);
        let expected = matrix(&output["dP_dF"]).concat();
        let cusp = Tol::stated(1e-7, "∂²W/∂x² of the van der Waals law is bounded near rest");
        let of_tangent = if id == "van_der_waals/small" { cusp } else { sums };
        assert_close(&format!("{id}: dP_dF"), &tangent.0.components.concat(), &expected, of_tangent);
    }
    Ok(())
}

fn deformations(count: usize) -> Vec<DeformationGradient> {
    let mut random = Random::new(31);
    let one = |random: &mut Random| {
        let stretches = core::array::from_fn(|_| (0.3 * random.symmetric()).exp());
        let f = with_stretches(&random.rotation(), stretches, &random.rotation());
        DeformationGradient::from_rows(f).expect("0 < det F")
    };
    (0..count).map(|_| one(&mut random)).collect()
}

/// Frame-indifference, an energy and a stress that are zero at rest, finite answers: all by `examine`.
#[test]
fn laws_of_rubber_pass_the_examination() -> Fallible {
    for (name, law) in all()? {
        assert_eq!(examine(&law, 0.3), Ok(()), "{name}");
    }
    Ok(())
}

/// W(F Q) = W(F): isotropy; P = ∂W/∂F, and ∂P/∂F is its derivative and symmetric.
#[test]
fn answers_of_rubber_equal_derivatives_of_their_energies() -> Fallible {
    let tol = Tol::ulps_because(1024.0, "two orders of summation of some hundred terms, chains half way to their end");
    for (name, law) in all()? {
        for f in deformations(4) {
            let (p, a) = law.first_piola_and_tangent(&f);
            let (q, b) = derived::first_piola_and_tangent(&law, &f);
            assert_close(&format!("{name}: P"), p.0.as_slice(), q.0.as_slice(), tol);
            assert_close(&format!("{name}: ∂P/∂F"), &a.0.components.concat(), &b.0.components.concat(), tol);
            let components = a.0.components;
            for (i, row) in components.iter().enumerate() {
                let column: Vec<f64> = components.iter().map(|other| other[i]).collect();
                let scale = components.concat().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                assert_close_at_scale(&format!("{name}: symmetry"), row, &column, scale, Tol::ulps(64.0));
            }
            let turn = Random::new(7).rotation();
            let mut turned = [[0.0; 3]; 3];
            for (i, row) in turned.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry = (0..3).map(|k| f.gradient_rows()[i][k] * turn[k][j]).sum();
                }
            }
            let turned = DeformationGradient::from_rows(turned)?;
            assert_close(&format!("{name}: isotropy"), &[law.energy(&turned)], &[law.energy(&f)], tol);
        }
    }
    Ok(())
}

#[test]
fn lanes_of_rubber_equal_single_values() -> Fallible {
    let points = deformations(4);
    let rows: [[Lanes<f64, 4>; 3]; 3] = core::array::from_fn(|i| {
        core::array::from_fn(|j| Lanes::from(core::array::from_fn(|lane| points[lane].gradient_rows()[i][j])))
    });
    let together = DeformationGradient::from_rows(rows)?;
    for (name, law) in all()? {
        let stress = law.first_piola(&together).0;
        for (lane, f) in points.iter().enumerate() {
            let alone = law.first_piola(f).0;
            let found: Vec<f64> = stress.iter().map(|x| x.primal(lane)).collect();
            let tol =
                Tol::ulps_because(64.0, "elementary functions of lanes differ by two ulp from those of the library");
            assert_close(&format!("{name}, lane {lane}"), &found, alone.as_slice(), tol);
        }
    }
    Ok(())
}

/// Stress in single precision agrees with double to its digits.
#[test]
fn single_precision_of_rubber_equals_double() -> Fallible {
    for (name, law) in all()? {
        for f in deformations(2) {
            #[expect(clippy::cast_possible_truncation, reason = "rounded to single precision")]
            let rows = f.gradient_rows().map(|row| row.map(|x| x as f32));
            let short = law.first_piola(&DeformationGradient::<f32>::from_rows(rows)?).0;
            let found: Vec<f64> = short.iter().map(|x| f64::from(*x)).collect();
            let tol = Tol::stated(1e-4, "single precision, chains half way to their end");
            assert_close(&name, &found, law.first_piola(&f).0.as_slice(), tol);
        }
    }
    Ok(())
}

/// α = 1, A alone, long chains without attraction and δ = 0: the neo-Hookean law; β = 2 of the tube: Mooney and Rivlin's.
#[test]
fn limits_of_rubber_equal_simpler_laws() -> Fallible {
    let volume = Quadratic::new(5.0)?;
    let plain = Compressible::new(NeoHookean::new(0.8)?, volume);
    let any = |shape: RubberShape| AnyRubber::of_shape(shape, Some(volume.into()));
    let laws = [
        ("Lopez-Pamies", any(LopezPamies::new(0.5, 1.0, 0.3, 1.0)?.into())?),
        ("Carroll", any(Carroll::new(0.4, 0.0, 0.0)?.into())?),
        ("van der Waals", any(VanDerWaals::new(0.8, 1e20, 0.0, 0.0)?.into())?),
        ("tube", AnyRubber::of_tube(ExtendedTube::new(0.8, 0.0, 0.0, 1.0)?, Some(volume.into()))?),
    ];
    let tol = Tol::ulps(64.0);
    for f in deformations(3) {
        for (name, law) in &laws {
            assert_close(name, law.first_piola(&f).0.as_slice(), plain.first_piola(&f).0.as_slice(), tol);
        }
        let tube = AnyRubber::of_tube(ExtendedTube::new(0.8, 0.0, 0.5, 2.0)?, Some(volume.into()))?;
        let both = Compressible::new(MooneyRivlin::new(0.4, 0.25)?, volume);
        assert_close("tube", tube.first_piola(&f).0.as_slice(), both.first_piola(&f).0.as_slice(), tol);
    }
    Ok(())
}

/// λₜ = λ^(−ν) of a bar whose terms share one ν: no stress across it.
#[test]
fn sides_of_a_bar_of_foam_at_the_closed_form_stretch_are_free() -> Fallible {
    let term = |modulus, exponent| FoamTerm { modulus, exponent, poisson_ratio: 0.3 };
    let law = OfStretches(Hyperfoam::new(&[term(1.0, 8.0), term(0.5, -2.0)])?);
    for stretch in [0.4_f64, 0.8, 1.5, 2.5] {
        let side = stretch.powf(-0.3);
        let stress = law.first_piola(&DeformationGradient::diagonal([stretch, side, side])?).0;
        let scale = stress[(0, 0)].abs();
        assert_close_at_scale("P₂₂", &[stress[(1, 1)]], &[0.0], scale, Tol::ulps(64.0));
    }
    Ok(())
}

/// The shear modulus at rest as the formulas state it.
#[test]
fn shear_moduli_of_rubber_equal_their_formulas() -> Fallible {
    let shear = |law: &AnyRubber| {
        let small = DisplacementGradient::from_rows([[0.0, 1e-9, 0.0], [0.0; 3], [0.0; 3]]).expect("finite");
        law.first_piola(&small).0[(0, 1)] / 1e-9
    };
    let tube = ExtendedTube::new(0.5, 0.25, 0.375, 0.625)?;
    let expected = [0.5 * (1.0 - 0.125) + 0.375, tube.shear_modulus()];
    let tol = Tol::stated(1e-9, "a shear of 1e-9: the chord of a law with √x in its slope");
    assert_close("tube", &[shear(&AnyRubber::of_tube(tube, None)?); 2], &expected, tol);
    let van = VanDerWaals::new(0.75, 2.5, 0.25, 0.1875)?;
    assert_close("van der Waals", &[shear(&AnyRubber::of_shape(van, None)?)], &[0.75], tol);
    let carroll = Carroll::new(0.5, 0.125, 0.25)?;
    let expected = 2.0 * (0.5 + 13.5 + 0.25 / (2.0 * 3.0_f64.sqrt()));
    assert_close("Carroll", &[carroll.shear_modulus()], &[expected], Tol::ulps(4.0));
    Ok(())
}

/// A body that keeps its volume answers with no stress at rest, and refuses a change of volume and what lies beyond its limit.
#[test]
fn laws_of_rubber_refuse_parameters_and_deformations_by_name() -> Fallible {
    let refused = |found: Result<(), SolidsError>| matches!(found, Err(SolidsError::BeyondLimit { .. }));
    let van = AnyRubber::of_shape(VanDerWaals::new(1.0, 2.0, 0.1, 0.0)?, None)?;
    assert!(refused(van.check(&DeformationGradient::simple_shear(1.5)?)) && van.is_incompressible());
    assert!(refused(van.check(&DeformationGradient::dilatation(1.1)?)));
    let tube = AnyRubber::of_tube(ExtendedTube::new(1.0, 0.5, 0.0, 1.0)?, None)?;
    assert!(refused(tube.check(&DeformationGradient::simple_shear(2.5)?)) && tube.is_incompressible());
    let torn: f64 = tube.energy(&DeformationGradient::simple_shear(2.5)?);
    assert!(torn.is_nan());
    for (name, law) in [("van der Waals", &van), ("tube", &tube)] {
        let rest = law.first_piola(&DeformationGradient::identity()).0;
        assert_close(name, rest.as_slice(), &[0.0; 9], Tol::ulps(1.0));
    }
    let named = |error: Option<SolidsError>, expected: &str| {
        let text = error.map(|error| error.to_string()).unwrap_or_default();
        assert!(text.contains(expected), "{text}");
    };
    named(Carroll::new(f64::NAN, 1.0, 1.0).err(), "linear");
    named(Carroll::new(-1.0, 0.0, 0.0).err(), "0 < A + 108 B + C/(2 √3)");
    named(LopezPamies::new(1.0, 0.0, 1.0, 1.0).err(), "α1 ≠ 0");
    named(VanDerWaals::new(1.0, 1.7, 0.0, 0.0).err(), "3 < λm²");
    named(VanDerWaals::new(1.0, 5.0, -0.1, 0.0).err(), "0 ≤ a");
    named(VanDerWaals::new(1.0, 5.0, 0.1, 1.5).err(), "0 ≤ β ≤ 1");
    named(ExtendedTube::new(1.0, 0.8, 1.0, 1.0).err(), "2 δ² < 1");
    named(ExtendedTube::new(1.0, 0.1, 1.0, 0.0).err(), "1e-6 ≤ β");
    let term = |modulus, exponent, poisson_ratio| [FoamTerm { modulus, exponent, poisson_ratio }];
    named(Hyperfoam::new(&[]).err(), "1 ≤ number of terms ≤ 6");
    named(Hyperfoam::new(&term(1.0, 0.0, 0.2)).err(), "α ≠ 0");
    named(Hyperfoam::new(&term(1.0, 2.0, 0.5)).err(), "−1 < ν < ½");
    named(Hyperfoam::new(&term(-1.0, 2.0, 0.2)).err(), "0 < Σ μ");
    Ok(())
}

#[test]
fn allocations_in_evaluations_of_rubber_equal_zero() -> Fallible {
    let f = DeformationGradient::simple_shear(0.25)?;
    for (name, law) in all()? {
        let (count, ()) = allocations_in(|| {
            let _ = black_box((law.energy_first_piola_and_tangent(&f), law.second_piola(&f), law.kirchhoff(&f)));
        });
        assert_eq!(count, 0, "{name}");
    }
    Ok(())
}

/// The eight chains of `solids` are exact: their stress has the inverse Langevin function itself.
#[test]
fn eight_chains_have_the_inverse_langevin_function_not_its_series() -> Fallible {
    // ℒ(β) = coth β − 1/β at β = 20; the chain's stretch there.
    let (beta, links) = (20.0_f64, 9.0);
    let chain = 1.0 / beta.tanh() - 1.0 / beta;
    let first = 3.0 * links * chain * chain - 3.0;
    let slope: [f64; 2] = ArrudaBoyce::new(2.0, links)?.slopes(first, 0.0);
    assert_close("∂W/∂I₁", &[slope[0]], &[2.0 * beta / (6.0 * chain)], Tol::ulps_because(512.0, "1/(1 − λ) = 20"));
    let law = IncompressibleSolid::new(ArrudaBoyce::new(2.0, links)?);
    assert!(law.check(&DeformationGradient::simple_shear(5.5)?).is_err());
    Ok(())
}

#[cfg(feature = "serde")]
#[test]
fn written_laws_of_rubber_equal_those_read() -> Fallible {
    for (name, law) in all()? {
        let text = serde_json::to_string(&law)?;
        assert_eq!(serde_json::from_str::<AnyRubber>(&text)?, law, "{name}: {text}");
    }
    let solid = r#"{"law":"saint_venant_kirchhoff","first_lame_parameter":1.0,"shear_modulus":2.0}"#;
    assert!(serde_json::from_str::<AnyRubber>(solid)?.solid().is_some());
    let wrong = r#"{"law":"rubber","shape":{"law":"carroll","a":-1.0,"b":0.0,"c":0.0}}"#;
    assert!(serde_json::from_str::<AnyRubber>(wrong).is_err());
    // A refusal names the parameter and its bound, or the field, or the laws that there are.
    for (text, expected) in [
        (r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 10.0, "shear_modulus": -2.0}"#, "0 < μ"),
        (r#"{"law": "rubber", "shape": {"law": "carroll", "linear": -1.0, "quartic": 0.0, "root": 0.0}}"#, "0 < A"),
        (r#"{"law": "hyperfoam", "terms": []}"#, "1 ≤ number of terms ≤ 6"),
        (r#"{"law": "blatz_ko", "shear_modulus": 1.0, "poisson_ratio": 0.25}"#, "missing field `solid_fraction`"),
        (r#"{"law": "rubber", "shape": {"law": "gum"}}"#, "unknown variant `gum`, expected one of `carroll`"),
        (r#"{"law": "gum"}"#, "`anisotropic_saint_venant_kirchhoff`, `rubber`, `extended_tube`, `hyperfoam`"),
        (r#"{"shear_modulus": 1.0}"#, "missing field `law`"),
    ] {
        let error = serde_json::from_str::<AnyRubber>(text).map(|_| ()).expect_err(text).to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
    Ok(())
}
