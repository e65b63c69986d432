//! Kinds of flows with their columns and geometries.

use core::str::FromStr;

use piola_document::units::Dimension;

use crate::MeasuredError;

/// Pa.
pub(super) const STRESS: Dimension = Dimension { length: -1, mass: 1, time: -2, angle: 0 };
pub(super) const RATE: Dimension = Dimension { time: -1, ..Dimension::NONE };
pub(super) const DISCHARGE: Dimension = Dimension { length: 3, time: -1, ..Dimension::NONE };
const DISCHARGE_PER_WIDTH: Dimension = Dimension { length: 2, time: -1, ..Dimension::NONE };
const PRESSURE_GRADIENT: Dimension = Dimension { length: -2, mass: 1, time: -2, angle: 0 };
pub(super) const TORQUE: Dimension = Dimension { length: 2, mass: 1, time: -2, angle: 0 };
const FORCE: Dimension = Dimension { length: 1, mass: 1, time: -2, angle: 0 };

/// A column: its name, dimension and SI unit.
pub(super) type Named = (&'static str, Dimension, &'static str);

const GRADIENT: Named = ("pressure_gradient", PRESSURE_GRADIENT, "Pa/m");
const SPEED: Named = ("angular_velocity", Dimension::ANGULAR_RATE, "rad/s");
const VOLUME: Named = ("discharge", DISCHARGE, "m^3/s");

/// The kind of a measurement: the quantity that was set, and one or more columns of responses.
///
/// | name | set | response | geometry |
/// |---|---|---|---|
/// | `pipe` | `pressure_gradient` (Pa/m), or `pressure_difference` and the size `length` | `discharge` (m³/s) | `radius` |
/// | `capillary` | `discharge` (m³/s) | `pressure_difference` (Pa), ends included | `radius`, `length` |
/// | `channel` | `pressure_gradient` (Pa/m) | `discharge_per_width` (m²/s) | `half_width` |
/// | `couette` | `torque_per_length` (N); or `torque` and the size `height`; or `dial_reading` of an oilfield viscometer and its `bob` | `speed_difference` (rad/s), `radial_stress_difference` (Pa) | `inner_radius`, `outer_radius` |
/// | `plates` | `angular_velocity` (rad/s) | `torque` (N m), `thrust` (N) | `radius`, `gap` |
/// | `cone` | `angular_velocity` (rad/s) | `torque` (N m), `thrust` (N) | `radius`, `angle` |
/// | `curve` | `shear_rate` (1/s) | `shear_stress` (Pa), or `viscosity` (Pa s) | |
///
/// `radial_stress_difference` is `T_rr` at the outer cylinder less that at the inner one, what rotation adds made good; `thrust` is what
/// drives the surfaces apart, counted from that at rest. These two may be negative, all of them; everything else is positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FlowKind {
    /// The discharge of a pipe.
    Pipe,
    /// The pressure that a capillary with its ends takes.
    Capillary,
    /// The discharge of a channel.
    Channel,
    /// The speeds, or radial stresses, of coaxial cylinders.
    Couette,
    /// The torque, or thrust, of parallel plates.
    Plates,
    /// The torque, or thrust, of cone and plate.
    Cone,
    /// A flow curve itself.
    Curve,
}

impl FlowKind {
    const ALL: [Self; 7] =
        [Self::Pipe, Self::Capillary, Self::Channel, Self::Couette, Self::Plates, Self::Cone, Self::Curve];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pipe => "pipe",
            Self::Capillary => "capillary",
            Self::Channel => "channel",
            Self::Couette => "couette",
            Self::Plates => "plates",
            Self::Cone => "cone",
            Self::Curve => "curve",
        }
    }

    /// Its name in a sentence.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Couette => "coaxial cylinders",
            Self::Plates => "parallel plates",
            Self::Cone => "cone and plate",
            Self::Curve => "flow curve",
            Self::Pipe | Self::Capillary | Self::Channel => self.name(),
        }
    }

    /// The column of the quantity that was set.
    pub(super) const fn drive(self) -> Named {
        match self {
            Self::Pipe | Self::Channel => GRADIENT,
            Self::Capillary => VOLUME,
            Self::Couette => ("torque_per_length", FORCE, "N"),
            Self::Plates | Self::Cone => SPEED,
            Self::Curve => ("shear_rate", RATE, "1/s"),
        }
    }

    /// The columns of possible responses.
    pub(super) const fn answers(self) -> &'static [Answering] {
        match self {
            Self::Pipe => &[Answering::Discharge],
            Self::Capillary => &[Answering::PressureDifference],
            Self::Channel => &[Answering::DischargePerWidth],
            Self::Couette => &[Answering::SpeedDifference, Answering::RadialStressDifference],
            Self::Plates | Self::Cone => &[Answering::Torque, Answering::Thrust],
            Self::Curve => &[Answering::ShearStress],
        }
    }

    /// The lengths and angles of the geometry.
    pub(super) const fn sizes(self) -> &'static [(&'static str, Dimension)] {
        const RADIUS: (&str, Dimension) = ("radius", Dimension::LENGTH);
        match self {
            Self::Pipe => &[RADIUS],
            Self::Capillary => &[RADIUS, ("length", Dimension::LENGTH)],
            Self::Channel => &[("half_width", Dimension::LENGTH)],
            Self::Couette => &[("inner_radius", Dimension::LENGTH), ("outer_radius", Dimension::LENGTH)],
            Self::Plates => &[RADIUS, ("gap", Dimension::LENGTH)],
            Self::Cone => &[RADIUS, ("angle", Dimension::ANGLE)],
            Self::Curve => &[],
        }
    }

    /// Lengths that some columns take besides.
    pub(super) const fn more_sizes(self) -> &'static [(&'static str, Dimension)] {
        match self {
            Self::Couette => &[("height", Dimension::LENGTH)],
            Self::Pipe | Self::Channel => &[("length", Dimension::LENGTH)],
            _ => &[],
        }
    }
}

/// The measured quantity of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Answering {
    /// Q, m³/s.
    Discharge,
    /// Δp of a capillary with its ends, Pa.
    PressureDifference,
    /// Q of a channel for each width, m²/s.
    DischargePerWidth,
    /// ΔΩ of coaxial cylinders, rad/s.
    SpeedDifference,
    /// `T_rr(R₂) − T_rr(R₁)`, Pa.
    RadialStressDifference,
    /// 𝓜, N m.
    Torque,
    /// 𝓕, N.
    Thrust,
    /// τ, Pa.
    ShearStress,
}

impl Answering {
    /// Its column.
    pub(super) const fn column(self) -> Named {
        match self {
            Self::Discharge => VOLUME,
            Self::PressureDifference => ("pressure_difference", STRESS, "Pa"),
            Self::DischargePerWidth => ("discharge_per_width", DISCHARGE_PER_WIDTH, "m^2/s"),
            Self::SpeedDifference => ("speed_difference", Dimension::ANGULAR_RATE, "rad/s"),
            Self::RadialStressDifference => ("radial_stress_difference", STRESS, "Pa"),
            Self::Torque => ("torque", TORQUE, "N m"),
            Self::Thrust => ("thrust", FORCE, "N"),
            Self::ShearStress => ("shear_stress", STRESS, "Pa"),
        }
    }

    /// Whether it comes of normal stresses and may be negative.
    #[must_use]
    pub const fn is_normal(self) -> bool {
        matches!(self, Self::RadialStressDifference | Self::Thrust)
    }
}

/// A column of measured responses.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Answer {
    /// The measured quantity.
    pub what: Answering,
    /// Whether all of the column is negative.
    pub is_negative: bool,
    /// The drive and the magnitude of the response, in SI units.
    pub rows: Vec<[f64; 2]>,
}

impl Answer {
    /// −1 or 1.
    #[must_use]
    pub const fn sign(&self) -> f64 {
        if self.is_negative { -1.0 } else { 1.0 }
    }
}

impl FromStr for FlowKind {
    type Err = MeasuredError;

    fn from_str(text: &str) -> Result<Self, MeasuredError> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| MeasuredError::Argument {
            argument: text.to_owned(),
            valid: "pipe, capillary, channel, couette, plates, cone or curve",
        })
    }
}

/// A flow with its geometry. Lengths in m, angles in rad.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Flow {
    /// A pipe.
    Pipe {
        /// Its radius.
        radius: f64,
    },
    /// A capillary.
    Capillary {
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
    },
    /// A channel.
    Channel {
        /// Half its width.
        half_width: f64,
    },
    /// Coaxial cylinders.
    Couette {
        /// The radius of the inner one.
        inner_radius: f64,
        /// The radius of the outer one.
        outer_radius: f64,
    },
    /// Parallel discs.
    Plates {
        /// Their radius.
        radius: f64,
        /// Their distance.
        gap: f64,
    },
    /// A cone on a plate.
    Cone {
        /// Its radius.
        radius: f64,
        /// The angle between cone and plate.
        angle: f64,
    },
    /// A flow curve.
    Curve,
}

impl Flow {
    /// The kind of the flow.
    #[must_use]
    pub const fn kind(self) -> FlowKind {
        match self {
            Self::Pipe { .. } => FlowKind::Pipe,
            Self::Capillary { .. } => FlowKind::Capillary,
            Self::Channel { .. } => FlowKind::Channel,
            Self::Couette { .. } => FlowKind::Couette,
            Self::Plates { .. } => FlowKind::Plates,
            Self::Cone { .. } => FlowKind::Cone,
            Self::Curve => FlowKind::Curve,
        }
    }

    /// Stress and rate at the wall of the Newtonian fluid that would have answered so: where searches start.
    pub(super) fn apparent(self, [drive, response]: [f64; 2]) -> [f64; 2] {
        use core::f64::consts::{PI, TAU};
        match self {
            Self::Pipe { radius } => [0.5 * drive * radius, 4.0 * response / (PI * radius.powi(3))],
            Self::Capillary { radius, length } => {
                [0.5 * response * radius / length, 4.0 * drive / (PI * radius.powi(3))]
            }
            Self::Channel { half_width } => [drive * half_width, 1.5 * response / (half_width * half_width)],
            Self::Couette { inner_radius, outer_radius } => {
                let (ratio, area) = (inner_radius / outer_radius, TAU * inner_radius.powi(2));
                [drive / area, 2.0 * response / (1.0 - ratio * ratio)]
            }
            Self::Plates { radius, gap } => [2.0 * response / (PI * radius.powi(3)), drive * radius / gap],
            Self::Cone { radius, angle } => [1.5 * response / (PI * radius.powi(3)), drive / angle],
            Self::Curve => [response, drive],
        }
    }
}
