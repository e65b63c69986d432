//! Elastic and viscous fields on a rectangle or a box, by the eigenfunctions of their operator.

mod checkpoint;
mod flow;
mod form;
mod instant;
mod load;
pub(crate) mod map;
mod motion;
mod run;
mod statics;

pub use checkpoint::BoxCheckpoint;
pub use flow::FlowHistory;
pub use form::{Form, Load, Start};
pub use instant::{FlowInstant, MotionInstant};
pub use motion::MotionHistory;
pub use run::{BoxFindings, Found};
pub use statics::StaticField;

use piola_spectral::{BoxGrid, LameParameters, PointLocation, Walls};

/// Instants of a motion, and steps of a flow, at most.
pub const MOST_STEPS: f64 = 100_000.0;
/// Memory that a study may take, bytes.
pub const MOST_BYTES: f64 = 1_073_741_824.0;

/// A study of fields on a rectangle or a box.
///
/// # Example
/// A bar between sliding walls under f = sin πx: u = f/((λ + 2μ) π²).
/// ```
/// use piola_spectral::{BoxGrid, LameParameters, Walls};
/// use piola_studies::boxes::{BoxFields, BoxFindings, BoxStudy, Form, Found, Load, StaticTask, Task};
/// use std::{f64::consts::PI, ops::ControlFlow};
/// let form = Form::Mode { amplitudes: [1.0, 0.0], indices: [1, 0] };
/// let fields = BoxFields {
///     sides: [1.0, 1.0],
///     walls: Walls::Sliding,
///     lame: LameParameters::new(2.0, 1.0)?,
///     loads: vec![Load { form, span: [0.0, f64::INFINITY], course: vec![1.0] }],
///     probes: vec![],
///     task: Task::Static(StaticTask { grid: BoxGrid::nodes([9, 3], [0.125, 0.5])?, modes: None }),
/// };
/// let (found, _) = BoxStudy::Rectangle(fields).run(&mut |_| ControlFlow::Continue(()));
/// let BoxFindings::Rectangle(Found::Static(field)) = found else { panic!() };
/// let (largest, [x, _]) = field.largest_displacement().unwrap();
/// assert_eq!(x, 0.5);
/// assert!((largest - 1.0 / (4.0 * PI * PI)).abs() < 1e-17);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub enum BoxStudy {
    /// Two sides: plane strain or plane flow, for a unit of depth.
    Rectangle(BoxFields<2>),
    /// Three sides.
    Box(BoxFields<3>),
}

/// Fields on a rectangle (D = 2) or a box (D = 3).
///
/// # Example
/// See [`BoxStudy`].
#[derive(Debug, Clone)]
pub struct BoxFields<const D: usize> {
    /// The sides, m.
    pub sides: [f64; D],
    /// What the walls hold.
    pub walls: Walls,
    /// λ and μ: moduli, Pa, or viscosities, Pa s.
    pub lame: LameParameters,
    /// The forces.
    pub loads: Vec<Load<D>>,
    /// The places that are recorded.
    pub probes: Vec<Probe<D>>,
    /// What is computed.
    pub task: Task<D>,
}

/// What is computed.
///
/// # Example
/// See [`BoxStudy`].
#[derive(Debug, Clone)]
pub enum Task<const D: usize> {
    /// The displacement in equilibrium.
    Static(StaticTask<D>),
    /// A motion of modes.
    Motion(MotionTask<D>),
    /// A creeping flow.
    Flow(FlowTask<D>),
}

/// Equilibrium on a grid.
///
/// # Example
/// See [`BoxStudy`].
#[derive(Debug, Clone)]
pub struct StaticTask<const D: usize> {
    /// The grid.
    pub grid: BoxGrid<D>,
    /// The highest indices that are kept; all when absent.
    pub modes: Option<[usize; D]>,
}

/// A motion of modes.
///
/// # Example
/// See [`BoxStudy::run_with_checkpoints`].
#[derive(Debug, Clone)]
pub struct MotionTask<const D: usize> {
    /// The highest indices.
    pub modes: [usize; D],
    /// ρ, kg/m³.
    pub density: f64,
    /// c, kg/(m³ s).
    pub drag: f64,
    /// Time from the start to the end, s.
    pub duration: f64,
    /// Time between the instants that are recorded, s.
    pub interval: f64,
    /// The parts of the state at the start.
    pub starts: Vec<Start<D>>,
}

/// A creeping flow on a grid.
///
/// # Example
/// See [`BoxStudy`].
#[derive(Debug, Clone)]
pub struct FlowTask<const D: usize> {
    /// The grid.
    pub grid: BoxGrid<D>,
    /// The highest indices that are kept; all when absent.
    pub modes: Option<[usize; D]>,
    /// Time from the start to the end, s.
    pub duration: f64,
    /// The step, s; chosen by the speed when absent.
    pub step: Option<f64>,
    /// Bound of det(1 − ∇u) for regridding.
    pub least_jacobian: f64,
}

/// A place with a name.
///
/// # Example
/// See [`BoxStudy`].
#[derive(Debug, Clone, PartialEq)]
pub struct Probe<const D: usize> {
    /// Its name.
    pub name: String,
    /// The place, m.
    pub at: [f64; D],
}

impl<const D: usize> BoxFields<D> {
    /// The highest indices of the modes.
    #[must_use]
    pub fn highest(&self) -> [usize; D] {
        match &self.task {
            Task::Static(StaticTask { grid, modes }) | Task::Flow(FlowTask { grid, modes, .. }) => {
                modes.unwrap_or_else(|| resolved(grid))
            }
            Task::Motion(task) => task.modes,
        }
    }

    /// Memory of the run, bytes.
    #[must_use]
    pub fn bytes(&self) -> f64 {
        let d = D as f64;
        let modes: f64 = self.highest().iter().map(|index| *index as f64 + 1.0).product();
        let lists = |count: f64, length: f64| 8.0 * count * length;
        match &self.task {
            // The displacement, a copy, its modes and the stress; what forces add is as large as the modes.
            Task::Static(task) => lists(3.0 * d + d * d, task.grid.len() as f64) + lists(3.0 * d, modes),
            // The velocity, the displacement and the memory of a step with its gradient.
            Task::Flow(task) => lists(5.0 * d + d * d, task.grid.len() as f64) + lists(3.0 * d, modes),
            // The state, each load, the four coefficients of their sum; the nodes at which functions are sampled.
            Task::Motion(task) => {
                let forms =
                    || self.loads.iter().map(|load| &load.form).chain(task.starts.iter().map(|start| &start.form));
                let nodes = forms().map(|form| form.nodes(self.sides, task.modes) as f64).fold(0.0, f64::max);
                lists(d * (self.loads.len() as f64 + 8.0), modes) + lists(2.0 * d, (0..D).map(|_| nodes).product())
            }
        }
    }
}

/// The highest indices that a grid can tell apart from others in all components.
#[must_use]
pub fn resolved<const D: usize>(grid: &BoxGrid<D>) -> [usize; D] {
    let beyond = if grid.location() == PointLocation::Cells { 1 } else { 2 };
    grid.points().map(|points| points - beyond)
}
