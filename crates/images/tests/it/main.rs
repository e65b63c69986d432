//! Files of images from outside: what comes back, what is refused, what other programs read.

mod damaged;
mod fields;
mod fixtures;
mod foreign;
mod fuzz;
mod headers;
mod orientations;
mod real;
mod round_trips;
