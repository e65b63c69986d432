//! How often bands of recovered flow curves hold the truth, and how wide they are beside the errors.
//!
//! ```sh
//! cargo run --release -p piola-viscometry --example bands -- 200
//! ```
//! The first argument is the number of trials of each fluid in each flow, the second, if there is one, the only flow, the third the only
//! fluid. Each table has 25 rows at wall rates from 10⁻² to 10³ 1/s, each response times 1 + 1 % normal noise, which is estimated from the
//! table. Rows whose band reaches by more than a factor of ten are refused, as `piola recover` does.
//!
//! The program first prints what the four numbers of a cell mean. The bands are simultaneous: nominally they hold 95 % of the curves.
//! The results are in `docs/measurements/measured-tables.md`.

use core::fmt::Write as _;
use std::error::Error;
use std::io::Write as _;

use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, PowerLaw, Sisko,
    ViscometricFluid as _,
};
use piola_testkit::NormalNoise;
use piola_viscometry::recover::{self, FlowTable};
use piola_viscometry::{Channel, ConeAndPlate, Couette, ParallelPlates, Poiseuille};

const NOISE: f64 = 0.01;
const ROWS: usize = 25;
const FLOWS: [&str; 6] = ["pipe", "channel", "couette 10:11", "couette 10:20", "plates", "cone"];
/// Radius, half width or inner radius, m.
const SIZE: f64 = 0.01;
const GAP: f64 = 1e-3;
const ANGLE: f64 = 0.03;

fn outer(flow: &str) -> f64 {
    if flow.ends_with("20") { 2.0 * SIZE } else { 1.1 * SIZE }
}

/// An exact row at a wall rate.
fn row(fluid: &AnyFluid, flow: &str, k: f64) -> Result<[f64; 2], Box<dyn Error>> {
    let wall = fluid.shear_stress(k);
    Ok(match flow {
        "pipe" => [2.0 * wall / SIZE, Poiseuille::new(SIZE, 2.0 * wall / SIZE)?.discharge(fluid)?.value],
        "channel" => [wall / SIZE, Channel::new(SIZE, wall / SIZE)?.discharge(fluid)?.value],
        "plates" => {
            let speed = k * GAP / SIZE;
            [speed, ParallelPlates::new(SIZE, GAP, speed)?.torque(fluid)?.value]
        }
        "cone" => [k * ANGLE, ConeAndPlate::new(SIZE, ANGLE, k * ANGLE)?.torque(fluid)?.value],
        _ => {
            let moment = core::f64::consts::TAU * SIZE * SIZE * wall;
            [moment, Couette::new(SIZE, outer(flow), moment)?.speed_difference(fluid)?.value]
        }
    })
}

/// Relative half widths and errors of the recovered rows; none of a row that is not told.
type Rows = Vec<Option<[f64; 2]>>;

/// Recovers a table; `None` where it is refused as a whole.
fn recovered(fluid: &AnyFluid, flow: &str, rows: &[[f64; 2]]) -> Option<Rows> {
    /// Abscissa, value and band of each row.
    macro_rules! points {
        ($curve:expr, $at:ident, $value:ident) => {
            $curve
                .with_band(0.95)
                .ok()?
                .points()
                .map(|point| point.ok().and_then(|point| Some((point.$at, point.$value, point.band?))))
                .collect()
        };
    }
    let points: Vec<Option<(f64, f64, [f64; 2])>> = match flow {
        "pipe" => points!(recover::pipe(&FlowTable::pipe(SIZE, rows).ok()?).ok()?, shear_stress, shear_rate),
        "channel" => points!(recover::channel(&FlowTable::channel(SIZE, rows).ok()?).ok()?, shear_stress, shear_rate),
        "plates" => {
            let table = FlowTable::parallel_plates(SIZE, GAP, rows).ok()?;
            points!(recover::parallel_plates(&table).ok()?, shear_rate, stress)
        }
        "cone" => {
            let table = FlowTable::cone_and_plate(SIZE, ANGLE, rows).ok()?;
            points!(recover::cone_and_plate_torque(&table).ok()?, shear_rate, stress)
        }
        _ => {
            let table = FlowTable::couette(SIZE, outer(flow), rows).ok()?;
            points!(recover::couette(&table).ok()?, shear_stress, shear_rate)
        }
    };
    let is_of_stress = matches!(flow, "plates" | "cone");
    let judged = |(at, value, [low, high]): (f64, f64, [f64; 2])| {
        // The program tells no value whose band reaches by more than a factor of ten on a side.
        if low < 0.1 * value || 10.0 * value < high {
            return None;
        }
        let truth = if is_of_stress { fluid.shear_stress(at) } else { fluid.shear_rate(at).ok()? };
        // Of a row that is held the half width is positive, of one that is missed negative.
        let half = 0.5 * (high - low) / truth;
        let sign = if low <= truth && truth <= high { 1.0 } else { -1.0 };
        Some([sign * half, (value / truth - 1.0).abs()])
    };
    Some(points.into_iter().map(|point| point.and_then(judged)).collect())
}

/// The value below which this share of the numbers lies.
fn quantile(mut numbers: Vec<f64>, share: f64) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let place = (share * (numbers.len() as f64 - 1.0)).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
    let place = place.max(0.0) as usize;
    numbers.get(place).copied().unwrap_or(f64::NAN)
}

/// What the numbers of a cell mean.
const LEGEND: &str = "A cell: share of the tables of which all recovered rows are held, %; share of the recovered rows that are held, %;\n\
    the largest ratio, over the rows recovered in half of the tables, of the median half width and the 95th percentile of the error;\n\
    share of the rows that are refused, %.\n";

/// A cell of the table, as [`LEGEND`] says.
fn cell(fluid: &AnyFluid, flow: &str, trials: u32, normal: &mut NormalNoise) -> Result<String, Box<dyn Error>> {
    let exact: Vec<[f64; 2]> = (0..ROWS)
        .map(|i| row(fluid, flow, 1e-2 * 1e5_f64.powf(i as f64 / (ROWS as f64 - 1.0))))
        .collect::<Result<_, _>>()?;
    let mut by_row = vec![Vec::new(); ROWS];
    let (mut whole, mut counted, mut refused) = (0_u32, 0_u32, 0_usize);
    for _ in 0..trials {
        let noisy: Vec<[f64; 2]> =
            exact.iter().map(|[drive, response]| [*drive, response * (1.0 + NOISE * normal.draw())]).collect();
        let Some(rows) = recovered(fluid, flow, &noisy) else {
            refused += ROWS;
            continue;
        };
        refused += ROWS - rows.iter().flatten().count();
        counted += u32::from(rows.iter().any(Option::is_some));
        whole += u32::from(rows.iter().any(Option::is_some) && rows.iter().flatten().all(|[half, _]| 0.0 < *half));
        for (place, row) in rows.into_iter().enumerate() {
            by_row[place].extend(row);
        }
    }
    if counted == 0 {
        return Ok("refused".to_owned());
    }
    let held = by_row.iter().flatten().filter(|[half, _]| 0.0 < *half).count();
    let all = by_row.iter().map(Vec::len).sum::<usize>();
    // Rows that were told in at least half of the trials.
    let ratio = by_row.iter().filter(|row| trials <= 2 * u32::try_from(row.len()).unwrap_or(0)).map(|row| {
        let widths = row.iter().map(|[half, _]| half.abs()).collect();
        let errors = row.iter().map(|[_, error]| *error).collect();
        quantile(widths, 0.5) / quantile(errors, 0.95)
    });
    // A dash where no row is recovered that often, or a ratio is none.
    let ratio = ratio.reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
    let ratio = ratio.filter(|ratio| ratio.is_finite()).map_or_else(|| "–".to_owned(), |ratio| format!("{ratio:.1}"));
    let share = |part: f64, all: f64| 100.0 * part / all;
    Ok(format!(
        "{:.1} / {:.1} / {ratio} / {:.0}",
        share(f64::from(whole), f64::from(counted)),
        share(held as f64, all as f64),
        share(refused as f64, f64::from(trials) * ROWS as f64)
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    let trials = std::env::args().nth(1).map_or(Ok(200), |text| text.parse())?;
    let only = |argument: usize, name: &str| std::env::args().nth(argument).is_none_or(|only| only == name);
    let flows: Vec<&str> = FLOWS.into_iter().filter(|flow| only(2, flow)).collect();
    let mut normal = NormalNoise(20_261_127);
    let mut out = std::io::stdout();
    writeln!(out, "{LEGEND}")?;
    writeln!(out, "| fluid | {} |\n|---|{}", flows.join(" | "), "---|".repeat(flows.len()))?;
    let fluids: [AnyFluid; 10] = [
        Newtonian::new(0.7)?.into(),
        PowerLaw::new(3.0, 0.5)?.into(),
        Bingham::new(5.0, 0.2)?.into(),
        Casson::new(5.0, 0.2)?.into(),
        HerschelBulkley::new(10.0, 5.0, 0.5)?.into(),
        Eyring::new(10.0, 0.1)?.into(),
        Sisko::new(0.05, 3.0, 0.5)?.into(),
        Ellis::new(50.0, 10.0, 2.5)?.into(),
        Cross::new(50.0, 0.02, 2.0, 0.75)?.into(),
        CarreauYasuda::new(10.0, 0.01, 1.0, 0.4, 2.0)?.into(),
    ];
    for fluid in fluids.iter().filter(|fluid| only(3, fluid.name())) {
        let mut line = format!("| {} |", fluid.name());
        for &flow in &flows {
            write!(line, " {} |", cell(fluid, flow, trials, &mut normal)?)?;
        }
        writeln!(out, "{line}")?;
    }
    Ok(())
}
