//! A point of a body with its state, which is led along a path of deformation.

use core::marker::PhantomData;

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, DisplacementGradient, FirstPiola};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_solids::{Response, SolidsError};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::Rows;

use crate::error::{check_bound, check_finite};
use crate::newton::{IncrementScalar, Varied, between, stress, values, values_of_rows};
use crate::path::{Effort, Increment, Reached, StepControl};
use crate::{Evolution, InelasticError};

/// State, stress and consistent tangent at the end of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advanced<const S: usize> {
    /// The internal variables.
    pub state: [f64; S],
    /// P, Pa.
    pub first_piola: FirstPiola,
    /// dP/dF, Pa: the derivative of P by F at the end of the increment through all its steps, the start held.
    pub tangent: FirstPiolaTangent,
    /// Steps, iterations and the estimated error.
    pub effort: Effort,
}

/// A point of a body: its law, its internal variables and its deformation.
///
/// Between two given deformations F changes in proportion to time.
///
/// # Example
/// A viscoelastic bar is stretched at once and held: its stress falls to that of the law at rest.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{StepControl, InelasticPoint, ReeseGovindjee};
/// use piola_solids::{Hyperelastic, NeoHookeanCiarlet};
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = ReeseGovindjee::new(spring, spring, 0.5)?; // η = 0.5 Pa s
/// let mut point = InelasticPoint::new(&law);
/// let shear = DeformationGradient::simple_shear(0.3)?;
/// let control = StepControl::new(1e-6)?;
/// let first = point.advance(&shear, 1e-6, &control)?.first_piola.0[(0, 1)];
/// let last = point.advance(&shear, 5.0, &control)?.first_piola.0[(0, 1)];
/// assert!((first - 0.6).abs() < 1e-5); // 2 μ k
/// assert!((last - 0.3).abs() < 1e-4); // μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct InelasticPoint<'a, L, const S: usize, const X: usize> {
    law: &'a L,
    state: [f64; S],
    gradient: Rows<f64>,
    unknowns: PhantomData<[(); X]>,
}

impl<'a, L: Evolution<S, X>, const S: usize, const X: usize> InelasticPoint<'a, L, S, X> {
    /// Of the body as it was made, undeformed.
    #[must_use]
    pub fn new(law: &'a L) -> Self {
        let gradient = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self { law, state: law.initial(), gradient, unknowns: PhantomData }
    }

    /// With a state and a deformation.
    ///
    /// # Errors
    /// [`InelasticError::WrongLength`], [`InelasticError::NotFinite`] of the state.
    pub fn with_state(law: &'a L, state: &[f64], deformation: &DeformationGradient) -> Result<Self, InelasticError> {
        let found = state.len();
        let Ok(state) = <[f64; S]>::try_from(state) else {
            return Err(InelasticError::WrongLength { quantity: "state", expected: S, found });
        };
        check_finite("state", &state)?;
        Ok(Self { law, state, gradient: rows_of(deformation.matrix()), unknowns: PhantomData })
    }

    /// The internal variables.
    #[must_use]
    pub const fn state(&self) -> &[f64; S] {
        &self.state
    }

    /// F.
    #[must_use]
    pub fn deformation(&self) -> DeformationGradient {
        DeformationGradient::trusted(self.gradient)
    }

    /// Leads the point to a deformation in the time `dt`, s.
    ///
    /// # Errors
    /// [`InelasticError::NotConverged`], [`InelasticError::NotAccurate`]: the point then stands at the last admissible state, and the error
    /// says where that is. [`InelasticError::OutOfBounds`] for a negative time, [`InelasticError::Solids`] where an elastic law refuses:
    /// the point stays where it was.
    pub fn advance(
        &mut self,
        to: &DeformationGradient,
        dt: f64,
        control: &StepControl,
    ) -> Result<Advanced<S>, InelasticError> {
        let end = rows_of(to.matrix());
        let (reached, result) = self.run(&end, dt, control)?;
        self.stand_at(&reached, &end, dt, control);
        result.map(|(stress, effort)| advanced(&reached, &stress, effort))
    }

    /// Leads the point to a deformation in the time `dt`, s, as [`advance`](Self::advance) does, but returns P, Pa, and the effort
    /// alone. It computes no derivatives of the state or of the stress.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    ///
    /// # Accuracy
    /// P and the state differ from those of [`advance`](Self::advance) by rounding.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_inelastic::{InelasticPoint, ReeseGovindjee, StepControl};
    /// use piola_solids::NeoHookeanCiarlet;
    /// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
    /// let law = ReeseGovindjee::new(spring, spring, 0.5)?;
    /// let mut point = InelasticPoint::new(&law);
    /// let shear = DeformationGradient::simple_shear(0.3)?;
    /// let (stress, effort) = point.advance_stress(&shear, 1e-6, &StepControl::one_step())?;
    /// assert!((stress.0[(0, 1)] - 0.6).abs() < 1e-5 && effort.steps == 1); // 2 μ k
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn advance_stress(
        &mut self,
        to: &DeformationGradient,
        dt: f64,
        control: &StepControl,
    ) -> Result<(FirstPiola, Effort), InelasticError> {
        let end = rows_of(to.matrix());
        let (reached, result) = self.run::<f64>(&end, dt, control)?;
        self.stand_at(&reached, &end, dt, control);
        result.map(|(stress, effort)| (FirstPiola(from_rows(stress)), effort))
    }

    /// What [`advance`](Self::advance) would return, the point staying where it is.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    pub fn trial(
        &self,
        to: &DeformationGradient,
        dt: f64,
        control: &StepControl,
    ) -> Result<Advanced<S>, InelasticError> {
        let (reached, result) = self.run(&rows_of(to.matrix()), dt, control)?;
        result.map(|(stress, effort)| advanced(&reached, &stress, effort))
    }

    /// Stress and consistent tangent as functions of the deformation at the end of an increment, as
    /// `piola_specimens::homogeneous::equilibrium` asks for them.
    #[must_use]
    pub const fn next(&self, dt: f64, control: StepControl) -> NextIncrement<'_, L, S, X> {
        NextIncrement { point: self, dt, control }
    }

    fn increment(&self, end: &Rows<f64>, dt: f64, control: &StepControl) -> Increment<'_, L, S> {
        Increment { law: self.law, start: self.gradient, end: *end, dt, control: *control }
    }

    /// Takes the place to which an increment has come.
    fn stand_at<T: IncrementScalar>(
        &mut self,
        reached: &Reached<T, S>,
        end: &Rows<f64>,
        dt: f64,
        control: &StepControl,
    ) {
        self.state = values(&reached.state);
        self.gradient = self.increment(end, dt, control).gradient(reached.share);
    }

    /// Returns the share and the state that the increment has reached. With them it returns the stress there and the effort, or the error that
    /// ended the increment early.
    #[expect(clippy::type_complexity, reason = "where it stands also after a failure")]
    fn run<T: IncrementScalar>(
        &self,
        end: &Rows<f64>,
        dt: f64,
        control: &StepControl,
    ) -> Result<(Reached<T, S>, Result<(Rows<T>, Effort), InelasticError>), InelasticError> {
        check_bound("increment", "dt", dt, "0 ≤ dt", 0.0 <= dt)?;
        let increment = self.increment(end, dt, control);
        let (reached, effort, failure) = increment.run::<T, X>(&self.state);
        if let Some(failure) = failure {
            let error = failure.at(reached.share, increment.gradient(reached.share));
            return Ok((reached, Err(error)));
        }
        self.law.check(end, &values(&reached.state))?;
        let stress = stress(self.law, &between(&self.gradient, end, 1.0), &reached.state);
        check_finite("P", values_of_rows(&stress).as_flattened())?;
        Ok((reached, Ok((stress, effort))))
    }
}

/// State, stress and tangent of numbers with derivatives.
fn advanced<const S: usize>(reached: &Reached<Varied, S>, stress: &Rows<Varied>, effort: Effort) -> Advanced<S> {
    let mut components = [[0.0; 9]; 9];
    for (row, entry) in components.iter_mut().zip(stress.as_flattened()) {
        *row = entry.partials;
    }
    let tangent = FirstPiolaTangent(FourthOrder { components });
    Advanced {
        state: values(&reached.state),
        first_piola: FirstPiola(from_rows(values_of_rows(stress))),
        tangent,
        effort,
    }
}

/// The next increment of a point as a function of its end: [`InelasticPoint::next`].
///
/// # Example
/// See [`InelasticPoint`]; here its use as a [`Response`].
/// ```
/// use piola_continuum::DisplacementGradient;
/// use piola_inelastic::{StepControl, InelasticPoint, ReeseGovindjee};
/// use piola_solids::{NeoHookeanCiarlet, Response};
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = ReeseGovindjee::new(spring, spring, 0.5)?;
/// let point = InelasticPoint::new(&law);
/// let next = point.next(1e-9, StepControl::default());
/// let stress = next.stress(&DisplacementGradient::simple_shear(0.25)?).0[(0, 1)];
/// assert!((stress - 0.5).abs() < 1e-8); // 2 μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct NextIncrement<'a, L, const S: usize, const X: usize> {
    point: &'a InelasticPoint<'a, L, S, X>,
    dt: f64,
    control: StepControl,
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> NextIncrement<'_, L, S, X> {
    fn at(&self, deformation: &DisplacementGradient) -> Result<Advanced<S>, InelasticError> {
        let to = DeformationGradient::trusted(piola_continuum::Deformation::gradient_rows(deformation));
        self.point.trial(&to, self.dt, &self.control)
    }
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> Response for NextIncrement<'_, L, S, X> {
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), SolidsError> {
        match self.at(deformation) {
            Ok(_) => Ok(()),
            Err(InelasticError::Solids(error)) => Err(error),
            Err(InelasticError::NotConverged { residual: value, .. }) => Err(SolidsError::BeyondLimit {
                law: "law with internal variables",
                quantity: "residual of the update",
                value,
                limit: 0.0,
            }),
            Err(InelasticError::NotAccurate { error: value, tolerance: limit, .. }) => Err(SolidsError::BeyondLimit {
                law: "law with internal variables",
                quantity: "estimated error of the update",
                value,
                limit,
            }),
            Err(_) => Err(SolidsError::Overflow { answer: "first_piola" }),
        }
    }

    /// NaN where the deformation is not [admitted](Response::admits).
    fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
        self.at(deformation).map_or_else(
            |_| {
                let nan = FourthOrder { components: [[f64::NAN; 9]; 9] };
                (FirstPiola(Matrix3::repeat(f64::NAN)), FirstPiolaTangent(nan))
            },
            |advanced| (advanced.first_piola, advanced.tangent),
        )
    }
}
