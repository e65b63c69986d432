//! What is recovered from a solved flow is the fluid.

use piola_fluids::{Newtonian, PowerLaw, ViscometricFluid};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close};
use piola_viscometry::recover::{
    self, ChannelGeometry, CouetteGeometry, FlowTable, MeasuredCurve, PipeGeometry, PlatesGeometry, functions,
};
use proptest::prelude::*;

use super::fluids::{Discharge, Discs, Plateau, Sheet, Speed};

/// A series of coaxial cylinders is summed to rounding, and its estimate does not hide more.
const SERIES: Tol =
    Tol::stated(1e-13, "derivatives of order 4 of the measured curve, itself a quadrature of 48 points");
/// Local derivatives of a quadrature.
const LOCAL: Tol = Tol::ulps(32.0);

const CARREAU: Plateau = Plateau { eta: [2.0, 0.0625], time: 1.5, power: 2.0, exponent: 0.4 };
const ROUNDED: Plateau = Plateau { eta: [1.0, 0.0], time: 2.0, power: 1.25, exponent: 0.5 };

fn rate(fluid: &impl ViscometricFluid, stress: f64) -> f64 {
    fluid.shear_rate(stress).expect("a rate")
}

#[test]
fn coaxial_cylinders_of_any_gap_recover_a_fluid_with_a_plateau() {
    for (fluid, tol) in [(CARREAU, SERIES), (ROUNDED, SERIES)] {
        for ratio in [0.2, 0.5, 0.9, 0.99, 0.999, 0.999_99] {
            let outer = 1.0 / ratio;
            let (curve, gap) = (Speed { fluid: &fluid, outer }, CouetteGeometry::new(1.0, outer).expect("a gap"));
            for stress in [1e-3, 0.5, 3.0, 40.0] {
                let found = functions::couette(&curve, gap, stress * core::f64::consts::TAU).expect("a sum");
                let truth = rate(&fluid, stress);
                assert_close("shear rate", &[found.value], &[truth], tol);
                assert!(found.enclosure[0] <= truth * (1.0 + 1e-13) && truth * (1.0 - 1e-13) <= found.enclosure[1]);
            }
        }
    }
}

/// ΔΩ of a power law between cylinders of radii 1 and R₂: T₁^(1/n) (1 − R₂^(−2/n)) n/(2 K^(1/n)).
struct PowerLawSpeed {
    consistency: f64,
    exponent: f64,
    outer: f64,
}

impl MeasuredCurve for PowerLawSpeed {
    fn response<T: Real>(&self, torque: T) -> T {
        let stress = torque * T::lit((core::f64::consts::TAU * self.consistency).recip());
        let share = -(-2.0 / self.exponent * (self.outer - 1.0).ln_1p()).exp_m1();
        stress.powf(T::lit(self.exponent.recip())) * T::lit(0.5 * self.exponent * share)
    }
}

fn stresses() -> impl Strategy<Value = f64> {
    (-6.0..6.0_f64).prop_map(f64::exp)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn coaxial_cylinders_recover_power_laws_without_a_term(
        consistency in 0.1..10.0_f64, exponent in 0.05..2.0_f64, gap in -9.0..2.0_f64, torque in stresses(),
    ) {
        let outer = 1.0 + gap.exp();
        let curve = PowerLawSpeed { consistency, exponent, outer };
        let found = functions::couette(&curve, CouetteGeometry::new(1.0, outer).expect("a gap"), torque).expect("a sum");
        let law = PowerLaw::new(consistency, exponent).expect("a fluid");
        let truth = rate(&law, torque / core::f64::consts::TAU);
        // The width of the gap is known to an ulp of R₂; the power 1/n multiplies the rounding of logarithms.
        let condition = 1.0 / (outer - 1.0).min(1.0) + 60.0 / exponent;
        assert_close("shear rate", &[found.value], &[truth], Tol::ulps(8.0).times(condition));
        prop_assert!(found.enclosure[0] <= truth * (1.0 + 1e-9) && truth * (1.0 - 1e-9) <= found.enclosure[1]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn pipes_channels_and_discs_recover_the_fluid_that_flowed(
        eta in 0.1..10.0_f64, share in 0.0..0.5_f64, time in 0.1..3.0_f64, exponent in 0.3..1.0_f64, drive in 0.1..10.0_f64,
    ) {
        let fluid = Plateau { eta: [eta, share * eta], time, power: 2.0, exponent };
        // Where the viscosity has fallen over decades a quadrature of 48 points is no longer exact.
        prop_assume!(rate(&fluid, drive) * time < 10.0);
        let wall = functions::pipe(&Discharge { fluid: &fluid }, PipeGeometry::new(1.0).expect("a pipe"), drive).expect("finite");
        assert_close("pipe", &[wall.shear_rate], &[rate(&fluid, 0.5 * drive)], LOCAL);
        let wall = functions::channel(&Sheet { fluid: &fluid }, ChannelGeometry::new(1.0).expect("a channel"), drive).expect("finite");
        assert_close("channel", &[wall.shear_rate], &[rate(&fluid, drive)], LOCAL);
        let plates = PlatesGeometry::new(1.0, 1.0).expect("plates");
        let discs = |thrust| Discs { fluid: &fluid, thrust };
        let speed = rate(&fluid, drive);
        let rim = functions::parallel_plates(&discs(false), plates, speed).expect("finite");
        assert_close("torque", &[rim.stress], &[drive], LOCAL);
        let rim = functions::parallel_plates_thrust(&discs(true), plates, speed).expect("finite");
        assert_close("thrust", &[rim.stress], &[speed * speed], LOCAL);
    }

    #[test]
    fn tables_of_power_laws_recover_them_to_rounding(
        consistency in 0.1..10.0_f64, exponent in 0.05..2.0_f64, outer in 1.01..3.0_f64, count in 8..40_usize,
    ) {
        let law = PowerLaw::new(consistency, exponent).expect("a fluid");
        let inverse = exponent.recip();
        let drives = (0..count).map(|i| (3.0 * i as f64 / (count - 1) as f64).exp());
        // Q = π R³ k_w/(3 + 1/n).
        let wall = |c: f64| rate(&law, 0.5 * c);
        let rows: Vec<_> = drives.clone().map(|c| [c, core::f64::consts::PI * wall(c) / (3.0 + inverse)]).collect();
        let curve = recover::pipe(&FlowTable::pipe(1.0, &rows).expect("a table")).expect("a curve");
        let curve = curve.with_band(0.95).expect("a band");
        let speed = PowerLawSpeed { consistency, exponent, outer };
        let rows: Vec<_> = drives.map(|torque| [torque, speed.response(torque)]).collect();
        let series = recover::couette(&FlowTable::couette(1.0, outer, &rows).expect("a table")).expect("a curve");
        let rounding = Tol::stated(1e-10, "rounding through the derivative of a spline of degree 7 at its end");
        for point in curve.points() {
            let point = point.expect("measured");
            let truth = rate(&law, point.shear_stress);
            assert_close("pipe", &[point.shear_rate], &[truth], rounding);
            let [low, high] = point.band.expect("asked for");
            prop_assert!(low <= truth && truth <= high);
        }
        for point in series.points() {
            let point = point.expect("measured");
            assert_close("cylinders", &[point.shear_rate], &[rate(&law, point.shear_stress)], rounding.times((1.0 / (outer - 1.0)).max(1.0)));
        }
    }
}

#[test]
fn limits_of_the_gap_are_off_by_no_more_than_they_say() {
    for ratio in [0.05, 0.5, 0.9, 0.99, 0.999] {
        let outer = 1.0 / ratio;
        let (curve, gap) = (Speed { fluid: &CARREAU, outer }, CouetteGeometry::new(1.0, outer).expect("a gap"));
        let (torque, truth) = (2.0 * core::f64::consts::TAU, rate(&CARREAU, 2.0));
        let wide = functions::couette_wide_gap(&curve, gap, torque).expect("finite");
        let narrow = functions::couette_narrow_gap(&curve, gap, torque).expect("finite");
        for found in [wide, narrow] {
            assert!((found.shear_rate - truth).abs() <= found.bound * (1.0 + 1e-12), "{ratio}: {found:?} {truth}");
        }
        assert!(0.9 < ratio || wide.bound < 1.3 * truth);
        assert!(ratio < 0.99 || narrow.bound < 0.1 * truth);
    }
}

#[test]
fn the_plain_series_comes_nearer_with_every_term_and_encloses_the_shear_rate() {
    let curve = Speed { fluid: &CARREAU, outer: 1.0 / 0.9 };
    let gap = CouetteGeometry::new(1.0, curve.outer).expect("a gap");
    let (torque, truth) = (2.0 * core::f64::consts::TAU, rate(&CARREAU, 2.0));
    let mut width = f64::INFINITY;
    for terms in [0, 1, 4, 16, 64] {
        let found = functions::couette_series(&curve, gap, torque, terms).expect("finite");
        let [low, high] = found.enclosure;
        assert!(low <= truth && truth <= high && high - low < width, "{terms}: {found:?} {truth}");
        assert!(truth - found.value <= found.error);
        width = high - low;
    }
    assert!(width < 1e-4 * truth);
}

/// The difference of the radial stresses ½ ∫ N₁(ζ(s)) ds/s with N₁ = 3 k², ζ = s, without inertia: ¾ (T₁² − T₂²).
struct Normal(f64);

impl MeasuredCurve for Normal {
    fn response<T: Real>(&self, torque: T) -> T {
        let stress = torque * T::lit(core::f64::consts::TAU.recip());
        stress * stress * T::lit(0.75 * (1.0 - self.0.powi(-4)))
    }
}

#[test]
fn normal_stresses_of_cylinders_recover_the_normal_stress_difference_of_either_sign() {
    struct Minus(Normal);
    impl MeasuredCurve for Minus {
        fn response<T: Real>(&self, torque: T) -> T {
            -self.0.response(torque)
        }
    }
    for outer in [1.001, 1.25, 2.0] {
        let gap = CouetteGeometry::new(1.0, outer).expect("a gap");
        let torque = 2.0 * core::f64::consts::TAU;
        let tol = Tol::ulps(8.0).times(1.0 / (outer - 1.0));
        let found = functions::couette(&Normal(outer), gap, torque).expect("a sum");
        assert_close("N1", &[found.value], &[12.0], tol);
        let found = functions::couette(&Minus(Normal(outer)), gap, torque).expect("a sum");
        assert_close("N1", &[found.value], &[-12.0], tol);
    }
}

#[test]
fn the_centrifugal_part_of_a_newtonian_fluid_is_its_closed_form() {
    // R₁ = 1, R₂ = 2, the inner cylinder at rest, ω = A (1 − 1/r²) with A = M/(4πμ): ∫ρξω²dξ = ρA² (3/2 − 2 ln 2 + 3/8).
    let gap = CouetteGeometry::new(1.0, 2.0).expect("a gap");
    let fluid = Newtonian::new(0.5).expect("a fluid");
    let (torque, density) = (3.0, 7.0);
    let found =
        functions::normal_stress_data(1.5, gap, density, 0.0, torque, |s| Ok(fluid.shear_rate(s)?)).expect("finite");
    let a = torque / (2.0 * core::f64::consts::TAU * 0.5);
    let exact = 1.5 + density * a * a * (1.875 - 2.0 * core::f64::consts::LN_2);
    assert_close("stress", &[found], &[exact], Tol::ulps(16.0));
}
