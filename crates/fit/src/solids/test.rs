//! Tests of a material: tables of stretches and stresses.

use nalgebra::Matrix3;
use piola_numerics::{Dual, Real};
use piola_specimens::homogeneous::{Incompressible, Mode, first_piola};

use crate::FitError;

/// det F of a measured deformation may differ from 1 by this much.
const ISOCHORIC: f64 = 1e-6;

/// Which stress a table holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Measure {
    /// Force per area of the reference: the first Piola–Kirchhoff stress.
    #[default]
    #[doc(alias = "nominal")]
    #[cfg_attr(feature = "serde", serde(alias = "nominal"))]
    FirstPiola,
    /// Force per area of the deformed body.
    Cauchy,
}

/// One component of a stress, measured at one deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Component {
    /// F by rows, det F = 1.
    pub deformation: [[f64; 3]; 3],
    /// Row and column of the component: 0, 1 or 2.
    pub component: [usize; 2],
    /// The axis along which the body carries no Cauchy stress, which fixes its pressure.
    pub free: usize,
    /// The component, Pa (or whatever the whole table is in).
    pub stress: f64,
}

/// The numbers of a test.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Table {
    /// (λ, stress) of a bar.
    Uniaxial(Vec<[f64; 2]>),
    /// (λ, stress) of a sheet pulled equally both ways.
    Equibiaxial(Vec<[f64; 2]>),
    /// (λ, stress) of a wide sheet, also called pure shear.
    Planar(Vec<[f64; 2]>),
    /// (k, shear stress) of a block.
    SimpleShear(Vec<[f64; 2]>),
    /// Components at any isochoric deformation, such as those of a sheet pulled unequally both ways.
    General(Vec<Component>),
}

impl Table {
    /// A table of a mode.
    #[must_use]
    pub fn of_mode(mode: Mode, points: Vec<[f64; 2]>) -> Self {
        match mode {
            Mode::Uniaxial => Self::Uniaxial(points),
            Mode::Equibiaxial => Self::Equibiaxial(points),
            Mode::Planar => Self::Planar(points),
            Mode::SimpleShear => Self::SimpleShear(points),
        }
    }

    /// The mode, with its points.
    #[must_use]
    pub fn mode(&self) -> Option<(Mode, &[[f64; 2]])> {
        match self {
            Self::Uniaxial(points) => Some((Mode::Uniaxial, points)),
            Self::Equibiaxial(points) => Some((Mode::Equibiaxial, points)),
            Self::Planar(points) => Some((Mode::Planar, points)),
            Self::SimpleShear(points) => Some((Mode::SimpleShear, points)),
            Self::General(_) => None,
        }
    }
}

/// A test of an incompressible material: a name, a table, what its stresses are, and how much it weighs.
///
/// # Example
/// ```
/// use piola_fit::solids::{Measure, Table, Test};
/// let bar = Test::new("bar", Table::Uniaxial(vec![[1.5, 0.4], [2.0, 0.6]]), Measure::FirstPiola)?;
/// assert_eq!(bar.largest_stress(), 0.6);
/// let wrong = Test::new("bar", Table::Uniaxial(vec![[-1.5, 0.4]]), Measure::FirstPiola);
/// assert_eq!(wrong.unwrap_err().to_string(), "test `bar`, point 0: the stretch -1.5 is not positive and finite");
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Test {
    name: String,
    table: Table,
    measure: Measure,
    weight: f64,
    points: Vec<Measurement>,
}

/// The deformation of one number of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Measurement {
    at: At,
    stress: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum At {
    /// A mode, its stretch, and what makes of the first Piola–Kirchhoff stress the measured one.
    Mode(Mode, f64, f64),
    /// Principal stretches λₐ, and δλₐ such that the measured stress is Σ δλₐ ∂W/∂λₐ.
    General([f64; 3], [f64; 3]),
}

impl Test {
    /// A test of weight 1.
    ///
    /// # Errors
    /// [`FitError::EmptyTest`], [`FitError::StretchNotPositive`], [`FitError::StressNotFinite`],
    /// [`FitError::NotIsochoric`], [`FitError::NoSuchComponent`].
    pub fn new(name: impl Into<String>, table: Table, measure: Measure) -> Result<Self, FitError> {
        let name = name.into();
        let points = match (table.mode(), &table) {
            (Some((mode, points)), _) => points
                .iter()
                .enumerate()
                .map(|(index, &[stretch, stress])| of_mode(&name, index, mode, measure, stretch, stress))
                .collect::<Result<Vec<_>, _>>()?,
            (None, Table::General(points)) => points
                .iter()
                .enumerate()
                .map(|(index, point)| of_component(&name, index, measure, point))
                .collect::<Result<Vec<_>, _>>()?,
            (None, _) => Vec::new(),
        };
        if points.is_empty() {
            return Err(FitError::EmptyTest { test: name });
        }
        Ok(Self { name, table, measure, weight: 1.0, points })
    }

    /// The same test with a weight: its squared residuals count that many times squared.
    ///
    /// # Errors
    /// [`FitError::WeightNotPositive`] unless it is positive and finite.
    pub fn with_weight(self, weight: f64) -> Result<Self, FitError> {
        if 0.0 < weight && weight.is_finite() {
            Ok(Self { weight, ..self })
        } else {
            Err(FitError::WeightNotPositive { test: self.name, value: weight })
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its table.
    #[must_use]
    pub const fn table(&self) -> &Table {
        &self.table
    }

    /// The measure of its stresses.
    #[must_use]
    pub const fn measure(&self) -> Measure {
        self.measure
    }

    /// Its weight.
    #[must_use]
    pub const fn weight(&self) -> f64 {
        self.weight
    }

    /// Numbers in its table.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.points.len()
    }

    /// Never: an empty table is no test.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        false
    }

    /// The largest modulus of its stresses, to which residuals are related; 1 if all are zero.
    #[must_use]
    pub fn largest_stress(&self) -> f64 {
        let largest = self.stresses().map(f64::abs).fold(0.0, f64::max);
        if 0.0 < largest { largest } else { 1.0 }
    }

    /// The measured stresses.
    pub fn stresses(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|point| point.stress)
    }

    /// The abscissa of each point: the stretch, the amount of shear, or the largest principal stretch.
    pub fn abscissas(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|point| match point.at {
            At::Mode(_, stretch, _) => stretch,
            At::General(stretches, _) => stretches.into_iter().fold(0.0, f64::max),
        })
    }

    /// The stretches of each point.
    pub(super) fn principal_stretches(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().map(|point| match point.at {
            At::Mode(mode, stretch, _) => mode.elongations(stretch).map(|x| x + 1.0),
            At::General(stretches, _) => stretches,
        })
    }

    /// Whether nothing is deformed at any point: there every isotropic law has the same stress, none.
    pub(super) fn is_at_rest(&self) -> bool {
        (0..self.points.len()).all(|point| !self.informs(point))
    }

    /// Whether the stress at a point depends on the law: at rest, and across a direction of no change, every isotropic law has none.
    pub(super) fn informs(&self, point: usize) -> bool {
        /// Principal stretches of a rotation are 1 to rounding.
        const ROUNDING: f64 = 16.0 * f64::EPSILON;
        match self.points[point].at {
            At::Mode(mode, stretch, _) => 0.0 < (stretch - mode.rest()).abs(),
            At::General(stretches, along) => {
                stretches.iter().any(|stretch| ROUNDING < (stretch - 1.0).abs()) && along.iter().any(|x| 0.0 < x.abs())
            }
        }
    }

    /// Numbers in its table that depend on the law: those at rest do not.
    #[must_use]
    pub fn informative(&self) -> usize {
        (0..self.points.len()).filter(|&point| self.informs(point)).count()
    }

    /// What a law has less what was measured, at every point. Points at rest have what was measured there, with the other sign.
    #[must_use]
    pub fn residuals(&self, law: &impl Incompressible<f64>) -> Vec<f64> {
        let residual = |(point, stress): (usize, f64)| {
            if self.informs(point) { self.answer::<f64>(point, law) - stress } else { -stress }
        };
        self.stresses().enumerate().map(residual).collect()
    }

    /// The stress of a law at a point.
    pub(super) fn answer<T: Real>(&self, point: usize, law: &impl Incompressible<T>) -> T {
        match self.points[point].at {
            At::Mode(mode, stretch, factor) => T::lit(factor) * first_piola(mode, T::lit(stretch), law),
            At::General(stretches, along) => {
                let varied = core::array::from_fn(|a| Dual::new(T::lit(stretches[a]), T::lit(along[a])));
                law.energy_of_stretches(varied).tangent
            }
        }
    }

    /// The stresses that a law answers at other stretches of the same mode; nothing for a general table.
    #[must_use]
    pub fn curve(&self, stretches: &[f64], law: &impl Incompressible<f64>) -> Option<Vec<f64>> {
        let (mode, _) = self.table.mode()?;
        let answer = |&stretch: &f64| factor(mode, self.measure, stretch) * first_piola(mode, stretch, law);
        Some(stretches.iter().map(answer).collect())
    }
}

/// Measured stress over first Piola–Kirchhoff stress: F₁₁, or 1 in simple shear, where F₁₁ is 1.
pub(super) fn factor(mode: Mode, measure: Measure, stretch: f64) -> f64 {
    match (measure, mode) {
        (Measure::FirstPiola, _) | (_, Mode::SimpleShear) => 1.0,
        (Measure::Cauchy, _) => stretch,
    }
}

fn of_mode(
    test: &str,
    index: usize,
    mode: Mode,
    measure: Measure,
    stretch: f64,
    stress: f64,
) -> Result<Measurement, FitError> {
    let positive = 0.0 < stretch || matches!(mode, Mode::SimpleShear);
    if !(positive && stretch.is_finite()) {
        return Err(FitError::StretchNotPositive { test: test.to_owned(), index, value: stretch });
    }
    let reach = 1e-30..=1e30;
    let size = stretch.abs();
    // An amount of shear may be as small as it likes.
    if !(reach.contains(&size) || mode == Mode::SimpleShear && size <= *reach.end()) {
        return Err(FitError::StretchOutOfRange { test: test.to_owned(), index, value: stretch });
    }
    check_stress(test, index, stress)?;
    Ok(Measurement { at: At::Mode(mode, stretch, factor(mode, measure, stretch)), stress })
}

fn check_stress(test: &str, index: usize, stress: f64) -> Result<(), FitError> {
    if stress.is_finite() {
        Ok(())
    } else {
        Err(FitError::StressNotFinite { test: test.to_owned(), index, value: stress })
    }
}

/// The direction of the principal stretches along which the energy changes by the component.
///
/// ```text
/// T = Σ tₐ nₐ ⊗ nₐ − p 1,   tₐ = λₐ ∂W/∂λₐ,   T_kk = 0:   Tᵢⱼ = Σ tₐ (nₐᵢ nₐⱼ − δᵢⱼ nₐₖ²),   P = T F⁻ᵀ
/// ```
fn of_component(test: &str, index: usize, measure: Measure, point: &Component) -> Result<Measurement, FitError> {
    let Component { deformation, component: [i, j], free, stress } = *point;
    if let Some(place) = [i, j, free].into_iter().find(|place| 2 < *place) {
        return Err(FitError::NoSuchComponent { test: test.to_owned(), index, value: place });
    }
    check_stress(test, index, stress)?;
    let f = Matrix3::from_fn(|i, j| deformation[i][j]);
    let determinant = f.determinant();
    let isochoric = (determinant - 1.0).abs() <= ISOCHORIC;
    let (true, Some(inverse)) = (isochoric, f.try_inverse()) else {
        return Err(FitError::NotIsochoric { test: test.to_owned(), index, determinant });
    };
    let axes = (f * f.transpose()).symmetric_eigen();
    let stretches: [f64; 3] = core::array::from_fn(|a| axes.eigenvalues[a].sqrt());
    let along = core::array::from_fn(|a| {
        let n = axes.eigenvectors.column(a);
        let kronecker = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let cauchy = |j: usize| n[i] * n[j] - kronecker(i, j) * n[free] * n[free];
        let share = match measure {
            Measure::Cauchy => cauchy(j),
            Measure::FirstPiola => (0..3).map(|m| cauchy(m) * inverse[(j, m)]).sum(),
        };
        stretches[a] * share
    });
    Ok(Measurement { at: At::General(stretches, along), stress })
}

/// A test as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    name: String,
    table: Table,
    #[serde(default)]
    measure: Measure,
    #[serde(default = "one")]
    weight: f64,
}

#[cfg(feature = "serde")]
const fn one() -> f64 {
    1.0
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Test {
    type Error = FitError;

    fn try_from(Written { name, table, measure, weight }: Written) -> Result<Self, FitError> {
        Self::new(name, table, measure)?.with_weight(weight)
    }
}

#[cfg(feature = "serde")]
impl From<Test> for Written {
    fn from(Test { name, table, measure, weight, .. }: Test) -> Self {
        Self { name, table, measure, weight }
    }
}

/// The tests that a law is fitted to, all at once.
///
/// # Example
/// See the [crate].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<Test>", into = "Vec<Test>"))]
pub struct Data {
    tests: Vec<Test>,
}

impl Data {
    /// All tests of one material.
    ///
    /// # Errors
    /// [`FitError::NoTests`]; [`FitError::TestTwice`] for two of one name.
    pub fn new(tests: Vec<Test>) -> Result<Self, FitError> {
        if tests.is_empty() {
            return Err(FitError::NoTests);
        }
        for (index, test) in tests.iter().enumerate() {
            if tests[..index].iter().any(|other| other.name == test.name) {
                return Err(FitError::TestTwice { test: test.name.clone() });
            }
        }
        Ok(Self { tests })
    }

    /// The tests.
    #[must_use]
    pub fn tests(&self) -> &[Test] {
        &self.tests
    }

    /// Numbers in all tables.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tests.iter().map(Test::len).sum()
    }

    /// Numbers in all tables that depend on the law.
    #[must_use]
    pub fn informative(&self) -> usize {
        self.tests.iter().map(Test::informative).sum()
    }

    /// Never.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        false
    }

    /// The same tests with no more than about so many numbers each, evenly chosen.
    pub(super) fn thinned(&self, most: usize) -> Self {
        let thinned = |test: &Test| {
            let stride = test.len().div_ceil(most.max(1)).max(1);
            let points = test.points.iter().rev().step_by(stride).rev().copied().collect();
            // The table is not looked at by a search.
            Test {
                name: test.name.clone(),
                table: Table::General(Vec::new()),
                measure: test.measure,
                weight: test.weight,
                points,
            }
        };
        Self { tests: self.tests.iter().map(thinned).collect() }
    }

    /// The largest I₁ = λ₁² + λ₂² + λ₃² at which something was measured.
    #[must_use]
    pub fn largest_first_invariant(&self) -> f64 {
        let first = |stretches: [f64; 3]| stretches.into_iter().map(|x| x * x).sum::<f64>();
        self.tests.iter().flat_map(Test::principal_stretches).map(first).fold(3.0, f64::max)
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<Test>> for Data {
    type Error = FitError;

    fn try_from(tests: Vec<Test>) -> Result<Self, FitError> {
        Self::new(tests)
    }
}

#[cfg(feature = "serde")]
impl From<Data> for Vec<Test> {
    fn from(data: Data) -> Self {
        data.tests
    }
}
