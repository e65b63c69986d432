//! Fields and motions over bodies, their derivatives and integrals.

pub mod integral;
