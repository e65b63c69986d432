//! One body's motion about a centre over a time, for every conic, in universal variables.

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

/// What a time adds to a state: to be summed with compensation where steps follow each other.
///
/// # Example
/// See [`advance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment<T = f64> {
    /// x(t) − x₀, m.
    pub position: [T; 3],
    /// v(t) − v₀, m/s.
    pub velocity: [T; 3],
}

/// Moves a body about a fixed centre for a time: on an ellipse, parabola, hyperbola or straight line, from any place but the
/// centre itself.
///
/// ```text
/// β = 2μ/r₀ − v₀²      η = x₀·v₀      ζ = μ − β r₀
/// t = r₀ s + η G₂(s) + ζ G₃(s)            Kepler's equation, solved for s
/// r = r₀ + η G₁ + ζ G₂
/// x(t) − x₀ = −(μ G₂/r₀) x₀ + (t − μ G₃) v₀
/// v(t) − v₀ = −(μ G₁/(r₀ r)) x₀ − (μ G₂/r) v₀
/// Gₙ(s) = sⁿ (1/n! − βs²/(n + 2)! + (βs²)²/(n + 4)! − …)
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | μ | `parameter` | scalar | m³/s² |
/// | x₀, v₀ | `position`, `velocity` | 3 each | m, m/s |
/// | t | `time` | scalar | s |
///
/// Over `Lanes` it moves as many bodies at once; over `Dual` it carries derivatives by all arguments.
///
/// # Validity
/// 0 ≤ μ, |x₀| > 0. Whole revolutions are subtracted in the scalar's own precision: beyond ten of them
/// [`KeplerMotion`](super::KeplerMotion) keeps more digits. Arguments that are infinite or NaN give NaN.
///
/// # Accuracy
/// In `f64` some ulps of |x₀| + |v₀ t| and of their rates while |β|s² ≤ 1, which is a seventh of a revolution.
///
/// # Example
/// ```
/// use piola_gravitation::kepler::advance;
/// // Straight up at the speed of escape 2 from r = ½ about μ = 1: r^(3/2) = (½)^(3/2) + 3t/√2.
/// let up = advance(1.0, [0.0, 0.0, 0.5], [0.0, 0.0, 2.0], 0.5);
/// let expected = (0.5_f64.powf(1.5) + 1.5 / 2.0_f64.sqrt()).powf(2.0 / 3.0);
/// assert!((0.5 + up.position[2] - expected).abs() < 1e-15);
/// ```
///
/// # Source
/// K. Stumpff (1947), Astron. Nachr. 275, 108; J. M. A. Danby, *Fundamentals of Celestial Mechanics*, 2nd ed. 1988, §6.9.
#[doc(alias("universal variables", "Stumpff"))]
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn advance<T: Real>(parameter: T, position: [T; 3], velocity: [T; 3], time: T) -> Increment<T> {
    let [x, y, z] = position;
    let [u, v, w] = velocity;
    let radius = (x * x + y * y + z * z).sqrt();
    let squared_speed = u * u + v * v + w * w;
    let orbit = Orbit {
        parameter,
        radius,
        radial: x * u + y * v + z * w,
        excess: radius * squared_speed - parameter,
        energy: parameter / radius * T::lit(2.0) - squared_speed,
    };
    let [g1, g2, lag] = orbit.functions(time);
    let now = radius + (orbit.radial * g1 + orbit.excess * g2);
    let on_position = -(parameter * g2) / radius;
    let fall = -(parameter * g1) / (radius * now);
    let slowing = -(parameter * g2) / now;
    Increment {
        position: [on_position * x + lag * u, on_position * y + lag * v, on_position * z + lag * w],
        velocity: [fall * x + slowing * u, fall * y + slowing * v, fall * z + slowing * w],
    }
}

/// What Kepler's equation depends on.
#[derive(Clone, Copy)]
struct Orbit<T> {
    /// μ.
    parameter: T,
    /// r₀.
    radius: T,
    /// η = x₀·v₀.
    radial: T,
    /// ζ = μ − β r₀ = r₀v₀² − μ.
    excess: T,
    /// β, twice the energy per mass that the body lacks to escape.
    energy: T,
}

/// Beyond this |βs²| the functions are not summed by series.
const LONG: f64 = 1.0;
/// Up to this |βs²| a short series does.
const SHORT: f64 = 0.0625;
/// Halley's iteration makes of a relative error ε one of some ε³.
const SETTLED: f64 = 1e-6;

impl<T: Real> Orbit<T> {
    /// G₁, G₂ and t − μ G₃ after the time t.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn functions(&self, time: T) -> [T; 3] {
        // Kepler's equation inverted to the third order in t.
        let start = time / self.radius;
        let first = T::lit(0.5) * self.radial / self.radius * start;
        let second = T::lit(1.0 / 6.0) * self.excess / self.radius * start * start;
        let mut s = start * (T::one() - first + (T::lit(2.0) * first * first - second));
        let mut more = T::ORDER;
        for _ in 0..8 {
            let z = self.energy * s * s;
            if !z.abs().at_most(T::lit(LONG)).all() {
                break;
            }
            let g = by_series(z, s);
            let change = self.correction(s, g, time);
            if change.abs().at_most(T::lit(SETTLED) * s.abs()).all() {
                if more == 0 {
                    return self.moved(g, change, time);
                }
                // Each iteration gains one more derivative at least.
                more -= 1;
            }
            s += change;
        }
        self.functions_of_any_time(time)
    }

    /// What the time of s is too late.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn missing(&self, s: T, [_, _, g2, g3]: [T; 4], time: T) -> T {
        (self.radius * s - time) + (self.radial * g2 + self.excess * g3)
    }

    /// Halley's correction of s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correction(&self, s: T, [g0, g1, g2, g3]: [T; 4], time: T) -> T {
        let missing = self.missing(s, [g0, g1, g2, g3], time);
        let radius = self.radius + (self.radial * g1 + self.excess * g2);
        let newton = missing / radius;
        let slope = (self.radial * g0 + self.excess * g1) / radius;
        -newton / (T::one() - T::lit(0.5) * newton * slope).max(T::lit(0.5))
    }

    /// G₁, G₂ and t − μ G₃ at s + change, of the functions at s: by Taylor's series, as the change is small.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn moved(&self, [g0, g1, g2, g3]: [T; 4], change: T, time: T) -> [T; 3] {
        // The third order of a relative change below a millionth is below rounding.
        let half = T::lit(0.5) * change;
        [
            g1 + change * (g0 - half * self.energy * g1),
            g2 + change * (g1 + half * g0),
            time - self.parameter * (g3 + change * (g2 + half * g1)),
        ]
    }
}

/// G₀ to G₃ of z = βs², |z| ≤ 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn by_series<T: Real>(z: T, s: T) -> [T; 4] {
    let (c2, c3) = if z.abs().at_most(T::lit(SHORT)).all() {
        (alternating::<T, 6>(z, 2), alternating::<T, 6>(z, 3))
    } else {
        (alternating::<T, 10>(z, 2), alternating::<T, 9>(z, 3))
    };
    let square = s * s;
    [T::one() - z * c2, s * (T::one() - z * c3), square * c2, square * s * c3]
}

/// 1/n! − z/(n + 2)! + z²/(n + 4)! − …, of so many terms.
#[cfg_attr(not(debug_assertions), inline(always))]
fn alternating<T: Real, const TERMS: usize>(z: T, n: usize) -> T {
    let mut sum = T::zero();
    for term in (0..TERMS).rev() {
        let coefficient = INVERSE_FACTORIALS[n + 2 * term];
        sum = T::lit(coefficient) - z * sum;
    }
    sum
}

/// 1/k!.
const INVERSE_FACTORIALS: [f64; 21] = {
    // Up to 20! they are whole numbers of 64 bits.
    let (mut inverse, mut factorial, mut k) = ([1.0; 21], 1_u64, 1);
    while k < 21 {
        factorial *= k as u64;
        inverse[k] = 1.0 / factorial as f64;
        k += 1;
    }
    inverse
};

/// Where the short way does not lead to the root: long times, and starts from which Halley's iteration goes astray.
impl<T: Real> Orbit<T> {
    /// As `functions`, by iteration between bounds.
    #[cold]
    #[inline(never)]
    fn functions_of_any_time(&self, time: T) -> [T; 3] {
        let is_bound = T::zero().less_than(self.energy);
        // A revolution is 2π/√β in s and 2πμ/β^(3/2) in time.
        let revolution = T::lit(core::f64::consts::TAU) / self.energy.abs().sqrt();
        let period = self.parameter / self.energy * revolution;
        let turns = rounded((time / period).frozen());
        let time = T::select(is_bound, time - turns * period, time);
        // Backwards as forwards, from the opposite velocity.
        let is_past = time.less_than(T::zero());
        let orbit = Self { radial: T::select(is_past, -self.radial, self.radial), ..*self };
        let time = time.abs();
        let mut low = T::zero();
        let mut high = T::select(is_bound, revolution, time / self.radius);
        for _ in 0..2100 {
            let is_low = orbit.missing(high, functions(self.energy, high), time).less_than(T::zero());
            let grows = is_low & !is_bound;
            if !grows.any() {
                break;
            }
            low = T::select(grows, high, low);
            high = T::select(grows, high + high, high);
        }
        let half = T::lit(0.5);
        let mut s = half * (low + high);
        for _ in 0..200 {
            let g = functions(self.energy, s);
            let is_low = orbit.missing(s, g, time).less_than(T::zero());
            low = T::select(is_low, s, low);
            high = T::select(is_low, high, s);
            let next = s + orbit.correction(s, g, time);
            let is_inside = low.at_most(next) & next.at_most(high);
            let next = T::select(is_inside, next, half * (low + high));
            let is_settled = (next - s).abs().at_most(T::lit(2.0 * unit_in_last_place::<T>()) * s.abs());
            s = next;
            if is_settled.all() {
                break;
            }
        }
        for _ in 0..T::ORDER {
            s += orbit.correction(s, functions(self.energy, s), time);
        }
        let [_, g1, g2, g3] = functions(self.energy, s);
        let lag = time - self.parameter * g3;
        [T::select(is_past, -g1, g1), g2, T::select(is_past, -lag, lag)]
    }
}

/// The nearest whole number, of numbers below half the reciprocal of the unit in the last place.
fn rounded<T: Real>(x: T) -> T {
    let shift = T::lit(1.5 / unit_in_last_place::<T>());
    (x + shift) - shift
}

/// G₀ to G₃ of any s.
fn functions<T: Real>(energy: T, s: T) -> [T; 4] {
    let z = energy * s * s;
    let is_near = z.abs().at_most(T::lit(LONG));
    let near = by_series(z, s);
    if is_near.all() {
        return near;
    }
    let size = energy.abs();
    let (root, angle) = (size.sqrt(), (size.sqrt() * s));
    let (sine, _) = angle.sin_cos();
    let (half_sine, _) = (T::lit(0.5) * angle).sin_cos();
    let is_bound = T::zero().less_than(energy);
    let g1 = T::select(is_bound, sine, angle.sinh()) / root;
    let half = T::select(is_bound, half_sine, (T::lit(0.5) * angle).sinh());
    let g2 = T::lit(2.0) * half * half / size;
    let far = [T::one() - energy * g2, g1, g2, (s - g1) / energy];
    core::array::from_fn(|n| T::select(is_near, near[n], far[n]))
}
