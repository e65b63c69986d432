//! Time–temperature superposition: shifts by overlap, and the constants of their laws.
//!
//! ```text
//! bₜ y(ω, θ) = y(ω aₜ, θ₀)      ln aₜ = (E/R) (1/θ − 1/θ₀)      log₁₀ aₜ = −C₁ (θ − θ₀)/(C₂ + θ − θ₀)
//! ```

use nalgebra::{DMatrix, Matrix2};
use piola_fit::internal::{Misfit, Range, minimise};
use piola_fit::{Covariance, Outcome, student};
use piola_fluids::{Arrhenius, TemperatureShift, WilliamsLandelFerry};

use crate::SpectraError;
use crate::error::check;

/// A modulus measured over frequencies at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsothermalCurve<'c> {
    /// ω, rad/s; 0 < ω, rising.
    pub angular_frequencies: &'c [f64],
    /// G′, G″ or |G*|, Pa; 0 < G.
    pub moduli: &'c [f64],
}

/// Horizontal shifts ln aₜ that lay each curve over its neighbour, from curves in the order of their temperatures.
///
/// The shift of two neighbours minimises the mean square of ln y − ln yₙ over the points of either that the other one
/// reaches, with ln yₙ linear between the points of the neighbour in ln ω. Each difference is weighted by the inverse of the variance that
/// equal relative errors of all points give it.
/// At least four points must overlap, and a third of the number of points of the shorter curve. `reference` is the curve whose
/// shift is zero.
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`]; [`SpectraError::OutOfBounds`] unless all numbers are positive,
/// frequencies rise, each curve has three points and `reference` is a curve;
/// [`SpectraError::NoOverlap`] where the moduli of neighbours have no range in common, or too few points overlap at any shift.
///
/// # Accuracy
/// The error of a shift is the interpolation error of ln y over the slope of the curve. It vanishes for exact power laws.
/// Plateaus do not determine a shift.
///
/// # Example
/// ```
/// use piola_spectra::{IsothermalCurve, horizontal_shifts};
/// let cold = IsothermalCurve { angular_frequencies: &[1.0, 2.0, 4.0, 8.0], moduli: &[2.0, 4.0, 8.0, 16.0] };
/// let warm = IsothermalCurve { angular_frequencies: &[1.0, 2.0, 4.0, 8.0], moduli: &[1.0, 2.0, 4.0, 8.0] };
/// // Warm times are half as long: aₜ = 1/2.
/// let shifts = horizontal_shifts(&[cold, warm], 0)?;
/// assert!((shifts[1] - 0.5_f64.ln()).abs() < 1e-6);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley, 1980, chapter 11.
pub fn horizontal_shifts(curves: &[IsothermalCurve<'_>], reference: usize) -> Result<Vec<f64>, SpectraError> {
    let curves: Vec<&[IsothermalCurve<'_>]> = curves.iter().map(core::slice::from_ref).collect();
    Ok(chained(&curves, reference, false)?.iter().map(|shift| shift.ln_horizontal).collect())
}

/// A shift along both axes.
///
/// # Example
/// See [`shifts_along_both_axes`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveShift {
    /// ln aₜ, added to ln ω.
    pub ln_horizontal: f64,
    /// ln bₜ, added to ln y.
    pub ln_vertical: f64,
    /// 95 % interval of ln aₜ for independent relative errors of the moduli, of one size; none of the reference.
    pub horizontal_interval: Option<[f64; 2]>,
    /// 95 % interval of ln bₜ.
    pub vertical_interval: Option<[f64; 2]>,
}

/// Shifts along both axes, from the curves of each temperature, such as G′ and G″, in the order of the temperatures.
///
/// ```text
/// bₜ y(ω, θ) = y(ω aₜ, θ₀)      bₜ = ρ₀ θ₀/(ρ θ) of rubber elasticity, near 1
/// ```
/// All curves of a temperature are shifted alike. The shift of two neighbours minimises the variance of ln y − ln yₙ over the points of
/// either that the other one reaches; its mean is ln bₜ.
///
/// # Errors
/// As [`horizontal_shifts`]; [`SpectraError::StraightCurves`] where neighbours overlap along straight lines of one slope only, which slide
/// along themselves: the shifts whose variance is at most four times the least reach over more than half of those tried; [`SpectraError::WrongLength`] unless every temperature has as many curves as the first.
///
/// # Accuracy
/// As [`horizontal_shifts`], over the difference of slopes along the curves instead of the slope. Noise of the moduli scatters ln bₜ
/// likewise. The intervals include this scatter. They do not include the interpolation error, and they treat the shifts of neighbouring pairs
/// as independent.
///
/// # Example
/// ```
/// use piola_spectra::{IsothermalCurve, shifts_along_both_axes};
/// // y = ω + ω²; the warm one has aₜ = 1/2 and bₜ = 1.1.
/// let frequencies: Vec<f64> = (0..25).map(|k| 10.0_f64.powf(f64::from(k) / 12.0 - 1.0)).collect();
/// let cold: Vec<f64> = frequencies.iter().map(|w| w + w * w).collect();
/// let warm: Vec<f64> = frequencies.iter().map(|w| (0.5 * w + 0.25 * w * w) / 1.1).collect();
/// let [cold, warm] = [&cold, &warm].map(|y| [IsothermalCurve { angular_frequencies: &frequencies, moduli: y }]);
/// let shifts = shifts_along_both_axes(&[&cold, &warm], 0)?;
/// assert!((shifts[1].ln_horizontal - 0.5_f64.ln()).abs() < 1e-2 && (shifts[1].ln_vertical - 1.1_f64.ln()).abs() < 1e-2);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley, 1980, chapter 11.
pub fn shifts_along_both_axes(
    curves: &[&[IsothermalCurve<'_>]],
    reference: usize,
) -> Result<Vec<CurveShift>, SpectraError> {
    chained(curves, reference, true)
}

/// Shifts of each over its neighbour, added up from the reference.
fn chained(
    curves: &[&[IsothermalCurve<'_>]],
    reference: usize,
    vertical: bool,
) -> Result<Vec<CurveShift>, SpectraError> {
    check("reference", 0, reference as f64, "reference < number of curves", reference < curves.len())?;
    let of_temperature = |curves: &&[IsothermalCurve<'_>]| curves.iter().map(logarithms).collect::<Result<Vec<_>, _>>();
    let logarithms = curves.iter().map(of_temperature).collect::<Result<Vec<_>, _>>()?;
    let expected = logarithms[0].len();
    if let Some(other) = logarithms.iter().find(|other| other.len() != expected) {
        return Err(SpectraError::WrongLength { quantity: "curves of a temperature", expected, found: other.len() });
    }
    let mut shifts = vec![CurveShift::default()];
    let mut scatter = Vec::new();
    for (first, pair) in logarithms.windows(2).enumerate() {
        let shift = overlap([&pair[0], &pair[1]], vertical, first)?;
        scatter.push(if vertical { scattered([&pair[0], &pair[1]], shift) } else { None });
        let before = shifts[first];
        shifts.push(CurveShift {
            ln_horizontal: before.ln_horizontal + shift.ln_horizontal,
            ln_vertical: before.ln_vertical + shift.ln_vertical,
            ..CurveShift::default()
        });
    }
    let zero = shifts[reference];
    for (index, shift) in shifts.iter_mut().enumerate() {
        shift.ln_horizontal -= zero.ln_horizontal;
        shift.ln_vertical -= zero.ln_vertical;
        // Of the pairs between this curve and the reference.
        let pairs = &scatter[index.min(reference)..index.max(reference)];
        let Some(pairs) = pairs.iter().copied().collect::<Option<Vec<Scatter>>>().filter(|pairs| !pairs.is_empty())
        else {
            continue;
        };
        let degrees = pairs.iter().map(|pair| pair.degrees).min().unwrap_or(0);
        let half = |axis: usize| {
            let variance: f64 = pairs.iter().map(|pair| pair.variances[axis]).sum();
            student(0.95, degrees).map(|t| t * variance.sqrt())
        };
        let about = |at: f64, half: Option<f64>| half.map(|half| [at - half, at + half]);
        shift.horizontal_interval = about(shift.ln_horizontal, half(0));
        shift.vertical_interval = about(shift.ln_vertical, half(1));
    }
    Ok(shifts)
}

/// The points (ln ω, ln y) of a curve.
fn logarithms(curve: &IsothermalCurve<'_>) -> Result<Vec<[f64; 2]>, SpectraError> {
    let (frequencies, moduli) = (curve.angular_frequencies, curve.moduli);
    if frequencies.len() != moduli.len() {
        return Err(SpectraError::WrongLength {
            quantity: "modulus",
            expected: frequencies.len(),
            found: moduli.len(),
        });
    }
    check("number of points", 0, moduli.len() as f64, "3 ≤ number of points", 3 <= moduli.len())?;
    let mut last = 0.0;
    for (index, (&frequency, &modulus)) in frequencies.iter().zip(moduli).enumerate() {
        check("angular frequency", index, frequency, "0 < ω, rising", last < frequency)?;
        check("modulus", index, modulus, "0 < G", 0.0 < modulus)?;
        last = frequency;
    }
    Ok(frequencies.iter().zip(moduli).map(|(w, y)| [w.ln(), y.ln()]).collect())
}

/// ln y of a curve at ln ω between its points, the point after it, and the share of that point; `None` outside.
fn between(curve: &[[f64; 2]], at: f64) -> Option<(f64, usize, f64)> {
    let next = curve.partition_point(|point| point[0] < at).max(1);
    let ([x0, y0], [x, y]) = (curve[next - 1], *curve.get(next)?);
    let share = (at - x0) / (x - x0);
    (x0 <= at).then_some((y0 + share * (y - y0), next, share))
}

/// The weight of a difference from what lies between two points: noise of all points has the variance 1/weight there. Without it shifts by
/// half a step, where noise is averaged, would seem to fit best.
fn weight(share: f64) -> f64 {
    (1.0 + share * share + (1.0 - share) * (1.0 - share)).recip()
}

/// What is left between curves at a shift: the number of differences ln y − ln yₙ, their weighted mean, their squares by their weights over
/// the number, and the same about the mean.
#[derive(Clone, Copy)]
struct Gap {
    count: usize,
    mean: f64,
    mean_square: f64,
    variance: f64,
}

fn gap(fixed: &[Vec<[f64; 2]>], moved: &[Vec<[f64; 2]>], shift: f64) -> Gap {
    let (mut count, mut sums) = (0_usize, [0.0; 3]);
    let mut add = |difference: f64, share: f64| {
        count += 1;
        for (sum, term) in sums.iter_mut().zip([1.0, difference, difference * difference]) {
            *sum += weight(share) * term;
        }
    };
    for (fixed, moved) in fixed.iter().zip(moved) {
        for &[x, y] in moved {
            if let Some((there, _, share)) = between(fixed, x + shift) {
                add(there - y, share);
            }
        }
        for &[x, y] in fixed {
            if let Some((there, _, share)) = between(moved, x - shift) {
                add(y - there, share);
            }
        }
    }
    let [weights, first, second] = sums;
    let mean = first / weights;
    let [mean_square, variance] = [second, second - mean * first].map(|sum| sum / count as f64);
    Gap { count, mean, mean_square, variance }
}

/// The scatter of a shift along both axes by noise.
#[derive(Clone, Copy)]
struct Scatter {
    /// Variances of ln a and ln b.
    variances: [f64; 2],
    degrees: usize,
}

/// The scatter of the shift of least weighted squares: differences d = ln yₙ − ln y of all points, of which each holds the errors of three.
///
/// ```text
/// d = A (δ ln a, ln b) + L ε      A = (slope, 1)      wᵢ = 1/(LLᵀ)ᵢᵢ      σ² = Σ w d²/n
/// Cov = σ² (AᵀWA)⁻¹ AᵀWL LᵀWA (AᵀWA)⁻¹
/// ```
fn scattered([fixed, moved]: [&[Vec<[f64; 2]>]; 2], shift: CurveShift) -> Option<Scatter> {
    let (mut normal, mut noise) = ([[0.0; 2]; 2], [[0.0; 2]; 2]);
    let (mut squares, mut count) = (0.0, 0_usize);
    for (fixed, moved) in fixed.iter().zip(moved) {
        // AᵀWL by the points of either curve.
        let mut loads = [vec![[0.0; 2]; fixed.len()], vec![[0.0; 2]; moved.len()]];
        for (own, (curve, other, sign)) in [(1, (moved, fixed, 1.0)), (0, (fixed, moved, -1.0))] {
            for (place, &[x, y]) in curve.iter().enumerate() {
                let Some((there, next, share)) = between(other, x + sign * shift.ln_horizontal) else { continue };
                // Over some points: noise of two neighbours would be taken for slopes.
                let (a, b) = (other[next.saturating_sub(4)], other[(next + 3).min(other.len() - 1)]);
                let row = [(b[1] - a[1]) / (b[0] - a[0]), 1.0];
                let (difference, weight) = (sign * (there - y) - shift.ln_vertical, weight(share));
                for (i, normal) in normal.iter_mut().enumerate() {
                    for (j, entry) in normal.iter_mut().enumerate() {
                        *entry += weight * row[i] * row[j];
                    }
                    let load = sign * weight * row[i];
                    loads[own][place][i] -= load;
                    loads[1 - own][next - 1][i] += load * (1.0 - share);
                    loads[1 - own][next][i] += load * share;
                }
                squares += weight * difference * difference;
                count += 1;
            }
        }
        for load in loads.iter().flatten() {
            for (i, noise) in noise.iter_mut().enumerate() {
                for (j, entry) in noise.iter_mut().enumerate() {
                    *entry += load[i] * load[j];
                }
            }
        }
    }
    let inverse = Matrix2::from(normal).try_inverse()?;
    let covariance = inverse * Matrix2::from(noise) * inverse * (squares / count as f64);
    // Each pair of points is compared twice.
    let degrees = (count / 2).checked_sub(2).filter(|degrees| 0 < *degrees)?;
    let variances = [covariance[(0, 0)], covariance[(1, 1)]];
    variances.iter().all(|x| x.is_finite()).then_some(Scatter { variances, degrees })
}

/// The shift that lays `moved` over `fixed`, curve by curve.
fn overlap([fixed, moved]: [&[Vec<[f64; 2]>]; 2], vertical: bool, first: usize) -> Result<CurveShift, SpectraError> {
    const STEPS: u32 = 400;
    /// Shifts with a misfit of at most this times the least fit about as well.
    const AS_WELL: f64 = 4.0;
    /// A variance of ln y that is rounding of its squares.
    const ROUNDING: f64 = 1e-12;
    let apart = SpectraError::NoOverlap { first, second: first + 1 };
    let widen = |ends: [f64; 2], value: f64| [ends[0].min(value), ends[1].max(value)];
    let range = |curves: &[Vec<[f64; 2]>], axis: usize| {
        curves.iter().flatten().fold([f64::INFINITY, f64::NEG_INFINITY], |ends, point| widen(ends, point[axis]))
    };
    for (fixed, moved) in fixed.iter().zip(moved) {
        let [[low, high], [lower, higher]] =
            [fixed, moved].map(|curve| curve.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |e, p| widen(e, p[1])));
        if high < lower || higher < low {
            return Err(apart);
        }
    }
    // Of both temperatures together; a pair of points alone matches anywhere.
    let points = |curves: &[Vec<[f64; 2]>]| curves.iter().map(Vec::len).sum::<usize>();
    let least = (points(fixed).min(points(moved)) / 3).max(4 * fixed.len());
    let misfit = |shift: f64| {
        let Gap { count, mean_square, variance, .. } = gap(fixed, moved, shift);
        match (least <= count, vertical) {
            (false, _) => f64::INFINITY,
            (_, false) => mean_square,
            (_, true) => variance,
        }
    };
    let ([start, end], [from, to]) = (range(fixed, 0), range(moved, 0));
    let (low, high) = (start - to, end - from);
    let step = (high - low) / f64::from(STEPS);
    let grid = (0..=STEPS).map(|k| low + step * f64::from(k)).map(|shift| [shift, misfit(shift)]);
    let tried: Vec<[f64; 2]> = grid.filter(|[_, misfit]| misfit.is_finite()).collect();
    let Some([best, least_misfit]) = tried.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])) else {
        return Err(apart);
    };
    // Straight lines of one slope slide along themselves: their valley is as long as the search, whatever the noise.
    let length = |largest: f64| {
        let within = tried.iter().filter(|[_, misfit]| *misfit <= largest);
        let [from, to] = within.fold([best; 2], |ends, [shift, _]| widen(ends, *shift));
        to - from
    };
    if vertical && 0.5 * length(f64::INFINITY) < length(AS_WELL * least_misfit + ROUNDING) {
        return Err(SpectraError::StraightCurves { first, second: first + 1 });
    }
    // Golden section about the best point of the grid.
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut a, mut b) = (best - step, best + step);
    for _ in 0..60 {
        let (left, right) = (b - share * (b - a), a + share * (b - a));
        if misfit(left) <= misfit(right) { b = right } else { a = left }
    }
    // Where too few points overlap beside a narrow window the section may have left it.
    let middle = 0.5 * (a + b);
    let ln_horizontal = if misfit(middle) <= least_misfit { middle } else { best };
    let Gap { mean, .. } = gap(fixed, moved, ln_horizontal);
    Ok(CurveShift { ln_horizontal, ln_vertical: if vertical { mean } else { 0.0 }, ..CurveShift::default() })
}

/// A law of temperature fitted to shifts, with 95 % intervals of its constants.
#[derive(Clone, Debug, PartialEq)]
pub struct ShiftFit<L, const N: usize> {
    /// The law.
    pub law: L,
    /// 95 % interval of each constant; `None` where the data do not determine it, or are as many as the constants.
    pub intervals: [Option<[f64; 2]>; N],
    /// √(S/m): the error of ln aₜ at the m temperatures beside the reference, root mean square.
    pub error: f64,
    /// How the search ended.
    pub outcome: Outcome,
}

/// Residuals of ln aₜ over positive constants; a law is made from them.
struct Shifts<'s, L, const N: usize> {
    temperatures: &'s [f64],
    logarithms: &'s [f64],
    law: &'s dyn Fn([f64; N]) -> Option<L>,
    slopes: &'s dyn Fn([f64; N], f64) -> [f64; N],
}

impl<L: TemperatureShift, const N: usize> Shifts<'_, L, N> {
    fn constants(x: &[f64]) -> [f64; N] {
        core::array::from_fn(|k| Range::POSITIVE.outward(x[k])[0])
    }
}

impl<L: TemperatureShift, const N: usize> Misfit for Shifts<'_, L, N> {
    type State = ([f64; N], Vec<f64>);

    fn rows(&self) -> usize {
        self.temperatures.len()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        let constants = Self::constants(x);
        let law = (self.law)(constants)?;
        let rows = self.temperatures.iter().zip(self.logarithms);
        let residuals = rows.map(|(&t, measured)| Some(law.logarithm(t).ok()? - measured)).collect::<Option<_>>()?;
        Some((constants, residuals))
    }

    fn residuals<'s>(&self, state: &'s Self::State) -> &'s [f64] {
        &state.1
    }

    fn jacobian(&self, state: &Self::State, _: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows(), N, |row, k| state.0[k] * (self.slopes)(state.0, self.temperatures[row])[k])
    }
}

/// Fits positive constants from `start`.
fn fit<L: TemperatureShift, const N: usize>(
    shifts: Shifts<'_, L, N>,
    start: [f64; N],
) -> Result<ShiftFit<L, N>, SpectraError> {
    let (found, expected) = (shifts.logarithms.len(), shifts.temperatures.len());
    if found != expected {
        return Err(SpectraError::WrongLength { quantity: "ln aₜ", expected, found });
    }
    for (index, (&t, &logarithm)) in shifts.temperatures.iter().zip(shifts.logarithms).enumerate() {
        check("temperature", index, t, "0 < θ", 0.0 < t)?;
        check("ln aₜ", index, logarithm, "finite", true)?;
    }
    // The law is zero at the reference temperature, whatever its constants: a shift there tells nothing.
    let tells = |t: &&f64| (shifts.slopes)(start, **t).iter().any(|slope| 0.0 < slope.abs());
    let told = shifts.temperatures.iter().filter(tells).count();
    let bound = "number of constants ≤ number of temperatures beside the reference";
    check("number of temperatures beside the reference", 0, told as f64, bound, N <= told)?;
    let none = SpectraError::NoShift { law: L::NAME };
    let x = start.map(|value| Range::POSITIVE.inward(value)).to_vec();
    let law = shifts.law;
    let end = minimise(shifts, x, 200, &|| false).ok_or_else(|| none.clone())?;
    let (constants, residuals) = &end.state;
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let degrees = told - N;
    let free: Vec<usize> = (0..N).collect();
    let covariance = Covariance::new(&end.misfit.jacobian(&end.state, &[]), &free, squares / degrees.max(1) as f64);
    // As many shifts as constants leave no errors.
    let factor = student(0.95, degrees).filter(|_| 0 < degrees);
    let intervals = core::array::from_fn(|k| {
        let place = covariance.parameters.iter().position(|&other| other == k)?;
        let half = factor? * covariance.matrix[place][place].sqrt();
        Some([constants[k] * (-half).exp(), constants[k] * half.exp()])
    });
    Ok(ShiftFit {
        law: law(*constants).ok_or(none)?,
        intervals,
        error: (squares / told as f64).sqrt(),
        outcome: end.outcome,
    })
}

/// The activation energy of Arrhenius from shifts ln aₜ at temperatures, K, by least squares of ln aₜ.
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`]; [`SpectraError::OutOfBounds`] of temperatures, or where
/// none is beside the reference; [`SpectraError::Fluids`] of the reference temperature; [`SpectraError::NoShift`] where no law was found.
///
/// # Example
/// ```
/// use piola_spectra::fit_arrhenius;
/// // E/R = 1200 K: ln aₜ = 1200 (1/θ − 1/300).
/// let fit = fit_arrhenius(&[300.0, 400.0], &[0.0, -1.0], 300.0)?;
/// assert!((fit.law.activation_energy() / 8.31446261815324 - 1200.0).abs() < 1e-3);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
pub fn fit_arrhenius(
    temperatures: &[f64],
    logarithms: &[f64],
    reference_temperature: f64,
) -> Result<ShiftFit<Arrhenius, 1>, SpectraError> {
    let unit = Arrhenius::new(1.0, reference_temperature)?;
    let law = |[energy]: [f64; 1]| Arrhenius::new(energy, reference_temperature).ok();
    let slopes = |_: [f64; 1], t: f64| [unit.logarithm(t).unwrap_or(f64::NAN)];
    fit(Shifts { temperatures, logarithms, law: &law, slopes: &slopes }, [5e4])
}

/// The constants C₁ and C₂, K, of Williams, Landel and Ferry from shifts ln aₜ at temperatures, K, by least squares of ln aₜ.
///
/// # Errors
/// As [`fit_arrhenius`], with two temperatures or more beside the reference.
pub fn fit_williams_landel_ferry(
    temperatures: &[f64],
    logarithms: &[f64],
    reference_temperature: f64,
) -> Result<ShiftFit<WilliamsLandelFerry, 2>, SpectraError> {
    let start = [8.86, 101.6];
    // Refuses a reference temperature that is none.
    WilliamsLandelFerry::new(start[0], start[1], reference_temperature)?;
    let law = |[strength, width]: [f64; 2]| WilliamsLandelFerry::new(strength, width, reference_temperature).ok();
    let slopes = |[strength, width]: [f64; 2], t: f64| {
        let above = t - reference_temperature;
        let share = above / (width + above) * core::f64::consts::LN_10;
        [-share, strength * share / (width + above)]
    };
    let lowest = temperatures.iter().fold(reference_temperature, |least: f64, &t| least.min(t));
    let start = [start[0], start[1].max(2.0 * (reference_temperature - lowest))];
    fit(Shifts { temperatures, logarithms, law: &law, slopes: &slopes }, start)
}
