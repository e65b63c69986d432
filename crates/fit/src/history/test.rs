//! Tests of laws with history: tables of time, stretch and stress.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_inelastic::{Advanced, Evolution, InelasticError, InelasticPoint, StepControl};

use crate::FitError;
use crate::sides::Loading;

/// A table of one test: time, stretch and stress of each row, in their order.
///
/// The body is undeformed and as it was made at time zero. Between two rows the deformation changes in proportion to time, so the rows
/// must follow the motion. Rows of the same time are a jump.
///
/// | loading | stretch | stress | sides |
/// |---|---|---|---|
/// | `Uniaxial` | λ₁ | P₁₁ | λ₂ = λ₃ free |
/// | `Equibiaxial` | λ₁ = λ₂ | P₁₁ | λ₃ free |
/// | `Planar` | λ₁, λ₂ = 1 | P₁₁ | λ₃ free |
/// | `SimpleShear` | amount k = F₂₁ | P₂₁ = T₁₂ | – |
///
/// # Example
/// A block is sheared within 0.1 s and held.
/// ```
/// use piola_fit::history::HistoryTest;
/// use piola_fit::sides::Loading;
/// let held = HistoryTest::new("hold", Loading::SimpleShear, &[[0.1, 0.5, 3.0], [1.0, 0.5, 2.0], [10.0, 0.5, 1.0]])?;
/// assert_eq!((held.name(), held.rows().len(), held.largest_stress()), ("hold", 3, 3.0));
/// assert!(HistoryTest::new("hold", Loading::SimpleShear, &[[1.0, 0.5, 3.0], [0.5, 0.5, 2.0]]).is_err());
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HistoryTest {
    name: String,
    loading: Loading,
    rows: Vec<[f64; 3]>,
}

impl HistoryTest {
    /// Of rows of t, s; stretch; stress, Pa.
    ///
    /// # Errors
    /// [`FitError::EmptyTest`]; [`FitError::NoHistoryLoading`] for a loading that is not in the table above;
    /// [`FitError::TimeOutOfOrder`] unless 0 ≤ t and no time is before that of the row above; [`FitError::StretchNotPositive`],
    /// [`FitError::StressNotFinite`].
    pub fn new(name: impl Into<String>, loading: Loading, rows: &[[f64; 3]]) -> Result<Self, FitError> {
        let test = name.into();
        if rows.is_empty() {
            return Err(FitError::EmptyTest { test });
        }
        if matches!(loading, Loading::Transverse | Loading::Volumetric) {
            return Err(FitError::NoHistoryLoading { test, loading: loading.name() });
        }
        let mut before = 0.0;
        for (index, &[t, stretch, stress]) in rows.iter().enumerate() {
            if !(before <= t && t.is_finite()) {
                return Err(FitError::TimeOutOfOrder { test, index, value: t, before });
            }
            before = t;
            let is_shear = loading == Loading::SimpleShear;
            if !stretch.is_finite() || (!is_shear && stretch <= 0.0) {
                return Err(FitError::StretchNotPositive { test, index, value: stretch });
            }
            if !stress.is_finite() {
                return Err(FitError::StressNotFinite { test, index, value: stress });
            }
        }
        Ok(Self { name: test, loading, rows: rows.to_vec() })
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its loading.
    #[must_use]
    pub const fn loading(&self) -> Loading {
        self.loading
    }

    /// Its rows: time, stretch, stress.
    #[must_use]
    pub fn rows(&self) -> &[[f64; 3]] {
        &self.rows
    }

    /// The largest modulus of its stresses, to which residuals are related; 1 if all are zero.
    #[must_use]
    pub fn largest_stress(&self) -> f64 {
        let largest = self.rows.iter().map(|row| row[2].abs()).fold(0.0, f64::max);
        if 0.0 < largest { largest } else { 1.0 }
    }
}

/// Stresses of a law along the rows of a test.
///
/// `control` tells how accurately each increment between two rows is integrated. Free sides are found by Newton's method with the
/// consistent tangent.
///
/// # Errors
/// [`FitError::NoHistory`] of the first row at which the law has no answer; [`FitError::SidesNotFound`].
///
/// # Example
/// Hooke's law in the logarithms, with a yield stress that is out of reach: T₁₂ of a small shear is μ k.
/// ```
/// use piola_fit::history::{HistoryTest, follow};
/// use piola_fit::sides::Loading;
/// use piola_inelastic::{Hardening, StepControl, Viscoplastic};
/// use piola_solids::Hencky;
/// let hardening = Hardening { yield_stress: 1.0, linear: 0.0, saturation: 1.0, saturation_exponent: 0.0 };
/// let law = Viscoplastic::new(Hencky::new(1.0, 2.0)?, hardening, 0.0)?;
/// let test = HistoryTest::new("shear", Loading::SimpleShear, &[[1.0, 1e-6, 0.0]])?;
/// let stress = follow(&law, &test, &StepControl::one_step())?[0];
/// assert!((stress - 2e-6).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn follow<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    test: &HistoryTest,
    control: &StepControl,
) -> Result<Vec<f64>, FitError> {
    let mut point = InelasticPoint::new(law);
    let (mut t, mut side) = (0.0, 1.0);
    let mut stresses = Vec::with_capacity(test.rows.len());
    for (index, &[time, stretch, _]) in test.rows.iter().enumerate() {
        let failed =
            |error: InelasticError| FitError::NoHistory { test: test.name.clone(), index, error: Box::new(error) };
        let at = |to: &DeformationGradient| point.trial(to, time - t, control);
        let found = match test.loading {
            Loading::SimpleShear => {
                let to = DeformationGradient::simple_shear(stretch).map_err(|error| failed(error.into()))?;
                Some((to, at(&to).map_err(failed)?))
            }
            loading => sides(loading, stretch, &mut side, at).map_err(failed)?,
        };
        let Some((to, advanced)) = found else {
            return Err(FitError::SidesNotFound { test: test.name.clone(), index });
        };
        let place = if test.loading == Loading::SimpleShear { (1, 0) } else { (0, 0) };
        stresses.push(advanced.first_piola.0[place]);
        point = InelasticPoint::with_state(law, &advanced.state, &to).map_err(failed)?;
        t = time;
    }
    Ok(stresses)
}

/// The deformation whose free sides carry no stress, from a first guess of their stretch; none where Newton's method finds none.
fn sides<const S: usize>(
    loading: Loading,
    stretch: f64,
    side: &mut f64,
    at: impl Fn(&DeformationGradient) -> Result<Advanced<S>, InelasticError>,
) -> Result<Option<(DeformationGradient, Advanced<S>)>, InelasticError> {
    /// The longest step of the logarithm of the stretch.
    const LONGEST: f64 = 0.25;
    /// A step after which one more leaves rounding alone.
    const NEARLY: f64 = 1e-9;
    let mut last = false;
    for _ in 0..60 {
        let stretches = match loading {
            Loading::Uniaxial => [stretch, *side, *side],
            Loading::Equibiaxial => [stretch, stretch, *side],
            _ => [stretch, 1.0, *side],
        };
        let to = DeformationGradient::new(Matrix3::from_diagonal(&stretches.into()))?;
        let advanced = at(&to)?;
        if last {
            return Ok(Some((to, advanced)));
        }
        let tangent = &advanced.tangent;
        let with_second = if loading == Loading::Uniaxial { tangent.entry(2, 2, 1, 1) } else { 0.0 };
        let slope = (tangent.entry(2, 2, 2, 2) + with_second) * *side;
        let step = -advanced.first_piola.0[(2, 2)] / slope;
        if !step.is_finite() {
            return Ok(None);
        }
        *side *= step.clamp(-LONGEST, LONGEST).exp();
        last = step.abs() <= NEARLY;
    }
    Ok(None)
}
