//! The least arithmetic of the isochoric neo-Hookean solid, step by step: what no implementation can go below in lanes.
//!
//! ```text
//! P = μ J^(−2/3) (F − I₁/3 F⁻ᵀ) + κ (J − 1) Cof F,   F⁻ᵀ = Cof F / J
//! ```
//! It is the formula as it is printed: it loses the digits that cancel near the reference, tests no point and refuses
//! nothing.

use piola_numerics::internal::Lanewise;
use piola_numerics::{Kernel, Lanes, Real, dispatch};

/// Points of a block.
pub const BLOCK: usize = 8;

/// Points in lanes, a vector for each component.
pub type Blocks = [[[f64; BLOCK]; 9]];

/// Numbers of F in, as many out.
pub trait Step: Lanewise<9, 9> {
    /// What is done.
    const NAME: &'static str;
}

/// F itself, read and written in lanes.
#[derive(Clone, Copy, Debug)]
pub struct Copied;

impl Step for Copied {
    const NAME: &'static str = "copy";
}

impl Lanewise<9, 9> for Copied {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, f: [T; 9]) -> [T; 9] {
        f
    }
}

/// J Cof F.
#[derive(Clone, Copy, Debug)]
pub struct Cofactor;

impl Step for Cofactor {
    const NAME: &'static str = "cofactor";
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn cofactor_and_determinant<T: Real>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> ([T; 9], T) {
    let (k, l, m) = (e * i - f * h, f * g - d * i, d * h - e * g);
    let cofactor = [k, l, m, c * h - b * i, a * i - c * g, b * g - a * h, b * f - c * e, c * d - a * f, a * e - b * d];
    (cofactor, a * k + b * l + c * m)
}

impl Lanewise<9, 9> for Cofactor {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, numbers: [T; 9]) -> [T; 9] {
        let ([a, b, c, d, e, f, g, h, i], j) = cofactor_and_determinant(numbers);
        [j * a, j * b, j * c, j * d, j * e, j * f, j * g, j * h, j * i]
    }
}

/// P by the printed formula.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// μ, Pa.
    pub mu: f64,
    /// κ, Pa.
    pub kappa: f64,
}

impl Step for NeoHookean {
    const NAME: &'static str = "neo_hookean_isochoric";
}

impl Lanewise<9, 9> for NeoHookean {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, numbers: [T; 9]) -> [T; 9] {
        let (cofactor, jacobian) = cofactor_and_determinant(numbers);
        let ([a, b, c, d, e, f, g, h, i], [k, l, m, n, o, p, q, r, s]) = (numbers, cofactor);
        let first = ((a * a + b * b + c * c) + (d * d + e * e + f * f)) + (g * g + h * h + i * i);
        // J^(−2/3) and 1/J from J^(−1/3): no division.
        let third = jacobian.recip_cbrt();
        let square = third * third;
        let x = T::lit(self.mu) * square;
        let y = T::lit(self.kappa) * (jacobian - T::one()) - x * first * T::lit(1.0 / 3.0) * (square * third);
        [
            x * a + y * k,
            x * b + y * l,
            x * c + y * m,
            x * d + y * n,
            x * e + y * o,
            x * f + y * p,
            x * g + y * q,
            x * h + y * r,
            x * i + y * s,
        ]
    }
}

/// A step at all points.
struct Run<'a, S> {
    step: &'a S,
    from: &'a Blocks,
    to: &'a mut Blocks,
}

impl<S: Step> Kernel for Run<'_, S> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        for (from, to) in self.from.iter().zip(self.to) {
            let [a, b, c, d, e, f, g, h, i] = *from;
            let inputs = [Lanes(a), Lanes(b), Lanes(c), Lanes(d), Lanes(e), Lanes(f), Lanes(g), Lanes(h), Lanes(i)];
            let [a, b, c, d, e, f, g, h, i] = Lanes::lanewise(self.step, inputs);
            *to = [a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0, i.0];
        }
    }
}

/// The step at every point, by the widest instructions of the machine.
pub fn run<S: Step>(step: &S, from: &Blocks, to: &mut Blocks) {
    dispatch(Run { step, from, to });
}
