//! The settings of the compiler, and orientations, which depend on them.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::Attitude;

use super::element::{Styled, unsupported};
use super::place::{Place, turn_of_z};
use crate::error::{FileFault, MultibodyError};
use crate::files::{Element, elements, fault};

/// What says an orientation.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// Of the compiler: files, names and pictures; how the model is kept.
const IDLE: [&str; 15] = [
    "strippath",
    "meshdir",
    "texturedir",
    "assetdir",
    "discardvisual",
    "usethread",
    "fitaabb",
    "fusestatic",
    "saveinertial",
    "savecompiled",
    "savecanonical",
    "convexhull",
    "exactmeshinertia",
    "conflict",
    "passthrough",
];
/// Of the compiler: what changes the mechanics.
const READ: [&str; 11] = [
    "angle",
    "autolimits",
    "eulerseq",
    "inertiafromgeom",
    "inertiagrouprange",
    "coordinate",
    "boundmass",
    "boundinertia",
    "settotalmass",
    "balanceinertia",
    "alignfree",
];

/// Of the option: gravity and a medium; wind, which needs one; the rest is of solvers, contact and sensors.
const OPTION: [&str; 30] = [
    "gravity",
    "density",
    "viscosity",
    "wind",
    "timestep",
    "impratio",
    "tolerance",
    "ls_tolerance",
    "noslip_tolerance",
    "ccd_tolerance",
    "mpr_tolerance",
    "sleep_tolerance",
    "magnetic",
    "o_margin",
    "o_solref",
    "o_solimp",
    "o_friction",
    "integrator",
    "cone",
    "jacobian",
    "solver",
    "iterations",
    "ls_iterations",
    "noslip_iterations",
    "ccd_iterations",
    "mpr_iterations",
    "sdf_iterations",
    "sdf_initpoints",
    "apirate",
    "collision",
];
/// Of the flags: the first nine change the mechanics.
const FLAG: [&str; 27] = [
    "gravity",
    "constraint",
    "equality",
    "frictionloss",
    "limit",
    "passive",
    "spring",
    "damper",
    "actuation",
    "contact",
    "clampctrl",
    "warmstart",
    "filterparent",
    "refsafe",
    "sensor",
    "midphase",
    "eulerdamp",
    "autoreset",
    "nativeccd",
    "island",
    "override",
    "energy",
    "fwdinv",
    "invdiscrete",
    "sensornoise",
    "multiccd",
    "sleep",
];

/// Where the inertia of a body comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    /// Where there is no `inertial`.
    Auto,
    Always,
}

/// The element `compiler`, and gravity.
pub(super) struct Settings {
    /// Radians of the unit of angles.
    pub(super) angle: f64,
    pub(super) autolimits: bool,
    /// The axis of each turn, and whether it is that of the turned frame.
    eulerseq: [(usize, bool); 3],
    pub(super) from_geoms: FromGeoms,
    /// The first and the last group of geoms that have mass.
    pub(super) groups: [f64; 2],
    pub(super) gravity: [f64; 3],
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            angle: 1f64.to_radians(),
            autolimits: true,
            eulerseq: [(0, true), (1, true), (2, true)],
            from_geoms: FromGeoms::Auto,
            groups: [0.0, 5.0],
            gravity: [0.0, 0.0, -9.81],
        }
    }
}

impl Settings {
    /// Reads the element `compiler`.
    pub(super) fn compiler(&mut self, element: Element<'_>) -> Result<(), MultibodyError> {
        let compiler = Styled::plain(element);
        compiler.check(&[&IDLE[..], &READ].concat())?;
        compiler.check_idle(&[
            ("coordinate", &["local"]),
            ("boundmass", &["0"]),
            ("boundinertia", &["0"]),
            ("settotalmass", &["-1"]),
            ("balanceinertia", &["false"]),
            ("alignfree", &["false"]),
        ])?;
        match compiler.text("angle") {
            None => {}
            Some(("degree", _)) => self.angle = 1f64.to_radians(),
            Some(("radian", _)) => self.angle = 1.0,
            Some((text, _)) => return Err(compiler.no_such_word("angle", text, "degree or radian")),
        }
        self.autolimits = compiler.flag("autolimits")?.unwrap_or(self.autolimits);
        match compiler.text("inertiafromgeom") {
            None => {}
            Some(("auto", _)) => self.from_geoms = FromGeoms::Auto,
            Some(("true", _)) => self.from_geoms = FromGeoms::Always,
            Some(("false", _)) => self.from_geoms = FromGeoms::Never,
            Some((text, _)) => return Err(compiler.no_such_word("inertiafromgeom", text, "true, false or auto")),
        }
        self.groups = compiler.numbers("inertiagrouprange")?.unwrap_or(self.groups);
        if let Some((text, _)) = compiler.text("eulerseq") {
            let axis = |letter: char| Some(("xyz".find(letter.to_ascii_lowercase())?, letter.is_ascii_lowercase()));
            let turns: Option<Vec<_>> = text.chars().map(axis).collect();
            let turns = turns.and_then(|turns| <[_; 3]>::try_from(turns).ok());
            let valid = "three of the letters x, y, z, X, Y and Z";
            self.eulerseq = turns.ok_or_else(|| compiler.no_such_word("eulerseq", text, valid))?;
        }
        Ok(())
    }

    /// Reads the element `option`: gravity, and that nothing else acts.
    pub(super) fn option(&mut self, element: Element<'_>) -> Result<(), MultibodyError> {
        let option = Styled::plain(element);
        option.check(&OPTION)?;
        option.check_idle(&[("density", &["0"]), ("viscosity", &["0"])])?;
        self.gravity = option.numbers("gravity")?.unwrap_or(self.gravity);
        for flags in elements(element) {
            if flags.tag_name().name() != "flag" {
                return Err(unsupported(flags));
            }
            let flags = Styled::plain(flags);
            flags.check(&FLAG)?;
            let enabled: &[&str] = &["enable"];
            let parts = ["constraint", "equality", "frictionloss", "limit", "passive", "spring", "damper", "actuation"];
            flags.check_idle(&parts.map(|part| (part, enabled)))?;
            match flags.text("gravity") {
                None | Some(("enable", _)) => {}
                Some(("disable", _)) => self.gravity = [0.0; 3],
                Some((text, _)) => return Err(flags.no_such_word("gravity", text, "enable or disable")),
            }
        }
        Ok(())
    }

    /// `pos` and orientation of an element.
    pub(super) fn place(&self, of: &Styled<'_>) -> Result<Place, MultibodyError> {
        Ok(Place { origin: of.numbers("pos")?.unwrap_or_default(), attitude: self.attitude(of)? })
    }

    /// The orientation of an element, in one of five ways.
    fn attitude(&self, of: &Styled<'_>) -> Result<Attitude<f64>, MultibodyError> {
        // An element's own orientation replaces the one of its defaults, in whichever way they are written.
        let Some((layer, said)) = of.first_with(&ORIENTATIONS) else { return Ok(Attitude::identity()) };
        let name = said[0];
        if let Some(&second) = said.get(1) {
            let element = layer.tag_name().name().to_owned();
            return Err(fault(layer, FileFault::TwoAttributes { element, first: name, second }));
        }
        let no_direction =
            |value| of.fault(name, FileFault::OutOfRange { attribute: name, value, condition: "0 < length" });
        match name {
            "quat" => {
                let quaternion = of.numbers(name)?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
                Attitude::from_quaternion(quaternion).map_err(|_| no_direction(0.0))
            }
            "axisangle" => {
                let [x, y, z, angle] = of.numbers(name)?.unwrap_or_default();
                Attitude::from_axis_angle(&Vector3::new(x, y, z), self.angle * angle).map_err(|_| no_direction(0.0))
            }
            "euler" => {
                let angles: [f64; 3] = of.numbers(name)?.unwrap_or_default();
                let mut attitude = Attitude::identity();
                for ((axis, is_intrinsic), angle) in self.eulerseq.into_iter().zip(angles) {
                    let turn = match axis {
                        0 => Attitude::about_x(self.angle * angle),
                        1 => Attitude::about_y(self.angle * angle),
                        _ => Attitude::about_z(self.angle * angle),
                    };
                    attitude = if is_intrinsic { attitude.product(turn) } else { turn.product(attitude) };
                }
                Ok(attitude)
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = of.numbers(name)?.unwrap_or_default();
                let (x, y) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
                let x = x.try_normalize(0.0).ok_or_else(|| no_direction(0.0))?;
                let y = (y - x * x.dot(&y)).try_normalize(1e-12 * y.norm()).ok_or_else(|| no_direction(0.0))?;
                let rows = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
                Attitude::from_matrix(&rows).map_err(|_| no_direction(0.0))
            }
            _ => {
                let direction: [f64; 3] = of.numbers(name)?.unwrap_or_default();
                if direction.iter().all(|x| x.abs() <= 0.0) {
                    return Err(no_direction(0.0));
                }
                Ok(turn_of_z(direction))
            }
        }
    }
}
