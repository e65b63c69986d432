//! `Hessian<T, N, PAIRS>`: a value with N partial derivatives and each second derivative once.
//!
//! ```text
//! (a b),ᵢⱼ = a,ᵢⱼ b + a b,ᵢⱼ + a,ᵢ b,ⱼ + a,ⱼ b,ᵢ        f(a),ᵢⱼ = f′ a,ᵢⱼ + f″ a,ᵢ a,ⱼ        i ≤ j
//! ```
//!
//! Beside the numbers two sets say which derivatives may differ from zero. In straight code the compiler knows them, and what is
//! zero costs nothing: a constant times a variable is one product, and a formula that does not depend on a variable has no terms of it.

use crate::Real;

/// A value, its N partial derivatives and its second derivatives ∂²a/∂xᵢ∂xⱼ with i ≤ j, exact to rounding.
///
/// The second derivatives are the upper triangle by rows: 11, 12, …, 1N, 22, …, NN. `PAIRS` is their number N (N + 1)/2, and N is at
/// most seven; the compiler refuses other numbers.
///
/// # Example
/// ```
/// use piola_numerics::{Hessian, Real};
/// let x = Hessian::<f64, 2, 3>::variable(3.0, 0);
/// let y = Hessian::<f64, 2, 3>::variable(4.0, 1);
/// let z = x * x * y;
/// assert_eq!((z.value(), z.partials()), (36.0, [24.0, 9.0]));
/// assert_eq!(z.second_partials(), [8.0, 6.0, 0.0]); // 2 y, 2 x, 0
/// ```
#[doc(alias("second derivatives", "hyper-dual number", "automatic differentiation"))]
#[derive(Clone, Copy, Debug)]
pub struct Hessian<T, const N: usize, const PAIRS: usize> {
    value: T,
    partials: [T; N],
    seconds: [T; PAIRS],
    /// Bit i: ∂a/∂xᵢ may differ from zero. Elsewhere it is stored as zero.
    varies: u32,
    /// Bit k: the second derivative number k may differ from zero. Elsewhere it is stored as zero.
    bends: u32,
}

/// The place of the pair i ≤ j in the upper triangle of N by N entries, by rows.
const fn place(n: usize, i: usize, j: usize) -> usize {
    let (i, j) = if i <= j { (i, j) } else { (j, i) };
    (2 * n + 1 - i) * i / 2 + j - i
}

/// The row of a place, and its column; (0, 0) beyond the last.
const fn pair(n: usize, number: usize) -> (usize, usize) {
    let mut i = 0;
    while i < n {
        let mut j = i;
        while j < n {
            if place(n, i, j) == number {
                return (i, j);
            }
            j += 1;
        }
        i += 1;
    }
    (0, 0)
}

/// Runs a statement for each variable, written out: in a loop the compiler would find out too late which terms are zero.
macro_rules! each_variable {
    ($i:ident: $statement:expr) => { each_variable!(@written $i, $statement, 0 1 2 3 4 5 6) };
    (@written $i:ident, $statement:expr, $($number:literal)*) => {
        $(if $number < N {
            const $i: usize = $number;
            $statement;
        })*
    };
}

/// Runs a statement for each pair of variables i ≤ j, written out.
macro_rules! each_pair {
    ($k:ident, $i:ident, $j:ident: $statement:expr) => {
        each_pair!(@written $k, $i, $j, $statement, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27)
    };
    (@written $k:ident, $i:ident, $j:ident, $statement:expr, $($number:literal)*) => {
        $(if $number < PAIRS {
            const $k: usize = $number;
            let ($i, $j) = const { pair(N, $number) };
            $statement;
        })*
    };
}

/// Whether a set has a member.
#[cfg_attr(not(debug_assertions), inline(always))]
const fn has(set: u32, member: usize) -> bool {
    (set >> member) & 1 == 1
}

impl<T: Real, const N: usize, const PAIRS: usize> Hessian<T, N, PAIRS> {
    /// A constant: all derivatives zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        const { assert!(N <= 7 && PAIRS == N * (N + 1) / 2, "PAIRS is N (N + 1)/2, and N is at most 7") };
        Self { value, partials: [T::zero(); N], seconds: [T::zero(); PAIRS], varies: 0, bends: 0 }
    }

    /// The variable number `direction`: its own partial derivative is one. A `direction` of N or more gives a constant.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn variable(value: T, direction: usize) -> Self {
        Self::constant(value).with_partial(direction, T::one())
    }

    /// With another derivative along `direction`; unchanged for a `direction` of N or more.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn with_partial(mut self, direction: usize, partial: T) -> Self {
        if direction < N {
            self.partials[direction] = partial;
            self.varies |= 1 << direction;
        }
        self
    }

    /// With another second derivative along two directions; unchanged for a direction of N or more.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn with_second_partial(mut self, directions: (usize, usize), second: T) -> Self {
        let (i, j) = directions;
        if i < N && j < N {
            self.seconds[place(N, i, j)] = second;
            self.bends |= 1 << place(N, i, j);
        }
        self
    }

    /// a.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn value(&self) -> T {
        self.value
    }

    /// ∂a/∂xᵢ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn partials(&self) -> [T; N] {
        self.partials
    }

    /// ∂²a/∂xᵢ∂xⱼ with i ≤ j, by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn second_partials(&self) -> [T; PAIRS] {
        self.seconds
    }

    /// ∂²a/∂xᵢ∂xⱼ of any two variables.
    ///
    /// # Panics
    /// When a variable is N or more.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn second_partial(&self, i: usize, j: usize) -> T {
        self.seconds[place(N, i, j)]
    }

    /// False if ∂a/∂xᵢ is zero because a does not depend on the variable.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn depends_on(&self, direction: usize) -> bool {
        has(self.varies, direction)
    }

    /// False if ∂²a/∂xᵢ∂xⱼ is zero because a is linear in the two variables.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn is_curved_in(&self, i: usize, j: usize) -> bool {
        has(self.bends, place(N, i, j))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_fixed(&self) -> bool {
        self.varies == 0 && self.bends == 0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, f: T, f1: impl FnOnce() -> T, f2: impl FnOnce() -> T) -> Self {
        let mut result = Self::constant(f);
        if self.is_fixed() {
            return result;
        }
        let (f1, f2) = (f1(), f2());
        result.varies = self.varies;
        let mut bent = [T::zero(); N];
        each_variable!(I: if has(self.varies, I) {
            result.partials[I] = self.partials[I] * f1;
            bent[I] = self.partials[I] * f2;
        });
        each_pair!(K, i, j: {
            let dyad = has(self.varies, i) && has(self.varies, j);
            if dyad {
                result.seconds[K] = bent[i] * self.partials[j];
            }
            if has(self.bends, K) {
                let own = self.seconds[K] * f1;
                result.seconds[K] = if dyad { own + result.seconds[K] } else { own };
            }
            if dyad || has(self.bends, K) {
                result.bends |= 1 << K;
            }
        });
        result
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        let mut result = Self::constant(f(self.value, other.value));
        (result.varies, result.bends) = (self.varies | other.varies, self.bends | other.bends);
        each_variable!(I: if has(result.varies, I) {
            result.partials[I] = f(self.partials[I], other.partials[I]);
        });
        each_pair!(K, _i, _j: if has(result.bends, K) {
            result.seconds[K] = f(self.seconds[K], other.seconds[K]);
        });
        result
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        let mut result = Self { value: f(self.value), ..self };
        each_variable!(I: if has(self.varies, I) {
            result.partials[I] = f(self.partials[I]);
        });
        each_pair!(K, _i, _j: if has(self.bends, K) {
            result.seconds[K] = f(self.seconds[K]);
        });
        result
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(self, o: Self) -> Self {
        let mut result = Self::constant(self.value * o.value);
        result.varies = self.varies | o.varies;
        each_variable!(I: if has(self.varies, I) {
            let own = self.partials[I] * o.value;
            result.partials[I] = if has(o.varies, I) { own + self.value * o.partials[I] } else { own };
        } else if has(o.varies, I) {
            result.partials[I] = self.value * o.partials[I];
        });
        each_pair!(K, i, j: {
            let terms = [
                (has(self.bends, K), self.seconds[K], o.value),
                (has(o.bends, K), self.value, o.seconds[K]),
                (has(self.varies, i) && has(o.varies, j), self.partials[i], o.partials[j]),
                (has(self.varies, j) && has(o.varies, i), self.partials[j], o.partials[i]),
            ];
            (result.seconds[K], result.bends) = sum_of(terms, K, result.bends);
        });
        result
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn quotient(self, o: Self) -> Self {
        // The value is divided and not multiplied by r: it is that of the plain scalar, to the last bit.
        let value = self.value / o.value;
        let mut result = Self::constant(value);
        if self.is_fixed() && o.is_fixed() {
            return result;
        }
        let r = T::one() / o.value;
        result.varies = self.varies | o.varies;
        each_variable!(I: if has(o.varies, I) {
            let less = value * o.partials[I];
            result.partials[I] = if has(self.varies, I) { (self.partials[I] - less) * r } else { -(less * r) };
        } else if has(self.varies, I) {
            result.partials[I] = self.partials[I] * r;
        });
        each_pair!(K, i, j: {
            let terms = [
                (has(o.bends, K), value, o.seconds[K]),
                (has(result.varies, i) && has(o.varies, j), result.partials[i], o.partials[j]),
                (has(result.varies, j) && has(o.varies, i), result.partials[j], o.partials[i]),
                (false, value, value),
            ];
            let (less, set) = sum_of(terms, K, 0);
            if has(self.bends, K) {
                result.seconds[K] = if set == 0 { self.seconds[K] * r } else { (self.seconds[K] - less) * r };
                result.bends |= 1 << K;
            } else if set != 0 {
                result.seconds[K] = -(less * r);
                result.bends |= 1 << K;
            }
        });
        result
    }
}

/// The sum of those products that are not known to be zero, and the set with the member `K` if there is one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of<T: Real>(terms: [(bool, T, T); 4], k: usize, set: u32) -> (T, u32) {
    let (mut sum, mut is_empty) = (T::zero(), true);
    let [first, second, third, fourth] = terms;
    macro_rules! add {
        ($term:ident) => {
            if $term.0 {
                let product = $term.1 * $term.2;
                sum = if is_empty { product } else { sum + product };
                is_empty = false;
            }
        };
    }
    add!(first);
    add!(second);
    add!(third);
    add!(fourth);
    (sum, if is_empty { set } else { set | (1 << k) })
}

/// Equal numbers are equal, whether or not derivatives that are zero are known to be.
impl<T: PartialEq, const N: usize, const PAIRS: usize> PartialEq for Hessian<T, N, PAIRS> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value && self.partials == other.partials && self.seconds == other.seconds
    }
}

crate::differentiable::implement_real!(
    Hessian<T, N, PAIRS>, 2, [T: Real, const N: usize, const PAIRS: usize], [const N: usize, const PAIRS: usize]
);
