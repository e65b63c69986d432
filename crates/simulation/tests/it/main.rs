//! Tests of simulated motions and wave fronts: closed forms, conservation, and the definitions of what is recorded.

mod drifts;
mod fronts;
mod mechanism;
mod media;
mod orbits;
mod timetable;
