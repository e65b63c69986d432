//! Rows in the order in which an instrument wrote them: sweeps that rise and fall, repeats, or no order.

use core::str::FromStr;

use crate::MeasuredError;

/// Which rows of a table with rising and falling sweeps are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Sweep {
    /// Those of the rising sweeps.
    #[default]
    Rising,
    /// Those of the falling sweeps.
    Falling,
    /// All, as repeated measurements.
    All,
}

impl FromStr for Sweep {
    type Err = MeasuredError;

    fn from_str(text: &str) -> Result<Self, MeasuredError> {
        match text {
            "rising" | "up" => Ok(Self::Rising),
            "falling" | "down" => Ok(Self::Falling),
            "all" => Ok(Self::All),
            _ => Err(MeasuredError::Argument { argument: text.to_owned(), valid: "rising, falling or all" }),
        }
    }
}

/// Responses of falling sweeps beside those of rising sweeps at the same drives.
///
/// # Example
/// ```
/// use piola_measured::rheology::{FlowKind, Measured};
/// // Up and down again, 10 % lower on the way back.
/// let text = "shear_rate,shear_stress\n1,10\n2,20\n4,40\n4,36\n2,18\n1,9\n";
/// let loop_ = Measured::parse("loop.csv", text, FlowKind::Curve, &[])?;
/// let hysteresis = loop_.hysteresis.expect("two sweeps");
/// assert!((hysteresis.mean - 0.9).abs() < 1e-12);
/// assert_eq!(loop_.rows().len(), 3);
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hysteresis {
    /// The geometric mean of falling over rising responses.
    pub mean: f64,
    /// The ratio that is farthest from 1.
    pub farthest: f64,
    /// The drive there, SI.
    pub at: f64,
    /// Rows of the rising and of the falling sweeps.
    pub rows: [usize; 2],
}

/// Fewest rows of a sweep.
const FEWEST: usize = 3;
/// More pieces than this are no sweeps.
const MOST: usize = 12;

/// The direction of each row's sweep: true where the drive rises; nothing if all rows go one way, or no way.
pub(crate) fn directions(drives: &[f64]) -> Option<Vec<bool>> {
    let mut rising = Vec::with_capacity(drives.len());
    let mut pieces: Vec<(bool, usize)> = Vec::new();
    let mut start = 0;
    while start < drives.len() {
        let next = drives.get(start + 1);
        let up = next.is_none_or(|next| drives[start] < *next);
        let mut end = start + 1;
        while end < drives.len() && if up { drives[end - 1] < drives[end] } else { drives[end] < drives[end - 1] } {
            end += 1;
        }
        pieces.push((up, end - start));
        rising.extend(core::iter::repeat_n(up, end - start));
        if MOST < pieces.len() {
            return None;
        }
        start = end;
    }
    let are_sweeps = pieces.iter().all(|(_, rows)| FEWEST <= *rows);
    let both = [true, false].iter().all(|way| pieces.iter().any(|(up, _)| up == way));
    (are_sweeps && both).then_some(rising)
}

/// Falling beside rising responses.
pub(crate) fn hysteresis(rows: &[[f64; 2]], rising: &[bool]) -> Option<Hysteresis> {
    let of = |up: bool| {
        let mut rows: Vec<[f64; 2]> =
            rows.iter().zip(rising).filter(|(_, way)| **way == up).map(|(row, _)| row.map(f64::ln)).collect();
        rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
        rows
    };
    let (up, down) = (of(true), of(false));
    let at = |u: f64| {
        let after = down.partition_point(|row| row[0] < u);
        let (a, b) = (down.get(after.saturating_sub(1))?, down.get(after)?);
        if u < a[0] {
            return None;
        }
        let width = b[0] - a[0];
        Some(if 0.0 < width { a[1] + (b[1] - a[1]) * (u - a[0]) / width } else { b[1] })
    };
    let ratios: Vec<[f64; 2]> = up.iter().filter_map(|row| Some([row[0], at(row[0])? - row[1]])).collect();
    let farthest = ratios.iter().copied().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs()))?;
    let mean = ratios.iter().map(|ratio| ratio[1]).sum::<f64>() / ratios.len() as f64;
    Some(Hysteresis {
        mean: mean.exp(),
        farthest: farthest[1].exp(),
        at: farthest[0].exp(),
        rows: [up.len(), down.len()],
    })
}
