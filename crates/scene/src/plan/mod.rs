//! The plan of a run: method and step, computed and skipped quantities, each with its reason.

mod choice;
mod mechanism;
mod phase;

use core::fmt;

pub use piola_simulation::motion::Method;

use piola_document::words;
use piola_simulation::motion::Timetable;
use serde::{Serialize, Serializer};

use crate::model::{ReferenceKind, Scene, System};

/// The plan of a run.
///
/// # Example
/// ```
/// use piola_scene::{Document, Plan, Scene};
/// let document = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.99
///     [time]
///     revolutions = 3
/// ");
/// let plan = Plan::of(&Scene::from_document(&document)?);
/// assert_eq!(plan.method.to_string(), "closed-form");
/// assert!(plan.reason.contains("ellipse"));
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Plan {
    /// Name of the scene.
    pub name: String,
    /// The system in words.
    pub system: String,
    /// Number of first-order equations.
    pub equations: usize,
    /// Method of integration.
    #[serde(serialize_with = "method_summary")]
    pub method: Method,
    /// Why this method with this step.
    pub reason: String,
    /// Start, s.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// Number of steps, for a fixed step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<u64>,
    /// Instants at which the state is recorded.
    pub instants: usize,
    /// Quantities computed besides the motion.
    pub computed: Vec<Item>,
    /// Quantities not computed.
    pub skipped: Vec<Item>,
    /// Folder of the results.
    pub folder: String,
    /// Files that will be written.
    pub files: Vec<String>,
}

/// Something that is computed or skipped, with the reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Item {
    /// The quantity.
    pub what: String,
    /// The reason, or the method.
    pub why: String,
}

#[derive(Serialize)]
struct MethodSummary {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    order: Option<u32>,
    symplectic: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    relative_tolerance: Option<f64>,
}

impl From<Method> for MethodSummary {
    fn from(method: Method) -> Self {
        let (order, symplectic, step_s, relative_tolerance) = match method {
            Method::Composition { order, step } | Method::GaussLegendre { order, step } => {
                (Some(order.value()), true, Some(step), None)
            }
            Method::DormandPrince { tolerance } | Method::Nystrom86 { tolerance } => {
                (Some(8), false, None, Some(tolerance))
            }
            Method::Verner { tolerance } => (Some(9), false, None, Some(tolerance)),
            Method::Nystrom1210 { tolerance } => (Some(12), false, None, Some(tolerance)),
            Method::ClosedForm => (None, true, None, None),
        };
        Self { name: method.to_string(), order, symplectic, step_s, relative_tolerance }
    }
}

/// Writes a method with its order and whether it is symplectic.
pub(crate) fn method_summary<S: Serializer>(method: &Method, serializer: S) -> Result<S::Ok, S::Error> {
    MethodSummary::from(*method).serialize(serializer)
}

impl Plan {
    /// The plan of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let mut plan = Self::brief(scene);
        plan.system = describe(&scene.system);
        plan.folder = scene.output.folder.display().to_string();
        plan.files.push("summary.json".to_string());
        plan.system_items(scene);
        plan.output_items(scene);
        plan
    }

    /// The plan that [`run`](crate::run::run()) needs: the method and the numbers. What is computed, what is skipped and which files are written
    /// is left out.
    ///
    /// # Example
    /// ```
    /// use piola_scene::{Document, Plan, Scene};
    /// let document = Document::parse("orbit.toml", "
    ///     [central]
    ///     gm = 1.0
    ///     [[body]]
    ///     name = 'comet'
    ///     semi_major_axis = 1.0
    ///     eccentricity = 0.99
    ///     [time]
    ///     revolutions = 3
    /// ");
    /// let scene = Scene::from_document(&document)?;
    /// let (brief, whole) = (Plan::brief(&scene), Plan::of(&scene));
    /// assert_eq!((brief.method, brief.instants), (whole.method, whole.instants));
    /// assert!(brief.computed.is_empty() && !whole.computed.is_empty());
    /// # Ok::<(), piola_scene::SceneError>(())
    /// ```
    #[must_use]
    pub fn brief(scene: &Scene) -> Self {
        let (method, reason) = choice::method(scene);
        let timetable = timetable(scene);
        let instants = timetable.instants();
        let steps = method.step().map(|step| steps(instants, step));
        Self {
            name: scene.name.clone(),
            system: String::new(),
            equations: equations(&scene.system),
            method,
            reason,
            start: scene.time.start,
            end: scene.time.end,
            steps,
            instants: instants.len(),
            computed: Vec::new(),
            skipped: Vec::new(),
            folder: String::new(),
            files: Vec::new(),
        }
    }

    fn compute(&mut self, what: &str, why: impl Into<String>) {
        self.computed.push(Item { what: what.to_string(), why: why.into() });
    }

    fn skip(&mut self, what: &str, why: impl Into<String>) {
        self.skipped.push(Item { what: what.to_string(), why: why.into() });
    }

    fn system_items(&mut self, scene: &Scene) {
        match &scene.system {
            System::Gravitation(system) => {
                self.compute("Newtonian attraction", "every pair once, direct summation");
                match system.post_newtonian {
                    Some(term) => self.compute(
                        "post-Newtonian term",
                        format!(
                            "first order, of {}, with its reaction: gravity.post_newtonian = true",
                            system.bodies[term.central].name
                        ),
                    ),
                    None => self.skip("post-Newtonian term", "gravity.post_newtonian = false"),
                }
                if system.softening > 0.0 {
                    self.compute("softening", format!("gravity.softening = {} m", words::number(system.softening)));
                } else {
                    self.skip("softening", "gravity.softening = 0: the true law");
                }
                self.skip("attitudes", "bodies without extent");
                self.skip("collisions", "bodies without extent cannot touch");
                self.compute(
                    "energy, momentum, angular momentum",
                    "conserved: compensated sums at every recorded instant",
                );
            }
            System::Mechanism(system) => {
                self.evaluation_items(system);
                if system.gravity.iter().all(|g| g.abs() <= 0.0) {
                    self.skip("gravity", "mechanism.gravity is zero");
                } else {
                    self.compute("gravity", format!("uniform, {} m/s²", words::numbers(&system.gravity)));
                }
                if !system.parts.iter().any(|part| part.rigid) {
                    self.skip("attitudes", "no rigid bodies");
                }
                self.skip("row of time in the metric", "the placement does not depend on time");
                self.constraint_items(system, scene.time.start);
                self.force_items(system);
                self.skip("momentum and angular momentum", "not conserved: the ground holds the mechanism");
            }
            System::Phase(system) => self.phase_items(system),
            System::Central(system) => {
                let gm = format!("gm = {} m³/s²", words::number(system.gm));
                if self.method == Method::ClosedForm {
                    self.compute("Kepler's ellipses", format!("in closed form at every recorded instant; {gm}"));
                    self.skip("forces and steps", "the closed form needs neither");
                } else {
                    self.compute("central attraction", gm);
                }
                self.skip("attraction between bodies", "[central]: the bodies do not attract");
                self.skip("attitudes", "bodies without extent");
                self.compute("energy and angular momentum", "conserved: at every recorded instant");
                self.skip("momentum", "not conserved: the centre is held");
            }
        }
    }

    fn output_items(&mut self, scene: &Scene) {
        match &scene.reference {
            Some(reference) => {
                let how = match &reference.kind {
                    ReferenceKind::Table(table) => {
                        format!("{} instants of {}", table.times.len(), table.path.display())
                    }
                    ReferenceKind::ClosedForm(_) => "closed form at every recorded instant".to_string(),
                };
                self.compute("error against reference", how);
            }
            None => self.skip("error against reference", "no [reference]"),
        }
        if scene.output.tables {
            if !matches!(scene.system, System::Phase(_)) {
                self.files.push("trajectory.csv".to_string());
            }
            self.files.push("invariants.csv".to_string());
            if matches!(scene.system, System::Mechanism(_) | System::Phase(_)) {
                self.files.push("coordinates.csv".to_string());
            }
            if let System::Mechanism(system) = &scene.system {
                self.files.extend(mechanism::tables(system).map(str::to_string));
            }
            if let System::Phase(system) = &scene.system {
                self.files.extend(phase::tables(system).map(str::to_string));
            }
            if scene.reference.is_some() {
                self.files.push("reference.csv".to_string());
            }
        } else {
            self.skip("tables", "output.tables = false");
        }
        if scene.output.figures {
            match &scene.system {
                System::Phase(system) => self.files.extend(phase::figures(system).map(str::to_string)),
                _ => self.files.push("trajectory.svg".to_string()),
            }
            self.files.push("invariants.svg".to_string());
            if scene.reference.is_some() {
                self.files.push("error.svg".to_string());
            }
        } else {
            self.skip("figures", "output.figures = false");
        }
    }
}

/// The instants that are recorded: samples and the instants of a reference table.
pub(crate) fn timetable(scene: &Scene) -> Timetable {
    let landings: &[f64] = match scene.reference.as_ref().map(|reference| &reference.kind) {
        Some(ReferenceKind::Table(table)) => &table.times,
        _ => &[],
    };
    Timetable::new(scene.time, scene.output.samples, landings)
}

/// Steps of at most `step` that land on every instant.
fn steps(instants: &[f64], step: f64) -> u64 {
    // As the integrators count: an interval that is a whole number of steps but for rounding is not given one more.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count, and the cast saturates")]
    let count = |pair: &[f64]| ((pair[1] - pair[0]).abs() / step * (1.0 - 4.0 * f64::EPSILON)).ceil() as u64;
    instants.windows(2).map(count).fold(0, u64::saturating_add)
}

fn describe(system: &System) -> String {
    let count = |n: usize, what: &str| if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") };
    match system {
        System::Gravitation(system) => {
            let bodies =
                if system.bodies.len() == 1 { "1 body".to_string() } else { format!("{} bodies", system.bodies.len()) };
            format!("{bodies} attracting each other")
        }
        System::Mechanism(system) => {
            let rigid = system.parts.iter().filter(|part| part.rigid).count();
            let mut parts = Vec::new();
            if rigid < system.parts.len() {
                parts.push(count(system.parts.len() - rigid, "particle"));
            }
            if 0 < rigid {
                parts.push(if rigid == 1 { "1 rigid body".to_string() } else { format!("{rigid} rigid bodies") });
            }
            format!("mechanism of {} with {}", parts.join(" and "), count(system.coordinates.len(), "coordinate"))
        }
        System::Phase(system) => format!("Hamiltonian with {}", count(system.freedom(), "degree")) + " of freedom",
        System::Central(system) => {
            let n = system.bodies.len();
            format!("{} about a fixed centre", if n == 1 { "1 body".to_string() } else { format!("{n} bodies") })
        }
    }
}

fn equations(system: &System) -> usize {
    match system {
        System::Gravitation(system) => 6 * system.bodies.len(),
        System::Mechanism(system) => 2 * system.coordinates.len() + mechanism::works(system),
        System::Central(system) => 6 * system.bodies.len(),
        System::Phase(system) => 2 * system.freedom() + usize::from(system.hamiltonian.0.depends_on_time()),
    }
}

/// A length of time to about seven digits.
fn seconds(step: f64) -> String {
    if (1e-3..1e9).contains(&step) { format!("{step:.6}") } else { format!("{step:.6e}") }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}, {} equations of first order", self.name, self.system, self.equations)?;
        write!(f, "time      {} s to {} s", words::number(self.start), words::number(self.end))?;
        writeln!(f, ", recorded at {} instants", self.instants)?;
        write!(f, "method    {}", self.method)?;
        match self.method {
            Method::DormandPrince { tolerance }
            | Method::Verner { tolerance }
            | Method::Nystrom86 { tolerance }
            | Method::Nystrom1210 { tolerance } => {
                writeln!(f, ", relative tolerance {tolerance:e}")?;
            }
            Method::Composition { step, .. } | Method::GaussLegendre { step, .. } => {
                let (step, count) = (seconds(step), self.steps.unwrap_or_default());
                writeln!(f, ", steps of at most {step} s that land on every instant: {count}")?;
            }
            Method::ClosedForm => writeln!(f, ", no steps")?,
        }
        writeln!(f, "          {}", self.reason)?;
        for (heading, items) in [("computed", &self.computed), ("skipped", &self.skipped)] {
            for (index, item) in items.iter().enumerate() {
                writeln!(f, "{:<10}{}: {}", if index == 0 { heading } else { "" }, item.what, item.why)?;
            }
        }
        write!(f, "written   {}: {}", self.folder, self.files.join(", "))
    }
}
