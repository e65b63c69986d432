//! Fits of the fluids with parameters in a row, by their names, compiled once, in this crate.

use core::fmt;
use core::str::FromStr;

use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, Papanastasiou,
    Parameters, PowerLaw, Sisko, ViscometricFluid,
};

use super::{FlowData, FluidFit, Options, fit_flow_until};
use crate::FitError;

/// The fluids: name, type, number of parameters.
macro_rules! models {
    ($($name:literal => $fluid:ident($count:literal)),+ $(,)?) => {
        /// A fluid with unknown parameters, by its name: what [`fit_flow`](super::fit_flow) takes as a type, as a value.
        ///
        /// [`fit_flow`](super::fit_flow) is compiled in the crate that calls it; the fits of this type are compiled in this one.
        ///
        /// # Example
        /// ```
        /// use piola_fit::fluids::{FlowData, FluidModel, Options};
        /// use piola_fluids::{AnyFluid, PowerLaw};
        /// let data = FlowData::flow_curve(&[[1.0, 3.0], [4.0, 6.0], [9.0, 9.0], [100.0, 30.0]])?; // 3 √k
        /// let model: FluidModel = "power-law".parse()?;
        /// let fit = model.fit_until(&[data], &[vec![1.0, 1.0]], &Options::default(), &|| false)?;
        /// let AnyFluid::PowerLaw(fluid) = fit.fluid else { unreachable!() };
        /// assert!((fluid.consistency() - 3.0).abs() < 1e-10 && (fluid.exponent() - 0.5).abs() < 1e-10);
        /// # Ok::<(), piola_fit::FitError>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum FluidModel {
            $(#[doc = concat!("[`", stringify!($fluid), "`], with ", $count, " parameters; `", $name, "`.")] $fluid),+
        }

        impl FluidModel {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$fluid),+];
            /// Their names.
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// Its name, as `carreau-yasuda`.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$fluid => $name),+
                }
            }

            /// The names of its parameters, in order.
            #[must_use]
            pub const fn parameters(self) -> &'static [&'static str] {
                match self {
                    $(Self::$fluid => &<$fluid as Parameters<$count>>::NAMES),+
                }
            }

            /// Fits the fluid to all sets at once from the best of several starts, until `stop` says so.
            ///
            /// # Errors
            /// [`FitError::NumberOfValues`] for a start of another length; as [`fit_flow`](super::fit_flow).
            pub fn fit_until(
                self,
                data: &[FlowData],
                starts: &[Vec<f64>],
                options: &Options,
                stop: &dyn Fn() -> bool,
            ) -> Result<FluidFit<AnyFluid>, FitError> {
                match self {
                    $(Self::$fluid => fitted::<$fluid, $count>(self, data, starts, options, stop)),+
                }
            }
        }
    };
}

models! {
    "newtonian" => Newtonian(1),
    "power-law" => PowerLaw(2),
    "bingham" => Bingham(2),
    "casson" => Casson(2),
    "herschel-bulkley" => HerschelBulkley(3),
    "papanastasiou" => Papanastasiou(4),
    "eyring" => Eyring(2),
    "sisko" => Sisko(3),
    "ellis" => Ellis(3),
    "cross" => Cross(4),
    "carreau-yasuda" => CarreauYasuda(5),
}

impl FluidModel {
    /// The fluids that are compared when none is named: all but those that regularise another one for computations.
    #[must_use]
    pub fn usual() -> Vec<Self> {
        Self::ALL.iter().copied().filter(|fluid| !fluid.is_regularisation()).collect()
    }

    /// Whether it replaces a yield stress by a steep but smooth rise so that computations are easier. It is fitted like any other, and not
    /// ranked among models of materials.
    #[must_use]
    pub const fn is_regularisation(self) -> bool {
        matches!(self, Self::Papanastasiou)
    }
}

fn fitted<F: Parameters<N> + ViscometricFluid + Into<AnyFluid>, const N: usize>(
    model: FluidModel,
    data: &[FlowData],
    starts: &[Vec<f64>],
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<FluidFit<AnyFluid>, FitError> {
    let own = |start: &Vec<f64>| -> Result<[f64; N], FitError> {
        let wrong = |_| FitError::NumberOfValues { model: model.name().to_owned(), parameters: N, values: start.len() };
        start.as_slice().try_into().map_err(wrong)
    };
    let starts: Vec<[f64; N]> = starts.iter().map(own).collect::<Result<_, _>>()?;
    Ok(fit_flow_until::<F, N>(data, &starts, options, stop)?.with_fluid(Into::into))
}

impl fmt::Display for FluidModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for FluidModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let found = Self::ALL.iter().copied().find(|model| model.name() == text);
        found.ok_or_else(|| FitError::UnknownFluid { name: text.to_owned() })
    }
}
