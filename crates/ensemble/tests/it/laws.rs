//! Members against closed forms; random values against their laws; what is refused.

use piola_ensemble::{Ensemble, EnsembleError, Portion, Random, Statistics, ValueRange};
use piola_scene::Document;
use piola_testkit::{Tol, assert_close};

use crate::journal::orbit;

fn range(text: &str) -> ValueRange {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

fn random(text: &str) -> Random {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_last_range_changes_fastest_and_units_are_of_the_range() {
    let ranges = vec![range("body.comet.semi_major_axis=1:3:3"), range("body.comet.mean_anomaly=0:90:2 deg")];
    let ensemble = Ensemble::new(orbit(), ranges, Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(ensemble.members(), 6);
    assert_eq!(ensemble.varied(), ["body.comet.semi_major_axis", "body.comet.mean_anomaly (deg)"]);
    let settings: Vec<Vec<f64>> = (0..6).map(|member| ensemble.settings(member)).collect();
    assert_eq!(settings, [[1.0, 0.0], [1.0, 90.0], [2.0, 0.0], [2.0, 90.0], [3.0, 0.0], [3.0, 90.0]]);
}

/// A revolution ends where it began: r = a (1 − e²)/(1 + e cos f), the energy is −GM/(2a).
#[test]
fn revolutions_end_where_they_began() {
    let ranges = vec![range("body.comet.semi_major_axis=1:4:4"), range("body.comet.eccentricity=0:0.6:3")];
    let ensemble = Ensemble::new(orbit(), ranges, Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"));
    let place = |name: &str| {
        ensemble.columns().iter().position(|other| other == name).unwrap_or_else(|| panic!("{:?}", ensemble.columns()))
    };
    let places = ["comet x (m)", "comet y (m)", "time (s)"].map(place);
    for member in 0..ensemble.members() {
        let [a, e] = [0, 1].map(|index| ensemble.settings(member)[index]);
        let found = ensemble.member(member);
        assert_eq!(found.failure, None);
        let [x, y, t] = places.map(|place| found.values[place]);
        assert_close("r", &[x.hypot(y)], &[a * (1.0 - e)], Tol::stated(1e-10, "the tolerance of the scene's method"));
        assert_close("T", &[t], &[core::f64::consts::TAU * a.powf(1.5)], Tol::ulps(8.0));
    }
}

/// Means and deviations of 4,000 members, at four standard errors.
#[test]
fn random_values_have_their_laws_and_depend_on_member_and_seed_alone() {
    let (normal, uniform) = (random("a.b=normal(3, 0.5) kg"), random("a.c=uniform(-1, 2)"));
    let draws = |law: &Random, which| (0..4000).map(|member| law.value(11, which, member)).collect::<Vec<f64>>();
    let of = |values: &[f64]| Statistics::of(values).unwrap_or_else(|| panic!("numbers"));
    let (first, second) = (of(&draws(&normal, 0)), of(&draws(&uniform, 1)));
    let error = 4.0 / 4000_f64.sqrt();
    assert!((first.mean - 3.0).abs() < 0.5 * error && (second.mean - 0.5).abs() < 0.75_f64.sqrt() * error);
    let deviations = [first.deviation, second.deviation].map(Option::unwrap_or_default);
    assert!((deviations[0] - 0.5).abs() < 0.5 * error && (deviations[1] - 0.75_f64.sqrt()).abs() < error);
    assert!(-1.0 <= second.quantiles[0] && second.quantiles[4] < 2.0);
    assert!((second.quantiles[2] - 0.5).abs() < 3.0 * error);
    assert_eq!(normal.value(11, 0, 5).to_bits(), draws(&normal, 0)[5].to_bits());
    assert!((normal.value(11, 0, 5) - normal.value(12, 0, 5)).abs() > 0.0);
    assert!((normal.value(11, 0, 5) - normal.value(11, 1, 5)).abs() > 0.0);
    assert_eq!(normal.setting(11, 0, 5), format!("a.b={:?} kg", normal.value(11, 0, 5)));
}

#[test]
fn statistics_leave_out_what_is_no_number() {
    let found = Statistics::of(&[1.0, f64::NAN, 3.0, 2.0]).unwrap_or_else(|| panic!("numbers"));
    assert_eq!((found.count, found.deviation, found.quantiles[2]), (3, Some(1.0), 2.0));
    assert_close("mean", &[found.mean], &[2.0], Tol::ulps(2.0));
    assert_eq!(Statistics::of(&[f64::NAN]), None);
    assert_eq!(Statistics::of(&[5.0]).and_then(|one| one.deviation), None);
}

#[test]
fn what_cannot_be_varied_is_refused_by_name() {
    for wrong in ["a", "a=1", "a=1:2", "a=1:2:0", "a=1:nan:3", "a=x:2:3", "=1:2:3", "a=-1e308:1e308:3"] {
        let error = wrong.parse::<ValueRange>().err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains("PATH=FROM:TO:COUNT UNIT"), "{wrong}: {error}");
    }
    for wrong in
        ["a", "a=normal", "a=normal(1)", "a=normal(1, 0)", "a=uniform(2, 1)", "a=cauchy(0, 1)", "a=normal(nan, 1)"]
    {
        let error = wrong.parse::<Random>().err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains("PATH=normal(MEAN, DEVIATION) UNIT"), "{wrong}: {error}");
    }
    for wrong in ["1", "0/2", "3/2", "a/b", "1/0"] {
        assert!(wrong.parse::<Portion>().is_err(), "{wrong}");
    }
    let made = |ranges: &[&str], random: &[&str], repeats| {
        let ranges = ranges.iter().map(|text| text.parse()).collect::<Result<_, _>>();
        let random = random.iter().map(|text| text.parse()).collect::<Result<_, _>>();
        Ensemble::new(orbit(), ranges.unwrap_or_default(), random.unwrap_or_default(), repeats, 0)
            .map_or_else(|error| error.to_string(), |_| String::new())
    };
    let axis = "body.comet.semi_major_axis=1:4:4";
    assert!(made(&[axis, axis], &[], 1).contains("each value once"));
    assert!(made(&[axis], &[], 3).contains("unless a value is random"));
    assert!(made(&["body.comet.eccentricity=0:0.5:100000000", axis], &[], 1).contains("are too many"));
    let unknown = made(&["body.comet.colour=1:2:2"], &[], 1);
    assert!(unknown.contains("member 0 is not valid") && unknown.contains("colour"), "{unknown}");
    let empty = Ensemble::new(Document::parse("empty.toml", ""), Vec::new(), Vec::new(), 1, 0);
    assert!(matches!(empty, Err(EnsembleError::Invalid { .. })));
}
