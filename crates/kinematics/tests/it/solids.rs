//! Volume, centre of mass and inertia of every solid against their defining integrals.

use core::convert::Infallible;
use core::f64::consts::PI;

use nalgebra::Vector3;
use piola_kinematics::Solid;
use piola_numerics::quadrature::{GaussKronrod, Panel, Quadpack, integrate};
use piola_testkit::{Tol, assert_close, assert_each_close};

const FEW: Tol = Tol::ulps(8.0);

/// The mass of all solids here, kg.
const MASS: f64 = 3.0;

/// A solid, its volume, the height of its centre of mass and its moments about the axes through it.
///
/// ```text
/// V = ∫ dV     z^c = ∫ z dV/V     I = M/V ∫ (|r|² 1 − r⊗r) dV from the centre of mass; of shell and disc over the surface
/// ```
///
/// The integrals by mpmath's `quad` in 30 digits: of solids of revolution over slices of radius ρ(z), with
/// π/2 ρ⁴ dz about the axis and (π/4 ρ⁴ + π ρ² z²) dz across; of the torus over the angle of its tube; of the cuboid threefold;
/// of the ellipsoid over elliptic slices; of the shell over zones 2πR² sin t dt; of the disc over rings. Formulas in print:
/// J. L. Meriam, L. G. Kraige, *Engineering Mechanics: Dynamics*, 7th ed., Wiley 2012, table D/4.
#[rustfmt::skip]
const INTEGRALS: [(Solid, f64, f64, [f64; 3]); 10] = [
    (Solid::Cuboid { edges: [0.5, 1.25, 2.0] }, 1.25, 0.0, [1.390_625, 1.0625, 0.453_125]),
    (Solid::Cylinder { radius: 0.75, height: 2.5 }, 4.417_864_669_110_647, 0.0, [1.984_375, 1.984_375, 0.843_75]),
    (Solid::HollowCylinder { inner_radius: 0.25, outer_radius: 0.75, height: 2.5 },
        3.926_990_816_987_241_5, 0.0, [2.031_25, 2.031_25, 0.9375]),
    (Solid::Capsule { radius: 0.75, height: 1.5 }, 4.417_864_669_110_647, 0.0, [2.041_875, 2.041_875, 0.776_25]),
    (Solid::Torus { radius: 2.0, tube_radius: 0.5 }, 9.869_604_401_089_358, 0.0, [6.468_75, 6.468_75, 12.5625]),
    (Solid::Sphere { radius: 1.25 }, 8.181_230_868_723_42, 0.0, [1.875; 3]),
    (Solid::SphericalShell { radius: 1.25 }, 8.181_230_868_723_42, 0.0, [3.125; 3]),
    (Solid::Cone { radius: 0.75, height: 2.0 }, 1.178_097_245_096_172_5, 1.5, [0.703_125, 0.703_125, 0.506_25]),
    (Solid::Ellipsoid { semi_axes: [0.5, 1.0, 1.75] }, 3.665_191_429_188_092, 0.0, [2.4375, 1.9875, 0.75]),
    (Solid::Disc { radius: 0.75 }, 0.0, 0.0, [0.421_875, 0.421_875, 0.843_75]),
];

#[test]
fn volume_centre_and_inertia_equal_their_integrals() {
    for (solid, volume, height, moments) in INTEGRALS {
        let what = format!("{solid:?}");
        assert_each_close(&what, &[solid.volume().expect("a solid")], &[volume], FEW);
        let centre = solid.centre_of_mass().expect("a solid");
        assert_each_close(&what, centre.as_slice(), &[0.0, 0.0, height], FEW);
        let inertia = solid.inertia(MASS).expect("a solid");
        let matrix = inertia.matrix();
        assert_each_close(&what, matrix.diagonal().as_slice(), &moments, FEW);
        assert_each_close(&what, &[matrix[(0, 1)], matrix[(0, 2)], matrix[(1, 2)]], &[0.0; 3], FEW);
        let body = solid.body(MASS).expect("a body");
        assert_each_close(&what, &[body.mass()], &[MASS], FEW);
        assert_eq!(body.inertia(), &inertia, "{what}");
        // Proportional to the mass.
        let double = solid.inertia(2.0 * MASS).expect("a solid").matrix();
        assert_each_close(&what, double.diagonal().as_slice(), &moments.map(|moment| 2.0 * moment), FEW);
    }
}

#[test]
fn volume_centre_and_inertia_of_a_tetrahedron_equal_their_integrals() {
    // x + y/2 + z/3 ≤ 1 in the first octant, the threefold integrals by mpmath; and far from the origin.
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let moments = [1.4625, 0.075, 0.1125, 0.075, 1.125, 0.225, 0.1125, 0.225, 0.5625];
    for shift in [0.0, 1024.0] {
        let solid = Solid::Tetrahedron { vertices: corner.map(|vertex| vertex.map(|x| x + shift)) };
        assert_each_close("V", &[solid.volume().expect("a solid")], &[1.0], FEW);
        let centre = solid.centre_of_mass().expect("a solid") - Vector3::repeat(shift);
        assert_each_close("centre", centre.as_slice(), &[0.25, 0.5, 0.75], FEW);
        let inertia = solid.inertia(MASS).expect("a solid").matrix();
        assert_each_close("I", inertia.as_slice(), &moments, FEW);
    }
}

/// ∫ f from 0 to an end, to rounding.
fn integral(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let to_rounding = |values: &[f64; 1], _: &[f64; 1]| [1e-13 * values[0].abs()];
    let method = (&GaussKronrod::POINTS_21, &Quadpack);
    let mut panels = [Panel::EMPTY; 16];
    let found = integrate(&mut panels, [(0.0, end)], method, &to_rounding, |_, x| Ok::<_, Infallible>([f(x)]));
    found.expect("infallible").values[0]
}

#[test]
fn inertia_of_surfaces_equals_the_sum_over_their_rings() {
    for radius in [0.3, 1.0, 7.5] {
        // Rings of the radius r have r² about their axis and half of that, and the square of their height, across.
        let density = MASS / (4.0 * PI * radius * radius);
        let ring = |t: f64| density * (2.0 * PI * radius * t.sin()) * radius;
        let along = integral(PI, |t| ring(t) * (radius * t.sin()).powi(2));
        let across = integral(PI, |t| ring(t) * (0.5 * (radius * t.sin()).powi(2) + (radius * t.cos()).powi(2)));
        let shell = Solid::SphericalShell { radius }.inertia(MASS).expect("a shell").matrix();
        assert_close("shell", shell.diagonal().as_slice(), &[across, across, along], Tol::ulps(32.0));
        let density = MASS / (PI * radius * radius);
        let along = integral(radius, |r| density * 2.0 * PI * r * r * r);
        let disc = Solid::Disc { radius }.inertia(MASS).expect("a disc").matrix();
        assert_close("disc", disc.diagonal().as_slice(), &[0.5 * along, 0.5 * along, along], Tol::ulps(32.0));
    }
}
