//! Figures of fields on a box.

use piola_charts::{
    Area, Canvas, Color as _, Drawn, FINE, INK, Lattice, RGBColor, WHITE, Window, colour_bar, figure, format_short,
    viridis,
};

use super::map::Slice;
use super::{AXES, FlowHistory, MotionHistory, MotionInstant, StaticField};
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::samples::lattice;

/// Steps of colour.
const BANDS: u32 = 24;
/// Lines of a grid along the longer side.
const LINES: usize = 24;
/// Material lines along the longer side.
const MATERIAL_LINES: f64 = 16.0;
/// Length of the largest displacement in a figure, over the longer side.
const SHOWN_DISPLACEMENT: f64 = 0.06;
/// Curves in the panel of the probes.
const MOST_CURVES: usize = 8;

/// A part of the energy, with its name.
type Part<const D: usize> = (&'static str, fn(&MotionInstant<D>) -> f64);

/// The colours of a map over a window, and the bar beside it.
fn draw_map(
    area: &Area<'_>,
    window: Window,
    lattice: &Lattice,
    (name, unit): (&str, f64),
    lines: &dyn Fn(&mut Canvas<'_>) -> Drawn,
) -> Drawn {
    let (width, _) = area.dim_in_pixel();
    let (plot, bar) = area.split_horizontally(width - 90 * FINE);
    let most = lattice.range().1.max(0.0);
    let share = |band: u32| f64::from(band) / f64::from(BANDS);
    let colours: Vec<RGBColor> = (0..BANDS).map(|band| viridis(share(band))).collect();
    let mut canvas = Canvas::metres(&plot, window, ("x", "y"))?;
    let low = lattice.origin;
    let high = lattice.place(lattice.points[0] - 1, lattice.points[1] - 1);
    canvas.fill(&[low, [high[0], low[1]], high, [low[0], high[1]]], colours[0])?;
    if 0.0 < most {
        let thresholds: Vec<f64> = (1..BANDS).map(|band| share(band) * most).collect();
        canvas.bands(lattice, &thresholds, &colours[1..], colours[0])?;
    }
    lines(&mut canvas)?;
    colour_bar(&bar, name, &colours, (0.0, most / unit))
}

/// Indices of lines: from the first one on, evenly apart, and the last.
fn lines_of(points: usize, longest: usize) -> Vec<usize> {
    let mut lines: Vec<usize> = (0..points).step_by(longest.div_ceil(LINES)).collect();
    if lines.last() != Some(&(points - 1)) {
        lines.push(points - 1);
    }
    lines
}

fn slice_title(title: &str, height: Option<f64>) -> String {
    height.map_or_else(|| title.to_string(), |z| format!("{title}, z = {} m", format_short(z)))
}

pub(super) fn displacement<const D: usize>(found: &StaticField<D>, title: &str) -> String {
    let slice = Slice::of(&found.grid);
    let title = slice_title(title, slice.height);
    if found.displacement[0].is_empty() {
        return figure((600, 200), &format!("{title}: stopped before the solution"), &|_| Ok(()));
    }
    let sizes = slice.sizes(&found.displacement);
    let [across, up] = slice.points();
    let sides = found.grid.sides();
    let in_plane = |i: usize, j: usize| {
        let position = slice.position(i, j);
        [found.displacement[0][position], found.displacement[1][position]]
    };
    let all = (0..up).flat_map(|j| (0..across).flat_map(move |i| in_plane(i, j)));
    let most = largest(all);
    let scale = if 0.0 < most { SHOWN_DISPLACEMENT * sides[0].max(sides[1]) / most } else { 0.0 };
    let deformed = |i: usize, j: usize| {
        let (place, u) = (slice.place(i, j), in_plane(i, j));
        [place[0] + scale * u[0], place[1] + scale * u[1]]
    };
    let longest = across.max(up);
    let mut curves: Vec<Vec<[f64; 2]>> = Vec::new();
    for i in lines_of(across, longest) {
        curves.push((0..up).map(|j| deformed(i, j)).collect());
    }
    for j in lines_of(up, longest) {
        curves.push((0..across).map(|i| deformed(i, j)).collect());
    }
    let corners = [[0.0, 0.0], [sides[0], 0.0], [sides[0], sides[1]], [0.0, sides[1]], [0.0, 0.0]];
    let window = Window::around(curves.iter().flatten().copied().chain(corners));
    let (name, unit) = prefixed("m", sizes.range().1);
    let (wide, tall) = window.size(980);
    let title = format!("{title} (grid: displacement times {})", format_short(scale));
    figure((wide + 90, tall), &title, &|area| {
        draw_map(area, window, &sizes, (&format!("|u| ({name})"), unit), &|canvas| {
            canvas.curve(&corners, INK.stroke_width(2 * FINE))?;
            for curve in &curves {
                canvas.curve(curve, WHITE.stroke_width(FINE))?;
            }
            Ok(())
        })
    })
}

pub(super) fn motion<const D: usize>(found: &MotionHistory<D>, title: &str) -> String {
    let end = found.instants.last().map_or(0.0, |instant| instant.time);
    let (second, time) = prefixed("s", end);
    let displacements = found.instants.iter().flat_map(|instant| instant.displacements.iter().flatten().copied());
    let (metre, length) = prefixed("m", largest(displacements));
    let mut moved = Panel::new("displacement", format!("time ({second})"), format!("u ({metre})")).with_zero();
    let mut curves = 0;
    for (index, probe) in found.probes.iter().enumerate() {
        for (component, axis) in AXES[..D].iter().enumerate() {
            let values =
                || found.instants.iter().map(|instant| (instant.time, instant.displacements[index][component]));
            let is_still = largest(values().map(|(_, u)| u)) <= 1e-9 * length;
            if is_still || curves == MOST_CURVES {
                continue;
            }
            let name = format!("{}: u_{axis}", probe.name);
            moved = moved.curve(&name, curves, values().map(|(t, u)| (t / time, u / length)));
            curves += 1;
        }
    }
    let unit = if D == 2 { "J/m" } else { "J" };
    let (joule, energy) = prefixed(unit, largest(found.instants.iter().map(MotionInstant::energy)));
    let mut energies = Panel::new("energy", format!("time ({second})"), format!("energy ({joule})")).with_zero();
    let parts: [Part<D>; 3] = [
        ("kinetic", |instant| instant.kinetic_energy),
        ("elastic", |instant| instant.elastic_energy),
        ("both", MotionInstant::energy),
    ];
    for (index, (name, part)) in parts.into_iter().enumerate() {
        energies = energies.curve(name, index, found.instants.iter().map(|at| (at.time / time, part(at) / energy)));
    }
    let rows = if found.probes.is_empty() { 1 } else { 2 };
    figure((980, 60 + 370 * u32::from(rows == 2) + 370), title, &|area| {
        let parts = area.split_evenly((rows, 1));
        if rows == 2 {
            moved.draw(&parts[0])?;
        }
        energies.draw(&parts[rows - 1])
    })
}

pub(super) fn flow<const D: usize>(found: &FlowHistory<D>, title: &str) -> String {
    let slice = Slice::of(&found.grid);
    let title = slice_title(title, slice.height);
    let Some([across, up]) = found.coordinates.as_ref().filter(|_| !found.velocity[0].is_empty()) else {
        return figure((600, 200), &format!("{title}: stopped before the flow"), &|_| Ok(()));
    };
    let sides = found.grid.sides();
    let speeds = slice.sizes(&found.velocity);
    let (name, unit) = prefixed("m/s", speeds.range().1);
    let corners = [[0.0, 0.0], [sides[0], 0.0], [sides[0], sides[1]], [0.0, sides[1]], [0.0, 0.0]];
    let window = Window::around(corners.into_iter());
    let (second, time) = prefixed("s", found.duration);
    let over_time = |value: fn(&super::FlowInstant) -> f64| {
        core::iter::once((0.0, 1.0)).chain(found.instants.iter().map(move |at| (at.time / time, value(at))))
    };
    let mut jacobian = Panel::new("least Jacobian", format!("time ({second})"), "det(1 − ∇u)")
        .with_zero()
        .curve("since the last regridding", 0, over_time(|at| at.least_jacobian))
        .dashed("certified for the whole map", 1, over_time(|at| at.certified_jacobian));
    for pair in found.instants.windows(2).filter(|pair| pair[0].regriddings < pair[1].regriddings) {
        jacobian = jacobian.mark("", 0, (pair[0].time / time, pair[0].least_jacobian), false);
    }
    let (wide, tall) = window.size(860);
    figure((wide + 90, tall + 330), &format!("{title} (lines: straight at first)"), &|area| {
        let (_, height) = area.dim_in_pixel();
        let (top, bottom) = area.split_vertically(height - 320 * FINE);
        draw_map(&top, window, &speeds, (&format!("|v| ({name})"), unit), &|canvas| {
            let longest = sides[0].max(sides[1]);
            for (coordinate, side) in [(across, sides[0]), (up, sides[1])] {
                let coordinate = lattice(coordinate);
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to MATERIAL_LINES")]
                let count = ((MATERIAL_LINES * side / longest).round() as u32).max(2);
                for line in 1..count {
                    let threshold = side * f64::from(line) / f64::from(count);
                    for border in coordinate.region(threshold) {
                        canvas.curve(&border, WHITE.stroke_width(FINE))?;
                    }
                }
            }
            canvas.curve(&corners, INK.stroke_width(2 * FINE))
        })?;
        jacobian.draw(&bottom)
    })
}
