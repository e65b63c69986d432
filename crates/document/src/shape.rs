//! Checks the tree against the declared keys and makes records of it.

use crate::include::FORMAT;
use crate::record::{Field, FieldValue, Parameter};
use crate::schema::{Absent, Key, Kind, Range, Table};
use crate::units::{Dimension, Quantity, UnitError, VectorQuantity};
use crate::{Document, Entry, Mistake, Node, Place, Record, Source, Value, words};

impl Document {
    /// The values that the keys of `root` declare, and every mistake: those of syntax and those against the keys.
    ///
    /// Each value is in SI units and keeps its place. [`Report`](crate::Report) shows the mistakes.
    #[must_use]
    pub fn records(&self, root: &'static Table) -> (Record, Vec<Mistake>) {
        records(self, root)
    }
}

/// The record of a whole document, and every mistake in its shape.
fn records(document: &Document, root: &'static Table) -> (Record, Vec<Mistake>) {
    let mut mistakes = document.mistakes().to_vec();
    let newer = formats(document, root);
    let damaged = !newer.is_empty() || mistakes.iter().any(|mistake| mistake.syntax);
    let mut reader = Reader { root, sources: document.sources(), mistakes: Vec::new(), damaged };
    let record = reader.table(root, document.root(), false);
    if let Some(key) = root.key(FORMAT) {
        for node in document.formats() {
            reader.value(key, node);
        }
    }
    if !newer.is_empty() {
        // What else is wrong here may be right in the newer format.
        mistakes.extend(newer);
        return (record, mistakes);
    }
    // What a syntax error damaged is not reported a second time as a wrong value.
    let lines: Vec<(usize, usize)> =
        mistakes.iter().filter(|mistake| mistake.syntax).map(|mistake| line_of(document, &mistake.place)).collect();
    reader.mistakes.retain(|mistake| !lines.contains(&line_of(document, &mistake.place)));
    mistakes.append(&mut reader.mistakes);
    (record, mistakes)
}

/// The versions of the format, of the document and of the files that it includes, which are newer than the declared one.
fn formats(document: &Document, root: &Table) -> Vec<Mistake> {
    let Some(Key { kind: Kind::Count { most, .. }, .. }) = root.key(FORMAT) else { return Vec::new() };
    let all = document.root().get(FORMAT).into_iter().chain(document.formats());
    let newer =
        all.filter(|node| matches!(node.value, Value::Number { value, whole: true } if f64::from(*most) < value));
    newer
        .map(|node| {
            let found = format!("this program reads format {most}: a newer Piola is needed");
            Mistake { syntax: true, ..Mistake::new(node.place.clone(), found) }
        })
        .collect()
}

fn line_of(document: &Document, place: &Place) -> (usize, usize) {
    (place.source, document.sources().get(place.source).map_or(0, |source| source.position(place.span.start).0))
}

struct Reader<'a> {
    /// The table of the whole document.
    root: &'static Table,
    /// The texts of the document.
    sources: &'a [Source],
    mistakes: Vec<Mistake>,
    /// Whether parts of the text could not be parsed: then nothing is reported as missing.
    damaged: bool,
}

impl Reader<'_> {
    fn table(&mut self, table: &'static Table, node: &Node, inner: bool) -> Record {
        let mut record = Record { place: node.place.clone(), ..Record::default() };
        let kind = node.get("type").and_then(|node| match &node.value {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        });
        // A type that is no type is a mistake of its own: any key may go with what it should be.
        let kind = kind.filter(|kind| known(table, Some(kind)));
        let applies = |key: &Key| key.only_for.is_empty() || kind.is_none_or(|kind| key.only_for.contains(&kind));
        for entry in node.entries() {
            let Some(key) = table.key(&entry.key) else {
                self.unknown(table, entry, inner, &applies);
                continue;
            };
            record.written.insert(key.name, entry.place.clone());
            if !applies(key) {
                let names: Vec<&str> = table.keys.iter().filter(|key| applies(key)).map(|key| key.name).collect();
                self.mistakes.push(
                    Mistake::new(
                        entry.place.clone(),
                        format!("`{}` is no key of a {} {}", key.name, kind.unwrap_or("?"), table.name),
                    )
                    .valid(format!(
                        "one of {}; `{}` is of type {}",
                        words::list(&names),
                        key.name,
                        key.only_for.join(", ")
                    )),
                );
                continue;
            }
            if let Some(value) = self.value(key, &entry.node) {
                record.fields.insert(key.name, Field { place: entry.node.place.clone(), value });
            }
        }
        for key in table.keys.iter().filter(|key| applies(key) && !record.written.contains_key(key.name)) {
            match key.absent {
                Absent::Optional => {}
                // A key of some types only is not missed where the type itself is wrong.
                Absent::Required if self.damaged || (!key.only_for.is_empty() && !known(table, kind)) => {}
                Absent::Required => self.missing(table, key, node, inner),
                Absent::Default(text) => {
                    if let Some(value) = default(key, text) {
                        record.fields.insert(key.name, Field { place: node.place.clone(), value });
                    }
                }
            }
        }
        record
    }

    fn missing(&mut self, table: &Table, key: &Key, node: &Node, inner: bool) {
        let what =
            if matches!(key.kind, Kind::Table(_)) { format!("[{}]", key.name) } else { format!("`{}`", key.name) };
        let name =
            node.get("name").and_then(|node| if let Value::Text(name) = &node.value { Some(name) } else { None });
        let of = match name {
            Some(name) if inner => format!("the {} `{name}`", table.name.replace('_', " ")),
            _ if inner => format!("[{}]", table.name),
            _ => format!("the {}", self.root.name),
        };
        self.mistakes.push(Mistake::new(node.place.clone(), format!("{of} lacks {what}")).valid(format!(
            "{} = {}: {}",
            key.name,
            key.kind.describe(),
            key.doc
        )));
    }

    fn unknown(&mut self, table: &Table, entry: &Entry, inner: bool, applies: &dyn Fn(&Key) -> bool) {
        let names = || table.keys.iter().filter(|key| applies(key)).map(|key| key.name);
        let of = if inner { format!(" in [{}]", table.name) } else { String::new() };
        let shown: String = entry.key.chars().take(60).collect();
        let mut mistake = Mistake::new(entry.place.clone(), format!("unknown key `{shown}`{of}"));
        // A key of another table, put before its header or after a wrong one, is the commonest slip.
        let home = self.root.keys.iter().find_map(|outer| match outer.kind {
            Kind::Table(other) | Kind::Tables(other) if other.name != table.name => other.key(&entry.key).map(|_| {
                if matches!(outer.kind, Kind::Table(_)) {
                    format!("[{}]", other.name)
                } else {
                    format!("[[{}]]", other.name)
                }
            }),
            _ => None,
        });
        mistake = match (words::nearest(&entry.key, names()), home) {
            (None, Some(home)) => mistake
                .valid(format!("it belongs in {home}; here one of {}", words::list(&names().collect::<Vec<_>>()))),
            _ => mistake.valid(words::one_of(&entry.key, names())),
        };
        self.mistakes.push(mistake);
    }

    fn parameter(&mut self, key: &Key, entry: &Entry) -> Option<Parameter> {
        let shown: String = entry.key.chars().take(60).collect();
        let word = |c: char| c.is_alphanumeric() || c == '_';
        if !entry.key.chars().all(word) || entry.key.chars().next().is_none_or(|c| c.is_ascii_digit()) {
            self.mistakes.push(
                Mistake::new(entry.place.clone(), format!("`{shown}` is no name of a parameter"))
                    .valid("letters, digits and `_`, not a digit first"),
            );
            return None;
        }
        match measured(&entry.node) {
            Ok((value, dimension)) => {
                Some(Parameter { name: entry.key.clone(), place: entry.place.clone(), value, dimension })
            }
            Err(wrong) => {
                let place = wrong.place.unwrap_or_else(|| entry.node.place.clone());
                let valid = wrong.valid.unwrap_or_else(|| "a number, or a text with a unit, as \"2 N/m\"".to_string());
                self.mistakes
                    .push(Mistake::new(place, format!("`{shown}` in [{}] is {}", key.name, wrong.found)).valid(valid));
                None
            }
        }
    }

    fn value(&mut self, key: &Key, node: &Node) -> Option<FieldValue> {
        match (&key.kind, &node.value) {
            (Kind::Table(table), Value::Table(_)) => Some(FieldValue::Record(self.table(table, node, true))),
            (Kind::Tables(table), Value::List(items))
                if items.iter().all(|item| matches!(item.value, Value::Table(_))) =>
            {
                Some(FieldValue::Records(items.iter().map(|item| self.table(table, item, true)).collect()))
            }
            (Kind::Parameters, Value::Table(entries)) => {
                let parameters: Vec<Option<Parameter>> =
                    entries.iter().map(|entry| self.parameter(key, entry)).collect();
                Some(FieldValue::Parameters(parameters.into_iter().collect::<Option<_>>()?))
            }
            _ => match value(&key.kind, node) {
                // A path of an included file is relative to that file.
                Ok(FieldValue::Text(text)) if matches!(key.kind, Kind::Path) => {
                    Some(FieldValue::Text(match self.sources.get(node.place.source) {
                        Some(source) => source.path(text),
                        None => text,
                    }))
                }
                Ok(value) => Some(value),
                Err(wrong) => {
                    self.mistakes.push(
                        Mistake::new(
                            wrong.place.unwrap_or_else(|| node.place.clone()),
                            format!("`{}` is {}", key.name, wrong.found),
                        )
                        .valid(wrong.valid.unwrap_or_else(|| key.kind.describe())),
                    );
                    None
                }
            },
        }
    }
}

/// A number in SI units with the dimension of its unit.
fn measured(node: &Node) -> Result<(f64, Dimension), Wrong> {
    let dimension = match &node.value {
        Value::Text(text) => {
            let quantity: Quantity = text.parse().map_err(|error| unreadable(text, &error))?;
            quantity.dimension().unwrap_or(Dimension::NONE)
        }
        _ => Dimension::NONE,
    };
    Ok((number(dimension, node)?, dimension))
}

/// Whether `kind` is one of the values that the table's `type` may have.
fn known(table: &Table, kind: Option<&str>) -> bool {
    let Some(Key { kind: Kind::Choice(choices), .. }) = table.key("type") else { return false };
    kind.is_some_and(|kind| choices.iter().any(|word| word.name == kind))
}

/// A wrong value: what was found there, and what would be valid when that is more than the kind.
struct Wrong {
    place: Option<Place>,
    found: String,
    valid: Option<String>,
}

impl Wrong {
    fn found(found: impl Into<String>) -> Self {
        Self { place: None, found: found.into(), valid: None }
    }
}

fn value(kind: &Kind, node: &Node) -> Result<FieldValue, Wrong> {
    match (kind, &node.value) {
        (Kind::Name, Value::Text(text)) if is_name(text) => Ok(FieldValue::Text(text.clone())),
        (Kind::Text, Value::Text(text)) => Ok(FieldValue::Text(text.clone())),
        (Kind::Path, Value::Text(text)) if !text.trim().is_empty() => Ok(FieldValue::Text(text.clone())),
        (Kind::Texts, Value::List(items)) => {
            let texts = items.iter().map(|item| match &item.value {
                Value::Text(text) => Ok(text.clone()),
                other => Err(Wrong {
                    place: Some(item.place.clone()),
                    ..Wrong::found(format!("a list with {}", other.describe()))
                }),
            });
            Ok(FieldValue::Texts(texts.collect::<Result<_, _>>()?))
        }
        (Kind::Flag, Value::Flag(flag)) => Ok(FieldValue::Flag(*flag)),
        (Kind::Choice(choices), Value::Text(text)) => {
            if choices.iter().any(|word| word.name == text) {
                return Ok(FieldValue::Text(text.clone()));
            }
            let names = choices.iter().map(|word| word.name);
            Err(Wrong { valid: Some(words::one_of(text, names)), ..Wrong::found(node.value.describe()) })
        }
        (Kind::Count { least, most }, Value::Number { value, whole: true })
            if f64::from(*least) <= *value && *value <= f64::from(*most) =>
        {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number within the range of u32"
            )]
            Ok(FieldValue::Count(*value as u32))
        }
        (Kind::Quantity(dimension, range), _) => {
            let number = number(*dimension, node)?;
            if range.contains(number) {
                Ok(FieldValue::Number(number))
            } else {
                Err(Wrong::found(out_of_range(*range, node, number)))
            }
        }
        (Kind::Numbers(dimension, counts), _) => {
            let numbers = numbers(*dimension, node)?;
            if counts.contains(&numbers.len()) {
                Ok(FieldValue::Numbers(numbers))
            } else {
                Err(Wrong::found(format!("a list of {}", numbers.len())))
            }
        }
        (_, other) => Err(Wrong::found(other.describe())),
    }
}

fn out_of_range(range: Range, node: &Node, number: f64) -> String {
    let written = node.value.describe();
    match range {
        Range::Positive | Range::NotNegative if number < 0.0 => format!("negative: {written}"),
        _ => written,
    }
}

/// A number in SI units.
fn number(dimension: Dimension, node: &Node) -> Result<f64, Wrong> {
    match &node.value {
        Value::Number { value, .. } if value.is_finite() => Ok(*value),
        Value::Number { value, .. } => Err(Wrong::found(not_finite(*value))),
        Value::Text(text) => {
            let quantity: Quantity = text.parse().map_err(|error| unreadable(text, &error))?;
            check_dimension(dimension, quantity.dimension(), text)?;
            quantity.to_si().map_err(|error| unreadable(text, &error))
        }
        other => Err(Wrong::found(other.describe())),
    }
}

/// Numbers in SI units.
fn numbers(dimension: Dimension, node: &Node) -> Result<Vec<f64>, Wrong> {
    match &node.value {
        Value::List(items) => items
            .iter()
            .map(|item| number(dimension, item).map_err(|wrong| Wrong { place: Some(item.place.clone()), ..wrong }))
            .collect(),
        Value::Text(text) => {
            let vector: VectorQuantity = text.parse().map_err(|error| unreadable(text, &error))?;
            check_dimension(dimension, vector.unit.as_ref().map(|(unit, _)| unit.dimension), text)?;
            vector.to_si().map_err(|error| unreadable(text, &error))
        }
        other => Err(Wrong::found(other.describe())),
    }
}

fn check_dimension(expected: Dimension, found: Option<Dimension>, text: &str) -> Result<(), Wrong> {
    match found {
        Some(found) if found != expected => {
            let valid = if expected == Dimension::NONE {
                "a pure number, without a unit".to_string()
            } else {
                format!("{expected}, for example in {}", expected.si_unit())
            };
            Err(Wrong {
                valid: Some(valid),
                ..Wrong::found(format!("\"{text}\", which has the dimension {found} instead of {expected}"))
            })
        }
        None if expected != Dimension::NONE => Err(Wrong {
            valid: Some(format!(
                "a number, which is in {unit}, or a text with a unit, as \"{text} {unit}\"",
                unit = expected.si_unit()
            )),
            ..Wrong::found(format!("\"{text}\", a text without a unit"))
        }),
        _ => Ok(()),
    }
}

fn unreadable(text: &str, error: &UnitError) -> Wrong {
    let valid = match error {
        UnitError::UnknownUnit { nearest: Some(name), .. } => Some(format!("did you mean `{name}`?")),
        UnitError::NotFinite { .. } => Some("a finite number".to_string()),
        _ => None,
    };
    let shown: String = text.chars().take(60).collect();
    Wrong { valid, ..Wrong::found(format!("\"{shown}\": {error}")) }
}

fn not_finite(value: f64) -> String {
    if value.is_nan() { "nan, not a number".to_string() } else { format!("{value}, not finite") }
}

fn is_name(text: &str) -> bool {
    let valid = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
    text.chars().count() <= 64
        && text.chars().all(valid)
        && text.chars().next().is_some_and(|c| c.is_alphanumeric() || c == '_')
        && !text.ends_with(' ')
}

/// A declared default, read by the same rules as a written value.
fn default(key: &Key, text: &str) -> Option<FieldValue> {
    let document = Document::parse("default", &format!("value = {text}"));
    value(&key.kind, document.root().get("value")?).ok()
}
