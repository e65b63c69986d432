//! Vector fields in simple forms: forces, displacements and velocities.

use piola_spectral::{ModalSeries, SpectralError, Walls};

/// The form of a force per volume, a displacement or a velocity.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone, PartialEq)]
pub enum Form<const D: usize> {
    /// The same everywhere.
    Uniform {
        /// The components.
        value: [f64; D],
    },
    /// `value` exp(−r²/radius²).
    Gaussian {
        /// The components in the middle.
        value: [f64; D],
        /// The middle, m.
        at: [f64; D],
        /// The distance at which it has fallen to 1/e, m.
        radius: f64,
    },
    /// One mode.
    Mode {
        /// The amplitudes of the components.
        amplitudes: [f64; D],
        /// The indices.
        indices: [usize; D],
    },
    /// A force at a point, N, or on a line across a rectangle, N/m.
    Point {
        /// The components.
        total: [f64; D],
        /// The place, m.
        at: [f64; D],
    },
}

/// A force between two instants.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone, PartialEq)]
pub struct Load<const D: usize> {
    /// Its form.
    pub form: Form<D>,
    /// Where it begins and ends, s; always and forever when it has no time.
    pub span: [f64; 2],
    /// The coefficients of its factor in the share of its time that has passed.
    pub course: Vec<f64>,
}

/// A part of the state at the start.
///
/// # Example
/// See [`BoxStudy::run_with_checkpoints`](super::BoxStudy::run_with_checkpoints).
#[derive(Debug, Clone, PartialEq)]
pub struct Start<const D: usize> {
    /// Its form.
    pub form: Form<D>,
    /// Whether it is a velocity, m/s, and no displacement, m.
    pub is_velocity: bool,
}

/// Nodes of the quadrature beyond the highest index.
const MORE_NODES: usize = 16;
/// Nodes for each radius of a Gaussian in a side.
const NODES_A_RADIUS: f64 = 6.0;

impl<const D: usize> Form<D> {
    /// The value at a place; none of a mode or a point, which samples do not hold.
    #[must_use]
    pub fn value(&self, place: [f64; D]) -> Option<[f64; D]> {
        match self {
            Self::Uniform { value } => Some(*value),
            Self::Gaussian { value, at, radius } => {
                let squared: f64 = place.iter().zip(at).map(|(x, a)| ((x - a) / radius).powi(2)).sum();
                Some(value.map(|component| component * (-squared).exp()))
            }
            Self::Mode { .. } | Self::Point { .. } => None,
        }
    }

    /// Nodes of the quadrature along each axis, for modes up to `highest`.
    #[must_use]
    pub fn nodes(&self, sides: [f64; D], highest: [usize; D]) -> usize {
        let most = highest.into_iter().max().unwrap_or(0) + MORE_NODES;
        match self {
            Self::Uniform { .. } => most,
            Self::Gaussian { radius, .. } => {
                let longest = sides.into_iter().fold(0.0, f64::max);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "saturates, and is positive"
                )]
                let needed = (NODES_A_RADIUS * longest / radius).ceil() as usize;
                most.max(needed)
            }
            Self::Mode { .. } | Self::Point { .. } => 0,
        }
    }

    /// The modes up to `highest`.
    pub(super) fn series(
        &self,
        sides: [f64; D],
        walls: Walls,
        highest: [usize; D],
    ) -> Result<ModalSeries<D>, SpectralError> {
        match self {
            Self::Mode { amplitudes, indices } => {
                let mut series = ModalSeries::zeros(sides, walls, highest)?;
                series.set_amplitudes(*indices, *amplitudes)?;
                Ok(series)
            }
            Self::Point { total, at } => ModalSeries::of_point_force(sides, walls, highest, *at, *total),
            _ => {
                let nodes = self.nodes(sides, highest);
                ModalSeries::of_function(sides, walls, highest, nodes, |place| self.value(place).unwrap_or([0.0; D]))
            }
        }
    }
}

/// All indices up to the highest.
pub(super) fn indices<const D: usize>(highest: [usize; D]) -> impl Iterator<Item = [usize; D]> {
    (0..highest.iter().map(|index| index + 1).product()).map(move |position| {
        let mut rest: usize = position;
        let mut indices = [0; D];
        for axis in (0..D).rev() {
            indices[axis] = rest % (highest[axis] + 1);
            rest /= highest[axis] + 1;
        }
        indices
    })
}

/// The sum of series times factors.
pub(super) fn sum<const D: usize>(
    sides: [f64; D],
    walls: Walls,
    highest: [usize; D],
    parts: &[(f64, &ModalSeries<D>)],
) -> Result<ModalSeries<D>, SpectralError> {
    let mut total = ModalSeries::zeros(sides, walls, highest)?;
    for indices in indices(highest) {
        let mut amplitudes = [0.0; D];
        for (factor, part) in parts {
            for (amplitude, own) in amplitudes.iter_mut().zip(part.amplitudes(indices)) {
                *amplitude += factor * own;
            }
        }
        total.set_amplitudes(indices, amplitudes)?;
    }
    Ok(total)
}
