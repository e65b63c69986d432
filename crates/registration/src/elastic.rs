//! Elastic registration: the sum of the measure and the elastic energy is made small.
//!
//! ```text
//! E(u) = D(u) + ½ mean(b·u),   b = −L u,   N ∂E/∂u = b − f,   f = −N ∂D/∂u
//! ```
//! The state is the body force b, and u is the response to it, so the energy needs no derivatives of u. Conjugate directions (Polak and
//! Ribière) are taken in the inner product of the energy: the gradient there is u minus the response to f, one solution for each step.

use piola_numerics::Real;
use piola_spectral::Precision;

use crate::alignment::Alignment;
use crate::error::RegistrationError;
use crate::field::largest;
use crate::grid::ImageGrid;
use crate::jacobian::least_jacobian;
use crate::map::DisplacementMap;
use crate::measure::Side;
use crate::model::RegistrationModel;
use crate::operator::Response;
use crate::parallel::{each, sum};
use crate::step::{Bounds, SHRINKING, SHRINKINGS, Step, scale};

/// Armijo's share of the decrease that the slope promises.
const SUFFICIENT: f64 = 1e-4;

pub(crate) struct ElasticState<const D: usize, T> {
    response: Response<D, T>,
    /// The factors of u in the maps of the fixed and of the moving image: 0 and 1, or −½ and ½.
    factors: [f64; 2],
    displacement: Vec<[T; D]>,
    body_force: Vec<[T; D]>,
    /// −N ∂D/∂u, then the response to it, then the trial displacement.
    force: Vec<[T; D]>,
    scratch: Vec<[T; D]>,
    direction: Vec<[T; D]>,
    /// −L of the direction.
    direction_force: Vec<[T; D]>,
    /// b − f of the step before.
    last_gradient: Vec<[T; D]>,
    last_norm: f64,
    /// The factor of the direction in the step before.
    length: f64,
    measure: f64,
}

/// mean(a·b).
fn mean_product<const D: usize, T: Real>(a: &[[T; D]], b: &[[T; D]]) -> f64 {
    let total = sum(0..a.len(), &|_, range: std::ops::Range<usize>| {
        let (a, b) = (a[range.clone()].as_flattened(), b[range].as_flattened());
        a.iter().zip(b).map(|(a, b)| a.primal(0) * b.primal(0)).sum()
    });
    total / a.len() as f64
}

/// `out` = `a` `out` + `b` `other`.
fn combine<const D: usize, T: Real>(out: &mut [[T; D]], a: f64, b: f64, other: &[[T; D]]) {
    let (a, b) = (T::lit(a), T::lit(b));
    each(out, &|start, part: &mut [[T; D]]| {
        for (position, vector) in (start..).zip(part) {
            for (own, other) in vector.iter_mut().zip(other[position]) {
                *own = a * *own + b * other;
            }
        }
    });
}

impl<const D: usize, T: Precision> ElasticState<D, T> {
    pub(crate) fn new(
        grid: &ImageGrid<D>,
        model: &RegistrationModel,
        is_symmetric: bool,
    ) -> Result<Self, RegistrationError> {
        let zeros = || vec![[T::zero(); D]; grid.len()];
        Ok(Self {
            response: Response::new(grid, model)?,
            factors: if is_symmetric { [-0.5, 0.5] } else { [0.0, 1.0] },
            displacement: zeros(),
            body_force: zeros(),
            force: zeros(),
            scratch: zeros(),
            direction: zeros(),
            direction_force: zeros(),
            last_gradient: zeros(),
            last_norm: 0.0,
            length: 0.0,
            measure: f64::INFINITY,
        })
    }

    /// The state that continues a coarser one.
    pub(crate) fn continued(
        &self,
        coarser: &ImageGrid<D>,
        grid: &ImageGrid<D>,
        model: &RegistrationModel,
    ) -> Result<Self, RegistrationError> {
        let body_force = DisplacementMap { grid: *coarser, displacements: self.body_force.clone() }.resampled(*grid);
        let mut finer = Self::new(grid, model, self.factors[0] < 0.0)?;
        finer.body_force = body_force.displacements;
        finer.response.solve(&finer.body_force, &mut finer.displacement)?;
        Ok(finer)
    }

    /// Compares the images at the first state of a level.
    ///
    /// The finer grid may see a fold where the coarser one saw none: the displacement is then made smaller.
    pub(crate) fn begin(&mut self, alignment: &mut Alignment<D, T>, bounds: &Bounds) -> f64 {
        for _ in 0..SHRINKINGS {
            if bounds.least_jacobian <= self.least_jacobian(&alignment.grid, &self.displacement) {
                break;
            }
            for field in [&mut self.displacement, &mut self.body_force] {
                scale(field, SHRINKING);
            }
        }
        self.measure = warped_measure(alignment, &self.displacement, self.factors);
        self.measure
    }

    /// One step. On return the state is the better one.
    pub(crate) fn step(
        &mut self,
        alignment: &mut Alignment<D, T>,
        bounds: &Bounds,
    ) -> Result<Option<Step>, RegistrationError> {
        let grid = alignment.grid;
        self.force.fill([T::zero(); D]);
        for (side, factor) in [Side::Fixed, Side::Moving].into_iter().zip(self.factors) {
            if factor.abs() > 0.0 {
                alignment.add_force(side, factor, &mut self.force);
            }
        }
        self.response.solve(&self.force, &mut self.scratch)?;
        // −g and its dual: the response to f minus u, and f − b.
        combine(&mut self.scratch, 1.0, -1.0, &self.displacement);
        combine(&mut self.force, 1.0, -1.0, &self.body_force);
        let norm = mean_product(&self.force, &self.scratch);
        if norm <= 0.0 || !norm.is_finite() {
            return Ok(None);
        }
        let turned = if 0.0 < self.last_norm {
            (norm - mean_product(&self.last_gradient, &self.scratch)).max(0.0) / self.last_norm
        } else {
            0.0
        };
        combine(&mut self.direction, turned, 1.0, &self.scratch);
        combine(&mut self.direction_force, turned, 1.0, &self.force);
        let mut slope = -mean_product(&self.force, &self.direction);
        if -0.1 * norm < slope {
            self.direction.copy_from_slice(&self.scratch);
            self.direction_force.copy_from_slice(&self.force);
            slope = -norm;
        }
        self.last_gradient.copy_from_slice(&self.force);
        self.last_norm = norm;

        // The elastic part of the energy along the direction is known.
        let linear = mean_product(&self.body_force, &self.direction);
        let quadratic = 0.5 * mean_product(&self.direction_force, &self.direction);
        let farthest = bounds.largest_step * grid.mean_spacing() / largest(&self.direction);
        let mut length = if 0.0 < self.length { (2.0 * self.length).min(farthest) } else { farthest.min(1.0) };
        for _ in 0..bounds.halvings {
            self.scratch.copy_from_slice(&self.displacement);
            combine(&mut self.scratch, 1.0, length, &self.direction);
            let least = self.least_jacobian(&grid, &self.scratch);
            let mut shorter = 0.5 * length;
            if bounds.least_jacobian <= least {
                let measure = warped_measure(alignment, &self.scratch, self.factors);
                let change = measure - self.measure + length * (linear + length * quadratic);
                if change <= SUFFICIENT * length * slope {
                    std::mem::swap(&mut self.displacement, &mut self.scratch);
                    combine(&mut self.body_force, 1.0, length, &self.direction_force);
                    self.length = length;
                    self.measure = measure;
                    return Ok(Some(Step { measure, decrease: -change, least_jacobian: least, regridded: false }));
                }
                // The minimum of the parabola through what is known.
                let curvature = change - length * slope;
                shorter = (-0.5 * slope * length * length / curvature).clamp(0.1 * length, 0.5 * length);
            }
            length = shorter;
        }
        // The images are left as the last trial warped them: warp them back.
        warped_measure(alignment, &self.displacement, self.factors);
        Ok(None)
    }

    /// The least Jacobian of the maps with the displacement `field`.
    fn least_jacobian(&self, grid: &ImageGrid<D>, field: &[[T; D]]) -> f64 {
        let factors = self.factors.into_iter().filter(|factor| factor.abs() > 0.0);
        factors.map(|factor| least_jacobian(grid, field, factor)).fold(f64::INFINITY, f64::min)
    }

    /// The maps to the moving image and, in a symmetric registration, to the fixed one.
    pub(crate) fn maps(&self, grid: &ImageGrid<D>) -> (DisplacementMap<D, T>, Option<DisplacementMap<D, T>>) {
        let part = |factor: f64| {
            let mut displacements = self.displacement.clone();
            scale(&mut displacements, factor);
            DisplacementMap { grid: *grid, displacements }
        };
        (part(self.factors[1]), (self.factors[0] < 0.0).then(|| part(self.factors[0])))
    }

    pub(crate) fn measure(&self) -> f64 {
        self.measure
    }
}

fn warped_measure<const D: usize, T: Real>(
    alignment: &mut Alignment<D, T>,
    displacement: &[[T; D]],
    factors: [f64; 2],
) -> f64 {
    if factors[0] < 0.0 {
        alignment.warp(Side::Fixed, displacement, factors[0]);
    }
    alignment.warp(Side::Moving, displacement, factors[1]);
    alignment.measure()
}
