//! Tables and the figure.

use core::fmt::Write as _;

use piola_solutions::loads::BentBlock;
use plotters::prelude::*;

use super::{BendingCurve, BentBlockStudy};
use crate::studies::StressAt;
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::stresses::stress_table;
use piola_charts::{Area, Drawn, FINE, INK, figure, format_short};
use piola_charts::{Canvas, Window, between, colour_bar};

/// Steps of colour, from pressed over white to pulled.
const STEPS: u32 = 17;
const PRESSED: RGBColor = RGBColor(33, 102, 172);
const PULLED: RGBColor = RGBColor(178, 24, 43);
/// Points of an arc.
const ARC: u32 = 40;

/// A file of the plan by its name.
pub(in crate::studies) fn file(
    found: &BendingCurve,
    asked: &BentBlockStudy,
    title: &str,
    name: &str,
) -> Option<String> {
    match name {
        "bending.csv" => Some(table(found, asked)),
        "stress.csv" => {
            let names = found.shown.iter().map(|angle| format!("angle {angle:.6} rad"));
            Some(stress_table(names.zip(found.stresses.iter().map(Vec::as_slice))))
        }
        "bending.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn table(found: &BendingCurve, asked: &BentBlockStudy) -> String {
    let mut text =
        String::from("angle_rad,moment_N_m,axial_force_N,inner_radius_m,outer_radius_m,small_strain_moment_N_m\n");
    for (angle, state) in found.angles.iter().zip(&found.states) {
        let [inner, outer] = state.radii;
        let small = asked.small_strain_moment(*angle).map(|moment| format!("{moment:?}")).unwrap_or_default();
        let _ = writeln!(text, "{angle:?},{:?},{:?},{inner:?},{outer:?},{small}", state.moment, state.axial_force);
    }
    text
}

fn drawing(found: &BendingCurve, asked: &BentBlockStudy, title: &str) -> String {
    let (unit_name, unit) = prefixed("N m", largest(found.states.iter().map(|state| state.moment)));
    let degrees = |angle: &f64| angle.to_degrees();
    let curve = found.angles.iter().zip(&found.states);
    let mut moment = Panel::new("moment on the ends", "angle α (deg)", format!("M ({unit_name})")).curve(
        "this block",
        0,
        core::iter::once((0.0, 0.0)).chain(curve.map(|(angle, state)| (degrees(angle), state.moment / unit))),
    );
    if asked.small_strain_moment(0.0).is_some() {
        let small = |angle: &f64| asked.small_strain_moment(*angle).map(|m| (degrees(angle), m / unit));
        // As far as it does not flatten the curve.
        let highest = 1.3 * largest(found.states.iter().map(|state| state.moment)) / unit;
        let line = found.angles.iter().filter_map(small).take_while(|(_, m)| *m < highest);
        moment = moment.dashed("small strains", 11, line);
    }
    for (angle, state) in found.shown.iter().zip(&found.shown_states) {
        moment = moment.mark("", 1, (degrees(angle), state.moment / unit), true);
    }
    let (metre, length) = prefixed("m", asked.block.thickness());
    let first = found.stresses.first().map_or(&[][..], Vec::as_slice);
    let (pascal, unit) = prefixed("Pa", largest(first.iter().flat_map(|at| at.stress)));
    let mut through = Panel::new(
        &found.shown.first().map_or_else(String::new, |angle| {
            format!("stress through the thickness at {} deg", format_short(degrees(angle)))
        }),
        format!("X from the inner face ({metre})"),
        format!("T ({pascal})"),
    );
    for (index, name) in ["T_rr", "T_θθ", "T_zz"].into_iter().enumerate() {
        let points = first.iter().map(|at| (at.reference / length, at.stress[index] / unit));
        through = through.curve(name, index + 1, points);
    }
    figure((1120, 900), title, &|area| {
        let rows = area.split_evenly((2, 1));
        let parts = rows[0].split_evenly((1, 2));
        moment.draw(&parts[0])?;
        through.draw(&parts[1])?;
        match (found.shown.first(), found.shown_states.first()) {
            (Some(angle), Some(state)) => draw_block(&rows[1], asked, *angle, state, first),
            _ => Ok(()),
        }
    })
}

/// The block before and after, coloured by its hoop stress.
fn draw_block(area: &Area<'_>, asked: &BentBlockStudy, angle: f64, state: &BentBlock, stresses: &[StressAt]) -> Drawn {
    let size = largest(stresses.iter().map(|at| at.stress[1]));
    let (pascal, unit) = prefixed("Pa", size);
    // Three digits beside the colours.
    let shown = (size / unit).max(f64::MIN_POSITIVE);
    let digit = 10.0_f64.powf(shown.log10().floor() - 2.0);
    let shown = (shown / digit).round() * digit;
    let (width, _) = area.dim_in_pixel();
    let (plot, bar) = area.split_horizontally(width - 90 * FINE);
    // The axis of bending is below, the middle of the block above it.
    let place = |radius: f64, share: f64| {
        let (sine, cosine) = (angle * (share - 0.5)).sin_cos();
        [radius * sine, radius * cosine]
    };
    let arc = |radius: f64| (0..=ARC).map(move |i| place(radius, f64::from(i) / f64::from(ARC))).collect::<Vec<_>>();
    let [inner, outer] = state.radii;
    // The reference stands beside it, its upper face as high.
    let (half, thickness) = (0.5 * asked.block.length(), asked.block.thickness());
    let left = arc(outer).iter().map(|[x, _]| -x).fold(f64::NEG_INFINITY, f64::max);
    let shift = -(left + 1.1 * half + 0.1 * outer);
    let corner = |x: f64, y: f64| [shift + x, outer - thickness + y];
    let rectangle =
        [(-half, 0.0), (half, 0.0), (half, thickness), (-half, thickness), (-half, 0.0)].map(|(x, y)| corner(x, y));
    let window = Window::around(arc(outer).into_iter().chain(arc(inner)).chain(rectangle));
    let mut canvas = Canvas::metres(&plot, window, ("x", "y"))?;
    let colour = |stress: f64| {
        let share = stress / size.max(f64::MIN_POSITIVE);
        if share < 0.0 { between(WHITE, PRESSED, -share) } else { between(WHITE, PULLED, share) }
    };
    for strip in stresses.windows(3).step_by(2) {
        let outline = arc(strip[0].radius).into_iter().chain(arc(strip[2].radius).into_iter().rev());
        canvas.fill(&outline.collect::<Vec<_>>(), colour(strip[1].stress[1]))?;
    }
    let thin = INK.mix(0.5).stroke_width(FINE);
    let lines = 12;
    for index in 0..=lines {
        let share = f64::from(index) / f64::from(lines);
        canvas.curve(&[place(inner, share), place(outer, share)], thin)?;
        let x = half * (2.0 * share - 1.0);
        canvas.curve(&[corner(x, 0.0), corner(x, thickness)], thin)?;
    }
    for step in 0..=4 {
        let share = f64::from(step) / 4.0;
        let square = inner * inner + share * (outer * outer - inner * inner);
        canvas.curve(&arc(square.sqrt()), thin)?;
        canvas.curve(&[corner(-half, share * thickness), corner(half, share * thickness)], thin)?;
    }
    canvas.curve(&rectangle, INK.stroke_width(2 * FINE))?;
    let steps: Vec<RGBColor> =
        (0..STEPS).map(|step| colour(size * (2.0 * f64::from(step) / f64::from(STEPS - 1) - 1.0))).collect();
    colour_bar(&bar, &format!("T_θθ ({pascal})"), &steps, (-shown, shown))
}
