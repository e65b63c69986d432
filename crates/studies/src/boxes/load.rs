//! Loads over time, as polynomials of a step.

use piola_spectral::{ModalSeries, SpectralError, Walls};

use super::Load;
use super::form::sum;

impl<const D: usize> Load<D> {
    /// The coefficients of the factor in the time since `now`, during a step that begins there; none when it does not act.
    ///
    /// ```text
    /// Σ cₖ τᵏ = Σⱼ sʲ Σₖ cₖ (k over j) a^(k−j)/Tʲ,   τ = a + s/T,   a = (now − from)/T
    /// ```
    pub(super) fn coefficients(&self, now: f64) -> Vec<f64> {
        let [from, until] = self.span;
        if now < from || until <= now {
            return Vec::new();
        }
        let span = until - from;
        let share = (now - from) / span;
        let mut coefficients = self.course.clone();
        // Taylor's shift by repeated synthetic division.
        for lowest in 0..coefficients.len() {
            for k in (lowest..coefficients.len() - 1).rev() {
                coefficients[k] += share * coefficients[k + 1];
            }
        }
        let mut scale = 1.0;
        for coefficient in &mut coefficients {
            *coefficient /= scale;
            scale *= span;
        }
        coefficients
    }
}

/// The modes of all loads, and their sum for a step.
pub(super) struct Forces<'a, const D: usize> {
    loads: &'a [Load<D>],
    series: Vec<ModalSeries<D>>,
    frame: ([f64; D], Walls, [usize; D]),
    /// The coefficients of each load for the sum below.
    coefficients: Vec<Vec<f64>>,
    /// The modes for each power of the time since the start of the step.
    sum: Vec<ModalSeries<D>>,
}

impl<'a, const D: usize> Forces<'a, D> {
    pub(super) fn new(
        loads: &'a [Load<D>],
        (sides, walls, highest): ([f64; D], Walls, [usize; D]),
    ) -> Result<Self, SpectralError> {
        let series = loads.iter().map(|load| load.form.series(sides, walls, highest)).collect::<Result<_, _>>()?;
        Ok(Self { loads, series, frame: (sides, walls, highest), coefficients: Vec::new(), sum: Vec::new() })
    }

    /// The first instant after `now` at which a load begins or ends.
    pub(super) fn next_change(&self, now: f64) -> f64 {
        let changes = self.loads.iter().flat_map(|load| load.span);
        changes.filter(|change| now < *change).fold(f64::INFINITY, f64::min)
    }

    /// The modes for each power of the time since `now`: added up again only when a coefficient has changed.
    pub(super) fn of_step(&mut self, now: f64) -> Result<&[ModalSeries<D>], SpectralError> {
        let coefficients: Vec<Vec<f64>> = self.loads.iter().map(|load| load.coefficients(now)).collect();
        if coefficients != self.coefficients {
            let powers = coefficients.iter().map(Vec::len).max().unwrap_or(0);
            let (sides, walls, highest) = self.frame;
            self.sum.clear();
            for power in 0..powers {
                let parts: Vec<(f64, &ModalSeries<D>)> = coefficients
                    .iter()
                    .zip(&self.series)
                    .filter_map(|(coefficients, series)| Some((*coefficients.get(power)?, series)))
                    .collect();
                self.sum.push(sum(sides, walls, highest, &parts)?);
            }
            self.coefficients = coefficients;
        }
        Ok(&self.sum)
    }
}
