//! Integrating, assembling and stepping allocate nothing.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_fields::integral::{
    AdaptiveQuadrature, Ball, Cuboid, Cylinder, EnergyBalance, EstimatedQuadrature, ExplicitMotion, IntegralBalance,
    LinearTetrahedra, QuadraticTetrahedra, Quadrature, Resultants, SurfacePoint, TetrahedralMesh, transport,
};
use piola_fields::{Body, Material, Spatial, Uniform};
use piola_numerics::Dual;
use piola_testkit::allocations_in;

use super::manufactured::{AffineDensity, Balanced, Quadratic, QuadraticField, SaintVenant};
use super::weak::{patch, stress};

#[test]
fn integrals_transport_and_balances_allocate_nothing() {
    let motion = Quadratic { linear: [[0.1; 3]; 3], of_squares: [[0.01; 6]; 3], shift: [1.0; 3] };
    let field = QuadraticField { coefficients: [[0.5; 10]; 3] };
    let actions = Balanced { motion: motion.clone(), stress: [[0.1; 4]; 6], density: AffineDensity([0.1, 0.0, 0.1]) };
    let (body, stress, force) = (actions.body(), actions.stress_field(), actions.force_field());
    let free = Body { motion: &motion, reference_density: Uniform(1.0) };
    let energy = SaintVenant { lambda: 1.0, mu: 1.0 };
    let rules = Quadrature::of_degree(6).expect("rules");
    let estimated = EstimatedQuadrature::of_degree(4).expect("rules");
    let adaptive = AdaptiveQuadrature::up_to_degree(20).expect("rules");
    let unit = Cuboid::new(Vector3::repeat(-0.5), Vector3::repeat(0.5)).expect("a box");
    let ball = Ball::new(Vector3::zeros(), 0.5).expect("a ball");
    let cylinder = Cylinder::new(Vector3::zeros(), Vector3::z(), [0.0, 0.5]).expect("a cylinder");
    let mesh = TetrahedralMesh::of_cuboid(&unit, [2, 2, 2]).expect("a mesh");
    let pole = Vector3::zeros();
    let (allocations, ()) = allocations_in(|| {
        let _ = rules.volume_integral(&mesh, |x: &Vector3<f64>| Matrix3::from_diagonal(x)).expect("finite");
        let _ = rules.surface_integral(&mesh, |point: &SurfacePoint<f64>| point.normal).expect("finite");
        let _ = rules.volume_integral(&cylinder, |x: &Vector3<f64>| x.norm_squared()).expect("finite");
        let _ = estimated.volume_integral(&ball, |x: &Vector3<f64>| x.x.exp()).expect("finite");
        let _ = adaptive.volume_integral(&ball, 1e-10, |x: &Vector3<f64>| x.x.exp()).expect("converged");
        let _ = Resultants::in_reference(&rules, &mesh, &body, &pole, Dual::variable(0.1)).expect("regular");
        let _ = transport(&rules, &mesh, &motion, &Spatial(&field), 0.1).expect("regular");
        let _ = IntegralBalance::of(&rules, &ball, &body, &stress, &force, &pole, 0.1).expect("regular");
        let _ =
            EnergyBalance::of(&rules, &unit, &free, &energy, &Material(Uniform(Vector3::zeros())), 0.1).expect("ok");
    });
    assert_eq!(allocations, 0);
}

#[test]
fn nodal_forces_masses_and_steps_allocate_nothing() {
    let body = LinearTetrahedra::new(patch(2), 1).expect("a body");
    let fine = QuadraticTetrahedra::new(patch(2), 4).expect("a body");
    let energy = SaintVenant { lambda: 1.0, mu: 1.0 };
    let mut masses = vec![0.0; body.nodes().len()];
    let (u, mut forces) = (vec![0.0; fine.components()], vec![0.0; fine.components()]);
    body.lumped_mass_into(|_| 1.0, &mut masses).expect("positive");
    let mut motion = ExplicitMotion::new(&masses, &vec![0.1; masses.len()]).expect("masses");
    let law = stress(energy);
    let (allocations, ()) = allocations_in(|| {
        fine.add_stress_forces(&u, &law, &mut forces).expect("regular");
        fine.add_forces_per_volume(|_| Vector3::z(), &mut forces).expect("lengths");
        fine.add_tractions(|point| point.normal, &mut forces).expect("lengths");
        fine.add_consistent_mass_product(|_| 1.0, &u, &mut forces).expect("lengths");
        let _ = fine.strain_energy(&u, |_, _| Ok(1.0)).expect("regular");
        let _ = fine.add_stress_forces(&u, |_, _| Ok(FirstPiola::zero()), &mut forces);
        body.lumped_mass_into(|_| 1.0, &mut masses).expect("positive");
        let _ = body.stable_step(1.0).expect("positive");
        for _ in 0..3 {
            motion.step(0.01, |_, u, forces| body.add_stress_forces(u, &law, forces)).expect("regular");
        }
    });
    assert_eq!(allocations, 0);
}
