//! Motion about a fixed centre in closed form.
//!
//! [`advance`] moves a body on any conic, [`KeplerMotion`] on an ellipse over many revolutions:
//!
//! ```text
//! M = M₀ + n (t − t₀)      n = √(μ/a³)      E − e sin E = M
//! x(t) = f x₀ + g v₀       f = 1 − (a/r₀)(1 − cos ΔE)      g = ΔM/n − (ΔE − sin ΔE)/n,  ΔE = E − E₀
//! ```
//!
//! # Accuracy
//! Elements follow from the state by cancellation: 1/a = 2/r₀ − v₀²/μ loses four digits at e = 0.99. They are computed
//! in twofold precision, and the mean anomaly is reduced by whole revolutions there as well, so that positions after a
//! thousand revolutions are right to a few ulps of a: the reference is that of the rounded initial state.
//!
//! # References
//! J. M. A. Danby, *Fundamentals of Celestial Mechanics*, 2nd ed. 1988, chapter 6.

mod elements;
mod motion;
mod twofold;
mod universal;

pub use elements::Elements;
pub use motion::{KeplerMotion, NotElliptic};
pub use universal::{Increment, advance};
