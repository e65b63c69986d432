//! The tests of `piola-constitutive`.

mod golden;
