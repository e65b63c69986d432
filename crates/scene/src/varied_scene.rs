//! A scene of which some numbers differ from run to run.

use piola_document::{Document, Varied};

use crate::SceneFile;
use crate::model::{Builder, Kept};
use crate::scene_file::built;
use crate::schema::SCENE;

/// A scene that is parsed once, and built again with other numbers at some paths.
///
/// The scenes are those of [`SceneFile::from_document`] after settings with the same numbers, to the last bit. The file of a reference is
/// read once.
///
/// # Example
/// ```
/// use piola_scene::{Document, SceneFile, VariedScene};
/// let mut document = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     revolutions = 1
/// ");
/// document.set("body.comet.semi_major_axis=1.0");
/// let varied = VariedScene::new(document, &[("body.comet.semi_major_axis", "")]).expect("a valid number");
/// let Some(SceneFile::Motion(scene)) = varied.scene(&[4.0]) else { panic!() };
/// assert!((scene.time.end - 16.0 * std::f64::consts::PI).abs() < 1e-12); // the third law
/// assert!(varied.scene(&[-1.0]).is_none());
/// ```
#[derive(Debug, Clone)]
pub struct VariedScene {
    document: Document,
    varied: Varied,
    kept: Kept,
}

impl VariedScene {
    /// Of a document with a number at each path, and the unit of the other numbers there.
    ///
    /// Nothing where the document has mistakes of its shape, or a path leads to something else than a quantity: then
    /// [`Document::set`] and [`SceneFile::from_document`] make the scenes, or tell the mistakes.
    #[must_use]
    pub fn new(document: Document, paths: &[(&str, &str)]) -> Option<Self> {
        let varied = document.varied(&SCENE, paths)?;
        Some(Self { document, varied, kept: Kept::default() })
    }

    /// The scene with other numbers, in the order and the units of the paths.
    ///
    /// Nothing where the numbers make a mistake: [`Document::set`] and [`SceneFile::from_document`] tell it.
    #[must_use]
    pub fn scene(&self, numbers: &[f64]) -> Option<SceneFile> {
        let record = self.varied.record(numbers)?;
        let mut builder = Builder::new(&self.document, Vec::new()).keeping(&self.kept);
        let built = built(&mut builder, &record);
        builder.finish(built).ok()
    }
}
