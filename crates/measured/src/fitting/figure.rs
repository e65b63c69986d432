//! The figure of a comparison: measured points and fitted curves, a panel for each test.

use piola_charts::{FINE, Panel, RGBColor, colour, figure, legend};

use super::tables::curve;
use super::{Comparison, Measurements};

/// Marks of a panel, at most.
const MARKS: usize = 600;
/// Panels beside each other.
const ACROSS: usize = 3;
/// Size of a panel and width of the legend, pixels.
const PANEL: (usize, usize) = (330, 330);
const LEGEND: usize = 190;

pub(super) fn comparison(measurements: &Measurements, comparison: &Comparison) -> String {
    let unit = measurements.unit.as_ref().map_or_else(String::new, |unit| format!(" ({unit})"));
    let tests = measurements.data.tests();
    let panels: Vec<Panel> = tests
        .iter()
        .map(|test| {
            let is_curve = test.table().mode().is_some();
            // Of many points some are drawn, evenly.
            let stride = test.len().div_ceil(MARKS).max(1);
            let points: Vec<(f64, f64)> = test.abscissas().zip(test.stresses()).step_by(stride).collect();
            let answers = |fit: &piola_fit::solids::Fit| {
                let found = fit.tests.iter().find(|found| found.test == test.name());
                let residuals = found.map_or(&[][..], |found| found.residuals.as_slice());
                points
                    .iter()
                    .zip(residuals.iter().step_by(stride))
                    .map(|((x, y), residual)| (*x, y + residual))
                    .collect()
            };
            let curves =
                comparison.fits().map(|(law, fit)| if is_curve { curve(law, fit, test) } else { answers(fit) });
            let curves = curves.collect();
            let abscissa = match test.table().mode() {
                Some((piola_specimens::homogeneous::Mode::SimpleShear, _)) => "amount of shear",
                Some(_) => "stretch",
                None => "largest stretch",
            };
            let axes = [abscissa.to_owned(), format!("stress{unit}")];
            Panel { name: test.name().to_owned(), axes, points, curves, is_curve }
        })
        .collect();
    let across = panels.len().clamp(1, ACROSS);
    let down = panels.len().div_ceil(across).max(1);
    let size = |count: usize, each: usize, more: usize| u32::try_from(count * each + more).unwrap_or(u32::MAX);
    let title = format!("{}: measured and fitted", measurements.name());
    let names: Vec<String> =
        comparison.fits().map(|(law, fit)| label(&law.to_string(), fit.worst_relative_rms())).collect();
    figure((size(across, PANEL.0, LEGEND + 24), size(down, PANEL.1, 56)), &title, &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plots, side) = area.split_horizontally(width - size(1, LEGEND, 0) * FINE);
        for (panel, part) in panels.iter().zip(plots.split_evenly((down, across))) {
            panel.draw(&part)?;
        }
        let entries: Vec<(&str, RGBColor)> =
            names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
        legend(&side, &entries)
    })
}

/// The law with its largest relative residual.
fn label(law: &str, residual: f64) -> String {
    format!("{law}  {:.1} %", 100.0 * residual)
}
