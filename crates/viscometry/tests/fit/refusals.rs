//! What cannot be fitted is refused by name.

use piola_constitutive::fluids::{Bingham, PowerLaw};
use piola_viscometry::ViscometryError;
use piola_viscometry::fit::{FlowData, Options, fit_flow};
use piola_viscometry::recover::FlowTable;

fn curve() -> FlowData {
    FlowData::flow_curve(&[[1.0, 3.0], [4.0, 6.0], [9.0, 9.0]]).expect("data")
}

fn sentence(options: &Options) -> String {
    fit_flow::<PowerLaw, 2>(&[curve()], &[[1.0, 1.0]], options).expect_err("refused").to_string()
}

#[test]
fn impossible_options_are_refused() {
    let confidence = Options { confidence: 1.5, ..Options::default() };
    assert_eq!(sentence(&confidence), "the confidence 1.5 violates 0 < confidence < 1");
    let bounds = |name: &str, pair| Options { bounds: vec![(name.to_owned(), pair)], ..Options::default() };
    assert_eq!(sentence(&bounds("viscosity", [0.0, 1.0])), "power law has no parameter `viscosity`");
    let crossed = "nothing lies between the bounds 2e0 and 1e0 of `exponent`, or they are not finite";
    assert_eq!(sentence(&bounds("exponent", [2.0, 1.0])), crossed);
}

#[test]
fn data_that_say_nothing_are_refused() {
    let empty = fit_flow::<PowerLaw, 2>(&[], &[[1.0, 1.0]], &Options::default());
    assert_eq!(empty, Err(ViscometryError::TooFewRows { rows: 0, least: 2 }));
    let none = fit_flow::<PowerLaw, 2>(&[curve()], &[], &Options::default());
    assert_eq!(none, Err(ViscometryError::NoStart { fluid: "power law" }));
    assert_eq!(
        FlowData::flow_curve(&[[1.0, 3.0], [0.5, 4.0]]),
        Err(ViscometryError::RowNotSorted { row: 1, value: 0.5, previous: 1.0 })
    );
    assert!(FlowData::flow_curve(&[[1.0, f64::NAN]]).is_err() && !curve().is_empty());
}

#[test]
fn a_start_at_which_nothing_flows_is_no_start() {
    let table = FlowTable::pipe(1.0, &[[2.0, 0.1], [4.0, 0.5], [6.0, 1.0]]).expect("a table");
    let fit = |start| fit_flow::<Bingham, 2>(&[FlowData::pipe(&table)], &[start], &Options::default());
    assert_eq!(fit([10.0, 1.0]), Err(ViscometryError::NoStart { fluid: "Bingham" }));
    assert!(fit([0.1, 1.0]).is_ok());
}
