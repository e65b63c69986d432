//! What cannot be fitted is refused by name.

use piola_fit::FitError;
use piola_fit::fluids::{FlowData, Options, fit_flow};
use piola_fluids::{Bingham, CarreauYasuda, HerschelBulkley, PowerLaw};
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{FlowTable, Noise};

fn curve() -> FlowData {
    FlowData::flow_curve(&[[1.0, 3.0], [4.0, 6.0], [9.0, 9.0]]).expect("data")
}

fn sentence(options: &Options) -> String {
    fit_flow::<PowerLaw, 2>(&[curve()], &[[1.0, 1.0]], options).expect_err("refused").to_string()
}

#[test]
fn impossible_options_are_refused() {
    let confidence = Options { confidence: 1.5, ..Options::default() };
    assert_eq!(sentence(&confidence), "the confidence 1.5 is not between 0 and 1");
    let bounds = |name: &str, pair| Options { bounds: vec![(name.to_owned(), pair)], ..Options::default() };
    assert_eq!(sentence(&bounds("viscosity", [0.0, 1.0])), "power law has no parameter `viscosity`");
    let crossed = "the bounds 2e0 and 1e0 of `exponent` must be finite, the lower below the upper";
    assert_eq!(sentence(&bounds("exponent", [2.0, 1.0])), crossed);
}

#[test]
fn data_that_say_nothing_are_refused() {
    let empty = fit_flow::<PowerLaw, 2>(&[], &[[1.0, 1.0]], &Options::default());
    assert_eq!(empty, Err(FitError::TooFewPoints { model: "power law".to_owned(), points: 0, parameters: 2 }));
    let none = fit_flow::<PowerLaw, 2>(&[curve()], &[], &Options::default());
    assert_eq!(none, Err(FitError::NoStart { model: "power law".to_owned() }));
    assert_eq!(
        FlowData::flow_curve(&[[1.0, 3.0], [0.5, 4.0]]),
        Err(FitError::Viscometry(ViscometryError::RowNotSorted { row: 1, value: 0.5, previous: 1.0 }))
    );
    assert!(FlowData::flow_curve(&[[1.0, f64::NAN]]).is_err() && !curve().is_empty());
}

#[test]
fn responses_that_fall_beyond_their_noise_are_refused_with_their_row() {
    let fitted = |data: FlowData| fit_flow::<PowerLaw, 2>(&[data], &[[1.0, 1.0]], &Options::default()).map(|_| ());
    let curve = |rows: &[[f64; 2]]| FlowData::flow_curve(rows).expect("data");
    // Too few rows tell no noise: any fall counts.
    let few = [[1.0, 3.0], [2.0, 4.0], [3.0, 3.98]];
    let falls = Err(FitError::Viscometry(ViscometryError::ResponseFalls { row: 2, value: 3.98, previous: 4.0 }));
    assert_eq!(fitted(curve(&few)), falls);
    assert_eq!(fitted(curve(&few).with_noise(Noise::Exact).expect("a noise")), falls);
    assert_eq!(fitted(curve(&few).with_noise(Noise::Relative(0.01)).expect("a noise")), Ok(()));
    assert!(curve(&few).with_noise(Noise::Relative(-0.01)).is_err());
    // Slowly, by less than the noise from row to row, but further and further below the largest.
    let slowly: Vec<_> = (1..30_u32).map(|i| [f64::from(i), 2.0 - 0.02 * f64::from(i)]).collect();
    let stated = curve(&slowly).with_noise(Noise::Relative(0.01)).expect("a noise");
    assert_eq!(
        fitted(stated),
        Err(FitError::Viscometry(ViscometryError::ResponseFalls { row: 7, value: 2.0 - 0.16, previous: 2.0 - 0.02 }))
    );
    // Nothing is above the first.
    let constant = [[1.0, 2.0], [2.0, 2.0], [3.0, 2.0], [4.0, 2.0], [5.0, 2.0], [6.0, 2.0]];
    let stays = Err(FitError::Viscometry(ViscometryError::ResponseFalls { row: 1, value: 2.0, previous: 2.0 }));
    assert_eq!(fitted(curve(&constant)), stays);
    let table = FlowTable::pipe(1.0, &constant).expect("a table");
    assert_eq!(table.check_rising().map_err(FitError::from), stays);
    assert_eq!(fitted(FlowData::pipe(&table)), stays);
}

#[test]
fn a_start_at_which_nothing_flows_is_no_start() {
    let table = FlowTable::pipe(1.0, &[[2.0, 0.1], [4.0, 0.5], [6.0, 1.0]]).expect("a table");
    let fit = |start| fit_flow::<Bingham, 2>(&[FlowData::pipe(&table)], &[start], &Options::default());
    assert_eq!(fit([10.0, 1.0]), Err(FitError::NoStart { model: "Bingham".to_owned() }));
    assert!(fit([0.1, 1.0]).is_ok());
}

#[test]
fn a_row_that_is_off_by_twelve_decades_ends_every_search() {
    let mut rows: Vec<_> = (1..=12).map(f64::from).map(|c| [c, core::f64::consts::PI * c / 16.0]).collect();
    rows[2][1] = 4.9e11;
    let data = FlowData::pipe(&FlowTable::pipe(1.0, &rows).expect("a table"));
    assert!(matches!(data.check_rising(), Err(FitError::Viscometry(ViscometryError::ResponseFalls { row: 3, .. }))));
    // Noise of decades admits it.
    let data = [data.with_noise(Noise::Relative(10.0)).expect("a noise")];
    let options = Options::default();
    // What comes out matters little; that it does, does.
    let power = fit_flow::<PowerLaw, 2>(&data, &[[2.0, 1.0], [2.0, 0.05]], &options);
    let yielding = fit_flow::<HerschelBulkley, 3>(&data, &[[0.1, 2.0, 1.0], [0.4, 1.0, 0.4]], &options);
    let plateau = fit_flow::<CarreauYasuda, 5>(&data, &[[2.0, 0.2, 1.0, 0.1, 2.0]], &options);
    let squares = [power.map(|fit| fit.squares), yielding.map(|fit| fit.squares), plateau.map(|fit| fit.squares)];
    assert!(squares.iter().all(|outcome| outcome.as_ref().is_ok_and(|squares| squares.is_finite())), "{squares:?}");
}
