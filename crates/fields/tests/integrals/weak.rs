//! Forces on the nodes of elements: patch test, virtual work, energy, tangents, masses.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{Deformation, DisplacementGradient, FirstPiola};
use piola_fields::integral::{
    Cuboid, LinearTetrahedra, MaterialPoint, QuadraticTetrahedra, StoredEnergy, TetrahedralElements, TetrahedralMesh,
};
use piola_fields::{Field, Motion};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Dual, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::manufactured::{Balanced, SaintVenant, balanced};

/// Sums of some tens of terms, not compensated, each a product of some factors.
pub(super) const ROUNDING: Tol = Tol::ulps(256.0);

/// A unit cube whose inner vertices, and those of its faces, are out of line.
pub(super) fn patch(cells: usize) -> TetrahedralMesh {
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let bump = |x: f64| 4.0 * x * (1.0 - x);
    let shift = |x: &Vector3<f64>| {
        let size = 0.3 / cells as f64;
        x + Vector3::new(bump(x.x) * (0.5 + x.y), -bump(x.y) * (0.7 + x.z), bump(x.z) * (0.9 - x.x)) * size
    };
    TetrahedralMesh::of_cuboid(&unit, [cells; 3]).expect("a mesh").moved(shift).expect("a mesh")
}

pub(super) fn stress<T: Real>(
    energy: SaintVenant,
) -> impl Fn(&MaterialPoint, &DisplacementGradient<T>) -> Result<FirstPiola<T>, piola_fields::FieldsError> {
    move |point, gradient| Ok(energy.stress(&point.position, &from_rows(gradient.gradient_rows())))
}

fn density<T: Real>(
    energy: SaintVenant,
) -> impl Fn(&MaterialPoint, &DisplacementGradient<T>) -> Result<T, piola_fields::FieldsError> {
    move |point, gradient| Ok(energy.density(&point.position, &from_rows(gradient.gradient_rows())))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn check_patch<const N: usize>(body: &TetrahedralElements<N>, gradient: &Matrix3<f64>) {
    let energy = SaintVenant { lambda: 2.0, mu: 1.0 };
    let mut displacement = vec![0.0; body.components()];
    body.sample_into(|x| gradient * x + Vector3::new(0.1, 0.2, 0.3), &mut displacement).expect("lengths");
    let mut forces = vec![0.0; body.components()];
    body.add_stress_forces(&displacement, stress(energy), &mut forces).expect("regular");
    let uniform = energy.stress(&Vector3::zeros(), &(Matrix3::identity() + gradient));
    body.add_tractions(|point| uniform.matrix() * point.normal, &mut forces).expect("lengths");
    assert_close_at_scale("patch", &forces, &vec![0.0; forces.len()], 1.0, ROUNDING);
    // The strain energy of a uniform deformation is W times the volume.
    let stored = body.strain_energy(&displacement, density(energy)).expect("regular");
    let expected = energy.density(&Vector3::zeros(), &(Matrix3::identity() + gradient)) * body.mesh().volume();
    assert_close_at_scale("energy", &[stored], &[expected], 1.0, ROUNDING);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn forces_of_uniform_stress_equal_tractions_of_the_patch(entries in strategies::vector(9, -0.2..0.2)) {
        let gradient = Matrix3::from_row_slice(&entries);
        check_patch(&LinearTetrahedra::new(patch(2), 0).expect("a body"), &gradient);
        check_patch(&QuadraticTetrahedra::new(patch(2), 2).expect("a body"), &gradient);
    }

    #[test]
    fn virtual_work_of_a_balanced_motion_equals_zero_at_every_node(body in balanced(), time in -1.0..1.0_f64) {
        // The motion is quadratic and its stress a polynomial: quadratic elements sample it without error.
        check_virtual_work(&body, time);
    }

    #[test]
    fn forces_equal_minus_slope_of_strain_energy(
        values in strategies::vector(3 * 27, -0.05..0.05), direction in strategies::vector(3 * 27, -1.0..1.0)
    ) {
        let body = QuadraticTetrahedra::new(patch(1), 3).expect("a body");
        let energy = SaintVenant { lambda: 2.0, mu: 1.0 };
        let along: Vec<Dual<f64>> = values.iter().zip(&direction).map(|(&u, &v)| Dual::new(u, v)).collect();
        let slope = body.strain_energy(&along, density(energy)).expect("regular").tangent;
        let mut forces = vec![0.0; body.components()];
        body.add_stress_forces(&values, stress(energy), &mut forces).expect("regular");
        assert_close_at_scale("slope", &[dot(&forces, &direction)], &[-slope], 10.0, ROUNDING);
    }

    #[test]
    fn tangents_of_an_energy_are_symmetric(
        values in strategies::vector(3 * 27, -0.05..0.05), first in strategies::vector(3 * 27, -1.0..1.0),
        second in strategies::vector(3 * 27, -1.0..1.0)
    ) {
        let body = LinearTetrahedra::new(patch(2), 0).expect("a body");
        let energy = SaintVenant { lambda: 2.0, mu: 1.0 };
        let product = |direction: &[f64]| -> Vec<f64> {
            let along: Vec<_> = values.iter().zip(direction).map(|(&u, &v)| Dual::new(u, v)).collect();
            let mut forces = vec![Dual::lit(0.0); body.components()];
            body.add_stress_forces(&along, stress(energy), &mut forces).expect("regular");
            forces.iter().map(|force| force.tangent).collect()
        };
        let (left, right) = (dot(&first, &product(&second)), dot(&second, &product(&first)));
        assert_close_at_scale("tangent", &[left], &[right], 100.0, ROUNDING);
    }

    #[test]
    fn forces_of_a_symmetric_stress_have_neither_resultant_nor_moment(
        values in strategies::vector(3 * 27, -0.05..0.05)
    ) {
        let body = LinearTetrahedra::new(patch(2), 0).expect("a body");
        let mut forces = vec![0.0; body.components()];
        let law = stress(SaintVenant { lambda: 2.0, mu: 1.0 });
        body.add_stress_forces(&values, law, &mut forces).expect("regular");
        let (mut resultant, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for ((node, u), f) in body.nodes().iter().zip(values.chunks(3)).zip(forces.chunks(3)) {
            let force = Vector3::new(f[0], f[1], f[2]);
            resultant += force;
            moment += (node + Vector3::new(u[0], u[1], u[2])).cross(&force);
        }
        assert_close_at_scale("force", resultant.as_slice(), &[0.0; 3], 1.0, ROUNDING);
        assert_close_at_scale("moment", moment.as_slice(), &[0.0; 3], 1.0, ROUNDING);
    }
}

/// The forces of ρ ü = f + Div P with c = 0: inertia taken as a body force.
fn check_virtual_work(actions: &Balanced, time: f64) {
    let unit = Cuboid::new(Vector3::repeat(-0.5), Vector3::repeat(0.5)).expect("a box");
    let mesh = TetrahedralMesh::of_cuboid(&unit, [1, 1, 1]).expect("a mesh");
    // Stress and shape functions are quadratic on the faces.
    let body = QuadraticTetrahedra::new(mesh, 4).expect("a body");
    let mut displacement = vec![0.0; body.components()];
    body.sample_into(|x| actions.motion.displacement(x, time), &mut displacement).expect("lengths");
    let mut forces = vec![0.0; body.components()];
    let (stress, body_force) = (actions.stress_field().0, actions.force_field().0);
    // The sampled gradient is that of the motion.
    let law = |point: &MaterialPoint, gradient: &DisplacementGradient| {
        let expected = actions.motion.displacement_gradient(&point.position, time)?;
        let (found, expected) = (gradient.displacement_rows(), expected.displacement_rows());
        assert_close_at_scale("∇u", found.as_flattened(), expected.as_flattened(), 1.0, ROUNDING);
        Ok(stress.at(&point.position, time))
    };
    body.add_stress_forces(&displacement, law, &mut forces).expect("regular");
    let force = |point: &MaterialPoint| {
        let acceleration = actions.motion.acceleration(&point.position, time).expect("regular");
        (body_force.at(&point.position, time) - acceleration) * actions.density.at(&point.position, time)
    };
    body.add_forces_per_volume(force, &mut forces).expect("lengths");
    let traction = |x: &Vector3<f64>| stress.at(x, time).matrix();
    body.add_tractions(|point| traction(&point.position) * point.normal, &mut forces).expect("lengths");
    assert_close_at_scale("virtual work", &forces, &vec![0.0; forces.len()], 1.0, ROUNDING);
}

#[test]
fn lumped_masses_are_positive_and_equal_the_mass() {
    fn check<const N: usize>(body: &TetrahedralElements<N>) {
        let mut masses = vec![0.0; body.nodes().len()];
        body.lumped_mass_into(|x| 1.0 + x.x, &mut masses).expect("positive");
        assert!(masses.iter().all(|&mass| 0.0 < mass));
        let field = vec![0.0; body.components()];
        let total = body.integral(&field, |point, _, _| Ok(1.0 + point.position.x)).expect("finite");
        assert_close("mass", &[masses.iter().sum()], &[total], ROUNDING);
    }
    check(&LinearTetrahedra::new(patch(3), 3).expect("a body"));
    check(&QuadraticTetrahedra::new(patch(3), 5).expect("a body"));
}

#[test]
fn lumped_mass_of_linear_elements_equals_row_sums_of_the_consistent_mass() {
    let body = LinearTetrahedra::new(patch(2), 2).expect("a body");
    let mut lumped = vec![0.0; body.nodes().len()];
    body.lumped_mass_into(|_| 3.0, &mut lumped).expect("positive");
    let (ones, mut rows) = (vec![1.0; body.components()], vec![0.0; body.components()]);
    body.add_consistent_mass_product(|_| 3.0, &ones, &mut rows).expect("lengths");
    let expected: Vec<f64> = rows.chunks(3).map(|row| row[0]).collect();
    assert_close("rows", &lumped, &expected, ROUNDING);
}

#[test]
fn consistent_mass_of_sampled_fields_equals_their_kinetic_energy() {
    let body = QuadraticTetrahedra::new(patch(2), 4).expect("a body");
    let mut velocity = vec![0.0; body.components()];
    body.sample_into(|x| Vector3::new(x.y * x.z, x.x * x.x, -x.y), &mut velocity).expect("lengths");
    let mut momentum = vec![0.0; body.components()];
    body.add_consistent_mass_product(|_| 2.0, &velocity, &mut momentum).expect("lengths");
    let energy = body.integral(&velocity, |_, v, _| Ok(v.dot(v))).expect("finite");
    assert_close("energy", &[0.5 * dot(&momentum, &velocity)], &[energy], ROUNDING);
}

#[test]
fn forces_per_volume_and_tractions_keep_their_resultants() {
    let body = QuadraticTetrahedra::new(patch(2), 4).expect("a body");
    let mut forces = vec![0.0; body.components()];
    body.add_forces_per_volume(|point| Vector3::new(point.position.x, 1.0, 0.0), &mut forces).expect("lengths");
    let sum = |forces: &[f64], i: usize| forces.iter().skip(i).step_by(3).sum::<f64>();
    let field = vec![0.0; body.components()];
    let expected = body.integral(&field, |point, _, _| Ok([point.position.x, 1.0, 0.0])).expect("finite");
    assert_close("body", &[sum(&forces, 0), sum(&forces, 1), sum(&forces, 2)], &expected, ROUNDING);
    forces.fill(0.0);
    // ∮ x n dA = V e₁.
    body.add_tractions(|point| point.normal * point.position.x, &mut forces).expect("lengths");
    let expected = [body.mesh().volume(), 0.0, 0.0];
    assert_close("surface", &[sum(&forces, 0), sum(&forces, 1), sum(&forces, 2)], &expected, ROUNDING);
}

#[test]
fn no_frequency_exceeds_the_bound_of_the_stable_step() {
    fn check<const N: usize>(body: &TetrahedralElements<N>) {
        // P = κ ∇u: all eigenvalues of ∂P/∂F are κ.
        let stiffness = 4.0;
        let mut masses = vec![0.0; body.nodes().len()];
        body.lumped_mass_into(|_| 1.0, &mut masses).expect("positive");
        let law = |_: &MaterialPoint, gradient: &DisplacementGradient<Dual<f64>>| {
            Ok(FirstPiola(from_rows(gradient.displacement_rows())) * Dual::lit(stiffness))
        };
        let mut direction: Vec<f64> = (0..body.components()).map(|k| ((k * k % 17) as f64) - 8.0).collect();
        let mut square = 0.0;
        for _ in 0..200 {
            let along: Vec<_> = direction.iter().map(|&v| Dual::new(0.0, v)).collect();
            let mut forces = vec![Dual::lit(0.0); body.components()];
            body.add_stress_forces(&along, law, &mut forces).expect("regular");
            let image: Vec<f64> = forces.iter().enumerate().map(|(k, f)| -f.tangent / masses[k / 3]).collect();
            let length = dot(&image, &image).sqrt();
            square = length / dot(&direction, &direction).sqrt();
            direction = image.iter().map(|v| v / length).collect();
        }
        let step = body.stable_step(stiffness).expect("positive");
        let limit = 2.0 / square.sqrt();
        assert!(step <= limit && 0.5 * limit < step, "{step} {limit}");
    }
    check(&LinearTetrahedra::new(patch(2), 1).expect("a body"));
    check(&QuadraticTetrahedra::new(patch(2), 4).expect("a body"));
}
