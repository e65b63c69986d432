//! Energies of a change of volume with their derivatives: `testdata/golden/solid_laws.json`.

use piola_numerics::Real;
use piola_solids::volumetric::{
    HartmannNeff, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor, Volumetric,
};
use piola_testkit::golden::{load, number, text};
use piola_testkit::{Tol, assert_close, assert_each_close};
use serde_json::Value;

fn examine(case: &Value, law: &impl Volumetric) {
    let (jacobian, output) = (number(&case["input"]["J"]), &case["output"]);
    let change = jacobian - 1.0;
    let actual = [law.energy(change, jacobian), law.mean_kirchhoff(change, jacobian), law.curvature(change, jacobian)];
    let expected = ["U", "J_dU", "d2U"].map(|name| number(&output[name]));
    // Each is a sum of powers and logarithms of an ulp each; J⁻¹¹ has eleven.
    assert_each_close(text(&case["id"]), &actual, &expected, Tol::ulps(16.0));
}

#[test]
fn energies_of_a_change_of_volume_equal_reference() {
    let mut count = 0;
    for case in load("solid_laws").cases.iter().filter(|case| text(&case["kind"]) == "volumetric") {
        let kappa = number(&case["params"]["kappa"]);
        match text(&case["law"]) {
            "quadratic" => examine(case, &Quadratic::new(kappa).expect("bounds")),
            "logarithmic" => examine(case, &Logarithmic::new(kappa).expect("bounds")),
            "quadratic_logarithmic" => examine(case, &QuadraticLogarithmic::new(kappa).expect("bounds")),
            "simo_taylor" => examine(case, &SimoTaylor::new(kappa).expect("bounds")),
            "liu" => examine(case, &Liu::new(kappa).expect("bounds")),
            "miehe" => examine(case, &Miehe::new(kappa).expect("bounds")),
            "ogden" => examine(case, &OgdenVolumetric::new(kappa, 9.0).expect("bounds")),
            "hartmann_neff" => examine(case, &HartmannNeff::new(kappa).expect("bounds")),
            other => unreachable!("{other}"),
        }
        count += 1;
    }
    assert_eq!(count, 8 * 4);
}

/// U = κ (J − 1 − ln J), and nothing that is not asked of a law.
#[derive(Clone)]
struct Own(f64);

impl Volumetric for Own {
    fn energy<T: Real>(&self, change: T, _jacobian: T) -> T {
        T::lit(self.0) * (change - change.ln_1p())
    }
    fn mean_kirchhoff<T: Real>(&self, change: T, _jacobian: T) -> T {
        T::lit(self.0) * change
    }
    fn curvature<T: Real>(&self, _change: T, jacobian: T) -> T {
        T::lit(self.0) / (jacobian * jacobian)
    }
}

#[test]
fn stiffness_of_a_law_of_ones_own_is_the_growth_of_its_mean_stress() {
    // J (J U′)′ = J (κ (J − 1))′ = κ J.
    for jacobian in [0.5, 0.8, 1.0, 1.25, 3.0] {
        let stiffness = Own(2.0).stiffness(jacobian - 1.0, jacobian);
        assert_close("J (J U′)′", &[stiffness], &[2.0 * jacobian], Tol::ulps(4.0));
    }
}
