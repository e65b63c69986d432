//! Loads: by surface integrals, by derivatives of the energy, by closed forms; inverse problems.

use core::f64::consts::{PI, TAU};

use nalgebra::Matrix3;
use piola_numerics::{Dual, Real};
use piola_solids::isochoric::{Gent, Isochoric, MooneyRivlin, NeoHookean, Rivlin};
use piola_solutions::families::{
    AzimuthalShearing, BlockBending, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
    TubeDeformation,
};
use piola_solutions::loads::{
    AzimuthalShear, Bending, Block, BlockExtension, BlockLoads, BlockSides, Ends, FaceForces, Sector, SectorLoads,
    ShearLoads, Shell, SphereInflation, Straightening, Torsion, Tube, TubeInflation, everted_tube, torsion_under,
};
use piola_solutions::{LoadCurve, LocalDeformation, ResponseFunctions, SolutionsError};
use piola_testkit::golden::{load, number, text};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::fixtures::{elastic, first_piola, integral, integral_by, rubber};

const QUADRATURE: Tol = Tol::stated(1e-11, "loads by quadrature");

type Rows<T> = [[T; 3]; 3];

fn energy<T: Real>(law: &Rivlin, gradient: Rows<T>) -> T {
    let local = LocalDeformation::of(gradient);
    law.energy(local.first_minus_three, local.second_minus_three)
}

/// F of families 1 and 3, written again.
fn bent<T: Real>([b, c, d, e]: [T; 4], offset: T, s: f64, is_sector: bool) -> Rows<T> {
    let a = (b * e - c * d).recip();
    let (k, xi) = if is_sector { (s, 0.5 * s * s) } else { (1.0, s) };
    let (k, zero) = (T::lit(k), T::zero());
    let r = (T::lit(2.0 * xi) * a + offset).sqrt();
    [[a * k / r, zero, zero], [zero, r * b / k, r * c], [zero, d / k, e]]
}

fn simple_shear<T: Real>(k: T) -> Rows<T> {
    let (zero, one) = (T::zero(), T::one());
    [[one, k, zero], [zero, one, zero], [zero, zero, one]]
}

fn block() -> impl Strategy<Value = [f64; 4]> {
    (0.6..1.8, -0.4..0.4, -0.4..0.4, 0.9..1.8).prop_map(|(b, c, d, e)| [b, c, d, e])
}

/// Loads of a bent block or a tube: the family's own stresses integrated over the faces, and derivatives of the energy.
fn check_sector(
    family: &impl Family,
    law: &Rivlin,
    loads: &SectorLoads,
    (constants, offset, is_sector): ([f64; 4], f64, bool),
    (s1, s2): (f64, f64),
    outer: f64,
) {
    let datum = Datum { reference: [s2, 0.0, 0.0], stress: outer };
    let nominal = |s: f64| {
        let local = family.deformation([s, 0.0, 0.0]).expect("deformation");
        first_piola(family.stress(law, &datum, [s, 0.0, 0.0]).expect("stress").cauchy.0.rows(), &local)
    };
    let radius = |s: f64| family.place([s, 0.0, 0.0])[0];
    let kappa = |s: f64| if is_sector { s } else { 1.0 };
    let surface = [
        integral(s1, s2, |s| radius(s) * nominal(s)[1][1]),
        integral(s1, s2, |s| radius(s) * nominal(s)[1][2] * kappa(s)),
        integral(s1, s2, |s| nominal(s)[2][1]),
        integral(s1, s2, |s| nominal(s)[2][2] * kappa(s)),
    ];
    let found = [loads.bending_moment, loads.torque, loads.axial_shear, loads.axial_force];
    let scale = integral(s1, s2, |s| nominal(s).as_flattened().iter().map(|p| p.abs()).sum::<f64>());
    assert_close_at_scale("surface integrals", &found, &surface, scale, QUADRATURE);

    let [b, c, d, e] = constants;
    let a = 1.0 / (b * e - c * d);
    let xi = |s: f64| if is_sector { 0.5 * s * s } else { s };
    let [t1, t2] = loads.normal_stresses;
    let radial = t2 * xi(s2) - t1 * xi(s1);
    for (direction, load) in found.into_iter().enumerate() {
        let varied: [Dual<f64>; 4] = core::array::from_fn(|i| {
            if i == direction { Dual::variable(constants[i]) } else { Dual::constant(constants[i]) }
        });
        let rate_of_a = (varied[0] * varied[3] - varied[1] * varied[2]).recip().tangent;
        let stored = integral(s1, s2, |s| {
            energy(law, bent(varied, Dual::constant(offset), s, is_sector)) * Dual::constant(kappa(s))
        });
        let work = load + radial * rate_of_a / a;
        assert_close_at_scale("dE", &[work], &[stored.tangent], scale, QUADRATURE);
    }
    let varied = constants.map(Dual::constant);
    let stored = integral(s1, s2, |s| {
        energy(law, bent(varied, Dual::variable(offset), s, is_sector)) * Dual::constant(kappa(s))
    });
    assert_close_at_scale("dE/dB", &[(t2 - t1) / (2.0 * a)], &[stored.tangent], scale, QUADRATURE);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn loads_of_a_bent_block_equal_surface_integrals_and_derivatives_of_the_energy(
        law in rubber(), block in block(), first in 0.3..1.0_f64, thickness in 0.1..1.5_f64, outer in -1.0..1.0_f64,
    ) {
        let family = BlockBending::isochoric(block).expect("constants");
        let ends = (first, first + thickness);
        let loads = SectorLoads::of_bending(&family, &law, ends, outer).expect("loads");
        check_sector(&family, &law, &loads, (block, 0.0, false), ends, outer);
    }

    #[test]
    fn loads_of_a_tube_equal_surface_integrals_and_derivatives_of_the_energy(
        law in rubber(), block in block(), b in -0.1..1.0_f64, first in 0.7..1.0_f64, thickness in 0.1..1.0_f64,
        outer in -1.0..1.0_f64, everted in any::<bool>(),
    ) {
        let [c, d, e, f] = block;
        let (offset, constants) = if everted { (b + 8.0, [c, d, e, -f]) } else { (b, block) };
        let family = TubeDeformation::isochoric([offset, c, d, e, constants[3]]).expect("constants");
        let ends = (first, first + thickness);
        let loads = SectorLoads::of_tube(&family, &law, ends, outer).expect("loads");
        check_sector(&family, &law, &loads, (constants, offset, true), ends, outer);
    }

    #[test]
    fn loads_of_a_straightened_sector_equal_surface_integrals_and_derivatives_of_the_energy(
        law in rubber(), block in block(), first in 0.5..1.0_f64, thickness in 0.1..1.0_f64, stress in -1.0..1.0_f64,
    ) {
        let family = SectorStraightening::isochoric(block).expect("constants");
        let (s1, s2) = (first, first + thickness);
        let loads = BlockLoads::of_sector(&family, &law, (s1, s2), stress).expect("loads");
        let datum = Datum { reference: [s2, 0.0, 0.0], stress };
        let nominal = |s: f64| {
            let local = family.deformation([s, 0.0, 0.0]).expect("deformation");
            first_piola(family.stress(&law, &datum, [s, 0.0, 0.0]).expect("stress").cauchy.0.rows(), &local)
        };
        let place = |s: f64| family.place([s, 0.0, 0.0])[0];
        let surface = [
            integral(s1, s2, |s| nominal(s)[1][1]),
            integral(s1, s2, |s| s * nominal(s)[1][2]),
            integral(s1, s2, |s| nominal(s)[2][1]),
            integral(s1, s2, |s| s * nominal(s)[2][2]),
            integral(s1, s2, |s| (place(s1) - place(s)) * nominal(s)[1][1]),
        ];
        let found = [loads.tension, loads.cross_shear, loads.shear, loads.axial_force, loads.bending_moment];
        let scale = integral(s1, s2, |s| nominal(s).as_flattened().iter().map(|p| p.abs()).sum::<f64>());
        assert_close_at_scale("surface integrals", &found, &surface, scale, QUADRATURE);
        let [b, c, d, e] = block;
        let a = 1.0 / (b * e - c * d);
        for (direction, load) in found.into_iter().take(4).enumerate() {
            let [b, c, d, e]: [Dual<f64>; 4] = core::array::from_fn(|i| {
                if i == direction { Dual::variable(block[i]) } else { Dual::constant(block[i]) }
            });
            let rate = (b * e - c * d).recip();
            let stored = integral(s1, s2, |s| {
                let (r, zero) = (Dual::constant(s), Dual::constant(0.0));
                energy(&law, [[rate * r, zero, zero], [zero, b / r, c], [zero, d / r, e]]) * r
            });
            let work = load + 0.5 * stress * (s2 * s2 - s1 * s1) * rate.tangent / a;
            assert_close_at_scale("dE", &[work], &[stored.tangent], scale, QUADRATURE);
        }
    }

    #[test]
    fn pressure_of_a_sphere_equals_the_derivative_of_its_energy(
        law in rubber(), outer in 1.01..3.0_f64, stretch in 0.7..3.0_f64,
    ) {
        for orientation in [Orientation::Kept, Orientation::Everted] {
            let body = SphereInflation { shell: Shell::new(1.0, outer).expect("shell"), law: &law, orientation };
            let a = Dual::variable(body.deformation(stretch).expect("deformation").constant());
            let sign = if orientation == Orientation::Kept { 1.0 } else { -1.0 };
            let stored = integral(1.0, outer, |s| {
                let (zero, size) = (Dual::constant(0.0), Dual::constant(s));
                let hoop = (Dual::constant(sign * s * s * s) + a).cbrt() / size;
                let radial = (hoop * hoop).recip();
                energy(&law, [[radial, zero, zero], [zero, hoop, zero], [zero, zero, hoop]]) * size * size
            });
            // dE = p dV, V = 4π/3 (r of the cavity)³, whose derivative by A is 4π/3.
            let point = body.point(stretch).expect("point");
            assert_close("p", &[point.load], &[3.0 * stored.tangent], QUADRATURE);
        }
    }

    #[test]
    fn forces_on_a_block_equal_derivatives_of_the_energy(
        law in rubber(), entries in prop::array::uniform9(-0.4..0.4_f64), extents in prop::array::uniform3(0.5..2.0_f64),
        stress in -1.0..1.0_f64, x in 0.7..2.0_f64,
    ) {
        let f = Matrix3::identity() + Matrix3::from_row_slice(&entries);
        prop_assume!(0.2 < f.determinant());
        let f = f / f.determinant().cbrt();
        let family = IsochoricDeformation::new(f, [1.0, 2.0, 3.0]).expect("isochoric");
        let block = Block::new(extents[0], extents[1], extents[2]).expect("block");
        let loads = FaceForces::of_block(&family, &law, &block, stress).expect("loads");
        let volume: f64 = extents.iter().product();
        let datum = Datum { reference: [0.0; 3], stress };
        let local = family.deformation([0.0; 3]).expect("F");
        let nominal = first_piola(family.stress(&law, &datum, [0.5; 3]).expect("T").cauchy.0.rows(), &local);
        let scale = volume * nominal.as_flattened().iter().map(|p| p.abs()).sum::<f64>();
        // dF = F L with tr L = 0 keeps volumes: three shears, three more, and two of the stretches.
        for (i, j) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2), (0, 0), (1, 1)] {
            let mut rate = Matrix3::zeros();
            rate[(i, j)] = 1.0;
            if i == j {
                rate[(2, 2)] = -1.0;
            }
            let moved = f * rate;
            let work: f64 =
                (0..3).flat_map(|a| (0..3).map(move |k| (a, k))).map(|(a, k)| loads.forces[a][k] * extents[a] * moved[(k, a)]).sum();
            // E of an isochoric path: F (1 + ε L) has the determinant 1 to first order.
            let varied = [0, 1, 2].map(|k: usize| [0, 1, 2].map(|a: usize| Dual { value: f[(k, a)], tangent: moved[(k, a)] }));
            assert_close_at_scale("dE", &[work], &[energy(&law, varied).tangent * volume], scale, QUADRATURE);
        }
        for sides in [BlockSides::Free, BlockSides::Held, BlockSides::Pulled] {
            let curve = BlockExtension { block, law: &law, sides };
            let state = curve.state(x).expect("state");
            let [_, on_y, on_z] = FaceForces::of_block(&state.deformation, &law, &block, 0.0).expect("loads").forces;
            let size = state.force.abs() + state.side_force.abs() + volume / extents[0];
            let found = [curve.point(x).expect("point").load, state.force, state.side_force];
            assert_close_at_scale("forces", &found, &[on_y[1], on_y[1], on_z[2]], size, QUADRATURE);
            let (one, zero, y) = (Dual::constant(1.0), Dual::constant(0.0), Dual::variable(x));
            let z = match sides {
                BlockSides::Free => y.sqrt().recip(),
                BlockSides::Held => one,
                BlockSides::Pulled => y,
            };
            let stored = energy(&law, [[(y * z).recip(), zero, zero], [zero, y, zero], [zero, zero, z]]);
            // dE = N L_y dλ + N_z L_z dλ_z.
            let work = state.force * extents[1] + state.side_force * extents[2] * z.tangent;
            assert_close_at_scale("dE/dλ", &[work], &[stored.tangent * volume], size * (extents[1] + extents[2]), QUADRATURE);
        }
    }

    #[test]
    fn couples_on_a_sheared_sector_balance_and_do_the_work_of_its_energy(
        law in rubber(), a in 0.7..1.5_f64, b in -1.0..1.0_f64, c in 0.7..1.5_f64, first in 0.5..1.0_f64,
        thickness in 0.2..1.0_f64, start in -0.5..0.5_f64, angle in 0.2..1.0_f64, stress in -1.0..1.0_f64,
    ) {
        // The stresses are linear in θ and in ln r.
        let integral = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| integral_by(4, (from, to), f);
        let family = AzimuthalShearing::isochoric([a, b, c]).expect("constants");
        let ([r1, r2], [t1, t2]) = ([first, first + thickness], [start, start + angle]);
        let sector = Sector::new([r1, r2], [t1, t2]).expect("sector");
        let datum = Datum { reference: [0.5 * (r1 + r2), start + 0.25 * angle, 0.0], stress };
        let loads = ShearLoads::of_sector(&family, &law, &sector, &datum).expect("loads");
        let nominal = |r: f64, theta: f64| {
            let local = family.deformation([r, theta, 0.0]).expect("deformation");
            first_piola(family.stress(&law, &datum, [r, theta, 0.0]).expect("stress").cauchy.0.rows(), &local)
        };
        let curved = |r: f64, f: &dyn Fn(f64) -> f64| integral(t1, t2, &|theta| nominal(r, theta)[1][0] * f(theta) * r);
        let flat = |theta: f64, f: &dyn Fn(f64) -> f64| integral(r1, r2, &|r| nominal(r, theta)[1][1] * f(r));
        let size = |r: f64, theta: f64| nominal(r, theta).as_flattened().iter().map(|p| p.abs()).sum::<f64>() * r;
        let scale = integral(r1, r2, &|r| integral(t1, t2, &|theta| size(r, theta))) + integral(r1, r2, &|r| size(r, t2));

        let couples = [r1, r2].map(|r| curved(r, &|_| a * r));
        let moments = [t1, t2].map(|theta| flat(theta, &|r| a * r));
        let axial = integral(r1, r2, &|r| integral(t1, t2, &|theta| nominal(r, theta)[2][2] * r));
        let found = [loads.couples, loads.moments].concat();
        assert_close_at_scale("couples, moments", &found, &[couples, moments].concat(), scale, QUADRATURE);
        assert_close_at_scale("axial force", &[loads.axial_force], &[axial], scale, QUADRATURE);
        let sum = loads.couples[1] - loads.couples[0] + loads.moments[1] - loads.moments[0];
        assert_close_at_scale("balance", &[sum], &[0.0], scale, QUADRATURE);

        // E of the constants, with D = 1/(A² C).
        let volume = 0.5 * (r2 * r2 - r1 * r1) * angle;
        let slope = |direction: usize| {
            let [a, b, c]: [Dual<f64>; 3] = core::array::from_fn(|i| {
                let value = [a, b, c][i];
                if i == direction { Dual::variable(value) } else { Dual::constant(value) }
            });
            let (zero, d) = (Dual::constant(0.0), (a * a * c).recip());
            (energy(&law, [[a, zero, zero], [a * b, a * c, zero], [zero, zero, d]]).tangent * volume, d.tangent)
        };
        // dE = ∫ P N · dx over all faces: dx_θ = r ln R dB or r Θ dC, dx_r = R dA, and dx_z = Z dD.
        let radial = |r: f64| integral(t1, t2, &|theta| nominal(r, theta)[0][0] * r * r);
        let along = |theta: f64| integral(r1, r2, &|r| nominal(r, theta)[0][1] * r);
        let (by_a, d_by_a) = slope(0);
        let work = radial(r2) - radial(r1) + along(t2) - along(t1) + loads.axial_force * d_by_a;
        assert_close_at_scale("dE/dA", &[work], &[by_a], scale, QUADRATURE);
        let edges = [t1, t2].map(|theta| flat(theta, &|r| a * r * r.ln()));
        let work = loads.couples[1] * r2.ln() - loads.couples[0] * r1.ln() + edges[1] - edges[0];
        assert_close_at_scale("dE/dB", &[work], &[slope(1).0], scale, QUADRATURE);
        let (by_c, d_by_c) = slope(2);
        let middle = 0.5 * (t1 + t2);
        let work = (loads.couples[1] - loads.couples[0]) * middle + loads.moments[1] * t2 - loads.moments[0] * t1
            + loads.axial_force * d_by_c;
        assert_close_at_scale("dE/dC", &[work], &[by_c], scale, QUADRATURE);
    }

    #[test]
    fn loads_of_all_curves_equal_derivatives_of_the_energy(
        law in rubber(), x in 1.05..1.8_f64, outer in 1.1..1.8_f64, held in 0.8..1.4_f64,
    ) {
        let modulus = 2.0 * (energy(&law, simple_shear(Dual::variable(1.0))).tangent).abs();
        // A tube: E of the stretch of the inner face, the axial stretch and the twist.
        let tube_energy = |inner: f64, [stretch, axial, twist]: [Dual<f64>; 3]| {
            let offset = Dual::constant(inner * inner) * (stretch * stretch - axial.recip());
            let constants = [Dual::constant(1.0), twist, Dual::constant(0.0), axial];
            let stored =
                integral(inner, outer, |s| energy(&law, bent(constants, offset, s, true)) * Dual::constant(s));
            (stored * Dual::constant(TAU)).tangent
        };
        let varied = |values: [f64; 3], direction: usize| -> [Dual<f64>; 3] {
            core::array::from_fn(|i| {
                if i == direction { Dual::variable(values[i]) } else { Dual::constant(values[i]) }
            })
        };
        let scale = modulus * outer * outer;
        let tube = Tube::new(1.0, outer).expect("tube");
        for ends in [Ends::Stretch(held), Ends::Force(0.1), Ends::Closed] {
            let curve = TubeInflation { tube, law: &law, ends };
            let state = curve.state(x).expect("state");
            let at = [x, state.axial_stretch, 0.0];
            // dE = p dV + N dλ_z, with V = π λ² λ_z of the inside at a fixed λ_z, and no work of p at a fixed λ.
            let pressure = curve.point(x).expect("point").load;
            let loads = [pressure, state.pressure].map(|p| TAU * x * state.axial_stretch * p);
            assert_close_at_scale("p dV", &loads, &[tube_energy(1.0, varied(at, 0)); 2], scale, QUADRATURE);
            assert_close_at_scale("N", &[state.axial_force], &[tube_energy(1.0, varied(at, 1))], scale, QUADRATURE);
        }
        for (inner, tube) in [(1.0, tube), (0.0, Tube::solid(outer).expect("rod"))] {
            for ends in [Ends::Stretch(held), Ends::Force(0.1), Ends::Closed] {
                let curve = Torsion { tube, law: &law, ends };
                let twist = x - 1.0;
                let state = curve.state(twist).expect("state");
                let [a, offset] = [state.deformation.constants()[0], state.deformation.constants()[1]];
                let stretch = if inner > 0.0 { (a + offset).sqrt() } else { 1.0 };
                let at = [stretch, state.axial_stretch, twist];
                let torque = [curve.point(twist).expect("point").load, state.torque];
                assert_close_at_scale("M", &torque, &[tube_energy(inner, varied(at, 2)); 2], scale, QUADRATURE);
                assert_close_at_scale("N", &[state.axial_force], &[tube_energy(inner, varied(at, 1))], scale, QUADRATURE);
                assert_close_at_scale("free face", &[0.0], &[tube_energy(inner, varied(at, 0))], scale, QUADRATURE);
            }
        }
        // A tube turned inside out: no load does work.
        let everted = everted_tube(&tube, &law).expect("state");
        for direction in 0..2 {
            let [radius, axial, _] = varied([everted.radii[0], everted.axial_stretch, 0.0], direction);
            let offset = radius * radius + Dual::constant(outer * outer) / axial;
            let constants = [Dual::constant(1.0), Dual::constant(0.0), Dual::constant(0.0), -axial];
            let stored = integral(1.0, outer, |s| energy(&law, bent(constants, offset, s, true)) * Dual::constant(s));
            assert_close_at_scale("no load", &[0.0], &[stored.tangent], scale, QUADRATURE);
        }
        // A block 0 ≤ X − X₁ ≤ H of length 2 and height 3: E of the angle, the axial stretch and X₁.
        let bending = Bending { block: Block::new(outer, 2.0, 3.0).expect("block"), law: &law, axial_stretch: held };
        let state = bending.state(x).expect("state");
        let block_energy = |[angle, axial, first]: [Dual<f64>; 3]| {
            let b = angle / Dual::constant(2.0);
            let constants = [b, Dual::constant(0.0), Dual::constant(0.0), axial];
            let offset = Dual::constant(2.0) * first / (b * axial);
            let stored = integral(0.0, outer, |s| energy(&law, bent(constants, offset, s, false)));
            (stored * Dual::constant(6.0)).tangent
        };
        let at = [x, held, state.faces[0]];
        let loads = [bending.point(x).expect("point").load, state.moment];
        assert_close_at_scale("moment", &loads, &[block_energy(varied(at, 0)); 2], 6.0 * scale, QUADRATURE);
        let force = 3.0 * state.axial_force;
        assert_close_at_scale("axial force", &[force], &[block_energy(varied(at, 1))], 6.0 * scale, QUADRATURE);
        assert_close_at_scale("free faces", &[0.0], &[block_energy(varied(at, 2))], 6.0 * scale, QUADRATURE);
        // A sector straightened to the length B a radian.
        let straightening =
            Straightening { sector: Sector::new([1.0, outer], [0.0, 1.0]).expect("sector"), law: &law, axial_stretch: held };
        let (b, e) = (Dual::variable(x), Dual::constant(held));
        let stored = integral(1.0, outer, |s| {
            let (r, zero) = (Dual::constant(s), Dual::constant(0.0));
            energy(&law, [[r / (b * e), zero, zero], [zero, b / r, zero], [zero, zero, e]]) * r
        });
        let tension = straightening.point(x).expect("point").load;
        assert_close_at_scale("tension", &[tension], &[stored.tangent], scale, QUADRATURE);
        // A sheared sector: T_rθ is the derivative of the energy per volume by B.
        let shear = AzimuthalShear { law: &law, radial_stretch: held, angular_stretch: outer };
        let [a, c, zero] = [held, outer, 0.0].map(Dual::constant);
        let stored = energy(&law, [[a, zero, zero], [a * Dual::variable(x), a * c, zero], [zero, zero, (a * a * c).recip()]]);
        let traction = shear.point(x).expect("point").load;
        assert_close_at_scale("T_rθ", &[traction], &[stored.tangent], scale, QUADRATURE);
    }

    #[test]
    fn pressure_of_tube_and_sphere_equals_the_traction_on_the_inner_face(
        law in elastic(), outer in 1.01..2.0_f64, stretch in 1.05..2.5_f64, held in 0.8..1.4_f64,
    ) {
        let modulus = law.0[0] + law.0[3];
        for orientation in [Orientation::Kept, Orientation::Everted] {
            let body = SphereInflation { shell: Shell::new(1.0, outer).expect("shell"), law: &law, orientation };
            // Turned inside out, the face that was outside bounds the cavity.
            let [cavity, free] = if orientation == Orientation::Kept { [1.0, outer] } else { [outer, 1.0] };
            let datum = Datum::free_at([free, 0.0, 1.0]);
            let family = body.deformation(stretch).expect("deformation");
            let stress = family.stress(&law, &datum, [cavity, 0.0, 1.0]).expect("stress").cauchy.0.components[0];
            let pressure = body.point(stretch).expect("point").load;
            assert_close_at_scale("p", &[pressure], &[-stress], modulus, QUADRATURE);
        }
        for ends in [Ends::Stretch(held), Ends::Closed] {
            let tube = Tube::new(1.0, outer).expect("tube");
            let state = TubeInflation { tube, law: &law, ends }.state(stretch).expect("state");
            let datum = Datum::free_at([outer, 0.0, 0.0]);
            let at = |r: f64| state.deformation.stress(&law, &datum, [r, 0.0, 0.0]).expect("stress").cauchy.0.components;
            assert_close_at_scale("p", &[state.pressure], &[-at(1.0)[0]], modulus, QUADRATURE);
            // N = 2π ∫ T_zz r dr, with r dr = R dR/λ_z.
            let force = TAU * integral(1.0, outer, |r| at(r)[2] * r) / state.axial_stretch;
            assert_close_at_scale("N", &[state.axial_force], &[force], modulus * outer * outer, QUADRATURE);
        }
    }

    #[test]
    fn slopes_of_all_curves_equal_differences_of_their_loads(law in rubber(), x in 1.05..2.0_f64) {
        let tube = Tube::new(1.0, 1.6).expect("tube");
        let rod = Tube::solid(1.3).expect("rod");
        check_slope(&SphereInflation { shell: Shell::new(1.0, 1.2).expect("shell"), law: &law, orientation: Orientation::Kept }, x);
        for ends in [Ends::Stretch(1.2), Ends::Force(0.3), Ends::Closed] {
            check_slope(&TubeInflation { tube, law: &law, ends }, x);
            check_slope(&Torsion { tube, law: &law, ends }, 0.5 * x);
            check_slope(&Torsion { tube: rod, law: &law, ends }, 0.5 * x);
        }
        check_slope(&Bending { block: Block::new(1.0, 2.0, 0.5).expect("block"), law: &law, axial_stretch: 1.1 }, x);
        let sector = Sector::new([1.0, 2.0], [0.0, 1.0]).expect("sector");
        check_slope(&Straightening { sector, law: &law, axial_stretch: 1.1 }, x);
        for sides in [BlockSides::Free, BlockSides::Held, BlockSides::Pulled] {
            check_slope(&BlockExtension { block: Block::new(1.0, 2.0, 0.5).expect("block"), law: &law, sides }, x);
        }
        check_slope(&AzimuthalShear { law: &law, radial_stretch: 1.1, angular_stretch: 0.9 }, x);
    }
}

/// A difference of fourth order.
fn check_slope<C: LoadCurve>(curve: &C, x: f64) {
    let step = 1e-3;
    let at = |i: f64| curve.point(x + i * step).expect("point").load;
    let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    let slope = curve.point(x).expect("point").slope;
    let scale = at(0.0).abs() / x;
    assert_close_at_scale(
        C::LOAD,
        &[slope],
        &[difference],
        scale,
        Tol::stated(1e-9, "a difference of order 4 at 1e-3"),
    );
}

#[test]
fn torsion_resultants_equal_golden() {
    let mut count = 0;
    for case in load("universal").cases.iter().filter(|case| text(&case["kind"]) == "torsion_resultants") {
        let of = |name: &str| number(&case["params"][name]);
        let law = MooneyRivlin::new(of("c10"), of("c01")).expect("law");
        let tube = Tube::solid(of("R0")).expect("radius");
        let twisted = Torsion { tube, law: &law, ends: Ends::Stretch(of("lam")) }.state(of("psi")).expect("state");
        assert_close("M", &[twisted.torque], &[number(&case["output"]["M"])], QUADRATURE);
        assert_close("N", &[twisted.axial_force], &[number(&case["output"]["N"])], QUADRATURE);
        let found = torsion_under(&tube, &law, twisted.axial_force, twisted.torque).expect("state");
        assert_close("λ", &[found.axial_stretch, found.twist], &[of("lam"), of("psi")], QUADRATURE);
        count += 1;
    }
    assert_eq!(count, 2);
}

#[test]
fn balloon_of_mooney_and_rivlin_has_two_limit_points_and_three_states_between_them() {
    let law = MooneyRivlin::new(0.5, 0.03).expect("law");
    let thickness = 1e-5;
    let shell = Shell::new(1.0, 1.0 + thickness).expect("shell");
    let balloon = SphereInflation { shell, law: &law, orientation: Orientation::Kept };
    let limits = balloon.limit_points((1.0, 12.0)).expect("limits");
    assert_eq!(limits.len(), 2);
    // The membrane: p = 4 h (1/λ − 1/λ⁷)(C₁₀ + C₀₁ λ²).
    let membrane = |x: f64| 4.0 * thickness * (1.0 / x - x.powi(-7)) * (0.5 + 0.03 * x * x);
    for limit in &limits {
        let x = limit.parameter;
        assert_close("p", &[limit.load], &[membrane(x)], Tol::stated(4.0 * thickness, "thickness/radius"));
        assert!(limit.slope.abs() < 1e-12 * limit.load);
    }
    let between = 0.5 * (limits[0].load + limits[1].load);
    let states = balloon.states_at(between, (1.0, 12.0)).expect("states");
    assert_eq!(states.len(), 3);
    assert!(0.0 < states[0].slope && states[1].slope < 0.0 && 0.0 < states[2].slope);
    for state in &states {
        assert_close("p", &[state.load], &[between], Tol::ulps(256.0).times(1.0 / thickness));
    }
    let beyond = balloon.states_at(1.01 * limits[0].load, (1.0, 0.5 * (limits[0].parameter + limits[1].parameter)));
    let Err(SolutionsError::BeyondLimitPoint { limit, at, .. }) = beyond else { panic!("{beyond:?}") };
    assert_close(
        "limit",
        &[limit, at],
        &[limits[0].load, limits[0].parameter],
        Tol::stated(1e-9, "limit points by slope"),
    );
    let far = balloon.states_at(-1.0, (1.0, 2.0));
    assert!(matches!(far, Err(SolutionsError::NotReached { .. })), "{far:?}");
}

/// A load beyond the first limit point of a curve is refused with the limit; below it there are two states.
fn check_limit<C: LoadCurve>(curve: &C, range: (f64, f64)) {
    let limits = curve.limit_points(range).expect("limits");
    assert_eq!(limits.len(), 1, "{} over {}: {limits:?}", C::LOAD, C::PARAMETER);
    let beyond = curve.states_at(1.001 * limits[0].load, range);
    let Err(SolutionsError::BeyondLimitPoint { limit, at, load, .. }) = beyond else { panic!("{beyond:?}") };
    assert_eq!(load, C::LOAD);
    assert_close("limit", &[limit, at], &[limits[0].load, limits[0].parameter], Tol::ulps(4.0));
    let states = curve.states_at(0.9 * limits[0].load, range).expect("states");
    assert_eq!(states.len(), 2, "{states:?}");
    assert!(0.0 < states[0].slope && states[1].slope < 0.0);
}

/// The curve s x².
struct Parabola(f64);

impl LoadCurve for Parabola {
    const LOAD: &'static str = "load";
    const PARAMETER: &'static str = "x";

    fn load_and_slope(&self, x: f64) -> Result<[f64; 2], SolutionsError> {
        Ok([self.0 * x * x, 2.0 * self.0 * x])
    }
}

#[test]
fn a_limit_point_at_a_node_of_the_search_is_found_once() {
    for parabola in [Parabola(1.0), Parabola(-1.0)] {
        // x = 0 is the middle of 256 intervals, and exact.
        let limits = parabola.limit_points((-1.0, 1.0)).expect("limits");
        assert_eq!(limits.iter().map(|limit| [limit.parameter, limit.load]).collect::<Vec<_>>(), [[0.0; 2]]);
    }
}

/// g₁ = exp(−(I − 3)/5): a rubber that softens.
struct Softening;

impl ResponseFunctions for Softening {
    fn response<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        [(T::lit(-0.2) * first).exp(), T::zero()]
    }
}

#[test]
fn loads_beyond_a_limit_point_are_refused_with_the_limit_by_every_curve() {
    let law = NeoHookean::new(1.0).expect("law");
    let tube = Tube::new(1.0, 1.2).expect("tube");
    check_limit(&TubeInflation { tube, law: &law, ends: Ends::Closed }, (1.0, 6.0));
    let shell = Shell::new(1.0, 1.3).expect("shell");
    check_limit(&SphereInflation { shell, law: &law, orientation: Orientation::Kept }, (1.0, 6.0));
    let law = Softening;
    for ends in [Ends::Stretch(1.0), Ends::Force(0.0)] {
        check_limit(&TubeInflation { tube, law: &law, ends }, (1.0, 4.0));
        check_limit(&Torsion { tube: Tube::solid(1.0).expect("rod"), law: &law, ends }, (0.0, 5.0));
    }
    for sides in [BlockSides::Free, BlockSides::Held, BlockSides::Pulled] {
        check_limit(&BlockExtension { block: Block::new(1.0, 1.0, 1.0).expect("block"), law: &law, sides }, (1.0, 4.0));
    }
    check_limit(&AzimuthalShear { law: &law, radial_stretch: 1.0, angular_stretch: 1.0 }, (0.0, 4.0));
    check_limit(
        &Bending { block: Block::new(1.0, 1.0, 1.0).expect("block"), law: &law, axial_stretch: 1.0 },
        (0.1, 6.0),
    );
    let sector = Sector::new([1.0, 1.5], [0.0, 1.0]).expect("sector");
    check_limit(&Straightening { sector, law: &law, axial_stretch: 1.0 }, (1.3, 6.0));
}

#[test]
fn torque_beyond_the_limit_under_an_axial_force_is_refused_with_the_limit() {
    let (rod, law) = (Tube::solid(1.0).expect("rod"), Softening);
    for axial_force in [0.0, 0.1] {
        let curve = Torsion { tube: rod, law: &law, ends: Ends::Force(axial_force) };
        let [limit] = curve.limit_points((0.0, 5.0)).expect("limit points")[..] else { panic!("one limit point") };
        for sign in [1.0, -1.0] {
            let below = torsion_under(&rod, &law, axial_force, sign * 0.98 * limit.load).expect("a state");
            let residual =
                Tol::stated(1e-10, "residuals of the loads are held below 1e-11 of their scales, near a limit");
            assert_close(
                "loads",
                &[below.torque, below.axial_force],
                &[sign * 0.98 * limit.load, axial_force],
                residual,
            );
            assert!(below.twist.abs() < limit.parameter);
            let Err(SolutionsError::BeyondLimitPoint { limit: named, at, .. }) =
                torsion_under(&rod, &law, axial_force, sign * 1.02 * limit.load)
            else {
                panic!("a torque above the limit")
            };
            assert_close(
                "limit",
                &[named, at],
                &[sign * limit.load, sign * limit.parameter],
                Tol::stated(
                    1e-7,
                    "where the slope vanishes the place of a limit is known to the root of rounding only",
                ),
            );
        }
    }
}

#[test]
fn closed_thin_tube_carries_the_pressure_of_the_membrane() {
    let law = Gent::new(1.0, 50.0).expect("law");
    let thickness = 1e-5;
    let tube = Tube::new(1.0, 1.0 + thickness).expect("tube");
    let closed = TubeInflation { tube, law: &law, ends: Ends::Closed };
    for stretch in [1.1, 1.5, 2.5] {
        let state = closed.state(stretch).expect("state");
        // T_θθ = p r/h, T_zz = ½ T_θθ, with h = thickness/(λ λ_z): g (λ² − λ_r²) = 2 g (λ_z² − λ_r²).
        let (axial, radial) = (state.axial_stretch, 1.0 / (stretch * state.axial_stretch));
        let hoop = stretch * stretch - radial * radial;
        let tol = Tol::stated(4.0 * thickness, "thickness/radius");
        assert_close("½ T_θθ", &[axial * axial - radial * radial], &[0.5 * hoop], tol);
        let first = stretch * stretch + axial * axial + radial * radial - 3.0;
        let pressure = thickness * hoop / (1.0 - first / 50.0) / (stretch * stretch * axial);
        assert_close("p", &[state.pressure], &[pressure], Tol::stated(1e-4, "thickness/radius"));
        assert_close("N", &[state.axial_force], &[PI * stretch * stretch * state.pressure], QUADRATURE);
    }
}

#[test]
fn bent_block_is_free_of_pressure_and_of_resultant_force() {
    let law = MooneyRivlin::new(0.4, 0.2).expect("law");
    for (thickness, axial_stretch) in [(0.5, 1.0), (1.0, 1.3), (2.0, 0.8)] {
        let bending = Bending { block: Block::new(thickness, 2.0, 3.0).expect("block"), law: &law, axial_stretch };
        for angle in [0.5, 1.0, 3.0] {
            let bent = bending.state(angle).expect("state");
            assert!(bent.loads.normal_stresses[0].abs() < 1e-12);
            let datum = Datum::free_at([bent.faces[1], 0.0, 0.0]);
            let hoop =
                |x: f64| bent.deformation.stress(&law, &datum, [x, 0.0, 0.0]).expect("stress").cauchy.0.components[1];
            // ∫ T_θθ dr with dr = A/r dX
            let a = bent.deformation.constants()[0];
            let pull = integral(bent.faces[0], bent.faces[1], |x| hoop(x) * a / (2.0 * a * x).sqrt());
            let size = integral(bent.faces[0], bent.faces[1], |x| hoop(x).abs() * a / (2.0 * a * x).sqrt());
            assert_close_at_scale("force", &[pull], &[0.0], size, QUADRATURE);
            assert_close("thickness", &[bent.faces[1] - bent.faces[0]], &[thickness], Tol::ulps(64.0));
            let back = bending.states_at(bent.moment, (0.1, 6.0)).expect("states");
            assert!(back.iter().any(|state| (state.parameter - angle).abs() < 1e-10), "{angle}: {back:?}");
        }
    }
}

#[test]
fn everted_bodies_carry_no_loads() {
    let law = MooneyRivlin::new(0.4, 0.1).expect("law");
    for outer in [1.05, 1.3, 1.8] {
        let tube = Tube::new(1.0, outer).expect("tube");
        let everted = everted_tube(&tube, &law).expect("state");
        let loads = SectorLoads::of_tube(&everted.deformation, &law, (1.0, outer), 0.0).expect("loads");
        assert!(loads.normal_stresses[0].abs() < 1e-11, "{loads:?}");
        assert!(loads.axial_force.abs() < 1e-11, "{loads:?}");
        let volume = (everted.radii[1].powi(2) - everted.radii[0].powi(2)) * everted.axial_stretch;
        assert_close("volume", &[volume], &[outer * outer - 1.0], Tol::ulps(64.0));

        let shell = SphereInflation {
            shell: Shell::new(1.0, outer).expect("shell"),
            law: &law,
            orientation: Orientation::Everted,
        };
        let free = shell.states_at(0.0, (0.3, 3.0)).expect("states");
        assert_eq!(free.len(), 1, "{free:?}");
        assert!(free[0].load.abs() < 1e-13);
    }
}

#[test]
fn torsion_without_axial_force_lengthens_and_at_fixed_length_pushes() {
    let law = NeoHookean::new(2.0).expect("law");
    for tube in [Tube::solid(1.0).expect("rod"), Tube::new(0.5, 1.0).expect("tube")] {
        for twist in [1e-3, 0.2, 1.0] {
            let free = Torsion { tube, law: &law, ends: Ends::Force(0.0) }.state(twist).expect("state");
            let held = Torsion { tube, law: &law, ends: Ends::Stretch(1.0) }.state(twist).expect("state");
            assert!(1.0 < free.axial_stretch && held.axial_force < 0.0);
            let loads = SectorLoads::of_tube(&free.deformation, &law, (tube.inner(), 1.0), 0.0).expect("loads");
            assert_close_at_scale("N", &[TAU * loads.axial_force], &[0.0], TAU, QUADRATURE);
            if !tube.is_solid() {
                assert_close_at_scale("T_rr", &[loads.normal_stresses[0]], &[0.0], 2.0, QUADRATURE);
            }
        }
    }
}
