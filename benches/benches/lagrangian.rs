//! Nanoseconds of the accelerations that Lagrange's equations give, and of their parts.
//!
//! An item is one state. The systems of the reference data stand beside their equations, coded by hand, and beside
//! their placement alone, of plain numbers, which any method has to pay that calls it; so do chains of one to 64
//! links (by hand), with the exponent with which their cost grows. Pendulum chains of n links: by Piola from the placement alone, from the closed form
//! of the chain (`by hand`), and from the same placement by the dual numbers of `num-dual` in two passes.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::Vector3;
use piola_benches::chain::{Chain, GRAVITY, Links, LinksWork, NUM_DUAL};
use piola_benches::golden_systems::{self as by_hand, Case};
use piola_benches::notes::Notes;
use piola_benches::problems::DoublePendulum;
use piola_integrators::Field as _;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential, Workspace};
use piola_numerics::Real;

#[path = "../../crates/lagrangian/tests/it/systems.rs"]
#[expect(dead_code, reason = "the tests place more systems than the data has")]
mod systems;

use systems::{
    BeadOnHoop, CartPole, Cylindrical, ElasticPendulum, Foucault, HeavyTop, Height, HingedBodies, Lorentz,
    RadialSpring, SphericalPendulum, Torsion, Torus,
};

/// The reference data.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../testdata/golden/lagrange.json");

/// States in one iteration.
const STATES: usize = 64;

type Group<'a> = BenchmarkGroup<'a, WallTime>;
type States<const N: usize> = Vec<([f64; N], [f64; N])>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut notes = Notes::of("lagrangian");
    let mut group = criterion.benchmark_group("lagrangian");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(STATES as u64));
    double_pendulum_by_hand(&mut group);
    chain::<2>(&mut group, &mut notes);
    chain::<3>(&mut group, &mut notes);
    chain::<4>(&mut group, &mut notes);
    chain::<8>(&mut group, &mut notes);
    chain::<16>(&mut group, &mut notes);
    skips(&mut group);
    heavy_top(&mut group, &mut notes)?;
    reference_systems(&mut group, &mut notes)?;
    for n in LINKS {
        links(&mut group, n)?;
    }
    group.finish();
    growth(&mut notes)?;
    criterion.final_summary();
    Ok(notes.write()?)
}

fn states<const N: usize>() -> States<N> {
    let state = |k: usize| {
        let q = core::array::from_fn(|i| 2.0 * ((7 * k + 3 * i) as f64 * 0.37).sin());
        (q, core::array::from_fn(|i| ((5 * k + i) as f64 * 0.73).cos()))
    };
    (0..STATES).map(state).collect()
}

/// Runs a function on all states.
fn bench<const N: usize>(
    group: &mut Group<'_>,
    name: &str,
    states: &States<N>,
    mut run: impl FnMut(&[f64; N], &[f64; N]),
) {
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for (q, v) in black_box(states) {
                run(q, v);
            }
        });
    });
}

/// The accelerations of any system into a buffer.
fn acceleration<S: Holonomic, P: Potential, F: Forces, const N: usize>(
    group: &mut Group<'_>,
    name: &str,
    states: &States<N>,
    lagrangian: &Lagrangian<S, P, F>,
) {
    let mut work = Workspace::default();
    let mut out = [0.0; N];
    bench(group, name, states, |q, v| {
        let _ = black_box(lagrangian.acceleration_into(&mut work, q, v, 0.5, &mut out));
        black_box(&mut out);
    });
}

/// Looks at where parts are, and does nothing else.
struct Looked;

impl Placement<f64> for Looked {
    #[inline(always)]
    fn particle(&mut self, _mass: f64, position: Vector3<f64>) {
        black_box(position);
    }
    #[inline(always)]
    fn body(&mut self, _body: &RigidBody, centre: Vector3<f64>, attitude: Attitude<f64>) {
        black_box((centre, attitude));
    }
}

/// The placement of plain numbers, without derivatives and equations: no method that calls the placement is
/// faster.
fn placement_alone<S: Holonomic, const N: usize>(
    group: &mut Group<'_>,
    name: &str,
    states: &States<N>,
    (system, time): (&S, f64),
) {
    bench(group, &format!("{name} placement alone"), states, |q, _v| {
        system.place(q, black_box(time), &mut Looked);
    });
}

/// The larger error; NaN is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}

fn double_pendulum_by_hand(group: &mut Group<'_>) {
    let chain = Chain::<2>::varied();
    let pendulum = DoublePendulum { masses: chain.masses, lengths: chain.lengths, gravity: GRAVITY };
    bench(group, "acceleration chain 2 by hand, solved", &states::<2>(), |q, v| {
        black_box(pendulum.acceleration(*q, *v));
    });
}

fn chain<const N: usize>(group: &mut Group<'_>, notes: &mut Notes) {
    let chain = Chain::<N>::varied();
    let lagrangian = Lagrangian::of(chain).with_gravity(GRAVITY);
    let states = states::<N>();
    let mut work = Workspace::default();

    let name = format!("acceleration chain {N}");
    acceleration(group, &name, &states, &lagrangian);
    let by_num_dual = format!("{name} num-dual");
    notes.peer(&by_num_dual, NUM_DUAL);
    let (mut error, mut peer_error) = (0.0_f64, 0.0_f64);
    for (q, v) in &states {
        let expected = chain.acceleration_by_hand(q, v);
        let difference = |i: usize, found: f64| (found - expected[i]).abs() / expected.amax();
        if let Ok(found) = lagrangian.acceleration(q, v, 0.0) {
            error = (0..N).fold(error, |error, i| worse(error, difference(i, found[i])));
        }
        let found = chain.acceleration_by_num_dual(q, v);
        peer_error = (0..N).fold(peer_error, |error, i| worse(error, difference(i, found[i])));
    }
    notes.error(&name, error);
    notes.error(&by_num_dual, peer_error);

    bench(group, &format!("{name} by hand"), &states, |q, v| {
        black_box(chain.acceleration_by_hand(q, v));
    });
    placement_alone(group, &name, &states, (&chain, 0.0));
    bench(group, &by_num_dual, &states, |q, v| {
        black_box(chain.acceleration_by_num_dual(q, v));
    });

    let mut metric = vec![0.0; N * N];
    bench(group, &format!("metric chain {N}"), &states, |q, _v| {
        let _ = black_box(lagrangian.inertia_metric_into(&mut work, q, 0.0, &mut metric));
        black_box(&mut metric);
    });
    bench(group, &format!("energies chain {N}"), &states, |q, v| {
        let _ = black_box(lagrangian.energies_with(&mut work, q, v, 0.0));
    });
    let mut canonical = lagrangian.canonical_motion::<f64>(N);
    let (mut state, mut rate) = (vec![0.0; 2 * N], vec![0.0; 2 * N]);
    bench(group, &format!("canonical rate chain {N}"), &states, |q, p| {
        state[..N].copy_from_slice(q);
        state[N..].copy_from_slice(p);
        let _ = black_box(canonical.rate(0.0, &state, &mut rate));
        black_box(&mut rate);
    });
}

/// Springs that straighten the chain.
struct Springs;

impl Potential for Springs {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        let mut sum = T::zero();
        for pair in q.windows(2) {
            let bend = pair[1] - pair[0];
            sum += T::lit(0.5) * bend * bend;
        }
        sum
    }
}

/// Drag on every particle.
struct Drag;

impl Forces for Drag {
    const ON_PARTS: bool = true;
    fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], velocity: [T; 3], _t: T) -> [T; 3] {
        velocity.map(|v| T::lit(-0.1) * v)
    }
}

/// A chain of two whose support is shaken.
struct Shaken(Chain<2>);

impl Holonomic for Shaken {
    const TIME_DEPENDENT: bool = true;
    #[inline(always)]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let mut x = Vector3::new(T::zero(), T::zero(), T::lit(0.1) * (T::lit(3.0) * t).sin());
        for (&angle, (&mass, &length)) in q.iter().zip(self.0.masses.iter().zip(&self.0.lengths)) {
            let (sine, cosine) = angle.sin_cos();
            x += Vector3::new(T::lit(length) * sine, T::zero(), -T::lit(length) * cosine);
            bodies.particle(mass, x);
        }
    }
}

/// A potential of first degree in the velocities, which may say so.
struct Field<const DECLARED: bool>;

impl<const DECLARED: bool> Potential for Field<DECLARED> {
    const VELOCITY_DEPENDENT: bool = true;
    const LINEAR_IN_VELOCITIES: bool = DECLARED;
    fn potential<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        (q[0] + q[1]).sin() * v[0] - q[0] * v[1]
    }
}

fn gravity_and<P: Potential>(potential: P) -> Lagrangian<Chain<2>, P> {
    Lagrangian::of(Chain::<2>::varied()).with_gravity(GRAVITY).with_potential(potential)
}

/// The same chain with bodies at the ends of its rods, which turn with them.
struct Rods {
    lengths: [f64; 2],
    bodies: [RigidBody; 2],
}

impl Rods {
    fn of(chain: &Chain<2>) -> Result<Self, piola_kinematics::KinematicsError> {
        let body = |mass: f64| RigidBody::new(mass, Inertia::principal([0.1, 0.1, 0.1])?);
        Ok(Self { lengths: chain.lengths, bodies: [body(chain.masses[0])?, body(chain.masses[1])?] })
    }
}

impl Holonomic for Rods {
    #[inline(always)]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = Vector3::new(T::zero(), T::zero(), T::zero());
        for (&angle, (body, &length)) in q.iter().zip(self.bodies.iter().zip(&self.lengths)) {
            let (sine, cosine) = angle.sin_cos();
            end += Vector3::new(T::lit(length) * sine, T::zero(), -T::lit(length) * cosine);
            bodies.body(body, end, Attitude::about_y(-angle));
        }
    }
}

/// What is saved by what a system does not have.
fn skips(group: &mut Group<'_>) {
    let (two, eight) = (states::<2>(), states::<8>());
    let plain = Chain::<2>::varied();
    acceleration(group, "skips chain 2 without gravity", &two, &Lagrangian::of(plain));
    let gravity = Lagrangian::of(plain).with_gravity(GRAVITY);
    acceleration(group, "skips chain 2", &two, &gravity);
    acceleration(group, "skips chain 2 with springs", &two, &gravity.clone().with_potential(Springs));
    acceleration(group, "skips chain 2 with drag", &two, &gravity.with_forces(Drag));
    let declared = Lagrangian::of(Chain::<2, true>::varied()).with_gravity(GRAVITY);
    acceleration(group, "skips chain 2 declared time-dependent", &two, &declared);
    let mut work = Workspace::default();
    bench(group, "skips energies chain 2 declared time-dependent", &two, |q, v| {
        let _ = black_box(declared.energies_with(&mut work, q, v, 0.5));
    });
    let mut canonical = declared.canonical_motion::<f64>(2);
    let (mut state, mut rate) = ([0.0; 4], [0.0; 4]);
    bench(group, "skips canonical rate chain 2 declared time-dependent", &two, |q, p| {
        state[..2].copy_from_slice(q);
        state[2..].copy_from_slice(p);
        let _ = black_box(canonical.rate(0.0, &state, &mut rate));
        black_box(&mut rate);
    });
    let shaken = Lagrangian::of(Shaken(plain)).with_gravity(GRAVITY);
    acceleration(group, "skips chain 2 shaken", &two, &shaken);
    acceleration(group, "skips chain 2 in a field", &two, &gravity_and(Field::<false>));
    acceleration(group, "skips chain 2 in a field declared linear", &two, &gravity_and(Field::<true>));
    let rods = Rods::of(&plain).map(|rods| Lagrangian::of(rods).with_gravity(GRAVITY));
    if let Ok(rods) = rods {
        acceleration(group, "skips chain 2 of bodies", &two, &rods);
    }
    let plain = Lagrangian::of(Chain::<8>::varied()).with_gravity(GRAVITY);
    acceleration(group, "skips chain 8", &eight, &plain);
    acceleration(group, "skips chain 8 with springs", &eight, &plain.with_potential(Springs));
    let declared = Lagrangian::of(Chain::<8, true>::varied()).with_gravity(GRAVITY);
    acceleration(group, "skips chain 8 declared time-dependent", &eight, &declared);
}

const TOP: ([f64; 3], f64, f64) = ([0.75, 0.75, 0.25], 1.0, 0.5);

/// A symmetric top that turns about a fixed point of its axis, by Eulerian angles z–y–z.
struct Top(RigidBody);

impl Holonomic for Top {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let attitude = Attitude::from_euler_zyz([q[0], q[1], q[2]]);
        let arm = Vector3::new(T::zero(), T::zero(), T::lit(TOP.2));
        bodies.body(&self.0, attitude.to_space(&arm), attitude);
    }
}

/// The closed form: A about the fixed point, C about the axis.
fn top_by_hand(q: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    let ([transverse, _, axial], mass, arm) = TOP;
    let about_point = transverse + mass * arm * arm;
    let (sine, cosine) = q[1].sin_cos();
    let spin = axial * (v[2] + v[0] * cosine);
    let nutation = ((about_point * v[0] * cosine - spin) * v[0] * sine + mass * GRAVITY * arm * sine) / about_point;
    let precession = (spin - 2.0 * about_point * v[0] * cosine) * v[1] / (about_point * sine);
    [precession, nutation, v[0] * v[1] * sine - precession * cosine]
}

fn heavy_top(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let body = RigidBody::new(TOP.1, Inertia::principal(TOP.0)?)?;
    let lagrangian = Lagrangian::of(Top(body)).with_gravity(GRAVITY);
    let mut states = states::<3>();
    for (q, _) in &mut states {
        q[1] = 1.0 + 0.3 * q[1]; // away from the pole of the angles
    }
    let mut error = 0.0_f64;
    for (q, v) in &states {
        let (found, expected) = (lagrangian.acceleration(q, v, 0.0)?, top_by_hand(q, v));
        let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
        error = found.iter().zip(expected).fold(error, |error, (a, b)| worse(error, (a - b).abs() / scale));
    }
    if error.is_nan() || 1e-11 < error {
        return Err(format!("the top by placement and by hand differ by {error}").into());
    }
    notes.error("acceleration heavy top", error);
    acceleration(group, "acceleration heavy top", &states, &lagrangian);
    bench(group, "acceleration heavy top by hand", &states, |q, v| {
        black_box(top_by_hand(q, v));
    });
    Ok(())
}

/// States near that of a case.
fn states_near<const N: usize>(case: &Case) -> States<N> {
    let near = |values: &[f64], k: usize| core::array::from_fn(|i| values[i] + 0.05 * ((3 * k + 2 * i) as f64).sin());
    (0..STATES).map(|k| (near(&case.q, k), near(&case.v, k))).collect()
}

/// A case by placement and by hand, which must agree.
fn reference_system<S: Holonomic, P: Potential, const N: usize>(
    (group, notes): (&mut Group<'_>, &mut Notes),
    case: &Case,
    lagrangian: &Lagrangian<S, P>,
    by_hand: impl Fn(&[f64; N], &[f64; N]) -> [f64; N],
) -> Result<(), Box<dyn Error>> {
    let states = states_near::<N>(case);
    let name = format!("reference {}", case.name);
    let mut error = 0.0_f64;
    for (q, v) in &states {
        let (found, expected) = (lagrangian.acceleration(q, v, case.time)?, by_hand(q, v));
        let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
        error = found.iter().zip(expected).fold(error, |error, (a, b)| worse(error, (a - b).abs() / scale));
    }
    if error.is_nan() || 1e-11 < error {
        return Err(format!("{} by placement and by hand differ by {error}", case.name).into());
    }
    notes.error(&name, error);
    let mut work = Workspace::default();
    let (mut out, time) = ([0.0; N], case.time);
    bench(group, &name, &states, |q, v| {
        let _ = black_box(lagrangian.acceleration_into(&mut work, q, v, black_box(time), &mut out));
        black_box(&mut out);
    });
    bench(group, &format!("{name} by hand"), &states, |q, v| {
        black_box(by_hand(q, v));
    });
    placement_alone(group, &name, &states, (lagrangian.system(), time));
    Ok(())
}

/// All systems of the reference data, without the numbers that are applied to some as forces.
fn reference_systems(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let data: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(DATA)?)?;
    let cases = data["cases"].as_array().ok_or("no cases")?;
    for case in cases {
        let case = &Case::of(case).ok_or("a case without state")?;
        let p = |name: &str| case.parameter(name);
        let to = (&mut *group, &mut *notes);
        let g = p("g");
        match case.system.as_str() {
            "double_pendulum" => {
                let system = systems::DoublePendulum { mass: [p("m1"), p("m2")], length: [p("l1"), p("l2")] };
                let constants = [p("m1"), p("m2"), p("l1"), p("l2"), g];
                let lagrangian = Lagrangian::of(system).with_uniform_gravity([0.0, -g, 0.0]);
                reference_system(to, case, &lagrangian, |q, v| by_hand::double_pendulum(constants, q, v))?;
            }
            "spherical_pendulum" => {
                let lagrangian = Lagrangian::of(SphericalPendulum { mass: p("m"), length: p("l") }).with_gravity(g);
                let constants = [p("l"), g];
                reference_system(to, case, &lagrangian, |q, v| by_hand::spherical_pendulum(constants, q, v))?;
            }
            "cart_pole" => {
                let system = CartPole { cart: p("M"), mass: p("m"), length: p("l") };
                let lagrangian = Lagrangian::of(system).with_uniform_gravity([0.0, -g, 0.0]);
                let constants = [p("M"), p("m"), p("l"), g];
                reference_system(to, case, &lagrangian, |q, v| by_hand::cart_pole(constants, q, v))?;
            }
            "bead_on_hoop" => {
                let [mass, radius, rate, wobble, frequency] = ["m", "R", "Omega", "epsilon", "nu"].map(p);
                let system = BeadOnHoop { mass, radius, rate, wobble, frequency };
                let constants = [radius, g, rate, wobble, frequency];
                let lagrangian = Lagrangian::of(system).with_gravity(g);
                let time = case.time;
                let closed = |q: &[f64; 1], _: &[f64; 1]| by_hand::bead_on_hoop(constants, q, black_box(time));
                reference_system(to, case, &lagrangian, closed)?;
            }
            "heavy_top" => {
                let constants = ["m", "h", "A", "C", "g"].map(p);
                let lagrangian = Lagrangian::of(HeavyTop::new(p("m"), p("h"), p("A"), p("C"))).with_gravity(g);
                reference_system(to, case, &lagrangian, |q, v| by_hand::heavy_top(constants, q, v))?;
            }
            "elastic_pendulum" => {
                let spring = RadialSpring { stiffness: p("k"), rest: p("l0") };
                let system = ElasticPendulum { mass: p("m") };
                let lagrangian = Lagrangian::of(system).with_gravity(g).with_potential(spring);
                let constants = ["m", "k", "l0", "g"].map(p);
                reference_system(to, case, &lagrangian, |q, v| by_hand::elastic_pendulum(constants, q, v))?;
            }
            "torus" => {
                let system = Torus { mass: p("m"), large: p("R"), small: p("a") };
                let lagrangian = Lagrangian::of(system).with_gravity(g);
                let constants = ["R", "a", "g"].map(p);
                reference_system(to, case, &lagrangian, |q, v| by_hand::torus(constants, q, v))?;
            }
            "charged_particle" => {
                let (electric, magnetic) = (["E1", "E2", "E3"].map(p), ["B1", "B2", "B3"].map(p));
                let lorentz = Lorentz { charge: p("e"), electric, magnetic };
                let lagrangian = Lagrangian::of(Cylindrical { mass: p("m") }).with_potential(lorentz);
                let (ratio, fields) = (p("e") / p("m"), [electric, magnetic].map(Vector3::from));
                reference_system(to, case, &lagrangian, |q, v| by_hand::charged_particle(ratio, fields, q, v))?;
            }
            "foucault" => {
                let pendulum = Foucault { mass: p("m"), length: p("l"), rate: p("Omega"), latitude: p("lam") };
                let height = Height { pendulum: &pendulum, gravity: g };
                let lagrangian = Lagrangian::of(&pendulum).with_potential(height);
                let (sine, cosine) = p("lam").sin_cos();
                let constants = [p("l"), g, p("Omega"), sine, cosine];
                reference_system(to, case, &lagrangian, |q, v| by_hand::foucault(constants, q, v))?;
            }
            "hinge_planar" => {
                let system = HingedBodies::new([p("m1"), p("m2")], [p("I1"), p("I2")], [p("a1"), p("a2")]);
                let torsion = Torsion { stiffness: p("k") };
                let lagrangian = Lagrangian::of(system).with_uniform_gravity([0.0, -g, 0.0]).with_potential(torsion);
                let constants = ["m1", "m2", "I1", "I2", "a1", "a2", "g", "k"].map(p);
                reference_system(to, case, &lagrangian, |q, v| by_hand::hinge_planar(constants, q, v))?;
            }
            other => return Err(format!("unknown system {other}").into()),
        }
    }
    Ok(())
}

/// Numbers of links that are known at run time only.
const LINKS: [usize; 12] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];
/// States of a long chain in one iteration.
const LONG_STATES: usize = 8;

/// Accelerations of a chain, by placement and by hand.
struct Evaluations {
    lagrangian: Lagrangian<Links>,
    states: Vec<(Vec<f64>, Vec<f64>)>,
    work: Workspace,
    work_by_hand: LinksWork,
    out: Vec<f64>,
}

impl Evaluations {
    fn of(n: usize) -> Self {
        let state = |k: usize| {
            let q = (0..n).map(|i| 2.0 * ((7 * k + 3 * i) as f64 * 0.37).sin()).collect();
            (q, (0..n).map(|i| ((5 * k + i) as f64 * 0.73).cos()).collect())
        };
        Self {
            lagrangian: Lagrangian::of(Links::varied(n)).with_gravity(GRAVITY),
            states: (0..LONG_STATES).map(state).collect(),
            work: Workspace::default(),
            work_by_hand: LinksWork::default(),
            out: vec![0.0; n],
        }
    }

    fn by_placement(&mut self) {
        for (q, v) in black_box(&self.states) {
            let _ = black_box(self.lagrangian.acceleration_into(&mut self.work, q, v, 0.0, &mut self.out));
            black_box(&mut self.out);
        }
    }

    fn by_hand(&mut self) {
        let chain = self.lagrangian.system();
        for (q, v) in black_box(&self.states) {
            let _ = black_box(chain.acceleration_by_hand(&mut self.work_by_hand, q, v, &mut self.out));
            black_box(&mut self.out);
        }
    }
}

fn links(group: &mut Group<'_>, n: usize) -> Result<(), Box<dyn Error>> {
    let mut evaluations = Evaluations::of(n);
    evaluations.by_hand();
    let expected = evaluations.out.clone();
    evaluations.by_placement();
    let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
    let error = evaluations.out.iter().zip(&expected).fold(0.0, |error, (a, b)| worse(error, (a - b).abs() / scale));
    if error.is_nan() || 1e-10 < error {
        return Err(format!("{n} links by placement and by hand differ by {error}").into());
    }
    group.throughput(Throughput::Elements(LONG_STATES as u64));
    group.bench_function(format!("links {n}"), |bencher| bencher.iter(|| evaluations.by_placement()));
    group.bench_function(format!("links {n} by hand"), |bencher| bencher.iter(|| evaluations.by_hand()));
    Ok(())
}

/// The shortest time of many calls, s.
fn shortest(mut run: impl FnMut()) -> f64 {
    (0..60).fold(f64::INFINITY, |least, _| {
        let start = std::time::Instant::now();
        run();
        least.min(start.elapsed().as_secs_f64())
    })
}

/// The exponents with which cost grows with the number of links: over all numbers from eight on, by least
/// squares of logarithms, and from 32 to 64.
fn growth(notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let long: Vec<usize> = LINKS.into_iter().filter(|&n| 8 <= n).collect();
    let times: Vec<[f64; 2]> = long
        .iter()
        .map(|&n| {
            let mut evaluations = Evaluations::of(n);
            [shortest(|| evaluations.by_placement()), shortest(|| evaluations.by_hand())]
        })
        .collect();
    for (way, name) in ["links", "links by hand"].into_iter().enumerate() {
        let points: Vec<(f64, f64)> =
            long.iter().zip(&times).map(|(&n, times)| ((n as f64).ln(), times[way].ln())).collect();
        let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
        let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
        let slope = mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x) * (p.0 - x));
        let at = |n: usize| long.iter().position(|&m| m == n).map(|k| times[k][way]).ok_or("not measured");
        let end = (at(64)? / at(32)?).log2();
        notes.number(name, "exponent", slope);
        notes.number(name, "exponent from 32 to 64", end);
        eprintln!("lagrangian/{name}: time ~ n^{slope:.2} from 8 to 64 links, n^{end:.2} from 32 to 64");
    }
    Ok(())
}
