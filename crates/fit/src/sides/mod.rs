//! Foams and fibre-reinforced solids: tests whose sides are free, measured or held.
//!
//! ```text
//! minimise S(θ) = Σ ((P(θ) − P̂)/P̂ₘ)² + Σ ((λₜ(θ) − λ̂ₜ)/m)²      λₜ(θ) from P = 0 on the free sides
//! ```
//! P̂ₘ is the largest stress of a test, m the largest |λ̂ₜ − 1| of its lateral stretches where they were measured.
//!
//! | law | W | parameters |
//! |---|---|---|
//! | `hyperfoam:n` | [`Hyperfoam`](piola_laws::rubber::Hyperfoam), compressible | μᵢ, αᵢ, νᵢ |
//! | `holzapfel-gasser-ogden` | [`HolzapfelGasserOgden`](piola_solids::HolzapfelGasserOgden) that keeps its volume, fibres at ±γ from axis 1 in the plane 1–2 | μ, k₁, k₂, γ, dispersion |
//!
//! # Example
//! See [`fit_sides`].

mod model;
mod test;

use core::f64::consts::FRAC_PI_2;

use nalgebra::DMatrix;
use piola_numerics::{Dual, Gradient, Real};

use crate::estimates::{Estimates, estimates, narrowed};
use crate::search::{Misfit, Range, minimise};
use crate::solids::SolidParameter;
use crate::statistics::{Autocorrelation, Criteria};
use crate::{FitError, Outcome};
use test::{Output, Point, shifted};

use model::oblique_energy;

pub use model::SidesModel;
pub use test::{Loading, SidesTest};

/// Parameters of one evaluation.
const CHUNK: usize = 3;

/// Options of a fit.
///
/// # Example
/// See [`fit_sides`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SidesOptions {
    /// Least and greatest values of parameters by name; they narrow those of the model. Equal ends fix a parameter.
    pub bounds: Vec<(String, [f64; 2])>,
    /// The probability of the intervals.
    pub confidence: f64,
    /// Evaluations of a search, for each unknown.
    pub patience: usize,
}

impl Default for SidesOptions {
    fn default() -> Self {
        Self { bounds: Vec::new(), confidence: 0.95, patience: 200 }
    }
}

impl SidesOptions {
    /// With bounds of a parameter.
    #[must_use]
    pub fn with_bounds(mut self, parameter: &str, bounds: [f64; 2]) -> Self {
        self.bounds.push((parameter.to_owned(), bounds));
        self
    }
}

/// Residuals of a test.
///
/// # Example
/// See [`fit_sides`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SidesResiduals {
    /// Name of the test.
    pub test: String,
    /// The RMS residual of the stresses over the largest stress.
    pub relative_rms: f64,
    /// The RMS residual of the lateral stretches over the largest |λ̂ₜ − 1| of the test; `None` if none was measured.
    pub lateral_rms: Option<f64>,
    /// P − P̂ of each row that is not at rest, in their order.
    pub stresses: Vec<f64>,
    /// λₜ − λ̂ₜ of each measured lateral stretch.
    pub laterals: Vec<f64>,
}

/// A fitted law.
///
/// # Example
/// See [`fit_sides`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SidesFit {
    /// The model.
    pub model: String,
    /// Its parameters, in its order.
    pub parameters: Vec<SolidParameter>,
    /// Residuals of each test.
    pub tests: Vec<SidesResiduals>,
    /// S.
    pub weighted_squares: f64,
    /// Numbers measured less parameters that could be moved.
    pub degrees_of_freedom: usize,
    /// Criteria for choosing between laws.
    pub criteria: Criteria,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
    /// How the search ended.
    pub outcome: Outcome,
    /// Starts of the search.
    pub starts: usize,
    /// Starts that came to this minimum.
    pub starts_that_agree: usize,
}

impl SidesFit {
    /// The values of the parameters.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.value).collect()
    }
}

/// Fits a law to tests whose sides are free, measured or held, all at once.
///
/// # Errors
/// [`FitError::NoTests`], [`FitError::TestTwice`], [`FitError::TooFewPoints`] for fewer numbers than parameters;
/// [`FitError::NoSuchLoading`] for a loading that the law has no answer to; [`FitError::UnknownParameter`],
/// [`FitError::ImpossibleBounds`], [`FitError::ConfidenceOutOfRange`]; [`FitError::NoStart`].
///
/// # Accuracy
/// Derivatives are exact, those of the sides by the condition that they are free; parameters to about the root of the rounding of S.
///
/// # Example
/// A foam with ν = 0.25 and α = 2 in compression: λₜ = λ^(−ν), P = (2 μ/α)(λ^α − λₜ^α)/λ with μ = 3.
/// ```
/// use piola_fit::sides::{Loading, SidesModel, SidesOptions, SidesTest, fit_sides};
/// let rows = [0.4_f64, 0.5, 0.6, 0.7, 0.8, 0.9].map(|stretch| {
///     let side = stretch.powf(-0.25);
///     (stretch, 3.0 * (stretch * stretch - side * side) / stretch, Some(side))
/// });
/// let test = SidesTest::new("press", Loading::Uniaxial, &rows)?;
/// let foam: SidesModel = "hyperfoam:1".parse()?;
/// let fitted = fit_sides(foam, &[test], &SidesOptions::default())?;
/// let [mu, alpha, nu] = fitted.values()[..] else { panic!("three parameters") };
/// assert!((mu - 3.0).abs() < 1e-6 && (alpha - 2.0).abs() < 1e-6 && (nu - 0.25).abs() < 1e-6);
/// let law = foam.law(&fitted.values(), 0.0)?;
/// # let _ = law;
/// # Ok::<(), piola_fit::FitError>(())
/// ```
pub fn fit_sides(model: SidesModel, tests: &[SidesTest], options: &SidesOptions) -> Result<SidesFit, FitError> {
    fit_sides_shifted(model, tests, options, &[])
}

/// The same with numbers added to the residuals over their scales: of each test those of the stresses, then those of the lateral stretches.
///
/// # Errors
/// As [`fit_sides`].
pub fn fit_sides_shifted(
    model: SidesModel,
    tests: &[SidesTest],
    options: &SidesOptions,
    shift: &[f64],
) -> Result<SidesFit, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    let mut problem = Problem::new(model, tests, &options.bounds)?;
    let mut shift = shift;
    for [begin, end] in &problem.parts {
        shift = shifted(&mut problem.points[*begin..*end], shift);
    }
    let points = problem.rows();
    let searched: Vec<usize> = (0..problem.ranges.len()).filter(|&k| !problem.ranges[k].is_fixed()).collect();
    if points < searched.len() {
        return Err(FitError::TooFewPoints { model: model.to_string(), points, parameters: searched.len() });
    }
    let stress = tests.iter().map(SidesTest::largest_stress).fold(0.0, f64::max);
    let starts = model.starts(stress);
    let mut found: Vec<(Vec<f64>, f64, Outcome)> = Vec::new();
    for start in &starts {
        let mut parameters = start.clone();
        for (k, range) in problem.ranges.iter().enumerate() {
            parameters[k] = parameters[k].clamp(range.bounds[0], range.bounds[1]);
        }
        let x = searched.iter().map(|&k| problem.ranges[k].inward(parameters[k])).collect();
        let walk = Walk { problem: &problem, searched: &searched, parameters };
        if let Some(end) = minimise(walk, x, options.patience.clamp(1, 1_000_000), &|| false) {
            let squares: f64 = end.state.0.iter().map(|r| r * r).sum();
            if squares.is_finite() {
                found.push((end.misfit.parameters, squares, end.outcome));
            }
        }
    }
    let Some((best, squares, outcome)) = found.iter().min_by(|a, b| a.1.total_cmp(&b.1)).cloned() else {
        return Err(FitError::NoStart { model: model.to_string() });
    };
    // Of an exact fit only rounding is left.
    let rounding = 1e-26 * points as f64;
    let agree = found.iter().filter(|other| other.1 <= squares * (1.0 + 1e-6) + rounding).count();
    let best = model.ordered(best);
    let mut fit = problem.report(tests, &best, squares, options.confidence);
    (fit.outcome, fit.starts, fit.starts_that_agree) = (outcome, starts.len(), agree);
    Ok(fit)
}

/// The data and ranges of a search.
struct Problem {
    model: SidesModel,
    points: Vec<Point>,
    /// First and last point of each test.
    parts: Vec<[usize; 2]>,
    names: Vec<(String, bool)>,
    ranges: Vec<Range>,
}

/// Free sides that carry no stress.
enum Sides {
    /// The logarithm of the one that is free, and ∂²W by it.
    One { side: f64, stiffness: f64 },
    /// The logarithm of the width of a strip and its shear, and the inverse of ∂²W by them.
    Strip { angle: f64, values: [f64; 2], inverse: [[f64; 2]; 2] },
}

/// Residuals, and their derivatives row by row.
type Rows = (Vec<f64>, DMatrix<f64>);

impl Problem {
    fn new(model: SidesModel, tests: &[SidesTest], bounds: &[(String, [f64; 2])]) -> Result<Self, FitError> {
        if tests.is_empty() {
            return Err(FitError::NoTests);
        }
        let (mut points, mut parts) = (Vec::new(), Vec::new());
        for (index, test) in tests.iter().enumerate() {
            if tests[..index].iter().any(|other| other.name() == test.name()) {
                return Err(FitError::TestTwice { test: test.name().to_owned() });
            }
            let begin = points.len();
            points.extend(test.points(model)?);
            if points.len() == begin {
                return Err(FitError::NothingTold { test: test.name().to_owned() });
            }
            parts.push([begin, points.len()]);
        }
        let (mut names, mut ranges) = (Vec::new(), Vec::new());
        for (name, is_stress, own) in model.parameters() {
            ranges.push(Range { bounds: own, least: 1e-9 });
            names.push((name, is_stress));
        }
        let ranges = narrowed(&model.to_string(), &names, ranges, bounds)?;
        Ok(Self { model, points, parts, names, ranges })
    }

    fn rows(&self) -> usize {
        self.points.iter().map(|point| point.outputs.len()).sum()
    }

    /// Residuals over their scales with all derivatives; nothing where a side is not found or an answer is not finite.
    fn evaluate(&self, theta: &[f64]) -> Option<Rows> {
        let mut residuals = Vec::with_capacity(self.rows());
        let mut slopes = DMatrix::zeros(self.rows(), theta.len());
        let twice: Vec<Dual<Dual<f64>>> = theta.iter().map(|x| Dual::constant(Dual::constant(*x))).collect();
        let sides: Vec<Sides> = self.points.iter().map(|point| self.sides(point, &twice)).collect::<Option<_>>()?;
        for begin in (0..theta.len()).step_by(CHUNK) {
            let lifted: Vec<Dual<Gradient<f64, CHUNK>>> = theta
                .iter()
                .enumerate()
                .map(|(k, x)| Dual::constant(Gradient::variable(*x, if k < begin { CHUNK } else { k - begin })))
                .collect();
            let mut row = 0;
            for (point, sides) in self.points.iter().zip(&sides) {
                let mut at = point.base.map(Gradient::<f64, CHUNK>::lit);
                match (sides, point.free) {
                    (Sides::One { side, stiffness }, Some(free)) => {
                        let there = along(at, free, Gradient::lit(*side));
                        // At the root the side moves by −(∂²W/∂y∂θ)/(∂²W/∂y²).
                        let mut moved = -(self.slope(there, free, &lifted) / Gradient::lit(*stiffness));
                        moved.value = *side;
                        at = along(at, free, moved);
                    }
                    (Sides::Strip { angle, values, inverse }, _) => {
                        let there = [at[0], Gradient::lit(values[0]), Gradient::lit(values[1])];
                        let slopes = [1, 2].map(|k| Self::oblique_slope(*angle, there, k, &lifted));
                        for (k, value) in values.iter().enumerate() {
                            let [first, second] = inverse[k].map(Gradient::lit);
                            let mut moved = -(first * slopes[0] + second * slopes[1]);
                            moved.value = *value;
                            at[k + 1] = moved;
                        }
                    }
                    _ => {}
                }
                for (output, measured, scale) in &point.outputs {
                    let answer = match (output, point.oblique) {
                        (Output::Stress { factor, .. }, Some(angle)) => {
                            Self::oblique_slope(angle, at, 0, &lifted) * Gradient::lit(*factor)
                        }
                        (Output::Stress { direction, factor }, None) => {
                            self.slope(at, *direction, &lifted) * Gradient::lit(*factor)
                        }
                        (Output::Lateral { .. }, Some(_)) => at[1].exp(),
                        (Output::Lateral { axis }, None) => at[*axis].exp(),
                    };
                    if begin == 0 {
                        residuals.push((answer.value - measured) / scale);
                    }
                    for k in begin..theta.len().min(begin + CHUNK) {
                        slopes[(row, k)] = answer.partials[k - begin] / scale;
                    }
                    row += 1;
                }
            }
        }
        let finite = residuals.iter().chain(slopes.iter()).all(|x| x.is_finite());
        finite.then_some((residuals, slopes))
    }

    /// ∂W along a direction of the logarithms.
    fn slope<T: Real>(&self, at: [T; 3], direction: [f64; 3], parameters: &[Dual<T>]) -> T {
        let varied = [0, 1, 2].map(|a| Dual::new(at[a], T::lit(direction[a])));
        self.model.energy(varied, parameters).tangent
    }

    /// ∂W of a strip by one of its coordinates.
    fn oblique_slope<T: Real>(angle: f64, at: [T; 3], k: usize, parameters: &[Dual<T>]) -> T {
        let varied = [0, 1, 2].map(|a| Dual::new(at[a], if a == k { T::one() } else { T::zero() }));
        oblique_energy(angle, varied, parameters).tangent
    }

    /// The free sides of a point.
    fn sides(&self, point: &Point, parameters: &[Dual<Dual<f64>>]) -> Option<Sides> {
        match point.oblique {
            Some(angle) => Self::strip(angle, point, parameters),
            None => self.side(point, parameters).map(|[side, stiffness]| Sides::One { side, stiffness }),
        }
    }

    /// Width and shear of a strip, by Newton's method from the width of a body without fibres.
    fn strip(angle: f64, point: &Point, parameters: &[Dual<Dual<f64>>]) -> Option<Sides> {
        /// The longest step.
        const LONGEST: f64 = 0.3;
        let mut values = [point.start, 0.0];
        for _ in 0..100 {
            let seed = |a: usize, k: usize| if a == k { 1.0 } else { 0.0 };
            let second = |i: usize, j: usize| {
                let at = [point.base[0], values[0], values[1]];
                let varied = [0, 1, 2].map(|a| Dual::new(Dual::new(at[a], seed(a, j)), Dual::lit(seed(a, i))));
                oblique_energy(angle, varied, parameters)
            };
            let [aa, ab, bb] = [second(1, 1), second(1, 2), second(2, 2)];
            let (slopes, [a, mixed, b]) =
                ([aa.value.tangent, bb.value.tangent], [aa, ab, bb].map(|energy| energy.tangent.tangent));
            let determinant = a * b - mixed * mixed;
            let is_minimum = 0.0 < a && 0.0 < determinant;
            // Where W is not convex it falls along the slopes.
            let step = if is_minimum {
                [(mixed * slopes[1] - b * slopes[0]) / determinant, (mixed * slopes[0] - a * slopes[1]) / determinant]
            } else {
                [-slopes[0] / a.abs(), -slopes[1] / b.abs()]
            };
            if !step.iter().all(|step| step.is_finite()) {
                return None;
            }
            for (value, step) in values.iter_mut().zip(step) {
                *value += step.clamp(-LONGEST, LONGEST);
            }
            if step.iter().zip(values).all(|(step, value)| step.abs() <= 1e-15 * (1.0 + value.abs())) {
                let inverse = [[b, -mixed], [-mixed, a]].map(|row| row.map(|x| x / determinant));
                return is_minimum.then_some(Sides::Strip { angle, values, inverse });
            }
        }
        None
    }

    /// The logarithm of the free side, and ∂²W by it: Newton's method, from where sides of a body of constant volume would be.
    fn side(&self, point: &Point, parameters: &[Dual<Dual<f64>>]) -> Option<[f64; 2]> {
        /// The longest step.
        const LONGEST: f64 = 0.5;
        let Some(free) = point.free else { return Some([0.0, 1.0]) };
        let mut y = point.start;
        for _ in 0..100 {
            let varied =
                [0, 1, 2].map(|a| Dual::new(Dual::new(point.base[a] + free[a] * y, free[a]), Dual::lit(free[a])));
            let energy = self.model.energy(varied, parameters);
            let (slope, stiffness) = (energy.value.tangent, energy.tangent.tangent);
            // Where W is not convex it falls along the slope.
            let step = (-slope / stiffness.abs()).clamp(-LONGEST, LONGEST);
            if !step.is_finite() {
                return None;
            }
            y += step;
            if step.abs() <= 1e-15 * (1.0 + y.abs()) {
                return (0.0 < stiffness).then_some([y, stiffness]);
            }
        }
        None
    }

    fn report(&self, tests: &[SidesTest], theta: &[f64], squares: f64, confidence: f64) -> SidesFit {
        let (residuals, slopes) = self.evaluate(theta).unwrap_or_else(|| (Vec::new(), DMatrix::zeros(0, theta.len())));
        let (found, series) = self.residuals(tests, &residuals);
        let series: Vec<&[f64]> = series.iter().map(Vec::as_slice).collect();
        let Estimates { parameters, degrees_of_freedom, criteria, autocorrelation } =
            estimates(&self.names, theta, &self.ranges, &slopes, &series, confidence);
        SidesFit {
            model: self.model.to_string(),
            parameters,
            tests: found,
            weighted_squares: squares,
            degrees_of_freedom,
            criteria,
            autocorrelation,
            outcome: Outcome::NoFurtherDecrease,
            starts: 0,
            starts_that_agree: 0,
        }
    }

    /// Residuals of each test, and as series of neighbours.
    fn residuals(&self, tests: &[SidesTest], weighted: &[f64]) -> (Vec<SidesResiduals>, Vec<Vec<f64>>) {
        let (mut found, mut series, mut row) = (Vec::new(), Vec::new(), 0);
        for (test, [begin, end]) in tests.iter().zip(&self.parts) {
            let (mut stresses, mut laterals) = (Vec::new(), Vec::new());
            let (mut of_stresses, mut of_laterals) = (Vec::new(), Vec::new());
            for (output, _, scale) in self.points[*begin..*end].iter().flat_map(|point| &point.outputs) {
                let residual = weighted.get(row).copied().unwrap_or(f64::NAN);
                let (values, weighted) = match output {
                    Output::Stress { .. } => (&mut stresses, &mut of_stresses),
                    Output::Lateral { .. } => (&mut laterals, &mut of_laterals),
                };
                values.push(residual * scale);
                weighted.push(residual);
                row += 1;
            }
            let rms = |values: &[f64]| (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt();
            found.push(SidesResiduals {
                test: test.name().to_owned(),
                relative_rms: rms(&of_stresses),
                lateral_rms: (!laterals.is_empty()).then(|| rms(&laterals)),
                stresses,
                laterals,
            });
            series.extend([of_stresses, of_laterals]);
        }
        (found, series)
    }
}

/// x + y f.
fn along<T: Real>(x: [T; 3], direction: [f64; 3], y: T) -> [T; 3] {
    [0, 1, 2].map(|a| x[a] + T::lit(direction[a]) * y)
}

/// One walk of a search.
struct Walk<'p> {
    problem: &'p Problem,
    searched: &'p [usize],
    parameters: Vec<f64>,
}

impl Misfit for Walk<'_> {
    type State = Rows;

    fn rows(&self) -> usize {
        self.problem.rows()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Rows> {
        for (&k, &x) in self.searched.iter().zip(x) {
            self.parameters[k] = self.problem.ranges[k].outward(x)[0];
        }
        self.problem.evaluate(&self.parameters)
    }

    fn residuals<'s>(&self, (residuals, _): &'s Rows) -> &'s [f64] {
        residuals
    }

    fn jacobian(&self, (_, slopes): &Rows, x: &[f64]) -> DMatrix<f64> {
        let mut jacobian = slopes.select_columns(self.searched);
        for (column, (&k, &x)) in self.searched.iter().zip(x).enumerate() {
            jacobian.column_mut(column).scale_mut(self.problem.ranges[k].outward(x)[1]);
        }
        jacobian
    }
}

/// γ of fibres.
const ANGLES: [f64; 2] = [0.0, FRAC_PI_2];
