//! An ensemble: a scene and what differs between its members.

use piola_scene::run::TOGETHER;
use piola_scene::{Document, SceneFile, VariedScene};

use crate::member::{Member, columns, compute, compute_together, may_go_together};
use crate::{EnsembleError, Random, ValueRange};

/// The largest number of members.
pub const MOST_MEMBERS: u64 = 100_000_000;

/// A scene, and what differs between its members.
///
/// Members are all combinations of the [ranges](ValueRange), the last range changing fastest, each combination `repeats` times with
/// other [random](Random) values.
///
/// # Example
/// ```
/// use piola_ensemble::Ensemble;
/// use piola_scene::Document;
/// let scene = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     revolutions = 1
/// ");
/// let ensemble = Ensemble::new(scene, vec!["body.comet.eccentricity=0:0.8:5".parse()?], Vec::new(), 1, 0)?;
/// assert_eq!(ensemble.members(), 5);
/// let member = ensemble.member(4);
/// let x = ensemble.columns().iter().position(|name| name == "comet x (m)").expect("there");
/// assert!((member.values[x] - 0.2).abs() < 1e-9); // at its perihelion again
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ensemble {
    scene: Document,
    ranges: Vec<ValueRange>,
    random: Vec<Random>,
    repeats: u64,
    seed: u64,
    columns: Vec<String>,
    /// The scene, read once; none if a varied value is not a quantity.
    varied: Option<VariedScene>,
    together: bool,
}

impl Ensemble {
    /// Of a scene.
    ///
    /// # Errors
    /// [`EnsembleError::TooMany`] beyond [`MOST_MEMBERS`]; [`EnsembleError::Argument`] for a value that is varied twice, or repeats
    /// without random values; [`EnsembleError::Invalid`] when the first member is not a scene.
    pub fn new(
        scene: Document,
        ranges: Vec<ValueRange>,
        random: Vec<Random>,
        repeats: u64,
        seed: u64,
    ) -> Result<Self, EnsembleError> {
        let paths: Vec<&String> =
            ranges.iter().map(|range| &range.path).chain(random.iter().map(|random| &random.path)).collect();
        if let Some(twice) = paths.iter().enumerate().find_map(|(i, path)| paths[..i].contains(path).then_some(path)) {
            return Err(EnsembleError::Argument { argument: (*twice).clone(), valid: "each value once" });
        }
        if random.is_empty() && repeats != 1 {
            let argument = format!("{repeats} members of each combination");
            return Err(EnsembleError::Argument { argument, valid: "one, unless a value is random" });
        }
        let members = ranges.iter().fold(repeats as f64, |product, range| product * range.count as f64);
        if members < 1.0 || (MOST_MEMBERS as f64) < members {
            return Err(EnsembleError::TooMany { members, most: MOST_MEMBERS });
        }
        let mut ensemble =
            Self { scene, ranges, random, repeats, seed, columns: Vec::new(), varied: None, together: false };
        let first =
            ensemble.scene(0).map_err(|error| EnsembleError::Invalid { member: 0, cause: error.to_string() })?;
        ensemble.columns = columns(&first);
        ensemble.together = may_go_together(&first);
        let ranges = ensemble.ranges.iter().map(|range| (range.path.as_str(), range.unit.as_str()));
        let random = ensemble.random.iter().map(|random| (random.path.as_str(), random.unit.as_str()));
        let paths: Vec<_> = ranges.chain(random).collect();
        ensemble.varied = VariedScene::new(ensemble.document(0), &paths);
        Ok(ensemble)
    }

    /// The number of members.
    #[must_use]
    pub fn members(&self) -> u64 {
        self.ranges.iter().fold(self.repeats, |product, range| product * range.count)
    }

    /// The names of the varied values, with their units, as `joint.elbow.angle (deg)`.
    #[must_use]
    pub fn varied(&self) -> Vec<String> {
        let named =
            |path: &String, unit: &String| if unit.is_empty() { path.clone() } else { format!("{path} ({unit})") };
        let ranges = self.ranges.iter().map(|range| named(&range.path, &range.unit));
        ranges.chain(self.random.iter().map(|random| named(&random.path, &random.unit))).collect()
    }

    /// The names of the quantities that a member keeps.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The varied values of a member, in the order of [`varied`](Self::varied).
    #[must_use]
    pub fn settings(&self, member: u64) -> Vec<f64> {
        let indices = self.indices(member);
        let ranges = self.ranges.iter().zip(&indices).map(|(range, &index)| range.value(index));
        let random = self.random.iter().zip(0..).map(|(random, which)| random.value(self.seed, which, member));
        ranges.chain(random).collect()
    }

    /// The place of a member in each range; the last changes fastest.
    fn indices(&self, member: u64) -> Vec<u64> {
        let mut rest = member / self.repeats;
        let mut indices = vec![0; self.ranges.len()];
        for (index, range) in indices.iter_mut().zip(&self.ranges).rev() {
            *index = rest % range.count;
            rest /= range.count;
        }
        indices
    }

    /// The scene of a member.
    ///
    /// # Errors
    /// [`EnsembleError::Scene`] with the mistakes of the scene.
    pub fn scene(&self, member: u64) -> Result<SceneFile, EnsembleError> {
        match self.varied.as_ref().and_then(|varied| varied.scene(&self.settings(member))) {
            Some(scene) => Ok(scene),
            None => Ok(SceneFile::from_document(&self.document(member))?),
        }
    }

    /// The document of a member.
    fn document(&self, member: u64) -> Document {
        let mut document = self.scene.clone();
        for (range, index) in self.ranges.iter().zip(self.indices(member)) {
            document.set(&range.setting(index));
        }
        for (random, which) in self.random.iter().zip(0..) {
            document.set(&random.setting(self.seed, which, member));
        }
        document
    }

    /// Computes a member.
    #[must_use]
    pub fn member(&self, member: u64) -> Member {
        self.member_until(member, || false).unwrap_or_else(|| Member::failed(member, "stopped", self.columns.len()))
    }

    /// Computes a member unless `stop` says so before its end; then there is none.
    #[must_use]
    pub fn member_until(&self, member: u64, stop: impl Fn() -> bool) -> Option<Member> {
        match self.scene(member) {
            Ok(scene) => compute(member, &scene, &self.columns, &stop),
            Err(error) => Some(Member::failed(member, &error.to_string(), self.columns.len())),
        }
    }

    /// How many members are best computed [together](Self::together): 1 unless they are bodies that attract each other, by a method of fixed
    /// steps.
    #[must_use]
    pub const fn at_once(&self) -> usize {
        if self.together { TOGETHER } else { 1 }
    }

    /// Computes members until `stop` says so; members that are not finished then are none. Groups of [`at_once`](Self::at_once) members that
    /// take the same steps are integrated together, each in a lane of a vector of numbers. A member's numbers are those of
    /// [`member`](Self::member), to the last bit.
    ///
    /// # Example
    /// ```
    /// use piola_ensemble::Ensemble;
    /// use piola_scene::Document;
    /// let scene = Document::parse("pair.toml", "
    ///     [gravity]
    ///     [[body]]
    ///     name = 'right'
    ///     gm = 1.0
    ///     position = [1, 0, 0]
    ///     velocity = [0, 0.5, 0]
    ///     [[body]]
    ///     name = 'left'
    ///     gm = 1.0
    ///     position = [-1, 0, 0]
    ///     velocity = [0, -0.5, 0]
    ///     [time]
    ///     end = 6.0
    ///     [integrator]
    ///     method = 'composition-8'
    ///     step = 0.1
    /// ");
    /// let ensemble = Ensemble::new(scene, vec!["body.left.velocity[1]=-0.5:-0.4:6".parse()?], Vec::new(), 1, 0)?;
    /// let together = ensemble.together(&[0, 1, 2, 3, 4, 5], || false);
    /// assert_eq!((ensemble.at_once(), together[5].as_ref()), (8, Some(&ensemble.member(5))));
    /// # Ok::<(), piola_ensemble::EnsembleError>(())
    /// ```
    #[must_use]
    pub fn together(&self, members: &[u64], stop: impl Fn() -> bool) -> Vec<Option<Member>> {
        let of = |chunk: &[u64]| -> Vec<Option<Member>> {
            let alone = || chunk.iter().map(|&member| if stop() { None } else { self.member_until(member, &stop) });
            if !self.together || chunk.len() < 2 {
                return alone().collect();
            }
            let scene = |&member: &u64| self.scene(member).ok().map(|scene| (member, scene));
            let scenes: Option<Vec<(u64, SceneFile)>> = chunk.iter().map(scene).collect();
            let found = scenes.and_then(|scenes| compute_together(&scenes, &self.columns, &stop));
            found.map_or_else(|| alone().collect(), |found| found.into_iter().map(Some).collect())
        };
        members.chunks(self.at_once()).flat_map(of).collect()
    }

    /// The scene, the variations, the seed and the version as a text of one line: equal ensembles have equal texts.
    #[must_use]
    pub fn identity(&self) -> String {
        let texts: Vec<&str> = self.scene.sources().iter().map(|source| source.text.as_str()).collect();
        serde_json::json!({
            "ensemble": 1,
            "version": env!("CARGO_PKG_VERSION"),
            "scene": texts,
            "ranges": self.ranges,
            "random": self.random,
            "repeats": self.repeats,
            "seed": self.seed,
        })
        .to_string()
    }

    /// Whether a member may be one of this ensemble.
    pub(crate) fn has(&self, member: &Member) -> bool {
        member.member < self.members() && member.values.len() == self.columns.len()
    }

    pub(crate) fn name(&self) -> &str {
        self.scene.name()
    }
}
