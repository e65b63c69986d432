//! Every term of the integral balances of a box by itself, where nothing balances, against integrals by mpmath.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_fields::integral::{Cuboid, ForceResultants, IntegralBalance, Quadrature};
use piola_fields::{Body, Field, Material, Motion};
use piola_numerics::Real;
use piola_testkit::golden::{load, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_each_close_at_scales};

/// x = (X₁ + t X₂²/4 + t², X₂ − t² X₁ X₃/2, X₃ + t² X₁/2).
#[derive(Clone, Copy)]
struct Bending;

impl Motion for Bending {
    fn place<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        let (half, square) = (T::lit(0.5), t * t);
        Vector3::new(
            x.x + T::lit(0.25) * t * x.y * x.y + square,
            x.y - half * square * x.x * x.z,
            x.z + half * square * x.x,
        )
    }
}

/// ρ = 2 + X₁/2 − X₂/4.
#[derive(Clone, Copy)]
struct Density;

impl Field for Density {
    type Value = f64;
    fn at<T: Real>(&self, x: &Vector3<T>, _: T) -> T {
        T::lit(2.0) + T::lit(0.5) * x.x - T::lit(0.25) * x.y
    }
}

/// P of the reference: neither symmetric nor in balance.
struct Stress;

impl Field for Stress {
    type Value = FirstPiola;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> FirstPiola<T> {
        let (a, b, c) = (x.x, x.y, x.z);
        #[rustfmt::skip]
        let p = Matrix3::new(
            a * b,           t + c * c,       -b,
            T::lit(2.0) * c, a * a - b,       t * a * c,
            b * b,           T::lit(3.0) - c, a + b * c,
        );
        FirstPiola(p)
    }
}

/// b = (X₂ X₃, 1 − t X₁, −9.75 + X₁ X₂).
struct Force;

impl Field for Force {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        Vector3::new(x.y * x.z, T::lit(1.0) - t * x.x, T::lit(-9.75) + x.x * x.y)
    }
}

/// W(15.16), W(15.18), W(21.4): a sign, a factor or a forgotten lever arm in one term is no residual of zero, but shows here.
#[test]
fn terms_of_the_balances_of_a_box_equal_reference() {
    let data = load("equations");
    let case = data.cases.iter().find(|case| text(&case["equation"]).starts_with("W(15.16)")).expect("a case");
    let triple = |key: &str| Vector3::from_column_slice(&vector(&case[key]));
    let (t, pole) = (number(&case["t"]), triple("pole"));
    let region = Cuboid::new(triple("low"), triple("high")).expect("a box");
    // ρ x × ẍ has degree six, (x − o) × P N five.
    let rules = Quadrature::of_degree(6).expect("rules");
    let body = Body { motion: Bending, reference_density: Density };
    let terms = IntegralBalance::of(&rules, &region, &body, &Material(Stress), &Material(Force), &pole, t);
    let terms = terms.expect("regular");
    // Compensated sums of products of a few factors. Components are integrals of parts of both signs, up to ten times as large.
    let few = Tol::ulps(16.0);
    let close = |what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>| {
        assert_each_close_at_scales(what, actual.as_slice(), expected.as_slice(), &[10.0; 3], few);
    };
    let all = &terms.resultants;
    assert_close("mass", &[all.mass.value], &[number(&case["mass"])], few);
    close("p", &all.momentum.map(|p| p.value), &triple("momentum"));
    close("ṗ", &all.momentum.map(|p| p.tangent), &triple("momentum_rate"));
    close("h", &all.angular_momentum.map(|h| h.value), &triple("angular_momentum"));
    close("ḣ", &all.angular_momentum.map(|h| h.tangent), &triple("angular_momentum_rate"));
    assert_close("K", &[all.kinetic_energy.value], &[number(&case["kinetic_energy"])], few);
    assert_close("K̇", &[all.kinetic_energy.tangent], &[number(&case["kinetic_energy_rate"])], few);
    assert_close("∫ P : Ḟ", &[terms.stress_power], &[number(&case["stress_power"])], few);
    let of = |key: &str, part: &str| Vector3::from_column_slice(&vector(&case[key][part]));
    let tractions = ForceResultants::of_tractions(&rules, &region, &Bending, &Material(Stress), &pole, t);
    let weight = ForceResultants::of_body_force(&rules, &region, &body, &Material(Force), &pole, t);
    let found = [("body", terms.body), ("surface", terms.surface)];
    let apart = [("body", weight.expect("regular")), ("surface", tractions.expect("regular"))];
    for (key, resultants) in found.into_iter().chain(apart) {
        close(key, &resultants.force, &of(key, "force"));
        // The weight's lever arms make moments of some hundreds.
        let scale = of(key, "moment").amax();
        let moment = of(key, "moment");
        assert_each_close_at_scales(key, resultants.moment.as_slice(), moment.as_slice(), &[scale; 3], few);
        assert_close(key, &[resultants.power], &[number(&case[key]["power"])], few);
    }
    // The residuals are what is left: rate − body − surface, and K̇ + ∫ P : Ḟ dV − power.
    let left = |rate: &str, part: &str| triple(rate) - of("body", part) - of("surface", part);
    close("momentum", &Vector3::from(terms.momentum_residual().value), &left("momentum_rate", "force"));
    let moment = left("angular_momentum_rate", "moment");
    let found = terms.moment_residual().value;
    assert_each_close_at_scales("moment", found.as_slice(), moment.as_slice(), &[200.0; 3], few);
    let powers = number(&case["body"]["power"]) + number(&case["surface"]["power"]);
    let power = number(&case["kinetic_energy_rate"]) + number(&case["stress_power"]) - powers;
    assert_close("power", &[terms.power_residual().value], &[power], few);
}
