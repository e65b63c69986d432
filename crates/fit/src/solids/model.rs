//! Models to fit: energies of the principal stretches with parameters.

use piola_numerics::{Dual, Real};
use piola_specimens::homogeneous::Incompressible;

use crate::FitError;

/// How a parameter enters the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Role {
    /// As a factor: W = Σ cₖ Wₖ. Such parameters are eliminated by linear least squares, and need no start.
    Linear,
    /// In any other way.
    Nonlinear,
}

/// A condition on one parameter under which its term is stable by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum StableSign {
    /// None is known.
    Any,
    /// 0 ≤ θ.
    NotNegative,
    /// 0 ≤ θ θⱼ with the parameter number j, which is not linear.
    SameAs(usize),
}

/// A parameter of a model.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Parameter {
    /// Its name, such as `mu1`.
    pub name: String,
    /// Whether its unit is that of the stresses; it is a pure number otherwise.
    pub is_stress: bool,
    /// How it enters.
    pub role: Role,
    /// The least and the greatest value; infinite where there is none.
    pub bounds: [f64; 2],
    /// When its term is stable.
    pub stable: StableSign,
}

impl Parameter {
    /// A factor of any sign, in the unit of the stresses.
    #[must_use]
    pub fn factor(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            is_stress: true,
            role: Role::Linear,
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
            stable: StableSign::Any,
        }
    }

    /// A pure number that is no factor, between bounds.
    #[must_use]
    pub fn number(name: impl Into<String>, bounds: [f64; 2]) -> Self {
        Self { name: name.into(), is_stress: false, role: Role::Nonlinear, bounds, stable: StableSign::Any }
    }

    /// With a condition of stability.
    #[must_use]
    pub fn stable_if(self, stable: StableSign) -> Self {
        Self { stable, ..self }
    }

    /// With bounds.
    #[must_use]
    pub fn between(self, bounds: [f64; 2]) -> Self {
        Self { bounds, ..self }
    }
}

/// The energy of an incompressible isotropic solid as a function of stretches and parameters.
///
/// One function over any scalar: derivatives with respect to stretches (stresses) and parameters (what the fit needs) are
/// exact. A model of your own has the rights of those in [`AnyModel`](super::AnyModel).
///
/// # Example
/// Varga's law W = 2 μ (λ₁ + λ₂ + λ₃ − 3), fitted to a point.
/// ```
/// use piola_fit::solids::{Data, Measure, Model, Options, Parameter, Table, Test, fit};
/// use piola_numerics::Real;
///
/// struct Varga;
///
/// impl Model for Varga {
///     fn name(&self) -> String {
///         "varga".into()
///     }
///     fn parameters(&self, _largest_first_invariant: f64) -> Vec<Parameter> {
///         vec![Parameter::factor("mu")]
///     }
///     fn energy<T: Real>(&self, stretches: [T; 3], parameters: &[T]) -> T {
///         T::lit(2.0) * parameters[0] * (stretches[0] + stretches[1] + stretches[2])
///     }
/// }
///
/// // P = 2 μ (1 − λ^(−3/2)): 7/4 μ at λ = 4, 26/27·2 μ at λ = 9.
/// let bar = Table::Uniaxial(vec![[4.0, 3.5], [9.0, 4.0 * 26.0 / 27.0]]);
/// let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola)?])?;
/// let fitted = fit(&Varga, &data, &Options::default())?;
/// assert!((fitted.parameters[0].value - 2.0).abs() < 1e-14);
/// # Ok::<(), piola_fit::FitError>(())
/// ```
pub trait Model {
    /// Its name, such as `ogden:3`.
    #[must_use]
    fn name(&self) -> String;

    /// Its parameters, for data with I₁ up to `largest_first_invariant`: limits of extensibility lie beyond.
    #[must_use]
    fn parameters(&self, largest_first_invariant: f64) -> Vec<Parameter>;

    /// W, up to a constant; the product of the stretches is 1.
    ///
    /// If parameters are linear, W is homogeneous of degree 1 in them all together.
    #[must_use]
    fn energy<T: Real>(&self, stretches: [T; 3], parameters: &[T]) -> T;

    /// Points from which to search: values of the parameters that are not linear, in their order.
    #[must_use]
    fn starts(&self, _largest_first_invariant: f64) -> Vec<Vec<f64>> {
        vec![vec![]]
    }

    /// Puts parameters that mean the same into one order, as terms of a sum.
    fn order(&self, _parameters: &mut [f64]) {}

    /// Laws that this one contains, each with the place of this law's parameters in it: a fit is never worse than that of these.
    #[must_use]
    fn contained(&self) -> Vec<(Self, Vec<Embedding>)>
    where
        Self: Sized,
    {
        Vec::new()
    }
}

/// A parameter of a law in terms of those of a law that it contains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Embedding {
    /// The contained law's parameter of this number, times a factor.
    Parameter(usize, f64),
    /// A constant.
    Constant(f64),
}

impl Embedding {
    /// The parameters of the larger law.
    pub(super) fn embed(places: &[Self], contained: &[f64]) -> Vec<f64> {
        let value = |place: &Self| match *place {
            Self::Parameter(index, factor) => factor * contained.get(index).copied().unwrap_or(0.0),
            Self::Constant(value) => value,
        };
        places.iter().map(value).collect()
    }
}

/// A model with its parameters, as a law for homogeneous tests.
#[derive(Clone, Debug)]
pub struct Fitted<'m, M, T> {
    model: &'m M,
    parameters: Vec<Dual<T>>,
}

impl<'m, M: Model, T: Real> Fitted<'m, M, T> {
    /// With parameters of any scalar, so that derivatives with respect to them come along.
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`] unless there is a value for each parameter.
    pub fn new(model: &'m M, parameters: impl IntoIterator<Item = T>) -> Result<Self, FitError> {
        let fitted = Self::trusted(model, parameters);
        // The number of parameters is the same for any data; 3 is the invariant of the reference.
        let (expected, values) = (model.parameters(3.0).len(), fitted.parameters.len());
        if values == expected {
            Ok(fitted)
        } else {
            Err(FitError::NumberOfValues { model: model.name(), parameters: expected, values })
        }
    }

    /// With as many parameters as the model has.
    pub(super) fn trusted(model: &'m M, parameters: impl IntoIterator<Item = T>) -> Self {
        Self { model, parameters: parameters.into_iter().map(Dual::constant).collect() }
    }
}

impl<M: Model, T: Real> Incompressible<T> for Fitted<'_, M, T> {
    fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T> {
        self.model.energy(stretches, &self.parameters)
    }
}
