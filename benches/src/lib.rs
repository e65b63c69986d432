//! Benchmarks of Piola beside its peers.
