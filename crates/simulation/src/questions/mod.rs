//! Questions to a mechanism: equilibria, stability, modes of small motions.

mod asked;

pub use asked::MechanismQuestions;

use nalgebra::DMatrix;
use piola_lagrangian::LagrangianError;
pub use piola_lagrangian::small_motions::Stability;
use piola_lagrangian::small_motions::{ComplexMode, ComplexModes, Equilibrium, Linearisation, ModeMotion, NormalModes};

use crate::joints::Mechanism;

/// A mode of small motions, e^(σ t) with σ = growth ± i ω.
///
/// # Example
/// See [`Mechanism::answers`].
#[derive(Debug, Clone, PartialEq)]
pub struct MechanismMode {
    /// Angular frequency ω, rad/s; zero of a motion that does not oscillate.
    pub angular_frequency: f64,
    /// Growth rate, 1/s: negative of a damped motion.
    pub growth_rate: f64,
    /// Displacements of the coordinates in phase, the largest of length one.
    pub shape: Vec<f64>,
    /// Displacements a quarter of a turn later, without the growth until then; empty where all coordinates move in phase.
    pub quadrature: Vec<f64>,
}

/// The answers of a mechanism.
///
/// # Example
/// See [`Mechanism::answers`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MechanismAnswers {
    /// Coordinates of the equilibrium.
    pub coordinates: Vec<f64>,
    /// The largest force left over the forces that balance.
    pub residual: f64,
    /// What becomes of a small disturbance.
    pub stability: Stability,
    /// The modes, by frequency, where they are asked for.
    pub modes: Vec<MechanismMode>,
}

impl Mechanism {
    /// The equilibrium that is found from the coordinates at the start, at a time, and the modes about it.
    ///
    /// They are those of the mechanism without its [constraints](Self::constraints).
    ///
    /// Undamped modes are normal modes; with damping or other forces of rates they are complex.
    ///
    /// # Errors
    /// Those of [`equilibrium`](piola_lagrangian::Lagrangian::equilibrium) and
    /// [`complex_modes`](piola_lagrangian::small_motions::Linearisation::complex_modes).
    ///
    /// # Example
    /// A pendulum of 2.5 m hangs straight down and swings with ω = √(g/l) = 2/s.
    /// ```
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// use piola_simulation::questions::MechanismQuestions;
    /// let turn = Coordinate { name: "turn".into(), angular: true, position: 0.3, velocity: 0.0 };
    /// let motion = JointMotion::Revolute([0.0, 1.0, 0.0]);
    /// let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![turn] };
    /// let bob = Part { joint: 0, name: "bob".into(), at: [0.0, 0.0, -2.5], kind: PartKind::Particle(3.0) };
    /// let mut pendulum = Mechanism::new(vec![joint], vec![bob], [0.0, 0.0, -10.0])?;
    /// pendulum.questions = MechanismQuestions { modes: true, ..MechanismQuestions::default() };
    /// let answers = pendulum.answers(0.0)?;
    /// assert!(answers.coordinates[0].abs() < 1e-15);
    /// assert!((answers.modes[0].angular_frequency - 2.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn answers(&self, t: f64) -> Result<MechanismAnswers, LagrangianError> {
        let Equilibrium { coordinates, residual, linearisation, stability, .. } =
            self.lagrangian().equilibrium(&self.position, t)?;
        let mut modes = Vec::new();
        if self.questions.modes {
            modes = if is_conservative(&linearisation) {
                normal(&linearisation.normal_modes()?)
            } else {
                complex(&linearisation.complex_modes()?)
            };
        }
        Ok(MechanismAnswers { coordinates: coordinates.as_slice().to_vec(), residual, stability, modes })
    }
}

/// Whether forces of rates, and those that no potential has, are rounding alone beside masses and stiffness.
fn is_conservative(small: &Linearisation) -> bool {
    /// Some hundred ulp.
    const ROUNDING: f64 = 1e-13;
    let masses = small.mass_matrix.diagonal();
    // Over √(mᵢ mⱼ) entries of all coordinates have one unit, 1/s or 1/s².
    let scaled = |matrix: &DMatrix<f64>| {
        DMatrix::from_fn(masses.len(), masses.len(), |i, j| matrix[(i, j)] / (masses[i] * masses[j]).sqrt())
    };
    let (stiffness, damping) = (scaled(&small.stiffness), scaled(&small.damping));
    let square = stiffness.amax();
    // Forces without rates have no damping, not even by rounding: each coordinate is measured by its own stiffness, so that a
    // light damped one is not lost beside a stiff one.
    let rates: Vec<f64> = stiffness.row_iter().map(|row| row.amax().sqrt()).collect();
    let damped = |i: usize, j: usize| ROUNDING * (rates[i] * rates[j]).sqrt() < damping[(i, j)].abs();
    (0..masses.len()).all(|i| (0..masses.len()).all(|j| !damped(i, j)))
        && scaled(&small.gyroscopic).amax() <= ROUNDING * square.sqrt()
        && scaled(&small.circulatory).amax() <= ROUNDING * square
}

fn normal(found: &NormalModes) -> Vec<MechanismMode> {
    let mode = |i: usize| {
        let shape = found.shapes.column(i);
        let largest = shape.amax();
        let (angular_frequency, growth_rate) = match found.motion(i) {
            Some(ModeMotion::Oscillation { angular_frequency }) => (angular_frequency, 0.0),
            Some(ModeMotion::Growth { rate }) => (0.0, rate),
            _ => (0.0, 0.0),
        };
        let shape = shape.iter().map(|x| x / largest).collect();
        MechanismMode { angular_frequency, growth_rate, shape, quadrature: Vec::new() }
    };
    (0..found.squares.len()).map(mode).collect()
}

fn complex(found: &ComplexModes) -> Vec<MechanismMode> {
    let mode = |mode: &ComplexMode| {
        let largest = mode.shape.iter().fold(0.0, |largest: f64, x| largest.max(x.norm()));
        MechanismMode {
            angular_frequency: mode.angular_frequency(),
            growth_rate: mode.growth_rate(),
            shape: mode.shape.iter().map(|x| x.re / largest).collect(),
            // A quarter of a turn later e^{iωt} is i: Re(iφ) = −Im φ.
            quadrature: mode.shape.iter().map(|x| -x.im / largest).collect(),
        }
    };
    found.modes.iter().map(mode).collect()
}
