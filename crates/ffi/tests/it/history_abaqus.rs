//! UMAT and VUMAT of laws with history along paths of one element: uniaxial, shear, relaxation.
//!
//! The one call of either subroutine into the library is made as they make it: the symbols of the library, a name padded with blanks,
//! arrays by columns. Where gfortran is there, the last test drives the subroutines themselves.

#![expect(unsafe_code, reason = "the functions are those of C")]

use nalgebra::Matrix3;
use piola::continuum::DeformationGradient;
use piola::continuum::polar::StretchAnalysis;
use piola::inelastic::{AnyInelastic, StepControl};
use piola::numerics::linear::matrix3::from_rows;
use piola::tensor::voigt::{Abaqus, StiffnessMatrix, StressVector};
use piola_ffi::FfiError;
use piola_ffi::abaqus::{Stretching, vumat};
use piola_ffi::c::PiolaStatus;
use piola_ffi::c::abaqus::{piola_umat, piola_vumat};
use piola_ffi::named::history;

use crate::history::{LAWS, laws};
use crate::programs::{compiled, crate_folder, has, printed};

/// One element by UMAT: its state as Abaqus keeps it.
struct Element<'a> {
    name: String,
    properties: &'a [f64],
    shear: usize,
    state: Vec<f64>,
    f: Matrix3<f64>,
    temperature: f64,
}

impl<'a> Element<'a> {
    fn new((name, properties): (&str, &'a [f64]), length: usize, shear: usize) -> Self {
        let name = format!("{:<80}", name.to_uppercase());
        Self { name, properties, shear, state: vec![0.0; length], f: Matrix3::identity(), temperature: 300.0 }
    }

    /// STRESS and DDSDDE by columns after an increment.
    fn increment(&mut self, f: &Matrix3<f64>, dt: f64) -> Result<(Vec<f64>, Vec<f64>), PiolaStatus> {
        let count = 3 + self.shear;
        let (mut stress, mut tangent) = (vec![0.0; count], vec![0.0; count * count]);
        // SAFETY: a padded name and arrays as long as said.
        let status = unsafe {
            piola_umat(
                self.name.as_ptr().cast(),
                80,
                self.properties.as_ptr(),
                self.properties.len(),
                3,
                self.shear,
                self.f.as_ptr(),
                f.as_ptr(),
                dt,
                self.temperature,
                self.state.as_mut_ptr(),
                self.state.len(),
                stress.as_mut_ptr(),
                tangent.as_mut_ptr(),
            )
        };
        if status != PiolaStatus::Ok {
            return Err(status);
        }
        self.f = *f;
        Ok((stress, tangent))
    }
}

/// Deformations with the times that lead to them.
type Path = Vec<(Matrix3<f64>, f64)>;

/// The paths by name.
fn paths() -> Vec<(&'static str, Path)> {
    let uniaxial = |k: usize| {
        Matrix3::from_diagonal(&[1.0 + 0.02 * k as f64, 1.0 - 0.008 * k as f64, 1.0 - 0.008 * k as f64].into())
    };
    let shear = |k: usize| Matrix3::new(1.0, 0.05 * k as f64, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let there_and_back = [1, 2, 3, 4, 5, 4, 3, 2, 1, 0];
    vec![
        ("uniaxial", there_and_back.map(|k| (uniaxial(k), 0.1)).to_vec()),
        ("shear", there_and_back.map(|k| (shear(k), 0.1)).to_vec()),
        ("relaxation", [(shear(6), 1e-3)].into_iter().chain([0.1; 8].map(|dt| (shear(6), dt))).collect()),
    ]
}

/// T and Jaumann's tangent of the library at the end of an increment.
fn of_library(
    law: &AnyInelastic,
    state: &mut [f64],
    path: [&DeformationGradient; 2],
    dt: f64,
) -> ([f64; 6], [[f64; 6]; 6]) {
    let found = law.advance(state, path, dt, &StepControl::one_step()).unwrap();
    let cauchy = found.first_piola.kirchhoff(path[1]).cauchy(path[1]);
    let jaumann = found.tangent.spatial(&cauchy, path[1]).jaumann(&cauchy);
    (StressVector::<f64, Abaqus>::of(&cauchy.0).components, StiffnessMatrix::<f64, Abaqus>::of(&jaumann.0).entries)
}

#[test]
fn umat_returns_the_bits_of_the_library_along_paths_of_one_element() {
    for (named, law) in LAWS.into_iter().zip(laws()) {
        for (what, path) in paths() {
            let length = law.state_length();
            let (mut whole, mut plane) = (Element::new(named, length, 3), Element::new(named, length, 1));
            let mut state = vec![0.0; length];
            law.initial_into(&mut state).unwrap();
            let mut before = DeformationGradient::identity();
            let mut stresses = Vec::new();
            for (f, dt) in path {
                let (stress, tangent) = whole.increment(&f, dt).unwrap();
                let (four, sixteen) = plane.increment(&f, dt).unwrap();
                let after = DeformationGradient::new(f).unwrap();
                let (expected, square) = of_library(&law, &mut state, [&before, &after], dt);
                assert_eq!(stress, expected, "{} {what}", law.name());
                assert_eq!(four, expected[..4]);
                assert_eq!((&whole.state, &plane.state), (&state, &state));
                for row in 0..6 {
                    for column in 0..6 {
                        assert_eq!(tangent[row + 6 * column], square[row][column], "{} {what}", law.name());
                        if row < 4 && column < 4 {
                            assert_eq!(sixteen[row + 4 * column], square[row][column]);
                        }
                    }
                }
                before = after;
                stresses.push(stress[3]);
            }
            let flows = matches!(law.name(), "bergstrom_boyce" | "reese_govindjee" | "in_series");
            if what == "relaxation" && flows {
                assert!(stresses.windows(2).all(|two| two[1] < two[0]), "{}: {stresses:?}", law.name());
            }
        }
    }
}

/// The consistent tangent is the derivative of T: D ↦ Jaumann's rate of τ over J, by difference quotients with spin-free increments.
#[test]
fn ddsdde_is_the_derivative_of_the_stress_of_umat() {
    for (named, law) in LAWS.into_iter().zip(laws()) {
        let start = Matrix3::new(1.0, 0.3, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 0.95);
        let f = Matrix3::new(1.05, 0.35, 0.0, 0.02, 0.98, 0.1, 0.0, 0.05, 1.0);
        let mut element = Element::new(named, law.state_length(), 3);
        element.increment(&start, 0.5).unwrap();
        let kept = element.state.clone();
        let mut at = |f: Matrix3<f64>| {
            (element.state, element.f) = (kept.clone(), start);
            let (stress, tangent) = element.increment(&f, 0.25).unwrap();
            (stress, tangent)
        };
        let (stress, tangent) = at(f);
        let scale = tangent.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let h = 1e-4;
        for (column, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
            let mut d = Matrix3::zeros();
            d[(i, j)] += 0.5;
            d[(j, i)] += 0.5;
            let mut quotient = |h: f64| {
                // exp(h D) to the third order.
                let stretched =
                    |h: f64| (Matrix3::identity() + d * h + d * d * (h * h / 2.0) + d * d * d * (h * h * h / 6.0)) * f;
                let (up, down) = (at(stretched(h)).0, at(stretched(-h)).0);
                // Kirchhoff's rate over J: Ṫ + T tr D.
                (0..6).map(|k| (up[k] - down[k]) / (2.0 * h) + stress[k] * d.trace()).collect::<Vec<f64>>()
            };
            let (one, two) = (quotient(h), quotient(2.0 * h));
            for row in 0..6 {
                let expected = (4.0 * one[row] - two[row]) / 3.0;
                let found = tangent[row + 6 * column];
                assert!((found - expected).abs() <= 1e-7 * scale, "{} {row} {column}: {found} {expected}", law.name());
            }
        }
    }
}

#[test]
fn vumat_gives_the_corotated_stresses_of_umat_and_its_states() {
    const POINTS: usize = 70; // more than a block
    for (named, law) in LAWS.into_iter().zip(laws()) {
        let length = law.state_length();
        let name = format!("{:<80}", named.0.to_uppercase());
        let gradient = |i: usize, part: f64| {
            let (x, y) = (part * 0.2 * (i as f64).sin(), part * 0.3 * (2.0 * i as f64).cos());
            Matrix3::new(1.0 + x, y, 0.0, -0.5 * y, 1.0 - 0.5 * x, 0.25 * y, 0.0, 0.0, 1.0 + 0.25 * x)
        };
        let analysis = |i: usize, part: f64| StretchAnalysis::of(&DeformationGradient::new(gradient(i, part)).unwrap());
        let stretches = |part: f64| {
            let mut all = vec![0.0; 6 * POINTS];
            for i in 0..POINTS {
                for (k, component) in analysis(i, part).right_stretch().components.into_iter().enumerate() {
                    all[POINTS * k + i] = component;
                }
            }
            all
        };
        let mut old = vec![0.0; length * POINTS];
        let mut elements: Vec<Element<'_>> = (0..POINTS).map(|_| Element::new(named, length, 3)).collect();
        for (from, to) in [(0.0, 0.5), (0.5, 1.0)] {
            let (before, after) = (stretches(from), stretches(to));
            let (mut new, mut stresses) = (vec![7.0; length * POINTS], vec![0.0; 6 * POINTS]);
            // SAFETY: a padded name and arrays as long as said.
            let status = unsafe {
                piola_vumat(
                    name.as_ptr().cast(),
                    80,
                    named.1.as_ptr(),
                    named.1.len(),
                    POINTS,
                    3,
                    3,
                    before.as_ptr(),
                    after.as_ptr(),
                    0.0,
                    0.25,
                    [300.0; POINTS].as_ptr(),
                    POINTS,
                    old.as_ptr(),
                    new.as_mut_ptr(),
                    length,
                    stresses.as_mut_ptr(),
                )
            };
            assert_eq!(status, PiolaStatus::Ok);
            for (i, element) in elements.iter_mut().enumerate() {
                let (stress, _) = element.increment(&gradient(i, to), 0.25).unwrap();
                let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k: usize| stress[k]); // 11, 22, 33, 12, 13, 23
                let stress = Matrix3::new(a, d, e, d, b, f, e, f, c);
                let rotation: Matrix3<f64> = from_rows(analysis(i, to).rotation());
                let turned = rotation.transpose() * stress * rotation;
                let scale = turned.norm().max(0.1);
                for (k, place) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].into_iter().enumerate() {
                    let found = stresses[POINTS * k + i];
                    // Newton's method ends at a residual of 1e-15 of a strain.
                    assert!(
                        (found - turned[place]).abs() <= 1e-11 * scale,
                        "{}: {found} {}",
                        law.name(),
                        turned[place]
                    );
                }
                for (k, value) in element.state.iter().enumerate() {
                    assert!((new[POINTS * k + i] - value).abs() <= 1e-11 * (1.0 + value.abs()), "{}", law.name());
                }
            }
            old = new;
        }
    }
}

/// The first call of a run: small strains in no time give the elastic stress and the state of the body as it was made.
#[test]
fn vumat_of_small_strains_in_no_time_is_elastic() {
    let (name, values) = LAWS[3]; // viscoplastic: μ = 2, λ = 3
    let padded = format!("{:<80}", name.to_uppercase());
    let (rest, strains) = ([1.0, 1.0, 1.0, 0.0], [1e-9, 0.0, 0.0, 0.0]);
    let (old, mut new, mut stress) = ([0.0; 10], [7.0; 10], [0.0; 4]);
    // SAFETY: a padded name and arrays as long as said.
    let status = unsafe {
        piola_vumat(
            padded.as_ptr().cast(),
            80,
            values.as_ptr(),
            values.len(),
            1,
            3,
            1,
            rest.as_ptr(),
            strains.as_ptr(),
            1.0,
            0.0,
            std::ptr::null(),
            0,
            old.as_ptr(),
            new.as_mut_ptr(),
            10,
            stress.as_mut_ptr(),
        )
    };
    assert_eq!(status, PiolaStatus::Ok);
    // F = 1 + ε has lost seven digits of ε to rounding.
    assert!((stress[0] - 7e-9).abs() < 1e-14 && (stress[1] - 3e-9).abs() < 1e-14, "{stress:?}");
    assert_eq!(new, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
}

/// A deformation that is none leaves the state alone and asks for a smaller increment; a wrong number of state variables is refused.
#[test]
fn umat_that_fails_leaves_all_as_it_is() {
    let named = LAWS[1];
    let mut element = Element::new(named, 9, 3);
    element.increment(&Matrix3::new(1.0, 0.3, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), 0.5).unwrap();
    let kept = element.state.clone();
    assert_eq!(element.increment(&Matrix3::zeros(), 0.5), Err(PiolaStatus::BadPoints));
    assert_eq!(element.state, kept);
    assert_eq!(Element::new(named, 8, 3).increment(&Matrix3::identity(), 0.5), Err(PiolaStatus::WrongLength));
    let wrong = ("REESE_GOVINDJEE-CHEESE", named.1);
    assert_eq!(Element::new(wrong, 9, 3).increment(&Matrix3::identity(), 0.5), Err(PiolaStatus::UnknownChoice));
}

/// The temperature at the end of an increment is that of Abaqus, zero too; with the coefficient 0 the law is its elastic part.
#[test]
fn thermal_strains_follow_the_temperatures_of_abaqus() {
    let f = Matrix3::new(1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let (name, coefficient, reference) = ("thermal-hencky-lame", 1e-3, 20.0);
    let properties = [2.0, 3.0, coefficient, reference];
    let mut element = Element::new((name, &properties), 1, 3);
    for temperature in [20.0, 45.0, 0.0, -10.0] {
        element.temperature = temperature;
        let (stress, _) = element.increment(&Matrix3::identity(), 0.5).unwrap();
        // Hencky's law, held: T = P = ϑ² Pₑ(1/ϑ), Pₑ = ϑ τₑ, τₑ = −(3 λ + 2 μ) α Δθ.
        let strain: f64 = coefficient * (temperature - reference);
        let expected = -13.0 * strain * (3.0 * strain).exp();
        assert!((stress[0] - expected).abs() < 1e-14, "{temperature}: {} {expected}", stress[0]);
        assert_eq!(element.state, [temperature]);
        let (stretching, mut new, mut stresses) = ([1.0, 1.0, 1.0, 0.0], [7.0], [0.0; 4]);
        let law = history(name, &properties).unwrap().into();
        let given = Stretching { before: &[], after: &stretching, added: 0.0, dt: 0.5, temperatures: &[temperature] };
        vumat(&law, [3, 1], given, (&[0.0], &mut new), &mut stresses).unwrap();
        assert!((stresses[0] - expected).abs() < 1e-14 && new == [temperature]);
        vumat(&law, [3, 1], Stretching { temperatures: &[], ..given }, (&[0.0], &mut new), &mut stresses).unwrap();
        assert!(stresses[0] == 0.0 && new == [reference], "at the reference temperature: {stresses:?}");
    }
    let mut elastic = Element::new((name, &[2.0, 3.0, 0.0, 20.0]), 1, 3);
    let (stress, tangent) = elastic.increment(&f, 0.5).unwrap();
    let law = piola_ffi::named::solid("hencky-lame", &[2.0, 3.0]).unwrap();
    let (mut expected, mut square) = ([0.0; 6], [0.0; 36]);
    crate::abaqus::umat_of(&law, [3, 3], f.as_slice().first_chunk().unwrap(), &mut expected, &mut square).unwrap();
    for (x, y) in stress.iter().zip(&expected).chain(tangent.iter().zip(&square)) {
        assert!((x - y).abs() < 1e-12, "{x} {y}"); // two ways through P and ∂P/∂F of some 7
    }
}

/// The message counts the failed points of all blocks. Numbers that are not finite are refused before any block is written.
#[test]
fn vumat_counts_failures_of_all_blocks_and_refuses_before_it_writes() {
    const POINTS: usize = 200;
    let law = history(LAWS[1].0, LAWS[1].1).unwrap().into();
    let mut after = [vec![1.01; 3 * POINTS], vec![0.0; 3 * POINTS]].concat();
    for point in [70, 71, 150] {
        after[point] = 0.0; // U₁₁
    }
    let (mut old, mut new, mut stresses) = (vec![0.0; 9 * POINTS], vec![7.0; 9 * POINTS], vec![7.0; 6 * POINTS]);
    let stretching = Stretching { before: &[], after: &after, added: 0.0, dt: 0.25, temperatures: &[] };
    let error = vumat(&law, [3, 3], stretching, (&old, &mut new), &mut stresses).unwrap_err();
    assert!(matches!(error, FfiError::BadIncrements { bad: 3, count: POINTS, index: 70, .. }), "{error}");
    assert!(stresses[150].is_nan() && stresses[151].is_finite());
    old[199] = f64::NAN; // of the last block
    (new, stresses) = (vec![7.0; 9 * POINTS], vec![7.0; 6 * POINTS]);
    let error = vumat(&law, [3, 3], stretching, (&old, &mut new), &mut stresses).unwrap_err();
    assert!(matches!(error, FfiError::NotFinite { quantity: "stateOld", index: 199, .. }), "{error}");
    assert!(new.iter().chain(&stresses).all(|x| x.to_bits() == 7.0_f64.to_bits()));
}

/// New states in the memory of the old ones are refused.
#[test]
fn vumat_refuses_outputs_that_overlap() {
    let (name, values) = LAWS[3];
    let padded = format!("{:<80}", name.to_uppercase());
    let (after, mut states, mut stress) = ([1.1, 1.0, 1.0, 0.0], [7.0; 20], [7.0; 4]);
    let place = states.as_mut_ptr();
    let mut call = |shift: usize| {
        // SAFETY: a padded name and arrays as long as said; the states overlap for shifts below 10, which is what is refused.
        unsafe {
            piola_vumat(
                padded.as_ptr().cast(),
                80,
                values.as_ptr(),
                values.len(),
                1,
                3,
                1,
                std::ptr::null(),
                after.as_ptr(),
                0.0,
                1.0,
                std::ptr::null(),
                0,
                place,
                place.add(shift),
                10,
                stress.as_mut_ptr(),
            )
        }
    };
    assert_eq!(call(0), PiolaStatus::BadPointer);
    assert_eq!(call(9), PiolaStatus::BadPointer);
    // A state of sevens is no state of a body, but it stands apart: det Fᵢ = 0.
    assert_eq!(call(10), PiolaStatus::BadPoints);
    assert!(states[..10].iter().all(|x| x.to_bits() == 7.0_f64.to_bits()));
}

fn numbers(words: &[&str]) -> Vec<f64> {
    words.iter().map(|word| f64::from_bits(u64::from_str_radix(word, 16).unwrap())).collect()
}

fn by_columns(numbers: &[f64]) -> DeformationGradient {
    DeformationGradient::new(Matrix3::from_column_slice(&numbers[..9])).unwrap()
}

/// The subroutines themselves, compiled by gfortran and driven along the same kinds of paths.
#[test]
fn umat_and_vumat_of_fortran_return_the_bits_of_the_library() {
    if !has("gfortran") {
        return;
    }
    let folder = crate_folder();
    let include = format!("-I{}", folder.join("tests/fortran").display());
    let flags = ["-O1", "-ffp-contract=off", "-Wall", "-Wno-unused-dummy-argument", &include];
    let files = ["fortran/umat.f", "fortran/vumat.f", "tests/fortran/driver_history.f90"];
    let sources = files.map(|file| folder.join(file));
    let text = printed(&compiled("gfortran", "fortran_history", &flags, &sources), &[]);
    let of_viscous = [1.0, 5.0, 2.0, 8.0, 0.75, 0.0];
    let viscous = history("reese_govindjee-neo_hookean-simo_taylor-hencky-lame", &of_viscous).unwrap();
    let of_plastic = [2.0, 3.0, 0.25, 0.5, 0.25, 0.125, 0.5, 4.0, 1.5, 0.0];
    let plastic = history("kinematic-hencky-lame-neo_hookean-simo_taylor", &of_plastic).unwrap();
    let material = viscous.clone().into();
    let (mut points, mut blocks) = (0, 0);
    let (mut last, mut state, mut before) = (String::new(), Vec::new(), DeformationGradient::identity());
    let (mut work, mut stress_before) = ([0.0; 7], vec![0.0; 42]);
    let (mut old, mut stretches) = (vec![0.0; 63], [[1.0; 21].as_slice(), &[0.0; 21]].concat());
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [path @ ("uniaxial" | "shear" | "relaxation"), name, shear, dt, ref rest @ ..] => {
                let law = if name.starts_with("KINEMATIC") { &plastic } else { &viscous };
                if format!("{path} {name}") != last {
                    last = format!("{path} {name}");
                    state = vec![0.0; law.state_length()];
                    law.initial_into(&mut state).unwrap();
                    before = DeformationGradient::identity();
                }
                let (found, count) = (numbers(rest), 3 + shear.parse::<usize>().unwrap());
                let after = by_columns(&found);
                let (stress, square) = of_library(law, &mut state, [&before, &after], numbers(&[dt])[0]);
                before = after;
                let found = &found[9..];
                assert_eq!(found[..state.len()], state, "{last}");
                assert_eq!(found[state.len()..][..count], stress[..count], "{last}");
                for (place, entry) in found[state.len() + count..].iter().enumerate() {
                    assert_eq!(*entry, square[place % count][place / count], "{last}");
                }
                points += 1;
            }
            ["vumat", ref rest @ ..] => {
                let found = numbers(rest);
                let (new, found) = found.split_at(42);
                let (mut stresses, mut states) = (vec![0.0; 42], vec![0.0; 63]);
                let stretching = Stretching { before: &stretches, after: new, added: 0.0, dt: 0.25, temperatures: &[] };
                vumat(&material, [3, 3], stretching, (&old, &mut states), &mut stresses).unwrap();
                let (found, energy) = found.split_at(105);
                assert_eq!(found, [&stresses[..], &states].concat());
                // Work of the mean stress on the strain increments of the driver, at the density 1.
                for (point, energy) in energy.iter().enumerate() {
                    for k in 0..6 {
                        let factor = if k < 3 { 0.5 } else { 1.0 };
                        work[point] += factor * (stress_before[7 * k + point] + stresses[7 * k + point]) * 1e-3;
                    }
                    let tolerance = 8.0 * f64::EPSILON * work[point].abs(); // two orders of a sum of six terms
                    assert!((energy - work[point]).abs() <= tolerance, "{energy} {}", work[point]);
                }
                (old, stretches, stress_before) = (states, new.to_vec(), stresses);
                blocks += 1;
            }
            ["start", ref rest @ ..] => {
                let (found, strains) = (numbers(rest), [1e-3; 42]);
                let (mut stresses, mut states) = (vec![0.0; 42], vec![0.0; 63]);
                let stretching =
                    Stretching { before: &stretches, after: &strains, added: 1.0, dt: 0.0, temperatures: &[] };
                vumat(&material, [3, 3], stretching, (&old, &mut states), &mut stresses).unwrap();
                assert_eq!(found, [&stresses[..], &states].concat());
                blocks += 1;
            }
            _ => {}
        }
    }
    assert_eq!((points, blocks), (42, 3), "{text}");
    assert!(text.contains("smaller 0.25") && !text.contains("changed"), "{text}");
    assert!(text.contains("`STATEV` has length 8; length 9 is needed"), "{text}");
    assert!(text.trim_end().ends_with("exit"), "{text}");
}
