//! How often nominal 95 % intervals hold the parameters, over noisy tables made from every fluid in every flow.
//!
//! ```sh
//! cargo run --release -p piola-fit --features fluids --example coverage -- 300
//! ```
//! The first argument is the number of trials of each case, the second the kind of intervals, as `profile` or `bootstrap:200`, the third, if there is
//! one, the only flow. Each table has 25 rows at rates or wall rates from 10⁻² to 10³ 1/s, each response
//! times 1 + 1 % normal noise. Flows are solved by `piola_viscometry`, which the fit does not use for its answers.

use core::fmt::Write as _;
use std::io::Write as _;

use piola_fit::fluids::{FlowData, Options, State, fit_flow};
use piola_fit::{FitError, Intervals};
use piola_fluids::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, Parameters, PowerLaw, Sisko,
    ViscometricFluid,
};
use piola_testkit::NormalNoise;
use piola_viscometry::recover::FlowTable;
use piola_viscometry::{Channel, ConeAndPlate, Couette, ParallelPlates, Poiseuille};

const NOISE: f64 = 0.01;
const FLOWS: [&str; 7] = ["curve", "pipe", "channel", "couette 10:11", "couette 10:20", "plates", "cone"];
/// Radius, half width or inner radius, m.
const SIZE: f64 = 0.01;
const GAP: f64 = 1e-3;
const ANGLE: f64 = 0.03;

/// Exact rows of a flow.
fn rows<F: ViscometricFluid>(fluid: &F, flow: &str) -> Result<Vec<[f64; 2]>, Box<dyn std::error::Error>> {
    let rates = (0..25_u32).map(|i| 1e-2 * 1e5_f64.powf(f64::from(i) / 24.0));
    let row = |k: f64| -> Result<[f64; 2], Box<dyn std::error::Error>> {
        let wall = fluid.shear_stress(k);
        Ok(match flow {
            "curve" => [k, wall],
            "pipe" => [2.0 * wall / SIZE, Poiseuille::new(SIZE, 2.0 * wall / SIZE)?.discharge(fluid)?.value],
            "channel" => [wall / SIZE, Channel::new(SIZE, wall / SIZE)?.discharge(fluid)?.value],
            "plates" => {
                let speed = k * GAP / SIZE;
                [speed, ParallelPlates::new(SIZE, GAP, speed)?.torque(fluid)?.value]
            }
            "cone" => [k * ANGLE, ConeAndPlate::new(SIZE, ANGLE, k * ANGLE)?.torque(fluid)?.value],
            couette => {
                let outer = if couette.ends_with("20") { 2.0 * SIZE } else { 1.1 * SIZE };
                let moment = core::f64::consts::TAU * SIZE * SIZE * wall;
                [moment, Couette::new(SIZE, outer, moment)?.speed_difference(fluid)?.value]
            }
        })
    };
    rates.map(row).collect()
}

fn data(flow: &str, rows: &[[f64; 2]]) -> Result<FlowData, FitError> {
    Ok(match flow {
        "curve" => FlowData::flow_curve(rows)?,
        "pipe" => FlowData::pipe(&FlowTable::pipe(SIZE, rows)?),
        "channel" => FlowData::channel(&FlowTable::channel(SIZE, rows)?),
        "plates" => FlowData::parallel_plates(&FlowTable::parallel_plates(SIZE, GAP, rows)?),
        "cone" => FlowData::cone_and_plate(&FlowTable::cone_and_plate(SIZE, ANGLE, rows)?),
        couette => {
            let outer = if couette.ends_with("20") { 2.0 * SIZE } else { 1.1 * SIZE };
            FlowData::couette(&FlowTable::couette(SIZE, outer, rows)?)
        }
    })
}

/// Trials of one fluid in every flow: a line each, with the least and the greatest coverage over its parameters.
fn fluid<F: Parameters<N> + ViscometricFluid, const N: usize>(
    truth: [f64; N],
    (trials, intervals): (u32, Intervals),
    normal: &mut NormalNoise,
    totals: &mut [(&str, u64, u64)],
) -> Result<(), Box<dyn std::error::Error>> {
    let options = Options { intervals, ..Options::default() };
    let fluid = F::from_parameters(truth)?;
    let mut line = format!("| {} |", F::NAME);
    for (flow, all_held, all_told) in totals {
        let exact = rows(&fluid, flow)?;
        let (mut held, mut told) = ([0_u64; N], [0_u64; N]);
        for _ in 0..trials {
            let noisy: Vec<[f64; 2]> =
                exact.iter().map(|[drive, response]| [*drive, response * (1.0 + NOISE * normal.draw())]).collect();
            // Below the truth: what yields at a larger stress than the smallest of the table has no answers there.
            let start = truth.map(|x| 0.95 * x);
            let Ok(found) = fit_flow::<F, N>(&[data(flow, &noisy)?], &[start], &options) else { continue };
            for (k, parameter) in found.parameters.iter().enumerate() {
                if let (State::Determined, Some([low, high])) = (parameter.state, parameter.interval) {
                    told[k] += 1;
                    held[k] += u64::from(low <= truth[k] && truth[k] <= high);
                }
            }
        }
        let shares = (0..N).filter(|k| 0 < told[*k]).map(|k| 100.0 * held[k] as f64 / told[k] as f64);
        let (low, high) = shares.fold((100.0, 0.0_f64), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
        write!(line, " {low:.0}–{high:.0} |")?;
        *all_held += held.iter().sum::<u64>();
        *all_told += told.iter().sum::<u64>();
    }
    writeln!(std::io::stdout(), "{line}")?;
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(200), |text| text.parse())?;
    let intervals = std::env::args().nth(2).map_or(Ok(Intervals::Linear), |text| text.parse())?;
    let only = std::env::args().nth(3);
    let flows: Vec<&str> = FLOWS.into_iter().filter(|flow| only.as_ref().is_none_or(|only| only == flow)).collect();
    let (mut normal, trials) = (NormalNoise(20_261_126), (count, intervals));
    let mut totals: Vec<(&str, u64, u64)> = flows.iter().map(|flow| (*flow, 0, 0)).collect();
    let mut out = std::io::stdout();
    writeln!(out, "| fluid | {} |\n|---|{}", flows.join(" | "), "---|".repeat(flows.len()))?;
    fluid::<Newtonian, 1>([0.7], trials, &mut normal, &mut totals)?;
    fluid::<PowerLaw, 2>([3.0, 0.5], trials, &mut normal, &mut totals)?;
    fluid::<Bingham, 2>([5.0, 0.2], trials, &mut normal, &mut totals)?;
    fluid::<Casson, 2>([5.0, 0.2], trials, &mut normal, &mut totals)?;
    fluid::<HerschelBulkley, 3>([10.0, 5.0, 0.5], trials, &mut normal, &mut totals)?;
    fluid::<Eyring, 2>([10.0, 0.1], trials, &mut normal, &mut totals)?;
    fluid::<Sisko, 3>([0.05, 3.0, 0.5], trials, &mut normal, &mut totals)?;
    fluid::<Ellis, 3>([50.0, 10.0, 2.5], trials, &mut normal, &mut totals)?;
    fluid::<Cross, 4>([50.0, 0.02, 2.0, 0.75], trials, &mut normal, &mut totals)?;
    fluid::<CarreauYasuda, 5>([10.0, 0.01, 1.0, 0.4, 2.0], trials, &mut normal, &mut totals)?;
    let all: Vec<String> =
        totals.iter().map(|(_, held, told)| format!("{:.1}", 100.0 * *held as f64 / *told as f64)).collect();
    writeln!(out, "| all parameters | {} |", all.join(" | "))?;
    Ok(())
}
