//! Principal frames and functions of tensors.

mod cases;
mod derivatives;
mod laws;
mod traps;
