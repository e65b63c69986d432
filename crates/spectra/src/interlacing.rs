//! Zeros of a sum of simple fractions: one between each two neighbouring poles.
//!
//! ```text
//! F(x) = c − d/x + Σ wⱼ pⱼ/(pⱼ − x)      rises from each pole to the next, for 0 ≤ c, 0 ≤ d, 0 < wⱼ
//! ```
//! A zero x gives the mode 1/(x F′(x)). The same sum converts both ways:
//!
//! | from | x | pⱼ | wⱼ | c | d |
//! |---|---|---|---|---|---|
//! | relaxation | λ | τⱼ | gⱼ | Gₑ | 0 |
//! | retardation | 1/τ | 1/λⱼ | Jⱼ | `J_g` | 1/η₀ |
//!
//! A zero is kept as its distance from the nearer pole, so that no difference of near numbers is formed.

/// What stands on the axis of x.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    /// The times of the modes.
    Times,
    /// Their inverses.
    Rates,
}

/// The sum F: modes (weight, time) in the order of their poles.
pub(crate) struct Fractions<'m> {
    pub(crate) axis: Axis,
    pub(crate) modes: &'m [[f64; 2]],
    pub(crate) constant: f64,
    pub(crate) drift: f64,
}

/// A place x = pᵢ (base + z).
#[derive(Clone, Copy)]
struct Place {
    pole: usize,
    /// 1 at a pole, 0 at x = 0.
    base: f64,
    offset: f64,
}

impl Fractions<'_> {
    fn time(&self, j: usize) -> f64 {
        self.modes[j][1]
    }

    /// pᵢ/pⱼ.
    fn ratio(&self, i: usize, j: usize) -> f64 {
        match self.axis {
            Axis::Times => self.time(i) / self.time(j),
            Axis::Rates => self.time(j) / self.time(i),
        }
    }

    /// (pⱼ − pᵢ)/pⱼ.
    fn gap(&self, i: usize, j: usize) -> f64 {
        let difference = self.time(j) - self.time(i);
        match self.axis {
            Axis::Times => difference / self.time(j),
            Axis::Rates => -difference / self.time(i),
        }
    }

    /// d/x.
    fn drifting(&self, at: Place) -> f64 {
        let scaled = match self.axis {
            Axis::Times => self.drift / self.time(at.pole),
            Axis::Rates => self.drift * self.time(at.pole),
        };
        scaled / (at.base + at.offset)
    }

    /// pᵢ/pⱼ and (pⱼ − x)/pⱼ.
    fn distance(&self, at: Place, j: usize) -> [f64; 2] {
        let ratio = self.ratio(at.pole, j);
        let first = if 0.0 < at.base { self.gap(at.pole, j) } else { 1.0 };
        [ratio, first - ratio * at.offset]
    }

    /// Whether F(x) < 0.
    fn is_below(&self, at: Place) -> bool {
        let terms = (0..self.modes.len()).map(|j| self.modes[j][0] / self.distance(at, j)[1]);
        terms.sum::<f64>() + self.constant < self.drifting(at)
    }

    /// The mode of a zero: 1/(x F′(x)) and its time.
    fn mode(&self, at: Place) -> [f64; 2] {
        let x = at.base + at.offset;
        let slope = |j: usize| {
            let [ratio, distance] = self.distance(at, j);
            self.modes[j][0] * (ratio * x / distance) / distance
        };
        let slope = (0..self.modes.len()).map(slope).sum::<f64>() + self.drifting(at);
        let time = self.time(at.pole);
        [slope.recip(), if self.axis == Axis::Times { time * x } else { time / x }]
    }

    /// The zero whose distance from a place is between 0 and `farthest`; F rises with the sign of `direction`.
    fn zero(&self, pole: usize, base: f64, direction: f64, farthest: f64) -> [f64; 2] {
        let at = |distance: f64| Place { pole, base, offset: direction * distance };
        let is_short = |distance: f64| self.is_below(at(distance)) == (0.0 < direction);
        self.mode(at(bisected(f64::MIN_POSITIVE, farthest, &is_short)))
    }

    /// The modes of all zeros, in the order of x.
    pub(crate) fn zeros(&self) -> Vec<[f64; 2]> {
        let mut found = Vec::with_capacity(self.modes.len() + 1);
        let last = self.modes.len().wrapping_sub(1);
        if self.modes.is_empty() {
            // c = d/x.
            let x = self.drift / self.constant;
            if 0.0 < x {
                found.push([self.constant.recip(), if self.axis == Axis::Times { x } else { x.recip() }]);
            }
            return found;
        }
        if 0.0 < self.drift {
            // Between 0 and the first pole.
            let middle = Place { pole: 0, base: 0.0, offset: 0.5 };
            found.push(if self.is_below(middle) { self.zero(0, 1.0, -1.0, 0.5) } else { self.zero(0, 0.0, 1.0, 0.5) });
        }
        for next in 1..=last {
            // Half the gap, over each of its ends.
            let (above, below) = (-0.5 * self.gap(next, next - 1), 0.5 * self.gap(next - 1, next));
            let middle = Place { pole: next - 1, base: 1.0, offset: above };
            found.push(if self.is_below(middle) {
                self.zero(next, 1.0, -1.0, below)
            } else {
                self.zero(next - 1, 1.0, 1.0, above)
            });
        }
        if 0.0 < self.constant {
            // Beyond the last pole each fraction is at most wⱼ/z.
            let sum: f64 = self.modes.iter().map(|mode| mode[0]).sum();
            let farthest = (sum / self.constant
                + self.drifting(Place { pole: last, base: 1.0, offset: 0.0 }) / self.constant)
                .min(f64::MAX);
            found.push(self.zero(last, 1.0, 1.0, farthest));
        }
        found
    }
}

/// The zero between two positive numbers, by bisection until no number is left between them.
fn bisected(mut low: f64, mut high: f64, is_below: &dyn Fn(f64) -> bool) -> f64 {
    loop {
        // The geometric mean first: the gap may span decades.
        let mean = if 4.0 * low < high { low.sqrt() * high.sqrt() } else { low + 0.5 * (high - low) };
        if mean <= low || high <= mean {
            return high;
        }
        if is_below(mean) { low = mean } else { high = mean }
    }
}

/// Modes (weight, time) in the order of their times, with equal times joined.
pub(crate) fn joined(modes: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for [weight, time] in modes {
        match joined.last_mut() {
            Some(last) if time <= last[1] => last[0] += weight,
            _ => joined.push([weight, time]),
        }
    }
    joined
}
