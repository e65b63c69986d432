//! UMAT and VUMAT of elastic laws, compiled by gfortran and driven along one-element paths, return the library's numbers to the last bit.

use nalgebra::Matrix3;
use piola::continuum::DeformationGradient;
use piola::solids::{AnySolid, Hyperelastic, MooneyRivlin};
use piola::tensor::PairSymmetric;
use piola::tensor::voigt::{Abaqus, StressVector};
use piola_ffi::abaqus::{Stretching, vumat};
use piola_ffi::named::solid;

use crate::abaqus::umat_of;
use crate::programs::{compiled, crate_folder, has, printed};

fn bits(words: &[&str]) -> Vec<f64> {
    words.iter().map(|word| f64::from_bits(u64::from_str_radix(word, 16).unwrap())).collect()
}

fn law(name: &str) -> AnySolid {
    match name {
        "MOONEY_RIVLIN" => MooneyRivlin::stress_free(0.5, 0.25, 1.0).unwrap().into(),
        "COMPRESSIBLE-GENT-SIMO_TAYLOR" => solid("compressible-gent-simo_taylor", &[1.0, 50.0, 100.0]).unwrap(),
        _ => solid("neo_hookean-lame", &[2.0, 3.0]).unwrap(),
    }
}

#[test]
fn umat_and_vumat_return_the_bits_of_the_library() {
    if !has("gfortran") {
        return;
    }
    let folder = crate_folder();
    let include = format!("-I{}", folder.join("tests/fortran").display());
    let flags = ["-O1", "-ffp-contract=off", "-Wall", "-Wno-unused-dummy-argument", &include];
    let sources = ["fortran/umat.f", "fortran/vumat.f", "tests/fortran/driver.f90"].map(|file| folder.join(file));
    let program = compiled("gfortran", "fortran", &flags, &sources);
    let materials = program.parent().unwrap();
    let tread =
        r#"{"law": "neo_hookean", "shear_modulus": 2.0, "volumetric": {"law": "lame", "first_lame_parameter": 3.0}}"#;
    std::fs::write(materials.join("tread.json"), tread).unwrap();
    let text = printed(&program, &[("PIOLA_MATERIALS", materials)]);
    let (mut points, mut blocks) = (0, 0);
    let mut last: [Vec<f64>; 3] = Default::default();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [path @ ("uniaxial" | "shear" | "held"), name, shear, ref numbers @ ..] => {
                let numbers = bits(numbers);
                compare_point(&law(name), shear.parse().unwrap(), &numbers);
                // The three materials follow each other. They are elastic: the stress of a held element does not relax.
                if path == "held" {
                    assert_eq!(numbers, last[points % 3], "{name}");
                }
                last[points % 3] = numbers;
                points += 1;
            }
            [which @ ("vumat" | "start"), shear, ref numbers @ ..] => {
                let (numbers, shear) = (bits(numbers), shear.parse().unwrap());
                let (given, found) = numbers.split_at(numbers.len() / 2);
                let mut expected = vec![0.0; given.len()];
                let added = if which == "start" { 1.0 } else { 0.0 };
                let stretching = Stretching { before: &[], after: given, added, dt: 1.0, temperatures: &[] };
                let material = law("MOONEY_RIVLIN").into();
                vumat(&material, [3, shear], stretching, (&[], &mut []), &mut expected).unwrap();
                assert_eq!(found, expected, "{which}");
                blocks += 1;
            }
            _ => {}
        }
    }
    assert_eq!((points, blocks), (75, 4));
    assert!(text.contains("smaller 0.25") && !text.contains("state"), "{text}");
    assert!(text.contains("law `mooney_rivlin` takes c10, c01, square_coefficient; 1 numbers were given"), "{text}");
    assert!(text.trim_end().ends_with("exit"), "{text}");
}

/// The numbers of one line: F by columns, STRESS, DDSDDE.
fn compare_point(law: &AnySolid, shear: usize, numbers: &[f64]) {
    let count = 3 + shear;
    let f = numbers.first_chunk::<9>().unwrap();
    let (mut stress, mut tangent) = (vec![0.0; count], vec![0.0; count * count]);
    umat_of(law, [3, shear], f, &mut stress, &mut tangent).unwrap();
    assert_eq!(numbers[9..9 + count], stress);
    assert_eq!(numbers[9 + count..], tangent);
    // The types of the library, one point at a time: the same bits where no elementary function is in the law.
    let deformation = DeformationGradient::new(Matrix3::from_column_slice(f)).unwrap();
    let (first_piola, tangent) = law.first_piola_and_tangent(&deformation);
    let cauchy = first_piola.kirchhoff(&deformation).cauchy(&deformation);
    let expected = StressVector::<f64, Abaqus>::of(&cauchy.0).components;
    let jaumann = tangent.spatial(&cauchy, &deformation).jaumann(&cauchy);
    let upper = piola::tensor::MajorSymmetric::from_slots(&jaumann.0.components);
    let square = piola::tensor::voigt::StiffnessMatrix::<f64, Abaqus>::of(&upper).entries;
    // The way by ∂S/∂E, which shares nothing with `spatial`.
    let (_, material) = law.second_piola_and_tangent(&deformation);
    let other = material.truesdell(&deformation).jaumann(&cauchy);
    let other = piola::tensor::voigt::StiffnessMatrix::<f64, Abaqus>::of(&other.0).entries;
    let largest = other.as_flattened().iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
    for (x, y) in square.as_flattened().iter().zip(other.as_flattened()) {
        assert!((x - y).abs() <= 1e-12 * largest, "by ∂S/∂E: {x} {y}"); // F F F F, and F⁻¹ with stretches up to 3
    }
    let has_no_logarithm = matches!(law, AnySolid::MooneyRivlin(_));
    for (row, entries) in square.iter().enumerate().take(count) {
        let scale = entries.iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
        let most = if has_no_logarithm { 0.0 } else { 64.0 * f64::EPSILON * scale };
        assert!((stress[row] - expected[row]).abs() <= most, "{} {}", stress[row], expected[row]);
        for (column, entry) in entries.iter().enumerate().take(count) {
            let found = numbers[9 + count + count * column + row];
            assert!((found - entry).abs() <= most, "{row} {column}: {found} {entry}");
        }
    }
}
