//! One test for each trap of the theory.
