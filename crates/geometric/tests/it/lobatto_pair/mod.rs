//! Lobatto's pairs: orders, what is kept, coefficients, and what goes wrong.

mod runs;
mod tableaux;
