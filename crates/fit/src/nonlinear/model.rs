//! Viscoelastic fluids by their names, and their parameters.

use core::fmt;
use core::str::FromStr;

use piola_fluids::{
    AnyFluid, ExponentialDamping, ExponentialPhanThienTanner, Giesekus, Kbkz, LinearPhanThienTanner, Mode, Modes,
    OldroydB, RationalDamping, Relaxation,
};

use super::answers::{differential, integral, linear};
use super::data::{NonlinearData, NonlinearFlow, ShearResponse};
use crate::FitError;

/// Most modes that are fitted.
const MOST: usize = 6;

/// A viscoelastic fluid with unknown parameters.
///
/// | name | fluid | parameters, of one mode |
/// |---|---|---|
/// | `oldroyd-b` | [`OldroydB`] | `solvent_viscosity`, `polymer_viscosity`, `time` |
/// | `giesekus` | [`Giesekus`] | the same, and `mobility` ≤ ½ |
/// | `linear-ptt`, `exponential-ptt` | [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`] | the same, and `extensibility` |
/// | `kbkz-rational` | [`Kbkz`] with [`RationalDamping`] | `viscosity`, `time`, `alpha`, `beta` ≤ 1 |
/// | `kbkz-exponential` | [`Kbkz`] with [`ExponentialDamping`] | `viscosity`, `time`, `strength`, `beta` ≤ 1 |
///
/// Several modes ([`RelaxationModes`]) have a viscosity and a `time` each. They share the solvent and the parameters behind `time` in the
/// table. Shear flows do not depend on `beta` of the K-BKZ fluids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NonlinearModel {
    /// Oldroyd's fluid B.
    OldroydB,
    /// Giesekus' fluid.
    Giesekus,
    /// Phan-Thien and Tanner's fluid with the linear function.
    LinearPtt,
    /// The same with the exponential function.
    ExponentialPtt,
    /// K-BKZ with the damping of Papanastasiou, Scriven and Macosko.
    KbkzRational,
    /// K-BKZ with Wagner's damping.
    KbkzExponential,
}

/// The relaxation modes: a number of modes whose viscosities and times are fitted, or given ones.
///
/// # Example
/// ```
/// use piola_fit::nonlinear::{NonlinearModel, RelaxationModes};
/// use piola_fluids::Relaxation;
/// let fitted = NonlinearModel::Giesekus.parameters(&RelaxationModes::Fitted(2));
/// assert_eq!(fitted[3..], ["polymer_viscosity2", "time2", "mobility"]);
/// let given = RelaxationModes::Given(vec![Relaxation { viscosity: 10.0, time: 1.0 }]);
/// assert_eq!(NonlinearModel::Giesekus.parameters(&given), ["solvent_viscosity", "mobility"]);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum RelaxationModes {
    /// The number of fitted modes, 1 to 6. Each has a viscosity and a time among the parameters.
    Fitted(usize),
    /// Viscosities and times that are held, as those of a relaxation spectrum: ηᵢ = gᵢ λᵢ.
    Given(Vec<Relaxation>),
}

impl Default for RelaxationModes {
    fn default() -> Self {
        Self::Fitted(1)
    }
}

impl RelaxationModes {
    /// Checks the number of modes, and the viscosities and times of given ones.
    ///
    /// # Errors
    /// [`FitError::ModeCount`]; [`FitError::ModeNotPositive`] for a viscosity or a time that is not positive and finite.
    ///
    /// # Example
    /// ```
    /// use piola_fit::nonlinear::RelaxationModes;
    /// let refused = RelaxationModes::Fitted(7).check().unwrap_err().to_string();
    /// assert_eq!(refused, "the number of relaxation modes is 7; it must be at least 1, and at most 6 if they are fitted");
    /// ```
    pub fn check(&self) -> Result<(), FitError> {
        match self {
            Self::Fitted(count) if !(1..=MOST).contains(count) => Err(FitError::ModeCount { value: *count }),
            Self::Fitted(_) => Ok(()),
            Self::Given(spectrum) if spectrum.is_empty() => Err(FitError::ModeCount { value: 0 }),
            Self::Given(spectrum) => {
                for (index, mode) in spectrum.iter().enumerate() {
                    for (quantity, value) in [("viscosity", mode.viscosity), ("time", mode.time)] {
                        if !(0.0 < value && value.is_finite()) {
                            return Err(FitError::ModeNotPositive { index, quantity, value });
                        }
                    }
                }
                Ok(())
            }
        }
    }

    /// Modes with viscosities and times among the parameters.
    const fn fitted(&self) -> usize {
        match self {
            Self::Fitted(count) => *count,
            Self::Given(_) => 0,
        }
    }
}

/// A fluid with its modes.
enum FluidOfModes {
    OldroydB(Vec<OldroydB>),
    Giesekus(Vec<Giesekus>),
    LinearPtt(Vec<LinearPhanThienTanner>),
    ExponentialPtt(Vec<ExponentialPhanThienTanner>),
    KbkzRational(Kbkz<RationalDamping>),
    KbkzExponential(Kbkz<ExponentialDamping>),
}

impl NonlinearModel {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::OldroydB,
        Self::Giesekus,
        Self::LinearPtt,
        Self::ExponentialPtt,
        Self::KbkzRational,
        Self::KbkzExponential,
    ];

    /// Its name, as `giesekus`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OldroydB => "oldroyd-b",
            Self::Giesekus => "giesekus",
            Self::LinearPtt => "linear-ptt",
            Self::ExponentialPtt => "exponential-ptt",
            Self::KbkzRational => "kbkz-rational",
            Self::KbkzExponential => "kbkz-exponential",
        }
    }

    /// Whether it has a second normal stress difference.
    #[must_use]
    pub const fn has_second_normal_stress(self) -> bool {
        matches!(self, Self::Giesekus)
    }

    /// Whether it has a solvent: K-BKZ fluids have none.
    const fn has_solvent(self) -> bool {
        !matches!(self, Self::KbkzRational | Self::KbkzExponential)
    }

    /// The parameters that all modes share, with their upper bounds.
    const fn shared(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::OldroydB => &[],
            Self::Giesekus => &[("mobility", 0.5)],
            Self::LinearPtt | Self::ExponentialPtt => &[("extensibility", f64::INFINITY)],
            Self::KbkzRational => &[("alpha", f64::INFINITY), ("beta", 1.0)],
            Self::KbkzExponential => &[("strength", f64::INFINITY), ("beta", 1.0)],
        }
    }

    /// The names of its parameters, in order; those of several modes are numbered from 1.
    #[must_use]
    pub fn parameters(self, modes: &RelaxationModes) -> Vec<String> {
        let mut names: Vec<String> = self.has_solvent().then(|| "solvent_viscosity".to_owned()).into_iter().collect();
        let viscosity = if self.has_solvent() { "polymer_viscosity" } else { "viscosity" };
        let count = modes.fitted();
        for k in 1..=count {
            let number = if count == 1 { String::new() } else { k.to_string() };
            names.extend([format!("{viscosity}{number}"), format!("time{number}")]);
        }
        names.extend(self.shared().iter().map(|(name, _)| (*name).to_owned()));
        names
    }

    /// The place of the first viscosity of a mode, and the number of modes that are fitted.
    pub(super) fn places(self, modes: &RelaxationModes) -> (usize, usize) {
        (usize::from(self.has_solvent()), modes.fitted())
    }

    /// The bounds of each parameter.
    pub(super) fn bounds(self, modes: &RelaxationModes) -> Vec<[f64; 2]> {
        let (first, count) = self.places(modes);
        let positive = core::iter::repeat_n([0.0, f64::INFINITY], first + 2 * count);
        positive.chain(self.shared().iter().map(|(_, high)| [0.0, *high])).collect()
    }

    /// Starts of a search about a viscosity and a rate.
    pub(super) fn starts(self, modes: &RelaxationModes, [viscosity, rate]: [f64; 2]) -> Vec<Vec<f64>> {
        let count = modes.fitted();
        // What is held needs no guesses of its times.
        let guesses: &[f64] = if count == 0 { &[1.0] } else { &[0.3, 3.0, 30.0] };
        let mut starts = Vec::new();
        for weissenberg in guesses {
            for last in [0.3, 0.03] {
                let solvent = if self == Self::OldroydB { 0.3 * last } else { 0.1 };
                let mut start = if self.has_solvent() { vec![solvent * viscosity] } else { Vec::new() };
                for k in 0..count {
                    // A decade apart, about the middle one.
                    let time = weissenberg / rate * 10.0_f64.powf(k as f64 - 0.5 * (count as f64 - 1.0));
                    start.extend([viscosity / count as f64, time]);
                }
                match self {
                    Self::OldroydB => {}
                    Self::Giesekus | Self::LinearPtt | Self::ExponentialPtt => start.push(last),
                    Self::KbkzRational => start.extend([3.0 / last, 0.3]),
                    Self::KbkzExponential => start.extend([last, 0.3]),
                }
                starts.push(start);
            }
        }
        starts
    }

    fn with_modes(self, modes: &RelaxationModes, parameters: &[f64]) -> Result<FluidOfModes, FitError> {
        let (first, count) = self.places(modes);
        let expected = first + 2 * count + self.shared().len();
        if parameters.len() != expected {
            let (model, values) = (self.name().to_owned(), parameters.len());
            return Err(FitError::NumberOfValues { model, parameters: expected, values });
        }
        let (own, shared) = parameters[first..].split_at(2 * count);
        let memory: Vec<Relaxation> = match modes {
            RelaxationModes::Given(spectrum) => spectrum.clone(),
            RelaxationModes::Fitted(_) => {
                own.chunks_exact(2).map(|pair| Relaxation { viscosity: pair[0], time: pair[1] }).collect()
            }
        };
        /// Modes of a constructor; the solvent is beside the first.
        macro_rules! modes {
            ($fluid:ident $(, $shared:expr)?) => {
                memory
                    .iter()
                    .enumerate()
                    .map(|(k, mode)| {
                        let solvent = if k == 0 { parameters[0] } else { 0.0 };
                        $fluid::new(solvent, mode.viscosity, mode.time $(, $shared)?)
                    })
                    .collect::<Result<_, _>>()?
            };
        }
        Ok(match self {
            Self::OldroydB => FluidOfModes::OldroydB(modes!(OldroydB)),
            Self::Giesekus => FluidOfModes::Giesekus(modes!(Giesekus, shared[0])),
            Self::LinearPtt => FluidOfModes::LinearPtt(modes!(LinearPhanThienTanner, shared[0])),
            Self::ExponentialPtt => FluidOfModes::ExponentialPtt(modes!(ExponentialPhanThienTanner, shared[0])),
            Self::KbkzRational => {
                FluidOfModes::KbkzRational(Kbkz::new(memory, RationalDamping::new(shared[0], shared[1])?)?)
            }
            Self::KbkzExponential => {
                FluidOfModes::KbkzExponential(Kbkz::new(memory, ExponentialDamping::new(shared[0], shared[1])?)?)
            }
        })
    }

    /// The fluid with these parameters; of one mode it is that fluid, of several their [`Modes`].
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`]; [`FitError::ModeCount`], [`FitError::ModeNotPositive`]; [`FitError::Fluids`] for parameters out of bounds.
    pub fn fluid(self, modes: &RelaxationModes, parameters: &[f64]) -> Result<AnyFluid, FitError> {
        fn one_or_several<M: Mode>(modes: Vec<M>) -> Result<AnyFluid, FitError>
        where
            AnyFluid: From<M> + From<Modes<M>>,
        {
            Ok(match modes.as_slice() {
                [only] => only.clone().into(),
                _ => Modes::new(modes)?.into(),
            })
        }
        modes.check()?;
        match self.with_modes(modes, parameters)? {
            FluidOfModes::OldroydB(modes) => one_or_several(modes),
            FluidOfModes::Giesekus(modes) => one_or_several(modes),
            FluidOfModes::LinearPtt(modes) => one_or_several(modes),
            FluidOfModes::ExponentialPtt(modes) => one_or_several(modes),
            FluidOfModes::KbkzRational(fluid) => Ok(fluid.into()),
            FluidOfModes::KbkzExponential(fluid) => Ok(fluid.into()),
        }
    }

    /// The answers of the fluid with these parameters in a flow, at each drive: the shear or extension rate of a steady flow, the time
    /// of a start-up. Stresses, Pa.
    ///
    /// # Errors
    /// As [`fluid`](Self::fluid); [`FitError::RateNotPositive`], [`FitError::RowNotPositive`] for a rate or a drive that is not positive
    /// and finite.
    ///
    /// # Example
    /// ```
    /// use piola_fit::nonlinear::{NonlinearFlow, NonlinearModel, RelaxationModes, ShearResponse};
    /// let flow = NonlinearFlow::SteadyShear(ShearResponse::ShearStress);
    /// let boger = NonlinearModel::OldroydB.answers(&RelaxationModes::Fitted(1), &[1.0, 2.0, 4.0], flow, &[10.0])?;
    /// assert_eq!(boger, [30.0]); // (1 + 2) k
    /// # Ok::<(), piola_fit::FitError>(())
    /// ```
    pub fn answers(
        self,
        modes: &RelaxationModes,
        parameters: &[f64],
        flow: NonlinearFlow,
        drives: &[f64],
    ) -> Result<Vec<f64>, FitError> {
        modes.check()?;
        let mut order: Vec<usize> = (0..drives.len()).collect();
        order.sort_by(|a, b| drives[*a].total_cmp(&drives[*b]));
        let sign = flow.shear_response().map_or(1.0, ShearResponse::sign);
        let data = NonlinearData::new(flow, drives.iter().map(|drive| [*drive, sign]).collect())?;
        let mut sorted = Vec::with_capacity(drives.len());
        self.answer(modes, parameters, &data, &mut sorted)?;
        let mut answers = vec![0.0; drives.len()];
        order.into_iter().zip(sorted).for_each(|(place, answer)| answers[place] = answer);
        Ok(answers)
    }

    /// The answers of the fluid with these parameters in the rows of a flow, appended.
    pub(super) fn answer(
        self,
        modes: &RelaxationModes,
        parameters: &[f64],
        data: &NonlinearData,
        out: &mut Vec<f64>,
    ) -> Result<(), FitError> {
        match self.with_modes(modes, parameters)? {
            FluidOfModes::OldroydB(modes) => linear(&modes, data, out),
            FluidOfModes::Giesekus(modes) => differential(&modes, data, out),
            FluidOfModes::LinearPtt(modes) => differential(&modes, data, out),
            FluidOfModes::ExponentialPtt(modes) => differential(&modes, data, out),
            FluidOfModes::KbkzRational(fluid) => integral(&fluid, data, out),
            FluidOfModes::KbkzExponential(fluid) => integral(&fluid, data, out),
        }
    }
}

impl fmt::Display for NonlinearModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for NonlinearModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let found = Self::ALL.into_iter().find(|model| model.name() == text);
        found.ok_or_else(|| FitError::UnknownNonlinearModel { name: text.to_owned() })
    }
}
