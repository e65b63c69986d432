//! Nanoseconds of Hamilton's field and of Poisson brackets, beside their closed forms and the dual numbers of num-dual.
//!
//! An item is one state. `by hand` is what a reader of the book would write down; every bench gives the same numbers
//! to rounding, which is noted as its error.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::SVector;
use num_dual::{DualNum, DualSVec64};
use piola_benches::chain::NUM_DUAL;
use piola_benches::notes::Notes;
use piola_hamiltonian::{Bracket, HamiltonianField, PhaseFunction, poisson_bracket};
use piola_integrators::Field;
use piola_numerics::Real;

/// States in one iteration.
const STATES: usize = 64;

type Group<'a> = BenchmarkGroup<'a, WallTime>;
type State = ([f64; 3], [f64; 3]);
/// The number of the peer.
type D = DualSVec64<6>;

/// Kepler's problem in space, m = k = 1.
struct Kepler;

impl PhaseFunction for Kepler {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let square = |x: &[T]| x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        T::lit(0.5) * square(p) - square(q).sqrt().recip()
    }
}

/// A component of the angular momentum.
struct Moment(usize);

impl PhaseFunction for Moment {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let (j, k) = ((self.0 + 1) % 3, (self.0 + 2) % 3);
        q[j] * p[k] - q[k] * p[j]
    }
}

/// A component of Runge's vector.
struct Runge(usize);

impl PhaseFunction for Runge {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let (j, k) = ((self.0 + 1) % 3, (self.0 + 2) % 3);
        let radius = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]).sqrt();
        p[j] * Moment(k).value(q, p, t) - p[k] * Moment(j).value(q, p, t) - q[self.0] / radius
    }
}

/// Hénon and Heiles's system.
struct HenonHeiles;

impl PhaseFunction for HenonHeiles {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let [x, y] = [q[0], q[1]];
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + x * x + y * y) + x * x * y - T::lit(1.0 / 3.0) * y * y * y
    }
}

/// H of Kepler's problem over the dual numbers of num-dual.
fn kepler_of_peer(x: &SVector<D, 6>) -> D {
    let square = |i: usize| x[i] * x[i] + x[i + 1] * x[i + 1] + x[i + 2] * x[i + 2];
    square(3) * 0.5 - DualNum::recip(&DualNum::sqrt(&square(0)))
}

/// L₁ and A₂ over the dual numbers of num-dual.
fn moment_of_peer(x: &SVector<D, 6>) -> D {
    x[1] * x[5] - x[2] * x[4]
}

fn runge_of_peer(x: &SVector<D, 6>) -> D {
    let radius = DualNum::sqrt(&(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
    let (first, third) = (x[1] * x[5] - x[2] * x[4], x[0] * x[4] - x[1] * x[3]);
    x[5] * first - x[3] * third - x[1] / radius
}

fn states() -> Vec<State> {
    let state = |i: usize| {
        let wave = |k: f64| (k * (i as f64 + 1.0)).sin();
        (
            [1.0 + 0.3 * wave(1.0), 0.5 * wave(2.0), 0.4 * wave(3.0)],
            [0.3 * wave(5.0), 0.9 + 0.2 * wave(7.0), 0.3 * wave(11.0)],
        )
    };
    (0..STATES).map(state).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut notes = Notes::of("hamiltonian");
    let mut group = criterion.benchmark_group("hamiltonian");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(STATES as u64));
    fields(&mut group, &mut notes);
    brackets(&mut group, &mut notes);
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// Times a function of states, and notes its largest difference from the closed form.
fn bench<const N: usize>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    (name, states): (&str, &[State]),
    closed_form: impl Fn(&State) -> [f64; N],
    mut function: impl FnMut(&State) -> [f64; N],
) {
    let mut error = 0.0_f64;
    for state in states {
        let (found, expected) = (function(state), closed_form(state));
        let scale = expected.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
        error = found.iter().zip(expected).fold(error, |error, (x, e)| error.max((x - e).abs() / scale));
    }
    notes.error(name, error);
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for state in black_box(states) {
                black_box(function(state));
            }
        });
    });
}

fn kepler_by_hand(&(q, p): &State) -> [f64; 6] {
    let square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    let pull = -1.0 / (square * square.sqrt());
    [p[0], p[1], p[2], pull * q[0], pull * q[1], pull * q[2]]
}

fn henon_heiles_by_hand(&(q, p): &State) -> [f64; 4] {
    [p[0], p[1], -q[0] - 2.0 * q[0] * q[1], -q[1] - q[0] * q[0] + q[1] * q[1]]
}

fn fields(group: &mut Group<'_>, notes: &mut Notes) {
    let states = states();
    let mut field = HamiltonianField::new(&Kepler, 3);
    let mut rate = [0.0; 6];
    bench(group, notes, ("field Kepler", &states), kepler_by_hand, |(q, p)| {
        field.rate(0.0, &[q[0], q[1], q[2], p[0], p[1], p[2]], &mut rate).expect("a regular point");
        rate
    });
    bench(group, notes, ("field Kepler by hand", &states), kepler_by_hand, kepler_by_hand);
    bench(group, notes, ("field Kepler num-dual", &states), kepler_by_hand, |(q, p)| {
        let (_, slope) =
            num_dual::gradient(|x| kepler_of_peer(&x), &SVector::<f64, 6>::new(q[0], q[1], q[2], p[0], p[1], p[2]));
        [slope[3], slope[4], slope[5], -slope[0], -slope[1], -slope[2]]
    });
    notes.peer("field Kepler num-dual", NUM_DUAL);
    let mut field = HamiltonianField::new(&HenonHeiles, 2);
    let mut rate = [0.0; 4];
    bench(group, notes, ("field Hénon–Heiles", &states), henon_heiles_by_hand, |(q, p)| {
        field.rate(0.0, &[q[0], q[1], p[0], p[1]], &mut rate).expect("a regular point");
        rate
    });
    bench(group, notes, ("field Hénon–Heiles by hand", &states), henon_heiles_by_hand, henon_heiles_by_hand);
}

/// {L₁, A₂} = A₃ by the two gradients written down.
fn bracket_by_hand((q, p): &State) -> f64 {
    let square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    let (inverse, cube) = (1.0 / square.sqrt(), 1.0 / (square * square.sqrt()));
    // L₁ = q₂p₃ − q₃p₂.
    let (moment_q, moment_p) = ([0.0, p[2], -p[1]], [0.0, -q[2], q[1]]);
    // A₂ = p₃ (q₂p₃ − q₃p₂) − p₁ (q₁p₂ − q₂p₁) − q₂/r.
    let runge_q = [
        -p[0] * p[1] + q[1] * q[0] * cube,
        p[2] * p[2] + p[0] * p[0] - inverse + q[1] * q[1] * cube,
        -p[2] * p[1] + q[1] * q[2] * cube,
    ];
    let runge_p = [2.0 * p[0] * q[1] - q[0] * p[1], -p[2] * q[2] - p[0] * q[0], 2.0 * p[2] * q[1] - q[2] * p[1]];
    (0..3).map(|i| moment_q[i] * runge_p[i] - moment_p[i] * runge_q[i]).sum()
}

fn brackets(group: &mut Group<'_>, notes: &mut Notes) {
    let states = states();
    let closed = |(q, p): &State| [Runge(2).value(q, p, 0.0)];
    bench(group, notes, ("bracket {L₁, A₂}", &states), closed, |(q, p)| {
        [poisson_bracket(&Moment(0), &Runge(1), q, p, 0.0).expect("a regular point")]
    });
    bench(group, notes, ("bracket {L₁, A₂} by hand", &states), closed, |state| [bracket_by_hand(state)]);
    bench(group, notes, ("bracket {L₁, A₂} num-dual", &states), closed, |(q, p)| {
        let x = SVector::<f64, 6>::new(q[0], q[1], q[2], p[0], p[1], p[2]);
        let (_, k) = num_dual::gradient(|x| moment_of_peer(&x), &x);
        let (_, h) = num_dual::gradient(|x| runge_of_peer(&x), &x);
        [(0..3).map(|i| k[i] * h[i + 3] - k[i + 3] * h[i]).sum()]
    });
    notes.peer("bracket {L₁, A₂} num-dual", NUM_DUAL);
    // {L₁, {L₂, A₃}} = {L₁, A₁} = 0.
    bench(
        group,
        notes,
        ("bracket {L₁, {L₂, A₃}}", &states),
        |_| [0.0],
        |(q, p)| [poisson_bracket(&Moment(0), &Bracket(Moment(1), Runge(2)), q, p, 0.0).expect("a regular point")],
    );
}
