//! Tests of documents: values with units, declared keys, settings, and every mistake at its place.

mod records;
mod units;
