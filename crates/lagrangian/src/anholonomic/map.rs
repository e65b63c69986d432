//! The map between velocities and quasi-velocities at a state, with its inverse and its derivatives.
//!
//! Matrices are held row after row. A slice of rows is the transposed matrix to the solvers, which store
//! columns: hence `solve_transposed_in_place` for a coframe.

use piola_numerics::linear::lu;
use piola_numerics::{Dual, NumericsError, Real};

use super::QuasiVelocities;
use crate::check::check_finite;
use crate::{AnholonomicError, LagrangianError};

/// Buffers of the map; `evaluate` comes before all else.
#[derive(Clone, Debug)]
pub(super) struct Map<T> {
    /// k_A^C at A n + C.
    pub(super) frame: Vec<T>,
    /// d^C of q̇ = k_A u^A + d.
    pub(super) drift: Vec<T>,
    /// What was given, and its factors: of the coframe always, of a frame when it is inverted.
    given: Vec<T>,
    factors: Vec<T>,
    exchanges: Vec<usize>,
    along: Vec<T>,
    moving: Vec<Dual<T>>,
    moving_rows: Vec<Dual<T>>,
    moving_drift: Vec<Dual<T>>,
}

impl<T> Default for Map<T> {
    fn default() -> Self {
        Self {
            frame: Vec::new(),
            drift: Vec::new(),
            given: Vec::new(),
            factors: Vec::new(),
            exchanges: Vec::new(),
            along: Vec::new(),
            moving: Vec::new(),
            moving_rows: Vec::new(),
            moving_drift: Vec::new(),
        }
    }
}

/// Makes `values` n zeros.
pub(super) fn zeros<T: Real>(values: &mut Vec<T>, n: usize) {
    values.clear();
    values.resize(n, T::zero());
}

/// Σ x_i y_i.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn dot<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::zero(), |sum, (&x, &y)| sum + x * y)
}

impl<T: Real> Map<T> {
    /// Frame and drift at a state.
    pub(super) fn evaluate<W: QuasiVelocities>(&mut self, map: &W, q: &[T], t: T) -> Result<(), LagrangianError> {
        let n = q.len();
        zeros(&mut self.given, n * n);
        zeros(&mut self.drift, n);
        map.matrix(q, t, &mut self.given);
        if W::DRIFT {
            map.drift(q, t, &mut self.drift);
        }
        if !W::COFRAME {
            self.frame.clone_from(&self.given);
            return Ok(());
        }
        self.factor(n)?;
        zeros(&mut self.frame, n * n);
        for (a, vector) in self.frame.chunks_exact_mut(n.max(1)).enumerate() {
            vector[a] = T::one();
            lu::solve_transposed_in_place(&self.factors, &self.exchanges, vector)?;
        }
        if W::DRIFT {
            lu::solve_transposed_in_place(&self.factors, &self.exchanges, &mut self.drift)?;
            for d in &mut self.drift {
                *d = -*d;
            }
        }
        Ok(())
    }

    /// Factors of what was given.
    fn factor(&mut self, n: usize) -> Result<(), LagrangianError> {
        self.factors.clone_from(&self.given);
        self.exchanges.clear();
        self.exchanges.resize(n, 0);
        lu::factor_in_place(&mut self.factors, &mut self.exchanges).map_err(|error| self.explain(error, n))
    }

    /// Names the combination of rows that vanishes.
    #[cold]
    fn explain(&self, error: NumericsError, n: usize) -> LagrangianError {
        if let Err(not_finite) = check_finite("frame", &self.given) {
            return not_finite;
        }
        let NumericsError::Singular { pivot: index, value: pivot, scale } = error else { return error.into() };
        // Row `index` is Σ c_i of those before it, U c = its column of U.
        let lane = (0..T::LANES)
            .find(|&lane| self.factors[index * (n + 1)].primal(lane).to_bits() == pivot.to_bits())
            .unwrap_or(0);
        let upper = |i: usize, j: usize| self.factors[i + j * n].primal(lane);
        let mut combination = vec![0.0; n];
        combination[index] = 1.0;
        for i in (0..index).rev() {
            let rest: f64 = (i + 1..=index).map(|j| upper(i, j) * combination[j]).sum();
            combination[i] = -rest / upper(i, i);
        }
        LagrangianError::Anholonomic(AnholonomicError::SingularFrame { index, pivot, scale, combination })
    }

    /// q̇ = k_A u^A + d.
    pub(super) fn velocities_into(&self, u: &[T], v: &mut [T]) {
        v.copy_from_slice(&self.drift);
        self.add_combination(u, v);
    }

    /// Adds k_A x^A.
    pub(super) fn add_combination(&self, x: &[T], out: &mut [T]) {
        for (vector, &x) in self.frame.chunks_exact(x.len().max(1)).zip(x) {
            for (out, &k) in out.iter_mut().zip(vector) {
                *out += k * x;
            }
        }
    }

    /// u of q̇.
    pub(super) fn quasi_velocities_into<W: QuasiVelocities>(
        &mut self,
        v: &[T],
        u: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = v.len();
        if W::COFRAME {
            // A (q̇ − d), with A as it was given.
            for (u, row) in u.iter_mut().zip(self.given.chunks_exact(n.max(1))) {
                *u = dot(row, v) - dot(row, &self.drift);
            }
            return Ok(());
        }
        for ((u, &v), &d) in u.iter_mut().zip(v).zip(&self.drift) {
            *u = v - d;
        }
        self.factor(n)?;
        Ok(lu::solve_in_place(&self.factors, &self.exchanges, u)?)
    }

    /// The coframe, row after row.
    pub(super) fn coframe_into<W: QuasiVelocities>(&mut self, n: usize, rows: &mut [T]) -> Result<(), LagrangianError> {
        if W::COFRAME {
            rows.copy_from_slice(&self.given);
            return Ok(());
        }
        self.factor(n)?;
        rows.fill(T::zero());
        for (a, row) in rows.chunks_exact_mut(n.max(1)).enumerate() {
            row[a] = T::one();
            lu::solve_transposed_in_place(&self.factors, &self.exchanges, row)?;
        }
        Ok(())
    }

    /// The derivatives of what was given along a direction of coordinates and time.
    pub(super) fn differentiate<W: QuasiVelocities>(&mut self, map: &W, q: &[T], t: T, (along, rate): (&[T], T)) {
        let n = q.len();
        self.moving.clear();
        self.moving.extend(q.iter().zip(along).map(|(&q, &along)| Dual::new(q, along)));
        zeros(&mut self.moving_rows, n * n);
        zeros(&mut self.moving_drift, n);
        let time = if W::TIME_DEPENDENT { Dual::new(t, rate) } else { Dual::constant(t) };
        map.matrix(&self.moving, time, &mut self.moving_rows);
        if W::DRIFT {
            map.drift(&self.moving, time, &mut self.moving_drift);
        }
    }

    /// The derivative of q̇ at fixed u along the direction of the last [`differentiate`](Self::differentiate).
    ///
    /// ```text
    /// u^A k̇_A + ḋ        or        −A⁻¹ (Ȧ q̇ + ȧ)
    /// ```
    pub(super) fn velocity_change_into<W: QuasiVelocities>(
        &self,
        u: &[T],
        v: &[T],
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = v.len();
        for (out, change) in out.iter_mut().zip(&self.moving_drift) {
            *out = change.tangent;
        }
        let rows = self.moving_rows.chunks_exact(n.max(1));
        if W::COFRAME {
            for (out, row) in out.iter_mut().zip(rows) {
                let sum = row.iter().zip(v).fold(*out, |sum, (entry, &v)| sum + entry.tangent * v);
                *out = -sum;
            }
            lu::solve_transposed_in_place(&self.factors, &self.exchanges, out)?;
        } else {
            for (row, &u) in rows.zip(u) {
                for (out, entry) in out.iter_mut().zip(row) {
                    *out += entry.tangent * u;
                }
            }
        }
        Ok(())
    }

    /// The derivative of k_A along the direction of the last [`differentiate`](Self::differentiate).
    pub(super) fn vector_rate_into<W: QuasiVelocities>(&self, a: usize, out: &mut [T]) -> Result<(), LagrangianError> {
        let n = out.len();
        let vector = &self.frame[a * n..(a + 1) * n];
        for (c, out) in out.iter_mut().enumerate() {
            *out = if W::COFRAME {
                let row = &self.moving_rows[c * n..(c + 1) * n];
                -row.iter().zip(vector).fold(T::zero(), |sum, (entry, &k)| sum + entry.tangent * k)
            } else {
                self.moving_rows[c + a * n].tangent
            };
        }
        if W::COFRAME {
            lu::solve_transposed_in_place(&self.factors, &self.exchanges, out)?;
        }
        Ok(())
    }

    /// X_AB of one A, the last direction being k_A (or the drift with time): what [k_A, k_B] is made of.
    ///
    /// A frame gives the components ∂_A k_B^C, a coframe the values −(∂_A A^C)·k_B. B = n stands for the drift.
    fn commutator_part<W: QuasiVelocities>(&self, n: usize, b: usize, c: usize) -> T {
        let with_drift = b == n;
        if W::COFRAME {
            let vector = if with_drift { &self.drift[..] } else { &self.frame[b * n..(b + 1) * n] };
            let row = &self.moving_rows[c * n..(c + 1) * n];
            let start = if with_drift { self.moving_drift[c].tangent } else { T::zero() };
            -row.iter().zip(vector).fold(start, |sum, (entry, &k)| sum + entry.tangent * k)
        } else if with_drift {
            self.moving_drift[c].tangent
        } else {
            self.moving_rows[c + b * n].tangent
        }
    }

    /// K^C_AB at C + n (B + (n + 1) A), B = n for the drift: of the map at which `evaluate` was last.
    ///
    /// ```text
    /// K^C_AB k_C = ∂_A k_B − ∂_B k_A        or        K^C_AB = −(∂_A A^C)·k_B + (∂_B A^C)·k_A      W(6.13)
    /// ```
    pub(super) fn structure_into<W: QuasiVelocities>(
        &mut self,
        map: &W,
        q: &[T],
        t: T,
        out: &mut Vec<T>,
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        let m = n + 1;
        zeros(out, n * m * m);
        let directions = if W::DRIFT || W::TIME_DEPENDENT { m } else { n };
        let mut along = core::mem::take(&mut self.along);
        for a in 0..directions {
            let rate = if a == n { T::one() } else { T::zero() };
            along.clear();
            along.extend_from_slice(if a == n { &self.drift } else { &self.frame[a * n..(a + 1) * n] });
            self.differentiate(map, q, t, (&along, rate));
            for b in 0..directions {
                for c in 0..n {
                    out[c + n * (b + m * a)] = self.commutator_part::<W>(n, b, c);
                }
            }
        }
        self.along = along;
        if !W::COFRAME {
            self.factor(n)?;
        }
        for a in 0..directions {
            for b in 0..a {
                let (ba, ab) = (n * (a + m * b), n * (b + m * a));
                for c in 0..n {
                    out[ba + c] = out[ba + c] - out[ab + c];
                }
                if !W::COFRAME {
                    lu::solve_in_place(&self.factors, &self.exchanges, &mut out[ba..ba + n])?;
                }
                for c in 0..n {
                    out[ab + c] = -out[ba + c];
                }
            }
            out[n * (a + m * a)..n * (a + m * a) + n].fill(T::zero());
        }
        Ok(())
    }
}
