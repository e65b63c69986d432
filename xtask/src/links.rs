//! Relative links in Markdown: the file must exist, and the heading too where the link names one.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::workspace::{Workspace, read};

/// Checks every relative link of every Markdown file; the number of links, or one problem for each broken one.
pub(crate) fn check(workspace: &Workspace) -> Result<usize, Vec<String>> {
    let mut anchors: HashMap<PathBuf, Vec<String>> = HashMap::new();
    let (mut count, mut problems) = (0, Vec::new());
    for path in workspace.files() {
        if path.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let text = match read(&path) {
            Ok(text) => text,
            Err(problem) => {
                problems.push(problem);
                continue;
            }
        };
        for (line, target) in links(&text) {
            if target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            count += 1;
            if let Err(what) = resolve(&path, &target, &mut anchors) {
                problems.push(format!("{}:{line}: `{target}`: {what}", workspace.relative(&path)));
            }
        }
    }
    if problems.is_empty() { Ok(count) } else { Err(problems) }
}

fn resolve(from: &Path, target: &str, anchors: &mut HashMap<PathBuf, Vec<String>>) -> Result<(), String> {
    let (file, anchor) = target.split_once('#').map_or((target, None), |(file, anchor)| (file, Some(anchor)));
    let folder = from.parent().unwrap_or(Path::new(""));
    let file = if file.is_empty() { from.to_path_buf() } else { folder.join(file) };
    if !file.exists() {
        return Err("no such file".into());
    }
    let Some(anchor) = anchor else { return Ok(()) };
    if file.extension().is_none_or(|extension| extension != "md") {
        return Ok(());
    }
    if !anchors.contains_key(&file) {
        anchors.insert(file.clone(), headings(&read(&file)?));
    }
    if anchors[&file].iter().any(|heading| heading == anchor) { Ok(()) } else { Err("no such heading".into()) }
}

/// The targets of `[text](target)`, `[label]: target` and `src="target"`, with line numbers; code is skipped.
fn links(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in prose(text) {
        let line = without_code_spans(line);
        for (start, _) in line.match_indices("](") {
            let rest = &line[start + 2..];
            if let Some(target) = rest.split([')', ' ']).next() {
                found.push((number, target.trim_matches(['<', '>']).to_owned()));
            }
        }
        if let Some((label, target)) = line.trim_start().split_once("]: ")
            && label.starts_with('[')
        {
            found.push((number, target.trim().to_owned()));
        }
        for attribute in ["src=\"", "href=\""] {
            for (start, _) in line.match_indices(attribute) {
                let target = line[start + attribute.len()..].split('"').next().unwrap_or_default();
                found.push((number, target.to_owned()));
            }
        }
    }
    found.retain(|(_, target)| !target.is_empty());
    found
}

/// The anchors that the usual renderers make of the headings: lower case, punctuation dropped, blanks to hyphens, and
/// a counter where a heading comes again.
fn headings(text: &str) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let mut anchors = Vec::new();
    for (_, line) in prose(text) {
        let level = line.chars().take_while(|&c| c == '#').count();
        if !(1..=6).contains(&level) || !line[level..].starts_with(' ') {
            continue;
        }
        let anchor: String = line[level..]
            .trim()
            .to_lowercase()
            .chars()
            .filter_map(|c| match c {
                ' ' => Some('-'),
                c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
                _ => None,
            })
            .collect();
        let times = seen.entry(anchor.clone()).or_default();
        anchors.push(if *times == 0 { anchor } else { format!("{anchor}-{times}") });
        *times += 1;
    }
    anchors
}

/// The lines outside fenced code, numbered from one.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fence: Option<&str> = None;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let start = line.trim_start();
        let opens = ["````", "```", "~~~"].into_iter().find(|mark| start.starts_with(mark));
        match (fence, opens) {
            (None, Some(mark)) => {
                fence = Some(mark);
                None
            }
            (Some(mark), _) => {
                if start.starts_with(mark) {
                    fence = None;
                }
                None
            }
            (None, None) => Some((index + 1, line)),
        }
    })
}

fn without_code_spans(line: &str) -> String {
    // Even pieces between backticks are prose. The text of a link may be code, its target never is.
    line.split('`').enumerate().map(|(index, piece)| if index % 2 == 0 { piece } else { "" }).collect()
}

#[cfg(test)]
mod tests {
    use super::{headings, links};

    #[test]
    fn links_are_found_in_prose_only() {
        let text = "See [a](b.md#c), ![d](e.svg \"t\") and `[f](g)`.\n```text\n[h](i)\n```\n[label]: j.md\n[`k`](l.md)";
        let targets: Vec<_> = links(text).into_iter().map(|(line, target)| format!("{line}:{target}")).collect();
        assert_eq!(targets, ["1:b.md#c", "1:e.svg", "5:j.md", "6:l.md"]);
    }

    #[test]
    fn headings_become_anchors() {
        assert_eq!(headings("# What is `Real`?\n## A–B, c\n## A–B, c"), ["what-is-real", "ab-c", "ab-c-1"]);
    }
}
