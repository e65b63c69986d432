//! Tests with sides.

use super::SidesModel;
use crate::FitError;

/// How a specimen is loaded along the axes 1, 2 and 3; sides that are not named are free.
///
/// | loading | stretch | stress | lateral stretch |
/// |---|---|---|---|
/// | `Uniaxial` | λ₁ | P₁ | λ₂ |
/// | `Transverse` | λ₂ | P₂ | λ₁ |
/// | `Equibiaxial` | λ₁ = λ₂ | P₁ (foam), the mean of P₁ and P₂ (fibres) | λ₃ |
/// | `Planar`, λ₂ = 1 | λ₁ | P₁ | λ₃ |
/// | `SimpleShear` (foam) | amount k | T₁₂ | – |
/// | `Volumetric` (foam) | det F | pressure | – |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Loading {
    /// Along 1.
    Uniaxial,
    /// Along 2.
    Transverse,
    /// Along 1 and 2.
    Equibiaxial,
    /// Along 1, held along 2.
    Planar,
    /// Shear.
    SimpleShear,
    /// The same along all axes.
    Volumetric,
}

impl Loading {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniaxial => "uniaxial",
            Self::Transverse => "transverse",
            Self::Equibiaxial => "equibiaxial",
            Self::Planar => "planar",
            Self::SimpleShear => "simple shear",
            Self::Volumetric => "volumetric",
        }
    }
}

/// A table of one test: stretch, stress and, where it was measured, the lateral stretch of each row. Stresses are first Piola–Kirchhoff
/// stresses.
///
/// # Example
/// ```
/// use piola_fit::sides::{Loading, SidesTest};
/// let pressed = SidesTest::new("press", Loading::Uniaxial, &[(0.5, -3.0, Some(1.1)), (0.7, -1.0, None)])?;
/// assert_eq!((pressed.name(), pressed.largest_stress()), ("press", 3.0));
/// assert!(SidesTest::new("press", Loading::Uniaxial, &[(-0.5, -3.0, None)]).is_err());
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SidesTest {
    name: String,
    loading: Loading,
    /// Of a strip, from axis 1, radians.
    angle: f64,
    rows: Vec<(f64, f64, Option<f64>)>,
}

/// What is measured at a point.
pub(super) enum Output {
    /// `factor` times ∂W along a direction.
    Stress { direction: [f64; 3], factor: f64 },
    /// The stretch of an axis.
    Lateral { axis: usize },
}

/// A row as the search sees it.
pub(super) struct Point {
    /// Logarithms of the stretches, those of free sides left out.
    pub(super) base: [f64; 3],
    /// The direction in which sides are free.
    pub(super) free: Option<[f64; 3]>,
    /// Where the search for the sides starts.
    pub(super) start: f64,
    /// The angle of a strip that shears, radians: its width and its shear are free instead.
    pub(super) oblique: Option<f64>,
    /// Output, measured value and scale.
    pub(super) outputs: Vec<(Output, f64, f64)>,
}

/// Adds numbers to the residuals of the points of a test over their scales, first those of the stresses; returns the numbers that are left.
pub(super) fn shifted<'s>(points: &mut [Point], mut shift: &'s [f64]) -> &'s [f64] {
    for is_lateral in [false, true] {
        let outputs = points.iter_mut().flat_map(|point| &mut point.outputs);
        for (_, measured, scale) in
            outputs.filter(|(output, ..)| matches!(output, Output::Lateral { .. }) == is_lateral)
        {
            if let [first, others @ ..] = shift {
                *measured -= first * *scale;
                shift = others;
            }
        }
    }
    shift
}

impl SidesTest {
    /// Of a table.
    ///
    /// # Errors
    /// [`FitError::EmptyTest`]; [`FitError::NoLateral`] of shears and volumes; [`FitError::StretchNotPositive`] also for a lateral stretch, [`FitError::StressNotFinite`].
    pub fn new(name: impl Into<String>, loading: Loading, rows: &[(f64, f64, Option<f64>)]) -> Result<Self, FitError> {
        let name = name.into();
        if rows.is_empty() {
            return Err(FitError::EmptyTest { test: name });
        }
        let has_sides = !matches!(loading, Loading::SimpleShear | Loading::Volumetric);
        if !has_sides && rows.iter().any(|row| row.2.is_some()) {
            return Err(FitError::NoLateral { test: name, loading: loading.name() });
        }
        for (index, &(stretch, stress, lateral)) in rows.iter().enumerate() {
            let positive = |x: f64| 0.0 < x && x.is_finite();
            let sheared = loading == Loading::SimpleShear && stretch.is_finite();
            for value in [Some(stretch).filter(|_| !sheared), lateral].into_iter().flatten() {
                if !positive(value) {
                    return Err(FitError::StretchNotPositive { test: name, index, value });
                }
            }
            if !stress.is_finite() {
                return Err(FitError::StressNotFinite { test: name, index, value: stress });
            }
        }
        Ok(Self { name, loading, angle: 0.0, rows: rows.to_vec() })
    }

    /// A test of a strip cut at `angle`, radians, from axis 1 in the plane 1–2 and pulled along its length. Rows: stretch, stress, lateral
    /// stretch. The ends must be free to shear, because a strip with oblique fibres shears when pulled.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`FitError::AngleNotFinite`].
    ///
    /// # Example
    /// ```
    /// use piola_fit::sides::SidesTest;
    /// let strip = SidesTest::strip("45°", core::f64::consts::FRAC_PI_4, &[(1.1, 0.3, None)])?;
    /// assert_eq!(strip.angle(), core::f64::consts::FRAC_PI_4);
    /// # Ok::<(), piola_fit::FitError>(())
    /// ```
    pub fn strip(name: impl Into<String>, angle: f64, rows: &[(f64, f64, Option<f64>)]) -> Result<Self, FitError> {
        let test = Self::new(name, Loading::Uniaxial, rows)?;
        if !angle.is_finite() {
            return Err(FitError::AngleNotFinite { test: test.name, value: angle });
        }
        Ok(Self { angle, ..test })
    }

    /// The angle of a strip from axis 1, radians; zero of other tests.
    #[must_use]
    pub const fn angle(&self) -> f64 {
        self.angle
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

    /// Its rows.
    #[must_use]
    pub fn rows(&self) -> &[(f64, f64, Option<f64>)] {
        &self.rows
    }

    /// The largest modulus of its stresses, to which residuals are related; 1 if all are zero.
    #[must_use]
    pub fn largest_stress(&self) -> f64 {
        let largest = self.rows.iter().map(|row| row.1.abs()).fold(0.0, f64::max);
        if 0.0 < largest { largest } else { 1.0 }
    }

    /// Its rows for a model, those at rest left out: there every law has the same answers.
    pub(super) fn points(&self, model: SidesModel) -> Result<Vec<Point>, FitError> {
        let keeps = model.keeps_volume();
        let no_answer = || FitError::NoSuchLoading { model: model.to_string(), loading: self.loading.name() };
        if keeps && matches!(self.loading, Loading::SimpleShear | Loading::Volumetric) {
            return Err(no_answer());
        }
        let stress_scale = self.largest_stress();
        let side = self.rows.iter().filter_map(|row| row.2).map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        let side_scale = if 0.0 < side { side } else { 1.0 };
        let rest = if self.loading == Loading::SimpleShear { 0.0 } else { 1.0 };
        let told = self.rows.iter().filter(|row| 0.0 < (row.0 - rest).abs());
        Ok(told
            .map(|&(stretch, stress, lateral)| {
                let x = stretch.ln();
                let across = if keeps { -1.0 } else { 0.0 };
                let uniaxial = if keeps { [0.0, 1.0, -1.0] } else { [0.0, 1.0, 1.0] };
                let transverse = if keeps { [1.0, 0.0, -1.0] } else { [1.0, 0.0, 1.0] };
                let third = (!keeps).then_some([0.0, 0.0, 1.0]);
                let (base, free, direction, factor, axis) = match self.loading {
                    Loading::Uniaxial => ([x, 0.0, across * x], Some(uniaxial), [1.0, 0.0, across], stretch.recip(), 1),
                    Loading::Transverse => {
                        ([0.0, x, across * x], Some(transverse), [0.0, 1.0, across], stretch.recip(), 0)
                    }
                    Loading::Equibiaxial => {
                        ([x, x, 2.0 * across * x], third, [1.0, 1.0, 2.0 * across], 0.5 / stretch, 2)
                    }
                    Loading::Planar => ([x, 0.0, across * x], third, [1.0, 0.0, across], stretch.recip(), 2),
                    Loading::SimpleShear => {
                        // k = 2 sinh s of the logarithmic stretches ±s.
                        let s = (0.5 * stretch).asinh();
                        ([s, -s, 0.0], None, [1.0, -1.0, 0.0], 0.5 / s.cosh(), 2)
                    }
                    Loading::Volumetric => {
                        let third = 1.0 / 3.0;
                        ([third * x; 3], None, [third; 3], -stretch.recip(), 2)
                    }
                };
                let mut outputs = vec![(Output::Stress { direction, factor }, stress, stress_scale)];
                if let Some(measured) = lateral {
                    outputs.push((Output::Lateral { axis }, measured, side_scale));
                }
                // A foam has no directions.
                let oblique = (keeps && 0.0 < self.angle.abs()).then_some(self.angle);
                Point { base, free, start: if keeps { -0.5 * x } else { 0.0 }, oblique, outputs }
            })
            .collect())
    }
}
