//! Starts of a search for laws with history, from the sizes of the data.
//!
//! The sum of squares of such a law has several minima. Elastic moduli that begin too small are the usual cause: if the first row of a metal is beyond
//! its yield stress, the secant to it shows less than the modulus. So the modulus of metal begins at the steepest secant of all tests, which
//! an unloading shows; without an unloading at twice that in four starts of five. Moduli of rubber begin at the secant of the row of the
//! largest stress, one overstress of Bergström and Boyce's near the steepest. Stresses and times begin at a few shares of what was measured.

use super::test::HistoryTest;
use crate::sides::Loading;

/// The part of the largest stress by which the ends of a secant differ at least.
const PART: f64 = 0.1;
/// The part of the range of strain of a test by which they differ at least, and by which a test that goes back does so: less is the creep of
/// a hold.
const LEAST_STEP: f64 = 1e-3;

/// The strain s of P = μ s, the stress of an incompressible neo-Hookean solid.
fn neo_hookean_strain(loading: Loading, stretch: f64) -> f64 {
    match loading {
        Loading::SimpleShear => stretch,
        Loading::Equibiaxial => stretch - stretch.powi(-5),
        Loading::Planar => stretch - stretch.powi(-3),
        _ => stretch - stretch.powi(-2),
    }
}

/// s/ε over E/μ at ν = 0.3 of each loading: μ of metal over the μ of a solid that keeps its volume.
const fn of_metal(loading: Loading) -> f64 {
    match loading {
        Loading::SimpleShear => 1.0,
        // E/μ = 2 (1 + ν); of equal stretches over 1 − ν; of a sheet 2/(1 − ν).
        Loading::Equibiaxial => 6.0 * 0.7 / 2.6,
        Loading::Planar => 4.0 * 0.7 / 2.0,
        _ => 3.0 / 2.6,
    }
}

/// λ̄ = √(I₁/3) of the row of a test with the largest one, for constant volume.
fn chain_stretch(test: &HistoryTest) -> f64 {
    let first_invariant = |x: f64| match test.loading() {
        Loading::SimpleShear => 3.0 + x * x,
        Loading::Equibiaxial => 2.0 * x * x + x.powi(-4),
        Loading::Planar => x * x + 1.0 + x.powi(-2),
        _ => x * x + 2.0 / x,
    };
    test.rows().iter().map(|row| (first_invariant(row[1]) / 3.0).sqrt()).fold(1.0, f64::max)
}

/// s, P and t of the rows, with the rest before them.
fn strains(test: &HistoryTest) -> Vec<[f64; 3]> {
    let rest = [[0.0; 3]];
    let rows = test.rows().iter().map(|row| [neo_hookean_strain(test.loading(), row[1]), row[2], row[0]]);
    rest.into_iter().chain(rows).collect()
}

/// The least change of s of a test that counts.
fn least_step(points: &[[f64; 3]]) -> f64 {
    let strains = || points.iter().map(|point| point[0]);
    LEAST_STEP * (strains().fold(0.0, f64::max) - strains().fold(0.0, f64::min))
}

/// The steepest secant |ΔP/Δs| of a test: between rows that follow each other in one direction and differ by a tenth of the largest stress
/// and by more than the creep of a hold.
fn steepest(test: &HistoryTest) -> Option<f64> {
    let points = strains(test);
    let (enough, least) = (PART * test.largest_stress(), least_step(&points));
    let from = |i: usize| {
        let way = points.get(i + 1)?[0] - points[i][0];
        let mut on_the_way = points.windows(2).skip(i).take_while(|pair| 0.0 < (pair[1][0] - pair[0][0]) * way);
        let is_far = |end: &[f64; 3]| enough <= (end[1] - points[i][1]).abs() && least <= (end[0] - points[i][0]).abs();
        let end = on_the_way.find(|pair| is_far(&pair[1]))?[1];
        let slope = (end[1] - points[i][1]) / (end[0] - points[i][0]);
        (0.0 < slope && slope.is_finite()).then_some(slope)
    };
    (0..points.len()).filter_map(from).reduce(f64::max)
}

/// P/s of the row of the largest stress of a test.
fn secant(test: &HistoryTest) -> Option<f64> {
    let row = test.rows().iter().max_by(|a, b| a[2].abs().total_cmp(&b[2].abs()))?;
    let modulus = (row[2] / neo_hookean_strain(test.loading(), row[1])).abs();
    (0.0 < modulus && modulus.is_finite()).then_some(modulus)
}

/// The sizes of some tests.
struct Sizes {
    /// The greatest P/s of the rows of the largest stresses, and the steepest secant.
    secant: f64,
    steepest: f64,
    /// The same of metal.
    steepest_of_metal: f64,
    largest: f64,
    /// Von Mises' stress and the strain of the largest ones.
    equivalent_stress: f64,
    equivalent_strain: f64,
    /// The fastest change of strain.
    fastest: f64,
    duration: f64,
    shortest: f64,
}

impl Sizes {
    fn of(tests: &[HistoryTest]) -> Self {
        let most = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, f64::max);
        let or_one = |x: f64| if 0.0 < x && x.is_finite() { x } else { 1.0 };
        let secant = or_one(most(&mut tests.iter().filter_map(secant)));
        let steepest_of = |test: &HistoryTest| steepest(test).map(|slope| (slope, slope * of_metal(test.loading())));
        let steepest: Vec<(f64, f64)> = tests.iter().filter_map(steepest_of).collect();
        // √3 τ of a shear, √3/2 P of a sheet.
        let equivalent = |test: &HistoryTest| match test.loading() {
            Loading::SimpleShear => [3.0_f64.sqrt(), 3.0_f64.sqrt().recip()],
            Loading::Planar => [0.75_f64.sqrt(), 0.75_f64.sqrt().recip()],
            Loading::Equibiaxial => [1.0, 2.0],
            _ => [1.0, 1.0],
        };
        let along = |test: &HistoryTest, row: &[f64; 3]| match test.loading() {
            Loading::SimpleShear => row[1].abs(),
            _ => row[1].ln().abs(),
        };
        let strain =
            |test: &HistoryTest| equivalent(test)[1] * most(&mut test.rows().iter().map(|row| along(test, row)));
        let rate = |test: &HistoryTest| {
            let steps = test.rows().windows(2).filter(|rows| rows[0][0] < rows[1][0]);
            let rate =
                |rows: &[[f64; 3]]| (along(test, &rows[1]) - along(test, &rows[0])).abs() / (rows[1][0] - rows[0][0]);
            equivalent(test)[1] * most(&mut steps.map(rate))
        };
        let duration = or_one(most(&mut tests.iter().filter_map(|test| Some(test.rows().last()?[0]))));
        let steps = tests.iter().flat_map(|test| test.rows().windows(2)).map(|rows| rows[1][0] - rows[0][0]);
        let strain = or_one(most(&mut tests.iter().map(strain)));
        let fastest = most(&mut tests.iter().map(rate));
        Self {
            secant,
            steepest: steepest.iter().map(|(slope, _)| *slope).fold(secant, f64::max),
            steepest_of_metal: steepest.iter().map(|(_, slope)| *slope).fold(secant, f64::max),
            largest: most(&mut tests.iter().map(HistoryTest::largest_stress)),
            equivalent_stress: most(&mut tests.iter().map(|test| equivalent(test)[0] * test.largest_stress())),
            equivalent_strain: strain,
            fastest: if 0.0 < fastest { fastest } else { strain / duration },
            duration,
            shortest: steps.filter(|step| 0.0 < *step).fold(duration, f64::min),
        }
    }
}

/// Whether a test goes back.
fn is_unloaded(test: &HistoryTest) -> bool {
    let points = strains(test);
    let least = least_step(&points);
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    points.iter().any(|[strain, ..]| {
        (low, high) = (low.min(*strain), high.max(*strain));
        least < high && strain + least < high || low < -least && low < strain - least
    })
}

/// Times of relaxation near the shortest step, near the duration, and between them.
fn times(sizes: &Sizes) -> [f64; 3] {
    [3.0 * sizes.shortest, (sizes.shortest * sizes.duration).sqrt(), 0.3 * sizes.duration]
}

/// Of Bergström and Boyce's rubber.
pub(super) fn bergstrom_boyce(tests: &[HistoryTest]) -> Vec<Vec<f64>> {
    let sizes = Sizes::of(tests);
    let (mu, times) = (sizes.secant, times(&sizes));
    // γ̇ = γ̇₀ (λ̄ − 1 + ξ)^c (τ/τ₀)^m is about 1/T: with γ̇₀ = 1/s, τ₀ = τ (T (λ̄ − 1 + ξ)^c)^(1/m).
    let (slowing, perturbation) = (-0.5, 0.01);
    let stretch = tests.iter().map(chain_stretch).fold(1.0, f64::max);
    let resistance = (stretch - 1.0 + perturbation).powf(slowing);
    let start = |time: f64, overstress: f64, power: f64| {
        let stress = sizes.largest * (time * resistance).powf(1.0 / power);
        // What the steepest secant leaves beside the overstress, but no small part of the secant of the largest stress.
        let at_rest = if overstress < sizes.steepest { (sizes.steepest - overstress).clamp(mu / 3.0, mu) } else { mu };
        vec![at_rest, 100.0 * at_rest, overstress, 100.0 * overstress, 1.0, stress, power, slowing, perturbation]
    };
    let steep = (sizes.steepest - 0.5 * mu).max(mu);
    let usual = times.into_iter().map(|time| start(time, mu, 4.0));
    usual.chain([start(times[1], steep, 4.0), start(times[1], mu, 8.0)]).collect()
}

/// Of Reese and Govindjee's solid.
pub(super) fn reese_govindjee(tests: &[HistoryTest]) -> Vec<Vec<f64>> {
    let sizes = Sizes::of(tests);
    let (mu, bulk) = (sizes.secant, 100.0 * sizes.secant);
    times(&sizes).iter().map(|time| vec![mu, bulk, mu, bulk, mu * time]).collect()
}

/// Of Ogden and Roxburgh's softening rubber.
pub(super) fn ogden_roxburgh(tests: &[HistoryTest]) -> Vec<Vec<f64>> {
    let sizes = Sizes::of(tests);
    let start = |softening: &f64| vec![sizes.secant, 100.0 * sizes.secant, *softening, 0.1 * sizes.largest, 0.1];
    [1.5, 3.0].iter().map(start).collect()
}

/// Of viscoplastic metal.
pub(super) fn viscoplastic(tests: &[HistoryTest]) -> Vec<Vec<f64>> {
    let sizes = Sizes::of(tests);
    // Without a way back, the modulus may be far above all secants.
    let factor = if tests.iter().any(is_unloaded) { 1.0 } else { 2.0 };
    let (stress, strain) = (sizes.equivalent_stress, sizes.equivalent_strain);
    // Shares of the largest stress: yield stress, saturation, growth by H over the strain, overstress; δ times the strain; μ over the secant.
    let shares = [
        (0.6, 0.85, 0.1, 0.05, 5.0, 1.0),
        (0.8, 0.9, 0.1, 0.05, 5.0, factor),
        (0.3, 0.8, 0.1, 0.05, 10.0, factor),
        (0.5, 0.6, 0.4, 0.02, 5.0, factor),
        (0.4, 0.6, 0.1, 0.3, 5.0, factor),
    ];
    let start = |(yields, saturates, grows, over, exponent, factor): (f64, f64, f64, f64, f64, f64)| {
        let mu = factor * sizes.steepest_of_metal;
        let (linear, viscosity) = (grows * stress / strain, over * stress / sizes.fastest);
        vec![mu, 1.5 * mu, yields * stress, linear, saturates * stress, exponent / strain, viscosity]
    };
    shares.into_iter().map(start).collect()
}
