//! Elements with the defaults of their classes.

use crate::error::{FileFault, MultibodyError};
use crate::files::{Element, elements, fault, missing, no_such_name, numbers, numbers_up_to};

pub(super) fn unsupported(element: Element<'_>) -> MultibodyError {
    fault(element, FileFault::Unsupported { element: element.tag_name().name().to_owned() })
}

/// A class of defaults.
struct Class<'a> {
    name: &'a str,
    element: Element<'a>,
    parent: Option<usize>,
}

/// All classes of a file.
#[derive(Default)]
pub(super) struct Classes<'a> {
    classes: Vec<Class<'a>>,
    main: Option<usize>,
}

impl<'a> Classes<'a> {
    /// Adds a `default` at the top with all that it holds.
    pub(super) fn add(&mut self, top: Element<'a>) -> Result<(), MultibodyError> {
        let first = self.classes.len();
        let name = top.attribute("class").unwrap_or("main");
        // A second `default` at the top goes on with the first.
        self.classes.push(Class { name, element: top, parent: self.main });
        self.main = Some(first);
        let mut next = first;
        while next < self.classes.len() {
            let element = self.classes[next].element;
            for inner in elements(element).filter(|inner| inner.tag_name().name() == "default") {
                let name = inner.attribute("class").ok_or_else(|| missing(inner, "class"))?;
                if self.classes.iter().any(|class| class.name == name) {
                    let source = Box::new(MultibodyError::DuplicateName { what: "classes", name: name.to_owned() });
                    return Err(fault(inner, FileFault::Invalid { source }));
                }
                self.classes.push(Class { name, element: inner, parent: Some(next) });
            }
            next += 1;
        }
        Ok(())
    }

    /// An element with its defaults, of its own class or else of the one that its body gives.
    pub(super) fn styled(
        &self,
        element: Element<'a>,
        class: Option<&'a str>,
        kinds: &[&str],
    ) -> Result<Styled<'a>, MultibodyError> {
        let mut next = self.main;
        if let Some(name) = element.attribute("class").or(class) {
            next = self.classes.iter().rposition(|class| class.name == name);
            if next.is_none() && name != "main" {
                return Err(no_such_name(element, "class", name));
            }
        }
        let mut layers = vec![element];
        while let Some(index) = next {
            let class = &self.classes[index];
            let defaults: Vec<_> = elements(class.element).collect();
            layers.extend(defaults.into_iter().rev().filter(|inner| kinds.contains(&inner.tag_name().name())));
            next = class.parent;
        }
        Ok(Styled { layers })
    }
}

/// An element, and the defaults for it, the nearest first.
pub(super) struct Styled<'a> {
    layers: Vec<Element<'a>>,
}

impl<'a> Styled<'a> {
    /// An element that has no class.
    pub(super) fn plain(element: Element<'a>) -> Self {
        Self { layers: vec![element] }
    }

    pub(super) fn element(&self) -> Element<'a> {
        self.layers[0]
    }

    /// Refuses attributes that are not among the known ones.
    pub(super) fn check(&self, known: &[&str]) -> Result<(), MultibodyError> {
        for &layer in &self.layers {
            let of = layer.tag_name().name();
            if let Some(wrong) = layer.attributes().find(|attribute| !known.contains(&attribute.name())) {
                let element = format!("attribute {} of {of}", wrong.name());
                return Err(fault(layer, FileFault::Unsupported { element }));
            }
        }
        Ok(())
    }

    /// Refuses attributes that have other values than the one without effect.
    pub(super) fn check_idle(&self, idle: &[(&'static str, &[&str])]) -> Result<(), MultibodyError> {
        for &(name, values) in idle {
            let Some((text, layer)) = self.text(name) else { continue };
            let is_zero = values.contains(&"0") && text.split_whitespace().all(|word| word.parse() == Ok(0.0));
            if !is_zero && !values.contains(&text.trim()) {
                let of = layer.tag_name().name();
                let element = format!("{name}=\"{text}\" of {of}");
                return Err(fault(layer, FileFault::Unsupported { element }));
            }
        }
        Ok(())
    }

    /// The text of an attribute with the element that has it.
    pub(super) fn text(&self, name: &str) -> Option<(&'a str, Element<'a>)> {
        self.layers.iter().find_map(|layer| layer.attribute(name).map(|text| (text, *layer)))
    }

    /// The first layer that has one of some attributes, and those that it has.
    pub(super) fn first_with(&self, names: &[&'static str]) -> Option<(Element<'a>, Vec<&'static str>)> {
        self.layers.iter().find_map(|layer| {
            let found: Vec<_> = names.iter().copied().filter(|name| layer.has_attribute(*name)).collect();
            (!found.is_empty()).then_some((*layer, found))
        })
    }

    pub(super) fn required(&self, name: &'static str) -> Result<&'a str, MultibodyError> {
        self.text(name).map(|(text, _)| text).ok_or_else(|| missing(self.element(), name))
    }

    pub(super) fn numbers<const N: usize>(&self, name: &'static str) -> Result<Option<[f64; N]>, MultibodyError> {
        self.text(name).map(|(text, layer)| numbers(layer, name, text)).transpose()
    }

    /// At most N numbers, zeros behind them, and how many there are.
    pub(super) fn numbers_up_to<const N: usize>(
        &self,
        name: &'static str,
    ) -> Result<([f64; N], usize), MultibodyError> {
        self.text(name).map_or(Ok(([0.0; N], 0)), |(text, layer)| numbers_up_to(layer, name, text))
    }

    pub(super) fn number(&self, name: &'static str, default: f64) -> Result<f64, MultibodyError> {
        Ok(self.numbers::<1>(name)?.map_or(default, |[number]| number))
    }

    /// A number that must not be negative.
    pub(super) fn not_negative(&self, name: &'static str, default: f64) -> Result<f64, MultibodyError> {
        let value = self.number(name, default)?;
        if value < 0.0 {
            return Err(self.fault(name, FileFault::Negative { attribute: name, value }));
        }
        Ok(value)
    }

    /// true, false, or nothing for `auto` and where it is missing.
    pub(super) fn flag(&self, name: &'static str) -> Result<Option<bool>, MultibodyError> {
        match self.text(name) {
            None | Some(("auto", _)) => Ok(None),
            Some(("true", _)) => Ok(Some(true)),
            Some(("false", _)) => Ok(Some(false)),
            Some((text, _)) => Err(self.no_such_word(name, text, "true, false or auto")),
        }
    }

    pub(super) fn no_such_word(&self, attribute: &'static str, text: &str, valid: &'static str) -> MultibodyError {
        self.fault(attribute, FileFault::NoSuchWord { attribute, text: text.to_owned(), valid })
    }

    /// A fault at the line that has the attribute.
    pub(super) fn fault(&self, attribute: &str, wrong: FileFault) -> MultibodyError {
        fault(self.text(attribute).map_or(self.element(), |(_, layer)| layer), wrong)
    }

    /// A range that is in force: that of an attribute, as its flag says it.
    pub(super) fn range(
        &self,
        name: &'static str,
        flag: &'static str,
        automatic: bool,
    ) -> Result<Option<[f64; 2]>, MultibodyError> {
        let range = self.numbers::<2>(name)?;
        let is_limited = match (self.flag(flag)?, range) {
            (Some(is_limited), _) => is_limited,
            (None, Some([low, high])) if automatic => low < high,
            (None, Some([low, high])) if low.abs() + high.abs() != 0.0 => {
                return Err(missing(self.element(), flag));
            }
            (None, _) => false,
        };
        if !is_limited {
            return Ok(None);
        }
        let Some([low, high]) = range else { return Err(missing(self.element(), name)) };
        if high <= low {
            let wrong = FileFault::OutOfRange { attribute: name, value: low, condition: "first < second" };
            return Err(self.fault(name, wrong));
        }
        Ok(Some([low, high]))
    }
}
