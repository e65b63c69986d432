//! The elements of a figure in SVG, for tests of what is drawn.

use core::fmt::Debug;
use core::str::FromStr;

/// An element, with its attributes and the text in it.
///
/// # Example
/// ```
/// let drawn = piola_testkit::svg::elements("<svg><circle cx=\"3\" r=\"1\"/><text x=\"2\">mass</text></svg>");
/// assert_eq!((drawn[1].tag(), drawn[1].number("cx")), ("circle", 3.0));
/// assert_eq!((drawn[2].text(), drawn[2].get("y")), ("mass", ""));
/// ```
#[derive(Clone, Debug)]
pub struct Element {
    tag: String,
    attributes: String,
    text: String,
}

/// All elements, in the order in which they are drawn.
#[must_use]
pub fn elements(svg: &str) -> Vec<Element> {
    let element = |piece: &str| {
        let (head, text) = piece.split_once('>').unwrap_or((piece, ""));
        let (tag, attributes) = head.trim_end_matches('/').split_once(' ').unwrap_or((head, ""));
        Element { tag: tag.to_owned(), attributes: format!(" {attributes}"), text: text.trim().to_owned() }
    };
    svg.split('<').skip(1).filter(|piece| !piece.starts_with('/')).map(element).collect()
}

impl Element {
    /// What it is, such as `circle`.
    #[must_use]
    pub fn tag(&self) -> &str {
        &self.tag
    }

    /// The text that it holds.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// An attribute as text; empty where there is none.
    #[must_use]
    pub fn get(&self, name: &str) -> &str {
        let key = format!(" {name}=\"");
        let from = self.attributes.find(&key).map(|at| &self.attributes[at + key.len()..]);
        from.and_then(|rest| rest.split('"').next()).unwrap_or("")
    }

    /// An attribute as a number.
    ///
    /// # Panics
    /// The element has no such attribute, or it is no number.
    #[must_use]
    pub fn number<N: FromStr<Err: Debug>>(&self, name: &str) -> N {
        self.get(name).parse().unwrap_or_else(|error| panic!("{name} of {self:?}: {error:?}"))
    }

    /// The points of a curve or polygon.
    ///
    /// # Panics
    /// A coordinate is no number.
    #[must_use]
    pub fn points(&self) -> Vec<[f64; 2]> {
        let number = |text: &str| -> f64 { text.parse().unwrap_or_else(|error| panic!("{text}: {error}")) };
        let pairs = self.get("points").split_whitespace().filter_map(|pair| pair.split_once(','));
        pairs.map(|(x, y)| [number(x), number(y)]).collect()
    }
}
