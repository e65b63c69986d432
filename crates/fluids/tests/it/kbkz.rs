//! K-BKZ fluids and temperature shifts: golden values, closed forms, histories.

use piola_continuum::Symmetric;
use piola_fluids::{
    Arrhenius, Bingham, ConvectedMaxwell, ExponentialDamping, Kbkz, RationalDamping, Relaxation, Shifted,
    TemperatureShift, UpperConvectedMaxwell, ViscometricFluid, WilliamsLandelFerry,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::golden::{load, number, text};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const QUADRATURE: Tol = Tol::stated(1e-11, "quadratures");

fn rational(modes: &[(f64, f64)], alpha: f64) -> Kbkz<RationalDamping> {
    let memory = modes.iter().map(|&(viscosity, time)| Relaxation { viscosity, time }).collect();
    Kbkz::new(memory, RationalDamping::new(alpha, 0.5).expect("bounds")).expect("bounds")
}

fn wagner(strength: f64) -> Kbkz<ExponentialDamping> {
    let memory = vec![Relaxation { viscosity: 2.0, time: 0.5 }, Relaxation { viscosity: 1.0, time: 4.0 }];
    Kbkz::new(memory, ExponentialDamping::new(strength, 1.0).expect("bounds")).expect("bounds")
}

/// Cₜ⁻¹ of a shear γ.
fn inverse(strain: f64) -> Symmetric {
    Symmetric::new(1.0, 1.0 + strain * strain, 1.0, strain, 0.0, 0.0)
}

#[test]
fn steady_shear_of_rational_damping_equals_golden() {
    let mut count = 0;
    for case in &load("fluids").cases {
        let ("kbkz_psm_steady_shear", input, output) = (text(&case["kind"]), &case["input"], &case["output"]) else {
            continue;
        };
        let pairs = input["modes"].as_array().expect("modes");
        let modes: Vec<_> = pairs.iter().map(|pair| (number(&pair[0]), number(&pair[1]))).collect();
        let (fluid, k) = (rational(&modes, number(&input["alpha"])), number(&input["k"]));
        let of = |name: &str| [number(&output[name])];
        let id = text(&case["id"]);
        assert_close(id, &[fluid.shear_stress(k)], &of("tau"), QUADRATURE);
        assert_close(id, &[fluid.sigma1(k)], &of("sigma1"), QUADRATURE);
        assert_close(id, &[fluid.sigma2(k)], &of("sigma2"), QUADRATURE);
        assert_close(id, &[fluid.first_normal_stress_difference(k)], &of("N1"), QUADRATURE);
        assert_close(id, &[fluid.second_normal_stress_difference(k)], &of("N2"), QUADRATURE);
        assert_close(id, &[fluid.viscosity(k)], &of("viscosity"), QUADRATURE);
        for (integral, name) in fluid.steady_shear(k).iter().zip(["tau", "N1"]) {
            let error = (integral.value - of(name)[0]).abs();
            assert!(
                // The bound is not idle: a tenth of what the values are compared with.
                error <= integral.bound && integral.bound <= QUADRATURE.times(0.1).value() * integral.value,
                "{id}: {error:e}, {integral:?}"
            );
        }
        let history = fluid.stress_of_history(|s| inverse(k * s), f64::INFINITY).expect("an age");
        let [t11, t22, _, t12, ..] = history.value.components;
        assert_close(id, &[t12, t22 - t11], &[of("tau")[0], of("N1")[0]], QUADRATURE);
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn steady_shear_of_exponential_damping_equals_its_closed_form() {
    for strength in [0.0, 0.2, 1.0] {
        let fluid = wagner(strength);
        for k in [1e-8, 1e-3, 0.7, 30.0, 1e4, 1e8] {
            let (mut shear, mut first) = (0.0, 0.0);
            for term in fluid.memory() {
                let left = 1.0 + strength * term.time * k;
                shear += term.viscosity * k / (left * left);
                first += 2.0 * term.viscosity * term.time * k * k / (left * left * left);
            }
            let what = format!("n = {strength}, k = {k:e}");
            assert_close(&what, &[fluid.shear_stress(-k)], &[-shear], Tol::stated(1e-14, "exponential convergence"));
            assert_close(&what, &[fluid.sigma2(k)], &[first], Tol::stated(1e-14, "exponential convergence"));
            assert_close(&what, &[fluid.viscosity(k)], &[shear / k], Tol::stated(1e-14, "exponential convergence"));
        }
    }
    assert_close("at rest", &[wagner(0.2).viscosity(0.0)], &[3.0], Tol::stated(1e-14, "exponential convergence"));
    assert_close("at rest", &[wagner(0.2).shear_stress(0.0)], &[0.0], Tol::ulps(0.0));
}

#[test]
fn fluids_without_damping_equal_maxwell_fluid() {
    let fluid =
        Kbkz::new(vec![Relaxation { viscosity: 2.0, time: 0.5 }], ExponentialDamping::new(0.0, 0.25).expect("bounds"))
            .expect("bounds");
    let maxwell = UpperConvectedMaxwell::new(2.0, 0.5).expect("bounds");
    for time in [1e-6, 0.1, 1.0, 20.0] {
        let (a, b) = (fluid.start_up(3.0, time).expect("a time"), maxwell.start_up(3.0, time).expect("a time"));
        assert_close("start-up", &[a.value.shear], &[b.shear], QUADRATURE);
        assert_close("start-up", &[a.value.first], &[b.first], QUADRATURE);
        assert!((a.value.shear - b.shear).abs() <= a.bound, "{:e}", a.bound);
        let (a, b) = (fluid.cessation(3.0, time).expect("a time"), maxwell.cessation(3.0, time).expect("a time"));
        assert_close("cessation", &[a.value.shear], &[b.shear], QUADRATURE);
        assert_close("cessation", &[a.value.first], &[b.first], QUADRATURE);
    }
    assert_close("G", &[fluid.step_strain(0.5, 0.5).shear], &[2.0 * (-1.0_f64).exp()], Tol::ulps(4.0));
}

#[test]
fn start_up_and_cessation_equal_the_steady_state_in_their_limits() {
    let fluid = rational(&[(2.0, 0.5), (1.0, 4.0)], 8.0);
    for k in [0.1, 5.0, 1e4] {
        let steady = [fluid.shear_stress(k), fluid.sigma2(k)];
        let (grown, at_once) = (fluid.start_up(k, 400.0).expect("a time"), fluid.cessation(k, 1e-13).expect("a time"));
        assert_close("start-up", &[grown.value.shear, grown.value.first], &steady, QUADRATURE);
        assert_close("cessation", &[at_once.value.shear, at_once.value.first], &steady, QUADRATURE);
        let history = fluid.stress_of_history(|s| inverse(k * s.min(0.3)), 0.3).expect("an age");
        let start = fluid.start_up(k, 0.3).expect("a time").value;
        let [t11, t22, _, t12, ..] = history.value.components;
        assert_close("history", &[t12, t22 - t11], &[start.shear, start.first], QUADRATURE);
    }
    assert!(fluid.start_up(f64::NAN, 1.0).is_err());
    assert!(fluid.start_up(1.0, 0.0).is_err());
    assert!(Kbkz::new(Vec::new(), RationalDamping::new(1.0, 0.0).expect("bounds")).is_err());
    assert!(RationalDamping::new(0.0, 0.5).is_err());
    assert!(ExponentialDamping::new(0.1, 1.5).is_err());
}

#[test]
fn derivatives_and_lanes_equal_those_of_the_closed_form() {
    let fluid = wagner(0.2);
    let ks = [1e-8, 0.7, 30.0, 1e4];
    let lanes = fluid.shear_stress(Lanes::<f64, 4>::from(ks));
    for (lane, k) in ks.into_iter().enumerate() {
        let tolerance = Tol::stated(1e-13, "exponential convergence");
        assert_close("lanes", &[lanes.primal(lane)], &[fluid.shear_stress(k)], tolerance);
        let slope: f64 = fluid
            .memory()
            .iter()
            .map(|term| {
                let x = 0.2 * term.time * k;
                term.viscosity * (1.0 - x) / (1.0 + x).powi(3)
            })
            .sum();
        let scale = fluid.viscosity(k);
        let found = fluid.shear_stress(Dual::variable(k)).tangent;
        assert_close_at_scale(&format!("dτ/dk at {k:e}"), &[found], &[slope], scale, tolerance);
    }
    // The stress of rational damping grows: it has an inverse.
    let fluid = rational(&[(2.0, 0.5)], 8.0);
    assert_close("ζ", &[fluid.shear_rate(fluid.shear_stress(0.9)).expect("a rate")], &[0.9], Tol::ulps(64.0));
}

#[test]
fn shifted_fluids_equal_the_fluid_at_shifted_rates() {
    let arrhenius = Arrhenius::new(50e3, 300.0).expect("bounds");
    assert_close("θ₀", &[arrhenius.factor(300.0).expect("θ")], &[1.0], Tol::ulps(0.0));
    let near = arrhenius.logarithm(300.0 + 1e-9).expect("θ");
    let difference = (300.0_f64 + 1e-9) - 300.0;
    assert_close(
        "near θ₀",
        &[near],
        &[-50e3 / 8.314_462_618_153_24 * difference / 90_000.0],
        Tol::ulps(64.0).or(Tol::stated(1e-11, "θ = θ₀ (1 + 3e-12)")),
    );
    let wlf = WilliamsLandelFerry::new(17.44, 51.6, 373.0).expect("bounds");
    assert_close("universal", &[wlf.factor(424.6).expect("θ")], &[10.0_f64.powf(-8.72)], Tol::ulps(64.0));
    let fluid = Bingham::new(1.0, 2.0).expect("bounds");
    let warm = arrhenius.shifted(fluid, 350.0).expect("θ");
    let a = warm.factor();
    for k in [-3.0, 0.0, 1e-8, 1e8] {
        assert_close("τ", &[warm.shear_stress(k)], &[fluid.shear_stress(a * k)], Tol::ulps(0.0));
        assert_close(
            "ζ",
            &[warm.shear_rate(warm.shear_stress(k)).expect("a rate")],
            &[k],
            Tol::ulps(8.0).times(1.0 + 1.0 / (a * k.abs().max(1e-8))),
        );
    }
    assert!(wlf.factor(300.0).is_err());
    assert!(arrhenius.factor(0.0).is_err());
    assert!(arrhenius.factor(f64::NAN).is_err());
    assert!(Shifted::new(fluid, 0.0).is_err());
    assert!(Arrhenius::new(-1.0, 300.0).is_err());
}
