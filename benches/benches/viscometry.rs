//! Flows that shear a fluid, and the functions behind them: `<what>/<case>`.
//!
//! | part | what |
//! |---|---|
//! | `profile`, `discharge`, `torque` `/<flow>_<fluid>` | 33 velocities of a pipe; discharge of a pipe and a channel; torque of cylinders at a speed |
//! | `plain_…` | the textbook's formula by adaptive Gauss–Kronrod quadrature to 1e-10, on the fluids of Piola |
//! | `closed_…` | the closed form as the textbook prints it |
//! | `everything/<flow>_<fluid>` | profile, stresses at 33 places, discharge, plug, dissipation and validity: what a discharge alone does not pay |
//! | `<function>/<fluid>_1`, `_1k` | τ, ζ = τ⁻¹, σ₂: one call; in lanes, nanoseconds an entry |
//! | `history/…` | a K-BKZ fluid: τ in steady shear, the same adaptively after start-up, Simpson's rule of 4096 steps |
//!
//! `error` is the true relative error, against numbers of twice the digits, closed forms, or for lanes one point.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_benches::notes::Notes;
use piola_benches::viscometry::history::{self, RATE};
use piola_benches::viscometry::problems::{PIPE, PLACES, Problem, places, problems};
use piola_benches::viscometry::{carreau_yasuda, giesekus, herschel_bulkley, melt, plain, power_law};
use piola_fluids::FluidsError;
use piola_fluids::{ViscometricFluid, batch};
use piola_viscometry::{Estimate, Poiseuille, Stresses, ViscometryError};

type Group<'a> = BenchmarkGroup<'a, WallTime>;
type Many<F> = fn(&F, &[f64], &mut [f64]) -> Result<(), FluidsError>;

/// Entries of a batch.
const BATCH: usize = 1000;
/// The tolerance of plain quadrature.
const PLAIN: f64 = 1e-10;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("viscometry");
    group.sample_size(10).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(200));
    let mut notes = Notes::of("viscometry");
    group.throughput(Throughput::Elements(1));
    for problem in problems()? {
        flow(&mut group, &mut notes, &problem);
    }
    everything(&mut group, "pipe_carreau_yasuda", &carreau_yasuda()?)?;
    everything(&mut group, "pipe_power_law", &power_law()?)?;
    everything(&mut group, "pipe_herschel_bulkley", &herschel_bulkley()?)?;
    histories(&mut group, &mut notes)?;
    functions(&mut group, &mut notes, "carreau_yasuda", &carreau_yasuda()?);
    functions(&mut group, &mut notes, "power_law", &power_law()?);
    functions(&mut group, &mut notes, "herschel_bulkley", &herschel_bulkley()?);
    functions(&mut group, &mut notes, "giesekus", &giesekus()?);
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// Ours, plain and closed.
fn flow(group: &mut Group<'_>, notes: &mut Notes, problem: &Problem) {
    let name = problem.name();
    let mut answers = [0.0; PLACES];
    let mut measure = |name: &str, run: &dyn Fn(&mut [f64; PLACES])| {
        group.bench_function(name, |b| b.iter(|| run(black_box(&mut answers))));
        run(&mut answers);
        notes.error(name, problem.error(&answers));
    };
    measure(&name, &problem.ours);
    let plain_name = format!("plain_{name}");
    measure(&plain_name, &|answers| (problem.plain)(PLAIN, answers));
    if let Some(closed) = &problem.closed {
        measure(&format!("closed_{name}"), closed);
    }
    notes.peer(&plain_name, plain::NAME);
}

/// Whatever a pipe answers.
fn everything<F: ViscometricFluid>(group: &mut Group<'_>, case: &str, fluid: &F) -> Result<(), ViscometryError> {
    let pipe = Poiseuille::new(PIPE[0], PIPE[1])?;
    let r = places();
    let mut speeds = [Estimate::ZERO; PLACES];
    let mut stresses = [Stresses::default(); PLACES];
    let mut ask = || -> Result<_, ViscometryError> {
        let (pipe, fluid) = (black_box(pipe), black_box(fluid));
        pipe.profile_into(fluid, &r, &mut speeds)?;
        for (r, at) in r.iter().zip(&mut stresses) {
            *at = pipe.stresses(fluid, *r, 0.0)?;
        }
        let validity = pipe.validity(fluid, 1000.0, 10.0)?;
        Ok((pipe.discharge(fluid)?, pipe.dissipation(fluid)?, pipe.plug_radius(fluid), validity))
    };
    ask()?;
    group.bench_function(format!("everything/{case}"), |b| b.iter(&mut ask));
    Ok(())
}

/// The memory of a melt.
fn histories(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let fluid = melt()?;
    let truth = history::exact(&fluid, RATE);
    let mut error = |name: &str, value: f64| notes.error(name, (value / truth - 1.0).abs());
    group.bench_function("history/kbkz_steady", |b| b.iter(|| black_box(&fluid).shear_stress(black_box(RATE))));
    error("history/kbkz_steady", fluid.shear_stress(RATE));
    group.bench_function("history/kbkz_start_up", |b| b.iter(|| black_box(&fluid).start_up(black_box(RATE), 40.0)));
    error("history/kbkz_start_up", fluid.start_up(RATE, 40.0)?.value.shear);
    group.bench_function("history/kbkz_simpson_4096", |b| {
        b.iter(|| history::simpson(black_box(&fluid), black_box(RATE), 2048));
    });
    error("history/kbkz_simpson_4096", history::simpson(&fluid, RATE, 2048).0);
    Ok(())
}

/// One by one and in lanes.
fn functions<F: ViscometricFluid>(group: &mut Group<'_>, notes: &mut Notes, fluid_name: &str, fluid: &F) {
    let rates: Vec<f64> = (0..BATCH).map(|i| 10.0_f64.powf(-3.0 + 6.0 * i as f64 / BATCH as f64)).collect();
    let stresses: Vec<f64> = rates.iter().map(|k| fluid.shear_stress(*k)).collect();
    group.throughput(Throughput::Elements(1));
    let (k, s) = (rates[600], stresses[600]);
    group.bench_function(format!("shear_stress/{fluid_name}_1"), |b| {
        b.iter(|| black_box(fluid).shear_stress(black_box(k)));
    });
    group
        .bench_function(format!("shear_rate/{fluid_name}_1"), |b| b.iter(|| black_box(fluid).shear_rate(black_box(s))));
    if F::NORMAL_STRESSES {
        group.bench_function(format!("sigma2/{fluid_name}_1"), |b| b.iter(|| black_box(fluid).sigma2(black_box(k))));
    }
    group.throughput(Throughput::Elements(BATCH as u64));
    let mut answers = vec![0.0; BATCH];
    let mut many = |what: &str, entries: &[f64], function: Many<F>, one: &dyn Fn(f64) -> f64| {
        let name = format!("{what}/{fluid_name}_1k");
        group.bench_function(&name, |b| b.iter(|| function(black_box(fluid), black_box(entries), &mut answers)));
        let off = entries.iter().zip(&answers).map(|(entry, answer)| (answer / one(*entry) - 1.0).abs());
        notes.error(&name, off.fold(0.0, f64::max));
    };
    many("shear_stress", &rates, batch::shear_stress, &|k| fluid.shear_stress(k));
    many("shear_rate", &stresses, batch::shear_rate, &|s| fluid.shear_rate(s).unwrap_or(f64::NAN));
    if F::NORMAL_STRESSES {
        many("sigma2", &rates, batch::sigma2, &|k| fluid.sigma2(k));
    }
}
