//! Torsion of a cylinder or a tube, with and without axial force.

use core::f64::consts::{PI, TAU};

use piola_numerics::Gradient;

use super::tube::{check_stretches, loads, profile};
use super::{Ends, Tube, shear_modulus};
use crate::error::check_finite;
use crate::families::TubeDeformation;
use crate::roots::{implicit, newton};
use crate::{LoadCurve, ResponseFunctions, SolutionsError};

/// The torque on a cylinder or a tube over its twist, its curved faces free.
///
/// ```text
/// θ = Θ + ψ Z      z = λ Z      M = 2π ∫ T_θz r² dr      N = 2π ∫ T_zz r dr
/// ```
/// At a fixed length a twisted cylinder pushes against its ends; without axial force it grows longer: Poynting's effect.
/// [`Ends::Closed`] is the same as no force: there is no pressure.
///
/// # Example
/// ```
/// use core::f64::consts::PI;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::LoadCurve;
/// use piola_solutions::loads::{Ends, Torsion, Tube};
/// let law = NeoHookean::new(1.0)?;
/// let rod = Torsion { tube: Tube::solid(1.0)?, law: &law, ends: Ends::Force(0.0) };
/// let twisted = rod.state(0.5)?;
/// // λ³ = 1 + ¼ ψ² R² of a neo-Hookean rod: N = π μ R² (λ − λ⁻²) − ¼ π μ ψ² R⁴ λ⁻²
/// assert!((twisted.axial_stretch.powi(3) - 1.0625).abs() < 1e-13);
/// assert!((twisted.torque - 0.25 * PI / twisted.axial_stretch).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. S. Rivlin, Phil. Trans. R. Soc. A 242 (1949) 173; J. H. Poynting, Proc. R. Soc. A 82 (1909) 546; family 3.
#[doc(alias("Poynting effect"))]
#[derive(Clone, Copy, Debug)]
pub struct Torsion<'a, L> {
    /// The cylinder or tube.
    pub tube: Tube,
    /// The law.
    pub law: &'a L,
    /// What holds the ends.
    pub ends: Ends,
}

/// A twisted cylinder or tube.
///
/// # Example
/// See [`Torsion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwistedTube {
    /// The deformation.
    pub deformation: TubeDeformation,
    /// λ.
    pub axial_stretch: f64,
    /// ψ, rad per metre of the reference.
    pub twist: f64,
    /// M, N m.
    pub torque: f64,
    /// N, N.
    pub axial_force: f64,
}

type Scalar = Gradient<f64, 3>;

/// What the loads of a tube are, with the condition that its inner face is free.
struct Loads {
    free: Scalar,
    torque: Scalar,
    force: Scalar,
}

fn loads_at(
    tube: &Tube,
    law: &impl ResponseFunctions,
    [axial, inner, twist]: [Scalar; 3],
) -> Result<Loads, SolutionsError> {
    check_stretches(axial.value, inner.value)?;
    let found = loads::<_, 21>(tube, law, &profile(tube, axial, inner, twist))?;
    let free = if tube.is_solid() {
        inner - Scalar::constant(1.0)
    } else {
        found.normal_stresses[0] / Scalar::constant(shear_modulus(law))
    };
    let whole = Scalar::constant(TAU);
    Ok(Loads { free, torque: found.torque * whole, force: found.axial_force * whole })
}

fn state_of(
    tube: &Tube,
    law: &impl ResponseFunctions,
    [axial_stretch, inner, twist]: [f64; 3],
) -> Result<TwistedTube, SolutionsError> {
    let profile = profile(tube, axial_stretch, inner, twist);
    let found = loads::<_, 6>(tube, law, &profile)?;
    let deformation = TubeDeformation::of_profile(profile);
    let (torque, axial_force) = (TAU * found.torque, TAU * found.axial_force);
    Ok(TwistedTube { deformation, axial_stretch, twist, torque, axial_force })
}

impl<L: ResponseFunctions> Torsion<'_, L> {
    /// The stretches along the axis and of the inner face, the twist; the torque and its slope.
    fn solved(&self, twist: f64) -> Result<([f64; 3], [f64; 2]), SolutionsError> {
        check_finite("twist", &[twist])?;
        let (guess, prescribed) = match self.ends.check()? {
            Ends::Stretch(stretch) => (stretch, None),
            Ends::Force(force) => (1.0, Some(force)),
            Ends::Closed => (1.0, Some(0.0)),
        };
        let scale = PI * self.tube.outer() * self.tube.outer() * shear_modulus(self.law);
        let state = |x: [Scalar; 3]| {
            let found = loads_at(&self.tube, self.law, x)?;
            let end = match prescribed {
                None => x[0] - Scalar::constant(guess),
                Some(force) => (found.force - Scalar::constant(force)) / Scalar::constant(scale),
            };
            Ok(([end, found.free], found.torque))
        };
        let inner = if self.tube.is_solid() { 1.0 } else { guess.sqrt().recip() };
        implicit("the axial force", [guess, inner, twist], state)
    }

    /// The state at a twist, rad/m.
    ///
    /// # Errors
    /// [`SolutionsError::NotConverged`] where no stretches are found; what the law refuses; [`SolutionsError::NotFinite`].
    pub fn state(&self, twist: f64) -> Result<TwistedTube, SolutionsError> {
        state_of(&self.tube, self.law, self.solved(twist)?.0)
    }
}

impl<L: ResponseFunctions> LoadCurve for Torsion<'_, L> {
    const LOAD: &'static str = "torque";
    const PARAMETER: &'static str = "twist";

    fn load_and_slope(&self, twist: f64) -> Result<[f64; 2], SolutionsError> {
        Ok(self.solved(twist)?.1)
    }
}

/// The state of a cylinder or tube under an axial force, N, and a torque, N m: that which grows from the unloaded one.
///
/// The loads are applied together in steps; all states under a torque come from [`Torsion`]'s
/// [`states_at`](LoadCurve::states_at).
///
/// # Errors
/// [`SolutionsError::BeyondLimitPoint`] where the torque is above all that the body can carry under the axial force, with
/// the limit; [`SolutionsError::NotConverged`] and [`SolutionsError::NotReached`] where no state is found; what the law
/// refuses; [`SolutionsError::NotFinite`].
///
/// # Accuracy
/// Residuals of the loads below 1e-11 of μ R² and μ R³, most often at rounding.
///
/// # Example
/// See [`Torsion`].
pub fn torsion_under(
    tube: &Tube,
    law: &impl ResponseFunctions,
    axial_force: f64,
    torque: f64,
) -> Result<TwistedTube, SolutionsError> {
    const STEPS: u32 = 8;
    check_finite("axial force", &[axial_force])?;
    check_finite("torque", &[torque])?;
    let scale = PI * tube.outer() * tube.outer() * shear_modulus(law);
    let lever = scale * tube.outer();
    let under = |start: [f64; 3], share: f64| {
        newton("axial force and torque", start, |x: [Scalar; 3]| {
            let found = loads_at(tube, law, x)?;
            Ok([
                (found.force - Scalar::constant(share * axial_force)) / Scalar::constant(scale),
                found.free,
                (found.torque - Scalar::constant(share * torque)) / Scalar::constant(lever),
            ])
        })
    };
    let mut x = [1.0, 1.0, 0.0];
    for step in 1..=STEPS {
        match under(x, f64::from(step) / f64::from(STEPS)) {
            Ok(next) => x = next,
            Err(SolutionsError::NotConverged { .. }) if torque != 0.0 => {
                return along_the_curve(&Torsion { tube: *tube, law, ends: Ends::Force(axial_force) }, torque);
            }
            Err(error) => return Err(error),
        }
    }
    state_of(tube, law, x)
}

/// The least twisted state that carries a torque on a curve, which names its limit point where there is no such state.
fn along_the_curve<L: ResponseFunctions>(curve: &Torsion<'_, L>, torque: f64) -> Result<TwistedTube, SolutionsError> {
    const DOUBLINGS: u32 = 10;
    let mut twist = torque.signum() * 0.125 / curve.tube.outer();
    for _ in 0..DOUBLINGS {
        let [load, slope] = curve.load_and_slope(twist)?;
        if slope < 0.0 || torque.abs() <= load.abs() {
            break;
        }
        twist *= 2.0;
    }
    let states = curve.states_at(torque, (twist.min(0.0), twist.max(0.0)))?;
    let least = states.iter().min_by(|a, b| a.parameter.abs().total_cmp(&b.parameter.abs()));
    curve.state(least.map_or(twist, |state| state.parameter))
}
