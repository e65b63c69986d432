//! Which arcs there are, by Lambert's theorem in the form of Lancaster and Blanchard, with μ = 1.
//!
//! ```text
//! T = √(2/s³) t,   2s = r₀ + r₁ + c,   λ = ±√(1 − c/s)
//! T(x) = ((ψ + Nπ)/√|1 − x²| − x + λy)/(1 − x²),   y = √(1 − λ²(1 − x²)),   cos ψ = xy + λ(1 − x²)
//! v_r = √(s/2) ((λy − x) − ρ(λy + x))/r₀,   v_t = √(s/2) √(1 − ρ²) (y + λx)/r₀,   ρ = (r₀ − r₁)/c
//! ```
//! For each sense of the motion there is one arc without a full revolution and two of N revolutions when T exceeds the least
//! of T(x), −1 < x < 1 (E. R. Lancaster and R. C. Blanchard, NASA TN D-5368 (1969)).

/// Arcs of more revolutions are not sought.
pub(super) const MOST_REVOLUTIONS: u32 = 49;
/// Halvings of an interval.
const HALVINGS: u32 = 200;

/// An arc: its velocity at the first event, along the radius and across it in the sense of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seed {
    /// Whether it goes the short way round.
    pub(super) direct: bool,
    pub(super) radial: f64,
    pub(super) transverse: f64,
}

/// T of N revolutions; cosh for cos beyond the parabola x = 1.
fn time(x: f64, lambda: f64, revolutions: f64) -> f64 {
    let square = 1.0 - x * x;
    let y = (1.0 - lambda * lambda * square).sqrt();
    let cosine = x * y + lambda * square;
    let psi = if x < 1.0 { cosine.clamp(-1.0, 1.0).acos() } else { cosine.max(1.0).acosh() };
    ((psi + revolutions * core::f64::consts::PI) / square.abs().sqrt() - x + lambda * y) / square
}

/// Where T of N > 0 revolutions is least, by golden section: it is convex.
fn least(lambda: f64, revolutions: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (-1.0 + 1e-9, 1.0 - 1e-9);
    for _ in 0..100 {
        let (a, b) = (high - SHARE * (high - low), low + SHARE * (high - low));
        if time(a, lambda, revolutions) < time(b, lambda, revolutions) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}

/// x with T(x) = T, between a place where T(x) is longer and one where it is shorter.
fn solve((mut longer, mut shorter): (f64, f64), lambda: f64, revolutions: f64, duration: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (longer + shorter);
        *(if duration < time(middle, lambda, revolutions) { &mut longer } else { &mut shorter }) = middle;
    }
    0.5 * (longer + shorter)
}

/// s, √(2/s³) by which a time is reduced, and |λ|.
fn shape(from: f64, to: f64, chord: f64) -> (f64, f64, f64) {
    let half = 0.5 * (from + to + chord);
    (half, (2.0 / (half * half * half)).sqrt(), (1.0 - chord / half).max(0.0).sqrt())
}

/// The time from which on there are arcs of more than [`MOST_REVOLUTIONS`].
pub(super) fn longest(from: f64, to: f64, chord: f64) -> f64 {
    let (_, scale, size) = shape(from, to, chord);
    let next = f64::from(MOST_REVOLUTIONS + 1);
    let shortest = |lambda: f64| time(least(lambda, next), lambda, next);
    shortest(size).min(shortest(-size)) / scale
}

/// All arcs between two distances with a chord after a time, of at most [`MOST_REVOLUTIONS`].
pub(super) fn arcs(from: f64, to: f64, chord: f64, duration: f64) -> Vec<Seed> {
    let (half, scale, size) = shape(from, to, chord);
    let reduced = scale * duration;
    let ratio = (from - to) / chord;
    let mut seeds = Vec::new();
    for (direct, lambda) in [(true, size), (false, -size)] {
        let mut found = vec![solve((-1.0 + 1e-9, 1e6), lambda, 0.0, reduced)];
        for revolutions in (1..=MOST_REVOLUTIONS).map(f64::from) {
            let middle = least(lambda, revolutions);
            if reduced <= time(middle, lambda, revolutions) {
                break;
            }
            for end in [-1.0 + 1e-12, 1.0 - 1e-12] {
                found.push(solve((end, middle), lambda, revolutions, reduced));
            }
        }
        for x in found {
            let y = (1.0 - lambda * lambda * (1.0 - x * x)).sqrt();
            let unit = (0.5 * half).sqrt() / from;
            seeds.push(Seed {
                direct,
                radial: unit * ((lambda * y - x) - ratio * (lambda * y + x)),
                transverse: unit * (1.0 - ratio * ratio).max(0.0).sqrt() * (y + lambda * x),
            });
        }
    }
    seeds
}

#[cfg(test)]
mod tests {
    use super::{MOST_REVOLUTIONS, arcs, longest};

    #[test]
    fn quarter_of_a_circle_in_its_own_time_is_one_of_two_arcs() {
        let chord = core::f64::consts::SQRT_2;
        let found = arcs(1.0, 1.0, chord, core::f64::consts::FRAC_PI_2);
        assert_eq!(found.len(), 2);
        assert!(found[0].direct && found[0].radial.abs() < 1e-12 && (found[0].transverse - 1.0).abs() < 1e-12);
        // A turn later the circle is there again.
        let later = arcs(1.0, 1.0, chord, 2.5 * core::f64::consts::PI);
        assert!(later.iter().any(|seed| seed.radial.abs() < 1e-9 && (seed.transverse - 1.0).abs() < 1e-9));
    }

    #[test]
    fn arcs_of_fifty_revolutions_begin_at_the_longest_time() {
        let chord = core::f64::consts::SQRT_2;
        let most = 2 + 4 * MOST_REVOLUTIONS as usize;
        let longest = longest(1.0, 1.0, chord);
        // s = 1 + 1/√2: the ellipses of fifty turns that take the least time are a little larger than a = s/2.
        let period = core::f64::consts::TAU * (0.5 + 0.5 * core::f64::consts::FRAC_1_SQRT_2).powf(1.5);
        assert!(50.0 * period < longest && longest < 51.0 * period, "{longest}");
        assert!(arcs(1.0, 1.0, chord, longest * (1.0 - 1e-9)).len() <= most);
        assert_eq!(arcs(1.0, 1.0, chord, f64::INFINITY).len(), most);
    }
}
