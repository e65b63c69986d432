//! The states that are written: one or two of each family.

use core::f64::consts::{FRAC_PI_4, PI};
use std::error::Error;

use nalgebra::Matrix3;
use piola_solids::isochoric::{Gent, MooneyRivlin, NeoHookean};
use piola_solutions::ResponseFunctions;
use piola_solutions::families::{
    AzimuthalShearing, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
};
use piola_solutions::loads::{
    Bending, Block, BlockLoads, Ends, FaceForces, Sector, ShearLoads, Shell, SphereInflation, Torsion, Tube,
    TubeInflation,
};

use super::mesh::Ranges;

/// A state of a body: what [`tables`](super::tables) writes.
pub(crate) struct Case<'a, F, L> {
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    /// What the reference and the deformed coordinates are called.
    pub(crate) coordinates: [[&'static str; 3]; 2],
    pub(crate) family: F,
    /// The constants of the family, in the order of its formula.
    pub(crate) constants: Vec<f64>,
    pub(crate) law: &'a L,
    pub(crate) datum: Datum,
    pub(crate) ranges: Ranges,
    /// Resultants: name with unit, value.
    pub(crate) loads: Vec<(&'static str, f64)>,
}

/// Receives each state.
pub(crate) trait Visitor {
    fn visit<F: Family, L: ResponseFunctions>(&mut self, case: &Case<'_, F, L>) -> Result<(), Box<dyn Error>>;
}

const CARTESIAN: [&str; 3] = ["x", "y", "z"];
const CYLINDRICAL: [&str; 3] = ["r", "theta", "z"];
/// θ the azimuth, φ the colatitude.
const SPHERICAL: [&str; 3] = ["r", "theta", "phi"];

/// The laws, with their parameters in Pa.
pub(crate) const LAWS: [&str; 3] = ["neo-hookean", "mooney-rivlin", "gent"];

/// Visits all states of a law.
pub(crate) fn visit_law(name: &str, visitor: &mut impl Visitor) -> Result<(), Box<dyn Error>> {
    match name {
        "neo-hookean" => visit(&NeoHookean::new(4.0e5)?, visitor),
        "mooney-rivlin" => visit(&MooneyRivlin::new(1.5e5, 0.5e5)?, visitor),
        _ => visit(&Gent::new(4.0e5, 30.0)?, visitor),
    }
}

/// The formula and the parameters of a law.
pub(crate) fn about_law(name: &str) -> (&'static str, &'static [(&'static str, f64)]) {
    match name {
        "neo-hookean" => ("W = mu/2 (I - 3)", &[("mu_Pa", 4.0e5)]),
        "mooney-rivlin" => ("W = C10 (I - 3) + C01 (II - 3)", &[("C10_Pa", 1.5e5), ("C01_Pa", 0.5e5)]),
        _ => ("W = -mu Jm/2 ln(1 - (I - 3)/Jm)", &[("mu_Pa", 4.0e5), ("Jm", 30.0)]),
    }
}

fn visit_homogeneous<L: ResponseFunctions>(law: &L, visitor: &mut impl Visitor) -> Result<(), Box<dyn Error>> {
    let gradient = Matrix3::new(1.25, 0.3, 0.1, 0.0, 0.8, -0.2, 0.0, 0.0, 1.0);
    let family = IsochoricDeformation::new(gradient, [0.0; 3])?;
    let forces = FaceForces::of_block(&family, law, &Block::new(1.0, 1.0, 1.0)?, 0.0)?.forces;
    visitor.visit(&Case {
        name: "family-0-homogeneous",
        about: "a block is stretched and sheared: x = F X",
        coordinates: [CARTESIAN, CARTESIAN],
        family,
        constants: gradient.transpose().as_slice().to_vec(),
        law,
        datum: Datum::free_at([0.0; 3]),
        ranges: [[0.0, 1.0]; 3],
        loads: vec![
            ("force_x_on_Q1_upper_N", forces[0][0]),
            ("force_y_on_Q2_upper_N", forces[1][1]),
            ("force_z_on_Q3_upper_N", forces[2][2]),
            ("shear_force_x_on_Q2_upper_N", forces[1][0]),
        ],
    })
}

fn visit<L: ResponseFunctions>(law: &L, visitor: &mut impl Visitor) -> Result<(), Box<dyn Error>> {
    visit_homogeneous(law, visitor)?;

    let bent = Bending { block: Block::new(0.1, 0.4, 0.2)?, law, axial_stretch: 1.1 }.state(1.2)?;
    visitor.visit(&Case {
        name: "family-1-bending",
        about: "a block is bent to a sector, its curved faces free: r = sqrt(2 A X), theta = B Y + C Z, z = D Y + E Z",
        coordinates: [CARTESIAN, CYLINDRICAL],
        family: bent.deformation,
        constants: bent.deformation.constants().to_vec(),
        law,
        datum: Datum::free_at([bent.faces[1], 0.0, 0.0]),
        ranges: [bent.faces, [-0.2, 0.2], [0.0, 0.2]],
        loads: vec![("moment_N_m", bent.moment), ("axial_force_N", bent.axial_force)],
    })?;

    let straight = SectorStraightening::new([2.0, 0.6, 0.0, 0.0, 1.0 / 1.2])?;
    let per = BlockLoads::of_sector(&straight, law, (1.0, 1.4), 0.0)?;
    visitor.visit(&Case {
        name: "family-2-straightening",
        about: "a sector of a tube is straightened: x = A R^2/2, y = B Theta + C Z, z = D Theta + E Z",
        coordinates: [CYLINDRICAL, CARTESIAN],
        family: straight,
        constants: straight.constants().to_vec(),
        law,
        datum: Datum::free_at([1.4, 0.0, 0.0]),
        ranges: [[1.0, 1.4], [-0.5, 0.5], [0.0, 0.5]],
        loads: vec![("tension_N", per.tension * 0.5), ("axial_force_N", per.axial_force)],
    })?;

    let tube = Tube::new(0.02, 0.03)?;
    let inflated = TubeInflation { tube, law, ends: Ends::Stretch(1.1) }.state(1.5)?;
    let quarter = [[0.02, 0.03], [0.0, 0.5 * PI], [0.0, 0.04]];
    visitor.visit(&Case {
        name: "family-3-inflation",
        about: "a quarter of a tube under pressure inside: r = sqrt(A R^2 + B), theta = C Theta + D Z, z = E Theta + F Z",
        coordinates: [CYLINDRICAL, CYLINDRICAL],
        family: inflated.deformation,
        constants: inflated.deformation.constants().to_vec(),
        law,
        datum: Datum::free_at([0.03, 0.0, 0.0]),
        ranges: quarter,
        loads: vec![("pressure_Pa", inflated.pressure), ("axial_force_of_the_whole_tube_N", inflated.axial_force)],
    })?;

    let twisted = Torsion { tube, law, ends: Ends::Stretch(1.0) }.state(20.0)?;
    visitor.visit(&Case {
        name: "family-3-torsion",
        about: "a quarter of a twisted tube, its curved faces free: r = sqrt(A R^2 + B), theta = C Theta + D Z, z = E Theta + F Z",
        coordinates: [CYLINDRICAL, CYLINDRICAL],
        family: twisted.deformation,
        constants: twisted.deformation.constants().to_vec(),
        law,
        datum: Datum::free_at([0.03, 0.0, 0.0]),
        ranges: quarter,
        loads: vec![
            ("torque_of_the_whole_tube_N_m", twisted.torque),
            ("axial_force_of_the_whole_tube_N", twisted.axial_force),
        ],
    })?;

    let balloon = SphereInflation { shell: Shell::new(0.05, 0.06)?, law, orientation: Orientation::Kept };
    let deformation = balloon.deformation(1.4)?;
    let face = [0.05_f64, 0.07_f64];
    visitor.visit(&Case {
        name: "family-4-balloon",
        about: "a part of a spherical shell under pressure inside: r = cbrt(R^3 + A), theta = Theta (azimuth), phi = Phi (colatitude)",
        coordinates: [SPHERICAL, SPHERICAL],
        family: deformation,
        constants: vec![face[1].powi(3) - face[0].powi(3)],
        law,
        datum: Datum::free_at([0.06, 0.0, 0.5 * PI]),
        ranges: [[0.05, 0.06], [-FRAC_PI_4, FRAC_PI_4], [FRAC_PI_4, 3.0 * FRAC_PI_4]],
        loads: vec![("pressure_Pa", piola_solutions::LoadCurve::point(&balloon, 1.4)?.load)],
    })?;

    let sheared = AzimuthalShearing::new([1.1, 0.4, 0.8, 1.0 / (1.1 * 1.1 * 0.8)])?;
    let (sector, datum) = (Sector::new([0.5, 0.8], [-0.6, 0.6])?, Datum::free_at([0.8, 0.0, 0.0]));
    let loads = ShearLoads::of_sector(&sheared, law, &sector, &datum)?;
    visitor.visit(&Case {
        name: "family-5-azimuthal-shear",
        about: "a sector is sheared azimuthally: r = A R, theta = B ln R + C Theta, z = D Z",
        coordinates: [CYLINDRICAL, CYLINDRICAL],
        family: sheared,
        constants: sheared.constants().to_vec(),
        law,
        datum,
        ranges: [[0.5, 0.8], [-0.6, 0.6], [0.0, 0.4]],
        loads: vec![
            ("couple_on_the_inner_face_N_m_per_m", loads.couples[0]),
            ("couple_on_the_outer_face_N_m_per_m", loads.couples[1]),
            ("moment_on_the_lower_face_of_theta_N_m_per_m", loads.moments[0]),
            ("moment_on_the_upper_face_of_theta_N_m_per_m", loads.moments[1]),
            ("axial_force_N", loads.axial_force),
        ],
    })
}
