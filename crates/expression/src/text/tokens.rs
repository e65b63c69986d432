//! Words, numbers and signs of an expression.

use piola_document::units::{Dimension, Unit};

use super::ExpressionMistake;

/// A piece of an expression.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    /// A number in SI units, with its dimension where a unit is written.
    Number(f64, Option<Dimension>),
    /// A name: letters, digits, `_` and `.`, with a place in a list as `[0]`; anything else between backquotes.
    Name(String),
    /// One of `+ - * / ^ ( ) ,`.
    Sign(char),
}

impl Token {
    /// The token as a reader knows it.
    pub(super) fn shown(&self) -> String {
        match self {
            Self::Number(number, _) => format!("the number {number}"),
            Self::Name(name) => format!("`{name}`"),
            Self::Sign(sign) => format!("`{sign}`"),
        }
    }
}

/// The pieces of a text.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, ExpressionMistake> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let token;
        (token, rest) = match first {
            '0'..='9' | '.' => number(rest)?,
            '`' => quoted(rest)?,
            c if c.is_alphabetic() || c == '_' => name(rest),
            '−' => (Token::Sign('-'), after(rest, first)),
            '·' | '×' => (Token::Sign('*'), after(rest, first)),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => (Token::Sign(first), after(rest, first)),
            other => {
                let valid = "numbers, names, + - * / ^ and brackets ( ); units stand in [ ] after a number";
                return Err(ExpressionMistake::new(format!("`{other}` cannot stand here"), valid));
            }
        };
        tokens.push(token);
        rest = rest.trim_start();
    }
    Ok(tokens)
}

fn after(text: &str, first: char) -> &str {
    &text[first.len_utf8()..]
}

/// A number, with a unit in brackets or without.
fn number(text: &str) -> Result<(Token, &str), ExpressionMistake> {
    let bytes = text.as_bytes();
    let digits = |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
    let mut end = digits(0);
    if bytes.get(end).is_some_and(|b| matches!(b, b'e' | b'E')) {
        let sign = usize::from(bytes.get(end + 1).is_some_and(|b| matches!(b, b'+' | b'-')));
        let last = digits(end + 1 + sign);
        if end + 1 + sign < last {
            end = last;
        }
    }
    let (written, rest) = text.split_at(end);
    let value: f64 =
        written.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            ExpressionMistake::new(format!("`{written}` is no finite number"), "a number such as 2.5e-3")
        })?;
    let Some(inside) = rest.trim_start().strip_prefix('[') else { return Ok((Token::Number(value, None), rest)) };
    let Some((unit, rest)) = inside.split_once(']') else {
        return Err(ExpressionMistake::new("a unit lacks its `]`", format!("{written} [N m]")));
    };
    let read: Unit = unit
        .parse()
        .map_err(|error| ExpressionMistake::new(format!("[{unit}]: {error}"), "a unit such as [N m] or [1/s]"))?;
    let si = read.to_si(value);
    if !si.is_finite() {
        return Err(ExpressionMistake::new(
            format!("{written} [{unit}] is outside of the range of numbers"),
            "a finite number",
        ));
    }
    Ok((Token::Number(si, Some(read.dimension)), rest))
}

fn quoted(text: &str) -> Result<(Token, &str), ExpressionMistake> {
    match text[1..].split_once('`') {
        Some((name, rest)) => Ok((Token::Name(name.to_string()), rest)),
        None => Err(ExpressionMistake::new("a name lacks its second backquote", "`left arm`")),
    }
}

fn name(text: &str) -> (Token, &str) {
    let word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let mut end = text.find(|c| !word(c)).unwrap_or(text.len());
    // A place in a list belongs to the name.
    if let Some((index, _)) = text[end..].strip_prefix('[').and_then(|inside| inside.split_once(']'))
        && !index.is_empty()
        && index.bytes().all(|b| b.is_ascii_digit())
    {
        end += index.len() + 2;
    }
    (Token::Name(text[..end].to_string()), &text[end..])
}
