//! Tables and the figure.

use core::fmt::Write as _;

use super::{LayeredTube, TubeState, TubeStresses};
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::stresses::stress_table;
use piola_charts::figure;

impl TubeStresses {
    pub(in crate::studies) fn file(&self, asked: &LayeredTube, title: &str, name: &str) -> Option<String> {
        match name {
            "pressure.csv" => Some(self.pressure_table()),
            "stress.csv" => {
                Some(stress_table(self.named().map(|(name, state)| (name.to_string(), state.stresses.as_slice()))))
            }
            "tube.svg" => Some(self.figure(asked, title)),
            _ => None,
        }
    }

    fn named(&self) -> impl Iterator<Item = (&'static str, &TubeState)> {
        let states = [
            ("without loads", &self.at_rest),
            ("under pressure", &self.loaded),
            ("homogeneous under pressure", &self.homogeneous),
        ];
        states.into_iter().filter_map(|(name, state)| Some((name, state.as_ref()?)))
    }

    fn pressure_table(&self) -> String {
        let mut text = String::from("stretch,pressure_Pa,homogeneous_pressure_Pa\n");
        for ((stretch, pressure), (_, homogeneous)) in self.curve.iter().zip(&self.homogeneous_curve) {
            let _ = writeln!(text, "{stretch:?},{pressure:?},{homogeneous:?}");
        }
        text
    }

    fn figure(&self, asked: &LayeredTube, title: &str) -> String {
        let [_, outer] = asked.layers.radii();
        let (metre, length) = prefixed("m", outer);
        let axis = format!("R ({metre})");
        let rest = self.at_rest.iter().flat_map(|state| &state.stresses);
        let (pascal, unit) = prefixed("Pa", largest(rest.clone().flat_map(|at| at.stress)));
        let mut residual = Panel::new("residual stress", axis.as_str(), format!("T ({pascal})"));
        for (index, name) in ["T_rr", "T_θθ", "T_zz"].into_iter().enumerate() {
            residual = residual.curve(
                name,
                index + 2,
                rest.clone().map(|at| (at.reference / length, at.stress[index] / unit)),
            );
        }
        let all = self.named().flat_map(|(_, state)| &state.stresses).map(|at| at.stress[1]);
        let (pascal, unit) = prefixed("Pa", largest(all));
        let mut hoop = Panel::new("hoop stress under pressure", axis.as_str(), format!("T_θθ ({pascal})"));
        for (index, (name, state)) in
            [("this tube", &self.loaded), ("homogeneous", &self.homogeneous)].iter().enumerate()
        {
            let points = state.iter().flat_map(|state| &state.stresses);
            let points = points.map(|at| (at.reference / length, at.stress[1] / unit));
            hoop = if index == 0 { hoop.curve(name, 0, points) } else { hoop.dashed(name, 11, points) };
        }
        let (pascal, unit) = prefixed("Pa", largest(self.curve.iter().chain(&self.homogeneous_curve).map(|p| p.1)));
        let scaled = |curve: &[(f64, f64)]| curve.iter().map(|(x, p)| (*x, p / unit)).collect::<Vec<_>>();
        let mut pressure = Panel::new("pressure inside", "r_i over that without loads", format!("p ({pascal})"))
            .curve("this tube", 0, scaled(&self.curve))
            .dashed("homogeneous", 11, scaled(&self.homogeneous_curve));
        let rest = self.at_rest.as_ref().map_or(1.0, |state| state.radii[0]);
        if let Some(state) = &self.loaded {
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
}
