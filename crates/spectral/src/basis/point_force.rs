//! Green's function: the field of a force at a point.

use crate::basis::{ModalSeries, weight};
use crate::error::{SpectralError, check_finite};
use crate::operator::BoxOperator;
use crate::walls::{Parity, Walls};

impl<const D: usize> ModalSeries<D> {
    /// The modes of a force at a point, N.
    ///
    /// # Errors
    /// As of [`zeros`](Self::zeros); a place or a force that is not finite; a place outside the box.
    pub fn of_point_force(
        sides: [f64; D],
        walls: Walls,
        highest: [usize; D],
        place: [f64; D],
        force: [f64; D],
    ) -> Result<Self, SpectralError> {
        check_finite("place", &place)?;
        check_finite("force", &force)?;
        if let Some(axis) = (0..D).find(|&axis| !(0.0 <= place[axis] && place[axis] <= sides[axis])) {
            return Err(SpectralError::OutOfBounds { quantity: "place", value: place[axis], bound: "0 <= x <= L" });
        }
        let mut series = Self::zeros(sides, walls, highest)?;
        for position in 0..series.amplitudes[0].len() {
            let indices = series.indices(position);
            let q = series.wave_vector(indices);
            for component in 0..D {
                let value = (0..D).fold(force[component], |product, axis| {
                    let (sin, cos) = (q[axis] * place[axis]).sin_cos();
                    product * if walls.parity(component, axis) == Parity::Sine { sin } else { cos }
                });
                series.amplitudes[component][position] = value / weight(&sides, indices);
            }
        }
        Ok(series)
    }

    /// Green's function: column b is the displacement at `place` under a unit force at `source` along axis b, m/N.
    ///
    /// ```text
    /// G(x, y) = Σ φ(x) φ(y)ᵀ/(−κ) = G(y, x)ᵀ
    /// ```
    /// The sum over 0 ≤ i ≤ `highest` is the field of a force that is spread over a distance of some L/N. At a distance r from
    /// the source the rest of the sum falls with N and oscillates.
    ///
    /// # Errors
    /// As of [`of_point_force`](Self::of_point_force).
    #[doc(alias = "Kelvin solution")]
    pub fn green_function(
        sides: [f64; D],
        walls: Walls,
        highest: [usize; D],
        operator: &BoxOperator,
        place: [f64; D],
        source: [f64; D],
    ) -> Result<[[f64; D]; D], SpectralError> {
        let mut rows = [[0.0; D]; D];
        for column in 0..D {
            let mut force = [0.0; D];
            force[column] = 1.0;
            let field = Self::of_point_force(sides, walls, highest, source, force)?.solved(operator);
            let value = field.value(place)?;
            for row in 0..D {
                rows[row][column] = value[row];
            }
        }
        Ok(rows)
    }
}
