//! What the readers of robots' files share: text, elements and numbers with their lines, inertias, pictures.

#[cfg(all(feature = "urdf", feature = "mjcf"))]
mod robot;
mod visual;

#[cfg(all(feature = "urdf", feature = "mjcf"))]
pub use robot::RobotFile;
pub use visual::{Visual, VisualShape};

use std::io::Read as _;
use std::path::Path;

use nalgebra::Matrix3;
use piola_kinematics::{Attitude, KinematicsError};
use roxmltree::{Document, Node};

use crate::error::{FileFault, MultibodyError};
use crate::tree::BodyInertia;

pub(crate) type Element<'a> = Node<'a, 'a>;

/// Bytes of a file at most: 16 MiB.
const LONGEST: u64 = 1 << 24;

/// What to do with an inertia of a file that is physically impossible.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FileInertias {
    /// They are refused: a mass that is not positive, a matrix that is not positive definite or violates the triangle
    /// inequality.
    #[default]
    Checked,
    /// They are used as given, zero masses too: see [`BodyInertia::as_given`].
    AsGiven,
}

impl FileInertias {
    pub(crate) fn body(
        self,
        mass: f64,
        centre: [f64; 3],
        about_centre: [[f64; 3]; 3],
    ) -> Result<BodyInertia, KinematicsError> {
        match self {
            Self::Checked => BodyInertia::new(mass, centre, about_centre),
            Self::AsGiven => BodyInertia::as_given(mass, centre, about_centre),
        }
    }
}

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String, MultibodyError> {
    let refused = |reason: String| MultibodyError::UnreadableFile { path: path.display().to_string(), reason };
    let unread = |error: std::io::Error| refused(error.to_string());
    // Before it is opened: to open a pipe waits for a writer.
    if !std::fs::metadata(path).map_err(unread)?.is_file() {
        return Err(refused("it is not a regular file".to_owned()));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes)).map_err(unread)?;
    if LONGEST < bytes.len() as u64 {
        return Err(MultibodyError::FileTooLong { path: path.display().to_string(), limit: LONGEST });
    }
    String::from_utf8(bytes).map_err(|error| refused(error.to_string()))
}

pub(crate) fn document(text: &str) -> Result<Document<'_>, MultibodyError> {
    Document::parse(text).map_err(|error| MultibodyError::InFile {
        line: error.pos().row as usize,
        fault: FileFault::Syntax { reason: error.to_string() },
    })
}

pub(crate) fn line_of(element: Element<'_>) -> usize {
    element.document().text_pos_at(element.range().start).row as usize
}

pub(crate) fn fault(element: Element<'_>, fault: FileFault) -> MultibodyError {
    MultibodyError::InFile { line: line_of(element), fault }
}

/// A body whose inertia is physically impossible, at its line.
pub(crate) fn invalid_inertia(element: Element<'_>, body: &str, source: KinematicsError) -> MultibodyError {
    let wrong = MultibodyError::InvalidInertia { body: body.to_owned(), source };
    fault(element, FileFault::Invalid { source: Box::new(wrong) })
}

/// An element that names something that does not exist.
pub(crate) fn no_such_name(element: Element<'_>, what: &'static str, name: &str) -> MultibodyError {
    let source = Box::new(MultibodyError::NoSuchName { what, name: name.to_owned() });
    fault(element, FileFault::Invalid { source })
}

pub(crate) fn elements(of: Element<'_>) -> impl DoubleEndedIterator<Item = Element<'_>> {
    of.children().filter(Node::is_element)
}

#[cfg(feature = "urdf")]
pub(crate) fn find<'a>(of: Element<'a>, name: &str) -> Option<Element<'a>> {
    elements(of).find(|element| element.tag_name().name() == name)
}

pub(crate) fn missing(element: Element<'_>, what: &'static str) -> MultibodyError {
    fault(element, FileFault::Missing { what, element: element.tag_name().name().to_owned() })
}

/// An element in another that must have it.
#[cfg(feature = "urdf")]
pub(crate) fn required<'a>(of: Element<'a>, name: &'static str) -> Result<Element<'a>, MultibodyError> {
    find(of, name).ok_or_else(|| missing(of, name))
}

#[cfg(feature = "urdf")]
pub(crate) fn attribute<'a>(element: Element<'a>, name: &'static str) -> Result<&'a str, MultibodyError> {
    element.attribute(name).ok_or_else(|| missing(element, name))
}

/// A finite number, or what stands for it where it is missing.
#[cfg(feature = "urdf")]
pub(crate) fn number(element: Element<'_>, name: &'static str, default: Option<f64>) -> Result<f64, MultibodyError> {
    match (element.attribute(name), default) {
        (None, Some(default)) => Ok(default),
        _ => Ok(numbers::<1>(element, name, attribute(element, name)?)?[0]),
    }
}

#[cfg(feature = "urdf")]
pub(crate) fn vector(element: Element<'_>, name: &'static str, default: [f64; 3]) -> Result<[f64; 3], MultibodyError> {
    element.attribute(name).map_or(Ok(default), |text| numbers(element, name, text))
}

/// As many finite numbers as are needed.
pub(crate) fn numbers<const N: usize>(
    element: Element<'_>,
    attribute: &'static str,
    text: &str,
) -> Result<[f64; N], MultibodyError> {
    match numbers_up_to(element, attribute, text)? {
        (values, count) if count == N => Ok(values),
        _ => Err(fault(element, FileFault::NotNumbers { attribute, text: text.to_owned() })),
    }
}

/// At most N finite numbers, and how many they are. The others are zero.
pub(crate) fn numbers_up_to<const N: usize>(
    element: Element<'_>,
    attribute: &'static str,
    text: &str,
) -> Result<([f64; N], usize), MultibodyError> {
    let mut out = [0.0; N];
    let mut count = 0;
    for word in text.split_whitespace() {
        match (out.get_mut(count), word.parse::<f64>()) {
            (Some(out), Ok(value)) if value.is_finite() => *out = value,
            _ => return Err(fault(element, FileFault::NotNumbers { attribute, text: text.to_owned() })),
        }
        count += 1;
    }
    Ok((out, count))
}

/// R I Rᵀ by rows, for an inertia in axes that are turned against those of a body.
pub(crate) fn turned(attitude: Attitude<f64>, inertia: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let turn = attitude.to_matrix().transpose();
    let turned = turn * Matrix3::from(inertia) * turn.transpose();
    ((turned + turned.transpose()) * 0.5).into()
}
