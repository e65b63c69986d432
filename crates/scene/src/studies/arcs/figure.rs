//! Tables and the figure.

use core::fmt::Write as _;

use plotters::prelude::*;

use super::Arcs;
use crate::output::figures::{FINE, INK, colour, figure, legend};
use crate::studies::chart::{Canvas, Window};

impl Arcs {
    pub(in crate::studies) fn file(&self, title: &str, name: &str) -> Option<String> {
        match name {
            "sheets.csv" => Some(self.sheets_table()),
            "arcs.csv" => Some(self.arcs_table()),
            "arcs.svg" => Some(self.figure(title)),
            _ => None,
        }
    }

    fn sheets_table(&self) -> String {
        let mut text = String::from(
            "arc,distance_J_s,closed_form_J_s,px0_kg_m_per_s,py0_kg_m_per_s,pz0_kg_m_per_s,px1_kg_m_per_s,py1_kg_m_per_s,\
             pz1_kg_m_per_s,initial_energy_J,final_energy_J,revolutions,direct,conjugate_points,index_in_the_plane,\
             L_kg_m2_per_s,G_kg_m2_per_s,H_kg_m2_per_s,radial_action_kg_m2_per_s,miss_m,distance_from_conjugate\n",
        );
        let shown = |x: Option<f64>| x.map(|x| format!("{x:?}")).unwrap_or_default();
        for (number, arc) in self.arcs.iter().enumerate() {
            let _ = write!(text, "{number},{:?},{}", arc.distance, shown(arc.closed_form));
            for x in arc.initial_momentum.iter().chain(&arc.final_momentum) {
                let _ = write!(text, ",{x:?}");
            }
            let _ = write!(
                text,
                ",{:?},{:?},{},{},{},{}",
                arc.initial_energy,
                arc.final_energy,
                arc.revolutions,
                arc.direct,
                arc.conjugate.len(),
                arc.index_in_the_plane
            );
            for k in 0..3 {
                let _ = write!(text, ",{}", shown(arc.delaunay.map(|actions| actions[k])));
            }
            let _ = writeln!(text, ",{},{:?},{:?}", shown(arc.radial_action), arc.miss, arc.distance_from_conjugate);
        }
        text
    }

    fn arcs_table(&self) -> String {
        let mut text = String::from("arc,along_m,across_m\n");
        for (number, arc) in self.arcs.iter().enumerate() {
            for [x, y] in &arc.points {
                let _ = writeln!(text, "{number},{x:?},{y:?}");
            }
        }
        text
    }

    fn figure(&self, title: &str) -> String {
        let points = self.arcs.iter().flat_map(|arc| &arc.points).chain(&self.ends).copied();
        let window = Window::around(points.chain([[0.0; 2]]));
        let names: Vec<String> = self
            .arcs
            .iter()
            .map(|arc| {
                let turns = match arc.revolutions {
                    0 => String::new(),
                    1 => ", 1 turn".to_string(),
                    turns => format!(", {turns} turns"),
                };
                let sense = if arc.direct { "direct" } else { "retrograde" };
                format!("{sense}{turns}, index {} in the plane", arc.index_in_the_plane)
            })
            .collect();
        let (wide, tall) = window.size(760);
        figure((wide + 340, tall), title, |area| {
            let (width, _) = area.dim_in_pixel();
            let (plot, beside) = area.split_horizontally(width - 330 * FINE);
            let mut canvas =
                Canvas::metres(&plot, window, ("along the first place", "across it, in the plane of the arcs"))?;
            for (index, arc) in self.arcs.iter().enumerate() {
                canvas.curve(&arc.points, colour(index).stroke_width(2 * FINE))?;
            }
            for (index, arc) in self.arcs.iter().enumerate() {
                for (_, place) in &arc.conjugate {
                    canvas.mark(*place, 3, colour(index))?;
                }
            }
            canvas.mark([0.0; 2], 7, RGBColor(240, 180, 30))?;
            for end in self.ends {
                canvas.mark(end, 5, INK)?;
            }
            let entries: Vec<(&str, RGBColor)> =
                names.iter().enumerate().map(|(index, name)| (name.as_str(), colour(index))).collect();
            legend(&beside, &entries)
        })
    }
}
