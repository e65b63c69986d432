//! Identities that every law satisfies.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_solids::Hyperelastic;
use piola_tensor::PairSymmetric;
use piola_testkit::strategies::{random_cases, rotation, rotation_matrix};
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{Group, Visitor, gradient, objective, turn};

const IDENTITY: Tol = Tol::stated(1e-13, "stresses and tangents, relative to the moduli");

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

struct StressesAndTangentsAgree(DeformationGradient);

impl Visitor for StressesAndTangentsAgree {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: Group) {
        let f = &self.0;
        let (stress, tangent) = law.first_piola_and_tangent(f);
        let moduli = largest(tangent.0.components.as_flattened());
        let close = |what: &str, actual: &[f64], expected: &[f64], scale: f64| {
            assert_close_at_scale(&format!("{name}: {what} at {f:?}"), actual, expected, scale, IDENTITY);
        };
        let inverse = largest(f.inverse_rows().as_flattened());
        let material = law.second_piola(f);
        close("S", &material.0.components, &stress.second_piola(f).0.components, moduli * inverse);
        close("τ", &law.kirchhoff(f).0.components, &stress.kirchhoff(f).0.components, moduli * 2.0);
        let by_strain = law.material_tangent(f);
        let expected = tangent.material(&material, f).0.major_part();
        let scale = moduli * inverse * inverse;
        close("∂S/∂E", by_strain.0.slots().as_flattened(), expected.slots().as_flattened(), scale);
        let spatial = law.truesdell_tangent(f).0.slots();
        let expected = by_strain.truesdell(f).0.slots();
        close("c/J", spatial.as_flattened(), expected.as_flattened(), moduli * 4.0);
    }
}

struct TurnsOfSpace {
    gradient: [[f64; 3]; 3],
    turn: Matrix3<f64>,
}

impl Visitor for TurnsOfSpace {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: Group) {
        let f = DeformationGradient::from_rows(self.gradient).expect("0 < det F");
        let turned = DeformationGradient::new(self.turn * matrix(self.gradient)).expect("0 < det F");
        let moduli = largest(law.first_piola_tangent(&f).0.components.as_flattened());
        let expected = self.turn * law.first_piola(&f).0;
        let actual = law.first_piola(&turned).0;
        assert_close_at_scale(&format!("{name}: P(Q F)"), actual.as_slice(), expected.as_slice(), moduli, IDENTITY);
        assert_close_at_scale(&format!("{name}: W(Q F)"), &[law.energy(&turned)], &[law.energy(&f)], moduli, IDENTITY);
    }
}

struct TurnsOfTheReference {
    gradient: [[f64; 3]; 3],
    turn: Matrix3<f64>,
    angle: f64,
}

impl Visitor for TurnsOfTheReference {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, group: Group) {
        let q = match group {
            Group::All => self.turn,
            Group::About(axis) => turn(axis, self.angle),
            Group::HalfTurns => {
                let mut axis = [0.0; 3];
                axis[usize::from(0.0 < self.angle) + usize::from(1.5 < self.angle)] = 1.0;
                turn(axis, core::f64::consts::PI)
            }
        };
        let f = DeformationGradient::from_rows(self.gradient).expect("0 < det F");
        let turned = DeformationGradient::new(matrix(self.gradient) * q).expect("0 < det F");
        let moduli = largest(law.first_piola_tangent(&f).0.components.as_flattened());
        let expected = law.first_piola(&f).0 * q;
        let actual = law.first_piola(&turned).0;
        assert_close_at_scale(&format!("{name}: P(F Q)"), actual.as_slice(), expected.as_slice(), moduli, IDENTITY);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn stresses_and_tangents_equal_each_others_transformations(rows in gradient()) {
        objective(&mut StressesAndTangentsAgree(DeformationGradient::from_rows(rows).expect("0 < det F")));
    }

    #[test]
    fn turning_space_equals_turning_the_stress(gradient in gradient(), q in rotation()) {
        objective(&mut TurnsOfSpace { gradient, turn: matrix(rotation_matrix(q)) });
    }

    #[test]
    fn turning_the_reference_by_the_group_equals_turning_the_stress(
        gradient in gradient(),
        q in rotation(),
        angle in -3.0..3.0_f64,
    ) {
        objective(&mut TurnsOfTheReference { gradient, turn: matrix(rotation_matrix(q)), angle });
    }
}
