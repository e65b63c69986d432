//! An elastic law by its S and ∂S/∂E gives the stresses, states and tangents of the law itself.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient};
use piola_inelastic::{
    ByTangent, DrivenGrowth, Evolution, InSeries, InelasticPoint, Kinematic, Mullins, ReeseGovindjee, StepControl,
    Viscoplastic,
};
use piola_numerics::{Dual, Gradient, Real as _};
use piola_solids::{Hencky, Hyperelastic, NeoHookeanCiarlet};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

/// Two increments of both laws.
fn compare<A: Evolution<S, X>, B: Evolution<S, X>, const S: usize, const X: usize>(
    what: &str,
    law: &A,
    by_tangent: &B,
) -> Fallible {
    let rows = [
        [[1.2, 0.25, 0.0], [0.0, 0.9, 0.1], [0.05, 0.0, 1.05]],
        [[1.3, 0.1, 0.05], [0.1, 0.95, 0.0], [0.0, 0.15, 1.1]],
    ];
    let (mut one, mut other) = (InelasticPoint::new(law), InelasticPoint::new(by_tangent));
    for control in [StepControl::one_step(), StepControl::new(1e-9)?] {
        for rows in rows {
            let f = DeformationGradient::from_rows(rows)?;
            let (a, b) = (one.advance(&f, 0.25, &control)?, other.advance(&f, 0.25, &control)?);
            let tol = Tol::stated(1e-11, "Newton's method ends at 1e-15 of a strain, and steps are extrapolated");
            assert_close_at_scale(what, b.first_piola.0.as_slice(), a.first_piola.0.as_slice(), 1.0, tol);
            assert_close(what, &b.state, &a.state, tol);
            let (a, b) = (a.tangent.0.components, b.tangent.0.components);
            let tol = Tol::stated(1e-9, "derivatives through extrapolated steps");
            assert_close_at_scale(what, b.as_flattened(), a.as_flattened(), 10.0, tol);
        }
    }
    Ok(())
}

#[test]
fn laws_with_history_by_the_tangents_of_their_springs_are_the_laws_themselves() -> Fallible {
    let (rest, spring) = (NeoHookeanCiarlet::with_constants(1.0, 5.0)?, NeoHookeanCiarlet::with_constants(2.0, 8.0)?);
    let metal = Hencky::new(3.0, 2.0)?;
    let hardening =
        piola_inelastic::Hardening { yield_stress: 0.25, linear: 0.125, saturation: 0.5, saturation_exponent: 4.0 };
    let law = ReeseGovindjee::new(rest, spring, 0.75)?.with_bulk_viscosity(3.0)?;
    let other = ReeseGovindjee::new(ByTangent(rest), ByTangent(spring), 0.75)?.with_bulk_viscosity(3.0)?;
    compare("Reese–Govindjee", &law, &other)?;
    let other = InSeries::new(ByTangent(rest), ByTangent(spring), 0.5)?;
    compare("in series", &InSeries::new(rest, spring, 0.5)?, &other)?;
    let other = Viscoplastic::new(ByTangent(metal), hardening, 0.5)?;
    compare("viscoplastic", &Viscoplastic::new(metal, hardening, 0.5)?, &other)?;
    let other = Kinematic::new(ByTangent(metal), ByTangent(spring), hardening, 0.25, 0.5)?;
    compare("kinematic", &Kinematic::new(metal, spring, hardening, 0.25, 0.5)?, &other)?;
    let other = Mullins::new(ByTangent(rest), 2.0, 0.25, 0.125)?;
    compare("Mullins", &Mullins::new(rest, 2.0, 0.25, 0.125)?, &other)?;
    let other = DrivenGrowth::new(ByTangent(rest), 0.5, [0.5, 2.0], 2.0)?;
    compare("driven growth", &DrivenGrowth::new(rest, 0.5, [0.5, 2.0], 2.0)?, &other)
}

/// Numbers with second derivatives go through the law itself, those with first derivatives by the chain rule: the same energy.
#[test]
fn energies_and_their_derivatives_of_any_order_are_those_of_the_law() -> Fallible {
    let law = NeoHookeanCiarlet::with_constants(1.0, 5.0)?;
    let f = DeformationGradient::from_rows([[1.2, 0.25, 0.0], [0.0, 0.9, 0.1], [0.05, 0.0, 1.05]])?;
    let first = f.lifted(|i, j, x| Gradient::<f64, 9>::variable(x, 3 * i + j));
    let (a, b) = (law.energy(&first), ByTangent(law).energy(&first));
    assert_close("W", &[b.value], &[a.value], Tol::ulps(8.0));
    assert_close_at_scale("P", &b.partials, &a.partials, 1.0, Tol::ulps(64.0));
    let second = f.lifted(|i, j, x| Dual::new(Dual::variable(x), Dual::lit(f64::from(u8::from(i == j)))));
    assert_eq!(law.energy(&second), ByTangent(law).energy(&second));
    let pair = (ByTangent(law).energy_and_first_piola(&f), law.energy_and_first_piola(&f));
    assert_close("W and P", pair.0.1.0.as_slice(), pair.1.1.0.as_slice(), Tol::ulps(64.0));
    assert_close("τ", &ByTangent(law).kirchhoff(&f).0.components, &law.kirchhoff(&f).0.components, Tol::ulps(64.0));
    Ok(())
}
