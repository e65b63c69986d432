//! A chain of masses on stiff springs with dashpots.

use core::convert::Infallible;

use piola_integrators::Field;
use piola_numerics::Real;

use super::reference::{array, numbers, read};
use super::{Equations, LONGEST_RUN, Problem, ReferenceError};

/// Masses in the chain.
const MASSES: usize = 20;

/// Twenty masses of 1 that hang one below the other, on a soft spring with stiff springs and dashpots between them:
///
/// ```text
/// ü₁ = −u₁ − u₁³ + N₁ + 1     üᵢ = Nᵢ − Nᵢ₋₁ + 1     Nᵢ = k (uᵢ₊₁ − uᵢ) + d (u̇ᵢ₊₁ − u̇ᵢ)     N₂₀ = 0
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SpringChain {
    /// k, N/m.
    pub stiffness: f64,
    /// d, N s/m.
    pub damping: f64,
}

impl SpringChain {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate_over<T: Real>(&self, y: &[T], rate: &mut [T]) {
        let (Some(&u), Some(&v)) = (y.first_chunk::<MASSES>(), y.last_chunk::<MASSES>()) else { return };
        let (k, d) = (T::lit(self.stiffness), T::lit(self.damping));
        rate[..MASSES].copy_from_slice(&v);
        let mut above = u[0] * u[0] * u[0] + u[0];
        for i in 0..MASSES {
            let below = if i + 1 < MASSES { k * (u[i + 1] - u[i]) + d * (v[i + 1] - v[i]) } else { T::zero() };
            rate[MASSES + i] = below - above + T::one();
            above = below;
        }
    }
}

impl SpringChain {
    /// Writes ∂f/∂y w, for the peers that ask for it.
    pub fn jacobian_product(&self, y: &[f64], w: &[f64], out: &mut [f64]) {
        let (Some(&u), Some(&v)) = (w.first_chunk::<MASSES>(), w.last_chunk::<MASSES>()) else { return };
        out[..MASSES].copy_from_slice(&v);
        let mut above = (3.0 * y[0] * y[0] + 1.0) * u[0];
        for i in 0..MASSES {
            let below = if i + 1 < MASSES {
                self.stiffness * (u[i + 1] - u[i]) + self.damping * (v[i + 1] - v[i])
            } else {
                0.0
            };
            out[MASSES + i] = below - above;
            above = below;
        }
    }
}

impl Equations<40> for SpringChain {
    #[inline]
    fn rate(&self, y: &[f64; 40], rate: &mut [f64; 40]) {
        self.rate_over(y, rate);
    }
}

impl<T: Real> Field<T> for SpringChain {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2 * MASSES
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        self.rate_over(y, rate);
        Ok(())
    }
}

/// The chain from rest at u = 0, ten seconds.
///
/// # Errors
/// The reference cannot be read.
pub fn spring_chain() -> Result<Problem<SpringChain, 40>, ReferenceError> {
    let data = read("stiff_chain")?;
    let one = |key: &str| numbers(&data[key]).map(|list| list.first().copied().unwrap_or(f64::NAN));
    Ok(Problem {
        name: "spring-chain",
        title: "Chain of 20 masses on stiff springs, 10 s",
        equations: SpringChain { stiffness: one("stiffness")?, damping: one("damping")? },
        start: [0.0; 40],
        end: one("end")?,
        reference: array(&numbers(&data["values"])?)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}
