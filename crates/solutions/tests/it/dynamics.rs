//! Motions with an acceleration potential.

use nalgebra::Vector3;
use piola_fields::{Coordinates, Motion};
use piola_numerics::{Gradient, Real};
use piola_solids::isochoric::{Gent, MooneyRivlin};
use piola_solutions::dynamics::{
    AsMovingMotion, MovingFamily, MovingSector, MovingSphere, MovingTube, SectorHistory, SphereHistory, TubeHistory,
};
use piola_solutions::families::{Datum, Family, Orientation};
use piola_solutions::{ResponseFunctions, SolutionsError};
use piola_testkit::golden::{load, matrix, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;
use serde_json::Value;

use crate::fixtures::elastic;

const GOLDEN: Tol = Tol::stated(1e-12, "the accuracy that the reference data are compared to");
const POTENTIAL: Tol = Tol::stated(1e-11, "the bound of the specification; the terms leave some 1e-14");

/// Polynomials, ascending.
#[derive(Clone, Debug)]
struct Polynomials(Vec<Vec<f64>>);

impl Polynomials {
    fn at<T: Real>(&self, index: usize, t: T) -> T {
        self.0[index].iter().rev().fold(T::zero(), |sum, &c| sum * t + T::lit(c))
    }
}

impl SectorHistory for Polynomials {
    fn constants<T: Real>(&self, t: T) -> [T; 4] {
        core::array::from_fn(|i| self.at(i, t))
    }
}

impl TubeHistory for Polynomials {
    fn constants<T: Real>(&self, t: T) -> [T; 2] {
        [self.at(0, t), self.at(1, t)]
    }
}

impl SphereHistory for Polynomials {
    fn constant<T: Real>(&self, t: T) -> T {
        self.at(0, t)
    }
}

fn compare(case: &Value, law: &impl ResponseFunctions) -> usize {
    let histories = ["B", "C", "D", "E"].map(|name| vector(&case["params"][name]));
    let sector = MovingSector { history: Polynomials(histories.to_vec()) };
    let of = |name: &str| number(&case["params"][name]);
    let (t, density) = (of("t"), of("rho"));
    let gradient = sector.acceleration_gradient(t).expect("gradient");
    assert_close("grad a", gradient.as_flattened(), &matrix(&case["accel_gradient"]).concat(), GOLDEN);
    let sides = number(&case["condition_lhs"]) - number(&case["condition_rhs"]);
    let condition = sector.potential_condition(t).expect("condition");
    assert_close_at_scale("W(25.35)", &[condition.value], &[sides], condition.scale, GOLDEN);
    let has_potential = case["has_acceleration_potential"].as_bool().expect("bool");
    assert_eq!(sector.has_potential(t).expect("condition"), has_potential);
    let points = case["points"].as_array().expect("points");
    for point in points {
        let at: [f64; 3] = vector(&point["ref_coords"]).try_into().expect("three");
        let family = sector.at(t).expect("family");
        assert_close("x", &family.place(at), &vector(&point["cur_coords"]), GOLDEN);
        let acceleration = sector.acceleration(at, t).expect("a");
        assert_close("a", &acceleration, &vector(&point["acceleration"]), GOLDEN);
        if !has_potential {
            let refused = sector.stress(law, density, &Datum::free_at(at), at, t);
            assert!(matches!(refused, Err(SolutionsError::NoPotential { .. })), "{refused:?}");
            continue;
        }
        let zeta = sector.potential(family.place(at), t).expect("ζ");
        assert_close("ζ", &[zeta], &[number(&point["zeta"])], GOLDEN);
        // The data measure the pressure from T_xx = −ρ ζ.
        let datum = Datum { reference: at, stress: -density * zeta };
        let stress = sector.stress(law, density, &datum, at, t).expect("stress");
        assert_close("p", &[stress.pressure], &[number(&point["p"])], GOLDEN);
        assert_close("T", stress.cauchy.0.rows().as_flattened(), &matrix(&point["T_phys"]).concat(), GOLDEN);
    }
    points.len()
}

#[test]
fn straightened_sectors_in_motion_equal_golden() {
    let (mut cases, mut points) = (0, 0);
    for case in load("universal").cases.iter().filter(|case| text(&case["kind"]) == "dynamic_family2") {
        let model = &case["model"];
        let of = |name: &str| number(&model[name]);
        points += match text(&model["name"]) {
            "mooney_rivlin" => compare(case, &MooneyRivlin::new(of("c10"), of("c01")).expect("law")),
            _ => compare(case, &Gent::new(of("mu"), of("Jm")).expect("law")),
        };
        cases += 1;
    }
    assert_eq!((cases, points), (3, 4));
}

/// a = −grad ζ, div T = ρ a, and the acceleration of the Cartesian motion.
fn check<M: MovingFamily>(motion: M, law: &impl ResponseFunctions, datum: [f64; 3], at: [f64; 3], t: f64) {
    let system = <M::Family as Family>::Current::default();
    let family = motion.at(t).expect("family");
    let place = family.place(at);
    let acceleration = motion.acceleration(at, t).expect("a");
    let zeta = motion.potential(core::array::from_fn(|i| Gradient::<f64, 3>::variable(place[i], i)), t).expect("ζ");
    let lengths = system.scale_factors(&Vector3::from(place)).expect("scale factors");
    let gradient: [f64; 3] = core::array::from_fn(|i| -zeta.partials[i] / lengths[i]);
    let scale = 1.0 + zeta.value.abs();
    assert_close_at_scale("a = −grad ζ", &acceleration, &gradient, scale, POTENTIAL);
    let left = motion.momentum_residual(law, 1.5, &Datum::free_at(datum), at, t).expect("residual");
    assert!(left.relative() < POTENTIAL.value(), "{left:?}");

    let frame = system.physical_frame(&Vector3::from(place)).expect("frame");
    let particle = <M::Family as Family>::Reference::default().place(&Vector3::from(at));
    let cartesian = AsMovingMotion(motion).acceleration(&particle, t).expect("a");
    let physical: [f64; 3] = frame.vector_from_cartesian(&cartesian).into();
    assert_close_at_scale("a of the motion", &physical, &acceleration, scale, POTENTIAL);
}

proptest! {
    #[test]
    fn acceleration_of_a_straightened_sector_is_the_gradient_of_its_potential(
        law in elastic(), p in prop::array::uniform4(-0.3..0.3_f64), q in prop::array::uniform4(-0.3..0.3_f64),
        at in (0.5..2.0_f64, -1.0..1.0_f64, -1.0..1.0_f64), t in 0.0..1.0_f64,
    ) {
        // D = C and E = B satisfy the condition; so does C = D = 0.
        let (b, c) = (vec![1.5, p[0], p[1], p[2]], vec![q[0], q[1], q[2], q[3]]);
        let equal = MovingSector { history: Polynomials(vec![b.clone(), c.clone(), c.clone(), b.clone()]) };
        let integral = equal.first_integral(t).expect("k");
        // B Ċ − C Ḃ − (E Ḋ − D Ė) is zero there.
        prop_assert!(integral.abs() < 1e-14);
        check(equal, &law, [1.0, 0.0, 0.0], [at.0, at.1, at.2], t);
        let plain = MovingSector { history: Polynomials(vec![b, vec![], vec![], vec![1.2, p[3], q[3]]]) };
        check(plain, &law, [1.0, 0.0, 0.0], [at.0, at.1, at.2], t);
    }

    #[test]
    fn acceleration_of_tube_and_sphere_is_the_gradient_of_its_potential(
        law in elastic(), p in prop::array::uniform3(-0.3..0.3_f64), q in prop::array::uniform3(-0.2..0.2_f64),
        at in (1.0..2.0_f64, -1.0..1.0_f64, 0.4..2.0_f64), t in 0.0..1.0_f64,
    ) {
        let at = [at.0, at.1, at.2];
        let history = || Polynomials(vec![vec![1.0, p[0], p[1], p[2]], vec![1.3, q[0], q[1], q[2]]]);
        check(MovingTube { history: history() }, &law, [1.2, 0.0, 0.0], at, t);
        check(MovingSphere { orientation: Orientation::Kept, history: history() }, &law, [1.2, 0.0, 1.0], at, t);
        let wide = Polynomials(vec![vec![10.0, p[0], p[1], p[2]]]);
        check(MovingSphere { orientation: Orientation::Everted, history: wide }, &law, [1.2, 0.0, 1.0], at, t);
    }
}
