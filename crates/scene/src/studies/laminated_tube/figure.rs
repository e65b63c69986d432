//! Tables and the figure.

use core::fmt::Write as _;

use super::{LayeredTube, TubeState, TubeStresses};
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::stresses::stress_table;
use piola_charts::figure;

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &TubeStresses, asked: &LayeredTube, title: &str, name: &str) -> Option<String> {
    match name {
        "pressure.csv" => Some(pressure_table(found)),
        "stress.csv" => {
            Some(stress_table(named(found).map(|(name, state)| (name.to_string(), state.stresses.as_slice()))))
        }
        "tube.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn named(found: &TubeStresses) -> impl Iterator<Item = (&'static str, &TubeState)> {
    let states = [
        ("without loads", &found.at_rest),
        ("under pressure", &found.loaded),
        ("homogeneous under pressure", &found.homogeneous),
    ];
    states.into_iter().filter_map(|(name, state)| Some((name, state.as_ref()?)))
}

fn pressure_table(found: &TubeStresses) -> String {
    let mut text = String::from("stretch,pressure_Pa,homogeneous_pressure_Pa\n");
    for ((stretch, pressure), (_, homogeneous)) in found.curve.iter().zip(&found.homogeneous_curve) {
        let _ = writeln!(text, "{stretch:?},{pressure:?},{homogeneous:?}");
    }
    text
}

fn drawing(found: &TubeStresses, asked: &LayeredTube, title: &str) -> String {
    let [_, outer] = asked.layers.radii();
    let (metre, length) = prefixed("m", outer);
    let axis = format!("R ({metre})");
    let rest = found.at_rest.iter().flat_map(|state| &state.stresses);
    let (pascal, unit) = prefixed("Pa", largest(rest.clone().flat_map(|at| at.stress)));
    let mut residual = Panel::new("residual stress", axis.as_str(), format!("T ({pascal})"));
    for (index, name) in ["T_rr", "T_θθ", "T_zz"].into_iter().enumerate() {
        residual =
            residual.curve(name, index + 2, rest.clone().map(|at| (at.reference / length, at.stress[index] / unit)));
    }
    let all = named(found).flat_map(|(_, state)| &state.stresses).map(|at| at.stress[1]);
    let (pascal, unit) = prefixed("Pa", largest(all));
    let mut hoop = Panel::new("hoop stress under pressure", axis.as_str(), format!("T_θθ ({pascal})"));
    for (index, (name, state)) in [("this tube", &found.loaded), ("homogeneous", &found.homogeneous)].iter().enumerate()
    {
        let points = state.iter().flat_map(|state| &state.stresses);
        let points = points.map(|at| (at.reference / length, at.stress[1] / unit));
        hoop = if index == 0 { hoop.curve(name, 0, points) } else { hoop.dashed(name, 11, points) };
    }
    let (pascal, unit) = prefixed("Pa", largest(found.curve.iter().chain(&found.homogeneous_curve).map(|p| p.1)));
    let scaled = |curve: &[(f64, f64)]| curve.iter().map(|(x, p)| (*x, p / unit)).collect::<Vec<_>>();
    let mut pressure = Panel::new("pressure inside", "r_i over that without loads", format!("p ({pascal})"))
        .curve("this tube", 0, scaled(&found.curve))
        .dashed("homogeneous", 11, scaled(&found.homogeneous_curve));
    let rest = found.at_rest.as_ref().map_or(1.0, |state| state.radii[0]);
    if let Some(state) = &found.loaded {
        pressure = pressure.mark("", 1, (state.radii[0] / rest, state.pressure / unit), true);
    }
    figure((1320, 470), title, &|area| {
        let parts = area.split_evenly((1, 3));
        for (panel, part) in [&residual, &hoop, &pressure].into_iter().zip(&parts) {
            panel.draw(part)?;
        }
        Ok(())
    })
}
