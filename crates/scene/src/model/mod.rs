//! The typed scene, built from a checked document.
//!
//! Values are in SI units and valid by themselves and together: names are unique and resolved, masses positive, bodies
//! apart, coordinates independent, reference files read.

mod central;
mod constraints;
mod forces;
mod gravitation;
mod hamiltonian;
mod mechanism;
mod reference;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

pub use piola_simulation::joints::{JointTree, Mechanism, PartName};
pub use piola_simulation::motion::{
    Central, Gravitation, MassPoint, NEWTONIAN_CONSTANT, Orbiter, PostNewtonian, System, TimeSpan,
};
pub use piola_simulation::phase::PhaseSystem;
pub use reference::{ClosedForm, Reference, ReferenceKind, ReferenceTable};

use crate::SceneError;
use crate::schema::{Kind, SCENE, SCENE_KINDS, SceneKind};
use piola_document::{Document, Mistake, Place, Record, words};

/// A scene: a system, a span of time, how to integrate it, what to write, what to compare with.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Name, also of the default output folder.
    pub name: String,
    /// Title of figures.
    pub title: Option<String>,
    /// The bodies and the forces between them.
    pub system: System,
    /// The span of time.
    pub time: TimeSpan,
    /// The method, step and tolerance that were asked for.
    pub integrator: IntegratorRequest,
    /// The files to write.
    pub output: OutputRequest,
    /// The reference for the result.
    pub reference: Option<Reference>,
}

/// The method, step and tolerance of a scene. The planner fills in those that are absent.
#[derive(Debug, Clone, PartialEq)]
pub struct IntegratorRequest {
    /// One of [`METHODS`](crate::schema::METHODS).
    pub method: String,
    /// Step of a method of fixed step, s.
    pub step: Option<f64>,
    /// Relative tolerance of an adaptive method.
    pub tolerance: Option<f64>,
}

/// The files that a scene asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputRequest {
    /// Folder, relative to the current one.
    pub folder: PathBuf,
    /// Number of instants, at least 2.
    pub samples: u32,
    /// Whether tables are written.
    pub tables: bool,
    /// Whether figures are drawn.
    pub figures: bool,
}

impl Scene {
    /// Reads a scene file, applies settings of the form `path=value`, and checks the result.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] with all mistakes; other variants when there is no text to check.
    pub fn load(path: &Path, settings: &[String]) -> Result<Self, SceneError> {
        Self::from_document(&Document::read_with(path, settings)?)
    }

    /// Checks a document and builds its scene.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] with every mistake found.
    ///
    /// # Example
    /// ```
    /// use piola_scene::{Document, Scene, SceneError};
    /// let document = Document::parse("orbit.toml", "
    ///     [central]
    ///     gm = 1.0
    ///     [[body]]
    ///     name = 'comet'
    ///     semi_major_axis = '-1 m'
    ///     eccentricity = 0.5
    ///     [time]
    ///     revolutions = 3
    /// ");
    /// let Err(SceneError::Invalid(report)) = Scene::from_document(&document) else { panic!() };
    /// assert_eq!((report.mistakes[0].line, report.mistakes[0].column), (6, 23));
    /// ```
    pub fn from_document(document: &Document) -> Result<Self, SceneError> {
        let (record, mistakes) = document.records(&SCENE);
        let mut builder = Builder::new(document, mistakes);
        let scene = builder.scene(&record);
        builder.finish(scene)
    }

    /// Names of everything that has a position, in the order of positions.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        self.system.names()
    }
}

/// Builds the model and collects mistakes.
pub(crate) struct Builder<'d> {
    pub(crate) document: &'d Document,
    mistakes: Vec<Mistake>,
    /// What scenes of one document keep for each other.
    kept: Option<&'d Kept>,
}

/// What scenes share that differ in numbers alone.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kept {
    /// The file of the reference, and its rows.
    reference: OnceLock<(PathBuf, Vec<reference::Row>)>,
}

impl<'d> Builder<'d> {
    pub(crate) fn new(document: &'d Document, mistakes: Vec<Mistake>) -> Self {
        Self { document, mistakes, kept: None }
    }

    /// Builds a scene like one that had no mistakes, but for numbers.
    pub(crate) fn keeping(self, kept: &'d Kept) -> Self {
        Self { kept: Some(kept), ..self }
    }

    /// Whether a scene like this one, but for numbers, had no mistakes: names need not be looked at again.
    pub(crate) const fn is_kept(&self) -> bool {
        self.kept.is_some()
    }

    /// The model, if there is no mistake.
    pub(crate) fn finish<T>(self, built: Option<T>) -> Result<T, SceneError> {
        match built {
            Some(built) if self.mistakes.is_empty() => Ok(built),
            _ => Err(SceneError::Invalid(self.document.report(self.mistakes))),
        }
    }

    /// The one kind of the scene, with what does not belong to it reported.
    pub(crate) fn kind(&mut self, record: &Record) -> Option<&'static SceneKind> {
        let written: Vec<_> = SCENE_KINDS.iter().filter(|kind| record.has(kind.name)).collect();
        let [kind] = written.as_slice() else {
            let what = if written.is_empty() {
                let syntax = self.mistakes.iter().any(|mistake| mistake.syntax);
                if syntax {
                    return None;
                }
                Mistake::new(record.place.clone(), "the scene has no system")
            } else {
                let names: Vec<String> = written.iter().map(|kind| format!("[{}]", kind.name)).collect();
                Mistake::new(record.place_of(written[1].name), format!("the scene has {}", names.join(" and ")))
            };
            let names: Vec<String> = SCENE_KINDS.iter().map(|kind| format!("[{}]", kind.name)).collect();
            self.wrong(what.valid(format!("exactly one of {}", names.join(", "))));
            return None;
        };
        // Each table once, however many kinds have it.
        let belongings: BTreeSet<&str> = SCENE_KINDS.iter().flat_map(|kind| kind.lists).copied().collect();
        for table in belongings.into_iter().filter(|table| record.has(table) && !kind.lists.contains(table)) {
            let headers: Vec<String> = kind.lists.iter().map(|name| header(name)).collect();
            let valid = if headers.is_empty() { "no such table".to_string() } else { headers.join(", ") };
            self.refuse(record.place_of(table), format!("{} in a scene of [{}]", header(table), kind.name), valid);
        }
        Some(kind)
    }

    pub(crate) fn wrong(&mut self, mistake: Mistake) {
        self.mistakes.push(mistake);
    }

    /// Adds a mistake: what was found at a place, and what would be valid.
    pub(crate) fn refuse(&mut self, place: Place, found: impl Into<String>, valid: impl Into<String>) {
        self.wrong(Mistake::new(place, found).valid(valid));
    }

    /// Adds a mistake after which there is nothing to return.
    pub(crate) fn refused<T>(&mut self, place: Place, found: impl Into<String>, valid: impl Into<String>) -> Option<T> {
        self.refuse(place, found, valid);
        None
    }

    /// The scene; parts that cannot be built have mistakes of their own.
    pub(crate) fn scene(&mut self, record: &Record) -> Option<Scene> {
        let name = record.text("name").map_or_else(|| self.file_stem(), str::to_string);
        let system = self.system(record);
        let period = match &system {
            Some(System::Central(central)) => central.period(),
            _ => None,
        };
        let time = self.time(record, period);
        let integrator = self.integrator(record);
        let output = output(record, &name);
        self.has_closed_form(record, system.as_ref());
        self.keeps_constraints(record);
        self.has_reactions(record);
        self.answerable(record, time);
        self.recordable(record, system.as_ref(), &output);
        let reference = self.reference(record, system.as_ref(), time);
        Some(Scene {
            name,
            title: record.text("title").map(str::to_string),
            system: system?,
            time: time?,
            integrator,
            output,
            reference: reference?,
        })
    }

    pub(crate) fn file_stem(&self) -> String {
        let stem = Path::new(self.document.name()).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let safe = |c: char| if c.is_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' };
        stem.filter(|stem| !stem.is_empty())
            .map_or_else(|| "scene".to_string(), |stem| stem.chars().map(safe).collect())
    }

    fn system(&mut self, record: &Record) -> Option<System> {
        let kind = self.kind(record)?;
        if kind.study {
            return self.refused(
                record.place_of(kind.name),
                format!("a scene of [{}] is a study: nothing moves in it", kind.name),
                "[gravity], [mechanism], [central] or [hamiltonian]",
            );
        }
        let table = record.record(kind.name)?;
        match kind.name {
            "gravity" => self.gravitation(record, table).map(System::Gravitation),
            "mechanism" => self.mechanism(record, table).map(|system| System::Mechanism(Box::new(system))),
            "hamiltonian" => self.hamiltonian(record, table).map(|system| System::Phase(Box::new(system))),
            _ => self.central(record, table).map(System::Central),
        }
    }

    pub(crate) fn time(&mut self, record: &Record, period: Option<f64>) -> Option<TimeSpan> {
        let Some(table) = record.record("time") else {
            let syntax = self.mistakes.iter().any(|mistake| mistake.syntax);
            if !record.has("time") && !syntax {
                self.refuse(record.place.clone(), "the scene lacks [time]", "time = a table, [time]: the span of time");
            }
            return None;
        };
        let start = table.number("start")?;
        if table.has("revolutions") && !record.has("central") {
            return self.refused(table.place_of("revolutions"), "`revolutions` without [central]", "end = a time");
        }
        if table.has("end") == table.has("revolutions") {
            let what = if table.has("end") { "[time] has both `end` and `revolutions`" } else { "[time] has no `end`" };
            let place = if table.has("end") { table.place_of("revolutions") } else { table.place.clone() };
            return self.refused(place, what, "end = a time, as end = \"10 d\"");
        }
        if let (Some(revolutions), Some(period)) = (table.number("revolutions"), period) {
            return Some(TimeSpan { start, end: start + revolutions * period });
        }
        let end = table.number("end")?;
        if start < end || end < start {
            return Some(TimeSpan { start, end });
        }
        self.refused(
            table.place_of("end"),
            format!("the end, {} s, is the start", words::number(end)),
            "a time after the start, or before it for a run backwards in time",
        )
    }

    pub(crate) fn integrator(&mut self, record: &Record) -> IntegratorRequest {
        /// Methods raise what is less: their steps would grow short, and nothing would be won.
        const LEAST_TOLERANCE: f64 = 2.0 * f64::EPSILON;
        let table = record.record("integrator");
        let method = table.and_then(|table| table.text("method")).unwrap_or("auto").to_string();
        let request = IntegratorRequest {
            step: table.and_then(|table| table.number("step")),
            tolerance: table.and_then(|table| table.number("tolerance")),
            method,
        };
        if let (Some(table), Some(tolerance)) = (table, request.tolerance)
            && tolerance < LEAST_TOLERANCE
        {
            self.refuse(
                table.place_of("tolerance"),
                format!("the tolerance {tolerance:e} is below rounding"),
                format!("from {LEAST_TOLERANCE:.1e} to less than 1"),
            );
        }
        if let Some(table) = table {
            let adaptive =
                ["dormand-prince-853", "verner-98", "nystrom-86", "nystrom-1210"].contains(&request.method.as_str());
            let closed = request.method == "closed-form";
            if closed && !record.has("central") && !record.has("mechanism") {
                self.refuse(
                    table.place_of("method"),
                    "the closed form in a scene that is not of [central] or [mechanism]",
                    "[central] with ellipses, a [mechanism] that is a symmetric top, or another method",
                );
            }
            let fixed = !adaptive && request.method != "auto";
            for (key, wrong) in [("step", adaptive || closed), ("tolerance", fixed)] {
                if wrong && table.has(key) {
                    let valid = match (closed, adaptive) {
                        (true, _) => "neither step nor tolerance: a closed form has no steps",
                        (_, true) => "tolerance: its step adapts",
                        _ => "step: its step is fixed",
                    };
                    self.refuse(table.place_of(key), format!("`{key}` with the method {}", request.method), valid);
                }
            }
            if request.method == "auto" && table.has("step") && table.has("tolerance") {
                self.refuse(
                    table.place_of("tolerance"),
                    "both `step` and `tolerance`",
                    "step for a fixed step, tolerance for an adaptive one",
                );
            }
        }
        request
    }

    /// Checks that what is recorded fits into memory.
    fn recordable(&mut self, record: &Record, system: Option<&System>, output: &OutputRequest) {
        /// Numbers over all instants: about a gigabyte with their tables.
        const MOST: usize = 30_000_000;
        let columns = match system {
            Some(System::Mechanism(system)) => {
                let parts = system.parts.len();
                let energies = if system.questions.energies { 2 * parts + system.forces.len() } else { 0 };
                let held = if system.reactions { 6 * parts + system.condition_names().len() } else { 0 };
                3 * parts + 2 * system.coordinates.len() + system.work_names().len() + energies + held
            }
            Some(System::Phase(system)) => 2 * system.freedom() + 1,
            _ => 6 * record.records("body").len(),
        };
        let (samples, most) = (output.samples as usize, MOST / columns.max(1));
        if most < samples {
            let place = record.record("output").map_or(record.place.clone(), |table| table.place_of("samples"));
            self.refuse(
                place,
                format!("{samples} samples of {columns} numbers are more than {MOST}"),
                format!("samples = at most {most}"),
            );
        }
    }

    /// Checks that names differ over all the given lists.
    pub(crate) fn unique_names(&mut self, lists: &[&[Record]]) {
        let mut seen: std::collections::HashMap<&str, &Record> = std::collections::HashMap::new();
        for record in lists.iter().copied().flatten() {
            let Some(name) = record.text("name") else { continue };
            if let Some(first) = seen.insert(name, record) {
                self.mistakes.push(
                    Mistake::new(record.place_of("name"), format!("the name `{name}` is taken"))
                        .see(first.place_of("name"), "first here")
                        .valid("a name unlike any other"),
                );
            }
        }
    }

    /// The index of a name, or a mistake that lists the valid ones.
    pub(crate) fn find(&mut self, record: &Record, key: &str, what: &str, names: &[&str]) -> Option<usize> {
        let name = record.text(key)?;
        let found = names.iter().position(|known| *known == name);
        if found.is_none() {
            self.refuse(
                record.place_of(key),
                format!("no {what} is named `{name}`"),
                words::one_of(name, names.iter().copied()),
            );
        }
        found
    }
}

/// The header of a table of the scene: `[law]`, `[[body]]`.
fn header(name: &str) -> String {
    match SCENE.key(name).map(|key| &key.kind) {
        Some(Kind::Tables(_)) => format!("[[{name}]]"),
        _ => format!("[{name}]"),
    }
}

/// The files to write.
pub(crate) fn output(record: &Record, name: &str) -> OutputRequest {
    let table = record.record("output");
    let folder = table.and_then(|table| table.text("folder")).map(PathBuf::from);
    OutputRequest {
        folder: folder.unwrap_or_else(|| Path::new("out").join(name)),
        samples: table.and_then(|table| table.count("samples")).unwrap_or(1001),
        tables: table.and_then(|table| table.flag("tables")).unwrap_or(true),
        figures: table.and_then(|table| table.flag("figures")).unwrap_or(true),
    }
}
