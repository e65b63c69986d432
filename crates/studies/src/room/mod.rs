//! The first arrival of a signal in a room.
//!
//! ```text
//! |∇u| v(x) = 1,    x′ = v² ξ,    u′ = 1        Φ(x, u, ξ) = ½(v² ξ·ξ − 1)                  W(A.38)
//! ```
//!
//! The parameter of the characteristics is the time of arrival itself.

mod run;

pub use run::{Arrivals, LossOfInvertibility};

use piola_characteristics::{FirstOrderPde, InitialManifold};
use piola_numerics::Real;

/// A room, the speed of a signal in it, and where it starts.
///
/// # Example
/// A signal from the wall of an elliptic room at 2 m/s everywhere: characteristics first cross at the tips of the evolute.
/// ```
/// use piola_studies::room::{Outline, Room, Speed};
/// use std::ops::ControlFlow;
/// let outline = Outline { centre: [0.0; 2], semi_axes: [1.0, 0.8], exponent: 2 };
/// let speed = Speed { at_origin: 2.0, gradient: [0.0; 2] };
/// let room = Room { outline, speed, circle: None, resolution: 0.01, grid: 21 };
/// let (found, _) = room.run(&mut |_| ControlFlow::Continue(()));
/// // The least radius of curvature of the ellipse, b²/a, over the speed.
/// assert!((found.first_loss.unwrap().time - 0.32).abs() < 1e-6);
/// ```
#[derive(Debug, Clone)]
pub struct Room {
    /// The wall.
    pub outline: Outline,
    /// The speed.
    pub speed: Speed,
    /// A circle on which the signal starts; the wall when there is none.
    pub circle: Option<Outline>,
    /// Largest error of interpolation, m.
    pub resolution: f64,
    /// Points of the grid along the longer axis, at least two.
    pub grid: u32,
}

/// A closed curve: (x/a)ⁿ + (y/b)ⁿ = 1 about its centre.
///
/// # Example
/// See [`Room`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// The centre, m.
    pub centre: [f64; 2],
    /// a and b, m.
    pub semi_axes: [f64; 2],
    /// n, even.
    pub exponent: i32,
}

/// v = v₀ + g·x.
///
/// # Example
/// See [`Room`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speed {
    /// v₀, m/s.
    pub at_origin: f64,
    /// g, 1/s.
    pub gradient: [f64; 2],
}

impl Outline {
    /// Less than one inside.
    #[must_use]
    pub fn level(&self, place: [f64; 2]) -> f64 {
        (0..2).map(|k| ((place[k] - self.centre[k]) / self.semi_axes[k]).powi(self.exponent)).sum()
    }

    /// The place of an angle τ.
    pub fn place<T: Real>(&self, angle: T) -> [T; 2] {
        let (sine, cosine) = angle.sin_cos();
        let stretch = if self.exponent == 2 {
            T::one()
        } else {
            (cosine.powi(self.exponent) + sine.powi(self.exponent)).powf(T::lit(-1.0 / f64::from(self.exponent)))
        };
        let [x, y] = self.centre;
        let [a, b] = self.semi_axes;
        [T::lit(x) + T::lit(a) * stretch * cosine, T::lit(y) + T::lit(b) * stretch * sine]
    }
}

impl Speed {
    /// v at a place.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn at<T: Real>(&self, [x, y]: [T; 2]) -> T {
        T::lit(self.at_origin) + T::lit(self.gradient[0]) * x + T::lit(self.gradient[1]) * y
    }
}

impl FirstOrderPde for Speed {
    fn value<T: Real>(&self, x: &[T], _u: T, xi: &[T]) -> T {
        let speed = self.at([x[0], x[1]]);
        T::lit(0.5) * (speed * speed * (xi[0] * xi[0] + xi[1] * xi[1]) - T::one())
    }
}

impl InitialManifold for Outline {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        [x[0], x[1]] = Outline::place(self, tau[0]);
        T::zero()
    }
}

impl Room {
    /// Least speed in the rectangle around the room, m/s.
    #[must_use]
    pub fn least_speed(&self) -> f64 {
        let [a, b] = self.outline.semi_axes;
        let [g, h] = self.speed.gradient;
        self.speed.at_origin - g.abs() * a - h.abs() * b
    }

    /// The first loss of invertibility in closed form: the smallest radius of curvature of an ellipse, over the speed.
    #[must_use]
    pub fn closed_form_of_first_loss(&self) -> Option<f64> {
        let start = self.circle.unwrap_or(self.outline);
        let even = self.speed.gradient.iter().all(|g| g.abs() <= 0.0);
        let [a, b] = start.semi_axes;
        (even && start.exponent == 2).then(|| a.min(b).powi(2) / a.max(b) / self.speed.at_origin)
    }
}
