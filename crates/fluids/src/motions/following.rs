//! Any motion of any differential fluid, by integration along it.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_integrators::{DormandPrince853, State, Tolerance, field};

use super::shear_stresses::ShearStresses;
use super::steady::steady_mode;
use super::stress_rate::StressRate;
use crate::error::check_bound;
use crate::{DifferentialFluid, FluidsError, Mode, ViscometricFluid};

/// Integration along a motion: the stresses of the modes of a differential fluid, and the time.
///
/// # Accuracy
/// The tolerance times a few, in units of the largest stress.
///
/// # Example
/// ```
/// use piola_fluids::{ConvectedMaxwell, Following, UpperConvectedMaxwell};
/// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
/// let shear = [[0.0; 3], [3.0, 0.0, 0.0], [0.0; 3]];
/// let mut motion = Following::from_rest(&fluid, 1e-12)?;
/// let early = motion.advance(|_| shear, 0.25)?;
/// let exact = fluid.start_up(3.0, 0.25)?;
/// assert!((early.components[3] / exact.shear - 1.0).abs() < 1e-11);
/// let later = motion.advance(|_| [[0.0; 3]; 3], 0.75)?; // for one λ at rest
/// assert!((later.components[3] / early.components[3] * 1.0_f64.exp() - 1.0).abs() < 1e-11);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Following<'a, F> {
    fluid: &'a F,
    state: State,
    method: DormandPrince853,
}

impl<'a, F: DifferentialFluid<Mode: StressRate>> Following<'a, F> {
    /// From rest at t = 0; every mode is integrated with step control to the relative `tolerance`.
    ///
    /// # Errors
    /// [`FluidsError::Integration`] for a tolerance that is not positive.
    pub fn from_rest(fluid: &'a F, tolerance: f64) -> Result<Self, FluidsError> {
        // Stresses may start from zero: what is small beside the modulus of a mode counts for nothing.
        let modulus =
            fluid.modes().iter().map(|mode| mode.polymer_viscosity() / mode.time()).fold(f64::INFINITY, f64::min);
        let method = DormandPrince853::new(Tolerance::new(tolerance, 1e-3 * tolerance * modulus)?);
        Ok(Self { fluid, state: State::new(0.0, vec![0.0; 6 * fluid.modes().len()])?, method })
    }

    /// After a motion with the steady velocity gradient L until t = 0.
    ///
    /// # Errors
    /// As [`from_rest`](Self::from_rest); [`FluidsError::BeyondLimit`] where the motion has no steady stress.
    pub fn from_steady(
        fluid: &'a F,
        velocity_gradient: &VelocityGradient,
        tolerance: f64,
    ) -> Result<Self, FluidsError> {
        let mut following = Self::from_rest(fluid, tolerance)?;
        for (mode, y) in fluid.modes().iter().zip(following.state.values.chunks_exact_mut(6)) {
            y.copy_from_slice(&steady_mode(mode, velocity_gradient)?.components);
        }
        Ok(following)
    }

    /// t, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// T + p 1 without the solvent, Pa, now.
    #[must_use]
    pub fn polymer_stress(&self) -> Symmetric {
        self.state
            .values
            .chunks_exact(6)
            .fold(Symmetric::zero(), |sum, y| sum + Symmetric { components: core::array::from_fn(|i| y[i]) })
    }

    /// Follows the motion whose L(t), by rows, is `gradient` until the time t, and gives T + p 1, Pa, there. Allocates nothing
    /// after the first call.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] for a time before now; [`FluidsError::Continuum`] for an L that is not finite
    /// there; [`FluidsError::Integration`] where the run fails.
    pub fn advance(&mut self, gradient: impl Fn(f64) -> [[f64; 3]; 3], t: f64) -> Result<Symmetric, FluidsError> {
        let (modes, before) = (self.fluid.modes(), self.state.time);
        check_bound(F::Mode::NAME, "time", t, "0 ≤ time, and no earlier than the one before", before <= t)?;
        let mut field = field(6 * modes.len(), |t, y: &[f64], rate: &mut [f64]| {
            // What is not finite stops the run, which names it.
            let l = VelocityGradient::from_rows(gradient(t));
            let (l, factor) = l.map_or((VelocityGradient::zero(), f64::NAN), |l| (l, 1.0));
            for (mode, (y, rate)) in modes.iter().zip(y.chunks_exact(6).zip(rate.chunks_exact_mut(6))) {
                let stress = Symmetric { components: core::array::from_fn(|i| y[i]) };
                rate.copy_from_slice(&mode.stress_rate(&stress, &l).components.map(|x| x * factor));
            }
        });
        self.method.integrate_to(&mut field, &mut self.state, t)?;
        let deforming = VelocityGradient::from_rows(gradient(t))?.rate_of_deformation().0;
        Ok(self.polymer_stress() + deforming * (2.0 * self.fluid.total_solvent_viscosity()))
    }
}

/// T + p 1, Pa, at each of the `times`, s, of a motion from rest at t = 0 with the velocity gradient L(t).
///
/// `gradient` gives the rows of L at t. Every mode is integrated with step control to the relative `tolerance`. What is followed
/// without new memory for its stresses is a [`Following`].
///
/// # Errors
/// [`FluidsError::OutOfBounds`] unless the times grow from 0 ≤ t; [`FluidsError::Continuum`] for an L that is not
/// finite at one of them; [`FluidsError::Integration`] where the run fails.
///
/// # Accuracy
/// The tolerance times a few, in units of the largest stress.
///
/// # Example
/// See [`Following`].
pub fn follow<F: DifferentialFluid<Mode: StressRate>>(
    fluid: &F,
    gradient: impl Fn(f64) -> [[f64; 3]; 3],
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<Symmetric>, FluidsError> {
    let mut motion = Following::from_rest(fluid, tolerance)?;
    times.iter().map(|&t| motion.advance(&gradient, t)).collect()
}

/// The stresses at each of the `times`, s, of a shear flow from rest at t = 0 with the rate k(t), 1/s.
///
/// # Errors
/// As [`follow`].
///
/// # Accuracy
/// As [`follow`].
///
/// # Example
/// See [`Following`].
pub fn follow_shear<F: DifferentialFluid<Mode: StressRate>>(
    fluid: &F,
    shear_rate: impl Fn(f64) -> f64,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<ShearStresses>, FluidsError> {
    let gradient = |t: f64| [[0.0; 3], [shear_rate(t), 0.0, 0.0], [0.0; 3]];
    Ok(follow(fluid, gradient, times, tolerance)?.iter().map(ShearStresses::of).collect())
}
