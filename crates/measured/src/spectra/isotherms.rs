//! Rows by temperature, and what a reader must know of their order.

use super::{Isotherm, Response, ResponseRow};
use crate::rheology::sweeps::{directions, hysteresis};

/// Temperatures that are farther apart belong to two isotherms, K.
const HELD: f64 = 0.5;
/// What temperatures of an isotherm may differ by, K; beyond, they are of a ramp.
const WANDERING: f64 = 3.0;
/// What is not worth a word, K.
const TOLD: f64 = 0.05;
/// K at 0 °C.
const ICE: f64 = 273.15;

/// Rows by temperature, in the order in which they were measured, with notes on what is fitted together. The error is a range of
/// temperatures, K, in which no isotherms can be told apart.
pub(super) fn grouped(
    rows: &[(Option<f64>, ResponseRow)],
    response: Response,
) -> Result<(Vec<Isotherm>, Vec<String>), [f64; 2]> {
    // Stable: rows of one temperature stay in their order.
    let mut order: Vec<(Option<f64>, usize)> = rows.iter().enumerate().map(|(k, row)| (row.0, k)).collect();
    order.sort_by(|a, b| a.0.unwrap_or(0.0).total_cmp(&b.0.unwrap_or(0.0)));
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut last: Option<Option<f64>> = None;
    for (temperature, k) in order {
        let is_same = match (last, temperature) {
            (Some(Some(a)), Some(b)) => b - a < HELD,
            (Some(a), b) => a.is_none() && b.is_none(),
            (None, _) => false,
        };
        match groups.last_mut() {
            Some(group) if is_same => group.push(k),
            _ => groups.push(vec![k]),
        }
        last = Some(temperature);
    }
    let (mut isotherms, mut notes) = (Vec::new(), Vec::new());
    for mut group in groups {
        group.sort_unstable();
        let mut temperature = None;
        let told: Vec<f64> = group.iter().filter_map(|&k| rows[k].0).collect();
        if let (Some(low), Some(high)) = (told.iter().copied().reduce(f64::min), told.iter().copied().reduce(f64::max))
        {
            if WANDERING < high - low {
                return Err([low, high]);
            }
            let mean = if low < high { told.iter().sum::<f64>() / told.len() as f64 } else { low };
            temperature = Some(mean);
            if TOLD < high - low {
                notes.push(format!(
                    "temperatures from {:.2} to {:.2} °C are one isotherm at their mean, {:.2} °C",
                    low - ICE,
                    high - ICE,
                    mean - ICE
                ));
            }
        }
        let of: Vec<ResponseRow> = group.iter().map(|&k| rows[k].1).collect();
        notes.extend(told_of(&of, temperature, response));
        isotherms.push(Isotherm { temperature, rows: of });
    }
    for isotherm in &mut isotherms {
        isotherm.rows.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    Ok((isotherms, notes))
}

/// Sweeps both ways, or abscissas that are measured more than once.
fn told_of(rows: &[ResponseRow], temperature: Option<f64>, response: Response) -> Option<String> {
    let at = temperature.map_or_else(String::new, |t| format!("at {:.1} °C ", t - ICE));
    let (name, what) = match response {
        Response::Oscillation => ("G′", "frequencies"),
        Response::Relaxation => ("G", "times"),
        Response::Creep => ("J", "times"),
    };
    let drives: Vec<f64> = rows.iter().map(|row| row.at).collect();
    let pairs: Vec<[f64; 2]> = rows.iter().map(|row| [row.at, row.moduli[0]]).collect();
    if let Some(rising) = directions(&drives) {
        let ratio = hysteresis(&pairs, &rising).map_or_else(String::new, |found| {
            format!("; falling {name} are {:.3} times rising ones in the mean", found.mean)
        });
        return Some(format!("{at}{what} rise and fall: both sweeps are fitted together{ratio}"));
    }
    let mut sorted = pairs;
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let repeats: Vec<&[[f64; 2]]> =
        sorted.chunk_by(|a, b| b[0] - a[0] <= 1e-9 * b[0]).filter(|rows| 1 < rows.len()).collect();
    if repeats.is_empty() {
        return None;
    }
    // The standard deviation of ln y about the means of repeats.
    let (mut squares, mut degrees) = (0.0, 0.0);
    for repeat in &repeats {
        let n = repeat.len() as f64;
        let mean = repeat.iter().map(|row| row[1].ln()).sum::<f64>() / n;
        squares += repeat.iter().map(|row| (row[1].ln() - mean).powi(2)).sum::<f64>();
        degrees += n - 1.0;
    }
    Some(format!(
        "{at}{} {what} are measured more than once, and all rows count: repeats of {name} scatter by {:.2} %",
        repeats.len(),
        100.0 * (squares / degrees).sqrt()
    ))
}
