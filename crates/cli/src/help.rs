//! Help texts in lines of at most 80 columns. Clap's own wrapping would bring a crate for the size of terminals.

use std::io::{IsTerminal as _, Write as _};

use clap::error::{Error, ErrorKind};

/// Columns of a line.
const WIDTH: usize = 80;

/// Prints what clap has to say: help to standard output, mistakes to standard error.
pub(crate) fn print(error: &Error) -> std::io::Result<()> {
    if error.kind() != ErrorKind::DisplayHelp {
        return error.print();
    }
    let (text, mut out) = (error.render(), std::io::stdout().lock());
    let is_coloured = out.is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let text = if is_coloured { text.ansi().to_string() } else { text.to_string() };
    out.write_all(wrapped(&text).as_bytes())?;
    out.flush()
}

/// The same text with long lines broken between words; what follows stands below the beginning.
fn wrapped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let indent = line.len() - line.trim_start().len();
        let mut column = 0;
        for word in line.trim().split(' ') {
            let width = columns(word);
            if column == 0 {
                out.push_str(&line[..indent]);
                column = indent + width;
            } else if column + 1 + width <= WIDTH {
                out.push(' ');
                column += 1 + width;
            } else {
                out.push('\n');
                out.push_str(&line[..indent]);
                column = indent + width;
            }
            out.push_str(word);
        }
        out.push('\n');
    }
    out
}

/// Visible characters: what starts with ESC and ends with a letter only sets a style.
fn columns(word: &str) -> usize {
    let (mut count, mut is_style) = (0, false);
    for c in word.chars() {
        match c {
            '\u{1b}' => is_style = true,
            c if is_style => is_style = !c.is_ascii_alphabetic(),
            _ => count += 1,
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn long_lines_are_broken_below_their_beginning_and_styles_have_no_width() {
        let word = "\u{1b}[1mabcdefghi\u{1b}[0m";
        let line = format!("    {}\n", [word; 9].join(" "));
        let expected = format!("    {}\n    {}\n", [word; 7].join(" "), [word; 2].join(" "));
        assert_eq!(wrapped(&line), expected);
        assert_eq!(wrapped("short  as it is\n\nend\n"), "short  as it is\n\nend\n");
    }
}
