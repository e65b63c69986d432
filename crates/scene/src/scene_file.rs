//! A scene file of either sort.

use std::path::Path;

use piola_document::{Document, Record};

use crate::model::Builder;
use crate::schema::SCENE;
use crate::{Scene, SceneError, Study};

/// A checked scene file: a motion or a study.
#[derive(Debug, Clone)]
pub enum SceneFile {
    /// A motion in time.
    Motion(Box<Scene>),
    /// A study.
    Study(Study),
}

impl SceneFile {
    /// Reads a scene file, applies settings of the form `path=value`, and checks the result.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] with all mistakes; other variants when there is no text to check.
    pub fn load(path: &Path, settings: &[String]) -> Result<Self, SceneError> {
        Self::from_document(&Document::read_with(path, settings)?)
    }

    /// Checks a document and builds what it holds.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] with every mistake found.
    ///
    /// # Example
    /// ```
    /// use piola_scene::{Document, SceneFile};
    /// let document = Document::parse("fronts.toml", "
    ///     [wavefront]
    ///     type = 'point'
    ///     length = 1.0
    ///     [[medium]]
    ///     type = 'uniform'
    /// ");
    /// assert!(matches!(SceneFile::from_document(&document)?, SceneFile::Study(_)));
    /// # Ok::<(), piola_scene::SceneError>(())
    /// ```
    pub fn from_document(document: &Document) -> Result<Self, SceneError> {
        let (record, mistakes) = document.records(&SCENE);
        let mut builder = Builder::new(document, mistakes);
        let built = built(&mut builder, &record);
        builder.finish(built)
    }
}

/// The scene of a record.
pub(crate) fn built(builder: &mut Builder<'_>, record: &Record) -> Option<SceneFile> {
    // One that has no kind, or several, is answered as a motion is.
    if Study::kind(record).is_some() {
        builder.study(record).map(SceneFile::Study)
    } else {
        builder.scene(record).map(|scene| SceneFile::Motion(Box::new(scene)))
    }
}
