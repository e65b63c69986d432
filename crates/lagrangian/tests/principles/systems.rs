//! One system with everything in it, so that few types are compiled.

use nalgebra::{DMatrix, Matrix3, Vector3};
use piola_kinematics::particle::Motion;
use piola_kinematics::placement::PlacementEvaluator;
use piola_kinematics::{Attitude, BodyMotion, Inertia, RigidBody};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, PartForce, Placement, Potential};
use piola_numerics::Real;
use proptest::prelude::*;

pub(crate) const GRAVITY: [f64; 3] = [0.5, -1.0, -9.5];

/// A sliding hub, driven where `MOVING`; a swinging arm with a body that turns on it, and a particle on the body.
/// q = [slide, swing, turn]. Parts: hub (particle), body, particle.
pub(crate) struct Arm<const MOVING: bool> {
    body: RigidBody,
}

impl<const MOVING: bool> Arm<MOVING> {
    pub(crate) fn new() -> Self {
        let inertia = Matrix3::new(0.8, 0.1, -0.05, 0.1, 0.6, 0.02, -0.05, 0.02, 0.5);
        let inertia = Inertia::new(inertia).expect("a possible inertia");
        Self { body: RigidBody::new(2.0, inertia).expect("a possible body") }
    }
    pub(crate) fn body(&self) -> &RigidBody {
        &self.body
    }
}

impl<const MOVING: bool> Holonomic for Arm<MOVING> {
    const TIME_DEPENDENT: bool = MOVING;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let zero = T::zero();
        let (shift, twist) = if MOVING { (T::lit(0.5) * (t + t).sin(), T::lit(0.25) * t * t) } else { (zero, zero) };
        let hub = Vector3::new(q[0] + shift, zero, T::lit(0.5) * shift * q[0]);
        bodies.particle(1.5, hub);
        let (s, c) = q[1].sin_cos();
        let centre = hub + Vector3::new(s, T::lit(0.25) * q[0], -c);
        let attitude = Attitude::about_y(-q[1]).product(Attitude::about_z(q[2] + twist)).product(Attitude::about_x(s));
        bodies.body(&self.body, centre, attitude);
        let arm = attitude.to_space(&Vector3::new(T::lit(0.5), T::lit(0.25), T::lit(-0.5)));
        bodies.particle(0.5, centre + arm);
    }
}

/// Forces and moments that depend on all that they may; with generalised forces where `GENERALISED`.
#[derive(Clone, Copy)]
pub(crate) struct Push<const GENERALISED: bool>;

impl<const GENERALISED: bool> Forces for Push<GENERALISED> {
    const GENERALISED: bool = GENERALISED;
    const ON_PARTS: bool = true;
    const MOMENTS: bool = true;
    fn generalised<T: Real>(&self, q: &[T], v: &[T], t: T, q_out: &mut [T]) {
        for (i, out) in q_out.iter_mut().enumerate() {
            *out += T::lit(0.5) * (q[i] + t).sin() - T::lit(0.25) * v[i];
        }
    }
    fn on_part<T: Real>(&self, part: usize, x: [T; 3], velocity: [T; 3], t: T) -> [T; 3] {
        let c = T::lit(0.5 + 0.25 * part as f64);
        [c * x[1] - velocity[0], t.cos() - c * velocity[1], c * x[0] * x[2]]
    }
    fn moment_on_body<T: Real>(&self, _part: usize, attitude: Attitude<T>, omega: [T; 3], t: T) -> [T; 3] {
        let about_z = attitude.to_body(&Vector3::new(T::zero(), T::zero(), t.sin()));
        [about_z.x - T::lit(0.25) * omega[1], about_z.y + omega[0] * omega[0], about_z.z]
    }
}

/// A potential that depends on time; also on the velocities, where `MAGNETIC`.
#[derive(Clone, Copy)]
pub(crate) struct Spring<const MAGNETIC: bool>;

impl<const MAGNETIC: bool> Potential for Spring<MAGNETIC> {
    const VELOCITY_DEPENDENT: bool = MAGNETIC;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let stretch = q[1] - t.sin();
        let mut sum = stretch * stretch + q[0] * q[0] * (T::lit(2.0) + t.cos()) + q[2].cos();
        if MAGNETIC {
            sum += T::lit(0.5) * q[0] * v[1] - T::lit(0.25) * q[1].sin() * v[2] * v[0] - T::lit(0.125) * t * v[2];
        }
        sum
    }
}

pub(crate) type Driven = Lagrangian<Arm<true>, piola_lagrangian::NoPotential, Push<false>>;
pub(crate) type Everything = Lagrangian<Arm<true>, Spring<true>, Push<true>>;

/// All that acts is known of the parts: reactions are those of the constraint alone.
pub(crate) fn driven() -> Driven {
    Lagrangian::of(Arm::new()).with_uniform_gravity(GRAVITY).with_forces(Push)
}

pub(crate) fn everything() -> Everything {
    Lagrangian::of(Arm::new()).with_uniform_gravity(GRAVITY).with_potential(Spring).with_forces(Push)
}

/// q, q̇ and t at random.
pub(crate) fn states() -> impl Strategy<Value = (Vec<f64>, Vec<f64>, f64)> {
    use piola_testkit::strategies::{finite, vector};
    (vector(3, -1.0..1.0), vector(3, -2.0..2.0), finite(-1.0..2.0))
}

/// By how much rounding is magnified when the mass matrix is solved with: its condition, scaled to unit diagonal.
pub(crate) fn condition_of(matrix: &DMatrix<f64>) -> f64 {
    let n = matrix.nrows();
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt());
    let singular = scaled.svd(false, false).singular_values;
    singular.max() / singular.min()
}

/// The condition of the mass matrix of a system.
pub(crate) fn condition<S: Holonomic, P: Potential, F: Forces>(
    lagrangian: &Lagrangian<S, P, F>,
    (q, v, t): (&[f64], &[f64], f64),
) -> f64 {
    let n = q.len();
    let (mut mass_matrix, mut forcing) = (DMatrix::zeros(n, n), vec![0.0; n]);
    let mut work = piola_lagrangian::Workspace::default();
    lagrangian.equations_into(&mut work, q, v, t, mass_matrix.as_mut_slice(), &mut forcing).unwrap();
    condition_of(&mass_matrix)
}

/// The hub, the particle and the body along a motion, by the kinematics crate alone.
pub(crate) fn motions<const MOVING: bool>(
    arm: &Arm<MOVING>,
    (q, v, a): (&[f64], &[f64], &[f64]),
    t: f64,
) -> ([Motion<f64>; 2], BodyMotion<f64>) {
    let (mut particles, mut bodies) = ([Motion::at_rest(); 2], [BodyMotion::at_rest()]);
    PlacementEvaluator::new(3).motions_into(arm, q, v, a, t, &mut particles, &mut bodies).unwrap();
    (particles, bodies[0])
}

/// Weight and push on each part, in the order of placement.
pub(crate) fn external_forces((particles, body): &([Motion<f64>; 2], BodyMotion<f64>), t: f64) -> [PartForce; 3] {
    let push = Push::<false>;
    let force = |part: usize, mass: f64, x: Vector3<f64>, v: Vector3<f64>| {
        Vector3::from(push.on_part(part, x.into(), v.into(), t)) + Vector3::from(GRAVITY) * mass
    };
    let moment = push.moment_on_body(1, body.attitude, body.angular_velocity.into(), t);
    let [hub, tip] = particles;
    [
        PartForce { force: force(0, 1.5, hub.position, hub.velocity), moment: Vector3::zeros() },
        PartForce { force: force(1, 2.0, body.position, body.velocity), moment: moment.into() },
        PartForce { force: force(2, 0.5, tip.position, tip.velocity), moment: Vector3::zeros() },
    ]
}
