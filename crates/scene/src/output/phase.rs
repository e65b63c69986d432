//! Figures of phase space: the plane of each coordinate and its momentum, and Poincaré sections.

use core::ops::Range;

use piola_charts::{Area, Color as _, Drawn, FINE, colour, discs, figure, line, plane_chart};

use super::Crossing;
use crate::run::History;

/// Planes that are drawn.
const MOST_PLANES: usize = 4;

/// The path in the plane of each coordinate and its momentum.
pub(super) fn planes(title: &str, history: &History) -> String {
    let n = history.coordinate_names.len() / 2;
    let points = |i: usize| history.coordinates.iter().map(|row| (row[i], row[n + i])).collect();
    panels(title, history, &(0..n).map(|i| (i, n + i, points(i))).collect::<Vec<_>>(), true)
}

/// The crossings of a section in the same planes.
pub(super) fn section(title: &str, history: &History, crossings: &[Crossing]) -> String {
    let n = history.coordinate_names.len() / 2;
    let points = |i: usize| crossings.iter().map(|(_, point)| (point[i], point[n + i])).collect();
    panels(&format!("{title}: section"), history, &(0..n).map(|i| (i, n + i, points(i))).collect::<Vec<_>>(), false)
}

/// Two columns of the record with their points.
type PhasePlane = (usize, usize, Vec<(f64, f64)>);

fn panels(title: &str, history: &History, planes: &[PhasePlane], joined: bool) -> String {
    let shown = planes.len().clamp(1, MOST_PLANES);
    let width = if shown == 1 { 680 } else { 1180 };
    let height = if shown <= 2 { 560 } else { 1080 };
    figure((width, height), title, &|area| {
        let parts = area.split_evenly((shown.div_ceil(2), shown.min(2)));
        for ((across, up, points), part) in planes.iter().zip(&parts) {
            let name = |i: usize| history.coordinate_names[i].clone();
            plane(part, points, (name(*across), name(*up)), joined)?;
        }
        Ok(())
    })
}

fn plane(area: &Area<'_>, points: &[(f64, f64)], names: (String, String), joined: bool) -> Drawn {
    let range = |pick: fn(&(f64, f64)) -> f64| -> Range<f64> {
        let values = points.iter().map(pick).filter(|x| x.is_finite());
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if high < low {
            return -1.0..1.0;
        }
        let margin = 0.04 * (high - low) + 1e-9 * (1.0 + low.abs().max(high.abs()));
        low - margin..high + margin
    };
    let mut chart = plane_chart(area, (range(|point| point.0), range(|point| point.1)), names)?;
    if joined {
        line(&mut chart, points.to_vec(), colour(0).stroke_width(FINE))
    } else {
        discs(&mut chart, points.to_vec(), 1, colour(0))
    }
}
