//! The formulas of the inversions, with every length: a fluid whose discharges and speeds are polynomials by hand, ζ = s/2 + s³/8.

use core::f64::consts::{PI, TAU};

use piola_numerics::Real;
use piola_testkit::{Tol, assert_each_close};
use piola_viscometry::recover::{
    self, ChannelGeometry, ConeGeometry, CouetteGeometry, FlowCurve, FlowTable, MeasuredCurve, PipeGeometry, functions,
};

/// Some ten operations on numbers of one sign.
const CLOSED: Tol = Tol::ulps(16.0);

fn rate(stress: f64) -> f64 {
    stress / 2.0 + stress.powi(3) / 8.0
}

/// a x + b x³.
struct Cubic(f64, f64);

impl MeasuredCurve for Cubic {
    fn response<T: Real>(&self, drive: T) -> T {
        T::lit(self.0) * drive + T::lit(self.1) * drive * drive * drive
    }
}

/// Q = π ∫ ξ² ζ(cξ/2) dξ up to R = π (c R⁴/16 + c³ R⁶/384).
fn pipe(radius: f64) -> Cubic {
    Cubic(PI * radius.powi(4) / 16.0, PI * radius.powi(6) / 384.0)
}

/// Q = 2 ∫ ξ ζ(cξ) dξ up to d = c d³/3 + c³ d⁵/20.
fn channel(half_width: f64) -> Cubic {
    Cubic(half_width.powi(3) / 3.0, half_width.powi(5) / 20.0)
}

/// ΔΩ = ½ ∫ ζ(s) ds/s from T₂ to T₁ = (T₁ − T₂)/4 + (T₁³ − T₂³)/48, T = M/(2πR²).
fn cylinders(inner: f64, outer: f64) -> Cubic {
    let [near, far] = [inner, outer].map(|r| 1.0 / (TAU * r * r));
    Cubic((near - far) / 4.0, (near.powi(3) - far.powi(3)) / 48.0)
}

#[test]
fn rates_at_the_wall_of_a_pipe_and_a_channel_equal_those_by_hand() {
    let mut count = 0;
    for length in [0.25, 1.0, 3.0] {
        for drive in [0.5, 2.0, 16.0] {
            let geometry = PipeGeometry::new(length).expect("a pipe");
            let wall = functions::pipe(&pipe(length), geometry, drive).expect("finite");
            let stress = drive * length / 2.0;
            assert_each_close("pipe", &[wall.shear_stress, wall.shear_rate], &[stress, rate(stress)], CLOSED);
            let geometry = ChannelGeometry::new(length).expect("a channel");
            let wall = functions::channel(&channel(length), geometry, drive).expect("finite");
            let stress = drive * length;
            assert_each_close("channel", &[wall.shear_stress, wall.shear_rate], &[stress, rate(stress)], CLOSED);
            count += 2;
        }
    }
    assert_eq!(count, 18);
}

#[test]
fn rates_between_cylinders_equal_those_by_hand() {
    for [inner, outer] in [[0.25, 0.5], [3.0, 4.0], [2.0, 2.125]] {
        let (curve, gap) = (cylinders(inner, outer), CouetteGeometry::new(inner, outer).expect("a gap"));
        for torque in [0.5, 20.0] {
            let [near, far] = [inner, outer].map(|r| torque / (TAU * r * r));
            // The differences of the radii and of the stresses cancel in part.
            let cancelled = CLOSED.times(inner / (outer - inner)).or(CLOSED);
            let found = functions::couette(&curve, gap, torque).expect("a sum");
            assert_each_close("T₁", &[found.shear_stress], &[near], CLOSED);
            let summed = Tol::stated(1e-11, "the rest of a series of two powers, by derivatives of order 4");
            assert_each_close("ζ(T₁)", &[found.value], &[rate(near)], summed);
            // φ = 2 M dΔΩ/dM = ζ(T₁) − ζ(T₂), the first term of the series; with the second ζ(T₁) − ζ(T₂ (R₁/R₂)²).
            let wide = functions::couette_wide_gap(&curve, gap, torque).expect("finite");
            assert_each_close("φ", &[wide.shear_stress, wide.shear_rate], &[near, rate(near) - rate(far)], cancelled);
            for (terms, left_out) in [(1, far), (2, far * (inner / outer).powi(2))] {
                let found = functions::couette_series(&curve, gap, torque, terms).expect("finite");
                assert_each_close("series", &[found.value], &[rate(near) - rate(left_out)], cancelled);
            }
            // R₁ ΔΩ/(R₂ − R₁).
            let speed = (near - far) / 4.0 + (near.powi(3) - far.powi(3)) / 48.0;
            let narrow = functions::couette_narrow_gap(&curve, gap, torque).expect("finite");
            assert_each_close("narrow", &[narrow.shear_rate], &[speed * inner / (outer - inner)], cancelled);
            for found in [wide, narrow] {
                let error = (found.shear_rate - rate(near)).abs();
                assert!(error <= found.bound, "{error:e} of {found:?}");
                // What is left out is known to a factor.
                assert!(found.bound <= 2.0 * rate(near), "{found:?}");
            }
        }
    }
}

fn rows(curve: &Cubic, lowest: f64) -> Vec<[f64; 2]> {
    (0..25).map(|i| lowest * (0.125 * f64::from(i)).exp()).map(|x| [x, curve.response(x)]).collect()
}

/// The largest error of a curve's rates, all of which lie in their bands.
fn largest(what: &str, curve: FlowCurve) -> f64 {
    let curve = curve.with_band(0.95).expect("a band");
    let mut largest = 0.0_f64;
    for point in curve.points() {
        let point = point.expect("measured");
        let truth = rate(point.shear_stress);
        let [low, high] = point.band.expect("asked for");
        assert!(low <= truth && truth <= high, "{what}: {truth} is not in {low} .. {high}");
        largest = largest.max((point.shear_rate / truth - 1.0).abs());
    }
    largest
}

#[test]
fn tables_of_any_size_recover_the_rates_by_hand() {
    let radius = 3.0;
    let table = FlowTable::pipe(radius, &rows(&pipe(radius), 0.25)).expect("a table");
    let error = largest("pipe", recover::pipe(&table).expect("a curve"));
    assert!(error <= TABLE.value(), "pipe: {error:e}");
    let half_width = 0.25;
    let table = FlowTable::channel(half_width, &rows(&channel(half_width), 2.0)).expect("a table");
    let error = largest("channel", recover::channel(&table).expect("a curve"));
    assert!(error <= TABLE.value(), "channel: {error:e}");
    let [inner, outer] = [3.0, 3.25];
    let table = FlowTable::couette(inner, outer, &rows(&cylinders(inner, outer), 20.0)).expect("a table");
    let error = largest("cylinders", recover::couette(&table).expect("a curve"));
    assert!(error <= TABLE.value(), "cylinders: {error:e}");
}

/// Splines of degree 7 through rows at e^⅛.
const TABLE: Tol = Tol::stated(2e-6, "(⅛)⁷ = 5e-7 of the change of the slope");

#[test]
fn a_cone_of_any_radius_gives_the_stresses_of_its_torque_and_thrust() {
    // τ = 3 and N₁ = 2 at R = ½: 𝓜 = 2π R³ τ/3 = π/4, 𝓕 = π R² N₁/2 = π/4.
    let cone = ConeGeometry::new(0.5, 0.05).expect("a cone");
    let point = recover::cone_and_plate(cone, 0.2, PI / 4.0, PI / 4.0).expect("a point");
    let found = [point.shear_rate, point.shear_stress, point.first_normal_stress_difference];
    assert_each_close("k, τ, N₁", &found, &[4.0, 3.0, 2.0], CLOSED);
}
