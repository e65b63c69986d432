//! Repeated measurements at one drive.

use core::ops::Range;

/// Drives that differ by less than this, relative, are one.
const SAME: f64 = 1e-3;
/// The same as a share of the mean distance of the rows: in a dense table no two rows are one.
const SHARE: f64 = 0.02;

/// The groups of rows at one drive, of rows that rise in the drive: drives count as one that differ by less than 0.1 %, and by less than
/// a fiftieth of the mean distance of the rows in ln drive.
///
/// # Example
/// ```
/// use piola_viscometry::recover::repeats;
/// let rows = [[1.0, 3.0], [1.0, 3.2], [10.0, 9.0], [100.0, 27.0]];
/// assert_eq!(repeats(&rows), [0..2, 2..3, 3..4]);
/// ```
#[must_use]
pub fn repeats(rows: &[[f64; 2]]) -> Vec<Range<usize>> {
    let (first, last) = (rows.first().map_or(1.0, |row| row[0]), rows.last().map_or(1.0, |row| row[0]));
    let spacing = (last / first).ln() / rows.len().saturating_sub(1).max(1) as f64;
    let near = 1.0 + if spacing.is_finite() { (SHARE * spacing).clamp(0.0, SAME) } else { 0.0 };
    let mut groups: Vec<Range<usize>> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        match groups.last_mut() {
            Some(group) if row[0] <= near * rows[group.start][0] => group.end = index + 1,
            _ => groups.push(index..index + 1),
        }
    }
    groups
}

/// The geometric mean of drives and of responses.
///
/// # Example
/// ```
/// use piola_viscometry::recover::mean;
/// let found = mean(&[[1.0, 2.0], [1.0, 8.0]]);
/// assert!((found[0] - 1.0).abs() < 1e-15 && (found[1] - 4.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn mean(rows: &[[f64; 2]]) -> [f64; 2] {
    if let [single] = rows {
        return *single;
    }
    let count = rows.len() as f64;
    [0, 1].map(|k| (rows.iter().map(|row| row[k].ln()).sum::<f64>() / count).exp())
}
