//! What cannot be recovered is refused with its row; limits are met without losing what they say.

use piola_numerics::{Mask, Real};
use piola_testkit::{Tol, allocations_in, assert_close};
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{
    self, BelowSmallest, ChannelGeometry, ConeGeometry, CouetteGeometry, FlowTable, MeasuredCurve, Noise, Options,
    PipeGeometry, PlatesGeometry, cone_and_plate, functions,
};

fn sentence<T: core::fmt::Debug>(result: Result<T, ViscometryError>) -> String {
    result.expect_err("refused").to_string()
}

const ROWS: [[f64; 2]; 6] = [[1.0, 1.0], [2.0, 2.5], [3.0, 4.0], [4.0, 6.0], [5.0, 8.0], [6.0, 10.0]];

fn with(row: usize, values: [f64; 2]) -> [[f64; 2]; 6] {
    let mut rows = ROWS;
    rows[row] = values;
    rows
}

#[test]
fn rows_that_cannot_be_are_named() {
    let table = |rows: &[[f64; 2]]| FlowTable::pipe(1.0, rows);
    assert_eq!(sentence(table(&with(2, [f64::NAN, 4.0]))), "row 2, column 0: NaN is not positive and finite");
    assert_eq!(sentence(table(&with(2, [3.0, -4.0]))), "row 2, column 1: -4 is not positive and finite");
    assert_eq!(sentence(table(&with(0, [0.0, 1.0]))), "row 0, column 0: 0 is not positive and finite");
    assert_eq!(sentence(table(&with(5, [6.0, f64::INFINITY]))), "row 5, column 1: inf is not positive and finite");
    assert_eq!(sentence(table(&with(3, [3.0, 6.0]))), "row 3: 3e0 repeats the value of the row before");
    assert_eq!(sentence(table(&with(3, [2.5, 6.0]))), "row 3: 2.5e0 is below 3e0 of the row before: sort the rows");
    let falls = table(&with(4, [5.0, 5.0])).and_then(|table| recover::pipe(&table.with_noise(Noise::Exact)?));
    assert_eq!(sentence(falls), "row 4: the response 5e0 is not above 6e0, the response at a smaller drive");
    let short = table(&ROWS[..4]).and_then(|table| recover::pipe(&table));
    assert_eq!(sentence(short), "too few rows: 4 given, at least 5 needed");
    let noise = table(&ROWS).and_then(|table| table.with_noise(Noise::Relative(-0.1)));
    assert_eq!(sentence(noise), "table: relative noise = -1e-1 violates 0 <= noise");
}

#[test]
fn a_response_may_fall_by_what_noise_explains_in_any_unit() {
    // 5 √2 σ = 0.0707: ln(6/5.7) = 0.0513 is noise, ln(6/5.5) = 0.0870 is not.
    for unit in [1e-6, 1.0, 1e6] {
        let rising = |response: f64| {
            let rows = with(4, [5.0, response]).map(|[drive, response]| [drive, unit * response]);
            let table = FlowTable::pipe(1.0, &rows).and_then(|table| table.with_noise(Noise::Relative(0.01)));
            table.expect("a table").check_rising()
        };
        assert_eq!(rising(5.7), Ok(()), "in units of {unit}");
        let (value, previous) = (unit * 5.5, unit * 6.0);
        assert_eq!(rising(5.5), Err(ViscometryError::ResponseFalls { row: 4, value, previous }), "in units of {unit}");
    }
}

#[test]
fn geometries_that_cannot_be_are_named() {
    assert_eq!(sentence(PipeGeometry::new(0.0)), "pipe: radius = 0e0 violates 0 < R");
    assert_eq!(sentence(ChannelGeometry::new(f64::NAN)), "channel: half width = NaN is not finite");
    assert_eq!(sentence(CouetteGeometry::new(2.0, 1.0)), "coaxial cylinders: outer radius = 1e0 violates R1 < R2");
    assert_eq!(sentence(CouetteGeometry::new(1.0, 1.0)), "coaxial cylinders: outer radius = 1e0 violates R1 < R2");
    assert_eq!(sentence(PlatesGeometry::new(1.0, -1.0)), "parallel plates: gap = -1e0 violates 0 < h");
    assert_eq!(sentence(ConeGeometry::new(1.0, 2.0)), "cone and plate: angle = 2e0 violates 0 < alpha < pi/2");
    let cone = ConeGeometry::new(1.0, 0.02).expect("a cone");
    assert_eq!(
        sentence(cone_and_plate(cone, 0.0, 1.0, 1.0)),
        "cone and plate: angular velocity = 0e0 violates 0 < Omega"
    );
}

#[test]
fn nothing_is_recovered_beyond_the_table() {
    let curve = recover::pipe(&FlowTable::pipe(1.0, &ROWS).expect("a table")).expect("a curve");
    assert!(curve.at(0.5).is_ok() && curve.at(3.0).is_ok());
    let [low, high] = [0.4, 3.1].map(|stress| sentence(curve.at(stress)));
    assert_eq!(low, "4e-1 lies outside the measured range, 5e-1 to 3e0");
    assert_eq!(high, "3.1e0 lies outside the measured range, 5e-1 to 3e0");
    assert!(curve.at(f64::NAN).is_err() && curve.viscosity(-1.0).is_err());
    assert_eq!(sentence(curve.with_band(1.0)), "the confidence 1 violates 0 < confidence < 1");
}

#[test]
fn an_evaluation_allocates_nothing() {
    let table = FlowTable::couette(1.0, 1.25, &ROWS).expect("a table");
    let curve = recover::couette(&table).and_then(|curve| curve.with_band(0.9)).expect("a curve");
    let stress = 3.0 / core::f64::consts::TAU;
    let (allocations, point) = allocations_in(|| curve.at(stress));
    assert!(point.is_ok() && allocations == 0);
}

/// Bingham's ΔΩ between cylinders of radii 1 and 2 with a yield stress and a viscosity of 1: ½ [s − ln s] from max(T₂, 1) to T₁.
struct Bingham;

impl MeasuredCurve for Bingham {
    fn response<T: Real>(&self, torque: T) -> T {
        let wall = torque * T::lit(core::f64::consts::TAU.recip());
        let (outer, one) = (wall * T::lit(0.25), T::one());
        let low = T::select(outer.less_than(one), one, outer);
        let value = T::lit(0.5) * (wall - low - (wall / low).ln());
        if wall.at_most(one).all() { T::zero() } else { value }
    }
}

#[test]
fn a_yield_stress_ends_the_series_where_nothing_flows() {
    let gap = CouetteGeometry::new(1.0, 2.0).expect("a gap");
    for stress in [1.0 + 1e-6, 1.5, 3.9, 4.1, 30.0, 900.0] {
        let found = functions::couette(&Bingham, gap, stress * core::f64::consts::TAU).expect("a sum");
        let tol = Tol::stated(1e-8, "an inversion of a measured function");
        assert_close("shear rate", &[found.value], &[stress - 1.0], tol);
    }
    let at_rest = functions::couette(&Bingham, gap, 0.9 * core::f64::consts::TAU).expect("a sum");
    assert!(at_rest.value.abs() <= 0.0 && at_rest.error.abs() <= 0.0);
}

#[test]
fn curves_and_drives_that_are_not_finite_are_refused() {
    struct Hole;
    impl MeasuredCurve for Hole {
        fn response<T: Real>(&self, _: T) -> T {
            T::lit(f64::NAN)
        }
    }
    let (pipe, gap) = (PipeGeometry::new(1.0).expect("a pipe"), CouetteGeometry::new(1.0, 2.0).expect("a gap"));
    assert_eq!(functions::pipe(&Hole, pipe, 2.0), Err(ViscometryError::CurveNotFinite { drive: 2.0 }));
    assert_eq!(functions::couette(&Hole, gap, 2.0), Err(ViscometryError::CurveNotFinite { drive: 2.0 }));
    assert_eq!(sentence(functions::pipe(&Hole, pipe, 0.0)), "pipe: pressure gradient = 0e0 violates 0 < drive");
    assert_eq!(sentence(functions::couette(&Hole, gap, -1.0)), "coaxial cylinders: torque = -1e0 violates 0 < M");
}

#[test]
fn an_assumption_below_the_smallest_torque_can_be_given() {
    // ζ = T, ΔΩ = (M/4π)(1 − 1/R₂²), in gaps that are wide and narrow.
    for outer in [1.01_f64, 2.0] {
        let factor = (1.0 - outer.powi(-2)) / (4.0 * core::f64::consts::PI);
        let rows: Vec<_> =
            (0..12).map(|i| (0.3 * f64::from(i)).exp()).map(|torque| [torque, factor * torque]).collect();
        let table = FlowTable::couette(1.0, outer, &rows).expect("a table");
        let given = |below| {
            let options = Options { below_smallest: Some(below), ..Options::default() };
            recover::couette_with(&table, options).expect("a curve")
        };
        let newtonian = given(BelowSmallest::Newtonian);
        let power_law = given(BelowSmallest::PowerLaw { exponent: 2.0 });
        assert_eq!(power_law.below_smallest(), BelowSmallest::PowerLaw { exponent: 2.0 });
        let tol = Tol::stated(1e-9, "rounding through the derivative of a spline, summed in a narrow gap");
        for point in newtonian.points() {
            let point = point.expect("measured");
            assert_close("shear rate", &[point.shear_rate], &[point.shear_stress], tol);
            // What is assumed below matters less and less above: F(2)/F(1) − 1 ≤ 0.6 of a rate up to four times the least.
            let other = power_law.at(point.shear_stress).expect("measured").shear_rate;
            let share = rows[0][0] / (point.shear_stress * core::f64::consts::TAU);
            assert!((other / point.shear_rate - 1.0).abs() < 2.4 * share, "{point:?} {other}");
        }
    }
}

#[cfg(feature = "serde")]
#[test]
fn written_tables_are_checked_when_they_are_read() {
    use piola_viscometry::recover::CouetteGeometry;
    let table = FlowTable::couette(1.0, 1.25, &ROWS)
        .and_then(|table| table.with_noise(Noise::Relative(0.01)))
        .expect("a table");
    let text = serde_json::to_string(&table).expect("text");
    assert_eq!(serde_json::from_str::<FlowTable<CouetteGeometry>>(&text).expect("a table"), table);
    let refused = |from: &str, to: &str| {
        let read = serde_json::from_str::<FlowTable<CouetteGeometry>>(&text.replace(from, to));
        read.expect_err("refused").to_string()
    };
    assert!(refused("1.25", "0.5").contains("violates R1 < R2"));
    assert!(refused("[2.0,2.5]", "[1.0,2.5]").contains("row 1: 1e0 repeats the value of the row before"));
    assert!(refused("0.01", "-0.01").contains("violates 0 <= noise"));
}
