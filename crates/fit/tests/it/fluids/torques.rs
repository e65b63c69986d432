//! Fluids from torques that have a closed form.

use core::f64::consts::PI;

use piola_fit::fluids::{FlowData, Options, fit_flow};
use piola_fluids::PowerLaw;
use piola_testkit::{Tol, assert_close};
use piola_viscometry::recover::FlowTable;

#[test]
fn torques_of_plates_and_of_a_cone_give_the_power_law_that_made_them() {
    let (consistency, exponent, radius, gap, angle) = (3.0, 0.6, 0.5_f64, 0.04, 0.05);
    let rows = |torque: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (0..12).map(|i| 0.02 * f64::from(i).exp2()).map(|speed| [speed, torque(speed)]).collect()
    };
    let stress = |rate: f64| consistency * rate.powf(exponent);
    // 2π ∫ r² K (Ω r/h)ⁿ dr and 2π ∫ r² K (Ω/α)ⁿ dr.
    let plates = rows(&|speed| 2.0 * PI * radius.powi(3) * stress(speed * radius / gap) / (3.0 + exponent));
    let cone = rows(&|speed| 2.0 * PI * radius.powi(3) * stress(speed / angle) / 3.0);
    let plates = FlowData::parallel_plates(&FlowTable::parallel_plates(radius, gap, &plates).expect("a table"));
    let cone = FlowData::cone_and_plate(&FlowTable::cone_and_plate(radius, angle, &cone).expect("a table"));
    let starts = [[1.0, 1.0], [5.0, 0.4]];
    for set in [plates, cone] {
        let fit = fit_flow::<PowerLaw, 2>(&[set], &starts, &Options::default()).expect("a fit");
        assert!(fit.outcome.is_converged(), "{:?}", fit.outcome);
        let found: Vec<_> = fit.parameters.iter().map(|parameter| parameter.value).collect();
        let tol = Tol::stated(1e-8, "the root of the rounding of the squares");
        assert_close("K, n", &found, &[consistency, exponent], tol);
    }
}
