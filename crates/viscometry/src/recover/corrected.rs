//! Flow curves that follow from several tables at once, with the band that the noise of all of them leaves.
//!
//! Each table is smoothed by itself. At an abscissa u the answers yᵢ of the tables are combined by the weights of a line through them,
//! of its value (aᵢ) and of its slope (bᵢ):
//!
//! ```text
//! slip   u = ln τ     yᵢ = 4Qᵢ/(πRᵢ³) over 1/Rᵢ     A = Σ aᵢ yᵢ        k = (3 A + dA/du)/4
//! ends   u = ln Q     yᵢ = Δpᵢ over Lᵢ/R            2τ = Σ bᵢ yᵢ       k = Q (3 + du/d ln τ)/(πR³)
//! ```
//! Errors of the coefficients of every table go through to ln k at the same τ, to the first order.

use core::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::band::critical;
use super::curve::{DEGREE, FINE, LEFT_OUT, SAFETY, envelope};
use super::geometry::PipeGeometry;
use super::plain::Smoother;
use super::smoothing::{Criterion, EXACT, Fitted, Smoothing};
use super::splines::Derivatives;
use super::table::{FlowTable, Noise};
use crate::ViscometryError;

/// A table's logarithms as a curve, with what its errors follow from.
#[derive(Clone, Debug, PartialEq)]
struct Smoothed {
    main: Fitted,
    /// Curves that could be as true.
    others: Vec<Fitted>,
    /// √Cov of the coefficients.
    root: DMatrix<f64>,
    /// Degrees of freedom of the noise.
    freedom: f64,
    /// How far off the others show the main curve to be.
    safety: f64,
    smoothing: Smoothing,
}

impl Smoothed {
    /// ln response over ln drive of a table, by the criteria of recovery.
    fn new(table: &FlowTable<PipeGeometry>) -> Result<Self, ViscometryError> {
        table.check_rows()?;
        table.check_rising()?;
        let u: Vec<f64> = table.drive.iter().map(|x| x.ln()).collect();
        let y: Vec<f64> = table.response.iter().map(|x| x.ln()).collect();
        let level = table.level();
        let known = matches!(table.noise, Noise::Relative(_)).then_some(level);
        let singular = || ViscometryError::RowsTooClose { rows: u.len() };
        if level <= EXACT {
            return Self::through(&u, &y, level).ok_or_else(singular);
        }
        let fitted = |order| {
            let smoother = Smoother::new(&u, &y, order).ok_or_else(singular)?;
            Ok::<_, ViscometryError>(smoother.fit(smoother.choose(known), known, false))
        };
        let (main, other) = (fitted(2)?, fitted(3)?);
        Ok(Self {
            main: main.fitted,
            others: vec![other.fitted],
            root: main.root,
            freedom: main.freedom,
            safety: 1.0,
            smoothing: main.smoothing,
        })
    }

    /// Through every row.
    fn through(u: &[f64], y: &[f64], level: f64) -> Option<Self> {
        let main = Fitted::through(u, y, DEGREE)?;
        let mut others: Vec<Fitted> =
            [DEGREE - 2, DEGREE + 2].iter().filter_map(|degree| Fitted::through(u, y, *degree)).collect();
        let without = |values: &[f64], row: usize| -> Vec<f64> {
            values.iter().enumerate().filter(|&(i, _)| i != row).map(|(_, x)| *x).collect()
        };
        let stride = u.len().div_ceil(LEFT_OUT);
        let inner = (1..u.len() - 1)
            .step_by(stride)
            .filter_map(|row| Fitted::through(&without(u, row), &without(y, row), DEGREE));
        others.extend(inner);
        let mut root = main.splines.matrix(u, 0).try_inverse()?;
        for (mut column, (u, y)) in root.column_iter_mut().zip(u.iter().zip(y)) {
            let rounding = 4.0 * f64::EPSILON * (1.0 + y.abs() + (1.0 + u.abs()) * main.at(*u)[1].abs());
            column *= level.max(rounding);
        }
        let smoothing = Smoothing {
            criterion: Criterion::Interpolation,
            noise: level,
            parameter: 0.0,
            degrees_of_freedom: u.len() as f64,
            raised: false,
        };
        Some(Self { main, others, root, freedom: f64::INFINITY, safety: SAFETY, smoothing })
    }
}

/// A table with its place on the line.
#[derive(Clone, Debug, PartialEq)]
struct Member {
    smoothed: Smoothed,
    /// ln drive − u.
    shift: f64,
    /// yᵢ over the response.
    scale: f64,
    /// The abscissa of the line.
    place: f64,
    /// aᵢ and bᵢ.
    weights: [f64; 2],
}

/// The correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    Slip,
    Ends { radius: f64 },
}

/// The result at an abscissa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) wall_stress: f64,
    pub(super) shear_rate: f64,
    /// Where the shear rate lies, if a band was asked for.
    pub(super) band: Option<[f64; 2]>,
    /// Value at 0 and slope of the line, and their standard errors beyond two tables.
    pub(super) line: [f64; 2],
    pub(super) errors: Option<[f64; 2]>,
}

/// Sums over the tables.
#[derive(Clone, Copy, Debug)]
struct Sums {
    /// ln τ and ln k.
    logarithms: [f64; 2],
    /// d ln k/d ln τ.
    slope: f64,
    line: [f64; 2],
}

/// Tables on lines.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Corrected {
    law: Law,
    members: Vec<Member>,
    /// Those that all tables reach, as logarithms.
    abscissas: Vec<f64>,
    /// Half widths of ln k at the fine points.
    band: Option<Vec<f64>>,
}

impl Corrected {
    /// Of tables, each with the scales of its drive and its response and its place on the line.
    pub(super) fn new(
        law: Law,
        tables: &[(&FlowTable<PipeGeometry>, f64, f64, f64)],
        abscissas: &[f64],
    ) -> Result<Self, ViscometryError> {
        let count = tables.len() as f64;
        let mean = tables.iter().map(|(.., place)| place).sum::<f64>() / count;
        let square: f64 = tables.iter().map(|(.., place)| (place - mean).powi(2)).sum();
        let member = |&(table, drive, scale, place): &(&FlowTable<PipeGeometry>, f64, f64, f64)| {
            let slope = (place - mean) / square;
            let weights = [count.recip() - mean * slope, slope];
            Ok(Member { smoothed: Smoothed::new(table)?, shift: -drive.ln(), scale, place, weights })
        };
        let members = tables.iter().map(member).collect::<Result<_, ViscometryError>>()?;
        Ok(Self { law, members, abscissas: abscissas.iter().map(|x| x.ln()).collect(), band: None })
    }

    /// The smoothing of each table.
    pub(super) fn smoothing(&self) -> impl Iterator<Item = Smoothing> + '_ {
        self.members.iter().map(|member| member.smoothed.smoothing)
    }

    /// yᵢ and the derivatives of its logarithm.
    fn answer(member: &Member, curve: &Fitted, u: f64) -> (f64, Derivatives) {
        let derivatives = curve.at(u + member.shift);
        (member.scale * derivatives[0].exp(), derivatives)
    }

    /// The sums with one of the curves in place of the main one of a table; `None` where nothing positive follows.
    fn sums(&self, u: f64, instead: Option<(usize, &Fitted)>) -> Option<Sums> {
        let (mut line, mut first, mut second) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for (index, member) in self.members.iter().enumerate() {
            let curve = instead.filter(|(other, _)| *other == index).map_or(&member.smoothed.main, |(_, curve)| curve);
            let (y, [_, slope, curvature, ..]) = Self::answer(member, curve, u);
            for (k, weight) in member.weights.into_iter().enumerate() {
                line[k] += weight * y;
                first[k] += weight * y * slope;
                second[k] += weight * y * (slope * slope + curvature);
            }
        }
        match self.law {
            Law::Slip => {
                let rate = 0.25 * (3.0 * line[0] + first[0]);
                let slope = 0.25 * (3.0 * first[0] + second[0]) / rate;
                (0.0 < rate && 0.0 < line[0]).then(|| Sums { logarithms: [u, rate.ln()], slope, line })
            }
            Law::Ends { radius } => {
                // N = d ln τ/d ln Q and its derivative.
                let exponent = first[1] / line[1];
                let change = second[1] / line[1] - exponent * exponent;
                let factor = 3.0 + exponent.recip();
                let slope = (1.0 - change / (exponent * exponent * factor)) / exponent;
                let rate = u + (factor / (PI * radius * radius * radius)).ln();
                (0.0 < line[1] && 0.0 < exponent).then(|| Sums {
                    logarithms: [(0.5 * line[1]).ln(), rate],
                    slope,
                    line,
                })
            }
        }
    }

    /// Weights of Bᵢ and Bᵢ′ in ln k at a given τ.
    fn sensitivity(&self, member: &Member, sums: &Sums, u: f64) -> [f64; 2] {
        let (y, [_, slope, ..]) = Self::answer(member, &member.smoothed.main, u);
        match self.law {
            Law::Slip => {
                let share = 0.25 * member.weights[0] * y * (-sums.logarithms[1]).exp();
                [share * (3.0 + slope), share]
            }
            Law::Ends { .. } => {
                let share = member.weights[1] * y / sums.line[1];
                let exponent = self.exponent(u, sums);
                let steepness = (exponent * (3.0 * exponent + 1.0)).recip();
                [share * (-steepness * (slope - exponent) - sums.slope), -steepness * share]
            }
        }
    }

    /// d ln τ/d ln Q.
    fn exponent(&self, u: f64, sums: &Sums) -> f64 {
        let part = |member: &Member| {
            let (y, [_, slope, ..]) = Self::answer(member, &member.smoothed.main, u);
            member.weights[1] * y * slope
        };
        self.members.iter().map(part).sum::<f64>() / sums.line[1]
    }

    /// The result at an abscissa.
    ///
    /// # Errors
    /// [`ViscometryError::NotMeasured`], [`ViscometryError::NotRecovered`].
    pub(super) fn at(&self, abscissa: f64) -> Result<Found, ViscometryError> {
        let (lowest, highest) = (self.abscissas[0], self.abscissas[self.abscissas.len() - 1]);
        let u = abscissa.ln();
        let slack = 8.0 * f64::EPSILON * (1.0 + u.abs());
        if !(lowest - slack <= u && u <= highest + slack) {
            return Err(ViscometryError::NotMeasured { value: abscissa, lowest: lowest.exp(), highest: highest.exp() });
        }
        let u = u.clamp(lowest, highest);
        let sums = self.sums(u, None).ok_or(ViscometryError::NotRecovered { at: abscissa })?;
        let [wall_stress, shear_rate] = sums.logarithms.map(f64::exp);
        let band = self.band.as_ref().map(|half| {
            let interval = self.abscissas[..self.abscissas.len() - 1].partition_point(|row| *row <= u).max(1) - 1;
            let half = match (self.abscissas.get(interval), self.abscissas.get(interval + 1)) {
                (Some(low), Some(high)) => {
                    let part = (u - low) / (high - low) * FINE as f64;
                    let first = FINE * interval + (1..FINE).take_while(|k| *k as f64 <= part).count();
                    half[first].max(half[first + 1])
                }
                _ => half[0],
            };
            [shear_rate * (-half).exp(), shear_rate * half.exp()]
        });
        Ok(Found { wall_stress, shear_rate, band, line: sums.line, errors: self.errors(u, &sums) })
    }

    /// Standard errors of the line by what it leaves.
    fn errors(&self, u: f64, sums: &Sums) -> Option<[f64; 2]> {
        let count = self.members.len() as f64;
        let mean = self.members.iter().map(|member| member.place).sum::<f64>() / count;
        let square: f64 = self.members.iter().map(|member| (member.place - mean).powi(2)).sum();
        let left = |member: &Member| {
            let (y, _) = Self::answer(member, &member.smoothed.main, u);
            (y - sums.line[0] - sums.line[1] * member.place).powi(2)
        };
        (2 < self.members.len()).then(|| {
            let variance = self.members.iter().map(left).sum::<f64>() / (count - 2.0);
            [(variance * (count.recip() + mean * mean / square)).sqrt(), (variance / square).sqrt()]
        })
    }

    /// The same with a band.
    ///
    /// # Errors
    /// [`ViscometryError::ConfidenceOutOfRange`], [`ViscometryError::NotRecovered`].
    pub(super) fn with_band(mut self, confidence: f64) -> Result<Self, ViscometryError> {
        if !(0.0 < confidence && confidence < 1.0) {
            return Err(ViscometryError::ConfidenceOutOfRange { value: confidence });
        }
        let inside = |pair: &[f64]| {
            let [a, b] = [pair[0], pair[1]];
            (0..FINE).map(move |k| a + (b - a) * k as f64 / FINE as f64)
        };
        let fine: Vec<f64> = self.abscissas.windows(2).flat_map(inside).chain(self.abscissas.last().copied()).collect();
        let (mut length, mut direction) = (0.0, None::<DVector<f64>>);
        let (mut deviations, mut differences) = (Vec::new(), Vec::new());
        for &u in &fine {
            let sums = self.sums(u, None).ok_or(ViscometryError::NotRecovered { at: u.exp() })?;
            let mapped = self.mapped(u, &sums);
            let deviation = mapped.norm();
            let unit = mapped / deviation;
            if let Some(before) = &direction {
                length += (&unit - before).norm();
            }
            direction = Some(unit);
            deviations.push(deviation);
            differences.push(self.difference(u, &sums));
        }
        let freedom = self.members.iter().map(|member| member.smoothed.freedom).fold(f64::INFINITY, f64::min);
        let critical = critical(length, freedom, confidence);
        let differences = envelope(&differences);
        let half = deviations.iter().zip(differences).map(|(deviation, other)| critical * deviation + other);
        self.band = Some(half.map(|half| half + 8.0 * f64::EPSILON).collect());
        Ok(self)
    }

    /// ln k as a sum of independent errors of all tables.
    fn mapped(&self, u: f64, sums: &Sums) -> DVector<f64> {
        let parts = self.members.iter().map(|member| {
            let [value, slope] = self.sensitivity(member, sums, u);
            let mut row = DVector::zeros(member.smoothed.main.splines.count());
            member.smoothed.main.splines.accumulate(
                row.as_mut_slice(),
                [value, slope, 0.0, 0.0, 0.0],
                u + member.shift,
            );
            member.smoothed.root.tr_mul(&row)
        });
        let all: Vec<f64> = parts.flat_map(|part| part.as_slice().to_vec()).collect();
        DVector::from_vec(all)
    }

    /// The change of ln k at the same τ by other curves of the tables.
    fn difference(&self, u: f64, sums: &Sums) -> f64 {
        let of_one = |(index, member): (usize, &Member)| {
            let change = |other: &Fitted| match self.sums(u, Some((index, other))) {
                Some(changed) => {
                    let [stress, rate]: [f64; 2] = core::array::from_fn(|k| changed.logarithms[k] - sums.logarithms[k]);
                    (rate - sums.slope * stress).abs()
                }
                None => f64::INFINITY,
            };
            member.smoothed.safety * member.smoothed.others.iter().map(change).fold(0.0, f64::max)
        };
        self.members.iter().enumerate().map(of_one).sum()
    }
}
