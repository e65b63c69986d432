//! How vectors and matrices are written: as lists, matrices by their rows.

use nalgebra::{DMatrix, DVector, Scalar, Vector3};
use piola_numerics::Real;
use serde::de::{Deserialize, Deserializer, Error};

use crate::check::check_finite;

/// Reads three components and refuses infinite and NaN ones.
pub(crate) fn finite_vector<'de, D: Deserializer<'de>, T: Real + Deserialize<'de>>(
    deserializer: D,
) -> Result<Vector3<T>, D::Error> {
    let vector = Vector3::<T>::deserialize(deserializer)?;
    check_finite("component", vector.as_slice()).map_err(D::Error::custom)?;
    Ok(vector)
}

/// A column as a list.
pub(crate) mod column {
    use serde::{Serialize, Serializer};

    use super::{DVector, Deserialize, Deserializer, Scalar};

    pub(crate) fn serialize<N: Scalar + Serialize, S: Serializer>(
        column: &DVector<N>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        column.as_slice().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, N: Scalar + Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<DVector<N>, D::Error> {
        Ok(DVector::from_vec(Vec::deserialize(deserializer)?))
    }
}

/// A matrix as the list of its rows.
pub mod matrix {
    use serde::{Serialize, Serializer};

    use super::{DMatrix, Deserialize, Deserializer, Error, Scalar};
    use crate::check::check_length;

    /// Writes the rows.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<N: Scalar + Serialize, S: Serializer>(
        matrix: &DMatrix<N>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(matrix.row_iter().map(|row| row.iter().cloned().collect::<Vec<_>>()))
    }

    /// Reads the rows.
    ///
    /// # Errors
    /// Those of the deserializer; rows of different lengths.
    pub fn deserialize<'de, N: Scalar + Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<DMatrix<N>, D::Error> {
        let rows = Vec::<Vec<N>>::deserialize(deserializer)?;
        let columns = rows.first().map_or(0, Vec::len);
        for row in &rows {
            check_length("row of a matrix", columns, row.len()).map_err(D::Error::custom)?;
        }
        let count = rows.len();
        Ok(DMatrix::from_row_iterator(count, columns, rows.into_iter().flatten()))
    }
}
