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

/// An isotherm that is not yet sorted.
pub(super) struct Group {
    /// With the rows in the order in which they were given.
    pub(super) isotherm: Isotherm,
    /// The places of the rows.
    pub(super) places: Vec<usize>,
    /// A note on temperatures that are merged.
    pub(super) merged: Option<String>,
}

impl Group {
    /// The isotherm, with its rows sorted.
    pub(super) fn sorted(mut self) -> Isotherm {
        self.isotherm.rows.sort_by(|a, b| a.at.total_cmp(&b.at));
        self.isotherm
    }
}

/// Rows by temperature, the lowest first. The error is a range of temperatures, K, in which no isotherms can be told apart.
pub(super) fn grouped(rows: &[(Option<f64>, ResponseRow)]) -> Result<Vec<Group>, [f64; 2]> {
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
    let mut found = Vec::new();
    for mut places in groups {
        places.sort_unstable();
        let (mut temperature, mut merged) = (None, None);
        let told: Vec<f64> = places.iter().filter_map(|&k| rows[k].0).collect();
        if let (Some(low), Some(high)) = (told.iter().copied().reduce(f64::min), told.iter().copied().reduce(f64::max))
        {
            if WANDERING < high - low {
                return Err([low, high]);
            }
            let mean = if low < high { told.iter().sum::<f64>() / told.len() as f64 } else { low };
            temperature = Some(mean);
            if TOLD < high - low {
                merged = Some(format!(
                    "temperatures from {:.2} to {:.2} °C are one isotherm at their mean, {:.2} °C",
                    low - ICE,
                    high - ICE,
                    mean - ICE
                ));
            }
        }
        let of: Vec<ResponseRow> = places.iter().map(|&k| rows[k].1).collect();
        found.push(Group { isotherm: Isotherm { temperature, rows: of }, places, merged });
    }
    Ok(found)
}

/// Sweeps both ways, or abscissas that are measured more than once.
pub(super) fn told_of(Isotherm { temperature, rows }: &Isotherm, response: Response) -> Option<String> {
    let at = temperature.map_or_else(String::new, |t| format!("at {:.1} °C ", t - ICE));
    let (name, one, what) = match response {
        Response::Oscillation => ("G′", "frequency", "frequencies"),
        Response::Relaxation => ("G", "time", "times"),
        Response::Creep => ("J", "time", "times"),
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
    let those = match repeats.len() {
        1 => format!("1 {one} is"),
        count => format!("{count} {what} are"),
    };
    Some(format!(
        "{at}{those} measured more than once, and all rows count: repeats of {name} scatter by {:.2} %",
        100.0 * (squares / degrees).sqrt()
    ))
}
