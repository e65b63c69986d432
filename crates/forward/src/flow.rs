//! A flow with its answers and its profile.

use piola_document::units::Dimension;
use piola_fluids::{AnyFluid, ViscometricFluid as _};
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, Estimate, FallingFilm, ParallelPlates, Poiseuille, ViscometryError,
};

use crate::ForwardError;
use crate::quantity::value;

/// g, m/s².
const GRAVITY: f64 = 9.806_65;
/// Intervals of a profile.
const INTERVALS: u32 = 200;

const GRADIENT: Dimension = Dimension { length: -2, mass: 1, time: -2, angle: 0 };
const DISCHARGE: Dimension = Dimension { length: 3, time: -1, ..Dimension::NONE };
const PER_WIDTH: Dimension = Dimension { length: 2, time: -1, ..Dimension::NONE };
const DENSITY: Dimension = Dimension { length: -3, mass: 1, time: 0, angle: 0 };

/// What to solve.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FlowRequest {
    /// `pipe`, `channel`, `annulus`, `couette`, `plates`, `cone` or `film`.
    pub flow: String,
    /// The fluid.
    pub fluid: AnyFluid,
    /// Sizes, as `("radius", "2 mm")`.
    pub sizes: Vec<(String, String)>,
    /// The drive or the answer, as `("discharge", "3 mL/s")`.
    pub given: (String, String),
}

impl FlowRequest {
    /// A request.
    #[must_use]
    pub fn new(flow: &str, fluid: AnyFluid, sizes: &[(&str, &str)], given: (&str, &str)) -> Self {
        let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        Self { flow: flow.to_owned(), fluid, sizes: sizes.iter().map(owned).collect(), given: owned(&given) }
    }
}

/// A number of a flow.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Answered {
    /// Its name.
    pub name: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The number.
    pub value: f64,
    /// A bound of its error; none where it was given, or follows from what was given by a formula.
    pub error: Option<f64>,
}

/// A point of a profile.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct ProfilePoint {
    /// The distance from the axis, the middle or the wall, m.
    pub position: f64,
    /// The velocity, m/s; of coaxial cylinders the angular velocity beside the inner one, rad/s.
    pub velocity: f64,
    /// The shear stress, Pa.
    pub shear_stress: f64,
    /// The shear rate, 1/s.
    pub shear_rate: f64,
}

/// A flow with its answers.
///
/// # Example
/// See [`solve`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SolvedFlow {
    /// Its name.
    pub flow: String,
    /// The fluid.
    pub fluid: AnyFluid,
    /// The drive, then all answers.
    pub answers: Vec<Answered>,
    /// Position, velocity, stress and rate across the flow.
    pub profile: Vec<ProfilePoint>,
}

/// The sizes and the given quantity of a request in SI.
struct Reader<'r>(&'r FlowRequest);

impl Reader<'_> {
    fn size(&self, name: &str, dimension: Dimension) -> Result<f64, ForwardError> {
        let Some((_, text)) = self.0.sizes.iter().find(|(other, _)| other == name) else {
            return Err(ForwardError::MissingSize { name: name.to_owned() });
        };
        value(text, dimension).ok_or_else(|| ForwardError::Argument {
            argument: format!("{name} = {text}"),
            valid: "a number with a unit of this size, as 2 mm, 2 deg or 1000 kg/m^3",
        })
    }

    /// Which of two quantities is given, and its value.
    fn given(
        &self,
        drive: (&str, Dimension),
        answer: (&str, Dimension),
        valid: &'static str,
    ) -> Result<(bool, f64), ForwardError> {
        let (name, text) = &self.0.given;
        let wrong = || ForwardError::Argument { argument: format!("{name} = {text}"), valid };
        let (is_drive, dimension) = match name.as_str() {
            name if name == drive.0 => (true, drive.1),
            name if name == answer.0 => (false, answer.1),
            _ => return Err(wrong()),
        };
        Ok((is_drive, value(text, dimension).ok_or_else(wrong)?))
    }

    fn allow(&self, names: &[&str]) -> Result<(), ForwardError> {
        match self.0.sizes.iter().find(|(name, _)| !names.contains(&name.as_str())) {
            Some((name, text)) => Err(ForwardError::Argument {
                argument: format!("{name} = {text}"),
                valid: "only the sizes of this flow",
            }),
            None => Ok(()),
        }
    }
}

const fn stated(name: &'static str, unit: &'static str, value: f64) -> Answered {
    Answered { name, unit, value, error: None }
}

const fn found(name: &'static str, unit: &'static str, Estimate { value, error }: Estimate) -> Answered {
    Answered { name, unit, value, error: Some(error) }
}

/// Points of a profile, evenly between two positions.
fn profile(
    low: f64,
    high: f64,
    at: impl Fn(f64) -> Result<[f64; 3], ViscometryError>,
) -> Result<Vec<ProfilePoint>, ViscometryError> {
    let point = |k: u32| {
        let position = (low + (high - low) * f64::from(k) / f64::from(INTERVALS)).min(high);
        let [velocity, shear_stress, shear_rate] = at(position)?;
        Ok(ProfilePoint { position, velocity, shear_stress, shear_rate })
    };
    (0..=INTERVALS).map(point).collect()
}

/// Solves a flow.
///
/// # Errors
/// [`ForwardError::Argument`] for flows, sizes, quantities and units that do not go together, [`ForwardError::MissingSize`];
/// [`ForwardError::Viscometry`] for what the flow or the fluid refuses.
///
/// # Example
/// ```
/// use piola_forward::{FlowRequest, fluid, solve};
/// // Water in a pipe of 1 mm: Q = π R⁴ c/(8 μ).
/// let water = fluid("newtonian:viscosity_coefficient=1 mPa s")?;
/// let request = FlowRequest::new("pipe", water, &[("radius", "1 mm")], ("discharge", "1 mL/s"));
/// let pipe = solve(&request)?;
/// let gradient = pipe.answer("pressure_gradient").expect("there").value;
/// assert!((gradient / (8e-3 * 1e-6 / (core::f64::consts::PI * 1e-12)) - 1.0).abs() < 1e-12);
/// # Ok::<(), piola_forward::ForwardError>(())
/// ```
pub fn solve(request: &FlowRequest) -> Result<SolvedFlow, ForwardError> {
    let (answers, profile) = match request.flow.as_str() {
        "pipe" => pipe(request)?,
        "channel" => channel(request)?,
        "annulus" => annulus(request)?,
        "couette" => couette(request)?,
        "plates" => plates(request)?,
        "cone" => cone(request)?,
        "film" => film(request)?,
        other => {
            return Err(ForwardError::Argument {
                argument: other.to_owned(),
                valid: "pipe, channel, annulus, couette, plates, cone or film",
            });
        }
    };
    Ok(SolvedFlow { flow: request.flow.clone(), fluid: request.fluid.clone(), answers, profile })
}

type Solved = Result<(Vec<Answered>, Vec<ProfilePoint>), ForwardError>;

fn pipe(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["radius"])?;
    let radius = reader.size("radius", Dimension::LENGTH)?;
    let valid = "pressure_gradient=10 kPa/m or discharge=3 mL/s";
    let (is_drive, value) = reader.given(("pressure_gradient", GRADIENT), ("discharge", DISCHARGE), valid)?;
    let flow =
        if is_drive { Poiseuille::new(radius, value)? } else { Poiseuille::with_discharge(radius, value, fluid)? };
    let error = if is_drive { None } else { Some(flow.pressure_gradient_error(fluid, value)?) };
    let wall = flow.wall_stress();
    let answers = vec![
        Answered { name: "pressure_gradient", unit: "Pa/m", value: flow.pressure_gradient(), error },
        found("discharge", "m^3/s", flow.discharge(fluid)?),
        found("mean_velocity", "m/s", flow.mean_velocity(fluid)?),
        found("velocity_on_the_axis", "m/s", flow.velocity(fluid, 0.0)?),
        stated("wall_shear_stress", "Pa", wall),
        stated("wall_shear_rate", "1/s", fluid.shear_rate(wall).map_err(ViscometryError::from)?),
        stated("plug_radius", "m", flow.plug_radius(fluid)),
        found("dissipation_per_length", "W/m", flow.dissipation(fluid)?),
    ];
    let at = |r: f64| Ok([flow.velocity(fluid, r)?.value, flow.shear_stress(r)?, flow.shear_rate(fluid, r)?]);
    Ok((answers, profile(0.0, radius, at)?))
}

fn channel(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["half_width"])?;
    let half = reader.size("half_width", Dimension::LENGTH)?;
    let valid = "pressure_gradient=10 kPa/m or discharge_per_width=3 mm^2/s";
    let (is_drive, value) = reader.given(("pressure_gradient", GRADIENT), ("discharge_per_width", PER_WIDTH), valid)?;
    let flow = if is_drive { Channel::new(half, value)? } else { Channel::with_discharge(half, value, fluid)? };
    let error = if is_drive { None } else { Some(flow.pressure_gradient_error(fluid, value)?) };
    let wall = flow.wall_stress();
    let answers = vec![
        Answered { name: "pressure_gradient", unit: "Pa/m", value: flow.pressure_gradient(), error },
        found("discharge_per_width", "m^2/s", flow.discharge(fluid)?),
        found("mean_velocity", "m/s", flow.mean_velocity(fluid)?),
        found("velocity_in_the_middle", "m/s", flow.velocity(fluid, 0.0)?),
        stated("wall_shear_stress", "Pa", wall),
        stated("wall_shear_rate", "1/s", fluid.shear_rate(wall).map_err(ViscometryError::from)?),
        stated("plug_half_width", "m", flow.plug_half_width(fluid)),
        found("dissipation_per_area", "W/m^2", flow.dissipation(fluid)?),
    ];
    let at = |x: f64| Ok([flow.velocity(fluid, x)?.value, flow.shear_stress(x)?, flow.shear_rate(fluid, x)?]);
    Ok((answers, profile(0.0, half, at)?))
}

fn annulus(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["inner_radius", "outer_radius"])?;
    let [inner, outer] = ["inner_radius", "outer_radius"].map(|name| reader.size(name, Dimension::LENGTH));
    let (inner, outer) = (inner?, outer?);
    let valid = "pressure_gradient=10 kPa/m or discharge=3 mL/s";
    let (is_drive, value) = reader.given(("pressure_gradient", GRADIENT), ("discharge", DISCHARGE), valid)?;
    let flow = if is_drive {
        Annulus::new(inner, outer, value)?
    } else {
        Annulus::with_discharge(inner, outer, value, fluid)?
    };
    let error = if is_drive { None } else { Some(flow.pressure_gradient_error(fluid, value)?) };
    let [low, high] = flow.plug(fluid)?;
    let answers = vec![
        Answered { name: "pressure_gradient", unit: "Pa/m", value: flow.pressure_gradient(), error },
        found("discharge", "m^3/s", flow.discharge(fluid)?),
        found("mean_velocity", "m/s", flow.mean_velocity(fluid)?),
        stated("radius_without_stress", "m", flow.rest_radius(fluid)?),
        stated("plug_from", "m", low),
        stated("plug_to", "m", high),
        stated("inner_shear_stress", "Pa", flow.shear_stress(fluid, inner)?),
        stated("outer_shear_stress", "Pa", flow.shear_stress(fluid, outer)?),
        found("dissipation_per_length", "W/m", flow.dissipation(fluid)?),
    ];
    let at = |r: f64| Ok([flow.velocity(fluid, r)?.value, flow.shear_stress(fluid, r)?, flow.shear_rate(fluid, r)?]);
    Ok((answers, profile(inner, outer, at)?))
}

fn couette(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["inner_radius", "outer_radius"])?;
    let [inner, outer] = ["inner_radius", "outer_radius"].map(|name| reader.size(name, Dimension::LENGTH));
    let (inner, outer) = (inner?, outer?);
    let valid = "torque_per_length=2 mN or speed_difference=60 rpm";
    let drive = ("torque_per_length", Dimension::FORCE);
    let (is_drive, value) = reader.given(drive, ("speed_difference", Dimension::ANGULAR_RATE), valid)?;
    let flow = if is_drive {
        Couette::new(inner, outer, value)?
    } else {
        Couette::with_speed_difference(inner, outer, value, fluid)?
    };
    let error = if is_drive { None } else { Some(flow.moment_error(fluid, value)?) };
    let mut answers = vec![
        Answered { name: "torque_per_length", unit: "N", value: flow.moment(), error },
        found("speed_difference", "rad/s", flow.speed_difference(fluid)?),
        stated("inner_shear_stress", "Pa", flow.shear_stress(inner)?),
        stated("inner_shear_rate", "1/s", flow.shear_rate(fluid, inner)?),
        stated("outer_shear_stress", "Pa", flow.shear_stress(outer)?),
        stated("outer_shear_rate", "1/s", flow.shear_rate(fluid, outer)?),
    ];
    answers.extend(flow.yield_radius(fluid).map(|radius| stated("yield_radius", "m", radius)));
    answers.push(found("dissipation_per_length", "W/m", flow.dissipation(fluid)?));
    let at = |r: f64| Ok([flow.angular_velocity(fluid, r)?.value, flow.shear_stress(r)?, flow.shear_rate(fluid, r)?]);
    Ok((answers, profile(inner, outer, at)?))
}

fn plates(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["radius", "gap"])?;
    let (radius, gap) = (reader.size("radius", Dimension::LENGTH)?, reader.size("gap", Dimension::LENGTH)?);
    let valid = "angular_velocity=60 rpm or torque=2 mN m";
    let drive = ("angular_velocity", Dimension::ANGULAR_RATE);
    let (is_drive, value) = reader.given(drive, ("torque", Dimension::MOMENT), valid)?;
    let flow = if is_drive {
        ParallelPlates::new(radius, gap, value)?
    } else {
        ParallelPlates::with_torque(radius, gap, value, fluid)?
    };
    let error = if is_drive { None } else { Some(flow.speed_error(fluid, value)?) };
    let answers = vec![
        Answered { name: "angular_velocity", unit: "rad/s", value: flow.speed(), error },
        found("torque", "N m", flow.torque(fluid)?),
        found("thrust", "N", flow.thrust(fluid)?),
        stated("rim_shear_rate", "1/s", flow.rim_shear_rate()),
        stated("rim_shear_stress", "Pa", flow.shear_stress(fluid, radius)?),
        found("dissipation", "W", flow.dissipation(fluid)?),
    ];
    let at = |r: f64| Ok([flow.speed() * r, flow.shear_stress(fluid, r)?, flow.shear_rate(fluid, r)?]);
    Ok((answers, profile(0.0, radius, at)?))
}

fn cone(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["radius", "angle"])?;
    let (radius, angle) = (reader.size("radius", Dimension::LENGTH)?, reader.size("angle", Dimension::ANGLE)?);
    let valid = "angular_velocity=60 rpm or torque=2 mN m";
    let drive = ("angular_velocity", Dimension::ANGULAR_RATE);
    let (is_drive, value) = reader.given(drive, ("torque", Dimension::MOMENT), valid)?;
    let flow = if is_drive {
        ConeAndPlate::new(radius, angle, value)?
    } else {
        ConeAndPlate::with_torque(radius, angle, value, fluid)?
    };
    let error = if is_drive { None } else { Some(flow.speed_error(fluid, value)?) };
    let answers = vec![
        Answered { name: "angular_velocity", unit: "rad/s", value: flow.speed(), error },
        found("torque", "N m", flow.torque(fluid)?),
        found("thrust", "N", flow.thrust(fluid)?),
        stated("shear_rate", "1/s", flow.nominal_shear_rate()),
        stated("shear_stress", "Pa", flow.shear_stress(fluid, radius)?),
        found("dissipation", "W", flow.dissipation(fluid)?),
    ];
    let at = |r: f64| Ok([flow.speed() * r, flow.shear_stress(fluid, r)?, flow.shear_rate(fluid, r)?]);
    // On the axis of a cone there is no gap.
    Ok((answers, profile(radius / f64::from(INTERVALS), radius, at)?))
}

fn film(request: &FlowRequest) -> Solved {
    let (reader, fluid) = (Reader(request), &request.fluid);
    reader.allow(&["density", "inclination"])?;
    let (density, inclination) = (reader.size("density", DENSITY)?, reader.size("inclination", Dimension::ANGLE)?);
    let valid = "thickness=1 mm or discharge_per_width=3 mm^2/s";
    let (is_drive, value) =
        reader.given(("thickness", Dimension::LENGTH), ("discharge_per_width", PER_WIDTH), valid)?;
    let flow = if is_drive {
        FallingFilm::new(value, density, GRAVITY, inclination)?
    } else {
        FallingFilm::with_discharge(value, density, GRAVITY, inclination, fluid)?
    };
    let error = if is_drive { None } else { Some(flow.thickness_error(fluid, value)?) };
    let answers = vec![
        Answered { name: "thickness", unit: "m", value: flow.thickness(), error },
        found("discharge_per_width", "m^2/s", flow.discharge(fluid)?),
        found("mean_velocity", "m/s", flow.mean_velocity(fluid)?),
        stated("wall_shear_stress", "Pa", flow.wall_stress()),
        stated("plug_thickness", "m", flow.plug_thickness(fluid)),
        found("dissipation_per_area", "W/m^2", flow.dissipation(fluid)?),
    ];
    let at = |x: f64| Ok([flow.velocity(fluid, x)?.value, flow.shear_stress(x)?, flow.shear_rate(fluid, x)?]);
    Ok((answers, profile(0.0, flow.thickness(), at)?))
}
