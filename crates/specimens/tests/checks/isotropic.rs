//! Isotropic solids: undistorted references, the general elastic form, and Noll's form of those with memory.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::strain::GreenStrain;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::memory::{History, IsotropicForm, Prony, PronyTerm, Remembered, SimpleMaterial, Viscoelastic};
use piola_solids::{Hyperelastic, IsotropicResponse, IsotropicSolid, MooneyRivlin, ResponseForm};
use piola_specimens::checks::{
    ChangedReference, CrystalClass, Elastic, Search, SymmetryGroup, frame_indifference, history_indifference,
    history_symmetry, hyperelasticity, material_symmetry,
};

fn search() -> Search {
    Search { samples: 100, ..Search::default() }
}

/// An isotropic solid without an energy, in one of the four forms.
struct General(ResponseForm);

impl IsotropicSolid for General {
    fn response<T: Real>(&self, [first, second, third]: [T; 3]) -> IsotropicResponse<T> {
        let c = T::lit;
        let coefficients =
            [c(0.3) * third.ln() - c(0.2) * first, c(0.5) + c(0.1) * second, c(0.4) * first.sqrt() - c(0.6)];
        IsotropicResponse { form: self.0, coefficients }
    }
}

fn elastic(solid: &impl IsotropicSolid) -> impl Elastic {
    |f: &Matrix3<f64>| {
        DeformationGradient::new(*f).map_or_else(|_| Matrix3::from_element(f64::NAN), |f| solid.cauchy(&f).0.matrix())
    }
}

#[test]
fn response_functions_of_every_form_make_isotropic_solids_and_not_all_of_them_have_an_energy() {
    for form in [ResponseForm::Stretch, ResponseForm::Square, ResponseForm::Inverse, ResponseForm::Mixed] {
        let solid = General(form);
        let law = elastic(&solid);
        assert!(frame_indifference(&law, &search()).passes(), "{form:?}");
        assert!(material_symmetry(&law, &SymmetryGroup::isotropic(), &search()).passes(), "{form:?}");
        assert!(!hyperelasticity(&law, &search()).passes(), "{form:?}");
        // In an undistorted reference, the stress is a pressure.
        let rest = law.cauchy(&Matrix3::identity());
        let pressure = Matrix3::identity() * (rest.trace() / 3.0);
        assert!((rest - pressure).norm() < 8.0 * f64::EPSILON, "{form:?}: {rest}");
    }
}

#[test]
fn a_reference_is_undistorted_if_and_only_if_it_differs_by_a_similarity() {
    let rubber = MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters");
    let isotropic = SymmetryGroup::isotropic();
    let turned = *nalgebra::Rotation3::new(Vector3::new(0.3, -0.7, 0.2)).matrix();
    let sheared = Matrix3::new(1.0, 0.4, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let changes =
        [(turned * 1.3, true), (sheared, false), (Matrix3::from_diagonal(&Vector3::new(1.3, 1.0, 1.0)), false)];
    for (change, undistorted) in changes {
        let told = ChangedReference::new(
            |f: &Matrix3<f64>| {
                DeformationGradient::new(*f)
                    .map_or_else(|_| Matrix3::from_element(f64::NAN), |f| rubber.cauchy(&f).0.matrix())
            },
            &DeformationGradient::new(change).expect("0 < det K"),
        );
        let group = isotropic.under(&change).expect("regular");
        assert!(material_symmetry(&told, &group, &search()).passes());
        assert_eq!(material_symmetry(&told, &isotropic, &search()).passes(), undistorted);
        assert_eq!(group.distortion(100, 3) < 1e-13, undistorted);
        // Only there the stress of the reference is a pressure.
        let rest = told.cauchy(&Matrix3::identity());
        let deviator = (rest - Matrix3::identity() * (rest.trace() / 3.0)).norm();
        assert_eq!(deviator < 1e-13 * rest.norm(), undistorted, "{rest}");
    }
    for class in CrystalClass::ALL {
        assert!(SymmetryGroup::crystal(class).distortion(0, 1) < 1e-14, "{class:?}");
    }
    assert!(0.1 < SymmetryGroup::fluid().distortion(100, 1));
}

/// Uₜ(t − s) and V(t) of a history Uₜ(t − s) V(t).
fn parts(history: &dyn History, elapsed: f64) -> (Matrix3<f64>, Matrix3<f64>) {
    let left = history.gradient(0.0);
    let inverse = left.try_inverse().unwrap_or_else(|| Matrix3::from_element(f64::NAN));
    (history.gradient(elapsed) * inverse, left)
}

/// G = V + Uₜ² V² + V² Uₜ² half a second and a second ago.
struct Isotropic;

impl SimpleMaterial for Isotropic {
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        let mut stress = history.gradient(0.0);
        for (elapsed, weight) in [(0.5, 0.4), (1.0, -0.3)] {
            let (relative, left) = parts(history, elapsed);
            let product = relative * relative * left * left;
            stress += (product + product.transpose()) * weight;
        }
        stress
    }
}

/// G = V + (n·Uₜ n) n ⊗ n: a direction of space is preferred.
struct Preferring;

impl SimpleMaterial for Preferring {
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        let (relative, left) = parts(history, 1.0);
        let n = Vector3::z();
        left + n * n.transpose() * n.dot(&(relative * n))
    }
}

#[test]
fn isotropic_functionals_of_relative_stretches_are_isotropic_solids_and_others_are_not_indifferent() {
    let isotropic = SymmetryGroup::isotropic();
    let form = IsotropicForm(Isotropic);
    assert!(history_indifference(&form, 1.0, &search()).passes());
    assert!(history_symmetry(&form, &isotropic, 1.0, &search()).passes());
    // It is no fluid: it feels changes of the reference that are no rotations.
    assert!(!history_symmetry(&form, &SymmetryGroup::fluid(), 1.0, &search()).passes());
    let preferring = IsotropicForm(Preferring);
    assert!(history_symmetry(&preferring, &isotropic, 1.0, &search()).passes());
    let refuted = history_indifference(&preferring, 1.0, &search());
    assert!(1e-2 < refuted.size, "{refuted:?}");
}

/// S = λ tr E 1 + 2 μ E + k `E_ff` f ⊗ f with a fibre f along e₃.
#[derive(Clone)]
struct Fibred(f64);

impl Hyperelastic for Fibred {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let (trace, along) = (strain.trace(), strain.components[2]);
        T::lit(0.5) * (trace * trace + T::lit(self.0) * along * along) + strain.double_contraction(&strain)
    }
}

#[test]
fn viscoelastic_solids_of_isotropic_laws_equal_their_form_by_relative_stretches_and_fibred_ones_do_not() {
    let series = || Prony::new(vec![PronyTerm { weight: 0.5, time: 0.7 }]).expect("series");
    let (plain, fibred) = (
        Viscoelastic::relaxing(Fibred(0.0), series()).expect("sum below 1"),
        Viscoelastic::relaxing(Fibred(2.0), series()).expect("sum below 1"),
    );
    let plain = Remembered::new(&plain, 4.0, 40).expect("positive");
    let fibred = Remembered::new(&fibred, 4.0, 40).expect("positive");
    let isotropic = SymmetryGroup::isotropic();
    assert!(history_symmetry(&plain, &isotropic, 1.0, &search()).passes());
    assert!(!history_symmetry(&fibred, &isotropic, 1.0, &search()).passes());
    let about = SymmetryGroup::transversely_isotropic([0.0, 0.0, 1.0]).expect("an axis");
    assert!(history_symmetry(&fibred, &about, 1.0, &search()).passes());
    let spinning = |elapsed: f64| {
        let turn = nalgebra::Rotation3::new(Vector3::new(0.4, -1.0, 0.3) * elapsed).into_inner();
        turn * Matrix3::new(1.2 - 0.1 * elapsed, 0.3, 0.0, 0.0, 0.9, 0.1 * elapsed, 0.1, 0.0, 1.1)
    };
    let stress = plain.cauchy(&spinning);
    let form = IsotropicForm(plain).cauchy(&spinning);
    // Forty steps, each with a polar decomposition of a condition of 2.
    assert!((form - stress).norm() < 1e-12 * stress.norm(), "{form} {stress}");
    let stress = fibred.cauchy(&spinning);
    assert!(1e-3 * stress.norm() < (IsotropicForm(fibred).cauchy(&spinning) - stress).norm());
}
