//! Stresses of viscous fluids in three dimensions: golden values, symmetry, isotropy, indifference, shear.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::DeformationGradient;
use piola_continuum::rates::VelocityGradient;
use piola_fluids::{
    Bingham, CarreauYasuda, Casson, ConstantCoefficients, EulerianFluid, GeneralisedNewtonian, LinearViscous,
    Newtonian, Polytropic, PowerLaw, ReinerRivlin, SecondOrder, ViscometricFluid, ViscousFluid,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::golden::{load, matrix, number, text};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;
use serde_json::Value;

const CLOSED: Tol = Tol::stated(1e-13, "closed forms");

pub(super) fn rows(value: &Value) -> [[f64; 3]; 3] {
    let rows = matrix(value);
    core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))
}

pub(super) fn gradient(value: &Value) -> VelocityGradient {
    VelocityGradient::from_rows(rows(value)).expect("finite")
}

#[test]
fn stresses_of_viscous_fluids_equal_golden() {
    let mut count = 0;
    for case in &load("fluids").cases {
        let (input, output) = (&case["input"], &case["output"]);
        let of = |name: &str| number(&input[name]);
        let stress = match text(&case["kind"]) {
            "newtonian" => {
                let fluid = LinearViscous::new(of("lambda"), of("mu")).expect("bounds");
                let l = gradient(&input["L"]);
                let (stress, rate) = (fluid.cauchy(of("p"), &l), l.rate_of_deformation().0);
                // T : D may cancel, pressure against viscous stresses; κ = λ + ⅔ μ too.
                let power = [number(&output["stress_power"])];
                let scale = stress.0.norm() * rate.norm();
                assert_close_at_scale("T : D", &[stress.0.double_contraction(&rate)], &power, scale, CLOSED);
                let parts = fluid.dissipation(&l) - of("p") * rate.trace();
                assert_close_at_scale("V : D − p tr D", &[parts], &power, scale, CLOSED);
                let kappa = [number(&output["bulk_viscosity"])];
                assert_close_at_scale("κ", &[fluid.bulk_viscosity()], &kappa, of("mu"), CLOSED);
                stress
            }
            "reiner_rivlin" => {
                let fluid = ReinerRivlin(ConstantCoefficients::new(of("g1"), of("g2")).expect("bounds"));
                fluid.cauchy(of("p"), &gradient(&input["L"]))
            }
            "eulerian_polytropic" => {
                let fluid = Polytropic::new(of("p0"), of("rho0"), of("gamma")).expect("bounds");
                let deformation = DeformationGradient::from_rows(rows(&input["F"])).expect("det F > 0");
                let density = fluid.density(&deformation);
                assert_close("rho", &[density], &[number(&output["rho"])], CLOSED);
                assert_close("p", &[fluid.pressure(density)], &[number(&output["p"])], CLOSED);
                assert_close("dp/drho", &[fluid.pressure_slope(density)], &[number(&output["dp_drho"])], CLOSED);
                let second = fluid.second_piola(&deformation).rows();
                assert_close("S", second.as_flattened(), rows(&output["S"]).as_flattened(), CLOSED);
                fluid.cauchy(&deformation)
            }
            _ => continue,
        };
        let id = text(&case["id"]);
        if let Some(d) = output.get("D") {
            assert_close(
                id,
                gradient(&input["L"]).rate_of_deformation().rows().as_flattened(),
                rows(d).as_flattened(),
                CLOSED,
            );
        }
        assert_close(id, stress.rows().as_flattened(), rows(&output["T"]).as_flattened(), CLOSED);
        count += 1;
    }
    assert_eq!(count, 13);
}

fn shear(k: f64) -> VelocityGradient {
    VelocityGradient::from_rows([[0.0; 3], [k, 0.0, 0.0], [0.0; 3]]).expect("finite")
}

/// V in simple shear is that of the viscometric functions.
fn in_shear<F: ViscousFluid, G: ViscometricFluid>(fluid: &F, functions: &G, k: f64) {
    let v = fluid.extra_stress(&shear(k)).components;
    let expected = [functions.shear_stress(k), functions.sigma1(k), functions.sigma2(k)];
    let scale = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    assert_close_at_scale(G::NAME, &[v[3], v[0] - v[2], v[1] - v[2]], &expected, scale, Tol::ulps(8.0));
    assert_close_at_scale("T13, T23", &[v[4], v[5]], &[0.0, 0.0], scale, Tol::ulps(0.0));
}

fn bingham() -> Bingham {
    Bingham::new(0.5, 0.75).expect("bounds")
}
fn carreau() -> CarreauYasuda {
    CarreauYasuda::new(2.0, 0.1, 1.5, 0.3, 1.25).expect("bounds")
}
fn reiner_rivlin() -> ReinerRivlin<ConstantCoefficients> {
    ReinerRivlin(ConstantCoefficients::new(1.5, -0.5).expect("bounds"))
}
fn second_order() -> SecondOrder {
    SecondOrder::new(2.0, -0.5, 0.75).expect("bounds")
}

#[test]
fn stresses_in_simple_shear_equal_the_viscometric_functions() {
    for k in [1e-8, -0.3, 1.0, 25.0, -1e8] {
        in_shear(&GeneralisedNewtonian::new(bingham()), &bingham(), k);
        in_shear(&GeneralisedNewtonian::new(carreau()), &carreau(), k);
        let casson = Casson::new(2.0, 0.5).expect("bounds");
        in_shear(&GeneralisedNewtonian::new(casson), &casson, k);
        in_shear(&reiner_rivlin(), &reiner_rivlin(), k);
        in_shear(&second_order(), &second_order(), k);
    }
}

#[test]
fn fluids_at_rest_have_no_extra_stress_and_newtonian_derivatives() {
    let rest = [GeneralisedNewtonian::new(bingham()).extra_stress(&shear(0.0)).components];
    assert_close("Bingham", &rest[0], &[0.0; 6], Tol::ulps(0.0));
    let plateau = GeneralisedNewtonian::new(carreau());
    let k = Dual::variable(0.0);
    let zero = Dual::lit(0.0);
    let l = VelocityGradient::from_rows([[zero; 3], [k, zero, zero], [zero; 3]]).expect("finite");
    let v = plateau.extra_stress(&l).components;
    assert_close("dV/dk", &[v[3].tangent, v[0].tangent, v[4].tangent], &[2.0, 0.0, 0.0], Tol::ulps(2.0));
    for size in [1e-200, 1e150] {
        let newtonian = GeneralisedNewtonian::new(Newtonian::new(0.5).expect("bounds"));
        assert_close(
            "no overflow",
            &[newtonian.extra_stress(&shear(size)).components[3]],
            &[0.5 * size],
            Tol::ulps(4.0),
        );
    }
}

#[test]
fn newtonian_limits_equal_the_linear_viscous_fluid() {
    let l = VelocityGradient::from_rows([[0.5, 0.3, -1.5], [2.9, -0.75, -1.4], [2.2, 0.3, 0.25]]).expect("finite");
    let expected = LinearViscous::new(0.5, 0.75).expect("bounds").extra_stress(&l).components;
    let close = |what: &str, v: [f64; 6]| assert_close(what, &v, &expected, Tol::ulps(8.0));
    close(
        "power law",
        GeneralisedNewtonian::new(PowerLaw::new(0.75, 1.0).expect("bounds")).extra_stress(&l).components,
    );
    close("Bingham", GeneralisedNewtonian::new(Bingham::new(0.0, 0.75).expect("bounds")).extra_stress(&l).components);
    close(
        "Reiner-Rivlin",
        ReinerRivlin(ConstantCoefficients::new(1.5, 0.0).expect("bounds")).extra_stress(&l).components,
    );
    close("second order", SecondOrder::new(0.75, 0.0, 0.0).expect("bounds").extra_stress(&l).components);
    let stokes = LinearViscous::stokes(0.3).expect("bounds");
    assert_close_at_scale("κ", &[stokes.bulk_viscosity()], &[0.0], 0.3, Tol::ulps(1.0));
    assert!(LinearViscous::new(-1.0, 1.0).is_err());
}

#[test]
fn lanes_equal_scalars() {
    let fluid = GeneralisedNewtonian::new(carreau());
    let ks = [0.0, 1e-8, 3.0, -1e8];
    let lanes = Lanes::<f64, 4>::from(ks);
    let zero = Lanes::splat(0.0);
    let l = VelocityGradient::from_rows([[zero; 3], [lanes, zero, lanes], [zero; 3]]).expect("finite");
    let v = fluid.extra_stress(&l);
    for (lane, &k) in ks.iter().enumerate() {
        let l = VelocityGradient::from_rows([[0.0; 3], [k, 0.0, k], [0.0; 3]]).expect("finite");
        let scalar = fluid.extra_stress(&l).components;
        assert_close("V", &v.components.map(|v| v.primal(lane)), &scalar, Tol::ulps(64.0));
    }
}

/// An observer who turns sees the turned stress.
fn seen_from<F: ViscousFluid>(fluid: &F, l: &VelocityGradient, rotation: &Matrix3<f64>, spin: &Vector3<f64>) -> bool {
    let stress = fluid.extra_stress(l).matrix();
    let seen = fluid.extra_stress(&l.seen_from(rotation, spin)).matrix();
    let size = stress.norm().max(1e-3) * (1.0 + spin.norm() / l.0.norm());
    (seen - rotation * stress * rotation.transpose()).norm()
        <= Tol::ulps_because(256.0, "two rotations, and squares of rates whose terms cancel").value() * size
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn stress_seen_from_a_turning_observer_is_the_turned_stress(
        entries in strategies::vector(9, -3.0..3.0), q in strategies::rotation(), spin in strategies::vector(3, -3.0..3.0),
    ) {
        let l = VelocityGradient::new(Matrix3::from_row_slice(&entries)).expect("finite");
        let r = strategies::rotation_matrix(q);
        let (rotation, spin) = (Matrix3::from_fn(|i, j| r[i][j]), Vector3::from_column_slice(&spin));
        prop_assert!(seen_from(&LinearViscous::new(0.5, 0.75).expect("bounds"), &l, &rotation, &spin));
        prop_assert!(seen_from(&GeneralisedNewtonian::new(bingham()), &l, &rotation, &spin));
        prop_assert!(seen_from(&GeneralisedNewtonian::new(carreau()), &l, &rotation, &spin));
        prop_assert!(seen_from(&reiner_rivlin(), &l, &rotation, &spin));
        // Steady for one observer only: it is his axes that may be turned.
        prop_assert!(seen_from(&second_order(), &l, &rotation, &Vector3::zeros()));
    }

    #[test]
    fn dissipation_is_not_negative(entries in strategies::vector(9, -3.0..3.0)) {
        let l = VelocityGradient::new(Matrix3::from_row_slice(&entries)).expect("finite");
        prop_assert!(0.0 <= LinearViscous::new(-0.5, 0.75).expect("bounds").dissipation(&l));
        prop_assert!(0.0 <= GeneralisedNewtonian::new(bingham()).dissipation(&l));
        prop_assert!(0.0 <= GeneralisedNewtonian::new(carreau()).dissipation(&l));
    }
}
