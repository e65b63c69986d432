//! Tests of ensembles: closed forms, the same bytes in any way of computing them, and what is refused.

mod journal;
mod laws;
mod once;
#[cfg(feature = "parquet")]
mod parquet;
mod ranks;
