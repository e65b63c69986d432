//! Which rows are independent: an orthogonalisation in the metric of a matrix that reveals the rank.
//!
//! ```text
//! M = L D Lᵀ        bᵢ = D^{-1/2} L⁻¹ gᵢ / sᵢ,   sᵢ² = gᵢᵀ M⁻¹ gᵢ        b_{order(k)} = Σ_l r_{l,k} u_l
//! ```
//!
//! gᵢ is row i, as the gradient of a constraint, and u the orthonormal basis of their span. At each stage the row is
//! taken of which most is left (the first of several equal ones). Where less than a given share is left of all, the
//! others depend on those taken.

use super::ldlt;
use super::vectors::{dot, size, zeros};
use crate::{NumericsError, Real};

/// The factors of a metric and of rows, which are gradients of constraints where mechanics calls it.
#[derive(Clone, Debug)]
pub struct IndependentRows<T> {
    coordinates: usize,
    /// L and D of the metric.
    pub factors: Vec<T>,
    /// D^{-1/2}.
    roots: Vec<T>,
    /// bᵢ; while the basis is made, what is left of it.
    rows: Vec<T>,
    /// sᵢ, in units of the constraint by those of √(kg m²).
    pub sizes: Vec<T>,
    /// `u_k`, one after the other.
    basis: Vec<T>,
    /// r_{l,i} at `l count + i`.
    coefficients: Vec<T>,
    /// The constraints taken, in order, then the others.
    pub order: Vec<usize>,
    /// How many are taken.
    pub rank: usize,
    /// D^{1/2} Lᵀ q̈, and its part along the basis that the constraints add.
    shifted: Vec<T>,
    along: Vec<T>,
    targets: Vec<T>,
    /// What the constraints that depend are made of, in those taken: `rank` numbers each.
    combinations: Vec<T>,
    small: Vec<T>,
    scaled: Vec<T>,
}

impl<T> Default for IndependentRows<T> {
    fn default() -> Self {
        Self {
            coordinates: 0,
            factors: Vec::new(),
            roots: Vec::new(),
            rows: Vec::new(),
            sizes: Vec::new(),
            basis: Vec::new(),
            coefficients: Vec::new(),
            order: Vec::new(),
            rank: 0,
            shifted: Vec::new(),
            along: Vec::new(),
            targets: Vec::new(),
            combinations: Vec::new(),
            small: Vec::new(),
            scaled: Vec::new(),
        }
    }
}

impl<T: Real> IndependentRows<T> {
    /// The number of constraints.
    fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Factors the metric of n coordinates.
    ///
    /// # Errors
    /// [`NumericsError::NotPositiveDefinite`].
    pub fn factor_metric(&mut self, metric: &[T], n: usize) -> Result<(), NumericsError> {
        self.coordinates = n;
        self.factors.clear();
        self.factors.extend_from_slice(metric);
        ldlt::factor_in_place(&mut self.factors, n)?;
        self.roots.clear();
        let factors = &self.factors;
        self.roots.extend((0..n).map(|k| factors[k * (n + 1)].sqrt().recip()));
        Ok(())
    }

    /// x ← D^{-1/2} L⁻¹ x.
    fn whiten(factors: &[T], roots: &[T], x: &mut [T]) {
        let n = x.len();
        for k in 0..n {
            let above = x[k];
            for i in k + 1..n {
                x[i] -= factors[i + k * n] * above;
            }
        }
        for (x, &root) in x.iter_mut().zip(roots) {
            *x *= root;
        }
    }

    /// x ← L⁻ᵀ D^{-1/2} x.
    fn unwhiten(&self, x: &mut [T]) {
        let n = x.len();
        for (x, &root) in x.iter_mut().zip(&self.roots) {
            *x *= root;
        }
        for k in (0..n).rev() {
            for i in k + 1..n {
                let below = x[i];
                x[k] -= self.factors[i + k * n] * below;
            }
        }
    }

    /// bᵢ and sᵢ of the gradients gᵢ.
    pub fn scale(&mut self, gradients: &[T], count: usize) {
        let n = self.coordinates;
        self.rows.clear();
        self.rows.extend_from_slice(gradients);
        zeros(&mut self.sizes, count);
        for (row, length) in self.rows.chunks_exact_mut(n.max(1)).zip(&mut self.sizes) {
            Self::whiten(&self.factors, &self.roots, row);
            *length = dot(row, row).sqrt();
            // A gradient that vanishes is left as it is: nothing is of its direction.
            if 0.0 < size(*length) {
                let inverse = length.recip();
                for entry in row {
                    *entry *= inverse;
                }
            }
        }
    }

    /// Takes independent constraints, as many as there are.
    pub fn choose(&mut self, least_share: f64) {
        let (n, count) = (self.coordinates, self.count());
        self.begin();
        self.order.clear();
        self.order.extend(0..count);
        self.rank = 0;
        while self.rank < n.min(count) {
            let (mut best, mut largest) = (self.rank, 0.0);
            for (place, &i) in self.order.iter().enumerate().skip(self.rank) {
                let left = self.left_of(i);
                // The first of those that are equal but for rounding.
                if largest * (1.0 + 1e-8) < left {
                    (best, largest) = (place, left);
                }
            }
            if largest <= least_share {
                break;
            }
            self.order[self.rank..=best].rotate_right(1);
            self.take(self.rank, count);
            self.rank += 1;
        }
    }

    /// Takes the constraints that were chosen before, in the same order.
    ///
    /// # Errors
    /// The row of which nothing is left.
    pub fn follow(&mut self) -> Result<(), usize> {
        self.begin();
        for place in 0..self.rank {
            let constraint = self.order[place];
            if self.left_of(constraint) <= 1e-14 {
                return Err(constraint);
            }
            self.take(place, self.rank);
        }
        Ok(())
    }

    fn begin(&mut self) {
        let count = self.count();
        self.basis.clear();
        zeros(&mut self.coefficients, count * count.min(self.coordinates));
    }

    /// The rows taken, in order.
    #[must_use]
    pub fn taken(&self) -> &[usize] {
        &self.order[..self.rank]
    }

    /// The part of a taken row's length, by its place in the order, that those before it do not have: 1 where it is orthogonal
    /// to them.
    #[must_use]
    pub fn share(&self, place: usize) -> T {
        self.coefficients[place * self.count() + self.order[place]]
    }

    fn row(&self, constraint: usize) -> &[T] {
        &self.rows[constraint * self.coordinates..(constraint + 1) * self.coordinates]
    }

    /// The share of a constraint that is left: in the lane where it is least.
    fn left_of(&self, constraint: usize) -> f64 {
        let row = self.row(constraint);
        let share = |lane: usize| row.iter().map(|x| x.primal(lane).powi(2)).sum::<f64>().sqrt();
        (0..T::LANES).map(share).fold(f64::INFINITY, |least, x| if least <= x { least } else { x })
    }

    /// Takes what is left of the constraint in a place of the order out of those after it, up to `end`.
    fn take(&mut self, place: usize, end: usize) {
        let (n, count) = (self.coordinates, self.count());
        let constraint = self.order[place];
        self.basis.extend_from_slice(&self.rows[constraint * n..(constraint + 1) * n]);
        let (before, unit) = self.basis.split_at_mut(place * n);
        // Once more against those before: what is left may be little, and must still be orthogonal.
        for (l, earlier) in before.chunks_exact(n.max(1)).enumerate() {
            let part = dot(earlier, unit);
            self.coefficients[l * count + constraint] += part;
            for (x, &e) in unit.iter_mut().zip(earlier) {
                *x -= part * e;
            }
        }
        let length = dot(unit, unit).sqrt();
        let inverse = length.recip();
        for x in unit.iter_mut() {
            *x *= inverse;
        }
        self.coefficients[place * count + constraint] = length;
        for &other in &self.order[place + 1..end] {
            let row = &mut self.rows[other * n..(other + 1) * n];
            let part = dot(unit, row);
            self.coefficients[place * count + other] = part;
            for (x, &u) in row.iter_mut().zip(&*unit) {
                *x -= part * u;
            }
        }
    }

    /// q̈ from the forcing and γ: the nearest to M⁻¹f, in the metric, with G q̈ = −γ.
    pub fn accelerate(&mut self, forcing: &[T], second_rates: &[T], acceleration: &mut [T]) {
        let (n, count) = (self.coordinates, self.count());
        self.shifted.clear();
        self.shifted.extend_from_slice(forcing);
        Self::whiten(&self.factors, &self.roots, &mut self.shifted);
        zeros(&mut self.targets, self.rank);
        zeros(&mut self.along, self.rank);
        for k in 0..self.rank {
            let i = self.order[k];
            let mut target = -second_rates[i] / self.sizes[i];
            for l in 0..k {
                target -= self.coefficients[l * count + i] * self.targets[l];
            }
            target /= self.coefficients[k * count + i];
            self.targets[k] = target;
            let unit = &self.basis[k * n..(k + 1) * n];
            let change = target - dot(unit, &self.shifted);
            self.along[k] = change;
            for (x, &u) in self.shifted.iter_mut().zip(unit) {
                *x += change * u;
            }
        }
        acceleration.copy_from_slice(&self.shifted);
        self.unwhiten(acceleration);
    }

    /// The least change, in the metric, that takes these residuals (or rates) away: −M⁻¹Gᵀ (G M⁻¹Gᵀ)⁻¹ φ, by the
    /// constraints taken.
    pub fn correct(&mut self, residuals: &[T], change: &mut [T]) {
        let mut zero = core::mem::take(&mut self.scaled);
        zeros(&mut zero, change.len());
        self.accelerate(&zero, residuals, change);
        self.scaled = zero;
    }

    /// The multipliers of the last accelerations: Σ λᵢ gᵢ = f − M q̈, those of least Σ (λᵢ sᵢ)².
    ///
    /// To be called after [`choose`](Self::choose).
    ///
    /// # Errors
    /// Those of [`ldlt`].
    pub fn multiply(&mut self, multipliers: &mut [T]) -> Result<(), NumericsError> {
        let (count, rank) = (self.count(), self.rank);
        let free = count - rank;
        // R λ₁ = −w.
        self.scaled.clear();
        self.scaled.extend(self.along.iter().map(|&w| -w));
        Self::substitute(&self.coefficients, &self.order, count, &mut self.scaled);
        self.combine();
        // λ₁ = λ₁⁰ − C λ₂ is least with λ₂ for (1 + CᵀC) λ₂ = Cᵀ λ₁⁰.
        zeros(&mut self.small, free * free);
        zeros(&mut self.targets, free);
        for a in 0..free {
            let column = &self.combinations[a * rank..(a + 1) * rank];
            self.targets[a] = dot(column, &self.scaled);
            for b in a..free {
                let other = &self.combinations[b * rank..(b + 1) * rank];
                self.small[b + a * free] = dot(column, other) + if a == b { T::one() } else { T::zero() };
            }
        }
        ldlt::factor_in_place(&mut self.small, free)?;
        ldlt::solve_in_place(&self.small, free, &mut self.targets)?;
        for a in 0..free {
            for k in 0..rank {
                self.scaled[k] -= self.combinations[a * rank + k] * self.targets[a];
            }
        }
        for (place, &i) in self.order.iter().enumerate() {
            let value = if place < rank { self.scaled[place] } else { self.targets[place - rank] };
            multipliers[i] = if 0.0 < size(self.sizes[i]) { value / self.sizes[i] } else { T::zero() };
        }
        Ok(())
    }

    /// x ← R⁻¹ x for the constraints taken.
    fn substitute(coefficients: &[T], order: &[usize], count: usize, x: &mut [T]) {
        for k in (0..x.len()).rev() {
            let mut sum = x[k];
            for j in k + 1..x.len() {
                sum -= coefficients[k * count + order[j]] * x[j];
            }
            x[k] = sum / coefficients[k * count + order[k]];
        }
    }

    /// What the constraints that depend are made of, by bᵢ.
    pub fn combine(&mut self) {
        let (count, rank) = (self.count(), self.rank);
        self.combinations.clear();
        for place in rank..count {
            let i = self.order[place];
            let start = self.combinations.len();
            let coefficients = &self.coefficients;
            self.combinations.extend((0..rank).map(|k| coefficients[k * count + i]));
            Self::substitute(coefficients, &self.order, count, &mut self.combinations[start..]);
        }
    }

    /// The weights c with `gᵢ = Σ c_k g_k` for the constraint in a place of the order beyond the rank.
    ///
    /// To be called after [`combine`](Self::combine).
    #[must_use]
    pub fn combination(&self, place: usize) -> Vec<T> {
        let mut weights = vec![T::zero(); self.count()];
        let length = self.sizes[self.order[place]];
        let column = &self.combinations[(place - self.rank) * self.rank..(place - self.rank + 1) * self.rank];
        for (&i, &weight) in self.order.iter().zip(column) {
            weights[i] = weight * length / self.sizes[i];
        }
        weights
    }

    /// Factors B Bᵀ + μ for corrections by all constraints together, after [`scale`](Self::scale).
    ///
    /// μ is far above rounding, so that constraints that depend on others need no decision, and far below one,
    /// so that the corrections of a few iterations are those without it.
    ///
    /// # Errors
    /// Those of [`ldlt`].
    pub fn factor_corrections(&mut self) -> Result<(), NumericsError> {
        const MU: f64 = 1e-12;
        let count = self.count();
        zeros(&mut self.small, count * count);
        for a in 0..count {
            for b in a..count {
                let product = dot(self.row(a), self.row(b));
                self.small[b + a * count] = product;
            }
            self.small[a * (count + 1)] += T::lit(MU);
        }
        ldlt::factor_in_place(&mut self.small, count)
    }

    /// x ← S⁻¹ (B Bᵀ + μ)⁻¹ S⁻¹ x: the weights of the gradients that correct residuals x.
    ///
    /// # Errors
    /// Those of [`ldlt`].
    pub fn weigh(&self, x: &mut [T]) -> Result<(), NumericsError> {
        let scale = |x: &mut [T]| {
            for (x, &length) in x.iter_mut().zip(&self.sizes) {
                *x = if 0.0 < size(length) { *x / length } else { T::zero() };
            }
        };
        scale(x);
        ldlt::solve_in_place(&self.small, self.count(), x)?;
        scale(x);
        Ok(())
    }

    /// x ← M⁻¹ x.
    ///
    /// # Errors
    /// Those of [`ldlt`].
    pub fn solve_metric(&self, x: &mut [T]) -> Result<(), NumericsError> {
        ldlt::solve_in_place(&self.factors, self.coordinates, x)
    }
}
