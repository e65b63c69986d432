//! Tests of the declared keys.

mod keys;
