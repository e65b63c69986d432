//! What rounding leaves of a result at inputs made to spoil it.
//!
//! Every quantity is computed in doubles and, by the same formula, in doubled precision from the same doubles; the
//! difference is rounding and nothing else. That the formula is right, other tests show. The free top is compared
//! with its closed form instead.

mod far;
mod metric;
mod rotations;
mod top;

use piola_numerics::Real;
use piola_testkit::DoubleDouble;

/// One line of a table: the worst case over some states.
#[derive(Clone, Debug)]
pub struct Row {
    /// What makes the input hard.
    pub input: String,
    /// Largest relative errors, in the order of the table's columns.
    pub errors: Vec<f64>,
    /// What each of them is held to.
    pub allowed: Vec<f64>,
}

/// Rows of one kind of adversity.
#[derive(Clone, Debug)]
pub struct Table {
    /// The heading.
    pub title: &'static str,
    /// What was done, and where the bounds come from.
    pub text: &'static str,
    /// The first column's heading, and those of the errors.
    pub columns: Vec<&'static str>,
    /// The rows.
    pub rows: Vec<Row>,
}

impl Table {
    /// The rows in which an error is larger than allowed, or is no number.
    pub fn exceeding(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.errors.iter().zip(&row.allowed).any(|(e, a)| e.is_nan() || a < e))
    }
}

/// All tables; `steps` is the number of steps that the free top is followed.
///
/// # Errors
/// What the systems refuse: none of these inputs should be.
pub fn tables(steps: u32) -> Result<Vec<Table>, Box<dyn std::error::Error>> {
    Ok(vec![
        rotations::near_singular_angles()?,
        metric::near_dependence()?,
        metric::mass_ratios()?,
        far::from_origin()?,
        top::free_top(steps)?,
    ])
}

/// Numbers without pattern between −1 and 1, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        // The upper 32 bits, as a dyadic fraction.
        f64::from((z >> 32) as u32) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn several(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

/// The same numbers in doubled precision.
fn doubled(values: &[f64]) -> Vec<DoubleDouble> {
    values.iter().map(|&x| DoubleDouble::lit(x)).collect()
}

/// The rounding of results, over the largest of the exact ones.
fn rounding(computed: &[f64], exact: &[DoubleDouble]) -> f64 {
    let mut worst = 0.0_f64;
    let mut size = 0.0_f64;
    for (&computed, exact) in computed.iter().zip(exact) {
        let error = exact.rounding_of(computed).abs();
        worst = if error <= worst { worst } else { error };
        size = size.max(exact.primal(0).abs());
    }
    worst / size
}

/// The larger error, or NaN where there is one.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}
