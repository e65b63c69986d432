//! Reactions of internal constraints that faces free of traction determine.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, DisplacementGradient, FirstPiola};
use piola_numerics::Real;
use piola_solids::internal_constraints::{
    Combination, Constraints, Incompressibility, Inextensibility, InternalConstraint, Rigidity, StressCondition,
};
use piola_solids::{Fibre, Hyperelastic, MooneyRivlin, Pressurised, Response, SolidsError};
use piola_specimens::homogeneous::{Control, Controls, constrained_equilibrium, equilibrium};
use piola_tensor::FourthOrder;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const NEWTON: Tol = Tol::stated(1e-11, "end of the iteration");

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

fn cord(direction: [f64; 3]) -> Inextensibility {
    Inextensibility::along(Fibre::new(direction).expect("direction"))
}

/// The faces across axis 3 keep their area: by exact differentiation alone.
struct AreaOfPlane;

impl InternalConstraint for AreaOfPlane {
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let [x, y, z] = deformation.cofactor_rows().map(|row| row[2]);
        x * x + y * y + z * z - T::one()
    }
}

#[test]
fn incompressible_sheet_under_a_force_equals_the_law_with_a_pressure() {
    let controls = Controls::axial([Control::FirstPiola(0.8), Control::HELD, Control::FREE]).expect("controls");
    let start = DisplacementGradient::zero();
    let found = constrained_equilibrium(&rubber(), &Incompressibility, &controls, &start).expect("state");
    let expected = equilibrium(&Pressurised::new(rubber()), &controls, &start).expect("state");
    let (f, g) = (found.state.deformation.matrix(), expected.deformation.matrix());
    assert_close("∇u", f.as_slice(), g.as_slice(), NEWTON);
    let pressure = Incompressibility::pressure(found.multipliers[0], &found.state.deformation);
    assert_close("p", &[pressure], &[expected.pressure], NEWTON);
    assert_close_at_scale(
        "N",
        &found.reaction.0.components,
        &[-pressure, -pressure, -pressure, 0.0, 0.0, 0.0],
        1.0,
        NEWTON,
    );
    // The multiplier is the one that the same conditions give where the deformation is known.
    let at = &found.state.deformation;
    let combination = Combination::new([Incompressibility.at(at).expect("finite")]).expect("one");
    let face = StressCondition::traction_free([0.0, 0.0, 1.0]).expect("normal");
    let multipliers = combination.multipliers(&rubber().cauchy(at), &face).expect("determined");
    assert_close("λ", &multipliers, &found.multipliers, NEWTON);
}

#[test]
fn cord_takes_the_force_and_the_rest_is_sheared() {
    // A sheet with cords at an angle, pulled along 1, sides free: it shears until the cords have turned.
    let constraints = cord([1.0, 0.5, 0.0]);
    let (free, held) = (Control::FREE, Control::HELD);
    let pulled = Control::FirstPiola(0.5);
    let controls = Controls::new([[pulled, free, held], [held, free, held], [held, held, free]]).expect("controls");
    let found = constrained_equilibrium(&rubber(), &constraints, &controls, &DisplacementGradient::zero());
    let found = found.expect("state");
    let at = &found.state.deformation;
    assert_close_at_scale("μ", &[constraints.value(at)], &[0.0], 1.0, Tol::ulps(64.0));
    let stress = found.state.first_piola.0;
    let given = [stress[(0, 0)], stress[(0, 1)], stress[(1, 1)], stress[(2, 2)]];
    assert_close_at_scale("tractions", &given, &[0.5, 0.0, 0.0, 0.0], 1.0, NEWTON);
    assert!(1e-3 < at.matrix()[(0, 1)].abs(), "it shears");
    // T = law + N.
    let sum = rubber().cauchy(at).0 + found.reaction.0;
    assert_close("T", &found.state.cauchy.0.components, &sum.components, Tol::stated(1e-12, "sum of two stresses"));
}

#[test]
fn incompressible_body_with_a_cord_has_both_reactions() {
    let constraints = (Incompressibility, cord([1.0, 0.0, 0.0]));
    // Force along the cord; the faces across 2 are pressed: λ₁ = 1, λ₂ λ₃ = 1.
    let controls =
        Controls::axial([Control::FirstPiola(2.0), Control::FirstPiola(-0.6), Control::FREE]).expect("controls");
    let found = constrained_equilibrium(&rubber(), &constraints, &controls, &DisplacementGradient::zero());
    let found = found.expect("state");
    let f = found.state.deformation.gradient_rows();
    assert_close("λ₁, λ₂ λ₃", &[f[0][0], f[1][1] * f[2][2]], &[1.0, 1.0], Tol::ulps(64.0));
    // Pure shear in the plane 23: −P = 2 (C₁₀ + C₀₁)(λ⁻³ − λ).
    let x = f[1][1];
    assert_close("P₂₂", &[2.0 * 0.48 * (x - x.powi(-3))], &[-0.6], NEWTON);
    assert!(found.values_vanish(&constraints));
}

trait Vanish<C> {
    fn values_vanish(&self, constraints: &C) -> bool;
}

impl<C: Constraints<N>, const N: usize> Vanish<C> for piola_specimens::homogeneous::ConstrainedState<N> {
    fn values_vanish(&self, constraints: &C) -> bool {
        constraints.values(&self.state.deformation).iter().all(|x| x.abs() <= 64.0 * f64::EPSILON)
    }
}

#[test]
fn constraint_of_ones_own_needs_no_derivatives() {
    let controls = Controls::axial([Control::FirstPiola(0.7), Control::FREE, Control::FREE]).expect("controls");
    let found = constrained_equilibrium(&rubber(), &AreaOfPlane, &controls, &DisplacementGradient::zero());
    let found = found.expect("state");
    assert!(found.values_vanish(&AreaOfPlane) && found.state.residual <= 1e-12, "{found:?}");
    let f = found.state.deformation.gradient_rows();
    assert_close("λ₁ λ₂", &[f[0][0] * f[1][1]], &[1.0], Tol::ulps(64.0));
}

#[test]
fn rigid_body_carries_any_load_unmoved() {
    let controls = Controls::new([
        [Control::FirstPiola(1.0), Control::FirstPiola(0.3), Control::FirstPiola(0.1)],
        [Control::HELD, Control::FirstPiola(-2.0), Control::FirstPiola(0.2)],
        [Control::HELD, Control::HELD, Control::FirstPiola(0.5)],
    ])
    .expect("controls");
    let found = constrained_equilibrium(&rubber(), &Rigidity, &controls, &DisplacementGradient::zero());
    let found = found.expect("state");
    assert_close_at_scale("∇u", found.state.deformation.matrix().as_slice(), &[0.0; 9], 1.0, Tol::ulps(64.0));
    let expected = [1.0, -2.0, 0.5, 0.3, 0.2, 0.1];
    assert_close("N", &found.reaction.0.components, &expected, Tol::ulps(64.0));
}

#[test]
fn start_that_violates_a_constraint_is_brought_back() {
    let swollen = DisplacementGradient::diagonal([0.2, 0.1, 0.3]).expect("F");
    let controls = Controls::uniaxial(2.0).expect("controls");
    let found = constrained_equilibrium(&rubber(), &Incompressibility, &controls, &swollen).expect("state");
    let expected = constrained_equilibrium(&rubber(), &Incompressibility, &controls, &DisplacementGradient::zero());
    let expected = expected.expect("state");
    assert_close("P", &[found.state.first_piola.0[(0, 0)]], &[expected.state.first_piola.0[(0, 0)]], NEWTON);
}

/// A stress that is linear in ∇u and has no energy, as its tangent is not symmetric.
struct Linear(FourthOrder);

impl Response for Linear {
    fn admits(&self, _: &DisplacementGradient) -> Result<(), SolidsError> {
        Ok(())
    }
    fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
        let stress = self.0.contract(deformation.displacement_rows());
        (FirstPiola(Matrix3::from_fn(|i, j| stress[i][j])), FirstPiolaTangent(self.0))
    }
}

#[test]
fn a_bar_without_an_energy_contracts_as_its_tangent_says() {
    // P₁₁ = 4 u₁₁ + u₂₂ + u₃₃, P₂₂ = 2 u₁₁ + 4 u₂₂ …
    let mut c = FourthOrder::from_fn(|i, a, j, b| if (i, a) == (j, b) { 4.0 } else { 0.0 });
    (c.components[0][4], c.components[0][8], c.components[4][0], c.components[8][0]) = (1.0, 1.0, 2.0, 2.0);
    let controls = Controls::uniaxial(1.25).expect("a stretch");
    let bar = equilibrium(&Linear(c), &controls, &DisplacementGradient::zero()).expect("equilibrium");
    assert_eq!((bar.deformation.matrix()[(1, 1)], bar.first_piola.0[(0, 0)]), (-0.125, 0.75));
}
