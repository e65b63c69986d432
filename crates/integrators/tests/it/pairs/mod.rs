//! Explicit pairs: conditions of order, orders, dense output, sizes known to the compiler.

mod conditions;
mod runs;
mod sizes;
