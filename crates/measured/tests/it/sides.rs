//! Foams and fibres: tables, cards, and the fit as a solid.

use core::fmt::Write as _;

use piola_measured::fitting::Program;
use piola_measured::sides::{SidesMeasurements, SidesModel, SidesOptions, card_of_foam, compare_sides};
use piola_testkit::{Tol, assert_close};

/// μ = 0.4 `MPa`, α = 6, ν = 0.2: λₜ = λ^(−ν), P = (2 μ/α)(λ^α − λₜ^α)/λ; pressed all around p = (2 μ/α)(J^(−αβ) − J^(α/3))/J, β = ⅓.
fn foam() -> String {
    let mut rows = String::from("mode;stretch;stress [MPa];lateral strain [%];operator\n");
    for x in [0.4_f64, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1] {
        let side = x.powf(-0.2);
        let stress = 0.8 / 6.0 * (x.powi(6) - side.powi(6)) / x;
        let _ = writeln!(rows, "uniaxial;{x};{stress};{};me", 100.0 * (side - 1.0));
        let pressure = 0.8 / 6.0 * (x.powi(-2) - x * x) / x;
        let _ = writeln!(rows, "volumetric;{x};{pressure};;me");
    }
    rows
}

#[test]
fn a_foam_read_from_a_table_is_the_one_that_made_it_with_its_card() {
    let found = SidesMeasurements::parse("foam.csv", &foam()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((found.tests.len(), found.unit.as_deref()), (2, Some("MPa")));
    assert_eq!(found.notes, ["columns not used: `operator`"]);
    let model: SidesModel = "hyperfoam:1".parse().unwrap_or_else(|error| panic!("{error}"));
    let fibres: SidesModel = "holzapfel-gasser-ogden".parse().unwrap_or_else(|error| panic!("{error}"));
    let comparison = compare_sides(&found, &[model, fibres], &SidesOptions::default());
    let (law, fit) = comparison.best().unwrap_or_else(|| panic!("a fit"));
    let tol = Tol::stated(1e-6, "the root of the rounding of the sum of squares");
    assert_close("θ", &fit.values(), &[0.4, 6.0, 0.2], tol);
    // Fibres have no answer to volumetric tests: told, and not fitted.
    assert!(!comparison.is_complete() && comparison.table(&found).contains("cannot be fitted to volumetric tests"));
    let card = card_of_foam(Program::Abaqus, law, fit).unwrap_or_else(|error| panic!("{error}"));
    let numbers: Vec<f64> =
        card.lines().nth(2).unwrap_or_default().split(", ").filter_map(|x| x.parse().ok()).collect();
    assert!(card.contains("*HYPERFOAM, N=1\n"), "{card}");
    assert_close("μ, α, ν", &numbers, &[0.4, 6.0, 0.2], tol);
    assert!(card_of_foam(Program::FeBio, law, fit).is_err());
}

#[test]
fn mistakes_of_tables_with_sides_are_named_with_their_line() {
    for (text, expected) in [
        ("mode,stretch,stress\nuniaxal,0.5,-1\n", "foam.csv:2: the mode is `uniaxal`"),
        ("mode,stretch,stress\nuniaxial,x,-1\n", "foam.csv:2: stretch is `x`"),
        ("mode,stretch,stress\nuniaxial,-0.5,-1\n", "foam.csv:2: the stretch is -0.5"),
        ("mode,stretch,stress,lateral stretch\nuniaxial,0.5,-1,0\n", "foam.csv:2: the lateral stretch is 0"),
        ("angle,stretch,stress\n120,1.1,1\n", "foam.csv:2: a uniaxial specimen at the angle `120`"),
        ("mode,angle,stretch,stress\nplanar,90,1.1,1\n", "foam.csv:2: a planar specimen at the angle `90`"),
        ("stretch,stress\n1.1,1\n", "foam.csv:1: no column is a mode or an angle"),
        ("mode,stress\nuniaxial,1\n", "foam.csv:1: no column is a stretch or a strain"),
        ("mode,stretch,stress [m]\nuniaxial,1.1,1\n", "foam.csv:1: "),
        ("mode,stretch [s],stress\nuniaxial,1.1,1\n", "foam.csv:1: `s` is not a unit of a stretch or strain"),
    ] {
        let error = SidesMeasurements::parse("foam.csv", text).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains(expected), "{text}: {error}");
    }
}
