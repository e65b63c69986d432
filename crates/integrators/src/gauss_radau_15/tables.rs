//! The coefficients of the eight stages, made from their nodes by the compiler with 31 digits.

use piola_numerics::Real;

/// An unevaluated sum of two doubles.
#[derive(Clone, Copy)]
struct Pair(f64, f64);

const ZERO: Pair = Pair(0.0, 0.0);
const ONE: Pair = Pair(1.0, 0.0);

/// a + b = sum + error (Knuth).
const fn two_sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let b_rounded = sum - a;
    Pair(sum, (a - (sum - b_rounded)) + (b - b_rounded))
}

/// Two halves of a number with half its digits each (Veltkamp).
const fn split(x: f64) -> Pair {
    let scaled = 134_217_729.0 * x;
    let high = scaled - (scaled - x);
    Pair(high, x - high)
}

/// a b = product + error (Dekker).
const fn two_product(a: f64, b: f64) -> Pair {
    let product = a * b;
    let (Pair(a_high, a_low), Pair(b_high, b_low)) = (split(a), split(b));
    Pair(product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low))
}

impl Pair {
    const fn whole(number: u32) -> Self {
        Self(number as f64, 0.0)
    }
    const fn plus(self, other: Self) -> Self {
        let Self(sum, error) = two_sum(self.0, other.0);
        let Self(rest, lost) = two_sum(self.1, other.1);
        let Self(sum, error) = two_sum(sum, error + rest);
        two_sum(sum, error + lost)
    }
    const fn minus(self, other: Self) -> Self {
        self.plus(Self(-other.0, -other.1))
    }
    const fn times(self, other: Self) -> Self {
        let Self(product, error) = two_product(self.0, other.0);
        two_sum(product, error + (self.0 * other.1 + self.1 * other.0))
    }
    const fn over(self, other: Self) -> Self {
        let first = Self(self.0 / other.0, 0.0);
        let rest = self.minus(first.times(other));
        let second = Self(rest.0 / other.0, 0.0);
        let rest = rest.minus(second.times(other));
        first.plus(second).plus(Self(rest.0 / other.0, 0.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Real>(self) -> T {
        T::lit(self.0) + T::lit(self.1)
    }
}

/// The nodes c: the start of the step, and the zeros of `(P₇(x) + P₈(x))/(1 + x)`, x = 2c − 1, with Legendre's P.
///
/// Source: computed with sixty digits. Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.5.
const NODES: [Pair; 8] = [
    ZERO,
    Pair(0.05626256053692215, -2.291625093370933e-18),
    Pair(0.18024069173689236, 3.8686752831754824e-18),
    Pair(0.3526247171131696, 2.061826646998368e-17),
    Pair(0.5471536263305554, -3.74080474792297e-17),
    Pair(0.7342101772154105, 4.4905724422883276e-17),
    Pair(0.8853209468390958, -2.2269048748061915e-17),
    Pair(0.9775206135612875, 2.753099537017373e-18),
];

/// The coefficients that belong to a set of nodes.
///
/// ℓⱼ is the polynomial of degree seven that is 1 at node j and 0 at the others.
#[derive(Clone, Debug)]
pub(super) struct Tables<T> {
    /// c
    pub(super) nodes: [T; 8],
    /// Row n: `∫₀^c ℓⱼ` at c = cₙ, for j from 1; in front of them c.
    pub(super) velocity: [[T; 8]; 8],
    /// Row n: `∬₀^c ℓⱼ`, for j from 1; in front of them c²/2.
    pub(super) position: [[T; 8]; 8],
    /// Row n: `1/(cₙ − cₖ)` for k < n.
    differences: [[T; 8]; 8],
    /// Row n: the coefficients of s, s², … in `s (s − c₁) … (s − cₙ₋₁)`.
    powers: [[T; 8]; 8],
    /// The coefficient of s⁷ in ℓⱼ, for j from 1.
    pub(super) last: [T; 8],
}

/// For scalars of more digits than a double has.
static EXACT: Tables<Pair> = Tables::of(NODES);
/// For doubles and scalars made of them. These tables belong to the nodes as doubles hold them: so the rounding of the nodes
/// spoils the conditions of order by 1e-17 of the coefficient that follows the last, and not of the first.
static ROUNDED: Tables<Pair> = Tables::of(rounded(NODES));

const fn rounded(mut nodes: [Pair; 8]) -> [Pair; 8] {
    let mut n = 0;
    while n < 8 {
        nodes[n].1 = 0.0;
        n += 1;
    }
    nodes
}

impl Tables<Pair> {
    const fn of(nodes: [Pair; 8]) -> Self {
        let empty = [[ZERO; 8]; 8];
        let mut tables =
            Self { nodes, velocity: empty, position: empty, differences: empty, powers: empty, last: [ZERO; 8] };
        let mut n = 1;
        while n < 8 {
            let c = nodes[n];
            tables.velocity[n][0] = c;
            tables.position[n][0] = c.times(c).times(Pair(0.5, 0.0));
            let mut k = 0;
            while k < n {
                tables.differences[n][k] = ONE.over(c.minus(nodes[k]));
                k += 1;
            }
            // From s (s − c₁) … (s − cₙ₋₂) to the next.
            if n == 1 {
                tables.powers[1][0] = ONE;
            } else {
                tables.powers[n] = times_difference(tables.powers[n - 1], nodes[n - 1]);
            }
            n += 1;
        }
        let mut j = 1;
        while j < 8 {
            tables.fill_column(j);
            j += 1;
        }
        tables
    }

    /// What belongs to `ℓⱼ = s Π (s − cₖ) / (cⱼ Π (cⱼ − cₖ))`, k ≠ 0, j.
    const fn fill_column(&mut self, j: usize) {
        // The coefficients of s, s², …, s⁷.
        let mut coefficients = [ZERO; 8];
        coefficients[0] = ONE;
        let mut scale = self.nodes[j];
        let mut k = 1;
        while k < 8 {
            if k != j {
                coefficients = times_difference(coefficients, self.nodes[k]);
                scale = scale.times(self.nodes[j].minus(self.nodes[k]));
            }
            k += 1;
        }
        self.last[j] = ONE.over(scale);
        let mut n = 1;
        while n < 8 {
            let c = self.nodes[n];
            let (mut once, mut twice) = (ZERO, ZERO);
            let mut degree = 7;
            while 0 < degree {
                let coefficient = coefficients[degree as usize - 1].over(scale);
                once = once.times(c).plus(coefficient.over(Pair::whole(degree + 1)));
                twice = twice.times(c).plus(coefficient.over(Pair::whole((degree + 1) * (degree + 2))));
                degree -= 1;
            }
            self.velocity[n][j] = once.times(c).times(c);
            self.position[n][j] = twice.times(c).times(c).times(c);
            n += 1;
        }
    }
}

/// The coefficients of a polynomial times (s − c).
const fn times_difference(coefficients: [Pair; 8], c: Pair) -> [Pair; 8] {
    let mut product = [ZERO; 8];
    let mut m = 0;
    while m < 8 {
        let before = if m == 0 { ZERO } else { coefficients[m - 1] };
        product[m] = before.minus(c.times(coefficients[m]));
        m += 1;
    }
    product
}

impl<T: Real> Tables<T> {
    pub(super) fn new() -> Self {
        // Whether the scalar holds more of a node than a double does.
        let Pair(high, low) = NODES[5];
        let finer = 0.0 < ((T::lit(high) + T::lit(low)) - T::lit(high)).primal(0);
        let tables = if finer { &EXACT } else { &ROUNDED };
        let all = |rows: &[[Pair; 8]; 8]| rows.map(|row| row.map(Pair::of));
        Self {
            nodes: tables.nodes.map(Pair::of),
            velocity: all(&tables.velocity),
            position: all(&tables.position),
            differences: all(&tables.differences),
            powers: all(&tables.powers),
            last: tables.last.map(Pair::of),
        }
    }

    /// The coefficients b₀ … b₆ of s, s², …, s⁷ in the polynomial that is `stages[n]` at node n and 0 at the start.
    ///
    /// By divided differences: what rounding leaves out of one of them, the next ones make up for.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn coefficients(&self, stages: &[T; 8]) -> [T; 7] {
        let (mut b, mut divided) = ([T::zero(); 7], [T::zero(); 8]);
        for n in 1..8 {
            // Divided: a reciprocal, always rounded the same way, changes the energy of a circular motion by 2e-20 in every step,
            // which is more than the random rest after 30,000 revolutions.
            let mut difference = stages[n] / self.nodes[n];
            for (divided, inverse) in divided.iter().zip(&self.differences[n]).take(n).skip(1) {
                difference = (difference - *divided) * *inverse;
            }
            divided[n] = difference;
        }
        // The small ones first.
        for n in (1..8).rev() {
            for (b, power) in b.iter_mut().zip(&self.powers[n]).take(n) {
                *b += divided[n] * *power;
            }
        }
        b
    }
}
