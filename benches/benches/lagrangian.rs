//! Nanoseconds of the accelerations that Lagrange's equations give, and of their parts.
//!
//! An item is one state. Pendulum chains of n links: by Piola from the placement alone, from the closed form
//! of the chain (`by hand`), and from the same placement by the dual numbers of `num-dual` in two passes.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::Vector3;
use piola_benches::chain::{Chain, GRAVITY, NUM_DUAL};
use piola_benches::notes::Notes;
use piola_benches::problems::DoublePendulum;
use piola_dynamics::lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential, Workspace};
use piola_integrators::Field;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_numerics::Real;

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
    group.finish();
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
