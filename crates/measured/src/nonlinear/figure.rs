//! The figure of fitted viscoelastic fluids: a panel for each kind of flow and response.

use piola_charts::{LogPanel, figure};
use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, ShearResponse};

use super::curves::{significant, unit_of_drive};
use super::{NonlinearComparison, NonlinearTable};

/// Title and axes of the panel of a flow.
const fn panel(flow: NonlinearFlow) -> (&'static str, [&'static str; 2]) {
    const RATE: &str = "shear rate (1/s)";
    const TIME: &str = "time (s)";
    const EXTENSION: &str = "rate of extension (1/s)";
    match flow {
        NonlinearFlow::SteadyShear(ShearResponse::ShearStress) => ("steady shear", [RATE, "τ (Pa)"]),
        NonlinearFlow::SteadyShear(ShearResponse::FirstNormalStressDifference) => ("steady shear", [RATE, "N₁ (Pa)"]),
        NonlinearFlow::SteadyShear(_) => ("steady shear", [RATE, "−N₂ (Pa)"]),
        NonlinearFlow::ShearStartUp { response: ShearResponse::ShearStress, .. } => {
            ("start-up of shear", [TIME, "τ (Pa)"])
        }
        NonlinearFlow::ShearStartUp { response: ShearResponse::FirstNormalStressDifference, .. } => {
            ("start-up of shear", [TIME, "N₁ (Pa)"])
        }
        NonlinearFlow::ShearStartUp { .. } => ("start-up of shear", [TIME, "−N₂ (Pa)"]),
        NonlinearFlow::SteadyExtension(_) => ("steady extension", [EXTENSION, "stress difference (Pa)"]),
        _ => ("start-up of extension", [TIME, "stress difference (Pa)"]),
    }
}

/// Measured points with the curves of the best fluid, or of the first where none is the best.
pub(super) fn drawn(table: &NonlinearTable, found: &NonlinearComparison) -> String {
    let shown = found.best().or_else(|| found.fits().next());
    let mut panels: Vec<LogPanel<'_>> = Vec::new();
    let mut ends: Vec<Vec<String>> = Vec::new();
    for set in &table.flows {
        let (title, axes) = panel(set.flow());
        let place = panels.iter().position(|other| other.title == title && other.axes == axes);
        let place = place.unwrap_or_else(|| {
            panels.push(LogPanel { title, axes, marks: Vec::new(), curves: Vec::new(), band: Vec::new() });
            ends.push(Vec::new());
            panels.len() - 1
        });
        let size = |[drive, answer]: &[f64; 2]| (*drive, answer.abs());
        panels[place].marks.extend(NonlinearData::rows(set).iter().map(size));
        if let Some((model, fitted)) = shown {
            let curve = fitted.curve(model, set);
            if curve.in_words(set.flow()).is_some() {
                let unit = unit_of_drive(set.flow());
                ends[place].push(match curve.points.last() {
                    Some([last, _]) => format!("curve ends at {} {unit}", significant(*last)),
                    None => "no curve".to_owned(),
                });
            }
            panels[place].curves.push(curve.points.iter().map(size).collect());
        }
    }
    let told = |(panel, ends): (&LogPanel<'_>, &Vec<String>)| match ends.as_slice() {
        [] => panel.title.to_owned(),
        ends => format!("{}; {}", panel.title, ends.join(", ")),
    };
    let titles: Vec<String> = panels.iter().zip(&ends).map(told).collect();
    for (panel, title) in panels.iter_mut().zip(&titles) {
        panel.title = title;
    }
    let columns = panels.len().clamp(1, 3);
    let rows = panels.len().div_ceil(columns).max(1);
    #[expect(clippy::cast_possible_truncation, reason = "a few panels")]
    let size = (400 * columns as u32, 400 * rows as u32);
    let name = shown.map_or_else(|| "no fluid".to_owned(), |(model, _)| model.to_string());
    figure(size, &format!("{}: {name}", table.name()), &|area| {
        let parts = area.split_evenly((rows, columns));
        panels.iter().zip(&parts).try_for_each(|(panel, part)| panel.draw(part))
    })
}
