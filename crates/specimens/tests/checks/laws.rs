//! One of each kind of closed form by its own type: derivatives of the energy, homogeneous tests.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_solids::isochoric::Gent;
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    Compressible, ElasticConstants, Fibre, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden, LinearElastic,
    MooneyRivlin, OgdenTerm, SolidsError, derived,
};
use piola_specimens::checks::{Sampler, Search, Stored, baker_ericksen, hyperelasticity, noll};
use piola_specimens::homogeneous::{self, Mode, first_piola};
use piola_testkit::{Tol, assert_close_at_scale};

/// What is done with each law.
trait Visitor {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L);
}

const TERMS: [OgdenTerm; 2] = [OgdenTerm { modulus: 0.6, exponent: 1.3 }, OgdenTerm { modulus: -0.02, exponent: -2.0 }];

/// One of each kind of closed form.
fn some(visitor: &mut impl Visitor) -> Result<(), SolidsError> {
    visitor.visit("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 1.25)?);
    visitor.visit("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, Quadratic::new(5.0)?));
    visitor.visit("isochoric Ogden", &IsochoricOgden::new(&TERMS, 5.0)?);
    Ok(())
}

/// Two families of fibres that answer in tension only.
fn wall() -> Result<HolzapfelGasserOgden, SolidsError> {
    HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 1.0, 0.1, [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?])
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
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        let mut sampler = Sampler::new(9);
        for _ in 0..40 {
            let f = DeformationGradient::new(sampler.gradient(0.35)).expect("0 < det F");
            let p = derived::first_piola(law, &f).0;
            let (gradient, jacobian) = (*f.matrix(), f.jacobian());
            let tolerance = Tol::stated(1e-13, "stresses against exact derivatives of the energy");
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
    OneDerivation.visit("wall", &wall().expect("parameters"));
}

struct Tests;

impl Visitor for Tests {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
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
                let stress = first_piola(mode, at, law) * faces;
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
