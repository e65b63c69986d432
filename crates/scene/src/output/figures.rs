//! SVG figures: trajectories, drift of invariants, error against the reference.

use piola_charts::{
    Area, Color as _, Drawn, FINE, MOST_NAMED, RGBColor, TimeCurve, colour, discs, figure, legend, length_unit, line,
    plane_chart, thinned, time_figure,
};

use crate::run::{History, Run};

/// The largest distance of each body from the origin, m.
fn reach(history: &History) -> Vec<f64> {
    let mut reach = vec![0.0; history.names.len()];
    for positions in &history.positions {
        for (reach, x) in reach.iter_mut().zip(positions) {
            *reach = f64::max(*reach, x.iter().map(|x| x * x).sum::<f64>().sqrt());
        }
    }
    reach
}

/// Paths in the plane in which they extend most; in two panels, near and all, when bodies are of very different reach.
pub(super) fn trajectory(title: &str, history: &History, gravity: Option<[f64; 3]>) -> String {
    let reach = reach(history);
    let (across, up) = plane(history, gravity);
    let mut sorted: Vec<f64> = reach.iter().copied().filter(|x| 0.0 < *x && x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let largest = sorted.last().copied().unwrap_or(1.0);
    // A body that hardly moves, as a sun, does not make a panel of its own.
    let several = |radius: f64| 1 < sorted.iter().filter(|x| **x <= radius && 0.05 * radius < **x).count();
    let gap = sorted
        .windows(2)
        .filter(|pair| 2.5 < pair[1] / pair[0] && 8.0 < largest / pair[0] && several(pair[0]))
        .max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])));
    let panels: Vec<f64> = gap.map(|pair| pair[0]).into_iter().chain([largest]).collect();
    let size = if panels.len() == 2 { (1180, 600) } else { (780, 640) };
    figure(size, title, &|area| {
        let beside = if history.names.len() <= MOST_NAMED { 130 * FINE } else { 0 };
        let (width, height) = area.dim_in_pixel();
        let (plots, names) = area.split_horizontally(width - beside);
        let each = (width - beside) / u32::try_from(panels.len())?;
        for (index, &radius) in panels.iter().enumerate() {
            let (part, _) = plots.split_horizontally(each * (u32::try_from(index)? + 1));
            let (_, part) = part.split_horizontally(each * u32::try_from(index)?);
            panel(&part, (each, height), history, &reach, (across, up), radius)?;
        }
        if 0 < beside {
            let entries: Vec<(&str, RGBColor)> =
                history.names.iter().enumerate().map(|(index, name)| (name.as_str(), colour(index))).collect();
            legend(&names, &entries)?;
        }
        Ok(())
    })
}

/// One panel with the bodies that stay within a radius, true to scale.
fn panel(
    area: &Area<'_>,
    (width, height): (u32, u32),
    history: &History,
    reach: &[f64],
    (across, up): (usize, usize),
    radius: f64,
) -> Drawn {
    let (unit, metre) = length_unit(radius);
    let shown: Vec<usize> = (0..reach.len()).filter(|body| reach[*body] <= radius).collect();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for positions in &history.positions {
        for &body in &shown {
            for (k, axis) in [across, up].into_iter().enumerate() {
                let x = positions[body][axis] / metre;
                if x.is_finite() {
                    low[k] = low[k].min(x);
                    high[k] = high[k].max(x);
                }
            }
        }
    }
    if !(low[0] <= high[0] && low[1] <= high[1]) {
        (low, high) = ([-1.0; 2], [1.0; 2]);
    }
    // One scale for both axes: the plot area is what margins and labels leave.
    let (wide, tall) = (
        f64::from(width.saturating_sub(100 * FINE).max(50 * FINE)),
        f64::from(height.saturating_sub(75 * FINE).max(50 * FINE)),
    );
    let scale = 1.08 * ((high[0] - low[0]) / wide).max((high[1] - low[1]) / tall).max(1e-12 * (1.0 + radius / metre));
    let range = |k: usize, pixels: f64| {
        let middle = 0.5 * (low[k] + high[k]);
        middle - 0.5 * scale * pixels..middle + 0.5 * scale * pixels
    };
    let names = ["x", "y", "z"].map(|name| format!("{name} ({unit})"));
    let ranges = (range(0, wide), range(1, tall));
    let mut chart = plane_chart(area, ranges, (names[across].clone(), names[up].clone()))?;
    for &body in &shown {
        let at = |positions: &Vec<[f64; 3]>| (positions[body][across] / metre, positions[body][up] / metre);
        let points: Vec<(f64, f64)> = history.positions.iter().map(at).collect();
        if jumps(&points, 0.15 * scale * wide.min(tall)) {
            let marks = scattered(&points, 2.0 * f64::from(FINE) * scale);
            discs(&mut chart, marks, 1, colour(body))?;
        } else {
            let style = colour(body).stroke_width(if history.names.len() == 1 { FINE } else { 3 * FINE / 2 });
            line(&mut chart, thinned(points.into_iter(), 3.0 * scale), style)?;
        }
        if let Some(last) = history.positions.last() {
            discs(&mut chart, vec![at(last)], 4, colour(body))?;
        }
    }
    Ok(())
}

/// The two axes along which paths extend most; up is against gravity when there is any.
fn plane(history: &History, gravity: Option<[f64; 3]>) -> (usize, usize) {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for x in history.positions.iter().flatten() {
        for k in 0..3 {
            low[k] = low[k].min(x[k]);
            high[k] = high[k].max(x[k]);
        }
    }
    let extent = |k: &usize| high[*k] - low[*k];
    let by_extent = |a: &usize, b: &usize| extent(b).total_cmp(&extent(a)).then(a.cmp(b));
    let mut axes = [0, 1, 2];
    axes.sort_by(by_extent);
    let vertical = gravity.and_then(|g| (0..3).find(|k| 0.9 * g.iter().map(|x| x * x).sum::<f64>() < g[*k] * g[*k]));
    match vertical {
        // A path that hardly rises is seen from above.
        Some(up) if 0.3 * extent(&axes[0]) < extent(&up) => {
            let across = axes.into_iter().find(|k| *k != up).unwrap_or(0);
            (across, up)
        }
        _ => (axes[0].min(axes[1]), axes[0].max(axes[1])),
    }
}

/// Whether successive points are so far apart that lines between them would show what is not there.
fn jumps(points: &[(f64, f64)], far: f64) -> bool {
    let long = points.windows(2).filter(|pair| far < (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).count();
    points.len() < 50 * long
}

/// One point for each occupied cell of a grid.
fn scattered(points: &[(f64, f64)], cell: f64) -> Vec<(f64, f64)> {
    let mut occupied = std::collections::BTreeSet::new();
    #[expect(clippy::cast_possible_truncation, reason = "cells of a figure are few, and the cast saturates")]
    let mut free = |(x, y): &(f64, f64)| occupied.insert(((x / cell).round() as i64, (y / cell).round() as i64));
    points.iter().filter(|(x, y)| x.is_finite() && y.is_finite()).filter(|point| free(point)).copied().collect()
}

/// The relative drift of each invariant over time.
pub(super) fn invariants(title: &str, history: &History) -> String {
    let series = history.drift_series();
    let curve = |name: &str, index: usize, pick: fn(&crate::run::DriftAt) -> Option<f64>| TimeCurve {
        name: name.to_string(),
        colour: colour(index),
        points: series.iter().filter_map(|drift| Some((drift.time, pick(drift)?))).collect(),
    };
    let mut curves = vec![
        curve("energy", 0, |drift| Some(drift.energy)),
        curve("post-Newtonian energy", 1, |drift| drift.post_newtonian_energy),
        curve("momentum", 2, |drift| drift.momentum),
        curve("angular momentum", 3, |drift| drift.angular_momentum),
    ];
    curves.retain(|curve| !curve.points.is_empty());
    time_figure(&format!("{title}: drift of invariants"), "relative change since the start", curves, false)
}

/// The relative error of each body over time.
pub(super) fn error(title: &str, run: &Run) -> String {
    let Some(errors) = &run.errors else { return figure((780, 520), title, &|_| Ok(())) };
    let curves: Vec<TimeCurve> = errors
        .bodies
        .iter()
        .map(|body| TimeCurve {
            name: body.name.clone(),
            colour: colour(body.body),
            points: body.at.iter().map(|at| (at.time, at.relative)).collect(),
        })
        .collect();
    let few = curves.iter().all(|curve| curve.points.len() <= 12);
    time_figure(&format!("{title}: difference from {}", errors.label), "relative error of position", curves, few)
}
