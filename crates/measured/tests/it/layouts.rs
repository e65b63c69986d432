//! Tables as instruments and spreadsheets write them: ten measured ones, and what is refused of others.

use std::path::Path;

use piola_measured::MeasuredError;
use piola_measured::fitting::Measurements;
use piola_measured::rheology::{FlowKind, Measured, Reading, RecoveryRequest, Request, Sweep, compare, recover};
use piola_testkit::{Tol, assert_close};

fn path(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name)
}

fn flow(name: &str, kind: FlowKind, only: &[(&str, &str)]) -> Measured {
    let mut reading = Reading::default();
    reading.only = only.iter().map(|(column, value)| ((*column).to_owned(), (*value).to_owned())).collect();
    Measured::load_as(&path(&format!("layouts/{name}")), kind, &reading).unwrap_or_else(|error| panic!("{error}"))
}

fn parsed(text: &str, kind: FlowKind) -> Measured {
    Measured::parse("flow.csv", text, kind, &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str, kind: FlowKind) -> String {
    Measured::parse("flow.csv", text, kind, &[]).map_or_else(|error| error.to_string(), |_| String::new())
}

fn rubber(text: &str) -> Measurements {
    Measurements::parse("rubber.csv", text).unwrap_or_else(|error| panic!("{error}"))
}

fn rubber_refused(text: &str) -> String {
    Measurements::parse("rubber.csv", text).map_or_else(|error| error.to_string(), |_| String::new())
}

/// Rows of one table beside those of another, each within the rounding of the tables' digits.
fn same_rows(name: &str, found: &[[f64; 2]], expected: &[[f64; 2]], tolerance: Tol) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for (found, expected) in found.iter().zip(expected) {
        for k in [0, 1] {
            assert_close(name, &[found[k]], &[expected[k]], tolerance);
        }
    }
}

const DIGITS: Tol = Tol::stated(1e-11, "converted numbers have twelve digits");

#[test]
fn rheometer_files_in_seven_layouts_are_read_without_editing() -> Result<(), MeasuredError> {
    let curve = |name: &str| Measured::load(&path(&format!("rheology/{name}")), FlowKind::Curve, &[]);
    // The shipped table of 4 % has no repeated rate; the instrument's has one.
    let export = flow("rheometer-export.csv", FlowKind::Curve, &[]);
    let (merged, shipped) = (export.merged().into_owned(), curve("ethylcellulose-4.csv")?);
    assert_eq!((export.rows().len(), merged.rows().len()), (shipped.rows().len() + 1, shipped.rows().len()));
    let columns = "columns not used: `Point`, `Viscosity`, `Speed`, `Torque`";
    assert!(export.notes.iter().any(|note| note == columns), "{:?}", export.notes);
    same_rows("hydrogel", flow("viscosities.txt", FlowKind::Curve, &[]).rows(), curve("hydrogel.csv")?.rows(), DIGITS);
    let eight = flow("nine-concentrations.csv", FlowKind::Curve, &[("conc", "8")]);
    same_rows("8 %", eight.rows(), curve("ethylcellulose-8.csv")?.rows(), Tol::ulps(1.0));
    same_rows(
        "74 %",
        flow("falling-rates.csv", FlowKind::Curve, &[]).rows(),
        curve("emulsion-0.74.csv")?.rows(),
        Tol::ulps(1.0),
    );
    same_rows(
        "70 %",
        flow("utf16.txt", FlowKind::Curve, &[]).rows(),
        curve("emulsion-0.70.csv")?.rows(),
        Tol::ulps(1.0),
    );
    let torques = Measured::load(&path("rheology/ethylcellulose-6-torque.csv"), FlowKind::Cone, &[])?;
    let cone = flow("cone-torques.csv", FlowKind::Cone, &[]);
    assert_eq!(cone.flow, torques.flow);
    same_rows("torques", cone.rows(), torques.rows(), Tol::ulps(4.0));
    let stresses = Tol::stated(0.02, "stress and viscosity have three digits each in the file");
    same_rows(
        "cP",
        flow("centipoise.csv", FlowKind::Curve, &[]).rows(),
        curve("ethylcellulose-8.csv")?.rows(),
        stresses,
    );
    Ok(())
}

#[test]
fn stresses_of_rubber_in_three_layouts_are_read_without_editing() -> Result<(), MeasuredError> {
    let layout = |name: &str| Measurements::load(&path(&format!("layouts/{name}")));
    let treloar = Measurements::load(&path("rubber/treloar-1944.csv"))?;
    let percent = layout("percent-strain.csv")?;
    assert_eq!((percent.unit.as_deref(), percent.data.len()), (Some("N/mm²"), treloar.data.len()));
    assert!(percent.notes.iter().any(|note| note.contains("stretch = 1 + strain")), "{:?}", percent.notes);
    for (found, expected) in percent.data.tests().iter().zip(treloar.data.tests()) {
        assert_eq!(
            found.name(),
            format!(
                "{} {}-1",
                expected.name(),
                if expected.name() == "planar" {
                    "PS"
                } else if expected.name() == "uniaxial" {
                    "UT"
                } else {
                    "ET"
                }
            )
        );
        let of = |test: &piola_measured::fitting::Test| {
            test.abscissas().zip(test.stresses()).map(|(x, y)| [x, y]).collect::<Vec<_>>()
        };
        same_rows(found.name(), &of(found), &of(expected), DIGITS);
    }
    // 26 sheets with two stresses each.
    let sheets = layout("unequal-stretches.csv")?;
    assert_eq!((sheets.data.tests()[0].name(), sheets.data.len(), sheets.unit), ("biaxial", 52, None));
    let kawabata = Measurements::load(&path("rubber/kawabata-1981.csv"))?;
    let truth = layout("true-stress.csv")?;
    assert_eq!((truth.data.tests()[0].name(), truth.unit.as_deref()), ("equibiaxial", Some("MPa")));
    let nominal: Vec<f64> =
        truth.data.tests()[0].abscissas().zip(truth.data.tests()[0].stresses()).map(|(x, t)| t / x).collect();
    let expected: Vec<f64> = kawabata.data.tests()[0].stresses().collect();
    assert_close("true stresses", &nominal, &expected, DIGITS);
    Ok(())
}

#[test]
fn usual_spellings_of_units_are_those_units() {
    // 2 in each unit, in pascals, pascal seconds, newton metres and 1/s.
    let stresses = [
        ("mPa", 2e-3),
        ("dyn/cm2", 0.2),
        ("dynes/cm^2", 0.2),
        ("psi", 2.0 * 6_894.757_293_168_361),
        ("N/m²", 2.0),
        ("N/mm2", 2e6),
        ("lbf/100 ft²", 2.0 * 0.478_802_589_803_358_4),
        ("lb/100ft2", 2.0 * 0.478_802_589_803_358_4),
        ("kgf/cm²", 196_133.0),
    ];
    for (unit, pascal) in stresses {
        let read = parsed(&format!("shear rate (s-1);shear stress ({unit})\n1;2\n"), FlowKind::Curve);
        assert_close(unit, &[read.rows()[0][1]], &[pascal], Tol::ulps(4.0));
    }
    for (unit, value) in
        [("cP", 2e-3), ("mPa.s", 2e-3), ("mPas", 2e-3), ("mPa-s", 2e-3), ("P", 0.2), ("Pa·s", 2.0), ("dyn s/cm^2", 0.2)]
    {
        let read = parsed(&format!("shear rate [s^-1],viscosity [{unit}]\n1,2\n"), FlowKind::Curve);
        assert_close(unit, &[read.rows()[0][1]], &[value], Tol::ulps(4.0));
    }
    let head = "# radius: 25 mm\n# angle: 1°\n";
    for (unit, value) in
        [("mN m", 2e-3), ("mNm", 2e-3), ("µN m", 2e-6), ("uNm", 2e-6), ("µN·m", 2e-6), ("dyn cm", 2e-7), ("N.m", 2.0)]
    {
        let read = parsed(&format!("{head}speed [1/min],torque [{unit}]\n60,2\n"), FlowKind::Cone);
        assert_close(unit, &read.rows()[0], &[core::f64::consts::TAU, value], Tol::ulps(4.0));
    }
    for (unit, value) in [
        ("mL/s", 2e-6),
        ("ml/min", 2e-6 / 60.0),
        ("L/min", 2e-3 / 60.0),
        ("µL/s", 2e-9),
        ("cc/s", 2e-6),
        ("cm3/s", 2e-6),
    ] {
        let read =
            parsed(&format!("# radius: 1 mm\npressure gradient [bar/m],flow rate [{unit}]\n1,2\n"), FlowKind::Pipe);
        assert_close(unit, &read.rows()[0], &[1e5, value], Tol::ulps(4.0));
    }
}

#[test]
fn unknown_units_are_refused_with_valid_ones_and_no_other_magnitude_is_suggested() {
    for wrong in ["hPa", "mpa", "furlong"] {
        let text = refused(&format!("shear_rate [1/s],shear_stress [{wrong}]\n1,2\n"), FlowKind::Curve);
        assert!(text.starts_with(&format!("flow.csv:1: `{wrong}`")) && text.contains("Pa, kPa, MPa"), "{text}");
        assert!(!text.contains("did you mean"), "{text}");
    }
    let text = rubber_refused("mode,stretch,stress_MPa,note\nuniaxial,1.5,0.4,ok\n# unit: furlong\n");
    assert!(text.starts_with("rubber.csv:1: the header says MPa and a comment furlong"), "{text}");
    let text = rubber_refused("# unit: furlong\nmode,stretch,stress\nuniaxial,1.5,0.4\n");
    assert!(text.starts_with("rubber.csv:1: `furlong` is not a unit; valid: one of "), "{text}");
}

#[test]
fn a_size_that_is_given_twice_or_without_its_unit_is_refused_with_its_line() {
    let twice = refused("# radius: 1 mm\n# Radius = 2 mm\npressure_gradient,discharge\n1,2\n", FlowKind::Pipe);
    assert_eq!(twice, "flow.csv:2: radius is given a second time, after line 1; valid: each size once");
    let diameter = refused("# radius: 1 mm\n# diameter: 2 mm\npressure_gradient,discharge\n1,2\n", FlowKind::Pipe);
    assert!(diameter.starts_with("flow.csv:2: diameter is given a second time"), "{diameter}");
    let bare = refused(
        "# Inner radius = 13\n# outer_radius: 14 mm\ntorque_per_length,speed_difference\n1,2\n",
        FlowKind::Couette,
    );
    assert_eq!(bare, "flow.csv:1: inner_radius is `13`; valid: its unit with it, as `13 mm`");
    let units = rubber_refused("# unit: MPa\n# unit: kPa\nmode,stretch,stress\nuniaxial,1.5,0.4\n");
    assert_eq!(units, "rubber.csv:2: the unit is given a second time, after line 1; valid: one unit");
    let given = [("radius".to_owned(), "2".to_owned())];
    let given = Measured::parse("flow.csv", "pressure_gradient,discharge\n1,2\n", FlowKind::Pipe, &given);
    assert_eq!(
        given.unwrap_err().to_string(),
        "`--radius 2` is not accepted; valid: a length from 1 nm to 1 km, or a positive angle, with its unit, as 2mm or 2deg"
    );
}

#[test]
fn rising_and_falling_sweeps_are_kept_apart_and_their_difference_is_told() -> Result<(), MeasuredError> {
    // τ = 10 √k on the way up, a tenth less on the way down.
    let rates = [1.0, 4.0, 9.0, 16.0, 25.0];
    let up = rates.iter().map(|k: &f64| format!("{k},{}\n", 10.0 * k.sqrt()));
    let down = rates.iter().rev().map(|k: &f64| format!("{k},{}\n", 9.0 * k.sqrt()));
    let text = format!("shear_rate [1/s],shear_stress [Pa]\n{}{}", up.collect::<String>(), down.collect::<String>());
    let of = |sweep: Sweep| {
        let mut reading = Reading::default();
        reading.sweep = sweep;
        Measured::parse_as("loop.csv", &text, FlowKind::Curve, &reading)
    };
    let rising = of(Sweep::Rising)?;
    let hysteresis = rising.hysteresis.expect("two sweeps");
    assert_close("hysteresis", &[hysteresis.mean, hysteresis.farthest], &[0.9, 0.9], Tol::ulps(16.0));
    assert_eq!(hysteresis.rows, [5, 5]);
    let consistency = |measured: &Measured| -> Result<f64, MeasuredError> {
        let comparison = compare(measured, &Request::of(vec!["power-law".parse()?]))?;
        Ok(comparison.fits().next().map_or(f64::NAN, |(_, fit)| fit.parameters[0].value))
    };
    let tolerance = Tol::stated(1e-8, "the search ends where residuals are quadratic");
    assert_close("up", &[consistency(&rising)?], &[10.0], tolerance);
    assert_close("down", &[consistency(&of(Sweep::Falling)?)?], &[9.0], tolerance);
    let all = of(Sweep::All)?;
    assert_eq!((all.rows().len(), all.merged().rows().len()), (10, 5));
    assert_close("both", &[consistency(&all)?], &[90.0_f64.sqrt()], tolerance);
    let told = rising.notes.iter().find(|note| note.contains("falling beside rising: -10.0 % on average"));
    assert!(told.is_some(), "{:?}", rising.notes);
    // A single pair of swapped rows is no sweep.
    let swapped = parsed("shear_rate,shear_stress\n1,1\n3,3\n2,2\n4,4\n5,5\n", FlowKind::Curve);
    assert!(swapped.hysteresis.is_none() && swapped.rows().len() == 5);
    Ok(())
}

#[test]
fn repeated_rows_are_data_of_fits_and_means_of_recoveries() -> Result<(), MeasuredError> {
    let rows = (0..8).flat_map(|i| {
        let k = 2.0_f64.powi(i);
        [1.01, 1.0 / 1.01].map(|error| format!("{k},{:?}\n", 3.0 * k * error))
    });
    let head = "# radius: 20 mm\n# angle: 2 deg\nangular_velocity [deg/s],torque [uN m]\n";
    let measured = parsed(&format!("{head}{}", rows.collect::<String>()), FlowKind::Cone);
    let comparison = compare(&measured, &Request::of(vec!["newtonian".parse()?]))?;
    let (_, fit) = comparison.fits().next().expect("sixteen rows");
    assert_eq!(fit.residuals.len(), 16);
    let recovery = recover(&measured, &RecoveryRequest::default())?;
    assert_eq!(recovery.curves[0].rows.len(), 8);
    let text = recovery.table(core::slice::from_ref(&measured));
    assert!(text.contains("16 rows are means of repeated measurements at 8 drives"), "{text}");
    Ok(())
}

#[test]
fn dial_readings_of_an_oilfield_viscometer_give_the_viscosity_of_its_calibration_oil() -> Result<(), MeasuredError> {
    // With R1, B1 and F1 the reading at 300 rpm is the viscosity in cP: 5.1067 dyn/cm² for a degree over 510.7 1/s.
    let text = "# bob: B1\nspeed (rpm),dial reading\n600,100\n300,50\n200,33.333333\n100,16.666667\n6,1\n3,0.5\n";
    let measured = parsed(text, FlowKind::Couette);
    let comparison = compare(&measured, &Request::of(vec!["newtonian".parse()?]))?;
    let viscosity = comparison.fits().next().expect("six rows").1.parameters[0].value;
    assert_close("cP", &[1e3 * viscosity], &[50.0], Tol::stated(1e-3, "the maker rounds the constants of the bob"));
    // The narrow bob with the stiff spring: the same oil reads less.
    let narrow = parsed(&text.replace("# bob: B1", "# bob: B2\n# spring: F2"), FlowKind::Couette);
    assert!(narrow.rows()[0][0] > measured.rows()[0][0]);
    let none = refused(&text.replace("# bob: B1\n", ""), FlowKind::Couette);
    assert!(
        none.starts_with("flow.csv:1: the bob of the dial readings is not given; valid: a comment `# bob: B1`"),
        "{none}"
    );
    let wrong = refused(&text.replace("B1", "B9"), FlowKind::Couette);
    assert_eq!(wrong, "flow.csv:1: bob is `B9`; valid: B1, B2 or B3");
    Ok(())
}

#[test]
fn torques_with_a_height_and_pressures_with_a_length_are_drives() {
    let head = "# inner_radius: 13 mm\n# outer_radius: 14 mm\n# height: 40 mm\n";
    let measured = parsed(&format!("{head}speed [rpm],torque [mN m]\n60,2\n"), FlowKind::Couette);
    assert_close("torque", &measured.rows()[0], &[0.05, core::f64::consts::TAU], Tol::ulps(4.0));
    let none = refused("# inner_radius: 13 mm\n# outer_radius: 14 mm\nspeed,torque\n1,2\n", FlowKind::Couette);
    assert!(none.starts_with("flow.csv:3: the height of the inner cylinder is not given"), "{none}");
    let text = "# radius: 1 mm\n# length: 2 m\npressure drop [bar],flow rate [mL/s]\n4,2\n";
    assert_close("pressure", &parsed(text, FlowKind::Pipe).rows()[0], &[2e5, 2e-6], Tol::ulps(4.0));
}

#[test]
fn numbers_that_cannot_be_told_are_refused_with_their_line() {
    let thousands = refused("shear_rate;shear_stress\n1;1.234,5\n", FlowKind::Curve);
    assert_eq!(thousands, "flow.csv:2: `1.234,5` has separators of thousands; valid: `1234,5`");
    let mixed = refused("shear_rate;shear_stress\n1,5;2\n2.5;3\n", FlowKind::Curve);
    assert!(
        mixed.starts_with("flow.csv:3: `2.5` has a point, other numbers of the table have decimal commas"),
        "{mixed}"
    );
    let commas = refused("shear_rate,shear_stress\n0,1,3,4\n", FlowKind::Curve);
    assert!(commas.contains("a row of 4 fields; valid: 2 fields; where decimals have commas"), "{commas}");
    let blanks = refused("shear_rate shear_stress\n1 2\n", FlowKind::Curve);
    assert!(blanks.contains("fields are separated by commas, semicolons or tabs"), "{blanks}");
    assert!(refused("shear_rate,shear_stress\n1,2.4D0\n", FlowKind::Curve).contains(":2: shear_stress is 2.4D0"));
    assert_eq!(parsed("sep=;\nshear_rate;shear_stress\n1;2\n", FlowKind::Curve).rows(), [[1.0, 2.0]]);
}

#[test]
fn strains_stretches_and_specimens_are_read_as_they_are_named() {
    let percent = rubber("mode;strain [%];stress [kPa]\nUT;50;400\nUT;100;600\n");
    assert_close("stretches", &percent.data.tests()[0].abscissas().collect::<Vec<_>>(), &[1.5, 2.0], Tol::ulps(1.0));
    assert_eq!(percent.unit.as_deref(), Some("kPa"));
    let plain = rubber_refused("mode,strain,stress\nUT,50,400\nUT,100,600\n");
    assert!(plain.starts_with("rubber.csv:1: `strain` reaches 100 and has no unit; valid: `strain [%]`"), "{plain}");
    let two = rubber("mode,stretch,stress\nUT_T,1.5,0.4\nUT_C,0.8,-0.3\n");
    assert_eq!(two.data.tests().iter().map(piola_measured::fitting::Test::name).collect::<Vec<_>>(), ["UT_T", "UT_C"]);
    let three =
        rubber("Stress [MPa],specimen,stretch,mode,weight\n0.4,a,1.5,planar,2\n0.5,b,1.5,planar,0\n0.6,a,2,planar,2\n");
    assert_eq!(
        (three.data.tests()[0].name(), three.data.tests()[0].weight().to_bits()),
        ("planar a", 2.0_f64.to_bits())
    );
    assert_eq!((three.held_out[0].name(), three.held_out[0].len()), ("planar b", 1));
    let weights = rubber_refused("mode,stretch,stress,weight\nUT,1.5,0.4,1\nUT,2,0.5,2\n");
    assert!(weights.starts_with("rubber.csv:3: the weight of `uniaxial` is 2, and 1 in an earlier row"), "{weights}");
    let shear = rubber("mode,shear strain [%],stress\nsimple shear,50,0.4\nsimple shear,0,0\n");
    assert_close("shears", &shear.data.tests()[0].abscissas().collect::<Vec<_>>(), &[0.5, 0.0], Tol::ulps(1.0));
    let kgf = rubber("mode,stretch,P_kgf_cm2,P_MPa\nUT,1.5,4.08,0.4\n");
    assert_eq!((kgf.unit.as_deref(), kgf.data.tests()[0].largest_stress().to_bits()), (Some("MPa"), 0.4_f64.to_bits()));
    assert_eq!(rubber("mode,stretch,stress [MPa]\nUT,1.5,0.4\n").unit.as_deref(), Some("MPa"));
}

#[test]
fn doubtful_stretches_are_told() {
    let note = |text: &str| rubber(text).notes.join("; ");
    let strain = note("mode,stretch,stress\nUT,0.1,0.4\nUT,0.2,0.6\n");
    assert!(strain.contains("are these strains? Call the column `strain`"), "{strain}");
    let percent = note("mode,stretch,stress\nUT,110,0.4\nUT,125,0.6\n");
    assert!(percent.contains("is this percent? Call the column `stretch [%]`"), "{percent}");
    let zero = rubber_refused("mode,stretch,stress\nUT,0,0\nUT,0.2,0.6\n");
    assert!(zero.ends_with("valid: 0 < stretch; strains are in a column `strain`"), "{zero}");
    assert!(note("mode,stretch,stress\nbiaxial,1.1,0.4\n").contains("`biaxial` is read as equibiaxial"));
}
