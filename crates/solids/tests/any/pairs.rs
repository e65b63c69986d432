//! Stresses and tangents asked for together equal those asked for apart, and share their work.

use core::cell::Cell;

use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::SolidsError;
use piola_solids::isochoric::{Gent, Isochoric};
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, Hyperelastic};
use piola_tensor::PairSymmetric;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::laws::{all, gradient, largest};

const TOGETHER: Tol = Tol::stated(1e-13, "two orders of the same sums, relative to the moduli");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn stress_and_tangent_together_equal_those_apart(rows in gradient()) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let inverse = largest(f.inverse_rows().as_flattened());
        for (law, _) in all() {
            let (first_piola, tangent) = law.first_piola_and_tangent(&f);
            let moduli = largest(tangent.0.components.as_flattened());
            let close = |what: &str, actual: &[f64], expected: &[f64], scale: f64| {
                assert_close_at_scale(&format!("{law:?}: {what} at {f:?}"), actual, expected, scale, TOGETHER);
            };
            close("P", first_piola.0.as_slice(), law.first_piola(&f).0.as_slice(), moduli);
            let energy = law.energy(&f);
            let (with_stress, stress) = law.energy_and_first_piola(&f);
            let (with_both, again, whole) = law.energy_first_piola_and_tangent(&f);
            // An energy is of second order in the strain, or of that of its reference with stress.
            let strain = largest(&kernels::green(f.displacement_rows()).components);
            let work = moduli * strain * (strain + largest(&law.reference_stress().components) / moduli);
            close("W with P", &[with_stress], &[energy], work);
            close("W with both", &[with_both], &[energy], work);
            close("P with W", stress.0.as_slice(), first_piola.0.as_slice(), moduli);
            close("P with W and ∂P/∂F", again.0.as_slice(), first_piola.0.as_slice(), moduli);
            let (whole, together) = (whole.0.components, tangent.0.components);
            close("∂P/∂F with W", whole.as_flattened(), together.as_flattened(), moduli);
            let apart = law.first_piola_tangent(&f).0.components;
            close("∂P/∂F", tangent.0.components.as_flattened(), apart.as_flattened(), moduli);
            let (stress, tangent) = law.second_piola_and_tangent(&f);
            close("S", &stress.0.components, &law.second_piola(&f).0.components, moduli * inverse);
            let apart = law.material_tangent(&f).0.slots();
            close("∂S/∂E", tangent.0.slots().as_flattened(), apart.as_flattened(), moduli * inverse * inverse);
            let (stress, tangent) = law.cauchy_and_tangent(&f);
            close("T", &stress.0.components, &law.cauchy(&f).0.components, moduli * 4.0);
            let apart = law.truesdell_tangent(&f).0.slots();
            close("c/J", tangent.0.slots().as_flattened(), apart.as_flattened(), moduli * 4.0);
        }
    }
}

/// Counts how often its slopes and curvatures are asked for.
#[derive(Clone)]
struct Counted {
    law: Gent,
    slopes: Cell<usize>,
    curvatures: Cell<usize>,
}

impl Isochoric for Counted {
    const SECOND: bool = Gent::SECOND;
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        self.law.energy(first, second)
    }
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        self.slopes.set(self.slopes.get() + 1);
        self.law.slopes(first, second)
    }
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        self.curvatures.set(self.curvatures.get() + 1);
        self.law.curvatures(first, second)
    }
}

#[test]
fn slopes_and_curvatures_are_evaluated_once_and_curvatures_only_for_a_tangent() -> Result<(), SolidsError> {
    let counted = Counted { law: Gent::new(0.8, 30.0)?, slopes: Cell::new(0), curvatures: Cell::new(0) };
    let law = Compressible::new(counted, Quadratic::new(5.0)?);
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F");
    let counts = |ask: &dyn Fn()| {
        let part = law.isochoric();
        part.slopes.set(0);
        part.curvatures.set(0);
        ask();
        (part.slopes.get(), part.curvatures.get())
    };
    assert_eq!(counts(&|| _ = law.energy(&f)), (0, 0));
    assert_eq!(counts(&|| _ = law.first_piola(&f)), (1, 0));
    assert_eq!(counts(&|| _ = law.cauchy(&f)), (1, 0));
    assert_eq!(counts(&|| _ = law.first_piola_tangent(&f)), (1, 1));
    assert_eq!(counts(&|| _ = law.first_piola_and_tangent(&f)), (1, 1));
    assert_eq!(counts(&|| _ = law.energy_and_first_piola(&f)), (1, 0));
    assert_eq!(counts(&|| _ = law.energy_first_piola_and_tangent(&f)), (1, 1));
    assert_eq!(counts(&|| _ = law.second_piola_and_tangent(&f)), (1, 1));
    assert_eq!(counts(&|| _ = law.cauchy_and_tangent(&f)), (1, 1));
    Ok(())
}

/// A law of its energy alone that counts how often it is asked.
#[derive(Clone)]
struct EnergyAlone {
    asked: Cell<usize>,
}

impl Hyperelastic for EnergyAlone {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.asked.set(self.asked.get() + 1);
        let (f, jacobian) = (deformation.gradient_rows(), deformation.jacobian());
        let square = f.as_flattened().iter().fold(T::zero(), |sum, &x| sum + x * x);
        T::lit(0.5) * (square - T::lit(3.0)) - jacobian.ln() + T::lit(2.0) * jacobian.ln() * jacobian.ln()
    }
}

#[test]
fn an_energy_alone_is_asked_no_more_for_stress_and_tangent_than_for_the_tangent() {
    let law = EnergyAlone { asked: Cell::new(0) };
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F");
    let count = |ask: &dyn Fn()| {
        law.asked.set(0);
        ask();
        law.asked.get()
    };
    assert_eq!(count(&|| _ = law.first_piola(&f)), 1);
    assert_eq!(count(&|| _ = law.first_piola_tangent(&f)), 9);
    assert_eq!(count(&|| _ = law.first_piola_and_tangent(&f)), 9);
    assert_eq!(count(&|| _ = law.energy_and_first_piola(&f)), 1);
    assert_eq!(count(&|| _ = law.energy_first_piola_and_tangent(&f)), 9);
    let energy: f64 = law.energy(&f);
    assert_eq!(law.energy_and_first_piola(&f).0.to_bits(), energy.to_bits());
    assert_eq!(count(&|| _ = law.material_tangent(&f)), 9);
    assert_eq!(count(&|| _ = law.second_piola_and_tangent(&f)), 9);
    assert_eq!(count(&|| _ = law.truesdell_tangent(&f)), 9);
    assert_eq!(count(&|| _ = law.cauchy_and_tangent(&f)), 9);
    let (stress, tangent) = law.first_piola_and_tangent(&f);
    // The same evaluation over dual numbers: a rounding or none.
    assert_close_at_scale("P", stress.0.as_slice(), law.first_piola(&f).0.as_slice(), 1.0, TOGETHER);
    assert_eq!(tangent, law.first_piola_tangent(&f));
}
