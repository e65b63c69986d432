//! Material cards: the documented energy of each program, with the numbers of the card, is that of the fitted law.

use core::fmt::Write as _;

use piola_fit::solids::{AnyModel, Model as _};
use piola_measured::fitting::{Bulk, FittedLaw, Measurements, Program, Request, card, compare};
use piola_testkit::{Tol, assert_close};

const BULK: f64 = 2000.0;

fn fitted(name: &str) -> (AnyModel, FittedLaw) {
    let mut rows = String::new();
    for x in (1..=14).map(|k| 1.0 + 0.25 * f64::from(k)) {
        let stresses = [x - x.powi(-2) + 1e-3 * x.powi(4), x - x.powi(-5) + 2e-3 * x.powi(4)];
        let _ = writeln!(rows, "uniaxial,{x},{}\nequibiaxial,{x},{}", stresses[0], stresses[1]);
    }
    let measurements = Measurements::parse("made.csv", &format!("mode,stretch,stress\n{rows}"))
        .unwrap_or_else(|error| panic!("{error}"));
    let law: AnyModel = name.parse().unwrap_or_else(|error| panic!("{error}"));
    let comparison = compare(&measurements, &Request::of(vec![law])).unwrap_or_else(|error| panic!("{error}"));
    let fit = comparison.candidates.into_iter().next().map(|candidate| candidate.fit);
    (law, fit.unwrap_or_else(|| panic!("{name}")).unwrap_or_else(|error| panic!("{error}")))
}

fn of(program: Program, name: &str) -> Option<String> {
    let (law, fit) = fitted(name);
    let bulk = Bulk::new(BULK).and_then(|bulk| bulk.with_density(1e-9));
    card(program, law, &fit, bulk.unwrap_or_else(|error| panic!("{error}"))).ok()
}

/// The numbers of all lines after the first that hold one of these words.
fn numbers(card: &str, after: &str) -> Vec<f64> {
    let start = card.find(after).unwrap_or_else(|| panic!("{after}: {card}"));
    let body = card[start..].split_once('\n').map_or("", |(_, body)| body);
    body.split([',', '\n']).filter_map(|text| text.trim().parse().ok()).collect()
}

/// Isochoric stretches.
const STRETCHES: [[f64; 3]; 4] = [[2.0, 0.8, 0.625], [1.2, 1.2, 1.0 / 1.44], [3.0, 1.0, 1.0 / 3.0], [1.0, 1.0, 1.0]];

fn invariants([a, b, c]: [f64; 3]) -> [f64; 2] {
    let [a, b, c] = [a * a, b * b, c * c];
    [a + b + c - 3.0, a * b + b * c + c * a - 3.0]
}

/// Compares an energy with that of the fit.
fn compare_energy(name: &str, program: &str, energy: impl Fn([f64; 3]) -> f64) {
    let (law, fit) = fitted(name);
    let rest: f64 = law.energy([1.0; 3], &fit.values());
    for stretches in STRETCHES {
        let own: f64 = law.energy(stretches, &fit.values()) - rest;
        let tolerance = Tol::stated(1e-10, "terms of polynomials and of Ogden's law cancel to some digits");
        assert_close(&format!("{program} {name}"), &[1.0 + energy(stretches)], &[1.0 + own], tolerance);
    }
}

/// (i, j) of Cᵢⱼ by degree, powers of I₁ − 3 first, as Abaqus and Ansys number them.
fn powers(degree: i32) -> Vec<[i32; 2]> {
    (1..=degree).flat_map(|n| (0..=n).map(move |j| [n - j, j])).collect()
}

fn polynomial(coefficients: &[f64], powers: &[[i32; 2]], stretches: [f64; 3]) -> f64 {
    let [a, b] = invariants(stretches);
    coefficients.iter().zip(powers).map(|(c, [i, j])| c * a.powi(*i) * b.powi(*j)).sum()
}

/// Σ 2μ/α² (…) of Abaqus, Σ μ/α (…) of Ansys and LS-DYNA, Σ c/m² (…) of `FEBio`.
fn ogden(terms: &[[f64; 2]], factor: impl Fn(f64, f64) -> f64, stretches: [f64; 3]) -> f64 {
    terms
        .iter()
        .map(|[mu, alpha]| factor(*mu, *alpha) * (stretches.iter().map(|x| x.powf(*alpha)).sum::<f64>() - 3.0))
        .sum()
}

fn pairs(numbers: &[f64], count: usize) -> Vec<[f64; 2]> {
    numbers.chunks_exact(2).take(count).map(|pair| [pair[0], pair[1]]).collect()
}

#[test]
fn cards_of_abaqus_have_the_energy_of_the_fit() {
    for (name, word, degree) in
        [("neo-hookean", "NEO HOOKE", 1), ("mooney-rivlin", "MOONEY-RIVLIN", 1), ("polynomial:3", "POLYNOMIAL, N=3", 3)]
    {
        let card = of(Program::Abaqus, name).unwrap_or_default();
        let found = numbers(&card, word);
        let own = if name == "neo-hookean" { vec![[1, 0]] } else { powers(degree) };
        compare_energy(name, "Abaqus", |x| polynomial(&found[..own.len()], &own, x));
        // D₁ = 2/K, the others none.
        let volumetric = &found[own.len()..];
        assert_close(name, &volumetric[..1], &[2.0 / BULK], Tol::ulps(1.0));
        assert_eq!(volumetric.len(), usize::try_from(degree).unwrap_or(0));
    }
    let found = numbers(&of(Program::Abaqus, "yeoh").unwrap_or_default(), "YEOH");
    compare_energy("yeoh", "Abaqus", |x| polynomial(&found[..3], &[[1, 0], [2, 0], [3, 0]], x));
    let found = numbers(&of(Program::Abaqus, "ogden:3").unwrap_or_default(), "OGDEN, N=3");
    compare_energy("ogden:3", "Abaqus", |x| ogden(&pairs(&found, 3), |mu, alpha| 2.0 * mu / (alpha * alpha), x));
}

/// `CalculiX` reads the first twenty characters of at most three terms, and replaces a D below 1e-10 by (0.1/μ)ⁱ.
#[test]
fn cards_of_calculix_have_the_energy_of_the_fit_as_that_program_reads_them() {
    let read = |name: &str, word: &str| -> Vec<f64> {
        let card = of(Program::CalculiX, name).unwrap_or_default();
        let body = card.split_once(word).map_or("", |(_, body)| body);
        let fields = body.split([',', '\n']).map(str::trim).filter(|text| !text.is_empty());
        fields.map(|text| text.get(..20).unwrap_or(text).parse().unwrap_or_else(|_| panic!("{text}"))).collect()
    };
    let found = read("polynomial:3", "POLYNOMIAL, N=3");
    compare_energy("polynomial:3", "CalculiX", |x| polynomial(&found[..9], &powers(3), x));
    let found = read("ogden:3", "OGDEN, N=3");
    compare_energy("ogden:3", "CalculiX", |x| ogden(&pairs(&found, 3), |mu, alpha| 2.0 * mu / (alpha * alpha), x));
    // U = Σ (J − 1)²ⁱ/Dᵢ is that of the bulk modulus alone.
    let volumetric = &found[6..];
    assert!(volumetric.len() == 3 && volumetric.iter().all(|d| 1e-10 <= *d), "{volumetric:?}");
    let energy = |change: f64| -> f64 { volumetric.iter().zip(1..).map(|(d, power)| change.powi(2 * power) / d).sum() };
    assert_close("U", &[energy(0.1)], &[0.5 * BULK * 0.01], Tol::stated(1e-12, "thirteen digits are written"));
    assert!(of(Program::CalculiX, "ogden:4").is_none() && of(Program::Abaqus, "ogden:4").is_some());
    let (law, fit) = fitted("neo-hookean");
    let stiff = Bulk::new(1e12).unwrap_or_else(|error| panic!("{error}"));
    let told = card(Program::CalculiX, law, &fit, stiff).expect_err("D").to_string();
    assert!(told.contains("CalculiX replaces D = 2/K below 1e-10"), "{told}");
}

#[test]
fn cards_of_ansys_have_the_energy_of_the_fit() {
    // TBDATA begins with the number of its first constant.
    let constants = |name: &str, kind: &str| -> Vec<f64> {
        let card = of(Program::Ansys, name).unwrap_or_default();
        assert!(card.lines().nth(1).is_some_and(|line| line.ends_with(kind)), "{card}");
        let lines = card.lines().filter_map(|line| line.strip_prefix("TBDATA,"));
        lines
            .flat_map(|line| line.split(',').skip(1).filter_map(|text| text.parse().ok()).collect::<Vec<f64>>())
            .collect()
    };
    let neo = constants("neo-hookean", "NEO");
    compare_energy("neo-hookean", "Ansys", |x| 0.5 * neo[0] * invariants(x)[0]);
    let mooney = constants("mooney-rivlin", "2,MOONEY");
    compare_energy("mooney-rivlin", "Ansys", |x| polynomial(&mooney[..2], &powers(1), x));
    let poly = constants("polynomial:2", "2,POLY");
    compare_energy("polynomial:2", "Ansys", |x| polynomial(&poly[..5], &powers(2), x));
    let terms = constants("ogden:3", "3,OGDEN");
    compare_energy("ogden:3", "Ansys", |x| ogden(&pairs(&terms, 3), |mu, alpha| mu / alpha, x));
    assert_close("d", &terms[6..7], &[2.0 / BULK], Tol::ulps(1.0));
    let tube = constants("extended-tube", "5,ETUBE");
    let [gc, ge, beta, delta] = [tube[0], tube[1], tube[2], tube[3]];
    compare_energy("extended-tube", "Ansys", |x| {
        let (first, square) = (invariants(x)[0], delta * delta);
        let network = (1.0 - square) * first / (1.0 - square * first) + (1.0 - square * first).ln();
        0.5 * gc * network + 2.0 * ge / (beta * beta) * (x.iter().map(|x| x.powf(-beta)).sum::<f64>() - 3.0)
    });
    assert_close("d", &tube[4..5], &[2.0 / BULK], Tol::ulps(1.0));
    assert!(of(Program::Ansys, "van-der-waals").is_none());
}

#[test]
fn card_of_abaqus_has_the_van_der_waals_energy_of_the_fit() {
    let found = numbers(&of(Program::Abaqus, "van-der-waals").unwrap_or_default(), "VAN DER WAALS");
    let [mu, locking, a, beta] = [found[0], found[1], found[2], found[3]];
    compare_energy("van-der-waals", "Abaqus", |x| {
        let [first, second] = invariants(x);
        let (x, limit) = (((1.0 - beta) * first + beta * second).max(0.0), locking * locking - 3.0);
        let eta = (x / limit).sqrt();
        mu * (-limit * ((1.0 - eta).ln() + eta) - 2.0 / 3.0 * a * (0.5 * x).powf(1.5))
    });
    assert_close("D", &found[4..], &[2.0 / BULK], Tol::ulps(1.0));
    assert!(of(Program::CalculiX, "van-der-waals").is_none() && of(Program::Abaqus, "carroll").is_none());
}

#[test]
fn cards_of_ls_dyna_have_the_energy_and_the_bulk_modulus_of_the_fit() {
    let card = of(Program::LsDyna, "polynomial:2").unwrap_or_default();
    let found = numbers(&card, "polynomial-2");
    // mid, ρ, ν, n, then C10, C01, C11, C20, C02, C30.
    let places = [[1, 0], [0, 1], [1, 1], [2, 0], [0, 2], [3, 0]];
    compare_energy("polynomial:2", "LS-DYNA", |x| polynomial(&found[4..10], &places, x));
    // K = 2 G (1 + ν)/(3 (1 − 2 ν)) with G = 2 (C10 + C01).
    let shear = 2.0 * (found[4] + found[5]);
    let bulk = 2.0 * shear * (1.0 + found[2]) / (3.0 * (1.0 - 2.0 * found[2]));
    assert_close("K", &[bulk], &[BULK], Tol::stated(1e-9, "1 − 2 ν is small"));
    let found = numbers(&of(Program::LsDyna, "ogden:2").unwrap_or_default(), "ogden-2");
    let terms: Vec<[f64; 2]> = (0..2).map(|k| [found[4 + k], found[12 + k]]).collect();
    compare_energy("ogden:2", "LS-DYNA", |x| ogden(&terms, |mu, alpha| mu / alpha, x));
    assert!(of(Program::LsDyna, "polynomial:3").is_none());
}

#[test]
fn cards_of_febio_have_the_energy_of_the_fit() {
    let value = |card: &str, tag: &str| -> f64 {
        let inner = card.split(&format!("<{tag}>")).nth(1).and_then(|rest| rest.split('<').next());
        inner.and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{tag}: {card}"))
    };
    let card = of(Program::FeBio, "mooney-rivlin").unwrap_or_default();
    let found = [value(&card, "c1"), value(&card, "c2")];
    compare_energy("mooney-rivlin", "FEBio", |x| polynomial(&found, &powers(1), x));
    assert_close("k", &[value(&card, "k")], &[BULK], Tol::ulps(1.0));
    let card = of(Program::FeBio, "ogden:2").unwrap_or_default();
    let terms = [["c1", "m1"], ["c2", "m2"]].map(|tags| tags.map(|tag| value(&card, tag)));
    compare_energy("ogden:2", "FEBio", |x| ogden(&terms, |c, m| c / (m * m), x));
    assert!(of(Program::FeBio, "yeoh").is_none() && of(Program::FeBio, "gent").is_none());
}
