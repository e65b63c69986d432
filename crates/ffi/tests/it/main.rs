//! The interface of C, the materials of Abaqus, and what both refuse.

#![expect(clippy::float_cmp, reason = "the same bits from every language, and numbers that are exact")]

mod abaqus;
mod alloc;
mod bad_input;
mod c_program;
mod flows;
mod fortran;
mod header;
#[cfg(feature = "history")]
mod history;
#[cfg(feature = "history")]
mod history_abaqus;
mod named;
mod points;
mod programs;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
