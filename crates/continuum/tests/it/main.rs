//! The tests of `piola-continuum`.
