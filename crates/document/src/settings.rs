//! `--set path=value`: edits of the tree before its meaning is checked.

use crate::{Entry, Mistake, Node, Place, Source, Value, parse, words};

/// A boxed mistake, since it is far larger than what is returned when all is well.
fn wrong<T>(mistake: Mistake) -> Result<T, Box<Mistake>> {
    Err(Box::new(mistake))
}

/// One step of a path.
pub(crate) enum Step {
    /// `.key`, or the name of an entry of a list.
    Key(String, Place),
    /// `[i]`.
    Index(usize, Place),
}

/// Applies the setting that `source` holds.
pub(crate) fn apply(root: &mut Node, source: &Source, id: usize) -> Result<(), Box<Mistake>> {
    let text = source.text.as_str();
    let Some((path, value)) = text.split_once('=') else {
        return wrong(
            Mistake::new(Place { source: id, span: 0..text.len() }, "a setting without `=`")
                .valid("path=value, for example `time.end=10 d`"),
        );
    };
    let offset = path.len() + 1;
    let steps = steps(path, id)?;
    let trimmed = value.trim();
    let start = offset + (value.len() - value.trim_start().len());
    let place = Place { source: id, span: start..start + trimmed.len() };
    if trimmed.is_empty() {
        return wrong(
            Mistake::new(Place { source: id, span: 0..text.len() }, "a setting without a value")
                .valid("path=value, for example `time.end=10 d`"),
        );
    }
    // What is not TOML is a text: `10 d`, `composition-8`, `[1, 2, 3] km`.
    let node = parse::value(trimmed, id, start)
        .unwrap_or_else(|| Node { place: place.clone(), value: Value::Text(trimmed.to_string()) });
    place_node(root, &steps, Node { place, value: node.value })
}

pub(crate) fn steps(path: &str, id: usize) -> Result<Vec<Step>, Box<Mistake>> {
    let bad =
        |span: core::ops::Range<usize>, what: &str| {
            wrong(Mistake::new(Place { source: id, span }, what.to_string()).valid(
                "keys with dots between, `[i]` or a name for an entry of a list: `body[3].mass`, `body.earth.mass`",
            ))
        };
    let mut steps = Vec::new();
    let mut at = 0;
    for part in path.split('.') {
        let (key, mut rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        let lead = key.len() - key.trim_start().len();
        let key_span = at + lead..at + lead + key.trim().len();
        if key.trim().is_empty() {
            return bad(at..at + part.len().max(1), "a path with an empty key");
        }
        steps.push(Step::Key(key.trim().to_string(), Place { source: id, span: key_span }));
        let mut inner = at + key.len();
        while let Some(index) = rest.strip_prefix('[') {
            let Some((digits, after)) = index.split_once(']') else {
                return bad(inner..at + part.len(), "`[` without `]`");
            };
            let span = inner..inner + digits.len() + 2;
            let Ok(number) = digits.trim().parse() else {
                return bad(span, "an index that is not a whole number from 0");
            };
            steps.push(Step::Index(number, Place { source: id, span: span.clone() }));
            inner = span.end;
            rest = after;
        }
        if !rest.trim().is_empty() {
            return bad(inner..at + part.len(), "text after `]`");
        }
        at += part.len() + 1;
    }
    Ok(steps)
}

fn place_node(node: &mut Node, steps: &[Step], new: Node) -> Result<(), Box<Mistake>> {
    let Some((step, rest)) = steps.split_first() else {
        *node = new;
        return Ok(());
    };
    match (step, &mut node.value) {
        (Step::Key(key, place), Value::Table(entries)) => {
            let index = if let Some(index) = entries.iter().position(|entry| entry.key == *key) {
                // The mistake, if the value makes one, is the argument's: the key is shown there too.
                if rest.is_empty() {
                    entries[index].place = place.clone();
                }
                index
            } else {
                let value = Value::Table(Vec::new());
                let node = Node { place: place.clone(), value };
                entries.push(Entry { key: key.clone(), place: place.clone(), node });
                entries.len() - 1
            };
            place_node(&mut entries[index].node, rest, new)
        }
        (Step::Key(name, place), Value::List(items)) => {
            let names: Vec<String> = items.iter().filter_map(name_of).collect();
            match items.iter_mut().find(|item| name_of(item).as_ref() == Some(name)) {
                Some(item) => place_node(item, rest, new),
                None => wrong(
                    Mistake::new(place.clone(), format!("no entry of the list is named `{name}`"))
                        .valid(words::one_of(name, names.iter().map(String::as_str))),
                ),
            }
        }
        (Step::Index(index, place), Value::List(items)) => {
            let count = items.len();
            match items.get_mut(*index) {
                Some(item) => place_node(item, rest, new),
                None => wrong(Mistake::new(place.clone(), format!("entry {index} of a list of {count}")).valid(
                    if count == 0 { "no entry: the list is empty".to_string() } else { format!("0 to {}", count - 1) },
                )),
            }
        }
        (Step::Key(_, place) | Step::Index(_, place), other) => {
            let what = other.describe();
            wrong(
                Mistake::new(place.clone(), format!("the path goes on, but here stands {what}"))
                    .valid("a path that ends at this value"),
            )
        }
    }
}

fn name_of(node: &Node) -> Option<String> {
    match &node.get("name")?.value {
        Value::Text(name) => Some(name.clone()),
        _ => None,
    }
}
