//! Identities that hold for all inputs, named by their two sides.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use piola_kinematics::curve::Frenet;
use piola_kinematics::euler_angles::AnglesOfAttitude;
use piola_kinematics::particle::{self, Motion, MovingFrame};
use piola_kinematics::placement::PlacementEvaluator;
use piola_kinematics::rigid_body::{angular_velocity_of_basis, velocity_of_embedded_point};
use piola_kinematics::solids::{body_of_particles, thin_rod};
use piola_kinematics::system::largest_distance_change;
use piola_kinematics::{
    Attitude, BodyMotion, BodyPose, BodyVelocity, EulerAngles, EulerSequence, ParticleSystem, RigidBody, Solid,
};
use piola_numerics::{Dual, Gradient, Jet, Lanes, Real};
use piola_testkit::strategies::{finite, rotation, unit_vector, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::{DoublePendulum, TopOnTable};

const FEW: Tol = Tol::ulps(64.0);

fn triple() -> impl Strategy<Value = Vector3<f64>> {
    vector(3, -2.0..2.0).prop_map(|v| Vector3::from_column_slice(&v))
}

fn attitude() -> impl Strategy<Value = Attitude<f64>> {
    rotation().prop_map(|q| Attitude::from_quaternion(q).expect("a unit quaternion"))
}

fn angles() -> impl Strategy<Value = [f64; 3]> {
    (finite(-3.1..3.1), finite(0.05..3.09), finite(-3.1..3.1)).prop_map(|(a, b, c)| [a, b, c])
}

fn particles() -> impl Strategy<Value = (Vec<f64>, Vec<Vector3<f64>>, Vec<Vector3<f64>>)> {
    (4_usize..9).prop_flat_map(|n| {
        let vectors = || proptest::collection::vec(triple(), n);
        (vector(n, 0.1..5.0), vectors(), vectors())
    })
}

fn body() -> impl Strategy<Value = RigidBody> {
    (vector(3, 0.3..2.0), attitude(), finite(0.5..5.0)).prop_map(|(edges, attitude, mass)| {
        let inertia = Solid::Cuboid { edges: [edges[0], edges[1], edges[2]] }.inertia(mass).expect("a cuboid");
        RigidBody::new(mass, inertia.rotated(attitude)).expect("a body")
    })
}

/// The attitude at rates: (value, derivative) as a dual attitude.
fn moving(attitude: Attitude<f64>, omega: &Vector3<f64>) -> Attitude<Dual<f64>> {
    let rate = attitude.rate(omega);
    let value = <[f64; 4]>::from(attitude);
    let [w, x, y, z] = core::array::from_fn(|i| Dual::new(value[i], rate[i]));
    Attitude { w, x, y, z }
}

fn constant(v: &Vector3<f64>) -> Vector3<Dual<f64>> {
    v.map(Dual::constant)
}

fn dual(value: &Vector3<f64>, tangent: &Vector3<f64>) -> Vector3<Dual<f64>> {
    value.zip_map(tangent, Dual::new)
}

fn tangent(v: &Vector3<Dual<f64>>) -> Vector3<f64> {
    v.map(|x| x.tangent)
}

fn close(what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>, scale: f64) {
    assert_close_at_scale(what, actual.as_slice(), expected.as_slice(), scale, FEW);
}

fn close_matrix(what: &str, actual: &Matrix3<f64>, expected: &Matrix3<f64>, scale: f64) {
    assert_close_at_scale(what, actual.as_slice(), expected.as_slice(), scale, FEW);
}

proptest! {
    #[test]
    fn mass_moments_about_the_centre_of_mass_equal_zero((m, x, v) in particles()) {
        let system = ParticleSystem::new(&m, &x, &v).expect("a system");
        let sum = (0..m.len()).map(|i| system.relative_position(i).expect("a particle") * m[i]).sum::<Vector3<f64>>();
        close("Σ m r^{αc}", &sum, &Vector3::zeros(), system.mass());
    }

    #[test]
    fn koenig_splits_equal_sums_over_particles((m, x, v) in particles(), pivot in triple()) {
        let system = ParticleSystem::new(&m, &x, &v).expect("a system");
        let energy: f64 = m.iter().zip(&v).map(|(m, v)| particle::kinetic_energy(*m, v)).sum();
        assert_close("E", &[system.kinetic_energy().total()], &[energy], FEW);
        let moment: Vector3<f64> = (0..m.len()).map(|i| particle::angular_momentum(m[i], &(x[i] - pivot), &v[i])).sum();
        close("H", &system.angular_momentum(&pivot).total(), &moment, 12.0 * system.mass());
    }

    #[test]
    fn rates_of_a_system_equal_derivatives_of_its_splits((m, x, v) in particles(), seed in triple()) {
        let a: Vec<_> = x.iter().map(|x| x.cross(&seed)).collect();
        let rates = ParticleSystem::new(&m, &x, &v).expect("a system").rates(&a, &Vector3::zeros()).expect("rates");
        let moving_x: Vec<_> = x.iter().zip(&v).map(|(x, v)| dual(x, v)).collect();
        let moving_v: Vec<_> = v.iter().zip(&a).map(|(v, a)| dual(v, a)).collect();
        let moving = ParticleSystem::new(&m, &moving_x, &moving_v).expect("a system");
        let scale = 50.0 * moving.mass();
        close("dL/dt", &rates.momentum, &tangent(&moving.momentum()), scale);
        let moment = moving.angular_momentum(&Vector3::zeros());
        close("dH/dt relative", &rates.angular_momentum.relative, &tangent(&moment.relative), scale);
        close("dH/dt of c", &rates.angular_momentum.of_centre_of_mass, &tangent(&moment.of_centre_of_mass), scale);
        let energy = moving.kinetic_energy();
        let parts = [rates.kinetic_energy.relative, rates.kinetic_energy.of_centre_of_mass];
        let expected = [energy.relative.tangent, energy.of_centre_of_mass.tangent];
        assert_close_at_scale("dE/dt", &parts, &expected, scale, FEW);
    }

    #[test]
    fn rates_of_a_particle_equal_derivatives_along_its_path(x in triple(), v in triple(), a in triple(), mass in finite(0.1..5.0), t in finite(-2.0..2.0)) {
        // A path of third degree about the fixed point `pivot`.
        let pivot = a - v;
        let path = |t: Jet<f64, 0>| {
            x.map(Jet::lit) + v.map(Jet::lit) * t + a.map(Jet::lit) * (t * t * Jet::lit(0.5)) + x.map(Jet::lit) * (t * t * t)
        };
        let motion = Motion::along(path, t);
        let (r, velocity) = (dual(&(motion.position - pivot), &motion.velocity), dual(&motion.velocity, &motion.acceleration));
        let scale = 400.0 * mass;
        close("dl/dt", &particle::momentum_rate(mass, &motion.acceleration), &tangent(&particle::momentum(mass, &velocity)), scale);
        let moment_rate = particle::angular_momentum_rate(mass, &(motion.position - pivot), &motion.acceleration);
        close("dh/dt", &moment_rate, &tangent(&particle::angular_momentum(mass, &r, &velocity)), 100.0 * scale);
        let power = particle::kinetic_energy_rate(mass, &motion.velocity, &motion.acceleration);
        assert_close_at_scale("de/dt", &[power], &[particle::kinetic_energy(mass, &velocity).tangent], 100.0 * scale, FEW);
    }

    #[test]
    fn motion_in_a_moving_frame_equals_derivatives_of_the_combined_path(
        omega in triple(), t in finite(-2.0..2.0), rate in finite(-2.0..2.0)
    ) {
        // A frame that turns about a fixed axis at a changing speed, on an accelerated origin.
        let path = |t: Jet<f64, 0>| {
            let phi = t * (Jet::lit(1.0) + Jet::lit(rate) * t);
            let attitude = Attitude::from_rotation_vector(&omega.map(|x| Jet::lit(x) * phi));
            let basis = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e: Vector3<Jet<f64, 0>>| attitude.to_space(&e));
            let origin = Vector3::new(t * t, t.sin(), Jet::lit(1.0));
            let within = Vector3::new(t.cos(), t * t * t, t);
            (origin, basis, within)
        };
        let (origin, basis, within) = path(Jet::time(t));
        let frame = MovingFrame::from_jets(&origin, &basis);
        let by_terms = frame.motion_in_space(&Motion::from_jet(&within));
        let direct = Motion::along(|t| {
            let (o, e, x) = path(t);
            o + e[0] * x.x + e[1] * x.y + e[2] * x.z
        }, t);
        let scale = by_terms.acceleration.norm() + by_terms.velocity.norm() + frame.basis_second_rate[0].norm() * 10.0;
        close("x", &by_terms.position, &direct.position, scale);
        close("v", &by_terms.velocity, &direct.velocity, scale);
        close("a", &by_terms.acceleration, &direct.acceleration, scale);
        // In a frame that turns with ω φ̇ the two terms are 2 ω × v and ω̇ × x + ω × (ω × x).
        let seen = Motion::from_jet(&within);
        let terms = frame.acceleration_terms(&seen);
        let in_space = |x: &Vector3<f64>| frame.basis[0] * x.x + frame.basis[1] * x.y + frame.basis[2] * x.z;
        let (x, v) = (in_space(&seen.position), in_space(&seen.velocity));
        let (speed, turning) = (omega * (1.0 + 2.0 * rate * t), omega * (2.0 * rate));
        close("2 ω × v", &terms.coriolis, &(speed.cross(&v) * 2.0), (1.0 + speed.norm()) * v.norm());
        let transport = turning.cross(&x) + speed.cross(&speed.cross(&x));
        close("ω̇ × x + ω × (ω × x)", &terms.transport, &transport, 64.0 * (1.0 + speed.norm_squared()) * x.norm());
        // The same frame from its angular velocity ω φ̇ and angular acceleration ω φ̈.
        let rigid = MovingFrame::rigid(Motion::from_jet(&origin), frame.basis, &speed, &turning);
        for i in 0..3 {
            close("ë", &rigid.basis_second_rate[i], &frame.basis_second_rate[i], 64.0 * (1.0 + speed.norm_squared()));
        }
    }

    #[test]
    fn velocity_of_an_embedded_point_equals_derivative_of_its_place(
        q in attitude(), omega in triple(), v in triple(), y in triple()
    ) {
        let pose = BodyPose { position: dual(&Vector3::zeros(), &v), attitude: moving(q, &omega) };
        let motion = BodyMotion { attitude: q, velocity: v, angular_velocity: omega, ..BodyMotion::at_rest() };
        let direct = tangent(&pose.embedded_point(&constant(&y)));
        close("v^p", &motion.velocity_of_point(&y), &direct, 40.0);
        let in_space = velocity_of_embedded_point(&v, &q.to_space(&omega), &q.to_space(&y));
        close("v^q + ω×r", &in_space, &direct, 40.0);
    }

    #[test]
    fn acceleration_of_an_embedded_point_equals_derivative_of_its_velocity(
        q in attitude(), omega in triple(), omega_rate in triple(), y in triple()
    ) {
        let moving_omega = dual(&omega, &omega_rate);
        let moving_motion =
            BodyMotion { attitude: moving(q, &omega), angular_velocity: moving_omega, ..BodyMotion::at_rest() };
        let motion = BodyMotion {
            attitude: q, angular_velocity: omega, angular_acceleration: omega_rate, ..BodyMotion::at_rest()
        };
        let direct = tangent(&moving_motion.velocity_of_point(&constant(&y)));
        close("a^p", &motion.acceleration_of_point(&y), &direct, 100.0);
    }

    #[test]
    fn quaternion_equals_matrix_equals_eulerian_angles(theta in angles(), v in triple()) {
        let euler = EulerAngles::zyz(theta);
        let attitude = euler.attitude();
        let q = euler.matrix();
        close_matrix("Q", &attitude.to_matrix(), &q, 1.0);
        close("v_body", &attitude.to_body(&v), &(q * v), 4.0);
        close("v_space", &attitude.to_space(&v), &(q.transpose() * v), 4.0);
        let by_axes = Attitude::about_z(theta[0]).product(Attitude::about_y(theta[1])).product(Attitude::about_z(theta[2]));
        close_matrix("Q by axes", &by_axes.to_matrix(), &q, 1.0);
        let AnglesOfAttitude::Regular { angles, condition_number } = EulerAngles::of_attitude(EulerSequence::Zyz, attitude) else {
            panic!("{theta:?} is no gimbal point");
        };
        assert_close("angles", &angles.theta, &theta, FEW.times(condition_number));
        close_matrix("Q of Q", &Attitude::from_matrix(&q).expect("a rotation").to_matrix(), &q, 1.0);
    }

    #[test]
    fn product_of_attitudes_equals_product_of_matrices(p in attitude(), q in attitude(), v in triple()) {
        close_matrix("Q(pq)", &p.product(q).to_matrix(), &(q.to_matrix() * p.to_matrix()), 1.0);
        close("p(q v)", &p.product(q).to_space(&v), &p.to_space(&q.to_space(&v)), 4.0);
        close("q* q v", &q.to_body(&q.to_space(&v)), &v, 4.0);
    }

    #[test]
    fn attitude_equals_nalgebra_rotation(q in attitude(), v in triple()) {
        let unit = UnitQuaternion::from(q);
        close("unit quaternion", &(unit * v), &q.to_space(&v), 4.0);
        close("rotation matrix", &(Rotation3::from(q) * v), &q.to_space(&v), 4.0);
        prop_assert_eq!(Attitude::from(unit), q);
        let back = Attitude::try_from(Rotation3::from(q)).expect("a rotation");
        close_matrix("round trip", &back.to_matrix(), &q.to_matrix(), 1.0);
    }

    #[test]
    fn logarithm_of_exponential_equals_rotation_vector(axis in unit_vector(), exponent in finite(-300.0..0.49)) {
        let phi = Vector3::from(axis) * 10.0_f64.powf(exponent);
        let attitude = Attitude::from_rotation_vector(&phi);
        assert_close("|q|²", &[attitude.squared_length()], &[1.0], FEW);
        assert_close("log exp φ", attitude.rotation_vector().as_slice(), phi.as_slice(), FEW);
        let by_axis = Attitude::from_axis_angle(&Vector3::from(axis), phi.norm()).expect("an axis");
        close_matrix("axis and angle", &by_axis.to_matrix(), &attitude.to_matrix(), 1.0);
    }

    #[test]
    fn derivatives_of_exponential_near_zero_equal_those_of_its_product_form(axis in unit_vector(), angle in finite(0.0..3.0)) {
        // Turning further about the same axis: exp((φ+s) n) = exp(φ n) exp(s n), whose derivative is ½ q n.
        let n = Vector3::from(axis);
        let s = Dual::variable(Dual::variable(angle));
        let q = Attitude::from_rotation_vector(&n.map(|x| Dual::<Dual<f64>>::lit(x) * s));
        let value = Attitude::from_rotation_vector(&(n * angle));
        let first = <[Dual<Dual<f64>>; 4]>::from(q).map(|x| x.tangent.value);
        assert_close("q′", &first, &value.rate(&n), FEW);
        // Twice: q″ = −¼ q.
        let second = <[Dual<Dual<f64>>; 4]>::from(q).map(|x| -4.0 * x.tangent.tangent);
        assert_close("q″", &second, &<[f64; 4]>::from(value), FEW);
    }

    #[test]
    fn angular_velocity_of_quaternion_equals_that_of_basis(q in attitude(), omega in triple()) {
        let moving = moving(q, &omega);
        let rate = <[Dual<f64>; 4]>::from(moving).map(|x| x.tangent);
        close("2 q* q̇", &q.angular_velocity_in_body(rate), &omega, 4.0);
        close("2 q̇ q*", &q.angular_velocity_in_space(rate), &q.to_space(&omega), 4.0);
        let basis = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e| moving.to_space(&constant(&e)));
        let by_basis = angular_velocity_of_basis(&basis.map(|f| f.map(|x| x.value)), &basis.map(|f| tangent(&f)));
        close("Ω", &by_basis, &omega, 4.0);
    }

    #[test]
    fn angular_velocity_of_eulerian_angles_equals_that_of_quaternion(theta in angles(), rates in triple(), second in triple()) {
        let (rates, second): ([f64; 3], [f64; 3]) = (rates.into(), second.into());
        let jets = core::array::from_fn(|i| Jet::<f64, 0> {
            value: theta[i], partials: [], rate: rates[i], second_rate: second[i]
        });
        let moving = <[Jet<f64, 0>; 4]>::from(Attitude::from_euler_zyz(jets));
        let euler = EulerAngles::zyz(theta);
        let q = euler.attitude();
        let (rate, second_rate) = (moving.map(|x| x.rate), moving.map(|x| x.second_rate));
        close("ω body", &euler.angular_velocity_in_body(rates), &q.angular_velocity_in_body(rate), 8.0);
        close("ω = W θ̇", &(euler.rate_matrix() * Vector3::from(rates)), &q.angular_velocity_in_body(rate), 8.0);
        close("ω space", &euler.angular_velocity_in_space(rates), &q.angular_velocity_in_space(rate), 8.0);
        let acceleration = euler.angular_acceleration_in_body(rates, second);
        close("ω̇ body", &acceleration, &q.angular_velocity_in_body(second_rate), 40.0);
        let in_space = euler.angular_acceleration_in_space(rates, second);
        close("ω̇ space", &in_space, &q.to_space(&acceleration), 40.0);
        let back = euler.rates(&euler.angular_velocity_in_body(rates)).expect("no gimbal point");
        assert_close_at_scale("θ̇", &back.rates, &rates, 8.0, FEW.times(back.condition_number));
    }

    /// W(5.30) with the sign of the specification: ∂W_ij/∂θ^r − ∂W_ir/∂θ^j = −ε_ikl W_kr W_lj.
    #[test]
    fn curl_of_rate_matrix_equals_minus_cross_products_of_its_columns(theta in angles()) {
        let seeds = core::array::from_fn(|i| Gradient::<f64, 3>::variable(theta[i], i));
        let w = EulerAngles::zyz(seeds).rate_matrix();
        let column = |j: usize| w.column(j).map(|x| x.value);
        for (j, r) in [(0, 1), (0, 2), (1, 2), (1, 0), (2, 2)] {
            let curl: Vector3<f64> = Vector3::from_fn(|i, _| w[(i, j)].partials[r] - w[(i, r)].partials[j]);
            let crossed: Vector3<f64> = -column(r).cross(&column(j));
            close("curl W", &curl, &crossed, 2.0);
        }
    }

    #[test]
    fn parallel_axes_there_and_back_equal_identity(body in body(), offset in triple()) {
        let there = body.inertia().about_offset_point(body.mass(), &offset);
        close_matrix("±s", &body.inertia().about_offset_point(body.mass(), &-offset), &there, 0.0);
        let back = piola_kinematics::Inertia::about_centre_of_mass(there, body.mass(), &offset).expect("a body");
        close_matrix("I", &back.matrix(), &body.inertia().matrix(), there.amax());
    }

    #[test]
    fn inertia_of_any_cloud_satisfies_triangle_inequality((m, x, _) in particles()) {
        let placed = body_of_particles(&m, &x).expect("a cloud is a body");
        let [a, b, c] = placed.body.inertia().principal_moments();
        prop_assert!(0.0 < a && a <= b && b <= c && c <= (a + b) * (1.0 + FEW.value()));
    }

    #[test]
    fn principal_axes_rebuild_inertia(body in body()) {
        let principal = body.inertia().principal_axes();
        let a = principal.axes;
        close_matrix("A Aᵀ", &(a * a.transpose()), &Matrix3::identity(), 1.0);
        assert_close("det A", &[a.determinant()], &[1.0], FEW);
        let rebuilt = a * Matrix3::from_diagonal(&Vector3::from(principal.moments)) * a.transpose();
        close_matrix("I", &rebuilt, &body.inertia().matrix(), 0.0);
    }

    #[test]
    fn kinetic_energy_of_a_cloud_equals_sum_over_its_particles((m, x, _) in particles(), v in triple(), omega in triple()) {
        let placed = body_of_particles(&m, &x).expect("a cloud is a body");
        let sum: f64 = m.iter().zip(&x).map(|(m, x)| {
            let velocity = velocity_of_embedded_point(&v, &omega, &(x - placed.centre_of_mass));
            particle::kinetic_energy(*m, &velocity)
        }).sum();
        let body: RigidBody = placed.body;
        assert_close_at_scale("E", &[body.kinetic_energy(&v, &omega)], &[sum], 50.0 * body.mass(), FEW);
    }

    #[test]
    fn kinetic_energy_equals_that_in_turned_body_axes(body in body(), q in attitude(), omega in triple()) {
        let turned = RigidBody::new(body.mass(), body.inertia().rotated(q)).expect("a body");
        let zero = Vector3::zeros();
        let energy = turned.kinetic_energy(&zero, &q.to_space(&omega));
        assert_close("E", &[energy], &[body.kinetic_energy(&zero, &omega)], FEW);
        let (turned, own) = (turned.inertia().principal_moments(), body.inertia().principal_moments());
        assert_close("principal moments", &turned, &own, FEW);
    }

    #[test]
    fn rates_of_a_body_equal_derivatives(
        body in body(), q in attitude(), v in triple(), a in triple(), omega in triple(), omega_rate in triple(), x in triple()
    ) {
        let motion = BodyMotion {
            position: x, attitude: q, velocity: v, angular_velocity: omega, acceleration: a,
            angular_acceleration: omega_rate,
        };
        let moving_motion = BodyMotion {
            position: dual(&x, &v), attitude: moving(q, &omega), velocity: dual(&v, &a),
            angular_velocity: dual(&omega, &omega_rate), ..BodyMotion::at_rest()
        };
        let scale = 200.0 * (body.mass() + body.inertia().matrix().amax());
        let energy = body.kinetic_energy(&moving_motion.velocity, &moving_motion.angular_velocity);
        let power = body.kinetic_energy_rate(&v, &a, &omega, &omega_rate);
        assert_close_at_scale("dE/dt", &[power], &[energy.tangent], scale, FEW);
        let moment = body.angular_momentum(&moving_motion, &Vector3::zeros());
        let rate = body.angular_momentum_rate(&motion, &Vector3::zeros());
        close("dH/dt", &rate, &tangent(&moment), scale);
    }

    #[test]
    fn curvature_and_torsion_equal_those_of_the_turned_curve(v in triple(), a in triple(), j in triple(), q in attitude()) {
        prop_assume!(0.1 < v.norm() && 0.1 < v.cross(&a).norm());
        let (Frenet::Curved(own), Frenet::Curved(turned)) = (
            Frenet::from_derivatives(&v, &a, &j).expect("finite"),
            Frenet::from_derivatives(&q.to_space(&v), &q.to_space(&a), &q.to_space(&j)).expect("finite"),
        ) else {
            panic!("the curve is curved");
        };
        let condition = a.norm() / own.normal_acceleration;
        assert_close("κ", &[turned.curvature], &[own.curvature], FEW.times(condition));
        let scale = j.norm() / own.speed / own.normal_acceleration;
        assert_close_at_scale("τ", &[turned.torsion], &[own.torsion], scale, FEW.times(condition));
        close("b", &own.tangent.cross(&own.normal), &own.binormal, 1.0);
        let rebuilt = own.tangent * own.tangential_acceleration + own.normal * own.normal_acceleration;
        close("a = s̈ s + v²κ n", &rebuilt, &a, 4.0);
    }

    #[test]
    fn velocity_equals_tangents_times_rates_plus_explicit_time_derivative(
        theta in angles(), distance in finite(0.5..3.0), qdot in vector(4, -2.0..2.0), t in finite(-3.0..3.0)
    ) {
        let system = TopOnTable::new();
        let q = [theta[0], theta[1], theta[2], distance];
        let mut evaluator = PlacementEvaluator::new(4);
        let (mut v, mut body) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
        evaluator.velocities_into(&system, &q, &qdot, t, &mut v, &mut body).expect("velocities");
        let (mut sum_v, mut sum_body) = (Vector3::zeros(), BodyVelocity::at_rest());
        for direction in 0..5 {
            let (mut h, mut tangent) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
            evaluator.tangent_into(&system, &q, t, direction, &mut h, &mut tangent).expect("a tangent");
            let rate = qdot.get(direction).copied().unwrap_or(1.0);
            sum_v += h[0] * rate;
            sum_body.velocity += tangent[0].velocity * rate;
            sum_body.angular_velocity += tangent[0].angular_velocity * rate;
        }
        close("v", &v[0], &sum_v, 20.0);
        close("v^c", &body[0].velocity, &sum_body.velocity, 20.0);
        close("ω", &body[0].angular_velocity, &sum_body.angular_velocity, 20.0);
        // The jets of the whole motion say the same of the velocities.
        let (mut motion, mut body_motion) = ([Motion::at_rest()], [BodyMotion::at_rest()]);
        evaluator.motions_into(&system, &q, &qdot, &[0.0; 4], t, &mut motion, &mut body_motion).expect("a motion");
        close("v of jets", &motion[0].velocity, &v[0], 20.0);
        close("ω of jets", &body_motion[0].angular_velocity, &body[0].angular_velocity, 20.0);
        // ω_Δ of the Eulerian angles are the columns of W.
        let w = EulerAngles::zyz(theta).rate_matrix();
        for direction in 0..3 {
            let (mut h, mut tangent) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
            evaluator.tangent_into(&system, &q, t, direction, &mut h, &mut tangent).expect("a tangent");
            close("ω_Δ", &tangent[0].angular_velocity, &w.column(direction).into_owned(), 1.0);
        }
    }

    #[test]
    fn acceleration_equals_derivative_of_velocity(q in vector(2, -3.0..3.0), qdot in vector(2, -3.0..3.0), qddot in vector(2, -3.0..3.0)) {
        let system = DoublePendulum { length: [1.0, 0.7] };
        let mut motion = [Motion::at_rest(); 2];
        PlacementEvaluator::new(2).motions_into(&system, &q, &qdot, &qddot, 0.0, &mut motion, &mut []).expect("motion");
        // Duals along the motion, carried through the velocities.
        let moving_q: Vec<_> = q.iter().zip(&qdot).map(|(q, v)| Dual::new(*q, *v)).collect();
        let moving_v: Vec<_> = qdot.iter().zip(&qddot).map(|(v, a)| Dual::new(*v, *a)).collect();
        let mut velocity = [Vector3::zeros(); 2];
        let mut evaluator = PlacementEvaluator::<Dual<f64>>::new(2);
        evaluator.velocities_into(&system, &moving_q, &moving_v, Dual::lit(0.0), &mut velocity, &mut []).expect("velocity");
        for i in 0..2 {
            close("v", &motion[i].velocity, &velocity[i].map(|x| x.value), 6.0);
            close("a", &motion[i].acceleration, &tangent(&velocity[i]), 40.0);
        }
    }

    #[test]
    fn rigid_motion_keeps_distances((_, x, _) in particles(), q in attitude(), shift in triple()) {
        let moved: Vec<_> = x.iter().map(|x| q.to_space(x) + shift).collect();
        let change = largest_distance_change(&x, &moved).expect("finite").expect("more than one particle");
        prop_assert!(change.relative_change.abs() <= FEW.value());
    }

    #[test]
    fn attitude_in_lanes_and_in_f32_equals_attitude_in_f64(axis in unit_vector(), angle in finite(-3.0..3.0), v in triple()) {
        let phi = Vector3::from(axis) * angle;
        let expected = Attitude::from_rotation_vector(&phi).to_space(&v);
        // Three lanes below one radian and one as given: both branches in one call.
        let lanes = |x: f64| Lanes([x, 0.25 * x, 0.0, x]);
        let in_lanes = Attitude::from_rotation_vector(&phi.map(lanes)).to_space(&v.map(Lanes::lit));
        close("lane 0", &in_lanes.map(|x: Lanes<f64, 4>| x.primal(0)), &expected, 4.0);
        close("lane 2", &in_lanes.map(|x| x.primal(2)), &v, 4.0);
        let quarter = Attitude::from_rotation_vector(&(phi * 0.25)).to_space(&v);
        close("lane 1", &in_lanes.map(|x| x.primal(1)), &quarter, 4.0);
        let single = Attitude::from_rotation_vector(&phi.map(f32::lit)).to_space(&v.map(f32::lit));
        let single = single.map(f64::from);
        assert_close_at_scale("f32", single.as_slice(), expected.as_slice(), 4.0, Tol::ulps32(16.0));
    }
}

#[test]
fn particles_of_a_thin_rod_equal_rod() {
    let (start, end) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(2.0, 0.0, 3.5));
    let rod = thin_rod(3.0, &start, &end).expect("a rod");
    let (masses, points): (Vec<f64>, Vec<Vector3<f64>>) = rod.into_iter().unzip();
    let system = ParticleSystem::new(&masses, &points, &points).expect("three particles");
    assert_close("M", &[system.mass()], &[3.0], FEW);
    let along = end - start;
    let expected = (Matrix3::identity() * along.norm_squared() - along * along.transpose()) * (3.0 / 12.0);
    close_matrix("I", &system.inertia_about_centre_of_mass(), &expected, 0.0);
}

/// Cavalieri: a cloud that fills the solid has nearly its inertia; here exactly, by Gauss points.
#[test]
fn inertia_of_cuboid_equals_that_of_its_gauss_points() {
    let edges = [0.5, 1.0, 1.5];
    let gauss = (1.0_f64 / 3.0).sqrt();
    let signs = [-gauss, gauss];
    let mut points = Vec::new();
    for x in signs {
        for y in signs {
            for z in signs {
                points.push(Vector3::new(0.5 * edges[0] * x, 0.5 * edges[1] * y, 0.5 * edges[2] * z));
            }
        }
    }
    let cloud = body_of_particles(&[0.25; 8], &points).expect("a cloud");
    let solid = Solid::Cuboid { edges }.inertia(2.0).expect("a cuboid");
    close_matrix("I", &cloud.body.inertia().matrix(), &solid.matrix(), 0.0);
}
