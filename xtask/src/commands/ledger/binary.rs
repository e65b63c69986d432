//! The sources of one test binary, cut into definitions: which function, type, constant or macro names what.
//!
//! Text is read here, not Rust: a name stands for everything in the binary that has it, the same file first.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use crate::source::code_only;
use crate::workspace::read;

/// Something with a name, and the words and signs of its code.
#[derive(Debug)]
pub(super) struct Definition {
    /// Where it stands, such as `laws::stress`.
    module: Vec<String>,
    pub(super) name: String,
    /// The type or trait around a function.
    pub(super) owner: Option<String>,
    pub(super) kind: Kind,
    pub(super) code: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Function,
    /// A function of a type or a trait.
    Method,
    Trait,
    Macro,
    /// The use of a macro outside every function, which may define what it is given the name of.
    MacroUse,
    /// A type, what it implements of a trait, a constant.
    Other,
}

impl Definition {
    /// True if it may stand for the name at `at` in `code`.
    fn is_named(&self, code: &[String], at: usize) -> bool {
        let is_call = is_called(code, at);
        match self.kind {
            Kind::Function => is_call && !is_of_value(code, at),
            Kind::Method => is_call && (is_of_value(code, at) || follows(code, at, "::")),
            Kind::Macro => code.get(at + 1).is_some_and(|next| next == "!"),
            Kind::MacroUse | Kind::Trait | Kind::Other => !is_of_value(code, at),
        }
    }
}

/// True if the name at `at` is called, or named with parameters of type.
pub(super) fn is_called(code: &[String], at: usize) -> bool {
    code.get(at + 1).is_some_and(|next| next == "(" || next == "::")
}

/// True if the name at `at` is that of a field or a method of a value.
pub(super) fn is_of_value(code: &[String], at: usize) -> bool {
    // Two dots are a range.
    follows(code, at, ".") && !(1 < at && code[at - 2] == ".")
}

/// True if `sign` stands right before `at`.
pub(super) fn follows(code: &[String], at: usize, sign: &str) -> bool {
    0 < at && code[at - 1] == sign
}

/// Every definition of a test binary.
#[derive(Default)]
pub(super) struct Binary {
    definitions: Vec<Definition>,
    by_name: HashMap<String, Vec<usize>>,
}

impl Binary {
    /// The binary of a folder: every file in it, and those that its files take by `#[path]`.
    pub(super) fn of_folder(folder: &Path) -> Result<Self, String> {
        let mut binary = Self::default();
        binary.add_folder(folder, &[])?;
        Ok(binary)
    }

    fn add_folder(&mut self, folder: &Path, module: &[String]) -> Result<(), String> {
        let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        for entry in entries {
            let path = entry.map_err(|error| error.to_string())?.path();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let mut inner = module.to_vec();
            if !matches!(&*stem, "main" | "mod") {
                inner.push(stem);
            }
            if path.is_dir() {
                self.add_folder(&path, &inner)?;
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = read(&path)?;
                self.add_text(&text, &inner);
                for (name, elsewhere) in modules_elsewhere(&text, folder) {
                    self.add_text(&read(&elsewhere)?, &[&inner[..], &[name]].concat());
                }
            }
        }
        Ok(())
    }

    /// The text of a file that is this module.
    pub(super) fn add_text(&mut self, text: &str, module: &[String]) {
        let mut found = Vec::new();
        define(&tokens(&code_only(text)), module, None, &mut found);
        for definition in found {
            let at = self.definitions.len();
            if definition.kind == Kind::MacroUse {
                let words: HashSet<&String> = definition.code.iter().filter(|token| is_word(token)).collect();
                for word in words {
                    self.by_name.entry(word.clone()).or_default().push(at);
                }
            } else {
                self.by_name.entry(definition.name.clone()).or_default().push(at);
            }
            self.definitions.push(definition);
        }
    }

    /// Every definition.
    pub(super) fn definitions(&self) -> &[Definition] {
        &self.definitions
    }

    /// The test of this path, and all that it may run in its binary; nothing if there is no such test.
    pub(super) fn reach(&self, test: &str) -> Vec<&Definition> {
        let path: Vec<&str> = test.split("::").collect();
        let Some((name, module)) = path.split_last() else { return Vec::new() };
        let named = self.by_name.get(*name).map_or(&[][..], Vec::as_slice);
        let stands_there = |at: &&usize| {
            let found = &self.definitions[**at];
            matches!(found.kind, Kind::Function | Kind::MacroUse) && found.module == module
        };
        let mut waiting: Vec<usize> = named.iter().filter(stands_there).copied().collect();
        let mut seen: HashSet<usize> = waiting.iter().copied().collect();
        let mut reached = Vec::new();
        while let Some(at) = waiting.pop() {
            reached.push(&self.definitions[at]);
            waiting.extend(self.named_by(&self.definitions[at]).filter(|next| seen.insert(*next)));
        }
        reached
    }

    fn named_by<'a>(&'a self, by: &'a Definition) -> impl Iterator<Item = usize> + 'a {
        by.code.iter().enumerate().flat_map(|(at, word)| {
            let named = self.by_name.get(word).map_or(&[][..], Vec::as_slice);
            let fitting: Vec<usize> =
                named.iter().copied().filter(|found| self.definitions[*found].is_named(&by.code, at)).collect();
            let is_near = |found: &usize| self.definitions[*found].module == by.module;
            let some_near = fitting.iter().any(is_near);
            fitting.into_iter().filter(move |found| !some_near || is_near(found))
        })
    }
}

/// The modules that a file takes from another place, by name.
fn modules_elsewhere(text: &str, folder: &Path) -> Vec<(String, PathBuf)> {
    let of = |piece: &str| {
        let (path, rest) = piece.split_once('"')?;
        let name = rest.split_once("mod ")?.1.split(';').next()?;
        Some((name.to_owned(), folder.join(path)))
    };
    text.split("#[path = \"").skip(1).filter_map(of).collect()
}

/// Words, `::`, and every other sign by itself.
fn tokens(code: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut in_word = false;
    for sign in code.chars() {
        let is_part = sign.is_alphanumeric() || sign == '_';
        match tokens.last_mut() {
            Some(last) if is_part && in_word => last.push(sign),
            Some(last) if sign == ':' && last == ":" => last.push(sign),
            _ if sign.is_whitespace() => {}
            _ => tokens.push(sign.into()),
        }
        in_word = is_part;
    }
    tokens
}

fn is_word(token: &str) -> bool {
    token.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

/// What the items of `code` define; `owner` is the type or trait around them.
fn define(code: &[String], module: &[String], owner: Option<&str>, found: &mut Vec<Definition>) {
    let mut at = 0;
    while at < code.len() {
        let end = at + end_of_item(&code[at..]);
        let name = code.get(at + 1).filter(|name| is_word(name));
        let mut add = |name: &str, kind| {
            let (module, owner, code) = (module.to_vec(), owner.map(str::to_owned), code[at..end].to_vec());
            found.push(Definition { module, name: name.into(), owner, kind, code });
        };
        match (code[at].as_str(), name) {
            ("fn", Some(name)) => add(name, if owner.is_some() { Kind::Method } else { Kind::Function }),
            ("struct" | "enum" | "type" | "const" | "static", Some(name)) if name != "fn" => {
                add(name, Kind::Other);
            }
            ("trait", Some(name)) => {
                add(name, Kind::Trait);
                define(inside(&code[at..end]), module, Some(name), found);
            }
            ("impl", _) => {
                let (of, of_trait) = implementor(&code[at..end]);
                if of_trait {
                    add(&of, Kind::Other);
                }
                define(inside(&code[at..end]), module, Some(&of), found);
            }
            ("mod", Some(name)) => {
                define(inside(&code[at..end]), &[module, std::slice::from_ref(name)].concat(), None, found);
            }
            ("macro_rules", _) if code.get(at + 1).is_some_and(|next| next == "!") => {
                if let Some(name) = code.get(at + 2) {
                    add(name, Kind::Macro);
                }
            }
            (word, _) if is_word(word) && code.get(at + 1).is_some_and(|next| next == "!") => {
                let content = inside(&code[at..end]);
                if content.iter().any(|token| token == "fn") {
                    define(content, module, owner, found);
                } else {
                    add("", Kind::MacroUse);
                }
            }
            // Attributes, visibility, imports: a word further.
            ("use", _) => {}
            _ => {
                at += 1;
                continue;
            }
        }
        at = end;
    }
}

/// Behind the braces of an item, or behind its semicolon if that comes first.
fn end_of_item(code: &[String]) -> usize {
    let mut depth = 0_usize;
    let is_call = code.get(1).is_some_and(|next| next == "!");
    for (at, token) in code.iter().enumerate() {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" if depth <= 1 => return at + 1,
            ")" if depth <= 1 && is_call => return at + 1,
            "}" | ")" | "]" => depth = depth.saturating_sub(1),
            ";" if depth == 0 => return at + 1,
            _ => {}
        }
    }
    code.len()
}

/// What stands within the outer braces or parentheses.
fn inside(item: &[String]) -> &[String] {
    let is_call = item.get(1).is_some_and(|next| next == "!");
    let opens = |token: &String| token == "{" || (is_call && token == "(");
    match item.iter().position(opens) {
        Some(start) if start + 1 < item.len() => &item[start + 1..item.len() - 1],
        _ => &[],
    }
}

/// The name of the type that an `impl` is for, and whether it implements a trait.
fn implementor(item: &[String]) -> (String, bool) {
    let head = &item[..item.iter().position(|token| token == "{").unwrap_or(item.len())];
    let head = &head[..head.iter().position(|token| token == "where").unwrap_or(head.len())];
    let of_trait = head.iter().rposition(|token| token == "for");
    let mut depth = 0_usize;
    let mut name = String::new();
    for token in &head[of_trait.map_or(1, |at| at + 1)..] {
        match token.as_str() {
            "<" => depth += 1,
            ">" => depth = depth.saturating_sub(1),
            _ if depth == 0 && is_word(token) => name.clone_from(token),
            _ => {}
        }
    }
    (name, of_trait.is_some())
}
