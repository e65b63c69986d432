//! Tables and the figure.

use core::fmt::Write as _;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{BurgersCircuits, ScrewDislocations};
use crate::studies::panel::{Panel, largest, prefixed};
use piola_charts::{Area, Drawn, FINE, FONT, INK, colour, figure, format_short, pixels};

/// Cells of the lattice under the circuits, each way.
const CELLS: i32 = 6;

/// A file of the plan by its name.
pub(in crate::studies) fn file(
    found: &BurgersCircuits,
    asked: &ScrewDislocations,
    title: &str,
    name: &str,
) -> Option<String> {
    match name {
        "circuits.csv" => Some(circuits_table(found)),
        "development.csv" => Some(development_table(found)),
        "torsion.csv" => Some(torsion_table(found)),
        "burgers.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn circuits_table(found: &BurgersCircuits) -> String {
    let mut text = String::from("radius_m,b_1_m,b_2_m,b_3_m,error_of_b_3_m,closed_form_m\n");
    for circuit in &found.circuits {
        let [first, second, third] = circuit.burgers;
        let known = circuit.closed_form.map(|b| format!("{b:?}")).unwrap_or_default();
        let _ = writeln!(text, "{:?},{first:?},{second:?},{third:?},{:?},{known}", circuit.radius, circuit.error[2]);
    }
    text
}

fn development_table(found: &BurgersCircuits) -> String {
    let mut text = String::from("x_m,y_m,z_m,crystal_1_m,crystal_2_m,crystal_3_m\n");
    for ([x, y, z], [first, second, third]) in found.in_body.iter().zip(&found.in_crystal) {
        let _ = writeln!(text, "{x:?},{y:?},{z:?},{first:?},{second:?},{third:?}");
    }
    text
}

fn torsion_table(found: &BurgersCircuits) -> String {
    let mut text = String::from("distance_m,screw_density_per_m,edge_density_per_m,largest_torsion_per_m\n");
    for at in &found.torsion {
        let _ = writeln!(text, "{:?},{:?},{:?},{:?}", at.distance, at.screw, at.edge, at.torsion);
    }
    text
}

fn drawing(found: &BurgersCircuits, asked: &ScrewDislocations, title: &str) -> String {
    let reach = asked.reach();
    let (metre, length) = prefixed("m", reach);
    let (tall, height) = prefixed("m", largest(found.circuits.iter().map(|circuit| circuit.burgers[2])));
    let mut burgers =
        Panel::new("Burgers vectors of the circuits", format!("radius ({metre})"), format!("b₃ ({tall})"));
    let known = (0..=80).filter_map(|i| {
        let radius = reach * f64::from(i) / 80.0;
        Some((radius / length, asked.closed_form(radius)? / height))
    });
    burgers = burgers.curve("density times area", 0, known);
    for circuit in &found.circuits {
        burgers = burgers.mark("", 1, (circuit.radius / length, circuit.burgers[2] / height), true);
    }
    let sizes = found.torsion.iter().flat_map(|at| [at.screw, at.torsion]);
    let scale = largest(sizes);
    // Powers of a metre: the prefix is that of the length below.
    let (below, unit) = prefixed("m", if 0.0 < scale { scale.recip() } else { 1.0 });
    let torsion = Panel::new("along a radius", format!("distance from the axis ({metre})"), format!("1/{below}"))
        .with_zero()
        .curve("screw density", 2, found.torsion.iter().map(|at| (at.distance / length, at.screw * unit)))
        .dashed("largest torsion", 3, found.torsion.iter().map(|at| (at.distance / length, at.torsion * unit)));
    figure((1120, 800), title, &|area| {
        let (circuits, panels) = area.split_vertically(330 * FINE);
        draw_circuit(found, &circuits, (&tall, height))?;
        let parts = panels.split_evenly((1, 2));
        burgers.draw(&parts[0])?;
        torsion.draw(&parts[1])
    })
}

/// The largest circuit in the body, and as it runs in the crystal.
fn draw_circuit(found: &BurgersCircuits, area: &Area<'_>, (unit_name, unit): (&str, f64)) -> Drawn {
    let parts = area.split_evenly((1, 2));
    let start = found.in_body.first().copied().unwrap_or_default();
    let body: Vec<[f64; 3]> = found.in_body.iter().map(|x| core::array::from_fn(|k| x[k] - start[k])).collect();
    let gap = found.in_crystal.last().copied().unwrap_or_default();
    let name = format!("in the crystal it ends b = {} {unit_name} from its start", format_short(gap[2] / unit));
    let view = View::of(body.iter().chain(&found.in_crystal));
    view.draw(&parts[0], "a circuit in the body is closed", &body, &[])?;
    view.draw(&parts[1], &name, &found.in_crystal, &[[0.0; 3], gap])
}

/// An oblique view from above, one scale for both circuits.
struct View {
    low: [f64; 2],
    high: [f64; 2],
    /// The corners of the lattice below.
    base: [[f64; 2]; 2],
}

/// A place in the plane of the drawing.
fn seen([x, y, z]: [f64; 3]) -> (f64, f64) {
    (x + 0.35 * y, 0.42 * y + 0.9 * z)
}

impl View {
    fn of<'p>(points: impl Iterator<Item = &'p [f64; 3]> + Clone) -> Self {
        let bounds = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let [(left, right), (front, back)] = [0, 1].map(|k| bounds(&mut points.clone().map(|point| point[k])));
        let air = 0.12 * (right - left).max(back - front);
        let base = [[left - air, front - air], [right + air, back + air]];
        let corners = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]: [usize; 2]| seen([base[i][0], base[j][1], 0.0]));
        let places = points.map(|point| seen(*point)).chain(corners);
        let places: Vec<(f64, f64)> = places.collect();
        let [(left, right), (bottom, top)] =
            [bounds(&mut places.iter().map(|p| p.0)), bounds(&mut places.iter().map(|p| p.1))];
        Self { low: [left, bottom], high: [right, top], base }
    }

    fn draw(&self, area: &Area<'_>, title: &str, circuit: &[[f64; 3]], gap: &[[f64; 3]]) -> Drawn {
        let style = (FONT, pixels(17)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(title.to_string(), (pixels(30), pixels(12)), style))?;
        let (width, height) = area.dim_in_pixel();
        let (wide, tall) = (f64::from(width - 50 * FINE), f64::from(height - 60 * FINE));
        let grain = ((self.high[0] - self.low[0]) / wide).max((self.high[1] - self.low[1]) / tall).max(1e-300);
        let range = |k: usize, pixels: f64| {
            let middle = 0.5 * (self.low[k] + self.high[k]);
            middle - 0.5 * grain * pixels..middle + 0.5 * grain * pixels
        };
        let (_, plot) = area.split_vertically(28 * FINE);
        let mut chart =
            ChartBuilder::on(&plot).margin(pixels(10)).build_cartesian_2d(range(0, wide), range(1, tall))?;
        let [[left, front], [right, back]] = self.base;
        let thin = INK.mix(0.25).stroke_width(FINE);
        for index in 0..=CELLS {
            let share = f64::from(index) / f64::from(CELLS);
            let (x, y) = (left + share * (right - left), front + share * (back - front));
            chart.draw_series(LineSeries::new([seen([x, front, 0.0]), seen([x, back, 0.0])], thin))?;
            chart.draw_series(LineSeries::new([seen([left, y, 0.0]), seen([right, y, 0.0])], thin))?;
        }
        // What stands between the circuit and the plane below it.
        for point in circuit.iter().step_by(4).filter(|point| 0.0 < point[2].abs()) {
            let [x, y, _] = *point;
            chart.draw_series(LineSeries::new([seen([x, y, 0.0]), seen(*point)], thin))?;
        }
        chart.draw_series(LineSeries::new(circuit.iter().map(|x| seen(*x)), colour(0).stroke_width(3 * FINE)))?;
        chart.draw_series(LineSeries::new(gap.iter().map(|x| seen(*x)), colour(1).stroke_width(4 * FINE)))?;
        let ends = [circuit.first().map(|x| (*x, 0)), gap.last().map(|x| (*x, 1))];
        for (place, index) in ends.into_iter().flatten() {
            chart.draw_series([Circle::new(seen(place), pixels(6), colour(index).filled())])?;
        }
        Ok(())
    }
}
