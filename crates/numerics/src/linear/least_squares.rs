//! Weighted least squares: A x ≈ b and `AᵀA x = Aᵀb + h` without forming `AᵀA`.
//!
//! ```text
//! minimise ½|A x − b|² − h·x        AᵀA x = Aᵀ b + h
//! ```
//!
//! A metric of condition number κ that is formed, `g = AᵀA`, has lost κ ulp before it is factored, whatever is
//! done to it afterwards. Its rows A have the condition number √κ:
//!
//! ```text
//! error of x, relative        by AᵀA:  κ ulp        by A:  √κ ulp + κ ulp · |A x − b|/(|A||x|)
//! ```
//!
//! An ulp of h is κ ulp of x, whatever the method.
//!
//! The rows may differ in size by any factor: by Householder reflections with exchanges of rows and columns
//! each row keeps its own digits (M. J. D. Powell, J. K. Reid, 1969; A. J. Cox, N. J. Higham, *Stability of
//! Householder QR factorization for weighted least squares problems*, 1998). Columns are scaled by powers of
//! two, so that their units do not matter.

use crate::error::check_dimension;
use crate::sums::unit_in_last_place;
use crate::{NumericsError, Real};

/// The rows of A with b, and what is needed to solve for x: made once, without allocation when used again.
///
/// # Example
/// A straight line through three points, y = 1 + 2 t.
/// ```
/// use piola_numerics::linear::least_squares::LeastSquares;
/// let mut line = LeastSquares::new();
/// line.begin(2);
/// for (t, y) in [(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)] {
///     line.add_row([1.0, t], y)?;
/// }
/// let mut x = [0.0_f64, 0.0]; // h = 0
/// line.solve_in_place(&mut x, 0.0)?;
/// assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[doc(alias("QR", "Householder"))]
#[derive(Clone, Debug)]
pub struct LeastSquares<T = f64> {
    columns: usize,
    /// Row by row; after a solution R on and above the diagonal, its columns in the order of `order`.
    rows: Vec<T>,
    right: Vec<T>,
    /// Which unknown each column is.
    order: Vec<usize>,
    /// The power of two that each unknown's column was divided by, and the size left of it.
    units: Vec<f64>,
    sizes: Vec<f64>,
    scratch: Vec<T>,
}

impl<T> Default for LeastSquares<T> {
    fn default() -> Self {
        Self {
            columns: 0,
            rows: Vec::new(),
            right: Vec::new(),
            order: Vec::new(),
            units: Vec::new(),
            sizes: Vec::new(),
            scratch: Vec::new(),
        }
    }
}

impl<T: Real> LeastSquares<T> {
    /// No rows yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets all rows; the next have `columns` entries.
    pub fn begin(&mut self, columns: usize) {
        self.columns = columns;
        self.rows.clear();
        self.right.clear();
    }

    /// Adds a row of A with its entry of b. Multiply both by √w to give the row the weight w.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`] unless the row has as many entries as [`begin`](Self::begin) said.
    pub fn add_row(&mut self, row: impl IntoIterator<Item = T>, right: T) -> Result<(), NumericsError> {
        self.rows.extend(row);
        self.right.push(right);
        check_dimension("row", self.rows.len(), self.right.len() * self.columns)
    }

    /// Overwrites h with the solution of `AᵀA x = Aᵀb + h`, and the rows with their factors: begin anew after it.
    ///
    /// What is left of a column when those before it are taken out must be more than `share` of it, or n ulp
    /// if that is more. In a metric `g = AᵀA` the pivots are the squares of these: dₖ/gₖₖ is share².
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`]; [`NumericsError::Singular`] with the unknown that depends on others, also when a number is
    /// NaN: [`null_direction_into`](Self::null_direction_into) tells how.
    ///
    /// # Accuracy
    /// See [the module](self).
    pub fn solve_in_place(&mut self, x: &mut [T], share: f64) -> Result<(), NumericsError> {
        let n = self.columns;
        check_dimension("right-hand side", x.len(), n)?;
        self.scale();
        let least = share.max(n as f64 * unit_in_last_place::<T>());
        for k in 0..n {
            let (column, size) = self.largest_column(k);
            let unknown = self.order[column];
            let whole = self.sizes[unknown];
            let independent = least * whole < size;
            if !independent || self.right.len() <= k {
                self.order.swap(k, column);
                self.swap_columns(k, column);
                let unit = self.units[unknown];
                return Err(NumericsError::Singular { pivot: unknown, value: size * unit, scale: whole * unit });
            }
            self.order.swap(k, column);
            self.swap_columns(k, column);
            self.reflect(k);
        }
        self.substitute(x);
        Ok(())
    }

    /// The direction z that changes nothing, A z = 0 to rounding, where [`solve_in_place`](Self::solve_in_place)
    /// refused an unknown; its entry of z is one.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`], also when nothing was refused.
    ///
    /// # Example
    /// ```
    /// use piola_numerics::linear::least_squares::LeastSquares;
    /// let mut equal = LeastSquares::new();
    /// equal.begin(2);
    /// equal.add_row([1.0, 1.0], 0.0)?;
    /// equal.add_row([2.0, 2.0], 0.0)?;
    /// assert!(equal.solve_in_place(&mut [0.0; 2], 0.0).is_err());
    /// let mut z = [0.0_f64; 2];
    /// equal.null_direction_into(1, &mut z)?;
    /// assert!((z[0] + z[1]).abs() < 1e-15 && z[1] == 1.0);
    /// # Ok::<(), piola_numerics::NumericsError>(())
    /// ```
    pub fn null_direction_into(&self, unknown: usize, direction: &mut [T]) -> Result<(), NumericsError> {
        let n = self.columns;
        check_dimension("direction", direction.len(), n)?;
        let rank = self.order.iter().position(|&column| column == unknown).unwrap_or(n);
        check_dimension("unknown", rank.max(n.saturating_sub(1)), n.saturating_sub(1))?;
        direction.fill(T::zero());
        let entry = |i: usize, j: usize| self.rows[i * n + j];
        direction[unknown] = T::one();
        for i in (0..rank).rev() {
            let mut x = -entry(i, rank);
            for j in i + 1..rank {
                x -= entry(i, j) * direction[self.order[j]] * self.unit_of(j);
            }
            // Columns were divided by their units: the unknowns of the scaled columns are z times the unit.
            direction[self.order[i]] = x / (entry(i, i) * self.unit_of(i));
        }
        let unit = self.unit_of(rank);
        for &column in &self.order[..rank] {
            direction[column] *= unit;
        }
        Ok(())
    }

    /// The unit of the column in place j.
    fn unit_of(&self, j: usize) -> T {
        T::lit(self.units[self.order[j]])
    }

    /// The largest |x| over lanes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(x: T) -> f64 {
        (0..T::LANES).map(|lane| x.primal(lane).abs()).fold(0.0, |m, x| if x <= m { m } else { x })
    }

    /// Divides each column by a power of two near its largest entry, and keeps its length.
    fn scale(&mut self) {
        let n = self.columns;
        self.order.clear();
        self.order.extend(0..n);
        self.units.clear();
        self.units.resize(n, 0.0);
        for row in self.rows.chunks_exact(n.max(1)) {
            for (unit, &entry) in self.units.iter_mut().zip(row) {
                *unit = unit.max(Self::size(entry));
            }
        }
        for unit in &mut self.units {
            // A column of zeros is left as it is; it will be refused.
            let exponent = if 0.0 < *unit && *unit < f64::INFINITY { unit.log2().round() } else { 0.0 };
            *unit = exponent.clamp(-1000.0, 1000.0).exp2();
        }
        for row in self.rows.chunks_exact_mut(n.max(1)) {
            for (entry, &unit) in row.iter_mut().zip(&self.units) {
                *entry *= T::lit(unit.recip());
            }
        }
        self.sizes.clear();
        for j in 0..n {
            let size = self.length(j, 0);
            self.sizes.push(size);
        }
    }

    /// The length of column j from row `first` on: of the lane in which it is shortest.
    fn length(&self, j: usize, first: usize) -> f64 {
        let n = self.columns;
        (0..T::LANES).fold(f64::INFINITY, |least, lane| {
            let entries = self.rows.chunks_exact(n).skip(first).map(|row| row[j].primal(lane));
            let length = entries.map(|x| x * x).sum::<f64>().sqrt();
            // NaN stays, to be refused.
            if least <= length { least } else { length }
        })
    }

    /// The column, from k on, of which most is left below row k.
    fn largest_column(&self, k: usize) -> (usize, f64) {
        let (mut column, mut largest) = (k, self.length(k, k));
        for j in k + 1..self.columns {
            let length = self.length(j, k);
            if largest < length {
                (column, largest) = (j, length);
            }
        }
        (column, largest)
    }

    fn swap_columns(&mut self, a: usize, b: usize) {
        if a != b {
            for row in self.rows.chunks_exact_mut(self.columns) {
                row.swap(a, b);
            }
        }
    }

    /// Brings the largest entry of column k to row k and reflects it onto the diagonal.
    fn reflect(&mut self, k: usize) {
        let n = self.columns;
        let mut top = k;
        for i in k + 1..self.right.len() {
            if Self::size(self.rows[top * n + k]) < Self::size(self.rows[i * n + k]) {
                top = i;
            }
        }
        if top != k {
            self.right.swap(k, top);
            let (before, after) = self.rows.split_at_mut(top * n);
            before[k * n..(k + 1) * n].swap_with_slice(&mut after[..n]);
        }
        let mut square = T::zero();
        for row in self.rows.chunks_exact(n).skip(k) {
            square += row[k] * row[k];
        }
        let diagonal = self.rows[k * n + k];
        let reflected = -square.sqrt().copysign(diagonal);
        // v = a − (reflected) e_k, whose first component does not cancel; H = 1 − v vᵀ/(½ v·v).
        let first = diagonal - reflected;
        self.rows[k * n + k] = first;
        let half_square = -(reflected * first);
        self.scratch.clear();
        self.scratch.resize(n - k, T::zero()); // v·(columns after k), and v·b at the place of column k
        for (row, &right) in self.rows.chunks_exact(n).zip(&self.right).skip(k) {
            let v = row[k];
            self.scratch[0] += v * right;
            for (sum, &entry) in self.scratch[1..].iter_mut().zip(&row[k + 1..]) {
                *sum += v * entry;
            }
        }
        for sum in &mut self.scratch {
            *sum /= half_square;
        }
        for (row, right) in self.rows.chunks_exact_mut(n).zip(&mut self.right).skip(k) {
            let v = row[k];
            *right -= v * self.scratch[0];
            for (entry, &sum) in row[k + 1..].iter_mut().zip(&self.scratch[1..]) {
                *entry -= v * sum;
            }
        }
        self.rows[k * n + k] = reflected;
    }

    /// x ← R⁻¹ (Qᵀ b + R⁻ᵀ h), in units and order of the unknowns.
    fn substitute(&mut self, x: &mut [T]) {
        let n = self.columns;
        self.scratch.clear();
        let unit = |j: usize| T::lit(self.units[self.order[j]].recip());
        for j in 0..n {
            let mut entry = x[self.order[j]] * unit(j);
            for i in 0..j {
                entry -= self.rows[i * n + j] * self.scratch[i];
            }
            self.scratch.push(entry / self.rows[j * n + j]);
        }
        for j in (0..n).rev() {
            let mut entry = self.scratch[j] + self.right[j];
            for i in j + 1..n {
                entry -= self.rows[j * n + i] * self.scratch[i];
            }
            self.scratch[j] = entry / self.rows[j * n + j];
        }
        for j in 0..n {
            x[self.order[j]] = self.scratch[j] * unit(j);
        }
    }
}
