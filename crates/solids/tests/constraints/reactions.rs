//! Reactions of constraints against references, and what no constraint may do.

use nalgebra::Matrix3;
use piola_continuum::rates::VelocityGradient;
use piola_continuum::strain::{LeftCauchyGreen, RightCauchyGreen};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_solids::Fibre;
use piola_solids::SolidsError;
use piola_solids::internal_constraints::{
    Combination, Incompressibility, Inextensibility, InternalConstraint, MetricConstraint, OfMetric, Restriction,
    Rigidity, StressCondition,
};
use piola_testkit::strategies::{random_cases, rotation, rotation_matrix, unit_vector, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use proptest::prelude::*;
use serde_json::Value;

const REFERENCE: Tol = Tol::ulps(16.0);

/// F = R diag(λ) Q with stretches of 0.6 to 1.6.
fn gradient() -> impl Strategy<Value = [[f64; 3]; 3]> {
    (rotation(), vector(3, 0.6..1.6), rotation()).prop_map(|(r, stretches, q)| {
        let (r, q) = (rotation_matrix(r), rotation_matrix(q));
        core::array::from_fn(|i| core::array::from_fn(|j| (0..3).map(|k| r[i][k] * stretches[k] * q[k][j]).sum()))
    })
}

fn deformation(case: &Value) -> DeformationGradient {
    let rows = golden::matrix(&case["input"]["F"]);
    DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))).expect("0 < det F")
}

fn cases(kind: &str) -> Vec<Value> {
    let cases: Vec<Value> =
        golden::load("constraints").cases.into_iter().filter(|case| golden::text(&case["kind"]) == kind).collect();
    assert!(2 < cases.len(), "{kind}");
    cases
}

fn three(value: &Value) -> [f64; 3] {
    golden::vector(value).try_into().expect("three components")
}

fn check(case: &Value, name: &str, actual: &[f64]) {
    let value = &case["output"][name];
    let expected = if value.is_number() { vec![golden::number(value)] } else { golden::matrix(value).concat() };
    assert_close_at_scale(&format!("{}: {name}", golden::text(&case["id"])), actual, &expected, 0.1, REFERENCE);
}

fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

/// The same constraint without what it overrides.
struct Derived<C>(C);

impl<C: InternalConstraint> InternalConstraint for Derived<C> {
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.value(deformation)
    }
}

fn check_scalar(case: &Value, constraint: &impl InternalConstraint) {
    let f = deformation(case);
    let multiplier = golden::number(&case["input"]["lambda"]);
    check(case, "mu", &[constraint.value(&f)]);
    check(case, "dmu_dF", constraint.gradient(&f).transpose().as_slice());
    check(case, "N", &nine(&constraint.reaction(&f, multiplier).0));
    let combination = Combination::new([constraint.at(&f).expect("objective")]).expect("one");
    check(case, "N", &nine(&combination.reaction([multiplier]).0));
}

#[test]
fn reaction_of_incompressibility_equals_reference() {
    for case in cases("incompressible") {
        check_scalar(&case, &Incompressibility);
        check_scalar(&case, &Derived(Incompressibility));
    }
}

fn cord(case: &Value) -> Fibre {
    Fibre::new(three(&case["input"]["e_dir"])).expect("direction")
}

/// |F e|² − 1 of C.
struct Length(Fibre);

impl MetricConstraint for Length {
    fn value<T: Real>(&self, metric: &RightCauchyGreen<T>) -> T {
        let structure = Symmetric { components: self.0.structure().components.map(T::lit) };
        metric.0.double_contraction(&structure) - T::one()
    }
}

#[test]
fn reaction_of_inextensibility_equals_reference() {
    for case in cases("inextensible") {
        let cord = cord(&case);
        check_scalar(&case, &Inextensibility::along(cord));
        check_scalar(&case, &Derived(Inextensibility::along(cord)));
        check_scalar(&case, &OfMetric(Length(cord)));
        check_scalar(&case, &Derived(OfMetric(Length(cord))));
    }
}

#[test]
fn reaction_of_rigidity_equals_reference() {
    for case in cases("rigid") {
        let f = deformation(&case);
        let rows = golden::matrix(&case["input"]["lambda"]);
        let multiplier = Symmetric::upper_triangle(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])));
        check(&case, "mu", &nine(&Rigidity.value(&f)));
        check(&case, "dmu_dF_contracted", Rigidity.gradient(&f, &multiplier).transpose().as_slice());
        let reaction = Rigidity.reaction(&f, &multiplier);
        check(&case, "N", &nine(&reaction.0));
        let combination = Combination::new(Rigidity.at(&f).expect("finite")).expect("independent");
        let [a, b, c, d, e, g] = multiplier.components;
        check(&case, "N", &nine(&combination.reaction([a, b, c, 2.0 * d, 2.0 * e, 2.0 * g]).0));
        let back = Rigidity.multiplier(&reaction, &f);
        assert_close("Λ", &back.components, &multiplier.components, Tol::stated(1e-13, "F⁻¹ N F⁻ᵀ"));
    }
}

/// 2 C₁₀ B − 2 C₀₁ B⁻¹.
fn extra_stress(case: &Value, f: &DeformationGradient) -> CauchyStress {
    let (c10, c01) = (golden::number(&case["input"]["c10"]), golden::number(&case["input"]["c01"]));
    let left = LeftCauchyGreen::of(f).0;
    CauchyStress(left * (2.0 * c10) - left.inverse().expect("positive definite") * (2.0 * c01))
}

fn pressure_and_tension(case: &Value, f: &DeformationGradient) -> Combination<2> {
    let tension = Inextensibility::along(cord(case));
    Combination::new([Incompressibility.at(f).expect("objective"), tension.at(f).expect("objective")])
        .expect("independent")
}

#[test]
fn stress_of_an_incompressible_inextensible_solid_equals_reference() {
    for case in cases("mooney_rivlin_incompressible_inextensible") {
        let f = deformation(&case);
        let constraints = pressure_and_tension(&case, &f);
        constraints.check_satisfied(1e-15).expect("on the constraint");
        let multipliers = [-golden::number(&case["input"]["p"]), 0.5 * golden::number(&case["input"]["q"])];
        let extra = extra_stress(&case, &f);
        check(&case, "extra_stress", &nine(&extra.0));
        check(&case, "reaction", &nine(&constraints.reaction(multipliers).0));
        let stress = constraints.stress(&extra, multipliers);
        check(&case, "T", &nine(&stress.0));
        check(&case, "P", stress.first_piola(&f).0.transpose().as_slice());
    }
}

#[test]
fn multipliers_from_a_face_and_a_fibre_equal_reference() {
    for case in cases("solve_multipliers") {
        let f = deformation(&case);
        let constraints = pressure_and_tension(&case, &f);
        let extra = extra_stress(&case, &f);
        let input = |name: &str| golden::number(&case["input"][name]);
        let face = StressCondition::normal_traction(three(&case["input"]["n_dir"]), input("tn")).expect("finite");
        let fibre = StressCondition::along_fibre(cord(&case), &f, input("fibre_stress")).expect("finite");
        let multipliers = constraints.multipliers(&extra, &[face, fibre]).expect("determined");
        check(&case, "p", &[Incompressibility::pressure(multipliers[0], &f)]);
        check(&case, "q", &[Inextensibility::tension(multipliers[1])]);
        check(&case, "T", &nine(&constraints.stress(&extra, multipliers).0));
    }
}

/// F₁₂, which no observer agrees on with another.
struct Observed;

impl InternalConstraint for Observed {
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        deformation.gradient_rows()[0][1]
    }
}

#[test]
fn constraints_that_depend_on_the_observer_are_refused() {
    let f = DeformationGradient::diagonal([2.0, 1.0, 1.0]).expect("0 < det F");
    let refused = Observed.at(&f);
    assert!(matches!(refused, Err(SolidsError::ConstraintDependsOnObserver { .. })), "{refused:?}");
}

/// |F e|² − 1.21: a cord of another length.
struct LongerCord(Fibre);

impl InternalConstraint for LongerCord {
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        Inextensibility::along(self.0).value(deformation) - T::lit(0.21)
    }
}

fn along(direction: [f64; 3], f: &DeformationGradient) -> Restriction {
    Inextensibility::along(Fibre::new(direction).expect("direction")).at(f).expect("objective")
}

#[test]
fn redundant_and_contradictory_constraints_are_told_apart() {
    let f = DeformationGradient::simple_shear(0.5).expect("finite");
    let first = along([1.0, 0.0, 0.0], &f);
    let longer = LongerCord(Fibre::new([1.0, 0.0, 0.0]).expect("direction")).at(&f).expect("objective");
    let refused = Combination::new([first, longer]);
    assert!(
        matches!(refused, Err(SolidsError::InconsistentConstraints { residual, .. })
            if (residual.abs() - 0.21).abs() <= Tol::ulps(32.0).value()),
        "{refused:?}"
    );
    // A rigid body is incompressible already.
    let turn = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).expect("rotation");
    let [a, b, c, d, e, g] = Rigidity.at(&turn).expect("finite");
    let seven = [a, b, c, d, e, g, Incompressibility.at(&turn).expect("objective")];
    assert_eq!(Combination::rank(&seven), 6);
    let refused = Combination::new(seven);
    assert!(matches!(refused, Err(SolidsError::RedundantConstraint { rank: 6, count: 7, .. })), "{refused:?}");
    // Three cords in a plane determine its metric: a fourth there is redundant.
    let cords = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [2.0, 1.0, 0.0]].map(|e| along(e, &turn));
    assert_eq!(Combination::rank(&cords), 3);
}

#[test]
fn conditions_that_do_not_determine_or_cannot_hold_are_refused() {
    let f = DeformationGradient::diagonal([2.0, 0.5, 1.0]).expect("0 < det F");
    let constraints = Combination::new([Incompressibility.at(&f).expect("objective"), along([0.0, 0.0, 1.0], &f)])
        .expect("independent");
    let extra = CauchyStress(Symmetric::diagonal([4.0, 0.25, 1.0]));
    // Neither face feels the cord.
    let faces = [
        StressCondition::normal_traction([0.0, 1.0, 0.0], 0.0).expect("finite"),
        StressCondition::normal_traction([1.0, 0.0, 0.0], 3.75).expect("finite"),
    ];
    let refused = constraints.multipliers(&extra, &faces);
    assert!(matches!(refused, Err(SolidsError::UndeterminedMultiplier { rank: 1, count: 2, .. })), "{refused:?}");
    // The pressure cannot free two faces on which the law's stresses differ.
    let pressure = Combination::new([Incompressibility.at(&f).expect("objective")]).expect("one");
    let [first, ..] = StressCondition::traction_free([0.0, 1.0, 0.0]).expect("direction");
    let [second, ..] = StressCondition::traction_free([1.0, 0.0, 0.0]).expect("direction");
    let refused = pressure.multipliers(&extra, &[first, second]);
    assert!(matches!(refused, Err(SolidsError::ImpossibleCondition { .. })), "{refused:?}");
    let violated = pressure.check_satisfied(1e-12);
    assert_eq!(violated, Ok(()));
    let stretched = DeformationGradient::diagonal([2.0, 1.0, 1.0]).expect("0 < det F");
    let violated = Combination::new([Incompressibility.at(&stretched).expect("objective")]).expect("one");
    let refused = violated.check_satisfied(1e-12);
    assert!(matches!(refused, Err(SolidsError::ConstraintViolated { index: 0, .. })), "{refused:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn power_of_reactions_in_motions_that_the_material_can_have_equals_zero(
        rows in gradient(),
        first in unit_vector(),
        second in unit_vector(),
        rates in vector(9, -1.0..1.0),
        multipliers in vector(3, -1.0..1.0),
    ) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let all = [Incompressibility.at(&f).expect("objective"), along(first, &f), along(second, &f)];
        prop_assume!(Combination::rank(&all) == 3);
        let constraints = Combination::new(all).expect("independent");
        let l = Matrix3::from_fn(|i, j| rates[3 * i + j]);
        let stretching = Symmetric::symmetric_part(VelocityGradient::new(l).expect("finite").rows());
        let admissible = constraints.admissible(&stretching);
        // Any spin may be added.
        let spin = 0.5 * (l - l.transpose());
        let motion = VelocityGradient::new(admissible.matrix() + spin).expect("finite");
        let tolerance = Tol::stated(1e-13, "rounding of the projection");
        assert_close_at_scale("μ̇", &constraints.rates(&motion), &[0.0; 3], 1.0, tolerance);
        let reaction = constraints.reaction([multipliers[0], multipliers[1], multipliers[2]]);
        let power = (reaction.matrix() * motion.matrix()).trace();
        assert_close_at_scale("tr(N L)", &[power], &[0.0], 1.0, tolerance);
        // The rate of the constraint itself, along any motion.
        let any = VelocityGradient::new(l).expect("finite");
        let change = l * f.matrix();
        let expected: f64 = all[1].gradient.dot(&change);
        assert_close_at_scale("μ̇ and ∂μ/∂F : Ḟ", &[constraints.rates(&any)[1]], &[expected], 1.0, tolerance);
    }

    #[test]
    fn closed_reactions_equal_derived_ones(rows in gradient(), direction in unit_vector()) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let fibre = Fibre::new(direction).expect("direction");
        let expected = Inextensibility::along(fibre).reaction(&f, 0.7).0;
        for actual in [
            Derived(Inextensibility::along(fibre)).reaction(&f, 0.7).0,
            OfMetric(Length(fibre)).reaction(&f, 0.7).0,
            Derived(OfMetric(Length(fibre))).reaction(&f, 0.7).0,
        ] {
            assert_close("N", &actual.components, &expected.components, Tol::ulps(32.0));
        }
    }
}
