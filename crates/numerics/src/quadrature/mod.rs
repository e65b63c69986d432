//! Adaptive integration of several functions of one variable at once, with an estimate of each error.
//!
//! ```text
//! ∫ f dx ≈ Σ K f over panels        error of a panel: from |K f − G f| and what else its rule looks at
//! ```
//!
//! K is Kronrod's rule, G Gauss's at some of the same points. The panel with the largest share of an error that is still too
//! large is halved, until all errors are as small as the caller wants. Nothing is allocated but by [`Growing`].
//!
//! | to choose | from |
//! |---|---|
//! | points of a panel | [`GaussKronrod::POINTS_15`], [`GaussKronrod::POINTS_21`] |
//! | error of a panel | [`Difference`], [`LargestDifference`], [`Quadpack`], [`Kinks`], or any [`ErrorRule`] |
//! | when to stop | a closure of values and sizes that returns the errors allowed, or any [`Accuracy`] |
//! | memory for panels | an array of [`Panel`]s, [`Growing`], or any [`Memory`] |
//!
//! # Example
//! ```
//! use piola_numerics::quadrature::{self, Ending, GaussKronrod, Panel, Quadpack};
//! // ∫ eˣ dx and ∫ √x dx from 0 to 1, each to ten digits.
//! let digits = |values: &[f64; 2], _sizes: &[f64; 2]| values.map(|value| 1e-10 * value.abs());
//! let (mut panels, method) = ([Panel::EMPTY; 64], (&GaussKronrod::POINTS_21, &Quadpack));
//! let found = quadrature::integrate(&mut panels, [(0.0, 1.0)], method, &digits, |_part, x: f64| {
//!     Ok::<_, core::convert::Infallible>([x.exp(), x.sqrt()])
//! })?;
//! assert_eq!(found.ending, Ending::Accurate);
//! assert!((found.values[0] - (1.0_f64.exp_m1())).abs() <= found.errors[0]);
//! assert!((found.values[1] - 2.0 / 3.0).abs() <= found.errors[1]);
//! # Ok::<(), core::convert::Infallible>(())
//! ```

mod errors;
mod points;

use core::cmp::Ordering;

pub use errors::{Difference, ErrorRule, Kinks, LargestDifference, Quadpack, Samples};
pub use points::GaussKronrod;

/// A part of the range with its integrals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panel<const K: usize> {
    /// Which of the given ranges it lies in, counted from 0.
    pub part: usize,
    /// One end.
    pub from: f64,
    /// The other end.
    pub to: f64,
    /// ∫ f dx of each function.
    pub values: [f64; K],
    /// |∫ |f| dx| of each function.
    pub sizes: [f64; K],
    /// The error of each integral, estimated by the [`ErrorRule`].
    pub errors: [f64; K],
}

impl<const K: usize> Panel<K> {
    /// No panel: what memory is filled with.
    pub const EMPTY: Self = Self { part: 0, from: 0.0, to: 0.0, values: [0.0; K], sizes: [0.0; K], errors: [0.0; K] };
}

/// Memory for panels: an array, for so many and without allocation; or [`Growing`].
pub trait Memory<const K: usize> {
    /// The first `count` panels; none where there is no room for so many.
    fn first(&mut self, count: usize) -> Option<&mut [Panel<K>]>;
}

impl<const K: usize, const N: usize> Memory<K> for [Panel<K>; N] {
    fn first(&mut self, count: usize) -> Option<&mut [Panel<K>]> {
        self.get_mut(..count)
    }
}

/// Memory that is allocated as panels need it, up to a bound.
#[derive(Clone, Debug)]
pub struct Growing<const K: usize> {
    panels: Vec<Panel<K>>,
    most: usize,
}

impl<const K: usize> Growing<K> {
    /// Room for up to `most` panels.
    #[must_use]
    pub const fn up_to(most: usize) -> Self {
        Self { panels: Vec::new(), most }
    }
}

impl<const K: usize> Memory<K> for Growing<K> {
    fn first(&mut self, count: usize) -> Option<&mut [Panel<K>]> {
        if self.most < count {
            return None;
        }
        self.panels.resize(count.max(self.panels.len()), Panel::EMPTY);
        self.panels.get_mut(..count)
    }
}

/// When integrals are accurate enough. A closure of values and sizes that returns the errors allowed is one.
pub trait Accuracy<const K: usize> {
    /// The error allowed of each integral, from their values ∫ f dx and sizes ∫ |f| dx so far.
    fn allowed(&self, values: &[f64; K], sizes: &[f64; K]) -> [f64; K];
    /// Whether halving a panel can make its error smaller: false where what is left is rounding.
    fn is_worth_halving(&self, _panel: &Panel<K>) -> bool {
        true
    }
}

impl<const K: usize, F: Fn(&[f64; K], &[f64; K]) -> [f64; K]> Accuracy<K> for F {
    fn allowed(&self, values: &[f64; K], sizes: &[f64; K]) -> [f64; K] {
        self(values, sizes)
    }
}

/// Integrals over all parts, with what is known of their errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const K: usize> {
    /// ∫ f dx of each function.
    pub values: [f64; K],
    /// The sum over panels of |∫ |f| dx|.
    pub sizes: [f64; K],
    /// The sum of the panels' errors.
    pub errors: [f64; K],
    /// How many panels there are.
    pub panels: usize,
    /// How often the functions were evaluated.
    pub evaluations: usize,
    /// Why no panel was halved further.
    pub ending: Ending,
}

/// Why an integration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// Every error is at most what was allowed.
    Accurate,
    /// The memory is full. Errors are infinite where not even the given parts had room.
    Full,
    /// Halving panels makes the errors no smaller: no panel is worth it, or the worst has no number between its ends.
    Exhausted,
    /// A function, or the sum over a panel, is infinite or NaN.
    NotFinite {
        /// The range of the place.
        part: usize,
        /// The place; the middle of the panel, where only the sum is not finite.
        x: f64,
        /// Which function.
        component: usize,
        /// Its value.
        value: f64,
    },
}

/// Integrates K functions over several ranges, each range from its first to its second end.
///
/// `f` is called with the number of the range and a place in it. `method` holds the points of a panel and the rule for its
/// error.
///
/// # Errors
/// Those of `f`. All else is in [`Integral::ending`].
///
/// # Accuracy
/// [`Integral::errors`]: true for functions that the points resolve on the panels, an estimate for others.
#[doc(alias("quadrature", "QUADPACK"))]
pub fn integrate<const K: usize, R: ErrorRule<K>, E>(
    memory: &mut impl Memory<K>,
    parts: impl IntoIterator<Item = (f64, f64)>,
    (points, rule): (&GaussKronrod, &R),
    accuracy: &impl Accuracy<K>,
    f: impl FnMut(usize, f64) -> Result<[f64; K], E>,
) -> Result<Integral<K>, E> {
    let mut sampler = Sampler { points, rule, f, evaluations: 0, bad: None };
    let (mut count, mut has_room) = (0, true);
    for (part, (from, to)) in parts.into_iter().enumerate() {
        let whole = sampler.panel(part, from, to)?;
        let halves = if R::COMPARES_HALVES { sampler.halves(&whole)? } else { [whole; 2] };
        let new = if R::COMPARES_HALVES { &halves[..] } else { &halves[..1] };
        if let Some(panels) = memory.first(count + new.len()) {
            panels[count..].copy_from_slice(new);
            count += new.len();
        } else {
            has_room = false;
        }
    }
    loop {
        let is_full = memory.first(count + 1).is_none();
        let panels = memory.first(count).unwrap_or_default();
        let sum = |part: fn(&Panel<K>) -> &[f64; K]| -> [f64; K] {
            core::array::from_fn(|k| panels.iter().map(|panel| part(panel)[k]).sum())
        };
        let (values, sizes) = (sum(|panel| &panel.values), sum(|panel| &panel.sizes));
        let errors = if has_room { sum(|panel| &panel.errors) } else { [f64::INFINITY; K] };
        let allowed = accuracy.allowed(&values, &sizes);
        let too_large = |k: usize| errors[k].partial_cmp(&allowed[k]).is_none_or(Ordering::is_gt);
        let share = |panel: &Panel<K>| {
            (0..K).filter(|&k| too_large(k)).map(|k| panel.errors[k] / errors[k]).fold(0.0, f64::max)
        };
        let candidates = panels.iter().enumerate().filter(|(_, panel)| accuracy.is_worth_halving(panel));
        let by_error = |a: &Panel<K>, b: &Panel<K>| {
            let alike = || a.errors.partial_cmp(&b.errors).unwrap_or(Ordering::Equal);
            share(a).total_cmp(&share(b)).then_with(alike)
        };
        let worst = candidates.max_by(|a, b| by_error(a.1, b.1)).filter(|(_, panel)| has_middle(panel));
        let ending = match worst {
            _ if sampler.bad.is_some() => sampler.bad,
            _ if !has_room => Some(Ending::Full),
            _ if !(0..K).any(too_large) => Some(Ending::Accurate),
            _ if is_full => Some(Ending::Full),
            None => Some(Ending::Exhausted),
            Some(_) => None,
        };
        if let (None, Some((index, &whole))) = (ending, worst) {
            let halves = sampler.halves(&whole)?;
            if let Some(panels) = memory.first(count + 1) {
                [panels[index], panels[count]] = halves;
                count += 1;
            }
            continue;
        }
        let ending = ending.unwrap_or(Ending::Exhausted);
        return Ok(Integral { values, sizes, errors, panels: count, evaluations: sampler.evaluations, ending });
    }
}

/// Whether there is a number between the ends.
fn has_middle<const K: usize>(panel: &Panel<K>) -> bool {
    let middle = f64::midpoint(panel.from, panel.to);
    (panel.from < middle && middle < panel.to) || (panel.to < middle && middle < panel.from)
}

/// Evaluates the functions on panels.
struct Sampler<'a, R, F> {
    points: &'a GaussKronrod,
    rule: &'a R,
    f: F,
    evaluations: usize,
    /// The first value that is not finite.
    bad: Option<Ending>,
}

impl<R, F> Sampler<'_, R, F> {
    fn at<const K: usize, E>(&mut self, part: usize, x: f64) -> Result<[f64; K], E>
    where
        F: FnMut(usize, f64) -> Result<[f64; K], E>,
    {
        self.evaluations += 1;
        let values = (self.f)(part, x)?;
        self.check(part, x, &values);
        Ok(values)
    }

    fn check(&mut self, part: usize, x: f64, values: &[f64]) {
        if let (None, Some(component)) = (self.bad, values.iter().position(|value| !value.is_finite())) {
            self.bad = Some(Ending::NotFinite { part, x, component, value: values[component] });
        }
    }

    fn panel<const K: usize, E>(&mut self, part: usize, from: f64, to: f64) -> Result<Panel<K>, E>
    where
        R: ErrorRule<K>,
        F: FnMut(usize, f64) -> Result<[f64; K], E>,
    {
        let GaussKronrod { nodes, kronrod: weights, gauss: coarse_weights, .. } = *self.points;
        let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
        let count = nodes.len();
        let centre = self.at(part, middle)?;
        let mut pairs = [[[0.0; K]; 2]; points::MOST_PAIRS];
        let mut kronrod = centre.map(|value| weights[count] * value);
        let mut size = centre.map(|value| weights[count] * value.abs());
        let mut gauss = centre.map(|value| self.points.gauss_at_centre * value);
        for (i, pair) in pairs[..count].iter_mut().enumerate() {
            let offset = half * nodes[i];
            *pair = [self.at(part, middle - offset)?, self.at(part, middle + offset)?];
            for k in 0..K {
                kronrod[k] += weights[i] * (pair[0][k] + pair[1][k]);
                size[k] += weights[i] * (pair[0][k].abs() + pair[1][k].abs());
                if i % 2 == 1 {
                    gauss[k] += coarse_weights[i / 2] * (pair[0][k] + pair[1][k]);
                }
            }
        }
        let ends = if R::SEES_ENDS { Some([self.at(part, from)?, self.at(part, to)?]) } else { None };
        let samples = Samples {
            points: self.points,
            half: half.abs(),
            centre,
            pairs: &pairs[..count],
            ends,
            kronrod,
            gauss,
            size,
        };
        let errors = self.rule.errors(&samples);
        let values = kronrod.map(|sum| sum * half);
        self.check(part, middle, &values);
        self.check(part, middle, &errors);
        Ok(Panel { part, from, to, values, sizes: size.map(|sum| sum * half.abs()), errors })
    }

    fn halves<const K: usize, E>(&mut self, whole: &Panel<K>) -> Result<[Panel<K>; 2], E>
    where
        R: ErrorRule<K>,
        F: FnMut(usize, f64) -> Result<[f64; K], E>,
    {
        let Panel { part, from, to, .. } = *whole;
        let middle = f64::midpoint(from, to);
        let mut halves = [self.panel(part, from, middle)?, self.panel(part, middle, to)?];
        if R::COMPARES_HALVES {
            for k in 0..K {
                // By luck the rules can agree across a kink: then what halving has changed tells of it.
                let change = (halves[0].values[k] + halves[1].values[k] - whole.values[k]).abs();
                for half in &mut halves {
                    half.errors[k] = half.errors[k].max(0.5 * change);
                }
            }
        }
        Ok(halves)
    }
}
