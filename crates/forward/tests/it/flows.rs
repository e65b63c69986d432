//! Flows solved for any fluid: drive and answer are each other's inverse, and closed forms come out.

use core::f64::consts::PI;

use piola_forward::{FlowRequest, SolvedFlow, fluid, solve};
use piola_testkit::{Tol, assert_close};

use crate::written;

fn solved(flow: &str, text: &str, sizes: &[(&str, &str)], given: (&str, &str)) -> SolvedFlow {
    let fluid = fluid(text).unwrap_or_else(|error| panic!("{error}"));
    solve(&FlowRequest::new(flow, fluid, sizes, given)).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(flow: &str, sizes: &[(&str, &str)], given: (&str, &str)) -> String {
    let fluid = fluid("newtonian:viscosity_coefficient=1").unwrap_or_else(|error| panic!("{error}"));
    solve(&FlowRequest::new(flow, fluid, sizes, given)).map_or_else(|error| error.to_string(), |_| String::new())
}

fn value(flow: &SolvedFlow, name: &str) -> f64 {
    flow.answer(name).unwrap_or_else(|| panic!("{name}")).value
}

const CLOSED: Tol = Tol::stated(1e-11, "the accuracy of solved flows");

#[test]
fn newtonian_flows_have_their_closed_forms() {
    let oil = "newtonian:viscosity_coefficient=2";
    let pipe = solved("pipe", oil, &[("radius", "1 cm")], ("pressure_gradient", "10 kPa/m"));
    assert_close("pipe", &[value(&pipe, "discharge")], &[PI * 1e4 * 1e-8 / 16.0], CLOSED);
    let channel = solved("channel", oil, &[("half_width", "1 cm")], ("pressure_gradient", "10 kPa/m"));
    assert_close("channel", &[value(&channel, "discharge_per_width")], &[2.0 * 1e4 * 1e-6 / 6.0], CLOSED);
    let cone = solved("cone", oil, &[("radius", "25 mm"), ("angle", "0.02 rad")], ("angular_velocity", "60 rpm"));
    let rate = 2.0 * PI / 0.02;
    let torque = 2.0 / 3.0 * PI * 0.025_f64.powi(3) * 2.0 * rate;
    assert_close("cone", &[value(&cone, "shear_rate"), value(&cone, "torque")], &[rate, torque], CLOSED);
    let plates = solved("plates", oil, &[("radius", "25 mm"), ("gap", "1 mm")], ("angular_velocity", "1 rad/s"));
    assert_close("plates", &[value(&plates, "torque")], &[0.5 * PI * 0.025_f64.powi(4) * 2.0 / 1e-3], CLOSED);
    let sizes = [("inner_radius", "1 cm"), ("outer_radius", "2 cm")];
    let couette = solved("couette", oil, &sizes, ("torque_per_length", "1 N"));
    assert_close("couette", &[value(&couette, "speed_difference")], &[0.75 / (8.0 * PI * 1e-4)], CLOSED);
    let sizes = [("density", "1000 kg/m^3"), ("inclination", "90 deg")];
    let film = solved("film", oil, &sizes, ("thickness", "1 mm"));
    assert_close("film", &[value(&film, "discharge_per_width")], &[9806.65 * 1e-9 / 6.0], CLOSED);
}

/// A flow, its sizes, and an answer with its value.
type Case<'c> = (&'c str, &'c [(&'c str, &'c str)], &'c str, &'c str);

#[test]
fn a_drive_found_from_an_answer_gives_that_answer() {
    let mud = "herschel-bulkley:yield_stress=5 Pa,consistency=2,exponent=0.5";
    let gap = [("inner_radius", "10 mm"), ("outer_radius", "15 mm")];
    let cases: [Case; 6] = [
        ("pipe", &[("radius", "5 mm")], "discharge", "20 mL/s"),
        ("channel", &[("half_width", "5 mm")], "discharge_per_width", "20 mm^2/s"),
        ("annulus", &gap, "discharge", "20 mL/s"),
        ("couette", &gap, "speed_difference", "60 rpm"),
        ("plates", &[("radius", "25 mm"), ("gap", "1 mm")], "torque", "1 mN m"),
        ("cone", &[("radius", "25 mm"), ("angle", "2 deg")], "torque", "1 mN m"),
    ];
    let si = [2e-5, 2e-5, 2e-5, 2.0 * PI, 1e-3, 1e-3];
    for ((flow, sizes, name, given), expected) in cases.into_iter().zip(si) {
        let found = solved(flow, mud, sizes, (name, given));
        assert_close(flow, &[value(&found, name)], &[expected], Tol::stated(1e-9, "the inverse of a solved flow"));
        assert!(found.answers[0].error.is_some_and(|error| error < 1e-6 * found.answers[0].value.abs()), "{flow}");
    }
}

#[test]
fn profiles_go_evenly_from_one_wall_to_the_other() {
    let oil = "newtonian:viscosity_coefficient=2";
    let turned = ("angular_velocity", "3 rad/s");
    let sizes = [("inner_radius", "1 cm"), ("outer_radius", "2 cm")];
    let couette = solved("couette", oil, &sizes, ("torque_per_length", "1 N"));
    let plates = solved("plates", oil, &[("radius", "25 mm"), ("gap", "1 mm")], turned);
    let cone = solved("cone", oil, &[("radius", "25 mm"), ("angle", "0.02 rad")], turned);
    // A cone has no gap on its axis, so its profile begins beside it.
    for (flow, low, high) in [(&couette, 0.01, 0.02), (&plates, 0.0, 0.025), (&cone, 0.025 / 200.0, 0.025)] {
        let positions: Vec<f64> = flow.profile.iter().map(|point| point.position).collect();
        let expected: Vec<f64> = (0..=200).map(|k| low + (high - low) * f64::from(k) / 200.0).collect();
        assert_close("positions", &positions, &expected, Tol::ulps(4.0));
    }
    for flow in [&plates, &cone] {
        let velocities: Vec<f64> = flow.profile.iter().map(|point| point.velocity).collect();
        let expected: Vec<f64> = flow.profile.iter().map(|point| 3.0 * point.position).collect();
        assert_close("velocities", &velocities, &expected, Tol::ulps(1.0));
    }
}

#[test]
fn a_flow_writes_its_profile_and_its_figure() {
    let mud = "bingham:yield_stress=3 Pa,plastic_viscosity=500 mPa s";
    let pipe = solved("pipe", mud, &[("radius", "1 cm")], ("pressure_gradient", "2 kPa/m"));
    assert_close("plug", &[value(&pipe, "plug_radius")], &[3e-3], Tol::ulps(8.0));
    let files = ["profile.csv", "profile.svg", "summary.json"];
    let [csv, svg, json] = written("forward", files, |folder| pipe.write(folder));
    let fields = |line: &str| -> [f64; 4] {
        let all: Vec<f64> = line.split(',').map(|field| field.parse().unwrap_or_else(|_| panic!("{line}"))).collect();
        all.try_into().unwrap_or_else(|_| panic!("{line}"))
    };
    let profile: Vec<[f64; 4]> = csv.lines().skip(1).map(fields).collect();
    assert_eq!(profile.len(), 201);
    // At the wall nothing moves and the stress is ½ c R; the plug moves as one.
    assert!(profile[200][1].abs() < 1e-14 && (profile[200][2].abs() - 10.0).abs() < 1e-12);
    assert_close(
        "plug",
        &[profile[0][1]],
        &[profile[59][1]],
        Tol::stated(1e-12, "two integrals over the same stresses"),
    );
    assert!(svg.contains("shear stress (Pa)") && json.contains("\"plug_radius\""), "{json}");
    assert!(pipe.table().contains("pressure gradient") && pipe.table().contains("plug radius"));
}

#[test]
fn the_best_fluid_of_a_fit_flows() -> Result<(), Box<dyn std::error::Error>> {
    use piola_measured::rheology::{FlowKind, Measured, Request, compare};
    let rows = (0..12).map(|i| 0.5_f64 * 1.7_f64.powi(i)).map(|k| [k, 2.0 + 0.5 * k]);
    let lines = rows.map(|[rate, stress]| format!("{rate:?},{stress:?}\n"));
    let text = format!("shear_rate,shear_stress\n{}", lines.collect::<String>());
    let measured = Measured::parse("mud.csv", &text, FlowKind::Curve, &[])?;
    let comparison = compare(&measured, &Request::of(vec!["bingham".parse()?, "newtonian".parse()?]))?;
    let path = std::env::temp_dir().join(format!("piola-forward-{}.json", std::process::id()));
    std::fs::write(&path, comparison.summary(&measured))?;
    let best = fluid(&path.display().to_string());
    let named = fluid(&format!("{}#newtonian", path.display()));
    let none = fluid(&format!("{}#casson", path.display()));
    let _ = std::fs::remove_file(&path);
    assert_eq!((best?.name(), named?.name()), ("Bingham", "Newtonian"));
    assert!(none.is_err_and(|error| error.to_string().contains("it has bingham, newtonian")));
    Ok(())
}

#[test]
fn what_does_not_go_together_is_refused_by_name() {
    let radius = [("radius", "1 cm")];
    assert_eq!(
        refused("pipe", &[], ("discharge", "1 mL/s")),
        "radius is not given; valid: --radius with a number and its unit"
    );
    let unit = refused("pipe", &radius, ("discharge", "1 mL"));
    assert_eq!(unit, "`discharge = 1 mL` is not accepted; valid: pressure_gradient=10 kPa/m or discharge=3 mL/s");
    assert!(refused("pipe", &radius, ("torque", "1 N m")).starts_with("`torque = 1 N m` is not accepted"));
    assert!(refused("pipe", &[("radius", "1")], ("discharge", "1 mL/s")).starts_with("`radius = 1` is not accepted"));
    assert!(
        refused("pipe", &[("radius", "1 cm"), ("gap", "1 mm")], ("discharge", "1 mL/s"))
            .contains("only the sizes of this flow")
    );
    assert!(
        refused("hose", &radius, ("discharge", "1 mL/s")).starts_with("`hose` is not accepted; valid: pipe, channel")
    );
    for wrong in [
        "water",
        "bingham:yield_stress=3",
        "bingham:yield_stress=-3,plastic_viscosity=1",
        "bingham:yield_stress",
        "newtonian:viscosity_coefficient=1,viscosity_coefficient=2",
    ] {
        assert!(fluid(wrong).is_err(), "{wrong}");
    }
}
