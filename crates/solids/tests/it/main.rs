//! The tests of `piola-constitutive`.

mod golden;
mod range;
mod single;
