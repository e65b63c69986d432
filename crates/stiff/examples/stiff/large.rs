//! Large stiff systems in which each rate depends on few components: a chain of springs, diffusion on a line and on a grid.

use core::convert::Infallible;

use piola_integrators::Field;
use piola_numerics::Real;

/// Masses of 1 that hang one below the other, on a soft spring with stiff springs and dashpots between them, in gravity 1:
///
/// ```text
/// ü₁ = −u₁ − u₁³ + N₁ + 1     üᵢ = Nᵢ − Nᵢ₋₁ + 1     Nᵢ = 10⁶ (uᵢ₊₁ − uᵢ) + 10³ (u̇ᵢ₊₁ − u̇ᵢ)     N_n = 0
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chain {
    /// The number of masses, n: y = (u, u̇).
    pub(crate) masses: usize,
}
impl<T: Real> Field<T> for Chain {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2 * self.masses
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let n = self.masses;
        let (u, v) = y.split_at(n);
        rate[..n].copy_from_slice(v);
        let mut above = u[0] * u[0] * u[0] + u[0];
        for i in 0..n {
            let below =
                if i + 1 < n { T::lit(1e6) * (u[i + 1] - u[i]) + T::lit(1e3) * (v[i + 1] - v[i]) } else { T::zero() };
            rate[n + i] = below - above + T::one();
            above = below;
        }
        Ok(())
    }
}

/// Diffusion with a reaction on a square of n×n points between walls at zero, or on a line of n points:
///
/// ```text
/// u̇ = Δu + u (1 − u),    Δu = (n + 1)² (Σ neighbours − 4 u)  or  (n + 1)² (left + right − 2 u)
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Diffusion {
    /// Points along a side, n.
    pub(crate) side: usize,
    /// The number of rows: n for a square, 1 for a line.
    pub(crate) rows: usize,
}

impl Diffusion {
    /// A hump in the middle.
    pub(crate) fn start(&self) -> Vec<f64> {
        let place = |k: usize, n: usize| (k + 1) as f64 / (n + 1) as f64;
        let hump = |x: f64| 4.0 * x * (1.0 - x);
        let value = |i: usize, j: usize| {
            hump(place(i, self.side)) * if self.rows == 1 { 1.0 } else { hump(place(j, self.rows)) }
        };
        (0..self.rows).flat_map(|j| (0..self.side).map(move |i| (i, j))).map(|(i, j)| value(i, j)).collect()
    }
}

impl<T: Real> Field<T> for Diffusion {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        self.side * self.rows
    }
    fn rate(&mut self, _t: f64, u: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (n, zero) = (self.side, T::zero());
        let conduction = T::lit(((n + 1) * (n + 1)) as f64);
        for j in 0..self.rows {
            for i in 0..n {
                let k = i + j * n;
                let mut flow = -u[k] - u[k];
                flow += if i == 0 { zero } else { u[k - 1] };
                flow += if i + 1 == n { zero } else { u[k + 1] };
                if 1 < self.rows {
                    flow -= u[k] + u[k];
                    flow += if j == 0 { zero } else { u[k - n] };
                    flow += if j + 1 == self.rows { zero } else { u[k + n] };
                }
                rate[k] = conduction * flow + u[k] * (T::one() - u[k]);
            }
        }
        Ok(())
    }
}
