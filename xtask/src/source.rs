//! Just enough understanding of Rust text for the tidy rules: what is code, what is a comment, a string or a test.

/// The code of `text` with comments, strings and character literals blanked out; lines keep their numbers.
pub(crate) fn code_only(text: &str) -> String {
    let source: Vec<char> = text.chars().collect();
    let mut code = String::with_capacity(text.len());
    let mut at = 0;
    while at < source.len() {
        let end = match source[at] {
            '/' if source.get(at + 1) == Some(&'/') => end_of_line(&source, at),
            '/' if source.get(at + 1) == Some(&'*') => end_of_block_comment(&source, at),
            '"' => end_of_string(&source, at),
            'r' if starts_raw_string(&source, at) => end_of_raw_string(&source, at),
            '\'' => end_of_character(&source, at),
            _ => {
                code.push(source[at]);
                at += 1;
                continue;
            }
        };
        code.extend(source[at..end].iter().map(|&c| if c == '\n' { '\n' } else { ' ' }));
        at = end;
    }
    code
}

/// The same with every item under `#[cfg(test)]` blanked out too.
pub(crate) fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut rest = code;
    let mut kept = String::with_capacity(code.len());
    while let Some(start) = rest.find(MARK) {
        kept.push_str(&rest[..start]);
        let end = start + end_of_item(&rest[start..]);
        kept.extend(rest[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        rest = &rest[end..];
    }
    kept.push_str(rest);
    kept
}

/// Where the item that starts here ends: at its closing brace, or at a semicolon before any brace.
fn end_of_item(code: &str) -> usize {
    let mut depth = 0_usize;
    for (at, c) in code.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth <= 1 => return at + 1,
            '}' => depth -= 1,
            ';' if depth == 0 => return at + 1,
            _ => {}
        }
    }
    code.len()
}

fn end_of_line(source: &[char], at: usize) -> usize {
    source[at..].iter().position(|&c| c == '\n').map_or(source.len(), |length| at + length)
}

fn end_of_block_comment(source: &[char], start: usize) -> usize {
    let (mut at, mut depth) = (start, 0_usize);
    while at < source.len() {
        match (source[at], source.get(at + 1)) {
            ('/', Some('*')) => (at, depth) = (at + 2, depth + 1),
            ('*', Some('/')) => (at, depth) = (at + 2, depth - 1),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    source.len()
}

fn end_of_string(source: &[char], start: usize) -> usize {
    let mut at = start + 1;
    while at < source.len() {
        match source[at] {
            '\\' => at += 2,
            '"' => return at + 1,
            _ => at += 1,
        }
    }
    source.len()
}

fn starts_raw_string(source: &[char], at: usize) -> bool {
    let in_a_word = 0 < at && (source[at - 1].is_alphanumeric() || source[at - 1] == '_') && source[at - 1] != 'b';
    let hashes = source[at + 1..].iter().take_while(|&&c| c == '#').count();
    !in_a_word && source.get(at + 1 + hashes) == Some(&'"')
}

fn end_of_raw_string(source: &[char], start: usize) -> usize {
    let hashes = source[start + 1..].iter().take_while(|&&c| c == '#').count();
    let mut at = start + hashes + 2;
    while at < source.len() {
        let closes = source[at] == '"' && source[at + 1..].iter().take(hashes).filter(|&&c| c == '#').count() == hashes;
        at += 1;
        if closes {
            return (at + hashes).min(source.len());
        }
    }
    source.len()
}

/// A character literal ends at its second quote; a lifetime is only its own quote.
fn end_of_character(source: &[char], start: usize) -> usize {
    match (source.get(start + 1), source.get(start + 2)) {
        (Some('\\'), _) => {
            let closing = source[start + 3..].iter().position(|&c| c == '\'');
            closing.map_or(source.len(), |length| start + 3 + length + 1)
        }
        (Some(_), Some('\'')) => start + 3,
        _ => start + 1,
    }
}

#[cfg(test)]
mod tests {
    use super::{code_only, without_tests};

    #[test]
    fn comments_strings_and_characters_are_not_code() {
        let text =
            "let a = \"x.unwrap()\"; // y.unwrap()\nlet b = '\\''; let c: &'a str = r#\"\"q\"\"#; /* /* */ z */ d";
        let code = code_only(text);
        assert!(!code.contains("unwrap"));
        assert!(!code.contains('q') && !code.contains('z'));
        assert!(code.contains("let c: & a str") && code.ends_with('d'));
        assert_eq!(code.lines().count(), text.lines().count());
    }

    #[test]
    fn test_modules_are_not_library_code() {
        let code = "fn a() {}\n#[cfg(test)]\nmod tests { fn b() { c.unwrap() } }\nfn d() {}\n#[cfg(test)]\nmod more;\nfn e() {}";
        let kept = without_tests(code);
        assert!(kept.contains("fn a") && kept.contains("fn d") && kept.contains("fn e"));
        assert!(!kept.contains("unwrap") && !kept.contains("more"));
        assert_eq!(kept.lines().count(), code.lines().count());
    }
}
