//! Whether two planets certainly stay further apart than a distance while each moves along an arc of Kepler's motion.
//!
//! An arc is compared with two simple curves. The chord is run through at constant velocity from one end of the arc to the other.
//! The cubic agrees with the arc in the positions and velocities of both ends. After a time τ along the arc:
//!
//! ```text
//! |x(t) − chord(t)| ≤ τ²/8 max|ẍ|              |x(t) − cubic(t)| ≤ τ⁴/384 max|x⁗|
//! |ẍ| = μ/r²                                  |x⁗| ≤ 2μ²/r⁵ + 6μ v²/r⁴
//! ```
//!
//! The difference of two cubics is a cubic again. Its control points in Bézier's form bound its distance from the origin. Where
//! that bound does not decide, the cubic is halved, and each half is examined in the same way.

use core::f64::consts::PI;

type Vector = [f64; 3];

/// Halvings after which two planets count as near each other.
const MOST_HALVINGS: u32 = 12;

/// An arc of Kepler's motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Arc {
    /// Places at both ends, m.
    places: [Vector; 2],
    /// Velocities at both ends, m/s.
    velocities: [Vector; 2],
    /// Gm of the centre.
    mu: f64,
    /// The square of the least distance from the centre on the arc, m².
    nearest_squared: f64,
    /// Bound of |ẍ| on the arc, m/s².
    acceleration: f64,
    /// How far the planet is from the arc at most, m.
    pub(super) excursion: f64,
}

impl Arc {
    /// The arc about a centre of Gm = μ between two states, a time apart.
    pub(super) fn new(mu: f64, places: [Vector; 2], velocities: [Vector; 2], time: f64) -> Self {
        let [r_squared, end_squared] = places.map(|x| dot(x, x));
        let mut nearest_squared = r_squared.min(end_squared);
        let [first, last] = [0, 1].map(|end| dot(places[end], velocities[end]) * time);
        let passes = first <= 0.0 && 0.0 <= last;
        // The semi-major axis is at least half of any distance, so half a revolution lasts at least π √(r³/8μ).
        let is_short = 8.0 * mu * time * time < PI * PI * r_squared * r_squared.sqrt();
        if passes || !is_short {
            nearest_squared = nearest_squared.min(pericentre(mu, places[0], velocities[0]).powi(2));
        }
        let acceleration = mu / nearest_squared;
        Self { places, velocities, mu, nearest_squared, acceleration, excursion: 0.0 }
    }

    /// The least distance from the centre on the arc, m.
    pub(super) fn nearest(&self) -> f64 {
        self.nearest_squared.sqrt()
    }

    /// Bound of |x⁗| on the arc, m/s⁴.
    fn snap(&self) -> f64 {
        let nearest = self.nearest();
        let energy = 2.0 * self.mu / length(self.places[0]) - dot(self.velocities[0], self.velocities[0]);
        let fastest_squared = (2.0 * self.mu / nearest - energy).max(0.0);
        (2.0 * self.acceleration + 6.0 * fastest_squared / nearest) * self.acceleration / nearest
    }

    /// Place and velocity at the start.
    pub(super) fn start(&self) -> [Vector; 2] {
        [self.places[0], self.velocities[0]]
    }

    /// Whether two planets certainly stay further apart than a distance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn is_clear_of(&self, other: &Self, time: f64, distance: f64) -> bool {
        let distance = distance + self.excursion + other.excursion;
        let ends = [0, 1].map(|end| minus(other.places[end], self.places[end]));
        let sag = 0.125 * time * time * (self.acceleration + other.acceleration);
        is_chord_clear(ends, distance + sag) || self.is_cubic_clear_of(other, time, distance, ends)
    }

    #[cold]
    #[inline(never)]
    fn is_cubic_clear_of(&self, other: &Self, time: f64, distance: f64, ends: [Vector; 2]) -> bool {
        let third = time / 3.0;
        let handles = [0, 1].map(|end| minus(other.velocities[end], self.velocities[end]).map(|u| third * u));
        let cubic = [ends[0], plus(ends[0], handles[0]), minus(ends[1], handles[1]), ends[1]];
        let error = time.powi(4) / 384.0 * (self.snap() + other.snap());
        is_clear(cubic, distance + error, MOST_HALVINGS)
    }
}

/// Whether a cubic certainly stays further from the origin than a distance.
fn is_clear(points: [Vector; 4], distance: f64, halvings: u32) -> bool {
    let [a, b, c, d] = points;
    let chord = minus(d, a);
    // How far the cubic is from the point that moves evenly along the chord: at most ¾ of the control points' own distance.
    let sags =
        [(b, 1.0 / 3.0), (c, 2.0 / 3.0)].map(|(point, part)| length(minus(point, plus(a, chord.map(|x| part * x)))));
    if is_chord_clear([a, d], distance + 0.75 * sags[0].max(sags[1])) {
        return true;
    }
    // What is NaN is not clear.
    let may_be_clear = distance < length(a).min(length(d));
    if halvings == 0 || !may_be_clear {
        return false;
    }
    let [ab, bc, cd] = [middle(a, b), middle(b, c), middle(c, d)];
    let [abc, bcd] = [middle(ab, bc), middle(bc, cd)];
    let centre = middle(abc, bcd);
    is_clear([a, ab, abc, centre], distance, halvings - 1) && is_clear([centre, bcd, cd, d], distance, halvings - 1)
}

/// Whether a straight line between two points stays further from the origin than a distance.
fn is_chord_clear([a, b]: [Vector; 2], distance: f64) -> bool {
    let (along, square) = (minus(b, a), distance * distance);
    if 0.0 <= dot(a, along) {
        return square < dot(a, a);
    }
    if dot(b, along) <= 0.0 {
        return square < dot(b, b);
    }
    // Twice the area of the triangle over its base.
    let moment = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    square * dot(along, along) < dot(moment, moment)
}

/// The least distance from the centre on a whole orbit.
#[cold]
fn pericentre(mu: f64, x: Vector, v: Vector) -> f64 {
    let (r, squared_speed, radial) = (length(x), dot(v, v), dot(x, v));
    // 2μ/r − v² = μ/a, and the squared angular momentum by Lagrange's identity.
    let energy = 2.0 * mu / r - squared_speed;
    let moment = (r * r * squared_speed - radial * radial).max(0.0);
    moment / (mu * (1.0 + (1.0 - energy * moment / (mu * mu)).max(0.0).sqrt()))
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn middle(a: Vector, b: Vector) -> Vector {
    plus(a, b).map(|x| 0.5 * x)
}

#[cfg(test)]
mod tests {
    use super::{Arc, length, minus};
    use crate::kepler::advance;

    /// Compares `is_clear_of` with the least distance at 1001 times, for 4000 random pairs of arcs. Every pair that it calls clear
    /// stays further apart than the distance; fewer than 200 clear pairs are not recognised.
    #[test]
    fn clear_arcs_are_those_that_stay_apart() {
        let mut counts = [0; 2];
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 8) / f64::from(1 << 24) - 0.5
        };
        for _ in 0..4000 {
            let states: [[[f64; 3]; 2]; 2] = core::array::from_fn(|_| {
                let x = [1.0 + 0.5 * random(), 0.5 * random(), 0.1 * random()];
                [x, [1.2 * random(), 1.0 + 0.5 * random(), 0.2 * random()]]
            });
            let time = 1.5 * random();
            let place = |[x, v]: [[f64; 3]; 2], t: f64| {
                let by = advance(1.0, x, v, t);
                [[0, 1, 2].map(|i| x[i] + by.position[i]), [0, 1, 2].map(|i| v[i] + by.velocity[i])]
            };
            let arcs = states.map(|state| {
                let [x, v] = place(state, time);
                Arc::new(1.0, [state[0], x], [state[1], v], time)
            });
            let looks = (0..=1000).map(|part| {
                let t = time * f64::from(part) / 1000.0;
                length(minus(place(states[1], t)[0], place(states[0], t)[0]))
            });
            let least = looks.fold(f64::INFINITY, f64::min);
            let distance = 0.3 * (random() + 0.5);
            if arcs[0].is_clear_of(&arcs[1], time, distance) {
                assert!(distance < least, "{states:?} in {time}: {least} is not beyond {distance}");
                counts[0] += 1;
            } else if distance < least {
                counts[1] += 1;
            }
        }
        // Counts: found clear; clear but not found.
        assert!(2000 < counts[0] && counts[1] < 200, "{counts:?}");
    }
}
