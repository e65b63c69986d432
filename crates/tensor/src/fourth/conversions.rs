//! Fourth-order tensors to and from matrices and arrays, checked.

use nalgebra::{Matrix6, SMatrix};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::symmetry::PairSymmetric;
use super::{FourthOrder, MajorSymmetric, MinorSymmetric};
use crate::TensorError;
use crate::error::check_finite;
use crate::slots::{PAIR, Slots};

/// What a matrix is called in errors.
const QUANTITY: &str = "fourth-order tensor";

/// The first lane in which a difference is more than 32 ulp of the largest entry, with both.
fn excess<T: Real>(difference: T, scale: T) -> Option<(f64, f64)> {
    let tolerance = scale * T::lit(32.0 * unit_in_last_place::<T>());
    if difference.abs().at_most(tolerance).all() {
        return None;
    }
    let exceeds = |lane: usize| tolerance.primal(lane) < difference.primal(lane).abs();
    let lane = (0..T::LANES).find(|&lane| exceeds(lane)).unwrap_or(0);
    Some((difference.primal(lane), scale.primal(lane)))
}

fn size<T: Real>(entries: &[T]) -> T {
    entries.iter().fold(T::zero(), |size, x| size.max(x.abs()))
}

/// From 9×9 components, row 3i + j and column 3k + l; refuses infinite and NaN ones.
impl<T: Real> TryFrom<[[T; 9]; 9]> for FourthOrder<T> {
    type Error = TensorError;
    fn try_from(components: [[T; 9]; 9]) -> Result<Self, TensorError> {
        check_finite(QUANTITY, components.as_flattened())?;
        Ok(Self { components })
    }
}

impl<T> From<FourthOrder<T>> for [[T; 9]; 9] {
    fn from(tensor: FourthOrder<T>) -> Self {
        tensor.components
    }
}

/// From components over pairs, without factors for shears; refuses infinite and NaN ones.
impl<T: Real> TryFrom<Slots<T>> for MinorSymmetric<T> {
    type Error = TensorError;
    fn try_from(components: Slots<T>) -> Result<Self, TensorError> {
        check_finite(QUANTITY, components.as_flattened())?;
        Ok(Self { components })
    }
}

impl<T> From<MinorSymmetric<T>> for Slots<T> {
    fn from(tensor: MinorSymmetric<T>) -> Self {
        tensor.components
    }
}

/// From components over pairs, without factors for shears; refuses infinite and NaN ones, and those that are not
/// symmetric to 32 ulp of the largest.
impl<T: Real> TryFrom<Slots<T>> for MajorSymmetric<T> {
    type Error = TensorError;
    fn try_from(components: Slots<T>) -> Result<Self, TensorError> {
        MinorSymmetric::try_from(components)?.major_symmetric()
    }
}

impl<T: Real> From<MajorSymmetric<T>> for Slots<T> {
    fn from(tensor: MajorSymmetric<T>) -> Self {
        tensor.slots()
    }
}

impl<T: Real> From<MajorSymmetric<T>> for MinorSymmetric<T> {
    fn from(tensor: MajorSymmetric<T>) -> Self {
        tensor.minor()
    }
}

impl<T: Real> MinorSymmetric<T> {
    /// From a 6×6 matrix of components over pairs, without factors for shears.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`].
    pub fn from_matrix(matrix: &Matrix6<T>) -> Result<Self, TensorError> {
        let mut components = [[T::zero(); 6]; 6];
        for (i, row) in components.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = matrix[(i, j)];
            }
        }
        Self::try_from(components)
    }

    /// The components over pairs as a matrix.
    #[must_use]
    pub fn matrix(&self) -> Matrix6<T> {
        Matrix6::from_fn(|i, j| self.components[i][j])
    }

    /// The tensor with its major symmetry in the type, if it has it to rounding; the mean of opposite entries.
    ///
    /// # Errors
    /// [`TensorError::NotMajorSymmetric`] when two opposite entries differ by more than 32 ulp of the largest.
    pub fn major_symmetric(&self) -> Result<MajorSymmetric<T>, TensorError> {
        let c = &self.components;
        let scale = size(c.as_flattened());
        for row in 0..6 {
            for column in row + 1..6 {
                if let Some((difference, scale)) = excess(c[row][column] - c[column][row], scale) {
                    let ((i, j), (k, l)) = (PAIR[row], PAIR[column]);
                    return Err(TensorError::NotMajorSymmetric { entry: [i, j, k, l], difference, scale });
                }
            }
        }
        Ok(self.major_part())
    }
}

impl<T: Real> MajorSymmetric<T> {
    /// From a 6×6 matrix of components over pairs, without factors for shears.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`]; [`TensorError::NotMajorSymmetric`] when two opposite entries differ by
    /// more than 32 ulp of the largest.
    pub fn from_matrix(matrix: &Matrix6<T>) -> Result<Self, TensorError> {
        MinorSymmetric::from_matrix(matrix)?.major_symmetric()
    }

    /// The components over pairs as a matrix.
    #[must_use]
    pub fn matrix(&self) -> Matrix6<T> {
        self.minor().matrix()
    }
}

impl<T: Real> FourthOrder<T> {
    /// From a 9×9 matrix, row 3i + j and column 3k + l.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`].
    pub fn from_matrix(matrix: &SMatrix<T, 9, 9>) -> Result<Self, TensorError> {
        let tensor = Self::from_fn(|i, j, k, l| matrix[(3 * i + j, 3 * k + l)]);
        Self::try_from(tensor.components)
    }

    /// The components as a matrix, row 3i + j and column 3k + l.
    #[must_use]
    pub fn matrix(&self) -> SMatrix<T, 9, 9> {
        SMatrix::from_fn(|row, column| self.components[row][column])
    }

    /// The tensor with its minor symmetries in the type, if it has them to rounding.
    ///
    /// # Errors
    /// [`TensorError::NotMinorSymmetric`] when two entries that should be equal differ by more than 32 ulp of
    /// the largest.
    pub fn minor_symmetric(&self) -> Result<MinorSymmetric<T>, TensorError> {
        let scale = size(self.components.as_flattened());
        for (entry, difference) in [self.residual(|i, j, k, l| [j, i, k, l]), self.residual(|i, j, k, l| [i, j, l, k])]
        {
            if let Some((difference, scale)) = excess(difference, scale) {
                return Err(TensorError::NotMinorSymmetric { entry, difference, scale });
            }
        }
        Ok(self.minor_part())
    }
}
