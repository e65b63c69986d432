//! Conversions to and from glam: matrices of stresses, vectors of normals.
//!
//! glam stores columns; nothing is transposed for the reader: entry (i, j) stays entry (i, j).

use glam::{DMat3, DVec3, Mat3, Vec3};
use nalgebra::{Matrix3, Vector3};

use super::{
    BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, ReferenceNormal, SecondPiola, UnitNormal,
};
use crate::ContinuumError;

macro_rules! between {
    ($name:ident, |$found:ident| $made:expr, $scalar:ident, $matrix:ident) => {
        impl From<$name<$scalar>> for $matrix {
            fn from(stress: $name<$scalar>) -> Self {
                Self::from_cols_array_2d(&stress.rows()).transpose()
            }
        }
        impl TryFrom<$matrix> for $name<$scalar> {
            type Error = ContinuumError;
            fn try_from(matrix: $matrix) -> Result<Self, ContinuumError> {
                let $found = Matrix3::from_column_slice(&matrix.to_cols_array());
                $made
            }
        }
    };
}

macro_rules! measures {
    (symmetric $($name:ident),*) => {
        $(
            between!($name, |matrix| Self::from_matrix(&matrix), f64, DMat3);
            between!($name, |matrix| Self::from_matrix(&matrix), f32, Mat3);
        )*
    };
    (general $($name:ident),*) => {
        $(
            between!($name, |matrix| Self::new(matrix), f64, DMat3);
            between!($name, |matrix| Self::new(matrix), f32, Mat3);
        )*
    };
}

measures!(symmetric CauchyStress, KirchhoffStress, SecondPiola);
measures!(general FirstPiola, BiotStress, MandelStress);

macro_rules! normals {
    ($name:ident, $scalar:ident, $vector:ident) => {
        impl From<$name<$scalar>> for $vector {
            fn from(normal: $name<$scalar>) -> Self {
                Self::from_array(normal.components())
            }
        }
        impl TryFrom<$vector> for $name<$scalar> {
            type Error = ContinuumError;
            fn try_from(vector: $vector) -> Result<Self, ContinuumError> {
                Self::new(Vector3::from(vector.to_array()))
            }
        }
    };
}

normals!(UnitNormal, f64, DVec3);
normals!(UnitNormal, f32, Vec3);
normals!(ReferenceNormal, f64, DVec3);
normals!(ReferenceNormal, f32, Vec3);
