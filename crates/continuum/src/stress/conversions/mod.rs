//! Conversions between the measures of stress: the table is in the documentation of [`stress`](crate::stress).

mod biot;
mod cauchy;
mod first_piola;
mod kirchhoff;
mod mandel;
mod second_piola;
