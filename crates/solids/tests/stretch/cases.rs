//! The laws under test and deformations to try them on.

use nalgebra::Matrix3;
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, EngineeringConstants, Fibre, Fung, Hencky,
    HolzapfelGasserOgden, Hyperelastic, IsochoricOgden, Ogden, OgdenTerm, ReinforcedNeoHookean, Stiffness,
    TransverseConstants,
};
use piola_testkit::strategies::{rotation, rotation_matrix, vector};
use proptest::prelude::*;

use super::once::Once;

/// Under which turns of the reference configuration a law answers the same.
#[derive(Clone, Copy)]
pub(super) enum Group {
    All,
    About([f64; 3]),
    HalfTurns,
}

/// What is done with every law.
pub(super) trait Visitor {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, group: Group);
}

fn term(mu: f64, alpha: f64) -> OgdenTerm {
    OgdenTerm { modulus: mu, exponent: alpha }
}

pub(super) fn ogden() -> Ogden {
    Ogden::new(&[term(1.2, 1.3), term(-0.3, -2.0)], 4.0).expect("parameters")
}

pub(super) fn isochoric_ogden() -> IsochoricOgden {
    IsochoricOgden::new(&[term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)], 10.0).expect("parameters")
}

pub(super) fn hencky() -> Hencky {
    Hencky::new(2.0, 0.9).expect("parameters")
}

pub(super) const FIBRE: [f64; 3] = [1.0, 2.0, 2.0];

pub(super) fn wood() -> EngineeringConstants {
    EngineeringConstants { young: [11.0, 1.2, 0.7], poisson: [0.38, 0.45, 0.4], shear: [0.8, 0.1, 0.7] }
}

pub(super) fn artery(dispersion: f64) -> HolzapfelGasserOgden {
    let fibres = [Fibre::in_plane(0.6).expect("angle"), Fibre::in_plane(-0.6).expect("angle")];
    HolzapfelGasserOgden::new(1.5, 20.0, 2.4, 0.8, dispersion, fibres).expect("parameters")
}

pub(super) fn orthotropic() -> Stiffness {
    Stiffness::orthotropic(&wood(), &Matrix3::identity()).expect("parameters")
}

pub(super) fn ply() -> Stiffness {
    let constants = TransverseConstants {
        young_along: 8.0,
        young_across: 1.5,
        poisson_along: 0.3,
        poisson_across: 0.45,
        shear_along: 0.6,
    };
    Stiffness::transversely_isotropic(&constants, Fibre::new(FIBRE).expect("direction")).expect("parameters")
}

/// All laws that do not depend on the observer.
pub(super) fn objective(visitor: &mut impl Visitor) {
    let fibre = Fibre::new(FIBRE).expect("direction");
    let soft = Stiffness::orthotropic(
        &EngineeringConstants { young: [0.9, 0.5, 0.4], poisson: [0.3, 0.2, 0.25], shear: [0.2, 0.15, 0.3] },
        &Matrix3::identity(),
    );
    visitor.visit("Ogden", &Once(&ogden()), Group::All);
    visitor.visit("isochoric Ogden", &Once(&isochoric_ogden()), Group::All);
    visitor.visit("Hencky", &Once(&hencky()), Group::All);
    visitor.visit("Fung", &Once(&Fung::new(1.7, soft.expect("parameters")).expect("parameters")), Group::HalfTurns);
    visitor.visit("Holzapfel", &Once(&artery(0.0)), Group::HalfTurns);
    visitor.visit("dispersed Holzapfel", &Once(&artery(0.2)), Group::HalfTurns);
    let reinforced = ReinforcedNeoHookean::new(0.8, 1.1, 2.0, fibre).expect("parameters");
    visitor.visit("reinforced neo-Hookean", &Once(&reinforced), Group::About(fibre.direction()));
    visitor.visit("orthotropic", &Once(&AnisotropicSaintVenantKirchhoff::new(orthotropic())), Group::HalfTurns);
    visitor.visit("transverse", &Once(&AnisotropicSaintVenantKirchhoff::new(ply())), Group::About(fibre.direction()));
}

/// The linear laws too.
pub(super) fn all(visitor: &mut impl Visitor) {
    objective(visitor);
    visitor.visit("linear orthotropic", &Once(&AnisotropicLinear::new(orthotropic())), Group::HalfTurns);
}

/// F = R diag(λ) Q with stretches of 0.6 to 1.6.
pub(super) fn gradient() -> impl Strategy<Value = [[f64; 3]; 3]> {
    (rotation(), vector(3, 0.6..1.6), rotation()).prop_map(|(r, stretches, q)| {
        let (r, q) = (rotation_matrix(r), rotation_matrix(q));
        core::array::from_fn(|i| core::array::from_fn(|j| (0..3).map(|k| r[i][k] * stretches[k] * q[k][j]).sum()))
    })
}

/// The turn by an angle about a unit vector.
pub(super) fn turn(axis: [f64; 3], angle: f64) -> Matrix3<f64> {
    let (sine, cosine) = (0.5 * angle).sin_cos();
    let rows = rotation_matrix([cosine, sine * axis[0], sine * axis[1], sine * axis[2]]);
    Matrix3::from_fn(|i, j| rows[i][j])
}
