//! Identities of Lagrange's equations, each for all systems of the reference data.

use core::cell::Cell;

use nalgebra::{DVector, Vector3};
use piola_kinematics::Attitude;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, LagrangianFunction, Placement, Potential, Workspace};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::any::{Everything, Law, for_all_systems};
use crate::systems::*;

/// By how much rounding is magnified when the metric is solved with: its condition, scaled to unit diagonal.
fn condition<S: Holonomic, P: Potential, F: Forces>(lagrangian: &Lagrangian<S, P, F>, q: &[f64], t: f64) -> f64 {
    let g = lagrangian.inertia_metric(q, t).unwrap();
    let scaled = nalgebra::DMatrix::from_fn(q.len(), q.len(), |i, j| g[(i, j)] / (g[(i, i)] * g[(j, j)]).sqrt());
    let singular = scaled.svd(false, false).singular_values;
    singular.max() / singular.min()
}

fn states() -> impl Strategy<Value = (Vec<f64>, Vec<f64>, f64)> {
    use piola_testkit::strategies::{finite, vector};
    (vector(6, -1.0..1.0), vector(6, -2.0..2.0), finite(-1.0..2.0))
}

macro_rules! law {
    ($name:ident, $law:expr) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(24))]
            #[test]
            fn $name((q, v, t) in states()) {
                for_all_systems(&$law, &q, &v, t);
            }
        }
    };
}

struct Hessian;
impl Law for Hessian {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let coordinates: Vec<_> = q.iter().map(|&q| Dual::constant(Dual::constant(q))).collect();
        let hessian = nalgebra::DMatrix::from_fn(n, n, |i, j| {
            let unit = |k: usize, l: usize| if k == l { 1.0 } else { 0.0 };
            let seed = |(k, &v): (usize, &f64)| Dual::new(Dual::new(v, unit(k, i)), Dual::constant(unit(k, j)));
            let rates: Vec<_> = v.iter().enumerate().map(seed).collect();
            let time = Dual::constant(Dual::constant(t));
            lagrangian.energies(&coordinates, &rates, time).unwrap().kinetic.tangent.tangent
        });
        let metric = lagrangian.inertia_metric(q, t).unwrap();
        assert_close(name, metric.as_slice(), hessian.as_slice(), Tol::ulps(64.0));
        assert_close(name, metric.transpose().as_slice(), metric.as_slice(), Tol::ulps(0.0));
    }
}
law!(inertia_metric_equals_kinetic_energy_hessian, Hessian);

/// The parts of a system seen through other coordinates: `q_i = r_i + ¼ sin r_{i+1} + ⅛ r_i r_0`.
struct Changed<'a, S>(&'a S);

fn old_coordinates<T: Real>(r: &[T]) -> Vec<T> {
    let next = |i: usize| r[(i + 1) % r.len()];
    (0..r.len()).map(|i| r[i] + T::lit(0.25) * next(i).sin() + T::lit(0.125) * r[i] * r[0]).collect()
}

impl<S: Holonomic> Holonomic for Changed<'_, S> {
    const TIME_DEPENDENT: bool = S::TIME_DEPENDENT;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.0.place(&old_coordinates(q), t, bodies);
    }
}

/// A point r and a motion through it, in both coordinates.
/// How many accelerations were compared.
#[derive(Default)]
struct Covariance(Cell<usize>);
impl Law for Covariance {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        r: &[f64],
        rates: &[f64],
        t: f64,
    ) {
        let n = r.len();
        // Only the placement is seen in other coordinates: no potential, no forces but uniform gravity.
        let old = Lagrangian::of(lagrangian.system()).with_uniform_gravity([1.0, -2.0, -9.8]);
        let new = Lagrangian::of(Changed(lagrangian.system())).with_uniform_gravity([1.0, -2.0, -9.8]);
        let column = |j: usize| -> Vec<f64> {
            let seed = |(i, &r): (usize, &f64)| if i == j { Dual::variable(r) } else { Dual::constant(r) };
            let along: Vec<_> = r.iter().enumerate().map(seed).collect();
            old_coordinates(&along).iter().map(|q| q.tangent).collect()
        };
        let jacobian = nalgebra::DMatrix::from_fn(n, n, |i, j| column(j)[i]);
        let q = old_coordinates(r);
        let expected = jacobian.transpose() * old.inertia_metric(&q, t).unwrap() * &jacobian;
        let metric = new.inertia_metric(r, t).unwrap();
        assert_close(name, metric.as_slice(), expected.as_slice(), Tol::ulps(64.0));

        // q̈ = (∂q/∂r) r̈ + d²q/dt² at r̈ = 0.
        let (Ok(acceleration), true) = (new.acceleration(r, rates, t), condition(&new, r, t) < 1e4) else { return };
        let along: Vec<_> = r
            .iter()
            .zip(rates)
            .zip(&acceleration)
            .map(|((&r, &v), &a)| Dual::new(Dual::new(r, v), Dual::new(v, a)))
            .collect();
        let moved = old_coordinates(&along);
        let v: Vec<f64> = moved.iter().map(|q| q.value.tangent).collect();
        let actual: Vec<f64> = moved.iter().map(|q| q.tangent.tangent).collect();
        let expected = old.acceleration(&q, &v, t).unwrap();
        let tol = Tol::ulps(256.0).times(condition(&new, r, t) * condition(&old, &q, t));
        assert_close_at_scale(name, &actual, expected.as_slice(), 100.0, tol);
        self.0.set(self.0.get() + 1);
    }
}

#[test]
fn metric_is_a_covariant_tensor_and_acceleration_a_motion() {
    let law = Covariance::default();
    let mut runner = TestRunner::new(ProptestConfig::with_cases(24));
    let outcome = runner.run(&states(), |(q, v, t)| {
        for_all_systems(&law, &q, &v, t);
        Ok(())
    });
    assert_eq!(outcome, Ok(()));
    // Of 24 states of 22 systems most have new coordinates that are regular and not ill-conditioned.
    assert!(400 < law.0.get(), "{} accelerations", law.0.get());
}

/// How many systems obeyed.
#[derive(Default)]
struct Explicit(Cell<usize>);
impl Law for Explicit {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        if S::TIME_DEPENDENT || P::VELOCITY_DEPENDENT {
            return; // W(6.3) is for scleronomic systems
        }
        let n = q.len();
        let geodesic = Lagrangian::of(lagrangian.system());
        let velocity = DVector::from_column_slice(v);
        // Q includes −∂V/∂q = ∂L/∂q − ∂E/∂q.
        let force = lagrangian.generalised_forces(q, v, t).unwrap() + lagrangian.coordinate_gradient(q, v, t).unwrap()
            - geodesic.coordinate_gradient(q, v, t).unwrap();
        let acceleration = lagrangian.acceleration(q, v, t).unwrap();
        let metric = lagrangian.inertia_metric(q, t).unwrap();
        let first = lagrangian.christoffel_first(q, t).unwrap();
        let curved = DVector::from_fn(n, |s, _| velocity.dot(&(&first[s] * &velocity)));
        let left = &metric * &acceleration + &curved;
        let terms = metric.amax() * acceleration.amax() + curved.amax() + force.amax();
        let tol = Tol::ulps(512.0).times(condition(lagrangian, q, t));
        assert_close_at_scale(name, left.as_slice(), force.as_slice(), terms, tol);

        let second = lagrangian.christoffel_second(q, t).unwrap();
        let raised = metric.lu().solve(&force).unwrap();
        let expected = DVector::from_fn(n, |s, _| raised[s] - velocity.dot(&(&second[s] * &velocity)));
        let size = expected.amax() + raised.amax();
        assert_close_at_scale(name, acceleration.as_slice(), expected.as_slice(), size, tol);
        self.0.set(self.0.get() + 1);
    }
}
proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn acceleration_equals_christoffel_form((q, v, t) in states()) {
        let law = Explicit::default();
        for_all_systems(&law, &q, &v, t);
        // All but the bead, the pendulum of Foucault and the charge, with and without forces.
        prop_assert_eq!(law.0.get(), 16);
    }
}

/// d/dt(∂L/∂q̇) − ∂L/∂q = Q along the motion, with d/dt an exact derivative along it.
struct Equations;
impl Law for Equations {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let acceleration = lagrangian.acceleration(q, v, t).unwrap();
        let along =
            |x: &[f64], rate: &[f64]| -> Vec<_> { x.iter().zip(rate).map(|(&x, &r)| Dual::new(x, r)).collect() };
        let (moving, rates) = (along(q, v), along(v, acceleration.as_slice()));
        let momenta = lagrangian.momenta(&moving, &rates, Dual::variable(t)).unwrap();
        let left: Vec<f64> = momenta.iter().map(|p| p.tangent).collect();
        let force = lagrangian.generalised_forces(q, v, t).unwrap();
        let right = lagrangian.coordinate_gradient(q, v, t).unwrap() + &force;
        let scale = lagrangian.inertia_metric(q, t).unwrap().amax() * acceleration.amax() + right.amax() + 1.0;
        let tol = Tol::ulps(512.0).times(condition(lagrangian, q, t));
        assert_close_at_scale(name, &left, right.as_slice(), scale, tol);

        // dh/dt = Q·q̇ − ∂L/∂t
        let h = lagrangian.jacobi_integral(&moving, &rates, Dual::variable(t)).unwrap();
        let power = force.dot(&DVector::from_column_slice(v));
        let expected = power - lagrangian.time_derivative(q, v, t).unwrap();
        assert_close_at_scale(name, &[h.tangent], &[expected], 2.0 * scale * v.len() as f64, tol);
    }
}
law!(rate_of_momentum_less_gradient_equals_force_and_rate_of_jacobi_integral_equals_power, Equations);

/// The Lagrangian of a system as one function.
struct Function<'a, S, P, F>(&'a Lagrangian<S, P, F>);
impl<S: Holonomic, P: Potential, F: Forces> LagrangianFunction for Function<'_, S, P, F> {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        self.0.energies(q, v, t).expect("lengths agree").lagrangian()
    }
}

/// The applied forces of a system as generalised forces.
struct Generalised<'a, S, P, F>(&'a Lagrangian<S, P, F>);
impl<S: Holonomic, P: Potential, F: Forces> Forces for Generalised<'_, S, P, F> {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, q: &[T], v: &[T], t: T, q_out: &mut [T]) {
        for (out, &force) in q_out.iter_mut().zip(&self.0.generalised_forces(q, v, t).expect("lengths agree")) {
            *out += force;
        }
    }
}

struct AsFunction;
impl Law for AsFunction {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let function = Lagrangian::from_function(Function(lagrangian)).with_forces(Generalised(lagrangian));
        let tol = Tol::ulps(256.0).times(condition(lagrangian, q, t));
        let (actual, expected) = (function.acceleration(q, v, t).unwrap(), lagrangian.acceleration(q, v, t).unwrap());
        assert_close_at_scale(name, actual.as_slice(), expected.as_slice(), 100.0, tol);
        let (actual, expected) = (function.momenta(q, v, t).unwrap(), lagrangian.momenta(q, v, t).unwrap());
        assert_close_at_scale(name, actual.as_slice(), expected.as_slice(), 1.0, Tol::ulps(64.0));
        let (actual, expected) =
            (function.jacobi_integral(q, v, t).unwrap(), lagrangian.jacobi_integral(q, v, t).unwrap());
        assert_close_at_scale(name, &[actual], &[expected], 100.0, Tol::ulps(64.0));

        // The inverse Legendre map of both: by a solve and by Newton's iteration.
        let momenta = lagrangian.momenta(q, v, t).unwrap();
        let mut velocities = vec![0.0; q.len()];
        let mut work = Workspace::default();
        lagrangian.velocities_into(&mut work, q, momenta.as_slice(), t, &mut velocities).unwrap();
        assert_close_at_scale(name, &velocities, v, 1.0, tol);
        function.velocities_into(&mut work, q, momenta.as_slice(), t, &mut velocities).unwrap();
        assert_close_at_scale(name, &velocities, v, 1.0, tol);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn lagrangian_function_equals_placement_and_velocities_of_momenta_are_the_velocities((q, v, t) in states()) {
        // Three systems stand for all: nested derivatives of every one would take minutes to compile.
        let double = DoublePendulum { mass: [1.0, 2.0], length: [1.0, 0.5] };
        let double = Lagrangian::of(double).with_uniform_gravity([0.0, -9.8, 0.0]);
        AsFunction.check("double pendulum", &double, &q[..2], &v[..2], t);
        let bead = BeadOnHoop { mass: 0.5, radius: 2.0, rate: 1.5, wobble: 0.25, frequency: 3.0 };
        AsFunction.check("bead on a hoop", &Lagrangian::of(bead).with_gravity(9.8), &q[..1], &v[..1], t);
        let field = Lorentz { charge: 2.0, electric: [0.5, -0.25, 0.125], magnetic: [1.0, -2.0, 0.5] };
        let charged = Lagrangian::of(Cylindrical { mass: 1.5 }).with_potential(field).with_forces(Everything(true));
        AsFunction.check("charged particle", &charged, &[1.5 + 0.5 * q[0], q[1], q[2]], &v[..3], t);
    }
}

/// Several copies of a system that know nothing of each other.
struct Copies<'a, S, P, F> {
    one: &'a Lagrangian<S, P, F>,
    freedom: usize,
}

impl<S: Holonomic, P, F> Holonomic for Copies<'_, S, P, F> {
    const TIME_DEPENDENT: bool = S::TIME_DEPENDENT;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        for q in q.chunks(self.freedom) {
            self.one.system().place(q, t, bodies);
        }
    }
}

/// The sum of the potentials of the copies.
struct Potentials<'a, S, P, F>(&'a Copies<'a, S, P, F>);
impl<S: Holonomic, P: Potential, F: Forces> Potential for Potentials<'_, S, P, F> {
    const VELOCITY_DEPENDENT: bool = P::VELOCITY_DEPENDENT;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let n = self.0.freedom;
        let mut sum = T::zero();
        for (i, q) in q.chunks(n).enumerate() {
            let v = if P::VELOCITY_DEPENDENT { &v[i * n..(i + 1) * n] } else { &[] };
            sum += self.0.one.potential().potential(q, v, t);
        }
        sum
    }
}

struct ByRows;
impl Law for ByRows {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        one: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let number = 8 / n + 1; // beyond eight coordinates
        let copies = Copies { one, freedom: n };
        let gravity = one.gravity();
        let all = Lagrangian::of(&copies).with_uniform_gravity(gravity).with_potential(Potentials(&copies));
        let repeat = |x: &[f64], step: f64| -> Vec<f64> {
            (0..number).flat_map(|i| x.iter().map(move |x| x + step * i as f64)).collect()
        };
        let (many_q, many_v) = (repeat(q, 0.01), repeat(v, -0.25));
        // Forces are left out: they count the parts of all copies.
        let bare = |q: &[f64], v: &[f64]| {
            let single = Copies { one, freedom: n };
            let bare = Lagrangian::of(&single).with_uniform_gravity(gravity).with_potential(Potentials(&single));
            bare.acceleration(q, v, t).unwrap()
        };
        let expected: Vec<f64> =
            many_q.chunks(n).zip(many_v.chunks(n)).flat_map(|(q, v)| bare(q, v).as_slice().to_vec()).collect();
        let actual = all.acceleration(&many_q, &many_v, t).unwrap();
        let tol = Tol::ulps(256.0).times(condition(one, q, t));
        assert_close_at_scale(name, actual.as_slice(), &expected, 100.0, tol);
        let momenta = all.momenta(&many_q, &many_v, t).unwrap();
        let mut velocities = vec![0.0; many_q.len()];
        all.velocities_into(&mut Workspace::default(), &many_q, momenta.as_slice(), t, &mut velocities).unwrap();
        assert_close_at_scale(name, &velocities, &many_v, 1.0, tol);
    }
}
law!(more_than_eight_coordinates_equal_copies_of_fewer, ByRows);

/// A system that drags along coordinates of unit mass that feel nothing: with them it has more than eight.
struct Dragging<'a, S>(&'a S, usize);
impl<S: Holonomic> Holonomic for Dragging<'_, S> {
    const TIME_DEPENDENT: bool = S::TIME_DEPENDENT;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.0.place(&q[..self.1], t, bodies);
        for &x in &q[self.1..] {
            bodies.particle(1.0, Vector3::new(x, T::zero(), T::zero()));
        }
    }
}

struct Applied;
impl Law for Applied {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let one = Lagrangian::of(lagrangian.system()).with_gravity(3.0).with_forces(Everything(true));
        let more = Lagrangian::of(Dragging(lagrangian.system(), n)).with_gravity(3.0).with_forces(Everything(true));
        let pad = |x: &[f64]| -> Vec<f64> { x.iter().copied().chain([0.5; 9]).collect() };
        let expected = one.acceleration(q, v, t).unwrap();
        let actual = more.acceleration(&pad(q), &pad(v), t).unwrap();
        let tol = Tol::ulps(256.0).times(condition(lagrangian, q, t));
        assert_close_at_scale(name, &actual.as_slice()[..n], expected.as_slice(), 100.0, tol);
    }
}
law!(applied_forces_of_more_than_eight_coordinates_equal_those_of_fewer, Applied);

/// A push at a point without mass: the end of a massless rod beyond the bob.
struct Pushed;
impl Forces for Pushed {
    const ON_PARTS: bool = true;
    fn on_part<T: Real>(&self, part: usize, _x: [T; 3], _v: [T; 3], _t: T) -> [T; 3] {
        let strength = if part == 1 { 6.0 } else { 0.0 };
        [T::lit(strength), T::zero(), T::zero()]
    }
}

struct Rod {
    idle: usize,
}
impl Holonomic for Rod {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = q[0].sin_cos();
        bodies.particle(3.0, Vector3::new(s, T::zero(), -c));
        bodies.particle(0.0, Vector3::new(T::lit(2.0) * s, T::zero(), T::lit(-2.0) * c));
        for &x in &q[1..=self.idle] {
            bodies.particle(1.0, Vector3::new(x, T::zero(), T::zero()));
        }
    }
}

#[test]
fn force_on_a_massless_part_moves_the_system_by_its_virtual_work() {
    for idle in [0, 1, 3, 7, 8, 20] {
        let rod = Lagrangian::of(Rod { idle }).with_forces(Pushed);
        // m l² q̈ = f·∂x/∂q = 6 · 2
        let acceleration = rod.acceleration(&vec![0.0; idle + 1], &vec![0.0; idle + 1], 0.0).unwrap();
        assert_close("q̈", &acceleration.as_slice()[..1], &[4.0], Tol::ulps(4.0));
    }
}

/// The double pendulum in absolute and in relative angles.
struct Relative(DoublePendulum);
impl Holonomic for Relative {
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.0.place(&[q[0], q[0] + q[1]], t, bodies);
    }
}

/// Only forces on the body itself.
struct OnBody;
impl Forces for OnBody {
    const ON_PARTS: bool = true;
    const MOMENTS: bool = true;
    fn on_part<T: Real>(&self, part: usize, x: [T; 3], velocity: [T; 3], t: T) -> [T; 3] {
        Everything(true).on_part(part, x, velocity, t)
    }
    fn moment_on_body<T: Real>(&self, part: usize, a: Attitude<T>, omega: [T; 3], t: T) -> [T; 3] {
        Everything(true).moment_on_body(part, a, omega, t)
    }
}

proptest! {
    #[test]
    fn double_pendulum_in_relative_angles_equals_absolute_angles((q, v, _) in states()) {
        let double = || DoublePendulum { mass: [1.0, 2.0], length: [1.0, 0.5] };
        let gravity = [0.0, -9.8, 0.0];
        let absolute = Lagrangian::of(double()).with_uniform_gravity(gravity);
        let relative = Lagrangian::of(Relative(double())).with_uniform_gravity(gravity);
        let a = relative.acceleration(&q[..2], &v[..2], 0.0).unwrap();
        let expected = absolute.acceleration(&[q[0], q[0] + q[1]], &[v[0], v[0] + v[1]], 0.0).unwrap();
        let tol = Tol::ulps(64.0).times(condition(&relative, &q[..2], 0.0));
        assert_close_at_scale("φ̈", &[a[0], a[0] + a[1]], expected.as_slice(), 10.0, tol);
    }

    #[test]
    fn free_body_acceleration_equals_newton_euler((q, v, t) in states()) {
        let inertia = uneven_inertia();
        let body = FreeBody::new(2.0, inertia);
        let q = [q[0], q[1], q[2], q[3], 1.5 + q[4], q[5]];
        let lagrangian = Lagrangian::of(body).with_gravity(9.8).with_forces(OnBody);
        let a = lagrangian.acceleration(&q, &v, t).unwrap();
        let force = Everything(true).on_part(0, [q[0], q[1], q[2]], [v[0], v[1], v[2]], t);
        let expected = [force[0] / 2.0, force[1] / 2.0, force[2] / 2.0 - 9.8];
        assert_close("Newton", &a.as_slice()[..3], &expected, Tol::ulps(256.0));

        // ω and ω̇ from the angles' own motion.
        let theta = [3, 4, 5].map(|i| Dual::new(Dual::new(q[i], v[i]), Dual::new(v[i], a[i])));
        let quaternion = Attitude::from_euler_zyz(theta);
        let components = [quaternion.w, quaternion.x, quaternion.y, quaternion.z];
        let attitude = Attitude { w: components[0].value.value, x: components[1].value.value,
            y: components[2].value.value, z: components[3].value.value };
        let omega = attitude.angular_velocity_in_body(components.map(|c| c.value.tangent));
        let omega_rate = attitude.angular_velocity_in_body(components.map(|c| c.tangent.tangent));
        let moment = Vector3::from(Everything(true).moment_on_body(0, attitude, omega.into(), t));
        let left = inertia * omega_rate + omega.cross(&(inertia * omega));
        assert_close_at_scale("Euler", left.as_slice(), moment.as_slice(), 10.0,
            Tol::ulps(64.0).times(condition(&lagrangian, &q, t)));
    }
}
