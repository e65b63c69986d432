//! Media: laws of the refractive index.

use piola_hamiltonian::PhaseFunction;
use piola_numerics::Real;

/// A medium of refractive index n(x, y), the product of those of its parts.
///
/// # Example
/// ```
/// use piola_studies::fronts::{Medium, MediumPart};
/// let lens = Medium { parts: vec![MediumPart::Luneburg { centre: [0.0, 0.0], radius: 1.0 }] };
/// assert_eq!(lens.index([0.0, 0.0]), f64::sqrt(2.0));
/// assert_eq!(lens.index([2.0, 0.0]), 1.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Medium {
    /// The parts.
    pub parts: Vec<MediumPart>,
}

/// A part of a medium.
///
/// # Example
/// See [`Medium`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MediumPart {
    /// n = `index`.
    Uniform {
        /// The index.
        index: f64,
    },
    /// n = 1 + a exp(−r²/R²).
    Gaussian {
        /// Centre, m.
        centre: [f64; 2],
        /// R, m.
        radius: f64,
        /// a.
        amplitude: f64,
    },
    /// n = √(2 − r²/R²) for r < R, 1 outside: it brings parallel rays together on its rim.
    Luneburg {
        /// Centre, m.
        centre: [f64; 2],
        /// R, m.
        radius: f64,
    },
    /// n = n₀ + g (y − y₀).
    Layers {
        /// n₀.
        index: f64,
        /// g, 1/m.
        gradient: f64,
        /// y₀, m.
        height: f64,
    },
}

/// r²/R².
fn square<T: Real>([x, y]: [T; 2], [a, b]: [f64; 2], radius: f64) -> T {
    let (x, y) = (x - T::lit(a), y - T::lit(b));
    (x * x + y * y) * T::lit(1.0 / (radius * radius))
}

impl MediumPart {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index<T: Real>(&self, place: [T; 2]) -> T {
        match *self {
            Self::Uniform { index } => T::lit(index),
            Self::Gaussian { centre, radius, amplitude } => {
                T::one() + T::lit(amplitude) * (-square(place, centre, radius)).exp()
            }
            Self::Luneburg { centre, radius } => {
                let square = square(place, centre, radius);
                let inside = square.less_than(T::one());
                // Outside the root is taken of one, so that derivatives are finite on both sides.
                T::select(inside, T::lit(2.0) - square, T::one()).sqrt()
            }
            Self::Layers { index, gradient, height } => T::lit(index) + T::lit(gradient) * (place[1] - T::lit(height)),
        }
    }
}

impl Medium {
    /// n at a place, m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn index<T: Real>(&self, place: [T; 2]) -> T {
        let mut index = T::one();
        for part in &self.parts {
            index *= part.index(place);
        }
        index
    }
}

/// |p|/n, whose level 1 are the rays.
impl PhaseFunction for Medium {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        (p[0] * p[0] + p[1] * p[1]).sqrt() / self.index([q[0], q[1]])
    }
}
