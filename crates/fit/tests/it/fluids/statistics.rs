//! Intervals and criteria under noise.

use piola_fit::fluids::{FlowData, Options, Weighting, fit_flow};
use piola_fluids::{CarreauYasuda, HerschelBulkley, PowerLaw};

/// `SplitMix64` and the transform of Box and Muller.
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn draw(&mut self) -> f64 {
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * u.ln()).sqrt() * (core::f64::consts::TAU * v).cos()
    }
}

fn noisy(normal: &mut Normal, level: f64, stress: impl Fn(f64) -> f64) -> FlowData {
    let rates = (0..25).map(|i| (0.25 * f64::from(i) - 3.0).exp());
    let rows: Vec<_> = rates.map(|k| [k, stress(k) * (1.0 + level * normal.draw())]).collect();
    FlowData::flow_curve(&rows).expect("data")
}

#[test]
fn intervals_of_confidence_hold_the_truth_as_often_as_they_say() {
    let mut normal = Normal(5);
    let trials = 1000;
    let mut held = [0; 2];
    for _ in 0..trials {
        let data = noisy(&mut normal, 0.01, |k| 3.0 * k.sqrt());
        let fit = fit_flow::<PowerLaw, 2>(&[data], &[[1.0, 1.0]], &Options::default()).expect("a fit");
        for ((parameter, truth), held) in fit.parameters.iter().zip([3.0, 0.5]).zip(&mut held) {
            let [low, high] = parameter.interval.expect("determined");
            *held += u32::from(low <= truth && truth <= high);
        }
    }
    for held in held {
        // 950 ± 7: three deviations.
        assert!(929 <= held && held <= 971, "{held}");
    }
}

#[test]
fn akaikes_criterion_prefers_the_fluid_that_made_the_data() {
    let mut normal = Normal(6);
    let data = [noisy(&mut normal, 0.01, |k| 3.0 * k.sqrt())];
    let options = Options::default();
    let two = fit_flow::<PowerLaw, 2>(&data, &[[1.0, 1.0]], &options).expect("a fit");
    let three = fit_flow::<HerschelBulkley, 3>(&data, &[[0.1, 1.0, 1.0], [0.01, 3.0, 0.6]], &options).expect("a fit");
    assert!(two.criteria.aicc.expect("rows") < three.criteria.aicc.expect("rows"));
    assert!(three.squares <= two.squares * (1.0 + 1e-6));
    let curved = [noisy(&mut normal, 0.01, |k| 1.0 + 3.0 * k.sqrt())];
    let two = fit_flow::<PowerLaw, 2>(&curved, &[[1.0, 1.0]], &options).expect("a fit");
    let three = fit_flow::<HerschelBulkley, 3>(&curved, &[[0.1, 1.0, 1.0]], &options).expect("a fit");
    assert!(three.criteria.aicc.expect("rows") < two.criteria.aicc.expect("rows"));
    assert!((three.parameters[0].value - 1.0).abs() < 0.1);
}

#[test]
fn parameters_stay_between_their_bounds_and_weights_choose_the_rows_that_count() {
    let mut normal = Normal(7);
    let data = [noisy(&mut normal, 0.02, |k| 2.0 * k / (1.0 + 2.0 * k * k).powf(0.3))];
    let bounds = vec![("exponent".to_owned(), [0.45, 1.0]), ("infinite_rate_viscosity".to_owned(), [0.0, 1e-3])];
    let options = Options { bounds, ..Options::default() };
    let start = [1.0, 5e-4, 1.0, 0.7, 2.0];
    let fit = fit_flow::<CarreauYasuda, 5>(&data, &[start], &options).expect("a fit");
    let exponent = fit.parameters[3].value;
    assert!((0.45..=1.0).contains(&exponent) && exponent < 0.5, "{exponent}");
    // With errors of equal size the large stresses count: a power law fits them and not the small ones.
    let equal = Options { weighting: Weighting::Equal, ..Options::default() };
    let relative = fit_flow::<PowerLaw, 2>(&data, &[[1.0, 1.0]], &Options::default()).expect("a fit");
    let equal = fit_flow::<PowerLaw, 2>(&data, &[[1.0, 1.0]], &equal).expect("a fit");
    assert!(equal.fluid.exponent() < relative.fluid.exponent());
}
