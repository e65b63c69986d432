//! Tables of viscometric measurements, good and bad, and what recovery and fits write.

use std::path::Path;

use piola_scene::SceneError;
use piola_scene::output::Folder;
use piola_scene::rheology::{FlowKind, Measured, Noise, RecoveryRequest, Request, Rise, compare, recover};

const PIPE: &str = "# radius: 2 mm\npressure_gradient [kPa/m],discharge [mm^3/s]\n";

fn sentences(text: &str, kind: FlowKind) -> Vec<String> {
    match Measured::parse("flow.csv", text, kind, &[]) {
        Ok(_) => Vec::new(),
        Err(error) => error.to_string().lines().map(str::to_owned).collect(),
    }
}

fn shipped(name: &str, kind: FlowKind) -> Measured {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rheology").join(name);
    Measured::load(&path, kind, &[]).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_mistake_of_a_flow_table_is_named_with_its_line() {
    let text = format!("{PIPE}10,125\n\n20,x\n# a comment\n30\n40,-1\n50,\n");
    let expected = [
        "flow.csv:5: discharge is x; valid: a positive number",
        "flow.csv:7: a row of 1 fields; valid: 2 fields",
        "flow.csv:8: discharge is -1; valid: a positive number",
        "flow.csv:9: discharge is missing; valid: a positive number",
    ];
    assert_eq!(sentences(&text, FlowKind::Pipe), expected);
}

#[test]
fn unsorted_and_repeated_rows_are_named_with_their_line() {
    let unsorted = sentences(&format!("{PIPE}10,125\n30,375\n20,250\n"), FlowKind::Pipe);
    assert!(unsorted[0].starts_with("flow.csv:5: ") && unsorted[0].contains("rows that rise"), "{unsorted:?}");
    let twice = sentences(&format!("{PIPE}10,125\n10,126\n"), FlowKind::Pipe);
    assert!(twice[0].starts_with("flow.csv:4: ") && twice[0].contains("once"), "{twice:?}");
    let falling = Measured::parse("flow.csv", &format!("{PIPE}1,1\n2,2\n3,9\n4,4\n5,5\n6,6\n"), FlowKind::Pipe, &[]);
    let falling = falling.and_then(|table| {
        let mut request = RecoveryRequest::default();
        request.noise = Noise::Exact;
        recover(&table, &request)
    });
    let text = falling.map_or_else(|error| error.to_string(), |_| String::new());
    assert!(text.starts_with("flow.csv:6: ") && text.contains("rises with the first"), "{text}");
}

#[test]
fn wrong_units_columns_and_geometries_are_named_with_their_line() {
    let unit = sentences(&format!("{}10,1\n", PIPE.replace("mm^3/s", "mm^2/s")), FlowKind::Pipe);
    assert_eq!(unit, ["flow.csv:2: `mm^2/s` is no unit of discharge; valid: a unit such as m^3/s"]);
    let unknown = sentences(&format!("{}10,1\n", PIPE.replace("kPa", "kPascal")), FlowKind::Pipe);
    assert!(unknown[0].starts_with("flow.csv:2: `kPascal` is not a unit"), "{unknown:?}");
    let column = sentences(&format!("{}10,1\n", PIPE.replace("discharge", "flow")), FlowKind::Pipe);
    assert!(column[0].starts_with("flow.csv:2: column 2 is `flow [mm^3/s]`"), "{column:?}");
    let radius = sentences(&format!("{}10,1\n", PIPE.replace("2 mm", "2 kg")), FlowKind::Pipe);
    assert_eq!(radius, ["flow.csv:1: radius is `2 kg`; valid: a positive length"]);
    let none = sentences("torque_per_length,speed_difference\n1,1\n", FlowKind::Couette);
    assert!(none.len() == 2 && none[0].contains("inner_radius is not given"), "{none:?}");
    let text = "# inner_radius: 2 cm\n# outer_radius: 1 cm\ntorque_per_length,speed_difference\n1,1\n";
    let radii = sentences(text, FlowKind::Couette);
    assert!(radii[0].ends_with("valid: inner_radius < outer_radius"), "{radii:?}");
    assert_eq!(sentences("", FlowKind::Curve)[0].split(';').next(), Some("flow.csv:1: the table is empty"));
}

#[test]
fn lengths_given_stand_before_those_of_the_file() -> Result<(), SceneError> {
    let text = format!("{PIPE}10,125\n20,250\n");
    let given = [("radius".to_owned(), "4 mm".to_owned())];
    let measured = Measured::parse("flow.csv", &text, FlowKind::Pipe, &given)?;
    assert!(format!("{:?}", measured.flow).contains("0.004"), "{:?}", measured.flow);
    let wrong = Measured::parse("flow.csv", &text, FlowKind::Pipe, &[("half_width".to_owned(), "4 mm".to_owned())]);
    assert!(wrong.is_err());
    Ok(())
}

/// τ = k (η_∞ + (η₀ − η_∞)(1 + (λ k)²)^(−0.3)) of the fluid behind the made tables.
fn made(rate: f64) -> f64 {
    let (zero, infinite, time) = (8.0, 0.01, 2.0);
    rate * (infinite + (zero - infinite) * (1.0 + (time * rate) * (time * rate)).powf(-0.3))
}

#[test]
fn bands_of_made_tables_hold_the_fluid_they_were_made_of() -> Result<(), SceneError> {
    for (name, kind) in [("pipe.csv", FlowKind::Pipe), ("couette.csv", FlowKind::Couette)] {
        let measured = shipped(name, kind);
        let mut request = RecoveryRequest::default();
        request.rise = Rise::Enforced;
        let recovery = recover(&measured, &request)?;
        assert_eq!(recovery.rows.len(), measured.rows.len(), "{name}");
        for point in &recovery.points {
            let [low, high] = point.band.expect("asked for");
            let (below, above) = (made(low.max(0.0)), made(high));
            assert!(below <= point.shear_stress && point.shear_stress <= above, "{name}: {point:?}");
            assert!(high - low < 0.5 * point.shear_rate, "{name}: {point:?}");
        }
    }
    Ok(())
}

#[test]
fn fluids_fitted_to_made_discharges_are_those_they_were_made_of() -> Result<(), Box<dyn std::error::Error>> {
    let measured = shipped("pipe.csv", FlowKind::Pipe);
    let request = Request::of(vec!["carreau-yasuda".parse()?, "power-law".parse()?, "newtonian".parse()?]);
    let comparison = compare(&measured, &request)?;
    let (best, fit) = comparison.best().expect("fits");
    assert_eq!(best.to_string(), "carreau-yasuda");
    assert!((fit.parameters[0].value / 8.0 - 1.0).abs() < 0.1, "{:?}", fit.parameters);
    assert!((fit.parameters[3].value / 0.4 - 1.0).abs() < 0.15, "{:?}", fit.parameters);
    Ok(())
}

#[test]
fn measured_flow_curves_are_fitted_by_every_fluid_or_refused_by_name() -> Result<(), SceneError> {
    let measured = shipped("emulsion-0.70.csv", FlowKind::Curve);
    let fluids = ["bingham", "casson", "herschel-bulkley"].map(str::parse);
    let comparison = compare(&measured, &Request::of(fluids.into_iter().collect::<Result<_, _>>()?))?;
    assert_eq!(comparison.best().map(|(fluid, _)| fluid.to_string()).as_deref(), Some("herschel-bulkley"));
    let folder = std::env::temp_dir().join(format!("piola-rheology-{}", std::process::id()));
    let written = comparison.write(&Folder::prepare(&folder)?, &measured);
    assert_eq!((written.files.len(), written.failures.len()), (4, 0));
    let _ = std::fs::remove_dir_all(folder);
    Ok(())
}
