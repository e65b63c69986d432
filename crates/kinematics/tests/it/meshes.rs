//! Inertia of closed triangle meshes, and principal axes that are always the same.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::mesh::MeshSolid;
use piola_kinematics::{Attitude, Inertia, KinematicsError, Solid};
use piola_testkit::golden::{load, matrix, number, text, vector};
use piola_testkit::strategies::{finite, rotation, vector as numbers};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_order};
use proptest::prelude::*;

const FEW: Tol = Tol::ulps(64.0);

/// The profile of a solid of revolution at a fineness.
type Profile = fn(usize) -> Vec<[f64; 2]>;

type Mesh = (Vec<Vector3<f64>>, Vec<[usize; 3]>);

fn tetrahedron(corners: [Vector3<f64>; 4]) -> Mesh {
    let [a, b, c, d] = corners;
    let outward = 0.0 < (b - a).dot(&(c - a).cross(&(d - a)));
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    (if outward { vec![a, b, c, d] } else { vec![a, c, b, d] }, triangles)
}

fn cuboid(edges: [f64; 3]) -> Mesh {
    let half = |bit: usize, edge: f64| if bit == 0 { -0.5 * edge } else { 0.5 * edge };
    let vertices = (0..8).map(|i| Vector3::from_fn(|k, _| half(i >> k & 1, edges[k]))).collect();
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (vertices, squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// An octahedron whose triangles are split in four `levels` times, the new vertices on the unit sphere.
fn sphere(levels: u32) -> Mesh {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let mut vertices = vec![x, y, -x, -y, z, -z];
    let mut triangles: Vec<[usize; 3]> = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect();
    for _ in 0..levels {
        let mut middles = BTreeMap::new();
        let mut middle = |a: usize, b: usize| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                vertices.push((vertices[a] + vertices[b]).normalize());
                vertices.len() - 1
            })
        };
        let mut finer = Vec::with_capacity(4 * triangles.len());
        for [a, b, c] in triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    (vertices, triangles)
}

/// A closed profile (ρ, z), counter-clockwise seen with ρ to the right and z upwards, turned about z in n steps.
fn revolved(profile: &[[f64; 2]], steps: usize) -> Mesh {
    let mut vertices = Vec::new();
    let mut rings = Vec::new();
    for &[rho, z] in profile {
        let first = vertices.len();
        let count = if rho <= 0.0 { 1 } else { steps };
        vertices.extend((0..count).map(|i| {
            let (s, c) = (core::f64::consts::TAU * i as f64 / steps as f64).sin_cos();
            Vector3::new(rho * c, rho * s, z)
        }));
        rings.push((first, count));
    }
    let mut triangles = Vec::new();
    for (ring, next) in rings.iter().zip(rings.iter().cycle().skip(1)) {
        for i in 0..steps {
            let at = |(first, count): (usize, usize), i: usize| first + i % count;
            let (a, b, c, d) = (at(*ring, i), at(*ring, i + 1), at(*next, i + 1), at(*next, i));
            // At the axis one or both of the triangles are none.
            triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    (vertices, triangles)
}

/// Points on an arc of the profile, from angle to angle.
fn arc(centre: [f64; 2], radius: f64, from: f64, to: f64, steps: usize) -> Vec<[f64; 2]> {
    (0..=steps)
        .map(|i| {
            let (s, c) = (from + (to - from) * i as f64 / steps as f64).sin_cos();
            // Exactly on the axis at the poles.
            let rho = centre[0] + radius * c;
            [if rho.abs() <= 1.0e-12 { 0.0 } else { rho }, centre[1] + radius * s]
        })
        .collect()
}

#[test]
fn inertia_of_solids_of_revolution_is_the_limit_of_their_meshes_at_order_two() {
    use core::f64::consts::{FRAC_PI_2, TAU};
    let solids: [(Solid, Profile); 6] = [
        (Solid::Cylinder { radius: 0.5, height: 2.0 }, |_| vec![[0.0, -1.0], [0.5, -1.0], [0.5, 1.0], [0.0, 1.0]]),
        (Solid::Cone { radius: 0.5, height: 2.0 }, |_| vec![[0.0, 0.0], [0.5, 2.0], [0.0, 2.0]]),
        (Solid::HollowCylinder { inner_radius: 0.5, outer_radius: 0.75, height: 2.0 }, |_| {
            vec![[0.5, -1.0], [0.75, -1.0], [0.75, 1.0], [0.5, 1.0]]
        }),
        (Solid::Capsule { radius: 0.5, height: 1.5 }, |n| {
            [arc([0.0, -0.75], 0.5, -FRAC_PI_2, 0.0, n), arc([0.0, 0.75], 0.5, 0.0, FRAC_PI_2, n)].concat()
        }),
        (Solid::Torus { radius: 1.0, tube_radius: 0.375 }, |n| {
            let mut ring = arc([1.0, 0.0], 0.375, 0.0, TAU, 4 * n);
            ring.pop();
            ring
        }),
        (Solid::Sphere { radius: 1.5 }, |n| arc([0.0, 0.0], 1.5, -FRAC_PI_2, FRAC_PI_2, 2 * n)),
    ];
    for (shape, profile) in solids {
        let (mut steps, mut volumes, mut moments) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new()]);
        let (volume, inertia) = (shape.volume().expect("a volume"), shape.inertia(1.0).expect("a body").matrix());
        for level in 2..5_u32 {
            let n = 2_usize.pow(level);
            let found = solid(&revolved(&profile(n), 4 * n));
            steps.push(1.0 / n as f64);
            volumes.push((found.volume() - volume).abs());
            let found = found.inertia(1.0).expect("a body").matrix();
            moments[0].push((found[(0, 0)] - inertia[(0, 0)]).abs());
            moments[1].push((found[(2, 2)] - inertia[(2, 2)]).abs());
        }
        let what = format!("{shape:?}");
        assert_order(&format!("V of {what}"), &steps, &volumes, 2.0, 0.1);
        for moments in &moments {
            assert_order(&format!("I of {what}"), &steps, moments, 2.0, 0.1);
        }
    }
}

fn solid((vertices, triangles): &Mesh) -> MeshSolid {
    MeshSolid::new(vertices, triangles).expect("a closed mesh")
}

fn moved((vertices, triangles): &Mesh, by: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Mesh {
    (vertices.iter().map(by).collect(), triangles.clone())
}

#[test]
fn inertia_of_meshes_equals_that_of_the_reference_shapes() {
    let golden = Tol::stated(1.0e-13, "algebraic quantities of the reference files");
    let mut checked = 0;
    for case in &load("rigid_body").cases {
        let mesh = match text(&case["shape"]) {
            "cuboid" => cuboid(vector(&case["edges"]).try_into().expect("three edges")),
            "tetrahedron" => {
                let corners: Vec<_> = matrix(&case["vertices"]).iter().map(|x| Vector3::from_column_slice(x)).collect();
                tetrahedron(corners.try_into().expect("four corners"))
            }
            _ => continue,
        };
        checked += 1;
        let (name, solid) = (text(&case["name"]), solid(&mesh));
        assert_close(name, &[solid.volume()], &[number(&case["volume"])], golden);
        let centre = vector(&case["centre_of_mass"]);
        assert_close_at_scale(name, solid.centre_of_mass().as_slice(), &centre, 1.0, golden);
        let inertia = solid.inertia(number(&case["mass"])).expect("a body");
        assert_close(name, inertia.matrix().as_slice(), &matrix(&case["inertia_com"]).concat(), golden);
        assert_close(name, &inertia.principal_moments(), &vector(&case["principal_moments"]), golden);
    }
    assert!(2 <= checked);
}

#[test]
fn moments_of_meshes_converge_to_those_of_the_sphere_at_order_two() {
    let (mut steps, mut errors) = (Vec::new(), [Vec::new(), Vec::new(), Vec::new()]);
    let pi = core::f64::consts::PI;
    for levels in 2..6_u32 {
        let solid = solid(&sphere(levels));
        steps.push(0.5_f64.powi(i32::try_from(levels).expect("small")));
        errors[0].push((solid.volume() - 4.0 / 3.0 * pi).abs());
        errors[1].push((solid.surface_area() - 4.0 * pi).abs());
        let [least, _, largest] = solid.inertia(1.0).expect("a body").principal_moments();
        errors[2].push((least - 0.4).abs());
        assert_close("a cube's symmetry", &[least], &[largest], FEW);
    }
    for (what, errors) in ["V", "A", "I"].iter().zip(&errors) {
        assert_order(what, &steps, errors, 2.0, 0.05);
    }
}

proptest! {
    #[test]
    fn inertia_of_a_turned_and_shifted_mesh_equals_the_inertia_turned(
        edges in numbers(3, 0.3..2.0), q in rotation(), shift in numbers(3, -3.0..3.0)
    ) {
        let mesh = cuboid([edges[0], edges[1], edges[2]]);
        let q = Attitude::from_quaternion(q).expect("unit");
        let shift = Vector3::from_column_slice(&shift);
        let there = solid(&moved(&mesh, |x| q.to_space(x) + shift));
        let here = solid(&mesh);
        assert_close("V", &[there.volume()], &[here.volume()], FEW);
        assert_close("A", &[there.surface_area()], &[here.surface_area()], FEW);
        assert_close_at_scale("c", there.centre_of_mass().as_slice(), shift.as_slice(), 2.0, FEW);
        let expected = here.inertia(3.0).expect("a body").rotated(q);
        let found = there.inertia(3.0).expect("a body");
        assert_close("I", found.matrix().as_slice(), expected.matrix().as_slice(), FEW);
    }

    #[test]
    fn inertia_of_a_tetrahedral_mesh_equals_that_of_the_solid(corners in numbers(12, -2.0..2.0)) {
        let corners: [Vector3<f64>; 4] = core::array::from_fn(|i| Vector3::from_column_slice(&corners[3 * i..3 * i + 3]));
        let volume = (corners[1] - corners[0]).dot(&(corners[2] - corners[0]).cross(&(corners[3] - corners[0]))).abs();
        prop_assume!(0.01 < volume);
        let expected = Solid::Tetrahedron { vertices: corners.map(Into::into) };
        let found = solid(&tetrahedron(corners));
        // The volume of a sliver is a difference of larger products.
        let condition = 64.0 / volume;
        assert_close("V", &[found.volume()], &[expected.volume().expect("a volume")], Tol::ulps(4.0).times(condition));
        let (found, expected) = (found.inertia(2.0).expect("a body"), expected.inertia(2.0).expect("a body"));
        assert_close("I", found.matrix().as_slice(), expected.matrix().as_slice(), Tol::ulps(4.0).times(condition));
    }

    #[test]
    fn principal_axes_of_a_body_do_not_depend_on_rounding(moments in numbers(2, 1.2..2.1), q in rotation(), noise in finite(-1.0..1.0)) {
        prop_assume!(0.01 < (moments[0] - moments[1]).abs());
        let inertia = Inertia::principal([moments[0], moments[1], 2.2]).expect("a body");
        let inertia = inertia.rotated(Attitude::from_quaternion(q).expect("unit"));
        let nudged = Inertia::new(inertia.matrix() + Matrix3::from_element(4.0 * f64::EPSILON * noise)).expect("a body");
        let (a, b) = (inertia.principal_axes(), nudged.principal_axes());
        let largest = |axes: &Matrix3<f64>, column: usize| {
            let mut sizes: [f64; 3] = axes.column(column).map(f64::abs).into();
            sizes.sort_by(f64::total_cmp);
            sizes[2] - sizes[1]
        };
        // Where two components are equally large, no rule is continuous.
        prop_assume!(1.0e-6 < largest(&a.axes, 0).min(largest(&a.axes, 1)));
        assert_close("A", a.axes.as_slice(), b.axes.as_slice(), Tol::ulps(64.0).times(2.2 / 0.01));
    }

    #[test]
    fn principal_axes_of_a_body_of_revolution_rebuild_its_inertia(q in rotation(), unique in finite(0.1..1.9), last in 0_usize..3) {
        let mut moments = [1.0; 3];
        moments[last] = unique;
        let inertia = Inertia::principal(moments).expect("a body").rotated(Attitude::from_quaternion(q).expect("unit"));
        let principal = inertia.principal_axes();
        let a = principal.axes;
        assert_close("A Aᵀ", (a * a.transpose()).as_slice(), Matrix3::<f64>::identity().as_slice(), FEW);
        assert_close("det A", &[a.determinant()], &[1.0], FEW);
        let rebuilt = a * Matrix3::from_diagonal(&Vector3::from(principal.moments)) * a.transpose();
        assert_close("I", rebuilt.as_slice(), inertia.matrix().as_slice(), FEW);
    }
}

#[test]
fn principal_axes_of_equal_moments_equal_body_axes() {
    for (moments, expected) in [
        ([1.0, 1.0, 1.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ([1.0, 1.0, 1.5], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ([0.5, 1.0, 1.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ([1.5, 1.0, 1.0], [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        ([1.0, 1.0, 0.5], [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        ([1.0, 1.5, 1.0], [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    ] {
        // With rounding in the tensor, which splits the equal moments and would turn their axes anywhere.
        for noise in [0.0, f64::EPSILON, -f64::EPSILON] {
            let nudge = Matrix3::new(noise, noise, 0.0, noise, 0.0, -noise, 0.0, -noise, -noise);
            let inertia = Inertia::new(Matrix3::from_diagonal(&Vector3::from(moments)) + nudge).expect("a body");
            let axes = inertia.principal_axes().axes;
            assert_close(&format!("{moments:?}"), axes.as_slice(), &expected.concat(), Tol::stated(1.0e-14, "ε/0.5"));
        }
    }
}

#[test]
fn mesh_far_from_the_origin_equals_mesh_near_it() {
    // Coordinates of few digits, so that the distance costs none of them.
    let near = moved(&cuboid([0.5, 1.25, 2.0]), |x| Vector3::new(x.x + 0.25 * x.y, x.y - 0.5 * x.z, x.z));
    let here = solid(&near);
    for distance in [1.0e3, 1.0e6, 1.0e9, 1.0e12] {
        let offset = Vector3::new(distance, -2.0 * distance, 0.5 * distance);
        let there = solid(&moved(&near, |x| x + offset));
        assert_close("V", &[there.volume()], &[here.volume()], Tol::ulps(8.0));
        let (found, expected) = (there.inertia(2.0).expect("a body"), here.inertia(2.0).expect("a body"));
        assert_close("I", found.matrix().as_slice(), expected.matrix().as_slice(), Tol::ulps(8.0));
        assert_close(
            "c",
            there.centre_of_mass().as_slice(),
            (here.centre_of_mass() + offset).as_slice(),
            Tol::ulps(1.0),
        );
    }
}

#[test]
fn hollow_mesh_equals_outside_less_inside() {
    let (outer, inner) = (cuboid([2.0, 3.0, 4.0]), cuboid([1.0, 1.0, 1.0]));
    let (mut vertices, mut triangles) = outer.clone();
    let first = vertices.len();
    vertices.extend(inner.0.iter());
    // The cavity is seen from inside the solid.
    triangles.extend(inner.1.iter().map(|&[a, b, c]| [a + first, c + first, b + first]));
    let hollow = MeshSolid::new(&vertices, &triangles).expect("a hollow solid");
    assert_close("V", &[hollow.volume()], &[24.0 - 1.0], FEW);
    let expected =
        solid(&outer).inertia(24.0).expect("a body").matrix() - solid(&inner).inertia(1.0).expect("a body").matrix();
    assert_close("I", hollow.inertia(23.0).expect("a body").matrix().as_slice(), expected.as_slice(), FEW);
}

#[test]
fn bad_rings_are_refused_by_name() {
    let refused = Solid::HollowCylinder { inner_radius: 1.0, outer_radius: 1.0, height: 1.0 }.volume();
    assert!(matches!(refused, Err(KinematicsError::NonPositiveSize { .. })), "{refused:?}");
    let refused = Solid::Torus { radius: 1.0, tube_radius: 1.5 }.inertia(1.0);
    let expected = KinematicsError::NonPositiveSize { quantity: "radius less tube radius", value: -0.5 };
    assert_eq!(refused, Err(expected));
    assert!(matches!(
        Solid::Capsule { radius: -1.0, height: 1.0 }.body(1.0),
        Err(KinematicsError::NonPositiveSize { .. })
    ));
}

#[test]
fn bad_meshes_are_refused_by_name() {
    let (vertices, triangles) = cuboid([1.0, 1.0, 1.0]);
    let refused = |vertices: &[Vector3<f64>], triangles: &[[usize; 3]]| {
        MeshSolid::new(vertices, triangles).expect_err("not a closed mesh")
    };
    assert_eq!(refused(&vertices, &[]), KinematicsError::NoVolume { volume: 0.0 });
    assert!(matches!(refused(&vertices, &triangles[1..]), KinematicsError::MeshNotClosed { .. }));
    let mut one_turned = triangles.clone();
    one_turned[5].swap(0, 1);
    let found = refused(&vertices, &one_turned);
    let KinematicsError::MeshOrientation { triangles: (a, b), .. } = found else { panic!("{found:?}") };
    assert!(a == 5 || b == 5);
    let all_turned: Vec<_> = triangles.iter().map(|&[a, b, c]| [b, a, c]).collect();
    let found = refused(&vertices, &all_turned);
    assert!(matches!(found, KinematicsError::MeshInverted { volume } if (volume + 1.0).abs() <= f64::EPSILON));
    let mut beyond = triangles.clone();
    beyond[3][1] = 8;
    let found = refused(&vertices, &beyond);
    assert_eq!(found, KinematicsError::MeshIndex { triangle: 3, corner: 1, index: 8, vertices: 8 });
    let mut repeated = triangles.clone();
    repeated[3] = [1, 1, 2];
    assert_eq!(refused(&vertices, &repeated), KinematicsError::MeshTriangle { triangle: 3, vertices: [1, 1, 2] });
    let mut infinite = vertices.clone();
    infinite[2].y = f64::INFINITY;
    assert!(matches!(refused(&infinite, &triangles), KinematicsError::NotFinite { index: 7, .. }));
    let flat: Vec<_> = vertices.iter().map(|x| Vector3::new(x.x + 0.3 * x.y, x.y, 0.7 * x.x)).collect();
    assert!(matches!(refused(&flat, &triangles), KinematicsError::NoVolume { .. }));
}

#[test]
fn meshes_beyond_the_range_of_numbers_are_refused() {
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let corner = |size: f64| [Vector3::zeros(), Vector3::x() * size, Vector3::y() * size, Vector3::z() * size];
    for size in [1e80, 1e120, 1e300] {
        let found = MeshSolid::new(&corner(size), &triangles).expect_err("too large");
        assert!(matches!(found, KinematicsError::NotFinite { .. }), "{size}: {found}");
    }
    let large = MeshSolid::new(&corner(1e60), &triangles).expect("a solid");
    assert_close("volume", &[large.volume()], &[1e180 / 6.0], Tol::ulps(8.0));
}
