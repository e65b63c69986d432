//! Slip and ends of capillaries.

use core::f64::consts::PI;

use piola_testkit::{NormalNoise, Tol, assert_close};
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{
    self, Capillary, Criterion, FlowTable, Noise, PipeGeometry, end_correction, slip_at_walls,
};
use statrs::distribution::{ContinuousCDF, Normal as StandardNormal};

const ROUNDING: Tol = Tol::stated(3e-13, "rounding through differences of nearly equal tables");

/// Bands of exact tables of 25 rows at e^0.1: some hundred times as wide as the error.
const NARROW: Tol = Tol::stated(5e-7, "splines of degree 7 at their ends");

/// A power law k = τ² that slips by u = 0.3 τ^1.5.
fn slipping(radius: f64, count: u32) -> Result<FlowTable<PipeGeometry>, ViscometryError> {
    let rows: Vec<_> = (0..count)
        .map(|i| (0.15 * f64::from(i)).exp())
        .map(|stress| {
            let apparent = 0.8 * stress * stress + 4.0 * 0.3 * stress.powf(1.5) / radius;
            [2.0 * stress / radius, 0.25 * PI * radius.powi(3) * apparent]
        })
        .collect();
    FlowTable::pipe(radius, &rows)
}

#[test]
fn discharge_without_slip_recovers_the_fluid_that_slipped() {
    let tables = [0.5, 1.0, 2.0].map(|radius| slipping(radius, 20).expect("a table"));
    let slip = slip_at_walls(&tables).expect("slip");
    assert_eq!(slip.points.len(), 20);
    for point in &slip.points {
        let exact = 0.3 * point.wall_stress.powf(1.5);
        assert_close("slip", &[point.slip_velocity], &[exact], ROUNDING);
        assert!(point.slip_error.expect("three pipes") <= ROUNDING.value() * exact);
    }
    let curve = recover::pipe(&slip.table).expect("a curve");
    for point in curve.points() {
        let point = point.expect("measured");
        assert_close("rate", &[point.shear_rate], &[point.shear_stress.powi(2)], ROUNDING.times(10.0));
    }
}

#[test]
fn slip_needs_pipes_that_differ_and_overlap() {
    let table = slipping(1.0, 10).expect("a table");
    assert_eq!(slip_at_walls(&[]), Err(ViscometryError::TooFewTables { tables: 0, least: 2 }));
    assert_eq!(
        slip_at_walls(core::slice::from_ref(&table)),
        Err(ViscometryError::TooFewTables { tables: 1, least: 2 })
    );
    let same = slip_at_walls(&[table.clone(), table.clone()]);
    assert_eq!(same, Err(ViscometryError::SameGeometry { quantity: "radius", value: 1.0 }));
    let far: Vec<_> = (0..8).map(|i| 1e3 * (1.0 + f64::from(i))).map(|c| [c, c]).collect();
    let far = FlowTable::pipe(2.0, &far).expect("a table");
    assert!(matches!(slip_at_walls(&[table, far]), Err(ViscometryError::NothingInCommon { .. })));
}

#[test]
fn pressure_without_ends_recovers_the_fluid() {
    // τ = √k in a capillary of radius 0.5: Q = π R³ τ²/5; ends lose 4 τ.
    let capillary = |length: f64| {
        let rows: Vec<_> = (0..20)
            .map(|i| (0.1 * f64::from(i)).exp())
            .map(|stress| {
                let discharge = PI * 0.125 * stress * stress / 5.0;
                [discharge, 2.0 * stress * length / 0.5 + 4.0 * stress]
            })
            .collect();
        Capillary::new(0.5, length, &rows)
    };
    let capillaries = [5.0, 10.0, 20.0].map(|length| capillary(length).expect("a capillary"));
    let ends = end_correction(&capillaries).expect("ends");
    for point in &ends.points {
        assert_close("end length", &[point.end_length], &[2.0], ROUNDING);
        assert_close("end pressure", &[point.end_pressure], &[4.0 * point.wall_stress], ROUNDING);
    }
    let curve = recover::pipe(&ends.table).expect("a curve");
    for point in curve.points() {
        let point = point.expect("measured");
        assert_close("rate", &[point.shear_rate], &[point.shear_stress.powi(2)], ROUNDING.times(10.0));
    }
    let wide =
        Capillary::new(1.0, 5.0, &[[1.0, 1.0], [2.0, 2.0], [3.0, 3.0], [4.0, 4.0], [5.0, 5.0]]).expect("a capillary");
    let mixed = end_correction(&[capillaries[0].clone(), wide]);
    assert_eq!(mixed, Err(ViscometryError::DifferentGeometry { quantity: "radius", values: [0.5, 1.0] }));
    let same = end_correction(&[capillaries[0].clone(), capillaries[0].clone()]);
    assert_eq!(same, Err(ViscometryError::SameGeometry { quantity: "length", value: 5.0 }));
}

/// A fluid that slips, in three pipes: k = τ + τ², so that A = τ + 4τ²/5, and u = 0.3 τ^1.5; errors of a row by `error`.
fn pipes(mut error: impl FnMut() -> f64) -> Result<Vec<FlowTable<PipeGeometry>>, ViscometryError> {
    let mut pipe = |radius: f64, shift: f64| {
        let rows: Vec<_> = (0..25)
            .map(|i| (0.1 * f64::from(i) + shift).exp())
            .map(|stress| {
                let apparent = stress + 0.8 * stress * stress + 4.0 * 0.3 * stress.powf(1.5) / radius;
                let discharge = 0.25 * PI * radius.powi(3) * apparent;
                [2.0 * stress / radius, discharge * (1.0 + error())]
            })
            .collect();
        FlowTable::pipe(radius, &rows)
    };
    Ok(vec![pipe(0.5, 0.0)?, pipe(1.0, -0.03)?, pipe(2.0, 0.04)?])
}

/// The same fluid in three capillaries that lose 4 τ at their ends.
fn capillaries(mut error: impl FnMut() -> f64) -> Result<Vec<Capillary>, ViscometryError> {
    let mut capillary = |length: f64, shift: f64| {
        let rows: Vec<_> = (0..25)
            .map(|i| (0.1 * f64::from(i) + shift).exp())
            .map(|stress| {
                let discharge = 0.25 * PI * 0.125 * (stress + 0.8 * stress * stress);
                [discharge, (2.0 * stress * length / 0.5 + 4.0 * stress) * (1.0 + error())]
            })
            .collect();
        Capillary::new(0.5, length, &rows)
    };
    Ok(vec![capillary(5.0, 0.0)?, capillary(10.0, -0.03)?, capillary(20.0, 0.04)?])
}

#[test]
fn bands_of_corrected_exact_tables_hold_the_fluid_and_are_narrow() {
    let slip = slip_at_walls(&pipes(|| 0.0).expect("tables")).and_then(|slip| slip.with_band(0.95)).expect("slip");
    let ends = end_correction(&capillaries(|| 0.0).expect("tables")).and_then(|ends| ends.with_band(0.95));
    let ends = ends.expect("ends");
    assert!(slip.smoothing().chain(ends.smoothing()).all(|smoothing| smoothing.criterion == Criterion::Interpolation));
    let slipping = slip.points.iter().map(|point| (point.wall_stress, point.shear_rate, point.band));
    let ending = ends.points.iter().map(|point| (point.wall_stress, point.shear_rate, point.band));
    for (stress, rate, band) in slipping.chain(ending) {
        let truth = stress + stress * stress;
        let [low, high] = band.expect("asked for");
        let width = (high - low) / truth;
        assert!(low <= truth && truth <= high && width <= NARROW.value(), "{truth} {low} {high}");
        assert_close("rate", &[rate], &[truth], Tol::stated(5e-9, "splines of degree 7 at their ends, rows at e^0.1"));
    }
    let middle = slip.at(2.0).expect("measured");
    assert_close(
        "slip",
        &[middle.slip_velocity],
        &[0.3 * 2.0_f64.powf(1.5)],
        Tol::stated(1e-12, "splines in their middle"),
    );
    assert!(matches!(slip.at(1e3), Err(ViscometryError::NotMeasured { .. })));
    assert_eq!(slip.with_band(1.0), Err(ViscometryError::ConfidenceOutOfRange { value: 1.0 }));
}

#[test]
fn bands_of_corrected_tables_with_a_percent_of_noise_hold_the_fluid_in_nine_of_ten_trials() {
    let mut normal = NormalNoise(17);
    let inside = |(stress, band): (f64, Option<[f64; 2]>)| {
        let [low, high] = band.expect("asked for");
        let truth = stress + stress * stress;
        low <= truth && truth <= high
    };
    let trials = 200;
    let mut held = [0; 4];
    for _ in 0..trials {
        let noisy = pipes(|| 0.01 * normal.draw()).expect("tables");
        let slip = slip_at_walls(&noisy).and_then(|slip| slip.with_band(0.95)).expect("slip");
        held[0] += u32::from(slip.points.iter().map(|point| (point.wall_stress, point.band)).all(inside));
        let known = noisy.into_iter().map(|table| table.with_noise(Noise::Relative(0.01)).expect("a level"));
        let slip = slip_at_walls(&known.collect::<Vec<_>>()).and_then(|slip| slip.with_band(0.95)).expect("slip");
        held[1] += u32::from(slip.points.iter().map(|point| (point.wall_stress, point.band)).all(inside));
        let noisy = capillaries(|| 0.01 * normal.draw()).expect("tables");
        let ends = end_correction(&noisy).and_then(|ends| ends.with_band(0.95)).expect("ends");
        held[2] += u32::from(ends.points.iter().map(|point| (point.wall_stress, point.band)).all(inside));
        let known = noisy.into_iter().map(|table| table.with_noise(Noise::Relative(0.01)).expect("a level"));
        let ends = end_correction(&known.collect::<Vec<_>>()).and_then(|ends| ends.with_band(0.95)).expect("ends");
        held[3] += u32::from(ends.points.iter().map(|point| (point.wall_stress, point.band)).all(inside));
    }
    for held in held {
        assert!(9 * trials <= 10 * held, "{held} of {trials}");
    }
}

#[test]
fn standard_errors_of_slip_and_ends_are_those_of_a_line() {
    // Answers that lie on no line over the abscissas 2, 1, ½: their regression by hand.
    let places = [2.0_f64, 1.0, 0.5];
    let factors = [4.0, 2.5, 2.5];
    let mean = 3.5 / 3.0;
    let square: f64 = places.iter().map(|x| (x - mean).powi(2)).sum();
    let slope = places.iter().zip(factors).map(|(x, y)| (x - mean) * y).sum::<f64>() / square;
    let value = 3.0 - mean * slope;
    let variance: f64 = places.iter().zip(factors).map(|(x, y)| (y - value - slope * x).powi(2)).sum();
    // Pipes with 4Q/(πR³) = factor τ and capillaries with Δp = factor Q.
    let pipe = |(place, factor): (&f64, f64)| {
        let radius = 1.0 / place;
        let rows: Vec<_> = (1..9)
            .map(f64::from)
            .map(|stress| [2.0 * stress / radius, 0.25 * PI * radius.powi(3) * factor * stress])
            .collect();
        FlowTable::pipe(radius, &rows).expect("a table")
    };
    let slip = slip_at_walls(&places.iter().zip(factors).map(pipe).collect::<Vec<_>>()).expect("slip");
    let capillary = |(place, factor): (&f64, f64)| {
        let rows: Vec<_> = (1..9).map(f64::from).map(|discharge| [discharge, factor * discharge]).collect();
        Capillary::new(1.0, *place, &rows).expect("a capillary")
    };
    let ends = end_correction(&places.iter().zip(factors).map(capillary).collect::<Vec<_>>()).expect("ends");
    assert_eq!((slip.points.len(), ends.points.len()), (8, 8));
    for (slip, ends) in slip.points.iter().zip(&ends.points) {
        let (stress, discharge) = (slip.wall_stress, ends.discharge);
        let expected = 0.25 * stress * (variance / square).sqrt();
        assert_close("slip", &[slip.slip_error.expect("three pipes")], &[expected], ROUNDING);
        let expected = discharge * (variance * (1.0 / 3.0 + mean * mean / square)).sqrt();
        assert_close("ends", &[ends.end_error.expect("three capillaries")], &[expected], ROUNDING);
    }
}

/// Half the width of a band of ln k at both ends of a table of 20 rows over `step`, over the deviation of the regression of
/// logarithms, and the probability that a path of such deviations is left somewhere (D. Q. Naiman's inequality).
///
/// ln k has the error Σ wᵢ (a δBᵢ + b δBᵢ′), of all tables alike but for wᵢ: √(a²/N + (a (u − ū) + b)²/S) √Σ wᵢ² σ.
fn check_band(halves: [f64; 2], step: f64, [a, b]: [f64; 2], weights: [f64; 3]) {
    let square = step * step * 20.0 * 399.0 / 12.0;
    let parts = [-9.5, 9.5].map(|place| [a / 20.0_f64.sqrt(), (a * place * step + b) / square.sqrt()]);
    let size = 0.01 * weights.iter().map(|w| w * w).sum::<f64>().sqrt();
    let [first, last] = [0, 1].map(|end| halves[end] / (size * parts[end][0].hypot(parts[end][1])));
    let tol = Tol::stated(1e-3, "what the smoothing leaves of curvature, less than 1e-3 of the deviation");
    assert_close("multiple of the deviation", &[first], &[last], tol);
    let [from, to] = parts.map(|[x, y]| y.atan2(x));
    let left = (to - from) / PI * (-0.5 * first * first).exp() + 2.0 * StandardNormal::standard().sf(first);
    assert_close("probability", &[left], &[0.05], tol.times(10.0));
}

#[test]
fn bands_of_power_laws_with_known_noise_are_those_of_straight_lines() {
    let known = Noise::Relative(0.01);
    let rows = |step: f64| (0..20).map(move |i| (step * f64::from(i)).exp());
    let half = |rate: f64, band: Option<[f64; 2]>| (band.expect("asked for")[1] / rate).ln();
    // 4Q/(πR³) = (4/5 + 2/(5R)) τ², so that k = τ²; aᵢ of the line through 2, 1, ½ at 0.
    let radii = [0.5, 1.0, 2.0];
    let pipe = |radius: f64| {
        let discharge = |stress: f64| 0.25 * PI * radius.powi(3) * (0.8 + 0.4 / radius) * stress * stress;
        let rows: Vec<_> = rows(0.15).map(|stress| [2.0 * stress / radius, discharge(stress)]).collect();
        FlowTable::pipe(radius, &rows)?.with_noise(known)
    };
    let slip = slip_at_walls(&radii.map(|radius| pipe(radius).expect("a table")));
    let points = slip.and_then(|slip| slip.with_band(0.95)).expect("slip").points;
    let halves = [0, 19].map(|at: usize| half(points[at].shear_rate, points[at].band));
    let weights = radii.map(|radius| {
        let share = 1.0 / 3.0 - 7.0 / 6.0 * (1.0 / radius - 7.0 / 6.0) / (7.0 / 6.0);
        0.25 * share * (0.8 + 0.4 / radius)
    });
    check_band(halves, 0.15, [5.0, 1.0], weights);
    // Δp = 2 τ L/R + 4 τ with τ = √Q: bᵢ of the line through 10, 20, 40, d ln k/d ln τ = 2, N (3N + 1) = 5/4.
    let capillary = |length: f64| {
        let rows: Vec<_> = rows(0.2).map(|q| [q, (4.0 * length + 4.0) * q.sqrt()]).collect();
        Capillary::new(0.5, length, &rows)?.with_noise(known)
    };
    let lengths = [5.0, 10.0, 20.0];
    let ends = end_correction(&lengths.map(|length| capillary(length).expect("a capillary")));
    let points = ends.and_then(|ends| ends.with_band(0.95)).expect("ends").points;
    let halves = [0, 19].map(|at: usize| half(points[at].shear_rate, points[at].band));
    let weights = lengths.map(|length| (2.0 * length - 70.0 / 3.0) / (1400.0 / 3.0) * (2.0 * length + 2.0));
    check_band(halves, 0.2, [2.0, 0.8], weights);
}
