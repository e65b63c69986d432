//! Identities between integrals, each side computed in its own way.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_fields::integral::{
    Ball, Cuboid, Cylinder, EnergyBalance, EstimatedQuadrature, ForceResultants, IntegralBalance, MassBalance,
    MovedRegion, Quadrature, Region, Resultants, SphericalShell, TetrahedralMesh, divergence_theorem, strain_energy,
    stress_power, tensor_divergence_theorem, transport, transport_of_mass,
};
use piola_fields::{Body, Field, Material, Motion, Spatial, Uniform};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::manufactured::{
    AffineDensity, Balanced, ForceOf, HyperelasticForce, HyperelasticStress, Quadratic, QuadraticField, SaintVenant,
    balanced, field, quadratic, volume_ratio,
};

/// Terms of a few units, made of sums of a few hundred products of ten factors; compensated, so their number does
/// not count.
const ROUNDING: Tol = Tol::ulps(64.0);

fn unit_box() -> Cuboid {
    Cuboid::new(Vector3::repeat(-0.5), Vector3::repeat(0.5)).expect("a box")
}

fn unit_ball() -> Ball {
    Ball::new(Vector3::new(0.1, -0.1, 0.2), 0.6).expect("a ball")
}

fn mesh() -> TetrahedralMesh {
    // The vertices are moved so that no face is parallel to an axis.
    let skew = |x: &Vector3<f64>| x + Vector3::new(0.1 * x.y * x.z, 0.15 * x.x, -0.1 * x.x * x.y);
    TetrahedralMesh::of_cuboid(&unit_box(), [1, 1, 1]).expect("a mesh").moved(skew).expect("a mesh")
}

fn check_transport<R: Region<f64> + Region<Dual<f64>>>(
    rules: &Quadrature,
    region: &R,
    motion: &Quadratic,
    field: &QuadraticField,
    time: f64,
) {
    let sides = transport(rules, region, motion, &Spatial(field), time).expect("regular");
    let scale = [sides.rate, sides.flux, sides.local, sides.convected].iter().map(Vector3::amax).fold(1.0, f64::max);
    assert_close_at_scale("volume", sides.residual.as_slice(), &[0.0; 3], scale, ROUNDING);
    assert_close_at_scale("flux", sides.flux_residual.as_slice(), &[0.0; 3], scale, ROUNDING);
}

/// Rules of a degree, made once a thread.
fn with_rules<R>(degree: usize, f: impl FnOnce(&Quadrature) -> R) -> R {
    use std::cell::RefCell;
    use std::collections::BTreeMap;
    thread_local!(static RULES: RefCell<BTreeMap<usize, Quadrature>> = const { RefCell::new(BTreeMap::new()) });
    RULES.with_borrow_mut(|rules| {
        f(rules.entry(degree).or_insert_with(|| Quadrature::of_degree(degree).expect("rules")))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn rate_of_integral_over_moving_box_equals_local_rate_and_transport(
        motion in quadratic(), field in field(), time in -1.0..1.0_f64
    ) {
        // Degree eight is the lowest that is exact: g 4, v 2, Cof F 2.
        with_rules(8, |rules| check_transport(rules, &unit_box(), &motion, &field, time));
    }

    #[test]
    fn rate_of_mass_weighted_integral_equals_integral_of_material_rate(
        motion in quadratic(), field in field(), time in -1.0..1.0_f64
    ) {
        let body = Body { motion, reference_density: AffineDensity([0.3, 0.0, 0.1]) };
        let sides = with_rules(5, |rules| {
            transport_of_mass(rules, &unit_box(), &body, &Spatial(field), time).expect("regular")
        });
        assert_close_at_scale("sides", sides.left.as_slice(), sides.right.as_slice(), 4.0, ROUNDING);
    }

    #[test]
    fn rates_of_momenta_and_energy_equal_forces_moments_and_power(body in balanced(), time in -1.0..1.0_f64) {
        // Degree five: x 2, ρ 1 and v 2; on the boundary x 2, P 2 and the normal of a ball 1.
        with_rules(5, |rules| check_balances(rules, &unit_box(), &body, time));
    }

    #[test]
    fn rate_of_integral_over_moving_ball_equals_local_rate_and_transport(
        motion in quadratic(), field in field(), time in -1.0..1.0_f64
    ) {
        // As on the box, and the normal 1.
        with_rules(9, |rules| check_transport(rules, &unit_ball(), &motion, &field, time));
    }

    #[test]
    fn rate_of_integral_over_moving_mesh_equals_local_rate_and_transport(
        motion in quadratic(), field in field(), time in -1.0..1.0_f64
    ) {
        with_rules(8, |rules| check_transport(rules, &mesh(), &motion, &field, time));
    }

    #[test]
    fn rates_of_momenta_and_energy_of_balls_equal_forces_moments_and_power(
        body in balanced(), time in -1.0..1.0_f64
    ) {
        with_rules(5, |rules| check_balances(rules, &unit_ball(), &body, time));
    }

    #[test]
    fn rates_of_momenta_and_energy_of_meshes_equal_forces_moments_and_power(
        body in balanced(), time in -1.0..1.0_f64
    ) {
        with_rules(5, |rules| check_balances(rules, &mesh(), &body, time));
    }

    #[test]
    fn rate_of_kinetic_and_stored_energy_equals_power_of_external_forces(
        motion in quadratic(), lambda in 0.1..10.0_f64, mu in 0.1..10.0_f64, time in -1.0..1.0_f64
    ) {
        let energy = SaintVenant { lambda, mu };
        let body = Body { motion: &motion, reference_density: Uniform(1.0) };
        let force = Material(HyperelasticForce(&motion, energy));
        let check = |terms: EnergyBalance| {
            let scale = lambda + mu + terms.residual().scale;
            assert_close_at_scale("energy", &[terms.residual().value], &[0.0], scale, ROUNDING);
        };
        // P 3 and v 2 on the boundary, and the normal of a ball 1.
        with_rules(6, |rules| {
            check(EnergyBalance::of(rules, &unit_ball(), &body, &energy, &force, time).expect("regular"));
        });
        with_rules(5, |rules| {
            check(EnergyBalance::of(rules, &unit_box(), &body, &energy, &force, time).expect("regular"));
        });
    }

    #[test]
    fn rate_of_strain_energy_equals_stress_power(
        motion in quadratic(), lambda in 0.1..10.0_f64, mu in 0.1..10.0_f64, time in -1.0..1.0_f64
    ) {
        let energy = SaintVenant { lambda, mu };
        let stress = Material(HyperelasticStress(&motion, energy));
        with_rules(4, |rules| {
            let stored = strain_energy(rules, &mesh(), &motion, &energy, Dual::variable(time)).expect("regular");
            let power = stress_power(rules, &mesh(), &motion, &stress, time).expect("regular");
            assert_close_at_scale("power", &[stored.tangent], &[power], lambda + mu, ROUNDING);
        });
    }

    #[test]
    fn integrals_in_space_equal_integrals_over_the_reference(
        motion in quadratic(), wind in field(), time in -1.0..1.0_f64
    ) {
        // A density given in space, 1 + a·x, is ρ_κ = J ρ in the reference configuration.
        let (density, pole) = (AffineDensity([0.25, 0.0, -0.1]), Vector3::new(0.3, 0.1, -0.2));
        let moved = MovedRegion { region: &unit_box(), motion: &motion, time };
        let place = |x: &Vector3<f64>| motion.place(x, time);
        let pulled = |x: &Vector3<f64>| volume_ratio(&motion, x, time) * density.at(&place(x), time);
        // Degree nine: v 4, ρ 2 and J 3.
        with_rules(9, |rules| {
            let present = Resultants::in_space(rules, &moved, &Spatial(density), &Spatial(&wind), &pole, time);
            let present = present.expect("regular");
            let mass = rules.volume_integral(&unit_box(), |x: &Vector3<f64>| pulled(x)).expect("finite");
            let momentum = |x: &Vector3<f64>| wind.at(&place(x), time) * pulled(x);
            let momentum = rules.volume_integral(&unit_box(), momentum).expect("finite");
            assert_close_at_scale("mass", &[present.mass], &[mass], 1.0, ROUNDING);
            assert_close_at_scale("momentum", present.momentum.as_slice(), momentum.as_slice(), 1.0, ROUNDING);
        });
    }
}

fn check_balances(rules: &Quadrature, region: &impl Region<f64>, actions: &Balanced, time: f64) {
    let (pole, body) = (Vector3::new(0.2, -0.3, 0.1), actions.body());
    let (stress, force) = (actions.stress_field(), actions.force_field());
    let terms = IntegralBalance::of(rules, region, &body, &stress, &force, &pole, time).expect("regular");
    // Tractions and body forces are of the size of stress and of accelerations, both a few units, at every point;
    // their integrals may cancel.
    let zero = [0.0; 3];
    assert_close_at_scale("momentum", terms.momentum_residual().value.as_slice(), &zero, 8.0, ROUNDING);
    assert_close_at_scale("moment", terms.moment_residual().value.as_slice(), &zero, 8.0, ROUNDING);
    assert_close_at_scale("power", &[terms.power_residual().value], &[0.0], 8.0, ROUNDING);
}

/// v = (x y², y z² + t, z x²): div v = x² + y² + z².
struct Cubic;
impl Field for Cubic {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, time: T) -> Vector3<T> {
        Vector3::new(x.x * x.y * x.y, x.y * x.z * x.z + time, x.z * x.x * x.x)
    }
}

/// A tensor that is cubic in the place and not symmetric.
struct CubicTensor;
impl Field for CubicTensor {
    type Value = Matrix3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, time: T) -> Matrix3<T> {
        let v = Cubic.at(x, time);
        Matrix3::new(v.x, v.y, v.z, v.z * x.x, T::lit(2.0), v.x, v.y * time, x.x, x.y * x.z * x.z)
    }
}

#[test]
fn integral_of_divergence_equals_flux_through_every_kind_of_boundary() {
    fn check(region: &impl Region<f64>) {
        let rules = Quadrature::of_degree(6).expect("rules");
        let sides = divergence_theorem(&rules, region, &Spatial(Cubic), 0.7).expect("finite");
        assert_close_at_scale("vector", &[sides.left], &[sides.right], 4.0, ROUNDING);
        let sides = tensor_divergence_theorem(&rules, region, &Spatial(CubicTensor), 0.7).expect("finite");
        assert_close_at_scale("tensor", sides.left.as_slice(), sides.right.as_slice(), 4.0, ROUNDING);
    }
    check(&unit_box());
    check(&unit_ball());
    check(&SphericalShell::new(Vector3::new(0.1, 0.0, 0.2), [0.3, 0.9]).expect("a shell"));
    for inner in [0.0, 0.3] {
        let axis = Vector3::new(0.5, 1.0, -0.7);
        check(&Cylinder::new(Vector3::new(0.2, -0.1, 0.0), axis, [inner, 0.7]).expect("a cylinder"));
    }
    check(&mesh());
    check(&mesh().refined().expect("a mesh"));
}

#[test]
fn boundary_normals_of_closed_surfaces_sum_to_zero() {
    fn check(region: &impl Region<f64>) {
        let rules = Quadrature::of_degree(3).expect("rules");
        let sum = rules.surface_integral(region, |point| point.normal).expect("finite");
        assert_close_at_scale("sum", sum.as_slice(), &[0.0; 3], 4.0, Tol::ulps(8.0));
    }
    check(&unit_box());
    check(&unit_ball());
    check(&mesh());
    check(&TetrahedralMesh::of_cuboid(&unit_box(), [3, 2, 4]).expect("a mesh"));
}

#[test]
fn mass_in_space_equals_mass_in_the_reference_and_stays() {
    /// x = e^t X, ρ = e^{−3t} (1 + x₁² e^{−2t}).
    struct Swell;
    impl Motion for Swell {
        fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
            reference * time.exp()
        }
    }
    struct Thinning;
    impl Field for Thinning {
        type Value = f64;
        fn at<T: Real>(&self, x: &Vector3<T>, time: T) -> T {
            let back = x.x * (-time).exp();
            (T::lit(-3.0) * time).exp() * (T::lit(1.0) + back * back)
        }
    }
    struct Reference;
    impl Field for Reference {
        type Value = f64;
        fn at<T: Real>(&self, x: &Vector3<T>, _: T) -> T {
            T::lit(1.0) + x.x * x.x
        }
    }
    let rules = Quadrature::of_degree(4).expect("rules");
    let body = Body { motion: Swell, reference_density: Reference };
    for time in [-1.0, 0.0, 0.5] {
        let mass = MassBalance::of(&rules, &unit_ball(), &body, &Spatial(Thinning), time).expect("regular");
        assert_close_at_scale("mass", &[mass.residual().relative()], &[0.0], 1.0, ROUNDING);
        assert_close_at_scale("rate", &[mass.present.tangent], &[0.0], mass.reference, ROUNDING);
    }
}

#[test]
fn rates_by_duals_equal_difference_quotients() {
    let motion = Quadratic {
        linear: [[0.1, 0.05, 0.0], [0.0, -0.1, 0.02], [0.03, 0.0, 0.08]],
        of_squares: [[0.02, 0.0, 0.01, 0.0, 0.03, 0.0], [0.01; 6], [0.0, 0.02, 0.0, 0.04, 0.0, 0.01]],
        shift: [0.3, -0.2, 0.5],
    };
    let (rules, pole) = (Quadrature::of_degree(6).expect("rules"), Vector3::new(0.1, 0.2, 0.3));
    let body = Body { motion, reference_density: AffineDensity([0.0, 0.2, 0.0]) };
    let rates = Resultants::in_reference(&rules, &unit_ball(), &body, &pole, Dual::variable(0.4)).expect("regular");
    let at = |t: &[f64]| {
        let of = Resultants::in_reference(&rules, &unit_ball(), &body, &pole, t[0]).expect("regular");
        let (p, h, s) = (of.momentum, of.angular_momentum, of.first_moment);
        vec![of.mass, p.x, p.y, p.z, h.x, h.y, h.z, s.x, s.y, s.z, of.kinetic_energy]
    };
    let (p, h, s) = (rates.momentum, rates.angular_momentum, rates.first_moment);
    let found =
        [rates.mass, p.x, p.y, p.z, h.x, h.y, h.z, s.x, s.y, s.z, rates.kinetic_energy].map(|rate| rate.tangent);
    let expected = difference_quotient(at, &[0.4], &[1.0]);
    assert_close_at_scale("rates", &found, &expected, 1.0, Tol::stated(1e-11, "sixth-order differences"));
    // The rate of the first moment is the momentum: the centre of mass moves with p/m, W(15.8).
    let velocity = rates.centre_of_mass(&pole).map(|c| c.tangent);
    let expected = rates.momentum.map(|p| p.value / rates.mass.value);
    assert_close_at_scale("centre", velocity.as_slice(), expected.as_slice(), 0.0, ROUNDING);
}

#[test]
fn resultants_of_a_rigid_ball_equal_those_of_a_particle_and_a_spin() {
    struct Screw;
    impl Motion for Screw {
        fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
            let (s, c) = (T::lit(2.0) * time).sin_cos();
            let turned =
                Vector3::new(c * reference.x - s * reference.y, s * reference.x + c * reference.y, reference.z);
            turned + Vector3::new(T::lit(1.0), T::lit(0.0), T::lit(3.0) * time)
        }
    }
    let ball = Ball::new(Vector3::zeros(), 0.5).expect("a ball");
    let mass = 4.0 / 3.0 * core::f64::consts::PI * 0.125 * 7.0;
    let rules = Quadrature::of_degree(2).expect("rules");
    let body = Body { motion: Screw, reference_density: Uniform(7.0) };
    let of = Resultants::in_reference(&rules, &ball, &body, &Vector3::zeros(), 0.4).expect("regular");
    let (spin, inertia) = (2.0, 0.4 * mass * 0.25);
    assert_close_at_scale("mass", &[of.mass], &[mass], 0.0, ROUNDING);
    assert_close_at_scale("p", of.momentum.as_slice(), &[0.0, 0.0, 3.0 * mass], 0.0, ROUNDING);
    let centre = of.centre_of_mass(&Vector3::zeros());
    assert_close_at_scale("c", centre.as_slice(), &[1.0, 0.0, 1.2], 0.0, ROUNDING);
    // c × m v + I ω, with c = (1, 0, 1.2) and v = (0, 0, 3).
    let moment = [0.0, -3.0 * mass, inertia * spin];
    assert_close_at_scale("h", of.angular_momentum.as_slice(), &moment, 0.0, ROUNDING);
    let energy = 0.5 * (mass * 9.0 + inertia * spin * spin);
    assert_close_at_scale("K", &[of.kinetic_energy], &[energy], 0.0, ROUNDING);
}

#[test]
fn buoyancy_equals_the_weight_of_the_fluid_displaced() {
    struct Still;
    impl Motion for Still {
        fn place<T: Real>(&self, reference: &Vector3<T>, _: T) -> Vector3<T> {
            *reference
        }
    }
    struct Water;
    impl Field for Water {
        type Value = FirstPiola;
        fn at<T: Real>(&self, x: &Vector3<T>, _: T) -> FirstPiola<T> {
            FirstPiola(Matrix3::from_diagonal(&Vector3::repeat(T::lit(9810.0) * (x.z - T::lit(3.0)))))
        }
    }
    let rules = Quadrature::of_degree(3).expect("rules");
    let centre = Vector3::new(0.1, -0.1, 0.2);
    let of =
        ForceResultants::of_tractions(&rules, &unit_ball(), &Still, &Material(Water), &centre, 0.0).expect("regular");
    let weight = 9810.0 * 4.0 / 3.0 * core::f64::consts::PI * 0.216;
    assert_close_at_scale("force", of.force.as_slice(), &[0.0, 0.0, weight], 3e4, ROUNDING);
    assert_close_at_scale("moment about the centre", of.moment.as_slice(), &[0.0; 3], 3e4, ROUNDING);
    // A ball of the same fluid floats: its weight, as a body force, takes up force and moment about any pole.
    let pole = Vector3::new(-1.0, 2.0, 0.5);
    let of =
        ForceResultants::of_tractions(&rules, &unit_ball(), &Still, &Material(Water), &pole, 0.0).expect("regular");
    let body = Body { motion: Still, reference_density: Uniform(1000.0) };
    let gravity = Material(Uniform(Vector3::new(0.0, 0.0, -9.81)));
    let drawn = ForceResultants::of_body_force(&rules, &unit_ball(), &body, &gravity, &pole, 0.0).expect("regular");
    assert_close_at_scale("weight", drawn.force.as_slice(), (-of.force).as_slice(), 3e4, ROUNDING);
    assert_close_at_scale("moment", drawn.moment.as_slice(), (-of.moment).as_slice(), 6e4, ROUNDING);
    let arm = centre - pole;
    let by_hand = arm.cross(&Vector3::new(0.0, 0.0, -weight));
    assert_close_at_scale("moment by hand", drawn.moment.as_slice(), by_hand.as_slice(), 6e4, ROUNDING);
}

#[test]
fn estimated_residuals_bound_what_the_rule_leaves_out() {
    let actions = Balanced {
        motion: Quadratic { linear: [[0.1; 3]; 3], of_squares: [[0.03; 6]; 3], shift: [1.0; 3] },
        stress: [[1.0, 0.5, 0.0, 0.25]; 6],
        density: AffineDensity([0.0, 0.1, 0.0]),
    };
    let (body, pole, stress) = (actions.body(), Vector3::zeros(), actions.stress_field());
    let largest = |values: [f64; 7]| values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    // Degree 2 and 4: below what is exact.
    let rough = EstimatedQuadrature::of_degrees(2, 4).expect("rules");
    let force = actions.force_field();
    let found =
        IntegralBalance::estimated_residuals(&rough, &unit_ball(), &body, &stress, &force, &pole, 0.3).expect("ok");
    assert!(largest(found.value) <= found.error && 0.0 < found.error, "{found:?}");
    // A body force that is wrong by 1 % is told from the error of the rule.
    let wrong = Material(ForceOf(&actions, 1.01));
    let exact = EstimatedQuadrature::of_degree(8).expect("rules");
    let found =
        IntegralBalance::estimated_residuals(&exact, &unit_ball(), &body, &stress, &wrong, &pole, 0.3).expect("ok");
    assert!(1e6 * found.error < largest(found.value), "{found:?}");
}

#[test]
fn integrals_in_lanes_and_single_precision_equal_those_in_double() {
    let rules = Quadrature::of_degree(4).expect("rules");
    let single = rules.volume_integral(&unit_ball(), |x: &Vector3<f32>| x.x * x.x + x.y).expect("finite");
    let double = rules.volume_integral(&unit_ball(), |x: &Vector3<f64>| x.x * x.x + x.y).expect("finite");
    assert_close_at_scale("f32", &[f64::from(single)], &[double], 1.0, Tol::ulps32(4.0));
    let lanes = rules
        .volume_integral(&unit_ball(), |x: &Vector3<Lanes<f64, 2>>| x.x * x.x * Lanes([1.0, 2.0]) + x.y)
        .expect("finite");
    assert_close_at_scale("lane", &[lanes.primal(0)], &[double], 1.0, Tol::ulps(4.0));
}

#[test]
fn mesh_integrals_equal_box_integrals() {
    let rules = Quadrature::of_degree(5).expect("rules");
    let polynomial = |x: &Vector3<f64>| Vector3::new(x.x * x.y * x.z, x.x.powi(4) * x.y, x.z.powi(3) - x.x);
    let expected = rules.volume_integral(&unit_box(), polynomial).expect("finite");
    let mesh = TetrahedralMesh::of_cuboid(&unit_box(), [2, 1, 3]).expect("a mesh");
    for mesh in [mesh.refined().expect("a mesh"), mesh] {
        let found = rules.volume_integral(&mesh, polynomial).expect("finite");
        assert_close_at_scale("volume", found.as_slice(), expected.as_slice(), 1.0, Tol::ulps(8.0));
    }
}
