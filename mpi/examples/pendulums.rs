//! Times of a sweep of double pendulums: one process, two threads, processes of `mpirun`, a loop over `piola run`, and a loop over
//! the crate `ode_solvers` with the equations written by hand. The table of docs/how-to/sweeps.md.
//!
//! `cargo build --release --manifest-path mpi/Cargo.toml`, then
//! `cargo run --release --manifest-path mpi/Cargo.toml --example pendulums -- 10000`

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use ode_solvers::{Dop853, OutputType, SVector, System};

/// Seconds of each motion, and the relative tolerance.
const END: f64 = 2.0;
const TOLERANCE: f64 = 1e-10;
/// Rounds; each way takes its turn in each.
const ROUNDS: usize = 3;
/// `piola run` starts a program for each member: only so many are run.
const RUNS: u32 = 200;

/// Angles and rates; the second angle is relative to the first rod.
type Angles = SVector<f64, 4>;

/// Masses of 1 and 2 kg on rods of 1 and 0.5 m, as in scenes/double-pendulum.toml.
struct Pendulum;

impl System<f64, Angles> for Pendulum {
    fn system(&self, _: f64, y: &Angles, rate: &mut Angles) {
        const G: f64 = 9.8125;
        let [a, b, u, w] = [y[0], y[0] + y[1], y[2], y[2] + y[3]];
        let (sine, cosine) = (a - b).sin_cos();
        let inertia = 1.0 + 2.0 * sine * sine;
        let du =
            (-3.0 * G * a.sin() + 2.0 * G * b.sin() * cosine - 2.0 * sine * (0.5 * w * w + u * u * cosine)) / inertia;
        let dw = (3.0 * G * (a.sin() * cosine - b.sin()) + sine * (3.0 * u * u + w * w * cosine)) / (0.5 * inertia);
        *rate = [y[2], y[3], du, dw - du].into();
    }
}

fn elbow(member: u32, members: u32) -> f64 {
    let share = f64::from(member) / f64::from(members - 1);
    1.5 * share
}

fn by_hand(members: u32) -> Vec<Angles> {
    let of = |member| {
        let start = [2.0, elbow(member, members), 0.0, 0.0].into();
        let mut method = Dop853::new(Pendulum, 0.0, END, END, start, TOLERANCE, TOLERANCE);
        // Its dense output goes beyond the end.
        method.set_output(OutputType::Sparse);
        method.integrate().unwrap_or_else(|error| panic!("{error}"));
        *method.y_out().last().unwrap_or_else(|| panic!("no state"))
    };
    (0..members).map(of).collect()
}

/// Processor seconds of the programs that have ended, in ticks of 10 ms.
fn spent() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<f64> = text.split(' ').map(|field| field.parse().unwrap_or(0.0)).collect();
    fields.iter().skip(13).take(4).sum::<f64>() / 100.0
}

struct Runner {
    program: PathBuf,
    scene: PathBuf,
    folder: PathBuf,
}

impl Runner {
    fn piola(&self, processes: u32, arguments: &[&str]) {
        let mut command = if processes == 0 { Command::new(&self.program) } else { Command::new("mpirun") };
        if 0 < processes {
            command.args(["--oversubscribe", "--bind-to", "none", "-n", &processes.to_string()]).arg(&self.program);
            command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
        }
        command.arg(arguments[0]).arg(&self.scene).args(&arguments[1..]).arg("--out").arg(&self.folder);
        command.args(["--set", "time.end=2 s", "--set", "output.samples=2", "--set", "integrator.tolerance=1e-10"]);
        let ended = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
        assert!(ended.is_ok_and(|status| status.success()), "{command:?}");
    }

    fn sweep(&self, processes: u32, threads: u32, members: u32) {
        let range = format!("joint.elbow.angle=0:1.5:{members} rad");
        self.piola(processes, &["sweep", "--vary", &range, "--threads", &threads.to_string()]);
    }

    fn runs(&self, members: u32) {
        for member in 0..RUNS {
            let setting = format!("joint.elbow.angle='{:?} rad'", elbow(member * (members / RUNS), members));
            self.piola(0, &["run", "--set", &setting]);
        }
    }
}

fn main() {
    let members = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(10_000).max(RUNS);
    let here = std::env::current_exe().unwrap_or_default();
    let program = here.parent().and_then(Path::parent).map(|folder| folder.join("piola")).unwrap_or_default();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/double-pendulum.toml");
    let folder = std::env::temp_dir().join(format!("piola-pendulums-{}", std::process::id()));
    let runner = Runner { program, scene, folder };
    let ways: [(&str, u32, Box<dyn Fn()>); 6] = [
        ("`piola sweep --threads 1`", members, Box::new(|| runner.sweep(0, 1, members))),
        ("`piola sweep --threads 2`", members, Box::new(|| runner.sweep(0, 2, members))),
        ("`mpirun -n 1 piola sweep --threads 1`", members, Box::new(|| runner.sweep(1, 1, members))),
        ("`mpirun -n 2 piola sweep --threads 1`", members, Box::new(|| runner.sweep(2, 1, members))),
        ("a loop over `piola run`", RUNS, Box::new(|| runner.runs(members))),
        ("a loop over `ode_solvers`, equations by hand", members, Box::new(|| drop(by_hand(members)))),
    ];
    let mut least = [[f64::INFINITY; 2]; 6];
    for _ in 0..ROUNDS {
        for ((_, count, way), least) in ways.iter().zip(&mut least) {
            let (begun, before) = (Instant::now(), spent());
            way();
            let found = [begun.elapsed().as_secs_f64(), spent() - before].map(|time| time / f64::from(*count));
            *least = [least[0].min(found[0]), least[1].min(found[1])];
        }
    }
    println!(
        "| {members} double pendulums, {END} s each | members a second | processor time a member |\n|---|---|---|"
    );
    for ((name, ..), [wall, processor]) in ways.iter().zip(least) {
        println!("| {name} | {:.0} | {:.2} ms |", 1.0 / wall, 1e3 * processor);
    }
    runner.sweep(0, 2, members);
    let table = std::fs::read_to_string(runner.folder.join("members.csv")).unwrap_or_default();
    let mut largest = 0.0_f64;
    for (row, expected) in table.lines().skip(1).zip(by_hand(members)) {
        let found: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        largest = (0..2).map(|k| (found[3 + k] - expected[k]).abs()).fold(largest, f64::max);
    }
    println!("largest difference of an angle at the end: {largest:.0e} rad");
    let _ = std::fs::remove_dir_all(&runner.folder);
}
