//! Fields on a box from checked records.

mod forms;
mod material;
mod numbers;

use piola_spectral::{BoxGrid, Eigenbasis, LameParameters, SpectralError, Walls};

use super::{BoxFields, BoxStudy, FlowTask, MOST_BYTES, MOST_STEPS, MotionTask, Probe, StaticTask, Task, resolved};
use crate::model::Builder;
use crate::studies::boxes::plan::bytes_in_words;
use forms::Frame;
use numbers::in_words;
use piola_document::{Record, words};

impl Builder<'_> {
    pub(in crate::studies) fn box_study(&mut self, scene: &Record, table: &Record) -> Option<BoxStudy> {
        if table.numbers("sides")?.len() == 2 {
            self.box_fields(scene, table).map(BoxStudy::Rectangle)
        } else {
            self.box_fields(scene, table).map(BoxStudy::Box)
        }
    }

    fn box_fields<const D: usize>(&mut self, scene: &Record, table: &Record) -> Option<BoxFields<D>> {
        let kind = table.text("type")?;
        let lame = self.lame_parameters(table, kind == "flow");
        let sides = self.sides(table);
        let walls = if table.text("walls")? == "guided" { Walls::Guided } else { Walls::Sliding };
        let (sides, lame) = (sides?, lame?);
        if let Err(error) = Eigenbasis::new(sides, lame) {
            return self.refused(table.place_of("sides"), error.to_string(), "lengths within this bound");
        }
        let task = self.task(table, kind, sides);
        let probes = self.probes(scene, sides);
        self.foreign_start(scene, kind);
        let mut fields = BoxFields { sides, walls, lame, loads: Vec::new(), probes: probes?, task: task? };
        let highest = fields.highest();
        let (end, spacings) = match &fields.task {
            Task::Motion(task) => (Some(task.duration), [0.0; D]),
            Task::Static(StaticTask { grid, .. }) | Task::Flow(FlowTask { grid, .. }) => (None, grid.spacings()),
        };
        let frame = Frame { sides, walls, highest, spacing: spacings.into_iter().fold(0.0, f64::max) };
        let starts = self.starts(scene, frame);
        fields.loads = self.loads(scene, frame, end)?;
        let starts = starts?;
        if fields.loads.is_empty() && starts.is_empty() {
            let what = if end.is_some() { "neither a [[load]] nor a [[start]]" } else { "no [[load]]" };
            return self.refused(
                table.place.clone(),
                format!("a [box] of the type {kind} with {what}: nothing moves"),
                "a list of tables, [[load]], as type = \"uniform\" and force_per_volume = \"[0, −9.8] kN/m^3\"",
            );
        }
        if let Task::Motion(task) = &mut fields.task {
            task.starts = starts;
        }
        self.is_recordable(scene, &fields)?;
        self.fits_into_memory(table, &fields)?;
        Some(fields)
    }

    fn sides<const D: usize>(&mut self, table: &Record) -> Option<[f64; D]> {
        let sides: [f64; D] = self.each_axis(table, "sides")?;
        if sides.iter().all(|side| 0.0 < *side) {
            return Some(sides);
        }
        self.refused(
            table.place_of("sides"),
            format!("sides of {} m", words::numbers(&sides)),
            "lengths greater than zero",
        )
    }

    fn task<const D: usize>(&mut self, table: &Record, kind: &str, sides: [f64; D]) -> Option<Task<D>> {
        if kind == "motion" {
            return self.motion(table).map(Task::Motion);
        }
        let grid = self.grid(table, sides)?;
        let modes = if table.has("modes") { Some(self.truncation(table, &grid)?) } else { None };
        if kind == "static" {
            return Some(Task::Static(StaticTask { grid, modes }));
        }
        let duration = table.number("duration")?;
        let step = table.number("step");
        if let Some(step) = step {
            self.steps_are_few(table, "step", duration / step)?;
        }
        Some(Task::Flow(FlowTask { grid, modes, duration, step, least_jacobian: table.number("least_jacobian")? }))
    }

    fn grid<const D: usize>(&mut self, table: &Record, sides: [f64; D]) -> Option<BoxGrid<D>> {
        let points: [usize; D] = self.whole(table, "points")?;
        let is_nodes = table.text("location")? == "nodes";
        let intervals = points.map(|points| if is_nodes { points.saturating_sub(1) } else { points });
        // A grid that is refused for its points has spacings that do not matter.
        let spacings = core::array::from_fn(|axis| sides[axis] / intervals[axis].max(1) as f64);
        let made = if is_nodes { BoxGrid::nodes(points, spacings) } else { BoxGrid::cells(points, spacings) };
        match made {
            Ok(grid) => Some(grid),
            Err(error) => {
                let valid = match &error {
                    SpectralError::TooFewPoints { least, .. } => format!("at least {least} along each axis"),
                    _ => "fewer points".to_string(),
                };
                self.refused(table.place_of("points"), error.to_string(), valid)
            }
        }
    }

    fn truncation<const D: usize>(&mut self, table: &Record, grid: &BoxGrid<D>) -> Option<[usize; D]> {
        let modes: [usize; D] = self.whole(table, "modes")?;
        let most = resolved(grid);
        if modes.iter().zip(most).all(|(index, most)| *index <= most) {
            return Some(modes);
        }
        self.refused(
            table.place_of("modes"),
            format!("modes up to {} are more than the grid can tell apart", in_words(&modes)),
            format!("at most {}", in_words(&most)),
        )
    }

    fn motion<const D: usize>(&mut self, table: &Record) -> Option<MotionTask<D>> {
        let (density, drag) = (table.number("density"), table.number("drag"));
        let duration = table.number("duration");
        if !table.has("modes") {
            return self.refused(
                table.place.clone(),
                "a [box] of the type motion lacks `modes`",
                format!("modes = the highest index along each axis, as {}", in_words(&[16; D])),
            );
        }
        let modes = self.whole(table, "modes");
        let (density, drag, duration) = (density?, drag?, duration?);
        let interval = table.number("interval").unwrap_or(duration / 200.0);
        self.steps_are_few(table, "interval", duration / interval)?;
        Some(MotionTask { modes: modes?, density, drag, duration, interval, starts: Vec::new() })
    }

    fn steps_are_few(&mut self, table: &Record, key: &str, count: f64) -> Option<()> {
        if count <= MOST_STEPS {
            return Some(());
        }
        self.refused(
            table.place_of(key),
            format!("the duration has {count:.0} times the {key} in it"),
            format!("at most {MOST_STEPS} times"),
        )
    }

    fn probes<const D: usize>(&mut self, scene: &Record, sides: [f64; D]) -> Option<Vec<Probe<D>>> {
        let records = scene.records("probe");
        self.unique_names(&[records]);
        let places: Vec<_> = records.iter().map(|record| self.place_in_box(record, sides)).collect();
        let named =
            |(record, at): (&Record, Option<[f64; D]>)| Some(Probe { name: record.text("name")?.to_string(), at: at? });
        records.iter().zip(places).map(named).collect()
    }

    fn foreign_start(&mut self, scene: &Record, kind: &str) {
        if kind != "motion" && scene.has("start") {
            self.refuse(
                scene.place_of("start"),
                format!("[[start]] in a [box] of the type {kind}"),
                "nothing: only a motion starts from a state",
            );
        }
    }

    fn is_recordable<const D: usize>(&mut self, scene: &Record, fields: &BoxFields<D>) -> Option<()> {
        let Task::Motion(task) = &fields.task else { return Some(()) };
        let count = (1.0 + task.duration / task.interval) * fields.probes.len() as f64;
        if count <= MOST_PLACES {
            return Some(());
        }
        self.refused(
            scene.place_of("probe"),
            format!("{count:.0} displacements over all instants and probes"),
            format!("at most {MOST_PLACES}: fewer probes, or a longer `interval`"),
        )
    }

    fn fits_into_memory<const D: usize>(&mut self, table: &Record, fields: &BoxFields<D>) -> Option<()> {
        let bytes = fields.bytes();
        if bytes <= MOST_BYTES {
            return Some(());
        }
        let key = if matches!(fields.task, Task::Motion(_)) { "modes" } else { "points" };
        let what = if key == "modes" {
            format!("modes up to {}, with the nodes that their functions need, take", in_words(&fields.highest()))
        } else {
            format!("{} points take", words::numbers(table.numbers("points").unwrap_or_default()))
        };
        self.refused(
            table.place_of(key),
            format!("{what} {} of memory", bytes_in_words(bytes)),
            format!("at most {}", bytes_in_words(MOST_BYTES)),
        )
    }
}

/// Displacements that are recorded, over all instants and probes.
const MOST_PLACES: f64 = 5_000_000.0;

/// Lamé's parameters, or the mistake about them.
type Lame = Result<LameParameters, SpectralError>;
