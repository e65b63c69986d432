//! The registration of two images, from coarse to fine.

use std::ops::ControlFlow;

use piola_spectral::Precision;

use crate::alignment::Alignment;
use crate::elastic::ElasticState;
use crate::error::{RegistrationError, check_bound};
use crate::fluid::FluidState;
use crate::grid::ImageGrid;
use crate::image::Image;
use crate::map::DisplacementMap;
use crate::measure::SimilarityMeasure;
use crate::model::RegistrationModel;
use crate::pyramid::halved;
use crate::sampler::Interpolant;
use crate::step::{Bounds, Step};

/// Steps over which the decrease is compared with the tolerance.
const WINDOW: usize = 10;

/// Samples along the shortest side of the coarsest image, unless the number of levels is given.
const COARSEST: usize = 16;

/// A method of registration: model, measure and control of steps.
///
/// It finds the map h(x) = x − u(x) from the fixed to the moving image for which moving(h(x)) resembles fixed(x). It begins with small images
/// (a Gaussian pyramid on the same box) and ends with the given ones. Every step decreases the measure (elastic: its sum with the energy of
/// the deformation), and keeps the least Jacobian positive. On each level it ends where ten steps decrease the measure by less than
/// `tolerance` times the decrease since the beginning, where no step decreases it, or after `steps` steps.
///
/// # Example
/// ```
/// use piola_registration::{Image, ImageGrid, Interpolant, Registration, RegistrationModel};
/// let grid = ImageGrid::new([32, 32], [1e-3; 2])?;
/// let blob = |centre: f64| Image::from_fn(grid, move |[y, x]| (-((x - centre).powi(2) + (y - 0.016).powi(2)) / 2e-5).exp());
/// let (fixed, moving) = (blob(0.017)?, blob(0.015)?);
/// let found = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?).run(&fixed, &moving)?;
/// let shift = found.map.displacement([0.016, 0.017]);
/// assert!((shift[1] - 2e-3).abs() < 2e-4 && shift[0].abs() < 1e-5);
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Registration {
    model: RegistrationModel,
    measure: SimilarityMeasure,
    interpolant: Interpolant,
    is_symmetric: bool,
    levels: Option<usize>,
    steps: usize,
    tolerance: f64,
    largest_step: f64,
    regrid_below: f64,
    least_jacobian: f64,
}

/// What an observer learns after each step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RegistrationProgress {
    /// The level: 0 is the finest.
    pub level: usize,
    /// The number of levels.
    pub levels: usize,
    /// Steps taken on this level.
    pub step: usize,
    /// The measure.
    pub measure: f64,
    /// The least Jacobian of the whole map; in a symmetric registration of the two halves.
    pub least_jacobian: f64,
    /// Regriddings on all levels so far.
    pub regriddings: usize,
}

/// Why a level or a registration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum RegistrationEnding {
    /// Ten steps decreased the measure by less than the tolerance.
    Converged,
    /// No step decreased the measure and kept the least Jacobian above its bound.
    NoFurtherDecrease,
    /// The allowed number of steps was taken.
    StepsTaken,
    /// The observer ended the run.
    Interrupted,
}

/// How one level went.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LevelReport<const D: usize> {
    /// The grid of the level.
    pub grid: ImageGrid<D>,
    /// The measure at the start and at the end of the level.
    pub measures: [f64; 2],
    /// Steps taken.
    pub steps: usize,
    /// Regriddings of the fluid.
    pub regriddings: usize,
    /// Why the level ended.
    pub ending: RegistrationEnding,
}

/// The result of a registration.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Registered<const D: usize, T> {
    /// From the fixed image to the moving one, on the grid of the images.
    pub map: DisplacementMap<D, T>,
    /// Of a symmetric registration: the maps from the middle to the fixed and to the moving image.
    ///
    /// The least Jacobian of each is above its bound. `map` is the second after the inverse of the first, sampled: where the two together
    /// compress a region below the spacing, the samples of `map` may show a fold although the composition has none.
    /// [`inverse`](Self::inverse) does not need them.
    pub halves: Option<[DisplacementMap<D, T>; 2]>,
    /// The levels, coarsest first.
    pub levels: Vec<LevelReport<D>>,
}

impl<const D: usize, T: Precision> Registered<D, T> {
    /// The map from the moving image to the fixed one: the inverse of `map`, in a symmetric registration composed of the halves.
    ///
    /// # Errors
    /// [`RegistrationError::Folded`] where a map has no inverse; after a run that was not interrupted there is one.
    pub fn inverse(&self) -> Result<DisplacementMap<D, T>, RegistrationError> {
        match &self.halves {
            Some([fixed, moving]) => fixed.after(&moving.inverse()?),
            None => self.map.inverse(),
        }
    }

    /// Why the last level ended.
    #[must_use]
    pub fn ending(&self) -> RegistrationEnding {
        self.levels.last().map_or(RegistrationEnding::Interrupted, |level| level.ending)
    }
}

impl Registration {
    /// A method with this model, the sum of squares as measure, linear interpolation, and the default control of steps.
    #[must_use]
    pub fn new(model: RegistrationModel) -> Self {
        Self {
            model,
            measure: SimilarityMeasure::default(),
            interpolant: Interpolant::default(),
            is_symmetric: false,
            levels: None,
            steps: 200,
            tolerance: 1e-3,
            largest_step: 0.5,
            regrid_below: 0.5,
            least_jacobian: 1e-3,
        }
    }

    /// The measure that is made small.
    #[must_use]
    pub fn with_measure(self, measure: SimilarityMeasure) -> Self {
        Self { measure, ..self }
    }

    /// How images are interpolated.
    #[must_use]
    pub fn with_interpolant(self, interpolant: Interpolant) -> Self {
        Self { interpolant, ..self }
    }

    /// Deforms both images, each by half, and composes one map with the inverse of the other.
    ///
    /// Exchanging the images then exchanges map and inverse, up to the interpolation of the composition.
    #[must_use]
    #[doc(alias = "inverse consistent")]
    pub fn symmetric(self) -> Self {
        Self { is_symmetric: true, ..self }
    }

    /// The number of levels, 1 for the given images alone. By default, images are halved while no side falls below 16 samples.
    #[must_use]
    pub fn with_levels(self, levels: usize) -> Self {
        Self { levels: Some(levels), ..self }
    }

    /// The most steps on a level (200).
    #[must_use]
    pub fn with_steps(self, steps: usize) -> Self {
        Self { steps, ..self }
    }

    /// The share of the whole decrease that ten steps must exceed (10⁻³). With zero, all steps are taken.
    #[must_use]
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// The largest displacement of one step, in samples (½).
    #[must_use]
    pub fn with_largest_step(self, largest_step: f64) -> Self {
        Self { largest_step, ..self }
    }

    /// The fluid is regridded where det(1 − ∇u) falls below `regrid_below` (½). No step takes the least Jacobian of the whole map below
    /// `least_jacobian` (10⁻³).
    #[must_use]
    pub fn with_jacobian_bounds(self, regrid_below: f64, least_jacobian: f64) -> Self {
        Self { regrid_below, least_jacobian, ..self }
    }

    /// Registers `moving` to `fixed`.
    ///
    /// # Errors
    /// [`RegistrationError::UnequalSizes`] or `UnequalSpacings` where the grids differ; `ConstantImage`; `OutOfBounds` or `NotFinite` for a
    /// parameter of the method.
    pub fn run<const D: usize, T: Precision>(
        &self,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
    ) -> Result<Registered<D, T>, RegistrationError> {
        self.run_observed(fixed, moving, |_| ControlFlow::Continue(()))
    }

    /// Registers `moving` to `fixed`; `observer` sees each step and may end the run. The map found so far is then the result.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_observed<const D: usize, T: Precision>(
        &self,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
        mut observer: impl FnMut(RegistrationProgress) -> ControlFlow<()>,
    ) -> Result<Registered<D, T>, RegistrationError> {
        fixed.grid().check_same(moving.grid())?;
        fixed.check_contrast("fixed")?;
        moving.check_contrast("moving")?;
        let bounds = self.bounds()?;
        let pyramid = self.pyramid(fixed, moving)?;

        let mut reports = Vec::with_capacity(pyramid.len());
        let mut state: Option<(State<D, T>, ImageGrid<D>)> = None;
        let (mut decrease, mut regriddings) = (0.0, 0);
        for (level, [fixed, moving]) in pyramid.iter().enumerate().rev() {
            let grid = *fixed.grid();
            let mut alignment = Alignment::new(self.measure, self.interpolant, fixed, moving);
            let mut current = match &state {
                None => State::new(&grid, &self.model, self.is_symmetric)?,
                Some((coarser, coarse_grid)) => coarser.continued(coarse_grid, &grid, &self.model)?,
            };
            let mut report = LevelReport {
                grid,
                measures: [current.begin(&mut alignment, &bounds); 2],
                steps: 0,
                regriddings: 0,
                ending: RegistrationEnding::StepsTaken,
            };
            // Decreases of the last steps, in turn.
            let mut window = [f64::INFINITY; WINDOW];
            while report.steps < self.steps {
                let Some(step) = current.step(&mut alignment, &bounds)? else {
                    report.ending = RegistrationEnding::NoFurtherDecrease;
                    break;
                };
                window[report.steps % WINDOW] = step.decrease;
                decrease += step.decrease;
                report.steps += 1;
                report.regriddings += usize::from(step.regridded);
                regriddings += usize::from(step.regridded);
                let progress = RegistrationProgress {
                    level,
                    levels: pyramid.len(),
                    step: report.steps,
                    measure: step.measure,
                    least_jacobian: step.least_jacobian,
                    regriddings,
                };
                if observer(progress).is_break() {
                    report.ending = RegistrationEnding::Interrupted;
                    break;
                }
                if window.iter().sum::<f64>() < self.tolerance * decrease {
                    report.ending = RegistrationEnding::Converged;
                    break;
                }
            }
            report.measures[1] = current.measure();
            reports.push(report);
            state = Some((current, grid));
            if report.ending == RegistrationEnding::Interrupted {
                break;
            }
        }
        let (moving, fixed) = match state {
            Some((state, grid)) if grid == *fixed.grid() => state.maps(&grid),
            Some((state, grid)) => {
                let (moving, other) = state.maps(&grid);
                (moving.resampled(*fixed.grid()), other.map(|other| other.resampled(*fixed.grid())))
            }
            None => (DisplacementMap::identity(*fixed.grid()), None),
        };
        Ok(match fixed {
            None => Registered { map: moving, halves: None, levels: reports },
            Some(fixed) => {
                let map = moving.after(&fixed.inverse()?)?;
                Registered { map, halves: Some([fixed, moving]), levels: reports }
            }
        })
    }

    fn bounds(&self) -> Result<Bounds, RegistrationError> {
        let Self { tolerance, largest_step, regrid_below, least_jacobian, .. } = *self;
        self.model.check()?;
        check_bound("tolerance", tolerance, "0 <= tolerance < 1", 0.0 <= tolerance && tolerance < 1.0)?;
        check_bound("largest step", largest_step, "0 < largest step <= 2", 0.0 < largest_step && largest_step <= 2.0)?;
        check_bound("regrid below", regrid_below, "0 <= regrid below < 1", 0.0 <= regrid_below && regrid_below < 1.0)?;
        let holds = 0.0 < least_jacobian && least_jacobian < 1.0;
        check_bound("least Jacobian", least_jacobian, "0 < least Jacobian < 1", holds)?;
        Ok(Bounds { largest_step, least_jacobian, regrid_below, halvings: 12 })
    }

    /// The images of all levels, the finest first.
    fn pyramid<const D: usize, T: Precision>(
        &self,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
    ) -> Result<Vec<[Image<D, T>; 2]>, RegistrationError> {
        let smallest = |grid: &ImageGrid<D>| grid.sizes().into_iter().min().unwrap_or(0);
        if let Some(levels) = self.levels {
            let most = 1 + (smallest(fixed.grid()) / 4).checked_ilog2().unwrap_or(0) as usize;
            let bound = "1 <= levels, with at least 4 samples along each side of the coarsest image";
            check_bound("levels", levels as f64, bound, 1 <= levels && levels <= most)?;
        }
        let mut pyramid = vec![[fixed.clone(), moving.clone()]];
        while let Some([fixed, moving]) = pyramid.last() {
            let is_enough = match self.levels {
                Some(levels) => levels <= pyramid.len(),
                None => smallest(&fixed.grid().halved()) < COARSEST,
            };
            if is_enough {
                break;
            }
            let coarser = [halved(fixed), halved(moving)];
            pyramid.push(coarser);
        }
        Ok(pyramid)
    }
}

/// The state of either model.
enum State<const D: usize, T> {
    Elastic(ElasticState<D, T>),
    Fluid(FluidState<D, T>),
}

impl<const D: usize, T: Precision> State<D, T> {
    fn new(grid: &ImageGrid<D>, model: &RegistrationModel, is_symmetric: bool) -> Result<Self, RegistrationError> {
        Ok(match model {
            RegistrationModel::Elastic { .. } => Self::Elastic(ElasticState::new(grid, model, is_symmetric)?),
            RegistrationModel::ViscousFluid { .. } => Self::Fluid(FluidState::new(grid, model, is_symmetric)?),
        })
    }

    fn continued(
        &self,
        coarser: &ImageGrid<D>,
        grid: &ImageGrid<D>,
        model: &RegistrationModel,
    ) -> Result<Self, RegistrationError> {
        Ok(match self {
            Self::Elastic(state) => Self::Elastic(state.continued(coarser, grid, model)?),
            Self::Fluid(state) => Self::Fluid(state.continued(coarser, grid, model)?),
        })
    }

    fn begin(&mut self, alignment: &mut Alignment<D, T>, bounds: &Bounds) -> f64 {
        match self {
            Self::Elastic(state) => state.begin(alignment, bounds),
            Self::Fluid(state) => state.begin(alignment, bounds),
        }
    }

    fn step(&mut self, alignment: &mut Alignment<D, T>, bounds: &Bounds) -> Result<Option<Step>, RegistrationError> {
        match self {
            Self::Elastic(state) => state.step(alignment, bounds),
            Self::Fluid(state) => state.step(alignment, bounds),
        }
    }

    fn maps(&self, grid: &ImageGrid<D>) -> (DisplacementMap<D, T>, Option<DisplacementMap<D, T>>) {
        match self {
            Self::Elastic(state) => state.maps(grid),
            Self::Fluid(state) => state.maps(grid),
        }
    }

    fn measure(&self) -> f64 {
        match self {
            Self::Elastic(state) => state.measure(),
            Self::Fluid(state) => state.measure(),
        }
    }
}
