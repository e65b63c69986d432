//! Studies from checked records.

use super::{Study, Subject};
use crate::model::{self, Builder};
use crate::schema::{SCENE_KINDS, SceneKind};
use piola_document::Record;

/// Tables that only scenes with a motion have.
const OF_MOTIONS: [&str; 3] = ["time", "integrator", "reference"];

impl Study {
    /// The kind, if the record is of one study.
    pub(crate) fn kind(record: &Record) -> Option<&'static SceneKind> {
        let mut written = SCENE_KINDS.iter().filter(|kind| record.has(kind.name));
        let kind = written.next()?;
        (kind.study && written.next().is_none()).then_some(kind)
    }
}

impl Builder<'_> {
    /// The study; parts that cannot be built have mistakes of their own.
    pub(crate) fn study(&mut self, record: &Record) -> Option<Study> {
        let kind = self.kind(record)?;
        let (is_box, is_robot) = (kind.name == "box", kind.name == "robot");
        for key in OF_MOTIONS.into_iter().filter(|key| record.has(key) && !(is_robot && *key != "reference")) {
            let valid = if is_box && key == "time" {
                "`duration` in a [box] of the type motion or flow"
            } else {
                "nothing: this is a study, without a motion in time"
            };
            self.refuse(record.place_of(key), format!("[{key}] in a scene of [{}]", kind.name), valid);
        }
        if let Some(output) = record.record("output").filter(|output| output.has("samples") && !is_robot) {
            let valid = if is_box {
                "`interval` in a [box] of the type motion"
            } else {
                "nothing: there are no instants to record"
            };
            self.refuse(output.place_of("samples"), format!("`samples` in a scene of [{}]", kind.name), valid);
        }
        self.has_reactions(record);
        let name = record.text("name").map_or_else(|| self.file_stem(), str::to_string);
        let output = model::output(record, &name);
        let table = record.record(kind.name)?;
        let subject = match kind.name {
            "room" => Subject::Room(self.room(table)?),
            "box" => self.fields_on_a_box(record, table)?,
            "robot" => self.robot_study(record, table, output.samples)?,
            "wavefront" => Subject::Wavefront(self.wavefront(record, table)?),
            _ => self.solid(record, table, kind.name)?,
        };
        Some(Study { name, title: record.text("title").map(str::to_string), subject, output })
    }

    #[cfg(feature = "spectral")]
    fn fields_on_a_box(&mut self, scene: &Record, table: &Record) -> Option<Subject> {
        self.box_study(scene, table).map(|study| Subject::Box(Box::new(study)))
    }

    #[cfg(not(feature = "spectral"))]
    fn fields_on_a_box(&mut self, scene: &Record, _table: &Record) -> Option<Subject> {
        self.lacks_feature(scene, "box", "spectral")
    }

    #[cfg(feature = "robots")]
    fn robot_study(&mut self, scene: &Record, table: &Record, samples: u32) -> Option<Subject> {
        self.robot(scene, table, samples).map(|robot| Subject::Robot(Box::new(robot)))
    }

    #[cfg(not(feature = "robots"))]
    fn robot_study(&mut self, scene: &Record, _table: &Record, _samples: u32) -> Option<Subject> {
        self.lacks_feature(scene, "robot", "robots")
    }

    #[cfg(not(feature = "solutions"))]
    fn solid(&mut self, scene: &Record, _table: &Record, name: &str) -> Option<Subject> {
        self.lacks_feature(scene, name, "solutions")
    }

    /// Says that this program has no studies of the kind `name`.
    #[cfg(not(all(feature = "solutions", feature = "spectral", feature = "robots")))]
    fn lacks_feature(&mut self, scene: &Record, name: &str, feature: &str) -> Option<Subject> {
        self.refused(
            scene.place_of(name),
            format!("a scene of [{name}] needs the feature `{feature}`, which this program was built without"),
            format!("a program built with it: `cargo build --release --features {feature}`"),
        )
    }
}
