//! Curves recovered from tables, with their bands.

use nalgebra::DVector;

use super::band::{WIDEST, critical, selected};
use super::rule::{Below, ONE_POWER, Rule, assumed, coarse};
use super::smoother::{Penalised, Smoother};
use super::smoothing::{Criterion, Curve, EXACT, Fitted, Smoothing, thinned};
use super::table::{FlowTable, Noise};
use super::yielding::{Kink, yielding};
use crate::ViscometryError;

/// Assumption on the response below the smallest torque of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum BelowSmallest {
    /// Nothing: the recovered quantity is local.
    NotNeeded,
    /// ΔΩ is proportional to the torque.
    Newtonian,
    /// ΔΩ is a power of the torque.
    PowerLaw {
        /// Its exponent, d ln ΔΩ/d ln M.
        exponent: f64,
    },
    /// ΔΩ is a sum of powers of the torque.
    Powers {
        /// The mean of their exponents at the smallest torque, d ln ΔΩ/d ln M.
        mean: f64,
        /// The variance of their exponents there, d² ln ΔΩ/(d ln M)².
        variance: f64,
    },
    /// The fluid seems to yield. Below, the shear rate rises with the stress from none: bands hold every curve that does.
    Yield,
}

/// Whether the recovered curve rises with its abscissa, as the shear stress of a stable fluid does with the shear rate.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Monotonicity {
    /// It does.
    Rising,
    /// It does not between these abscissas, the first interval of several.
    Falling {
        /// From here, Pa or 1/s.
        from: f64,
        /// To here.
        to: f64,
    },
}

/// Treatment of a smoothed curve that does not rise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Rise {
    /// It is reported.
    #[default]
    Reported,
    /// It is smoothed further until it rises.
    Enforced,
}

/// Options of a recovery.
///
/// # Example
/// ```
/// use piola_viscometry::recover::{self, BelowSmallest, FlowTable, Options, Rise};
/// let factor = 0.75 / (4.0 * core::f64::consts::PI); // ΔΩ/M of a Newtonian fluid of viscosity 1, R₂ = 2 R₁
/// let rows: Vec<_> = (1..=12).map(f64::from).map(|torque| [torque, factor * torque]).collect();
/// let options = Options { rise: Rise::Enforced, below_smallest: Some(BelowSmallest::Newtonian) };
/// let curve = recover::couette_with(&FlowTable::couette(1.0, 2.0, &rows)?, options)?;
/// assert!((curve.at(1.0)?.shear_rate - 1.0).abs() < 1e-12);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Options {
    /// Treatment of a smoothed curve that does not rise.
    pub rise: Rise,
    /// Assumption below the smallest torque; found from the table unless given as `Newtonian` or `PowerLaw`.
    pub below_smallest: Option<BelowSmallest>,
}

/// Points between two rows at which bands are known.
pub(super) const FINE: usize = 4;
/// The degree of a curve through exact rows.
pub(super) const DEGREE: usize = 7;
/// Bands hold this times the differences between curves that differ in nothing but degree or one row.
pub(super) const SAFETY: f64 = 2.0;
/// Rows left out one at a time, at most.
pub(super) const LEFT_OUT: usize = 40;

/// A recovered curve: abscissas, the recovered quantity, and what bands follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Recovered {
    rule: Rule,
    main: Curve,
    /// Curves through exact rows that could be as true.
    others: Vec<Curve>,
    /// The errors of the main curve, if it is smoothed.
    penalised: Option<Penalised>,
    /// Relative noise of an interpolated curve.
    level: f64,
    /// ln drive and ln response of the rows.
    u: Vec<f64>,
    y: Vec<f64>,
    /// The rows, or of many rows some: between them terms of the series and bands are known.
    grid: Vec<f64>,
    /// Abscissa over drive.
    scale: f64,
    /// Terms of the series in each interval between rows.
    terms: Vec<usize>,
    pub(super) smoothing: Smoothing,
    pub(super) below: BelowSmallest,
    pub(super) monotonicity: Monotonicity,
    pub(super) residuals: Vec<f64>,
    /// The abscissa from which on all values are known.
    known_from: f64,
    /// The confidence and the half widths of ln at the fine points.
    band: Option<(f64, Vec<f64>)>,
}

/// At each fine point, the largest value within two rows.
pub(super) fn envelope(values: &[f64]) -> Vec<f64> {
    let reach = 2 * FINE;
    let around = |i: usize| &values[i.saturating_sub(reach)..values.len().min(i + reach + 1)];
    (0..values.len()).map(|i| around(i).iter().copied().fold(0.0, f64::max)).collect()
}

impl Recovered {
    pub(super) fn new<G>(
        table: &FlowTable<G>,
        rule: Rule,
        scale: f64,
        options: Options,
    ) -> Result<Self, ViscometryError> {
        Self::of(table, rule, scale, options, true)
    }

    /// Of normal stresses, of which no theory says that they rise from none at a yield stress.
    pub(super) fn without_yield<G>(
        table: &FlowTable<G>,
        rule: Rule,
        scale: f64,
        options: Options,
    ) -> Result<Self, ViscometryError> {
        Self::of(table, rule, scale, options, false)
    }

    fn of<G>(
        table: &FlowTable<G>,
        rule: Rule,
        scale: f64,
        options: Options,
        may_yield: bool,
    ) -> Result<Self, ViscometryError> {
        table.check_rows()?;
        table.check_rising()?;
        let u: Vec<f64> = table.drive.iter().map(|x| x.ln()).collect();
        let y: Vec<f64> = table.response.iter().map(|x| x.ln()).collect();
        let level = table.level();
        let singular = || ViscometryError::RowsTooClose { rows: u.len() };
        let exponent = match options.below_smallest {
            Some(BelowSmallest::Newtonian) => Some(1.0),
            Some(BelowSmallest::PowerLaw { exponent }) => Some(exponent),
            _ => None,
        };
        let rule = assumed(rule, exponent);
        let mut recovered = if level <= EXACT {
            let main = Fitted::through(&u, &y, DEGREE).ok_or_else(singular)?;
            let others = [DEGREE - 2, DEGREE + 2].iter().filter_map(|degree| Fitted::through(&u, &y, *degree));
            let others = others.map(Curve::Through).collect();
            let smoothing = Smoothing {
                criterion: Criterion::Interpolation,
                noise: level,
                parameter: 0.0,
                degrees_of_freedom: u.len() as f64,
                raised: false,
            };
            Self::assembled(rule, Curve::Through(main), others, None, smoothing, (u, y, scale))
        } else {
            let known = matches!(table.noise, Noise::Relative(_));
            let smoother = Smoother::new(&u, &y, level, known).ok_or_else(singular)?;
            let mut choice = smoother.choose().ok_or_else(singular)?;
            let make = |choice: &_, raised| {
                let fit = smoother.fit(choice, raised).ok_or_else(singular)?;
                let (main, smoothing) = (Curve::Smooth(fit.curve.clone()), fit.smoothing);
                let rule = coarse(rule);
                let rule = if may_yield { yielding(rule, &main, [u[0], u[u.len() - 1]]) } else { rule };
                let rows = (u.clone(), y.clone(), scale);
                Ok::<_, ViscometryError>(Self::assembled(rule, main, Vec::new(), Some(fit), smoothing, rows))
            };
            let mut made = make(&choice, false)?;
            if options.rise == Rise::Enforced {
                while made.monotonicity()? != Monotonicity::Rising {
                    let Some(next) = smoother.smoother(&choice) else { break };
                    choice = next;
                    made = make(&choice, true)?;
                }
            }
            made
        };
        recovered.level = level;
        recovered.known_from = recovered.first_known();
        if recovered.is_unknown(recovered.u[recovered.u.len() - 1]) {
            return Err(ViscometryError::YieldUnknown { rows: recovered.u.len(), above: recovered.known_from });
        }
        recovered.choose_terms();
        recovered.monotonicity = recovered.monotonicity()?;
        recovered.below = recovered.assumption(options.below_smallest);
        Ok(recovered)
    }

    fn assembled(
        rule: Rule,
        main: Curve,
        others: Vec<Curve>,
        penalised: Option<Penalised>,
        smoothing: Smoothing,
        (u, y, scale): (Vec<f64>, Vec<f64>, f64),
    ) -> Self {
        let grid = thinned(&u);
        let terms = grid.windows(2).map(|pair| rule.most_terms(pair[0], u[0])).collect();
        let residuals = u.iter().zip(&y).map(|(u, y)| (y - main.at(*u)[0]).exp_m1()).collect();
        Self {
            rule,
            main,
            others,
            penalised,
            level: 0.0,
            u,
            y,
            grid,
            scale,
            terms,
            smoothing,
            below: BelowSmallest::NotNeeded,
            monotonicity: Monotonicity::Rising,
            residuals,
            known_from: 0.0,
            band: None,
        }
    }

    /// In each interval, as many terms as make the result depend least on the curve and on the rest.
    fn choose_terms(&mut self) {
        if self.penalised.is_some() || !matches!(self.rule, Rule::Series { below: Below::Powers, .. }) {
            return;
        }
        for interval in 0..self.terms.len() {
            let at = [self.grid[interval], self.grid[interval + 1]];
            let doubt = |terms: usize| {
                let spread = |u| self.spread(&self.others, u, terms);
                at.into_iter().map(spread).fold(0.0, f64::max)
            };
            let most = self.terms[interval];
            let best = (0..=most).rev().min_by(|&a, &b| doubt(a).total_cmp(&doubt(b)));
            self.terms[interval] = best.unwrap_or(most);
        }
    }

    /// The largest difference to other curves, with what the rest may be off.
    fn spread(&self, others: &[Curve], u: f64, terms: usize) -> f64 {
        let Some([value, rest]) = self.rule.value(&self.main, u, terms) else { return f64::INFINITY };
        others.iter().fold(rest, |most, other| match self.rule.value(other, u, terms) {
            Some([other, _]) => most.max((other - value).abs() + rest),
            None => f64::INFINITY,
        })
    }

    /// The interval of u, whose terms hold there.
    fn interval(&self, u: f64) -> usize {
        self.grid[1..self.grid.len() - 1].partition_point(|row| *row <= u)
    }

    fn logarithm(&self, u: f64) -> Option<f64> {
        self.rule.value(&self.main, u, self.terms[self.interval(u)]).map(|[value, _]| value)
    }

    /// The fine points, `FINE` in each interval and the last row.
    fn fine(&self) -> impl Iterator<Item = f64> + '_ {
        let inside = |pair: &[f64]| {
            let [a, b] = [pair[0], pair[1]];
            (0..FINE).map(move |k| a + (b - a) * k as f64 / FINE as f64)
        };
        self.grid.windows(2).flat_map(inside).chain(self.grid.last().copied())
    }

    fn abscissa(&self, u: f64) -> f64 {
        self.scale * u.exp()
    }

    fn monotonicity(&self) -> Result<Monotonicity, ViscometryError> {
        let mut previous: Option<[f64; 2]> = None;
        for u in self.fine().filter(|u| !self.is_unknown(*u)) {
            let Some(value) = self.logarithm(u) else {
                return Err(ViscometryError::NotRecovered { at: self.abscissa(u) });
            };
            if let Some([before, lower]) = previous
                && value < lower
            {
                return Ok(Monotonicity::Falling { from: self.abscissa(before), to: self.abscissa(u) });
            }
            previous = Some([u, value]);
        }
        Ok(Monotonicity::Rising)
    }

    /// Whether the value at u of a fluid that seems to yield depends on responses below the smallest drive by more than 39 % of it.
    fn is_unknown(&self, u: f64) -> bool {
        /// The most that ln value may be off, downwards: 1 − e^(−½) of the value.
        const UNKNOWN: f64 = 0.5;
        let terms = self.terms[self.interval(u)];
        let value = || self.rule.value(&self.main, u, terms);
        self.rule.yields() && value().is_none_or(|[_, doubt]| UNKNOWN < doubt)
    }

    /// The abscissa from which on all values are known, of a fluid that seems to yield.
    fn first_known(&self) -> f64 {
        let mut known = None;
        for u in self.fine() {
            known = if self.is_unknown(u) { None } else { known.or(Some(u)) };
        }
        self.abscissa(known.unwrap_or_else(|| match self.rule {
            // Beyond the table, where it is enough that the smallest drive is a step below.
            Rule::Series { step, .. } => self.u[0] + step,
            _ => self.u[0],
        }))
    }

    fn assumption(&self, given: Option<BelowSmallest>) -> BelowSmallest {
        let [_, mean, variance, ..] = self.main.at(self.u[0]);
        match (self.rule, given) {
            (Rule::Plain { .. } | Rule::Local { .. }, _) => BelowSmallest::NotNeeded,
            (_, Some(given @ (BelowSmallest::Newtonian | BelowSmallest::PowerLaw { .. }))) => given,
            (Rule::Series { .. }, _) if self.rule.yields() => BelowSmallest::Yield,
            (Rule::Series { step, .. }, _) => {
                let told = ONE_POWER < (variance * step * step).abs();
                match (told, (mean - 1.0).abs() < 1e-9) {
                    (true, _) => BelowSmallest::Powers { mean, variance },
                    (false, true) => BelowSmallest::Newtonian,
                    (false, false) => BelowSmallest::PowerLaw { exponent: mean },
                }
            }
        }
    }

    /// The same with a band.
    pub(super) fn with_band(mut self, confidence: f64) -> Result<Self, ViscometryError> {
        if !(0.0 < confidence && confidence < 1.0) {
            return Err(ViscometryError::ConfidenceOutOfRange { value: confidence });
        }
        let fine: Vec<f64> = self.fine().collect();
        let half = match &self.penalised {
            Some(penalised) => self.smoothed(penalised, &fine, confidence),
            None => self.interpolated(&fine, confidence),
        };
        self.band = Some((confidence, half));
        Ok(self)
    }

    /// The differences to other curves, at the fine points.
    fn differences(&self, others: &[Curve], fine: &[f64]) -> Vec<f64> {
        let all: Vec<f64> = fine.iter().map(|&u| self.spread(others, u, self.terms[self.interval(u)])).collect();
        envelope(&all)
    }

    /// Simultaneous bands of a smoothed curve, with what the responses below the smallest drive may be off.
    fn smoothed(&self, penalised: &Penalised, fine: &[f64], confidence: f64) -> Vec<f64> {
        let count = penalised.curve.count();
        let mut length = 0.0;
        let mut direction: Option<DVector<f64>> = None;
        let mut deviations = Vec::with_capacity(fine.len());
        for &u in fine {
            let mut row = DVector::zeros(count);
            self.rule.gradient(&self.main, u, self.terms[self.interval(u)], row.as_mut_slice());
            let mapped = penalised.root.tr_mul(&row);
            let deviation = mapped.norm();
            let unit = mapped / deviation;
            if let Some(before) = &direction {
                length += (&unit - before).norm();
            }
            direction = Some(unit);
            deviations.push(deviation);
        }
        let factor = selected(penalised.smoothing.degrees_of_freedom);
        let critical = factor * critical(length, penalised.freedom, confidence);
        let kink = self.kink();
        let doubts = fine.iter().map(|&u| {
            let of_kink = kink.map_or(0.0, |kink| kink.doubt(u, self.logarithm(u)));
            self.spread(&[], u, self.terms[self.interval(u)]) + of_kink
        });
        deviations.iter().zip(doubts).map(|(deviation, doubt)| critical * deviation + doubt).collect()
    }

    /// Where the fluid of the smallest torque, which seems to yield, begins to flow at the outer cylinder.
    fn kink(&self) -> Option<Kink> {
        /// The part of the range below which no kink is resolved.
        const PART: f64 = 1.0 / 40.0;
        let Rule::Series { step, below: Below::Yield { lowest }, .. } = self.rule else { return None };
        // ΔΩ begins at the yield torque as a power of the excess, of Bingham's fluid the second.
        let slope = self.main.at(lowest)[1];
        let at = [(lowest + step + (-2.0 / slope).ln_1p()).max(lowest), lowest + step];
        let spacing = |at: f64| {
            let above = self.u.partition_point(|u| *u <= at);
            Some(self.u.get(above)? - self.u[above - 1])
        };
        let spacing = spacing(at[0])?.max(spacing(at[1]).unwrap_or(0.0));
        let width = spacing.max(PART * (self.u[self.u.len() - 1] - lowest));
        let rate = |u: f64| self.logarithm(u).map(f64::exp);
        // The rise at the yield torque, where the rate begins, from those beyond the lowest row: a rate that begins as a higher power than the
        // first does not bend the curve.
        let beside = width.min(step / 3.0);
        let [first, second, third] = [rate(lowest)?, rate(lowest + beside)?, rate(lowest + 2.0 * beside)?];
        let rises = [(second - first) / beside, (third - second) / beside];
        let rise = rises[0] - (rises[1] - rises[0]) * (0.5 + 2.0 / (slope * beside));
        Some(Kink { at, width, rise })
    }

    /// Bands of an interpolated curve: what other degrees and rows left out would change, what rounding and noise below
    /// [`EXACT`] may.
    fn interpolated(&self, fine: &[f64], confidence: f64) -> Vec<f64> {
        let rows = self.u.len();
        let stride = rows.div_ceil(LEFT_OUT);
        let without = |values: &[f64], row: usize| -> Vec<f64> {
            values.iter().enumerate().filter(|&(i, _)| i != row).map(|(_, x)| *x).collect()
        };
        // The ends are left out only inside: beyond the rows nothing is recovered.
        let left_out = (1..rows - 1)
            .step_by(stride)
            .filter_map(|row| Fitted::through(&without(&self.u, row), &without(&self.y, row), DEGREE));
        let left_out = left_out.map(Curve::Through);
        let others: Vec<Curve> = self.others.iter().cloned().chain(left_out).collect();
        let differences = self.differences(&others, fine);
        let factors = self.main.factors(&self.u);
        let quantile = critical(0.0, f64::INFINITY, 1.0 - (1.0 - confidence) / rows as f64);
        let size = |row: usize| {
            let slope = self.main.at(self.u[row])[1].abs();
            4.0 * f64::EPSILON * (1.0 + self.y[row].abs() + (1.0 + self.u[row].abs()) * slope)
        };
        let sizes: Vec<f64> = (0..rows).map(size).collect();
        let mut row = vec![0.0; rows];
        let mut noise = |u: f64| {
            let Some(factors) = &factors else { return f64::INFINITY };
            row.fill(0.0);
            self.rule.gradient(&self.main, u, self.terms[self.interval(u)], &mut row);
            let told = factors.solve_transposed(&mut row);
            let mapped = row[told.clone()].iter().zip(&sizes[told]);
            let (rounding, squares) = mapped.fold((0.0, 0.0), |(rounding, squares), (weight, size)| {
                (rounding + weight.abs() * size, squares + weight * weight)
            });
            rounding + quantile * self.level * squares.sqrt() + 8.0 * f64::EPSILON
        };
        fine.iter().zip(differences).map(|(&u, other)| SAFETY * other + noise(u)).collect()
    }

    pub(super) fn confidence(&self) -> Option<f64> {
        self.band.as_ref().map(|(confidence, _)| *confidence)
    }

    /// The abscissas of the rows.
    pub(super) fn abscissas(&self) -> impl Iterator<Item = f64> + '_ {
        self.u.iter().map(|u| self.abscissa(*u))
    }

    /// The value at an abscissa and its band.
    pub(super) fn at(&self, abscissa: f64) -> Result<(f64, Option<[f64; 2]>), ViscometryError> {
        let (lowest, highest) = (self.u[0], self.u[self.u.len() - 1]);
        let u = (abscissa / self.scale).ln();
        // An abscissa of a row may have been rounded beyond the ends.
        let slack = 8.0 * f64::EPSILON * (1.0 + u.abs());
        if !(lowest - slack <= u && u <= highest + slack) {
            let [lowest, highest] = [lowest, highest].map(|u| self.abscissa(u));
            return Err(ViscometryError::NotMeasured { value: abscissa, lowest, highest });
        }
        let u = u.max(lowest).min(highest);
        if self.is_unknown(u) {
            return Err(ViscometryError::YieldUnknown { rows: self.u.len(), above: self.known_from });
        }
        let logarithm = self.logarithm(u).ok_or(ViscometryError::NotRecovered { at: abscissa })?;
        let value = logarithm.exp();
        let half = self.band.as_ref().map(|(_, half)| {
            let interval = self.interval(u);
            let part = (u - self.grid[interval]) / (self.grid[interval + 1] - self.grid[interval]);
            let first = FINE * interval + (1..FINE).take_while(|k| *k as f64 <= part * FINE as f64).count();
            half[first].max(half[first + 1])
        });
        if half.is_some_and(|half| half.is_nan() || WIDEST < half) {
            return Err(ViscometryError::NotDetermined { at: abscissa });
        }
        Ok((value, half.map(|half| [value * (-half).exp(), value * half.exp()])))
    }
}
