//! Tests of documents: values with units, declared keys, settings, and every mistake at its place.

mod includes;
mod places;
mod records;
mod units;
mod varied;
