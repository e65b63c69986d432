//! Registration by a viscous fluid: the drive of the images moves it, and its stress relaxes.
//!
//! ```text
//! L v + f = 0,   ∂u/∂t = v − (∇u) v
//! ```
//! The second equation says that x − u is constant along the paths of the fluid, so a step of length δ follows them back:
//! u(x, t + δ) = δ v + u(x − δ v, t), of first order in δ and stable for any δ. When the least det(1 − ∇u) falls below a bound, the whole map
//! is kept and u begins again from zero (regridding): the map is then x ↦ h₁(h₂(… (x − u))).

use piola_numerics::Real;
use piola_spectral::Precision;

use crate::alignment::Alignment;
use crate::error::RegistrationError;
use crate::field::{compose, largest, sample, target};
use crate::grid::ImageGrid;
use crate::jacobian::least_jacobian;
use crate::map::DisplacementMap;
use crate::measure::Side;
use crate::model::RegistrationModel;
use crate::operator::Response;
use crate::parallel::each;
use crate::step::{Bounds, SHRINKING, SHRINKINGS, Step, scale};

/// The displacements of one image.
struct Carried<const D: usize, T> {
    /// Since the last regridding: u.
    stage: Vec<[T; D]>,
    /// Up to the last regridding.
    before: Vec<[T; D]>,
    /// Both composed.
    whole: Vec<[T; D]>,
    trial_stage: Vec<[T; D]>,
    trial_whole: Vec<[T; D]>,
}

impl<const D: usize, T: Real> Carried<D, T> {
    fn new(grid: &ImageGrid<D>) -> Self {
        let zeros = || vec![[T::zero(); D]; grid.len()];
        Self { stage: zeros(), before: zeros(), whole: zeros(), trial_stage: zeros(), trial_whole: zeros() }
    }

    fn regrid(&mut self) {
        self.before.copy_from_slice(&self.whole);
        self.stage.fill([T::zero(); D]);
    }

    /// Carries u along the velocity for the time `duration`, into the trial. The least Jacobians of the stage and of the whole.
    fn advance(&mut self, grid: &ImageGrid<D>, velocity: &[[T; D]], duration: f64) -> [f64; 2] {
        let duration = T::lit(duration);
        let stage = &self.stage;
        each(&mut self.trial_stage[..], &|start, part: &mut [[T; D]]| {
            for (position, u) in (start..).zip(part) {
                let v = &velocity[position];
                let carried = sample(grid, stage, target(grid, position, v, duration));
                *u = std::array::from_fn(|axis| duration * v[axis] + carried[axis]);
            }
        });
        compose(grid, &self.before, &self.trial_stage, &mut self.trial_whole);
        [least_jacobian(grid, &self.trial_stage, 1.0), least_jacobian(grid, &self.trial_whole, 1.0)]
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.stage, &mut self.trial_stage);
        std::mem::swap(&mut self.whole, &mut self.trial_whole);
    }
}

pub(crate) struct FluidState<const D: usize, T> {
    response: Response<D, T>,
    moving: Carried<D, T>,
    /// In a symmetric registration the fixed image flows the other way.
    fixed: Option<Carried<D, T>>,
    force: Vec<[T; D]>,
    velocity: Vec<[T; D]>,
    /// The length of a step, in samples; zero at first.
    length: f64,
    measure: f64,
}

impl<const D: usize, T: Precision> FluidState<D, T> {
    pub(crate) fn new(
        grid: &ImageGrid<D>,
        model: &RegistrationModel,
        is_symmetric: bool,
    ) -> Result<Self, RegistrationError> {
        let zeros = || vec![[T::zero(); D]; grid.len()];
        Ok(Self {
            response: Response::new(grid, model)?,
            moving: Carried::new(grid),
            fixed: is_symmetric.then(|| Carried::new(grid)),
            force: zeros(),
            velocity: zeros(),
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
        let mut finer = Self::new(grid, model, self.fixed.is_some())?;
        let sides = [(Some(&self.moving), Some(&mut finer.moving)), (self.fixed.as_ref(), finer.fixed.as_mut())];
        for (from, to) in sides {
            if let (Some(from), Some(to)) = (from, to) {
                let whole = DisplacementMap { grid: *coarser, displacements: from.whole.clone() }.resampled(*grid);
                to.whole = whole.displacements;
                to.regrid();
            }
        }
        Ok(finer)
    }

    /// Compares the images at the first state of a level.
    ///
    /// The finer grid may see a fold where the coarser one saw none: the displacement is then made smaller.
    pub(crate) fn begin(&mut self, alignment: &mut Alignment<D, T>, bounds: &Bounds) -> f64 {
        for side in std::iter::once(&mut self.moving).chain(&mut self.fixed) {
            for _ in 0..SHRINKINGS {
                if bounds.least_jacobian <= least_jacobian(&alignment.grid, &side.whole, 1.0) {
                    break;
                }
                scale(&mut side.whole, SHRINKING);
                side.regrid();
            }
        }
        self.compare(alignment)
    }

    /// Warps the images by the state, and compares them.
    fn compare(&mut self, alignment: &mut Alignment<D, T>) -> f64 {
        if let Some(fixed) = &self.fixed {
            alignment.warp(Side::Fixed, &fixed.whole, 1.0);
        }
        alignment.warp(Side::Moving, &self.moving.whole, 1.0);
        self.measure = alignment.measure();
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
        let share = if self.fixed.is_some() { 0.5 } else { 1.0 };
        alignment.add_force_before(Side::Moving, &self.moving.whole, share, &mut self.force);
        if let Some(fixed) = &self.fixed {
            alignment.add_force_before(Side::Fixed, &fixed.whole, -share, &mut self.force);
        }
        self.response.solve(&self.force, &mut self.velocity)?;
        let fastest = largest(&self.velocity);
        if !(0.0 < fastest && fastest.is_finite()) {
            return Ok(None);
        }
        let mut length =
            if 0.0 < self.length { (1.5 * self.length).min(bounds.largest_step) } else { bounds.largest_step };
        for _ in 0..bounds.halvings {
            let duration = length * grid.mean_spacing() / fastest;
            let mut least = self.moving.advance(&grid, &self.velocity, duration);
            if let Some(fixed) = &mut self.fixed {
                let other = fixed.advance(&grid, &self.velocity, -duration);
                least = [least[0].min(other[0]), least[1].min(other[1])];
            }
            if bounds.least_jacobian <= least[1] {
                alignment.warp(Side::Moving, &self.moving.trial_whole, 1.0);
                if let Some(fixed) = &self.fixed {
                    alignment.warp(Side::Fixed, &fixed.trial_whole, 1.0);
                }
                let measure = alignment.measure();
                if measure < self.measure {
                    let decrease = self.measure - measure;
                    let regridded = least[0] < bounds.regrid_below;
                    for side in std::iter::once(&mut self.moving).chain(&mut self.fixed) {
                        side.accept();
                        if regridded {
                            side.regrid();
                        }
                    }
                    (self.length, self.measure) = (length, measure);
                    return Ok(Some(Step { measure, decrease, least_jacobian: least[1], regridded }));
                }
            }
            length *= 0.5;
        }
        self.compare(alignment);
        Ok(None)
    }

    /// The maps to the moving image and, in a symmetric registration, to the fixed one.
    pub(crate) fn maps(&self, grid: &ImageGrid<D>) -> (DisplacementMap<D, T>, Option<DisplacementMap<D, T>>) {
        let part = |side: &Carried<D, T>| DisplacementMap { grid: *grid, displacements: side.whole.clone() };
        (part(&self.moving), self.fixed.as_ref().map(part))
    }

    pub(crate) fn measure(&self) -> f64 {
        self.measure
    }
}
