//! Reference values of fluids in shear: `testdata/golden/shear_functions.json`.

use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, FlowMoment, FluidsError, HerschelBulkley,
    Papanastasiou, Sisko,
};
use piola_testkit::golden::{load, number, text};
use serde_json::Value;

/// The fluids of the tables.
pub(super) fn fluid(name: &str) -> AnyFluid {
    fluid_or_error(name).expect("the parameters are within bounds")
}

fn fluid_or_error(name: &str) -> Result<AnyFluid, FluidsError> {
    Ok(match name {
        "bingham" => Bingham::new(0.5, 0.75)?.into(),
        "herschel" => HerschelBulkley::new(0.5, 0.75, 0.4)?.into(),
        "casson" => Casson::new(0.5, 0.75)?.into(),
        "carreau" => CarreauYasuda::new(2.0, 0.0625, 1.5, 0.25, 0.75)?.into(),
        "cross" => Cross::new(2.0, 0.125, 1.5, 0.75)?.into(),
        "ellis" => Ellis::new(2.0, 1.5, 2.5)?.into(),
        "eyring" => Eyring::new(0.75, 1.5)?.into(),
        "sisko" => Sisko::new(0.5, 3.0, 0.375)?.into(),
        _ => Papanastasiou::new(0.5, 0.75, 0.5, 4.0)?.into(),
    })
}

fn cases(kind: &str) -> Vec<Value> {
    load("shear_functions").cases.into_iter().filter(|case| text(&case["kind"]) == kind).collect()
}

/// Fluid, k, τ.
pub(super) fn shear_stresses() -> Vec<(String, f64, f64)> {
    let stresses: Vec<_> = cases("shear_stress")
        .iter()
        .map(|case| (text(&case["fluid"]).to_owned(), number(&case["k"]), number(&case["tau"])))
        .collect();
    assert_eq!(stresses.len(), 45);
    stresses
}

/// Fluid, moment, from, to, ∫ sᵖ ζ ds.
pub(super) fn moments() -> Vec<(String, FlowMoment, f64, f64, f64)> {
    const MOMENTS: [FlowMoment; 4] =
        [FlowMoment::Reciprocal, FlowMoment::Zeroth, FlowMoment::First, FlowMoment::Second];
    let of = |case: &Value| {
        let power = case["power"].as_i64().expect("a power");
        let moment = MOMENTS.into_iter().find(|moment| i64::from(moment.power()) == power).expect("a moment");
        let [from, to, integral] = ["from", "to", "integral"].map(|name| number(&case[name]));
        (text(&case["fluid"]).to_owned(), moment, from, to, integral)
    };
    let moments: Vec<_> = cases("moment").iter().map(of).collect();
    assert_eq!(moments.len(), 83);
    moments
}
