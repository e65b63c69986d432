//! Motions with an acceleration potential.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use piola_fields::{Coordinates, Motion};
use piola_numerics::{Gradient, Real};
use piola_solids::isochoric::{Gent, MooneyRivlin};
use piola_solutions::dynamics::{
    AsMovingMotion, BlockHistory, MovingBlock, MovingFamily, MovingSector, MovingShear, MovingSphere, MovingTube,
    SectorHistory, ShearHistory, SphereHistory, TubeHistory,
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
    fn constants<T: Real>(&self, t: T) -> [T; 5] {
        core::array::from_fn(|i| self.at(i, t))
    }
}

impl SphereHistory for Polynomials {
    fn constant<T: Real>(&self, t: T) -> T {
        self.at(0, t)
    }
}

impl BlockHistory for Polynomials {
    fn constants<T: Real>(&self, t: T) -> [T; 4] {
        core::array::from_fn(|i| self.at(i, t))
    }
}

impl ShearHistory for Polynomials {
    fn constants<T: Real>(&self, t: T) -> [T; 3] {
        core::array::from_fn(|i| self.at(i, t))
    }
}

/// Family 1 with C = c B, D = w/(A B), E = (1 + c w)/(A B): A B Ḃ = k and ẇ/(A B)² are constant.
#[derive(Clone, Copy, Debug)]
struct BlockWithPotential {
    a: f64,
    b: f64,
    ratio: f64,
    rate: f64,
    shear: [f64; 2],
    /// B = b exp(k t), A = a exp(−2 k t); otherwise B² = b² + 2 k t, A = a.
    is_exponential: bool,
}

impl BlockHistory for BlockWithPotential {
    fn constants<T: Real>(&self, t: T) -> [T; 4] {
        let &Self { a, b, ratio, rate, shear: [start, growth], .. } = self;
        let (a, b, k, c) = (T::lit(a), T::lit(b), T::lit(rate), T::lit(ratio));
        let (a, b, w) = if self.is_exponential {
            let fall = (T::lit(-2.0) * k * t).exp();
            (a * fall, b * (k * t).exp(), fall)
        } else {
            (a, (b * b + T::lit(2.0) * k * t).sqrt(), t * (b * b + k * t))
        };
        let w = T::lit(start) + T::lit(growth) * w;
        let size = (a * b).recip();
        [b, c * b, w * size, (T::lit(1.0) + c * w) * size]
    }
}

/// Family 3 with the constants of the block, and any B.
#[derive(Clone, Copy, Debug)]
struct SectorOfTube {
    offset: [f64; 3],
    block: BlockWithPotential,
}

impl TubeHistory for SectorOfTube {
    fn constants<T: Real>(&self, t: T) -> [T; 5] {
        let [c, d, e, f] = self.block.constants(t);
        let [start, rate, second] = self.offset.map(T::lit);
        [start + t * (rate + t * second), c, d, e, f]
    }
}

/// Family 5 with A² = 1/(1 + p t + q t²): C and A² Ḃ are constant, or B/C and A² C Ċ.
#[derive(Clone, Copy, Debug)]
struct ShearWithPotential {
    inflation: [f64; 2],
    b: f64,
    c: f64,
    rate: f64,
    turns: bool,
}

impl ShearHistory for ShearWithPotential {
    fn constants<T: Real>(&self, t: T) -> [T; 3] {
        let ([p, q], b, c) = (self.inflation.map(T::lit), T::lit(self.b), T::lit(self.c));
        let a = (T::lit(1.0) + p * t + q * t * t).sqrt().recip();
        // ∫ dt/A²
        let grown = T::lit(self.rate) * t * (T::lit(1.0) + t * (p / T::lit(2.0) + q * t / T::lit(3.0)));
        if self.turns {
            let c = (c * c + T::lit(2.0) * grown).sqrt();
            [a, b * c, c]
        } else {
            [a, b + grown, c]
        }
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

/// The largest circulation of the acceleration, ∮ a·dx, around three circles of particles, beside ∮ |a·dx|: zero exactly where
/// the acceleration has a potential.
fn circulation<M: MovingFamily>(motion: &M, centre: [f64; 3], t: f64) -> f64 {
    const POINTS: u32 = 64;
    let system = <M::Family as Family>::Current::default();
    let mut largest = 0.0_f64;
    for normal in 0..3 {
        let (mut sum, mut size) = (0.0, 0.0);
        for point in 0..POINTS {
            let angle = Gradient::<f64, 1>::variable(TAU * f64::from(point) / f64::from(POINTS), 0);
            let mut particle = centre.map(Gradient::constant);
            particle[(normal + 1) % 3] += angle.cos() * Gradient::constant(0.2);
            particle[(normal + 2) % 3] += angle.sin() * Gradient::constant(0.2);
            let place = motion.place(particle, Gradient::constant(t));
            let acceleration = motion.acceleration(particle.map(|x| x.value), t).expect("a");
            let lengths = system.scale_factors(&Vector3::from(place.map(|q| q.value))).expect("scale factors");
            for i in 0..3 {
                let term = acceleration[i] * lengths[i] * place[i].partials[0];
                sum += term;
                size += term.abs();
            }
        }
        if 0.0 < size {
            largest = largest.max(sum.abs() / size);
        }
    }
    largest
}

#[test]
fn motions_without_a_potential_are_refused_with_the_condition_that_they_violate() {
    let polynomials = |constants: &[&[f64]]| Polynomials(constants.iter().map(|c| c.to_vec()).collect());
    let named = |result: Result<f64, SolutionsError>| match result {
        Err(SolutionsError::NoPotential { condition, residual, scale, t }) => {
            assert!(0.0 < residual.abs() && residual.abs() <= scale && t.abs() <= 0.0);
            condition
        }
        other => panic!("{other:?}"),
    };
    let mut found = Vec::new();
    let blocks: [&[&[f64]]; 5] = [
        &[&[1.0], &[0.0, 1.0], &[], &[1.0]],
        &[&[1.0], &[0.0, 0.0, 1.0], &[], &[1.0]],
        &[&[1.0, 0.0, 1.0], &[], &[], &[1.0]],
        &[&[], &[1.0, 0.0, 1.0], &[-1.0], &[]],
        &[&[1.0], &[], &[0.0, 0.0, 1.0], &[1.0]],
    ];
    for constants in blocks {
        let block = MovingBlock { history: polynomials(constants) };
        assert!(!block.has_potential(0.0).expect("conditions"));
        found.push(named(block.potential([1.0, 0.5, 0.25], 0.0)));
        assert!(1e-3 < circulation(&block, [1.0, 0.4, 0.3], 0.0), "{found:?}");
    }
    let tubes: [&[&[f64]]; 5] = [
        &[&[0.5], &[1.0], &[0.0, 1.0], &[], &[1.0]],
        &[&[0.5], &[1.0], &[0.0, 0.0, 1.0], &[], &[1.0]],
        &[&[0.5], &[1.0, 0.0, 1.0], &[], &[], &[1.0]],
        &[&[0.5], &[], &[1.0, 0.0, 1.0], &[-1.0], &[]],
        &[&[0.5], &[1.0], &[], &[0.0, 0.0, 1.0], &[1.0]],
    ];
    for constants in tubes {
        let tube = MovingTube { history: polynomials(constants) };
        assert!(!tube.has_potential(0.0).expect("conditions"));
        found.push(named(tube.potential([1.0, 0.5, 0.25], 0.0)));
        assert!(1e-3 < circulation(&tube, [1.0, 0.4, 0.3], 0.0), "{found:?}");
    }
    let sectors: [&[&[f64]]; 3] =
        [&[&[1.0], &[0.0, 1.0], &[1.0, 1.0]], &[&[1.0], &[0.0, 0.0, 1.0], &[1.0]], &[&[1.0], &[], &[1.0, 1.0]]];
    for constants in sectors {
        let sector = MovingShear { history: polynomials(constants) };
        assert!(!sector.has_potential(0.0).expect("conditions"));
        found.push(named(sector.potential([1.0, 0.5, 0.25], 0.0)));
        assert!(1e-3 < circulation(&sector, [1.0, 0.4, 0.3], 0.0), "{found:?}");
    }
    let expected = [
        "B Ċ = C Ḃ",
        "B C̈ = C B̈",
        "(A B Ḃ)˙ = 0",
        "(A C Ċ)˙ = 0",
        "D Ë = E D̈",
        "C Ḋ = D Ċ",
        "C D̈ = D C̈",
        "(A C Ċ)˙ = 0",
        "(A D Ḋ)˙ = 0",
        "E F̈ = F Ë",
        "Ċ (C Ḃ − B Ċ) = 0",
        "[A² (C Ḃ − B Ċ)]˙ = 0",
        "(A² C Ċ)˙ = 0",
    ];
    assert_eq!(found, expected);
    // The stress and the momentum are refused with the same words.
    let law = MooneyRivlin::new(0.5, 0.1).expect("law");
    let block = MovingBlock { history: polynomials(blocks[2]) };
    let at = [1.0, 0.5, 0.25];
    let stress = block.stress(&law, 1.0, &Datum::free_at(at), at, 0.0).map(|stress| stress.pressure);
    let residual = block.momentum_residual(&law, 1.0, &Datum::free_at(at), at, 0.0).map(|left| left.relative());
    assert_eq!([named(stress), named(residual)], [expected[2]; 2]);
    // Constants that no motion has.
    let singular = MovingBlock { history: polynomials(&[&[1.0], &[], &[], &[]]) };
    assert!(matches!(singular.potential(at, 0.0), Err(SolutionsError::OutOfBounds { .. })));
    let shut = MovingShear { history: polynomials(&[&[1.0], &[], &[]]) };
    assert!(matches!(shut.potential(at, 0.0), Err(SolutionsError::OutOfBounds { .. })));
    assert!(matches!(shut.potential_conditions(f64::NAN), Err(SolutionsError::NotFinite { .. })));
}

proptest! {
    #[test]
    fn acceleration_of_a_bent_block_is_the_gradient_of_its_potential(
        law in elastic(), a in 0.7..1.4_f64, b in 0.7..1.4_f64, ratio in -0.4..0.4_f64, rate in -0.3..0.5_f64,
        shear in prop::array::uniform2(-0.4..0.4_f64), at in (0.5..2.0_f64, -0.8..0.8_f64, -0.8..0.8_f64),
        t in 0.0..0.7_f64,
    ) {
        for is_exponential in [false, true] {
            let history = BlockWithPotential { a, b, ratio, rate, shear, is_exponential };
            let block = MovingBlock { history };
            check(block, &law, [1.0, 0.0, 0.0], [at.0, at.1, at.2], t);
            prop_assert!(circulation(&block, [at.0, at.1, at.2], t) < POTENTIAL.value());
            // The same constants for a sector of a tube, family 3, with B that changes in any way.
            let tube = MovingTube { history: SectorOfTube { offset: [0.5, shear[0], shear[1]], block: history } };
            check(tube, &law, [1.0, 0.0, 0.0], [at.0, at.1, at.2], t);
            prop_assert!(circulation(&tube, [at.0, at.1, at.2], t) < POTENTIAL.value());
        }
    }

    #[test]
    fn acceleration_of_a_sheared_sector_is_the_gradient_of_its_potential(
        law in elastic(), inflation in prop::array::uniform2(-0.4..0.8_f64), b in -0.8..0.8_f64, c in 0.7..1.4_f64,
        rate in -0.2..0.6_f64, at in (0.5..2.0_f64, -0.8..0.8_f64, -0.8..0.8_f64), t in 0.0..0.7_f64,
    ) {
        for turns in [false, true] {
            let sector = MovingShear { history: ShearWithPotential { inflation, b, c, rate, turns } };
            check(sector, &law, [1.0, 0.2, 0.0], [at.0, at.1, at.2], t);
            prop_assert!(circulation(&sector, [at.0, at.1, at.2], t) < POTENTIAL.value());
        }
    }

    /// Random histories violate the conditions, and the acceleration circulates.
    #[test]
    fn acceleration_circulates_where_a_condition_is_violated(
        p in prop::array::uniform8(0.1..0.5_f64), q in prop::array::uniform4(0.1..0.5_f64), t in 0.0..0.5_f64,
    ) {
        let constants = |start: [f64; 4]| {
            Polynomials((0..4).map(|i| vec![start[i], p[i], p[i + 4], q[i]]).collect())
        };
        let centre = [1.0, 0.4, 0.3];
        let relative = |conditions: &[(&str, piola_fields::Residual)]| {
            conditions.iter().map(|(_, residual)| residual.relative()).fold(0.0, f64::max)
        };
        let block = MovingBlock { history: constants([1.0, 0.2, 0.1, 2.0]) };
        prop_assert!(1e-2 < relative(&block.potential_conditions(t).expect("conditions")));
        prop_assert!(1e-6 < circulation(&block, centre, t));
        let sector = MovingShear { history: constants([1.0, 0.2, 1.0, 0.0]) };
        prop_assert!(1e-2 < relative(&sector.potential_conditions(t).expect("conditions")));
        prop_assert!(1e-6 < circulation(&sector, centre, t));
    }

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
        // A constant twist: B and F change in any way.
        let tube = Polynomials(vec![vec![1.0, p[0], p[1], p[2]], vec![1.1], vec![q[1]], vec![], vec![1.3, q[0], q[1], q[2]]]);
        let tube = MovingTube { history: tube };
        check(tube.clone(), &law, [1.2, 0.0, 0.0], at, t);
        prop_assert!(circulation(&tube, at, t) < POTENTIAL.value());
        let sphere = Polynomials(vec![vec![1.0, p[0], p[1], p[2]]]);
        check(MovingSphere { orientation: Orientation::Kept, history: sphere }, &law, [1.2, 0.0, 1.0], at, t);
        let wide = Polynomials(vec![vec![10.0, p[0], p[1], p[2]]]);
        check(MovingSphere { orientation: Orientation::Everted, history: wide }, &law, [1.2, 0.0, 1.0], at, t);
    }
}
