//! Exact solutions: reference values, identities, refusals.

mod golden;
