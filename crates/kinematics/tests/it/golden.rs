//! Reference values of independent high-precision computations.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::curve::{Curve, Derivatives, Frenet};
use piola_kinematics::solids::Solid;
use piola_kinematics::{Attitude, BodyMotion, EulerAngles, EulerSequence, Inertia, ParticleSystem, RigidBody};
use piola_numerics::Real;
use piola_testkit::golden::{load, matrix, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const GOLDEN: Tol = Tol::stated(1.0e-13, "algebraic quantities of the reference files");

type Case = serde_json::Value;

fn triple(value: &Case) -> [f64; 3] {
    vector(value).try_into().expect("three numbers")
}

fn point(value: &Case) -> Vector3<f64> {
    Vector3::from(triple(value))
}

fn points(value: &Case) -> Vec<Vector3<f64>> {
    matrix(value).iter().map(|row| Vector3::from_column_slice(row)).collect()
}

/// A matrix by rows.
fn rows(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

fn check(name: &str, what: &str, actual: &[f64], expected: &[f64]) {
    assert_close(&format!("{name}: {what}"), actual, expected, GOLDEN);
}

fn check_at_scale(name: &str, what: &str, actual: f64, expected: f64, scale: f64) {
    assert_close_at_scale(&format!("{name}: {what}"), &[actual], &[expected], scale, GOLDEN);
}

#[test]
fn eulerian_angles_equal_reference() {
    let mut compared = 0;
    for case in load("euler_angles").cases.iter().filter(|case| case.get("theta_list").is_none()) {
        let name = text(&case["name"]);
        let euler = EulerAngles::zyz(triple(&case["theta"]));
        let expected = matrix(&case["Q"]).concat();
        check(name, "Q", &rows(&euler.matrix()), &expected);
        check(name, "Q of the quaternion", &rows(&euler.attitude().to_matrix()), &expected);
        let (rates, second) = (triple(&case["theta_dot"]), triple(&case["theta_ddot"]));
        check(name, "W", &rows(&euler.rate_matrix()), &matrix(&case["W"]).concat());
        check(name, "det W", &[euler.rate_matrix_determinant()], &[number(&case["det_W"])]);
        let omega = euler.angular_velocity_in_body(rates);
        check(name, "ω body", omega.as_slice(), &vector(&case["omega_body"]));
        let in_space = euler.angular_velocity_in_space(rates);
        check(name, "ω space", in_space.as_slice(), &vector(&case["omega_space"]));
        let body_rate = euler.angular_acceleration_in_body(rates, second);
        check(name, "ω̇ body", body_rate.as_slice(), &vector(&case["domega_body_dt"]));
        let space_rate = euler.angular_acceleration_in_space(rates, second);
        check(name, "ω̇ space", space_rate.as_slice(), &vector(&case["domega_space_dt"]));
        let inverted = euler.rates(&point(&case["omega_body"])).expect("not a gimbal point");
        let tolerance = Tol::ulps(8.0).times(inverted.condition_number);
        assert_close(&format!("{name}: θ̇ from ω"), &inverted.rates, &rates, tolerance);
        compared += 1;
    }
    assert_eq!(compared, 6);
}

#[test]
fn composed_attitudes_equal_reference() {
    let mut compared = 0;
    for case in load("euler_angles").cases.iter().filter(|case| case.get("theta_list").is_some()) {
        compared += 1;
        let name = text(&case["name"]);
        // Each rotation about the axes reached so far: later ones stand on the right.
        let attitude = matrix(&case["theta_list"]).iter().fold(Attitude::identity(), |reached, theta| {
            reached.product(Attitude::from_euler_zyz([theta[0], theta[1], theta[2]]))
        });
        check(name, "Q", &rows(&attitude.to_matrix()), &matrix(&case["Q"]).concat());
        let angles = EulerAngles::of_attitude(EulerSequence::Zyz, attitude).angles();
        check(name, "angles", &angles.theta, &vector(&case["theta_of_composition"]));
        let from_matrix = Attitude::from_matrix(&attitude.to_matrix()).expect("a rotation");
        check(name, "Q of Q's quaternion", &rows(&from_matrix.to_matrix()), &matrix(&case["Q"]).concat());
    }
    assert_eq!(compared, 2);
}

/// The curves of the file; parameters in alphabetical order do not help a reader, so each has its name.
struct NamedCurve<'a> {
    name: &'a str,
    parameters: &'a Case,
}

impl Curve for NamedCurve<'_> {
    fn position<T: Real>(&self, t: T) -> Vector3<T> {
        let p = |name: &str| T::lit(number(&self.parameters[name]));
        match self.name {
            "helix" => {
                let (s, c) = (t * p("w")).sin_cos();
                Vector3::new(p("R") * c, p("R") * s, p("c") * t)
            }
            "ellipse" | "ellipse_vertex" => {
                let (s, c) = (t * p("w")).sin_cos();
                Vector3::new(p("a") * c, p("b") * s, T::zero())
            }
            "cubic" => Vector3::new(p("a") * t, p("b") * t * t, p("c") * t * t * t),
            "cubic_shifted" => {
                Vector3::new(p("a") * t + p("d"), p("b") * t * t - t, p("a") * t * t + p("c") * t * t * t)
            }
            unknown => panic!("no curve {unknown}"),
        }
    }
}

#[test]
fn frenet_data_equal_reference() {
    let mut compared = 0;
    for case in load("curves").cases.iter().filter(|case| text(&case["kind"]) == "curve") {
        compared += 1;
        let name = text(&case["name"]);
        let curve = NamedCurve { name, parameters: &case["parameters"] };
        let t = number(&case["t"]);
        let x = Derivatives::of_curve(&curve, t);
        check(name, "position", x.position.as_slice(), &vector(&case["position"]));
        check(name, "velocity", x.velocity.as_slice(), &vector(&case["velocity"]));
        check(name, "acceleration", x.acceleration.as_slice(), &vector(&case["acceleration"]));
        check(name, "jerk", x.jerk.as_slice(), &vector(&case["jerk"]));
        let Frenet::Curved(path) = Frenet::of_curve(&curve, t).expect("finite") else {
            panic!("{name} is curved");
        };
        check(name, "speed", &[path.speed], &[number(&case["speed"])]);
        check(name, "tangent", path.tangent.as_slice(), &vector(&case["tangent"]));
        check(name, "normal", path.normal.as_slice(), &vector(&case["normal"]));
        check(name, "binormal", path.binormal.as_slice(), &vector(&case["binormal"]));
        let acceleration = x.acceleration.norm();
        let tangential = number(&case["tangential_acceleration"]);
        check_at_scale(name, "s̈", path.tangential_acceleration, tangential, acceleration);
        check(name, "v²κ", &[path.normal_acceleration], &[number(&case["normal_acceleration"])]);
        check(name, "κ", &[path.curvature], &[number(&case["curvature"])]);
        check(name, "1/κ", &[path.radius_of_curvature()], &[number(&case["radius_of_curvature"])]);
        check_at_scale(name, "τ", path.torsion, number(&case["torsion"]), path.curvature);
    }
    assert_eq!(compared, 5);
}

#[test]
fn koenig_splits_equal_reference() {
    let mut compared = 0;
    for case in load("curves").cases.iter().filter(|case| text(&case["kind"]) == "system") {
        compared += 1;
        let name = text(&case["name"]);
        let masses = vector(&case["masses"]);
        let (x, v, a) = (points(&case["positions"]), points(&case["velocities"]), points(&case["accelerations"]));
        let system = ParticleSystem::new(&masses, &x, &v).expect("a system");
        let of = |key: &str| vector(&case[key]);
        check(name, "M", &[system.mass()], &[number(&case["total_mass"])]);
        check(name, "r^c", system.centre_of_mass().as_slice(), &of("centre_of_mass"));
        check(name, "v^c", system.velocity_of_centre_of_mass().as_slice(), &of("velocity_com"));
        check(name, "L", system.momentum().as_slice(), &of("momentum"));
        let moment = system.angular_momentum(&Vector3::zeros());
        check(name, "H relative", moment.relative.as_slice(), &of("H_com"));
        check(name, "H of c", moment.of_centre_of_mass.as_slice(), &of("H_of_com_about_origin"));
        check(name, "H", moment.total().as_slice(), &of("H_origin"));
        let energy = system.kinetic_energy();
        check(name, "E relative", &[energy.relative], &[number(&case["E_relative"])]);
        check(name, "E of c", &[energy.of_centre_of_mass], &[number(&case["E_of_com"])]);
        check(name, "E", &[energy.total()], &[number(&case["E"])]);
        let rates = system.rates(&a, &Vector3::zeros()).expect("rates");
        check(name, "a^c", rates.acceleration_of_centre_of_mass.as_slice(), &of("acceleration_com"));
        check(name, "dL/dt", rates.momentum.as_slice(), &of("force_total"));
        check(name, "dH/dt relative", rates.angular_momentum.relative.as_slice(), &of("dH_com_dt"));
        check(name, "dH/dt", rates.angular_momentum.total().as_slice(), &of("dH_origin_dt"));
        check(name, "dE/dt", &[rates.kinetic_energy.total()], &[number(&case["power"])]);
        let inertia = system.inertia_about_centre_of_mass();
        check(name, "I", &rows(&inertia), &matrix(&case["inertia_about_com"]).concat());
    }
    assert_eq!(compared, 2);
}

fn solid(case: &Case) -> Solid {
    let size = |key: &str| number(&case[key]);
    match text(&case["shape"]) {
        "cuboid" => Solid::Cuboid { edges: triple(&case["edges"]) },
        "cylinder" => Solid::Cylinder { radius: size("radius"), height: size("height") },
        "sphere" => Solid::Sphere { radius: size("radius") },
        "cone" => Solid::Cone { radius: size("radius"), height: size("height") },
        "ellipsoid" => Solid::Ellipsoid { semi_axes: triple(&case["semi_axes"]) },
        "tetrahedron" => {
            let vertices: Vec<[f64; 3]> = points(&case["vertices"]).into_iter().map(Into::into).collect();
            Solid::Tetrahedron { vertices: vertices.try_into().expect("four corners") }
        }
        unknown => panic!("no solid {unknown}"),
    }
}

#[test]
fn inertia_of_solids_equals_reference() {
    for case in &load("rigid_body").cases {
        let name = text(&case["name"]);
        let (solid, mass) = (solid(case), number(&case["mass"]));
        check(name, "volume", &[solid.volume().expect("volume")], &[number(&case["volume"])]);
        let centre = solid.centre_of_mass().expect("centre");
        check(name, "centre of mass", centre.as_slice(), &vector(&case["centre_of_mass"]));
        let inertia = solid.inertia(mass).expect("inertia");
        check(name, "I", &rows(&inertia.matrix()), &matrix(&case["inertia_com"]).concat());
        check(name, "principal", &inertia.principal_moments(), &vector(&case["principal_moments"]));
        let offset = point(&case["offset_body"]);
        let about_offset = inertia.about_offset_point(mass, &offset);
        check(name, "I_P", &rows(&about_offset), &matrix(&case["inertia_about_offset_point"]).concat());
        let back = Inertia::about_centre_of_mass(about_offset, mass, &offset).expect("inertia");
        check(name, "I from I_P", &rows(&back.matrix()), &matrix(&case["inertia_com"]).concat());
    }
}

#[test]
fn motion_of_rigid_bodies_equals_reference() {
    for case in &load("rigid_body").cases {
        let name = text(&case["name"]);
        let body: RigidBody = solid(case).body(number(&case["mass"])).expect("a body");
        let euler = EulerAngles::zyz(triple(&case["theta"]));
        let (rates, second) = (triple(&case["theta_dot"]), triple(&case["theta_ddot"]));
        let motion = BodyMotion {
            attitude: euler.attitude(),
            velocity: point(&case["velocity_com_space"]),
            angular_velocity: euler.angular_velocity_in_body(rates),
            angular_acceleration: euler.angular_acceleration_in_body(rates, second),
            ..BodyMotion::at_rest()
        };
        let (omega, omega_rate) = (&motion.angular_velocity, &motion.angular_acceleration);
        let zero = Vector3::zeros();
        check(name, "ω", omega.as_slice(), &vector(&case["omega_body"]));
        check(name, "ω̇", omega_rate.as_slice(), &vector(&case["domega_body_dt"]));
        let turning = body.kinetic_energy(&zero, omega);
        check(name, "E of rotation", &[turning], &[number(&case["kinetic_energy_rotation"])]);
        let moving = body.kinetic_energy(&motion.velocity, &zero);
        check(name, "E of translation", &[moving], &[number(&case["kinetic_energy_translation"])]);
        let energy = body.kinetic_energy(&motion.velocity, omega);
        check(name, "E", &[energy], &[number(&case["kinetic_energy"])]);
        check(name, "Iω", body.spin_in_body(omega).as_slice(), &vector(&case["H_com_body"]));
        let about_centre = body.angular_momentum(&motion, &motion.position);
        check(name, "H about c", about_centre.as_slice(), &vector(&case["H_com_space"]));
        let spin_rate = body.spin_rate_in_body(omega, omega_rate);
        check(name, "dH/dt in body", spin_rate.as_slice(), &vector(&case["dH_com_dt_body"]));
        let in_space = body.angular_momentum_rate(&motion, &motion.position);
        check(name, "dH/dt in space", in_space.as_slice(), &vector(&case["dH_com_dt_space"]));
        let power = body.kinetic_energy_rate(&zero, &zero, omega, omega_rate);
        let scale = omega.norm() * body.spin_in_body(omega_rate).norm();
        check_at_scale(name, "dE/dt", power, number(&case["dE_rotation_dt"]), scale);
        let pivot = motion.attitude.to_space(&point(&case["offset_body"]));
        let about_pivot = body.angular_momentum(&motion, &pivot);
        check(name, "H about P", about_pivot.as_slice(), &vector(&case["H_about_offset_point_space"]));
    }
}
