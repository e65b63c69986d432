//! Identities that hold for all inputs, named by their two sides.
