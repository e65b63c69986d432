//! Fluids fitted to the flows that they make, in closed form: the search must find the parameters that the flow was made of.

use core::f64::consts::PI;

use piola_measured::MeasuredError;
use piola_measured::rheology::{FlowKind, Measured, Request, Weighting, compare};
use piola_testkit::{Tol, assert_each_close};

use crate::rheology::csv;

/// A fluid by its name, with its parameters in the order of its fit.
type Made<'f> = (&'f str, &'f [f64]);

fn assert_found(
    (fluid, parameters): Made<'_>,
    kind: FlowKind,
    head: &str,
    rows: impl Iterator<Item = [f64; 2]>,
) -> Result<(), MeasuredError> {
    let measured = Measured::parse("made.csv", &csv(head, rows), kind, &[])?;
    for weighting in [Weighting::Relative, Weighting::Equal] {
        let mut request = Request::of(vec![fluid.parse()?]);
        request.weighting = weighting;
        let comparison = compare(&measured, &request)?;
        let what = format!("{fluid} from the flow {}, {weighting:?}", kind.name());
        let fit = comparison.candidates[0].fit.as_ref().unwrap_or_else(|error| panic!("{what}: {error}"));
        let found: Vec<f64> = fit.parameters.iter().map(|parameter| parameter.value).collect();
        assert_each_close(&what, &found, parameters, FOUND);
    }
    Ok(())
}

const FOUND: Tol = Tol::stated(1e-6, "the root of the rounding of squares, a hundred times where parameters are alike");

/// Rates from 0.01/s to 1000/s, evenly in the logarithm.
fn rates() -> impl Iterator<Item = f64> {
    (0..21).map(|i| 10.0_f64.powf(0.25 * f64::from(i) - 2.0))
}

#[test]
fn every_fluid_is_found_from_its_torques_under_a_cone() -> Result<(), MeasuredError> {
    // The rate is the same everywhere, Ω/α, and so is the stress: M = 2πR³ τ/3.
    let cone = |made: Made<'_>, rows: &mut dyn Iterator<Item = [f64; 2]>| {
        let rows = rows.map(|[rate, stress]| [0.02 * rate, 2.0 * PI * 8e-6 * stress / 3.0]);
        assert_found(made, FlowKind::Cone, "# radius: 20 mm\n# angle: 0.02 rad\nangular_velocity,torque", rows)
    };
    // Solutions with stresses of pascals, and melts that are a hundred thousand times as viscous.
    for s in [1.0, 1e5] {
        let at_rates =
            |made: Made<'_>, stress: &dyn Fn(f64) -> f64| cone(made, &mut rates().map(|k| [k, s * stress(k)]));
        at_rates(("newtonian", &[0.7 * s]), &|k| 0.7 * k)?;
        at_rates(("power-law", &[3.0 * s, 0.5]), &|k| 3.0 * k.sqrt())?;
        at_rates(("bingham", &[5.0 * s, 0.2 * s]), &|k| 5.0 + 0.2 * k)?;
        at_rates(("casson", &[5.0 * s, 0.2 * s]), &|k| (5.0_f64.sqrt() + (0.2 * k).sqrt()).powi(2))?;
        at_rates(("herschel-bulkley", &[5.0 * s, 2.0 * s, 0.5]), &|k| 5.0 + 2.0 * k.sqrt())?;
        let papanastasiou = |k: f64| 2.0 * k.sqrt() - 5.0 * (-20.0 * k).exp_m1();
        at_rates(("papanastasiou", &[5.0 * s, 2.0 * s, 0.5, 20.0]), &papanastasiou)?;
        at_rates(("eyring", &[4.0 * s, 0.5]), &|k| 4.0 * (0.5 * k).asinh())?;
        at_rates(("sisko", &[0.02 * s, 3.0 * s, 0.4]), &|k| 0.02 * k + 3.0 * k.powf(0.4))?;
        let cross = |k: f64| k * (0.01 + 7.99 / (1.0 + (2.0 * k).powf(0.7)));
        at_rates(("cross", &[8.0 * s, 0.01 * s, 2.0, 0.7]), &cross)?;
        let carreau = |k: f64| k * (0.01 + 7.99 * (1.0 + (2.0 * k).powf(1.5)).powf(-0.6 / 1.5));
        at_rates(("carreau-yasuda", &[8.0 * s, 0.01 * s, 2.0, 0.4, 1.5]), &carreau)?;
        // Ellis' rate is given by the stress.
        let stresses = rates().map(|x| 0.3 * x.powf(0.7));
        cone(
            ("ellis", &[8.0 * s, 5.0 * s, 2.5]),
            &mut stresses.map(|t| [t / 8.0 * (1.0 + (t / 5.0).powf(1.5)), s * t]),
        )?;
    }
    Ok(())
}

#[test]
fn newtonian_fluids_and_power_laws_are_found_from_pipes_channels_cylinders_and_plates() -> Result<(), MeasuredError> {
    // τ = K kⁿ at the wall, at the inner cylinder and at the rim, over one and a half decades of k and over five.
    let fluids: [(Made<'_>, f64); 4] = [
        (("newtonian", &[3.0]), 1.0),
        (("power-law", &[3.0, 1.0]), 1.0),
        (("power-law", &[3.0, 0.5]), 0.5),
        (("power-law", &[3.0, 0.3]), 0.3),
    ];
    for (rows, (made, n)) in [7, 21].into_iter().flat_map(|rows| fluids.map(|fluid| (rows, fluid))) {
        let walls = || rates().take(rows).map(|k| [k, 3.0 * k.powf(n)]);
        let pipe = walls().map(|[k, t]| [2.0 * t / 2e-3, PI * 8e-9 * k * n / (3.0 * n + 1.0)]);
        assert_found(made, FlowKind::Pipe, "# radius: 2 mm\npressure_gradient,discharge", pipe)?;
        let channel = walls().map(|[k, t]| [t / 1e-3, 2e-6 * k * n / (2.0 * n + 1.0)]);
        assert_found(made, FlowKind::Channel, "# half_width: 1 mm\npressure_gradient,discharge_per_width", channel)?;
        let cylinders = walls().map(|[k, t]| [2.0 * PI * 36e-6 * t, 0.5 * n * k * (1.0 - 0.36_f64.powf(1.0 / n))]);
        let head = "# inner_radius: 6 mm\n# outer_radius: 10 mm\ntorque_per_length,speed_difference";
        assert_found(made, FlowKind::Couette, head, cylinders)?;
        let plates = walls().map(|[k, t]| [0.125 * k, 2.0 * PI * 64e-9 * t / (n + 3.0)]);
        assert_found(made, FlowKind::Plates, "# radius: 4 mm\n# gap: 0.5 mm\nangular_velocity,torque", plates)?;
    }
    Ok(())
}

#[test]
fn bingham_s_plastic_is_found_from_pipes_channels_and_cylinders() -> Result<(), MeasuredError> {
    // Stresses of 1.1 to 350 times the yield stress of 5 Pa.
    let (yielding, viscosity) = (5.0, 0.2);
    let made: Made<'_> = ("bingham", &[yielding, viscosity]);
    let walls = || (0..21).map(|i| 1.1 * yielding * 10.0_f64.powf(0.125 * f64::from(i))).map(|t| (t, yielding / t));
    // Buckingham and Reiner: Q = πR³τ/(4η) (1 − 4φ/3 + φ⁴/3) with φ = τ₀/τ.
    let pipe = walls().map(|(t, share)| {
        [2.0 * t / 2e-3, PI * 8e-9 * t / (4.0 * viscosity) * (1.0 - 4.0 * share / 3.0 + share.powi(4) / 3.0)]
    });
    assert_found(made, FlowKind::Pipe, "# radius: 2 mm\npressure_gradient,discharge", pipe)?;
    let channel =
        walls().map(|(t, share)| [t / 1e-3, 2e-6 * t / (3.0 * viscosity) * (1.0 - 1.5 * share + 0.5 * share.powi(3))]);
    assert_found(made, FlowKind::Channel, "# half_width: 1 mm\npressure_gradient,discharge_per_width", channel)?;
    // Reiner and Riwlin: all of the gap flows where τ₀ < τ (R₁/R₂)².
    let sheared = walls().map(|(t, _)| 3.0 * t);
    let cylinders = sheared.map(|t| {
        [2.0 * PI * 36e-6 * t, t * (1.0 - 0.36) / (2.0 * viscosity) - yielding / viscosity * (10.0_f64 / 6.0).ln()]
    });
    let head = "# inner_radius: 6 mm\n# outer_radius: 10 mm\ntorque_per_length,speed_difference";
    assert_found(made, FlowKind::Couette, head, cylinders)
}

#[test]
fn sums_of_powers_of_the_rate_are_found_from_the_torques_of_plates() -> Result<(), MeasuredError> {
    // Each power K kⁿ at the rim adds 2πR³ K kⁿ/(n + 3) to the torque.
    let plates = |made: Made<'_>, torque: &dyn Fn(f64) -> f64| {
        let rows = rates().map(|k| [0.125 * k, 2.0 * PI * 64e-9 * torque(k)]);
        assert_found(made, FlowKind::Plates, "# radius: 4 mm\n# gap: 0.5 mm\nangular_velocity,torque", rows)
    };
    let power = |consistency: f64, n: f64, k: f64| consistency * k.powf(n) / (n + 3.0);
    plates(("bingham", &[5.0, 0.2]), &|k| power(5.0, 0.0, k) + power(0.2, 1.0, k))?;
    plates(("herschel-bulkley", &[5.0, 2.0, 0.5]), &|k| power(5.0, 0.0, k) + power(2.0, 0.5, k))?;
    plates(("sisko", &[0.02, 3.0, 0.4]), &|k| power(0.02, 1.0, k) + power(3.0, 0.4, k))
}

#[test]
fn eyring_s_fluid_is_found_from_pipes_channels_and_cylinders() -> Result<(), MeasuredError> {
    // λ k = sinh x with x = τ/τ₀ of 0.05 to 8.
    let (stress, time) = (4.0, 0.5);
    let made: Made<'_> = ("eyring", &[stress, time]);
    let walls = || (0..21).map(|i| 0.05 * 160.0_f64.powf(f64::from(i) / 20.0));
    // Moments of sinh, as series of positive terms: ∫ xᵐ sinh x dx = Σ xʲ⁺ᵐ⁺¹/((j + m + 1) j!) over odd j.
    let moment = |m: i32, x: f64| {
        let mut power = x;
        let mut sum = 0.0;
        for j in (1..60).step_by(2).map(f64::from) {
            sum += power / (j + f64::from(m) + 1.0);
            power *= x * x / ((j + 1.0) * (j + 2.0));
        }
        sum * x.powi(m + 1)
    };
    let pipe = walls().map(|x| [2.0 * stress * x / 2e-3, PI * 8e-9 * moment(2, x) / (time * x.powi(3))]);
    assert_found(made, FlowKind::Pipe, "# radius: 2 mm\npressure_gradient,discharge", pipe)?;
    let channel = walls().map(|x| [stress * x / 1e-3, 2e-6 * moment(1, x) / (time * x.powi(2))]);
    assert_found(made, FlowKind::Channel, "# half_width: 1 mm\npressure_gradient,discharge_per_width", channel)?;
    let speed = |x: f64| 0.5 * (moment(-1, x) - moment(-1, 0.36 * x)) / time;
    let cylinders = walls().map(|x| [2.0 * PI * 36e-6 * stress * x, speed(x)]);
    let head = "# inner_radius: 6 mm\n# outer_radius: 10 mm\ntorque_per_length,speed_difference";
    assert_found(made, FlowKind::Couette, head, cylinders)
}
