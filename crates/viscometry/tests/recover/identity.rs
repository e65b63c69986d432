//! Flows that are solved and recovered give back the fluid: as functions to the digits of the derivatives, as tables to those of the
//! rows, where the rows reach down far enough.

use core::f64::consts::{PI, TAU};

use piola_fluids::FluidsError;
use piola_fluids::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, Giesekus, HerschelBulkley, LinearPhanThienTanner, Newtonian,
    OldroydB, PowerLaw, SecondOrder, Sisko, ViscometricFluid,
};
use piola_numerics::{Mask, Real};
use piola_testkit::golden::{number, text, vector};
use piola_testkit::{Tol, assert_close};
use piola_viscometry::recover::{
    self, ChannelGeometry, CouetteGeometry, FlowTable, MeasuredCurve, PipeGeometry, functions,
};
use piola_viscometry::{Channel, Couette, Poiseuille, ViscometryError};
use proptest::prelude::*;
use serde_json::Value;

use super::fluids::legendre;
use super::golden::cases;

/// Where a fluid flows.
#[derive(Clone, Copy, Debug)]
enum Duct {
    /// Q(c) of a pipe of radius 1.
    Pipe,
    /// Q(c) for each width of a channel of half width 1.
    Channel,
    /// ΔΩ(M) between cylinders of the radii 1 and this.
    Cylinders(f64),
}

/// A solved flow as a function over any scalar, by a quadrature of its own: panels of the logarithm of the stress above yield.
struct Solved<'f, F> {
    fluid: &'f F,
    duct: Duct,
    rule: Vec<(f64, f64)>,
}

impl<'f, F: ViscometricFluid> Solved<'f, F> {
    fn new(fluid: &'f F, duct: Duct) -> Self {
        Self { fluid, duct, rule: legendre(20) }
    }

    fn rate<T: Real>(&self, stress: T) -> T {
        self.fluid.shear_rate(stress).unwrap_or_else(|error| panic!("{error}"))
    }

    /// ∫ f(v) dv from 0 to `width` in panels of a half or less.
    fn panels<T: Real>(&self, width: f64, f: impl Fn(f64) -> T) -> T {
        let count = (2.0 * width).ceil();
        let half = 0.5 * width / count;
        let mut sum = T::zero();
        let mut panel = 0.0;
        while panel < count {
            for &(node, weight) in &self.rule {
                sum += T::lit(half * weight) * f(half * (2.0 * panel + 1.0 + node));
            }
            panel += 1.0;
        }
        sum
    }

    /// ∫ w(s) ζ(s) ds from the yield stress to `wall`.
    fn above_yield<T: Real>(&self, wall: T, weight: impl Fn(T) -> T) -> T {
        let yields = T::lit(self.fluid.yield_stress());
        let excess = wall - yields;
        self.panels(36.0, |v| {
            let part = excess * T::lit((-v).exp());
            weight(yields + part) * self.rate(yields + part) * part
        })
    }
}

impl<F: ViscometricFluid> MeasuredCurve for Solved<'_, F> {
    fn response<T: Real>(&self, drive: T) -> T {
        match self.duct {
            Duct::Pipe => {
                let wall = T::lit(0.5) * drive;
                self.above_yield(wall, |s| s * s) * T::lit(PI) / wall.powi(3)
            }
            Duct::Channel => self.above_yield(drive, |s| s) * T::lit(2.0) / (drive * drive),
            Duct::Cylinders(outer) => {
                let wall = drive * T::lit(TAU.recip());
                let width = 2.0 * (outer - 1.0).ln_1p();
                let far = wall * T::lit((-width).exp());
                if far.at_most(T::lit(self.fluid.yield_stress())).any() {
                    return T::lit(0.5) * self.above_yield(wall, Real::recip);
                }
                // Beside a yield stress the rate is a power of what is above it.
                let yields = T::lit(self.fluid.yield_stress());
                let (top, low) = (wall - yields, far - yields);
                let span = (top / low).ln();
                let panels = span.primal(0);
                if 0.5 < panels && 0.0 < self.fluid.yield_stress() {
                    let sum = self.panels(panels, |v| {
                        let part = top * (-span * T::lit(v / panels)).exp();
                        self.rate(yields + part) * part / (yields + part)
                    });
                    return sum * span * T::lit(0.5 / panels);
                }
                T::lit(0.5) * self.panels(width, |v| self.rate(wall * T::lit((-v).exp())))
            }
        }
    }
}

/// What a flow of this crate answers to the same drive.
fn answer<F: ViscometricFluid>(fluid: &F, duct: Duct, drive: f64) -> Result<f64, ViscometryError> {
    Ok(match duct {
        Duct::Pipe => Poiseuille::new(1.0, drive)?.discharge(fluid)?.value,
        Duct::Channel => Channel::new(1.0, drive)?.discharge(fluid)?.value,
        Duct::Cylinders(outer) => Couette::new(1.0, outer, drive)?.speed_difference(fluid)?.value,
    })
}

/// The shear rate that is recovered from the flow as a function.
fn recovered<F: ViscometricFluid>(fluid: &F, duct: Duct, stress: f64) -> Result<f64, ViscometryError> {
    let solved = Solved::new(fluid, duct);
    Ok(match duct {
        Duct::Pipe => functions::pipe(&solved, PipeGeometry::new(1.0)?, 2.0 * stress)?.shear_rate,
        Duct::Channel => functions::channel(&solved, ChannelGeometry::new(1.0)?, stress)?.shear_rate,
        Duct::Cylinders(outer) => functions::couette(&solved, CouetteGeometry::new(1.0, outer)?, TAU * stress)?.value,
    })
}

/// At the drive of this wall stress the function is what the flow answers, and gives the shear rate back.
fn check<F: ViscometricFluid>(fluid: &F, excess: f64) {
    let yields = fluid.yield_stress();
    let stress = yields + excess;
    let truth: f64 = fluid.shear_rate(stress).expect("a rate");
    // Where the outer wall begins to yield the curve has a kink, and the series its largest error.
    let tol = if 0.0 < yields {
        Tol::stated(1e-8, "a kink at yield")
    } else {
        Tol::stated(1e-12, "derivatives of a quadrature")
    };
    for duct in DUCTS {
        let drive = match duct {
            Duct::Pipe => 2.0 * stress,
            Duct::Channel => stress,
            Duct::Cylinders(_) => TAU * stress,
        };
        let what = format!("{} of {duct:?} at {stress:e} Pa", F::NAME);
        let response = Solved::new(fluid, duct).response(drive);
        let flow = answer(fluid, duct, drive).expect("a flow");
        assert_close(&what, &[response], &[flow], Tol::stated(1e-12, "two quadratures"));
        assert_close(&what, &[recovered(fluid, duct, stress).expect("a rate")], &[truth], tol);
    }
}

const DUCTS: [Duct; 6] = [
    Duct::Pipe,
    Duct::Channel,
    Duct::Cylinders(2.0),
    Duct::Cylinders(1.0 / 0.9),
    Duct::Cylinders(1.0 / 0.99),
    Duct::Cylinders(1.0 / 0.999),
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn solved_flows_recover_every_fluid_as_functions(
        viscosity in 0.1..10.0_f64, time in 0.05..2.0_f64, exponent in 0.3..1.0_f64, excess in -3.0..2.5_f64,
    ) {
        let excess = 10.0_f64.powf(excess);
        check(&Newtonian::new(viscosity).expect("a fluid"), excess);
        check(&PowerLaw::new(viscosity, 2.0 * exponent - 0.3).expect("a fluid"), excess);
        check(&CarreauYasuda::new(viscosity, 0.02 * viscosity, time, exponent, 1.0 + time).expect("a fluid"), excess);
        check(&Cross::new(viscosity, 0.02 * viscosity, time, 1.0 - 0.9 * exponent).expect("a fluid"), excess);
        check(&Ellis::new(viscosity, 1.0 + time, 1.0 + exponent).expect("a fluid"), excess);
        check(&Eyring::new(1.0 + viscosity, time).expect("a fluid"), excess.min(10.0));
        check(&Sisko::new(viscosity, 1.0, exponent).expect("a fluid"), excess);
        check(&Bingham::new(time, viscosity).expect("a fluid"), excess);
        check(&Casson::new(time, viscosity).expect("a fluid"), excess);
        check(&HerschelBulkley::new(time, viscosity, exponent).expect("a fluid"), excess);
        check(&SecondOrder::new(viscosity, -time, time).expect("a fluid"), excess);
        check(&OldroydB::new(0.1 * viscosity, viscosity, time).expect("a fluid"), excess);
        check(&Giesekus::new(0.2 * viscosity, viscosity, time, 0.5 * exponent).expect("a fluid"), excess);
        check(&LinearPhanThienTanner::new(0.2 * viscosity, viscosity, time, exponent).expect("a fluid"), excess);
    }
}

#[test]
fn measured_functions_recover_the_rates_of_the_reference_values() {
    let tol = Tol::stated(
        5e-14,
        "a quadrature of some hundred panels; 2 % above yield an ulp of the stress is fifty of the rate",
    );
    for case in cases() {
        let p = |name: &str| number(&case["params"][name]);
        match text(&case["fluid"]) {
            "newtonian" => of_reference(&case, &Newtonian::new(p("mu")).expect("a fluid"), tol),
            "power_law" => of_reference(&case, &PowerLaw::new(p("K"), p("n")).expect("a fluid"), tol),
            "carreau_yasuda" => {
                let fluid = CarreauYasuda::new(p("eta0"), p("eta_inf"), p("lam"), p("n"), p("a"));
                of_reference(&case, &fluid.expect("a fluid"), tol);
            }
            "bingham" => of_reference(&case, &Bingham::new(p("tau_y"), p("mu")).expect("a fluid"), tol),
            "oldroyd_b" => of_reference(&case, &OldroydB::new(p("eta_s"), p("eta_p"), p("lam")).expect("a fluid"), tol),
            other => unreachable!("{other}"),
        }
    }
}

/// All rows of a case in a pipe, a channel, its own cylinders and in gaps that are wider and narrower.
fn of_reference<F: ViscometricFluid>(case: &Value, fluid: &F, tol: Tol) {
    let [couette, pipe] = ["couette", "pipe"].map(|flow| &case["output"][flow]);
    let cylinders = Duct::Cylinders(number(&case["input"]["couette"]["R2"]));
    let mut count = 0;
    for (stresses, rates, ducts) in [
        (&couette["tau_inner"], &couette["kappa_inner"], [&[cylinders], &DUCTS[2..]].concat()),
        (&pipe["tau_wall"], &pipe["kappa_wall"], DUCTS[..2].to_vec()),
    ] {
        for (stress, rate) in vector(stresses).into_iter().zip(vector(rates)) {
            for &duct in &ducts {
                let found = recovered(fluid, duct, stress).expect("a rate");
                assert_close(&format!("{} of {duct:?}", text(&case["id"])), &[found], &[rate], tol);
                count += 1;
            }
        }
    }
    assert_eq!(count, 25 * 7);
}

/// Rows of ΔΩ at wall stresses that rise by e^`step` from e^`lowest` up to e³.
fn table<F: ViscometricFluid>(fluid: &F, outer: f64, lowest: f64, step: f64) -> FlowTable<CouetteGeometry> {
    let mut rows = Vec::new();
    let mut u = 3.0;
    while lowest - 1e-9 <= u {
        let torque = TAU * u.exp();
        rows.push([torque, answer(fluid, Duct::Cylinders(outer), torque).expect("a flow")]);
        u -= step;
    }
    rows.reverse();
    FlowTable::couette(1.0, outer, &rows).expect("a table")
}

/// The median error of the rates at stresses from 1 to e³, all of which lie in the band.
fn median<F: ViscometricFluid>(fluid: &F, outer: f64, lowest: f64, step: f64) -> f64 {
    let curve = recover::couette(&table(fluid, outer, lowest, step)).and_then(|curve| curve.with_band(0.95));
    let curve = curve.expect("a curve");
    let mut errors: Vec<_> = (0..25)
        .map(|i| {
            let point = curve.at((0.125 * f64::from(i)).exp()).expect("measured");
            let truth: f64 = fluid.shear_rate(point.shear_stress).expect("a rate");
            let [low, high] = point.band.expect("asked for");
            assert!(low <= truth && truth <= high, "R2 = {outer}, from e^{lowest}: {truth} not in {low} .. {high}");
            (point.shear_rate / truth - 1.0).abs()
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors[12]
}

#[test]
fn tables_between_cylinders_recover_the_fluid_as_they_reach_lower_torques_and_have_more_rows() {
    let fluid = CarreauYasuda::new(2.0, 0.04, 0.7, 0.5, 2.0).expect("a fluid");
    // In a wide gap what lies below the smallest torque limits the digits, and more rows alone do not help.
    let alone = [0.125, 0.0625].map(|step| median(&fluid, 2.0, 0.0, step));
    assert!(0.5 * alone[0] < alone[1], "{alone:?}");
    // Every power of e that the table reaches down takes most of it away.
    let lower = [0.0, -1.0, -2.0, -4.0].map(|lowest| median(&fluid, 2.0, lowest, 0.0625));
    assert!(lower.windows(2).all(|pair| pair[1] < 0.2 * pair[0]) && lower[3] < 1e-8, "{lower:?}");
    // In a gap of a tenth the rows do: derivatives of splines of degree seven are of the order seven.
    let finer = [0.25, 0.125].map(|step| median(&fluid, 1.0 / 0.9, -2.0, step));
    assert!(finer[1] < 0.5_f64.powi(7) * finer[0] && finer[1] < 1e-8, "{finer:?}");
}

/// ζ = s, and from `from` on with a wave of the period δ in ln s: ζ = s + ¼ (δ/2π) from sin(2π ln(s/from)/δ).
struct Wave {
    from: f64,
    period: f64,
    height: f64,
}

impl Wave {
    fn rate<T: Real>(&self, stress: T) -> T {
        let size = stress.abs();
        let flat = size.at_most(T::lit(self.from));
        let above = T::select(flat, T::lit(self.from), size);
        let phase = (above * T::lit(self.from.recip())).ln() * T::lit(TAU / self.period);
        let rate = size + T::lit(self.height) * phase.sin();
        T::select(stress.less_than(T::zero()), -rate, rate)
    }
}

impl ViscometricFluid for Wave {
    const NAME: &'static str = "fluid with a wave";
    const CLOSED_RATE: bool = true;

    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        // The wave is steep a quarter at most.
        (0..80).fold(shear_rate, |stress, _| stress - T::lit(0.8) * (self.rate(stress) - shear_rate))
    }

    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        Ok(self.rate(shear_stress))
    }
}

#[test]
fn two_fluids_that_differ_by_a_wave_of_the_width_of_the_gap_have_one_table() {
    // No inversion of a table tells them apart: ΔΩ is the integral of the wave over one period.
    for outer in [2.0, 1.0 / 0.9] {
        let (period, from) = (2.0 * (outer - 1.0_f64).ln_1p(), (outer * outer).recip());
        let wave = Wave { from, period, height: 0.25 * from * period / TAU };
        let straight = Newtonian::new(1.0).expect("a fluid");
        for ([torque, one], [_, other]) in
            table(&wave, outer, 0.0, 0.125).rows().zip(table(&straight, outer, 0.0, 0.125).rows())
        {
            assert_close(&format!("{torque}"), &[one], &[other], Tol::stated(1e-13, "two quadratures"));
        }
        let most = |u: f64| (wave.rate(u.exp()) / u.exp() - 1.0).abs();
        let most = (0..100).map(|i| most(0.01 * f64::from(i))).fold(0.0, f64::max);
        assert!(1e-3 < most, "{most}");
    }
}
