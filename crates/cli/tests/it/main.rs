//! The program from outside: arguments, exit codes, what goes to which stream, what is written.

mod boxes;
mod end_to_end;
mod explain;
mod hostile;
mod includes;
mod intervals;
mod measurements;
mod register;
mod rendering;
mod resume;
mod sweeps;
