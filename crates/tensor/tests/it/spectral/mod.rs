//! Principal frames and functions of tensors.

mod cases;
mod derivatives;
mod functions;
mod laws;
mod traps;
mod turning;
