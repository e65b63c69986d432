//! The checks run over every law.

use nalgebra::Matrix3;
use piola_constitutive::ConstitutiveError;
use piola_constitutive::checks::{
    Sampler, Search, Stored, SymmetryGroup, baker_ericksen, hyperelasticity, material_symmetry, noll, potential,
};
use piola_constitutive::homogeneous::{self, Mode, nominal_stress};
use piola_constitutive::solids::isochoric::{self, ArrudaBoyce, Gent, Yeoh};
use piola_constitutive::solids::volumetric::{Logarithmic, Quadratic};
use piola_constitutive::solids::{
    AnisotropicSaintVenantKirchhoff, BlatzKo, Compressible, ElasticConstants, EngineeringConstants, Fibre, Fung,
    Hencky, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden, LinearElastic, MooneyRivlin, NeoHookeanCiarlet,
    NeoHookeanLogarithmic, Ogden, OgdenTerm, ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness, derived,
};
use piola_continuum::{Deformation, DeformationGradient};
use piola_testkit::{Tol, assert_close_at_scale};

/// What is done with each law and its group.
trait Visitor {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, group: &SymmetryGroup);
}

const TERMS: [OgdenTerm; 2] = [OgdenTerm { mu: 0.6, alpha: 1.3 }, OgdenTerm { mu: -0.02, alpha: -2.0 }];

fn isotropic(visitor: &mut impl Visitor) -> Result<(), ConstitutiveError> {
    let group = SymmetryGroup::isotropic();
    let mooney = isochoric::MooneyRivlin::new(0.5, 0.25)?;
    visitor.visit("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 1.25)?, &group);
    visitor.visit("Mooney–Rivlin, logarithmic", &Compressible::new(mooney, Logarithmic::new(5.0)?), &group);
    visitor.visit("Yeoh", &Compressible::new(Yeoh::new(0.5, -0.05, 0.01)?, Quadratic::new(5.0)?), &group);
    visitor.visit("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, Quadratic::new(5.0)?), &group);
    visitor.visit("Arruda–Boyce", &Compressible::new(ArrudaBoyce::new(0.8, 9.0)?, Quadratic::new(5.0)?), &group);
    visitor.visit("neo-Hookean of ln J", &NeoHookeanLogarithmic::with_constants(0.8, 3.0)?, &group);
    visitor.visit("neo-Hookean of Ciarlet", &NeoHookeanCiarlet::with_constants(0.8, 3.0)?, &group);
    visitor.visit("Saint-Venant–Kirchhoff", &SaintVenantKirchhoff::new(1.5, 0.75)?, &group);
    visitor.visit("Blatz–Ko", &BlatzKo::new(0.8, 0.4, 0.7)?, &group);
    visitor.visit("Ogden", &Ogden::new(&TERMS, 2.0)?, &group);
    visitor.visit("isochoric Ogden", &IsochoricOgden::new(&TERMS, 5.0)?, &group);
    visitor.visit("Hencky", &Hencky::new(1.5, 0.75)?, &group);
    Ok(())
}

/// One of each kind of closed form.
fn some(visitor: &mut impl Visitor) -> Result<(), ConstitutiveError> {
    let group = SymmetryGroup::isotropic();
    visitor.visit("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 1.25)?, &group);
    visitor.visit("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, Quadratic::new(5.0)?), &group);
    visitor.visit("isochoric Ogden", &IsochoricOgden::new(&TERMS, 5.0)?, &group);
    Ok(())
}

fn anisotropic(visitor: &mut impl Visitor) -> Result<(), ConstitutiveError> {
    let axis = [0.6, 0.0, 0.8];
    let about = SymmetryGroup::transversely_isotropic(axis)?;
    visitor.visit("reinforced", &ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new(axis)?)?, &about);
    let wood = EngineeringConstants { young: [12.0, 1.0, 0.5], poisson: [0.3, 0.2, 0.25], shear: [0.8, 0.1, 0.7] };
    let stiffness = Stiffness::orthotropic(&wood, &Matrix3::identity())?;
    let orthotropic = SymmetryGroup::orthotropic();
    visitor.visit("orthotropic", &AnisotropicSaintVenantKirchhoff::new(stiffness), &orthotropic);
    visitor.visit("Fung", &Fung::new(0.5, stiffness)?, &orthotropic);
    Ok(())
}

/// Two families of fibres that answer in tension only.
fn wall() -> Result<HolzapfelGasserOgden, ConstitutiveError> {
    HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 1.0, 0.1, [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?])
}

struct Claims {
    samples: usize,
    circuits: f64,
}

impl Visitor for Claims {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, group: &SymmetryGroup) {
        let search = Search { samples: self.samples, strain: 0.35, ..Search::default() };
        let report = noll(law, &search);
        assert!(report.agrees() && report.passes(), "{name}: {report:?}");
        let report = material_symmetry(&Stored(law), group, &search);
        assert!(report.passes(), "{name}: {report:?}");
        let search = Search { samples: self.samples / 4, strain: 0.25, tolerance: self.circuits, ..search };
        let report = hyperelasticity(&Stored(law), &search);
        assert!(report.passes(), "{name}: {report:?}");
        let f = DeformationGradient::new(Sampler::new(4).gradient(0.3)).expect("0 < det F");
        let found = potential(&Stored(law), &f);
        let tolerance = Tol::stated(self.circuits, "quadrature along a path");
        assert_close_at_scale(&format!("{name}: W"), &[found.energy], &[law.energy(&f)], 1.0, tolerance);
    }
}

#[test]
fn every_law_keeps_nolls_claims_its_group_and_its_energy() {
    isotropic(&mut Claims { samples: 60, circuits: 1e-10 }).expect("parameters");
    anisotropic(&mut Claims { samples: 60, circuits: 1e-10 }).expect("parameters");
    // Where fibres slacken the stress has a kink, which the quadrature feels.
    let mut claims = Claims { samples: 60, circuits: 1e-3 };
    claims.visit("wall", &wall().expect("parameters"), &SymmetryGroup::orthotropic());
}

#[test]
fn infinitesimal_law_is_refuted_at_finite_strain() {
    // W = ½ ε : C : ε depends on the observer: Noll's claims fail together.
    let law = LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75).expect("constants")).expect("law");
    let report = noll(&law, &Search { samples: 60, ..Search::default() });
    assert!(report.agrees() && !report.passes(), "{report:?}");
    // But it has an energy.
    assert!(hyperelasticity(&Stored(&law), &Search { samples: 30, ..Search::default() }).passes());
}

struct OneDerivation;

impl Visitor for OneDerivation {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: &SymmetryGroup) {
        let mut sampler = Sampler::new(9);
        for _ in 0..40 {
            let f = DeformationGradient::new(sampler.gradient(0.35)).expect("0 < det F");
            let p = derived::first_piola(law, &f).0;
            let (gradient, jacobian) = (*f.matrix(), f.jacobian());
            let tolerance = Tol::stated(1e-12, "stresses against exact derivatives of the energy");
            let close = |what: &str, actual: &[f64], expected: Matrix3<f64>| {
                let scale = 1.0 + p.norm();
                assert_close_at_scale(&format!("{name}: {what}"), actual, expected.as_slice(), scale, tolerance);
            };
            close("P = ∂W/∂F", law.first_piola(&f).0.as_slice(), p);
            let inverse = gradient.try_inverse().expect("F⁻¹");
            close("S = F⁻¹ P", law.second_piola(&f).0.matrix().as_slice(), inverse * p);
            close("τ = P Fᵀ", law.kirchhoff(&f).0.matrix().as_slice(), p * gradient.transpose());
            close("T = P Fᵀ/J", law.cauchy(&f).0.matrix().as_slice(), p * gradient.transpose() / jacobian);
        }
    }
}

#[test]
fn stresses_are_one_derivative_of_the_energy() {
    some(&mut OneDerivation).expect("parameters");
    OneDerivation.visit("wall", &wall().expect("parameters"), &SymmetryGroup::orthotropic());
}

struct Tests;

impl Visitor for Tests {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: &SymmetryGroup) {
        for stretch in [0.8, 1.0 + 1e-9, 1.3, 1.8] {
            for state in [
                homogeneous::uniaxial(law, stretch),
                homogeneous::equibiaxial(law, stretch),
                homogeneous::planar(law, stretch),
                homogeneous::simple_shear(law, stretch - 1.0, true),
            ] {
                let state = state.unwrap_or_else(|error| panic!("{name} at {stretch}: {error}"));
                assert_close_at_scale(name, &[state.first_piola.0[(2, 2)]], &[0.0], 1.0, Tol::stated(1e-11, "Newton"));
            }
            // The incompressible body of the same energy: the derivative of the energy along the path.
            for mode in Mode::ALL {
                let at = if mode == Mode::SimpleShear { stretch - 1.0 } else { stretch };
                let energy = |x: f64| {
                    let f = match mode {
                        Mode::SimpleShear => DeformationGradient::simple_shear(x),
                        _ => DeformationGradient::diagonal(mode.elongations(x).map(|e| 1.0 + e)),
                    };
                    law.energy(&f.expect("0 < det F"))
                };
                let difference = |h: f64| (energy(at + h) - energy(at - h)) / (2.0 * h);
                let slope = (4.0 * difference(1e-3) - difference(2e-3)) / 3.0;
                let faces = if mode == Mode::Equibiaxial { 2.0 } else { 1.0 };
                let stress = nominal_stress(mode, at, law) * faces;
                let tolerance = Tol::stated(1e-9, "differences of fourth order, h = 1e-3");
                assert_close_at_scale(&format!("{name} {}", mode.name()), &[stress], &[slope], 5.0, tolerance);
            }
        }
        assert!(baker_ericksen(law, &Search { strain: 0.1, ..Search::default() }).passes(), "{name}");
    }
}

#[test]
fn homogeneous_tests_leave_free_faces_free_and_follow_the_energy() {
    some(&mut Tests).expect("parameters");
}
