//! A specimen along a path of loads or stretches.

use core::iter::once;

use piola_continuum::{Deformation as _, DisplacementGradient};
use piola_document::units::Dimension;
use piola_laws::rubber::AnyRubber;
use piola_solids::isochoric::Isochoric;
use piola_solids::{AnySolid, Hyperelastic as _};
use piola_solutions::loads::{Ends, Torsion, Tube};
use piola_specimens::homogeneous::{HomogeneousState, equilibrium};

use crate::ForwardError;
use crate::controls::{Prescribed, Test, controls, range};
use crate::quantity::value;

/// The least and the greatest number of points of a path.
const POINTS: core::ops::RangeInclusive<u32> = 2..=100_000;
/// Radians per metre.
const TWIST: Dimension = Dimension { length: -1, angle: 1, ..Dimension::NONE };

/// A test of a solid, its path and its conditions.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SpecimenRequest {
    /// `uniaxial`, `equibiaxial`, `biaxial`, `planar`, `simple-shear`, `volumetric`, `mixed` or `torsion`.
    pub test: String,
    /// The solid.
    pub solid: AnyRubber,
    /// The path: a quantity with its first and last value, as `("stretch", "1..3")`.
    pub path: (String, String),
    /// Other prescribed quantities with their values, as `("P22", "10 kPa")`.
    pub held: Vec<(String, String)>,
    /// Sizes of a twisted rod, as `("radius", "5 mm")`.
    pub sizes: Vec<(String, String)>,
    /// The number of points of the path.
    pub points: u32,
}

impl SpecimenRequest {
    /// A request of 101 points.
    #[must_use]
    pub fn new(test: &str, solid: AnyRubber, path: (&str, &str), held: &[(&str, &str)]) -> Self {
        let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        let held = held.iter().map(owned).collect();
        Self { test: test.to_owned(), solid, path: owned(&path), held, sizes: Vec::new(), points: 101 }
    }

    /// With a size.
    #[must_use]
    pub fn with_size(mut self, name: &str, value: &str) -> Self {
        self.sizes.push((name.to_owned(), value.to_owned()));
        self
    }
}

/// A specimen along its path: one row for each point.
///
/// # Example
/// See [`specimen`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LoadedSpecimen {
    /// The test.
    pub test: String,
    /// The solid.
    pub solid: AnyRubber,
    /// Names and SI units of the columns; the first is what is changed.
    pub columns: Vec<(String, &'static str)>,
    /// The values.
    pub rows: Vec<Vec<f64>>,
    /// Where the path ended early: the value at which there is no state, and why.
    pub ended: Option<(f64, String)>,
    pub(crate) shown: &'static [&'static str],
}

impl LoadedSpecimen {
    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|(other, _)| other == name)?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }
}

/// Loads a specimen along a path, each state from the one before.
///
/// Columns of homogeneous tests are the components of F, P and T, det F, the energy in the reference volume, and of solids that
/// keep their volume the pressure that keeps it. Columns of torsion are torque, axial force and axial stretch.
///
/// # Errors
/// [`ForwardError::Argument`] for tests, names, values and units that do not go together, [`ForwardError::MissingSize`];
/// [`ForwardError::Specimens`] and [`ForwardError::Solutions`] when there is no state at the first point. Where there is none at a
/// later point, the path [ended](LoadedSpecimen::ended) there.
///
/// # Example
/// ```
/// use piola_forward::{SpecimenRequest, solid, specimen};
/// // P = μ (λ − λ⁻²) of a bar.
/// let rubber = solid("neo-hookean:mu=1 MPa", None)?;
/// let bar = specimen(&SpecimenRequest::new("uniaxial", rubber, ("stretch", "1..2"), &[]))?;
/// let stress = bar.column("P11").expect("there");
/// assert!((stress[100] - 1.75e6).abs() < 1e-6);
/// # Ok::<(), piola_forward::ForwardError>(())
/// ```
pub fn specimen(request: &SpecimenRequest) -> Result<LoadedSpecimen, ForwardError> {
    if !POINTS.contains(&request.points) {
        let argument = format!("{} points", request.points);
        return Err(ForwardError::Argument { argument, valid: "from 2 to 100000 points" });
    }
    if request.test == "torsion" {
        return torsion(request);
    }
    if let Some((name, size)) = request.sizes.first() {
        return Err(ForwardError::Argument { argument: format!("{name} = {size}"), valid: "sizes for torsion only" });
    }
    let test = Test::named(&request.test).ok_or_else(|| ForwardError::Argument {
        argument: request.test.clone(),
        valid: "uniaxial, equibiaxial, biaxial, planar, simple-shear, volumetric, mixed or torsion",
    })?;
    let named = |(name, text): &(String, String)| {
        let refused = || ForwardError::Argument { argument: format!("{name}={text}"), valid: test.names() };
        test.prescribed(name).ok_or_else(refused)
    };
    let path = named(&request.path)?;
    let ends = path.range(&request.path.1)?;
    let mut held: Vec<(Prescribed, f64)> = Vec::new();
    for condition in &request.held {
        let prescribed = named(condition)?;
        if once(&path).chain(held.iter().map(|(other, _)| other)).any(|other| other.meets(&prescribed)) {
            let argument = format!("{}={}", condition.0, condition.1);
            return Err(ForwardError::Argument { argument, valid: "each component once" });
        }
        let value = prescribed.value(&condition.1)?;
        held.push((prescribed, value));
    }
    let keeps_volume = request.solid.is_incompressible();
    let mut last = DisplacementGradient::zero();
    let (rows, ended) = along(ends, request.points, |value| {
        let state = equilibrium(&request.solid, &controls(test, (&path, value), &held)?, &last)?;
        last = state.deformation;
        Ok::<_, ForwardError>(row(&request.solid, value, &state, keeps_volume))
    })?;
    let components = |letter| (1..=3).flat_map(move |i| (1..=3).map(move |j| format!("{letter}{i}{j}")));
    let strains = components("F").chain(once("J".to_owned())).map(|name| (name, ""));
    let stresses = components("P").chain(["T11", "T22", "T33", "T12", "T13", "T23"].map(str::to_owned));
    let stresses = stresses.chain(keeps_volume.then(|| "pressure".to_owned())).map(|name| (name, "Pa"));
    let mut columns = vec![(path.name.clone(), path.unit())];
    columns.extend(strains.chain(stresses).chain(once(("energy".to_owned(), "J/m^3"))));
    let shown = test.shown();
    let (test, solid) = (request.test.clone(), request.solid.clone());
    Ok(LoadedSpecimen { test, solid, columns, rows, ended, shown })
}

/// The rows of a path, and where it ended early.
type Rows = (Vec<Vec<f64>>, Option<(f64, String)>);

/// The states at evenly spaced values; what the first one refuses is refused.
fn along(
    [from, to]: [f64; 2],
    points: u32,
    mut at: impl FnMut(f64) -> Result<Vec<f64>, ForwardError>,
) -> Result<Rows, ForwardError> {
    let mut rows = Vec::with_capacity(points as usize);
    for k in 0..points {
        let share = f64::from(k) / f64::from(points - 1);
        let value = from * (1.0 - share) + to * share;
        match at(value) {
            Ok(row) => rows.push(row),
            Err(error) if rows.is_empty() => return Err(error),
            Err(error) => return Ok((rows, Some((value, error.to_string())))),
        }
    }
    Ok((rows, None))
}

fn row(solid: &AnyRubber, value: f64, state: &HomogeneousState, keeps_volume: bool) -> Vec<f64> {
    let gradient = state.deformation.gradient_rows();
    let stress = state.cauchy.0.rows();
    let cauchy = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| stress[i][j]);
    let mut row = vec![value];
    row.extend(gradient.as_flattened());
    row.push(state.deformation.jacobian());
    row.extend((0..9).map(|place| state.first_piola.0[(place / 3, place % 3)]));
    row.extend(cauchy);
    row.extend(keeps_volume.then_some(state.pressure));
    row.push(solid.energy(&state.deformation));
    row
}

/// A rod or a tube of a solid that keeps its volume, its ends held or under a force.
fn torsion(request: &SpecimenRequest) -> Result<LoadedSpecimen, ForwardError> {
    match &request.solid {
        AnyRubber::Solid(AnySolid::Incompressible(solid)) => twisted(request, &solid.isochoric),
        AnyRubber::Rubber { shape, volumetric: None } => twisted(request, shape),
        _ => Err(ForwardError::Argument {
            argument: "the solid".to_owned(),
            valid: "neo-hookean, mooney-rivlin, yeoh, gent, arruda-boyce, carroll, lopez-pamies, van-der-waals or polynomial:n, \
                    without a bulk modulus",
        }),
    }
}

fn twisted(request: &SpecimenRequest, law: &impl Isochoric) -> Result<LoadedSpecimen, ForwardError> {
    let known = |name: &str| matches!(name, "radius" | "inner_radius");
    if let Some((name, size)) = request.sizes.iter().find(|(name, _)| !known(name)) {
        return Err(ForwardError::Argument { argument: format!("{name} = {size}"), valid: "radius or inner_radius" });
    }
    let size = |name: &str| -> Result<Option<f64>, ForwardError> {
        let Some((_, text)) = request.sizes.iter().find(|(other, _)| other == name) else { return Ok(None) };
        let refused = || ForwardError::Argument { argument: format!("{name} = {text}"), valid: "a length, as 5 mm" };
        value(text, Dimension::LENGTH).map(Some).ok_or_else(refused)
    };
    let outer = size("radius")?.ok_or_else(|| ForwardError::MissingSize { name: "radius".to_owned() })?;
    let tube = match size("inner_radius")? {
        Some(inner) => Tube::new(inner, outer)?,
        None => Tube::solid(outer)?,
    };
    let (name, text) = &request.path;
    let ends = (name == "twist").then(|| range(text, TWIST)).flatten().ok_or_else(|| ForwardError::Argument {
        argument: format!("{name}={text}"),
        valid: "twist, the angle per length of the rod, as twist=0..100 rad/m",
    })?;
    let held = match request.held.as_slice() {
        [] => Some(Ends::Force(0.0)),
        [(name, text)] if name == "stretch" => value(text, Dimension::NONE).map(Ends::Stretch),
        [(name, text)] if name == "force" => value(text, Dimension::FORCE).map(Ends::Force),
        _ => None,
    };
    let held = held.ok_or_else(|| ForwardError::Argument {
        argument: request.held.iter().map(|(name, text)| format!("{name}={text}")).collect::<Vec<_>>().join(", "),
        valid: "stretch=1.1 or force=0 N, one of them",
    })?;
    let rod = Torsion { tube, law, ends: held };
    let (rows, ended) = along(ends, request.points, |twist| {
        let state = rod.state(twist)?;
        Ok(vec![twist, state.torque, state.axial_force, state.axial_stretch])
    })?;
    let columns = [("twist", "rad/m"), ("torque", "N m"), ("axial_force", "N"), ("axial_stretch", "")];
    let columns = columns.map(|(name, unit)| (name.to_owned(), unit)).to_vec();
    let shown =
        if matches!(held, Ends::Stretch(_)) { &["torque", "axial_force"] } else { &["torque", "axial_stretch"] };
    Ok(LoadedSpecimen { test: request.test.clone(), solid: request.solid.clone(), columns, rows, ended, shown })
}
