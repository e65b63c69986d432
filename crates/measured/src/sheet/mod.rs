//! Tables as instruments and spreadsheets write them, before anything is known of their contents.
//!
//! ```text
//! # radius: 25 mm            comments and lines above the header: `key: value` or `key = value`
//! Shear rate [1/s];Stress [Pa]     the header: the first line with names that are known
//! 0,1;3,4                    rows; with semicolons or tabs between the fields, decimals may have commas
//! ```
//! Byte-order marks, line ends of all systems, blank lines, comments and a line of units below the header are read.

mod columns;
mod heading;
mod spelling;
mod text;

pub(crate) use columns::{NumberColumn, valid_units};
pub(crate) use heading::{Heading, plain};
pub use spelling::spelled;
pub(crate) use spelling::{units_of, unknown};
pub use text::read;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::fitting::TableMistake;

/// Lines in which a header is looked for.
const HEAD: usize = 200;
/// Separators between fields, the rarest in plain text first.
const SEPARATORS: [u8; 3] = [b'\t', b';', b','];

/// A key with its value, of a comment or of a line above the header.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setting {
    pub(crate) line: u64,
    /// In small letters with blanks: `inner radius`.
    pub(crate) key: String,
    pub(crate) value: String,
}

/// A row of a table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Row {
    pub(crate) line: u64,
    pub(crate) fields: StringRecord,
}

/// The parts of a table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sheet {
    pub(crate) settings: Vec<Setting>,
    pub(crate) header_line: u64,
    pub(crate) headings: Vec<Heading>,
    pub(crate) rows: Vec<Row>,
    /// The last line of the file.
    pub(crate) last: u64,
    separator: u8,
    decimal_comma: bool,
}

/// The line of a header and its separator.
struct Found<'t> {
    index: usize,
    start: &'t str,
    separator: u8,
}

/// A line of the text with its separator at the front, if the file says it.
fn stated_separator(line: &str) -> Option<u8> {
    let mark = line.trim().strip_prefix("sep=").or_else(|| line.trim().strip_prefix("SEP="))?;
    mark.bytes().next().filter(|_| mark.len() == 1)
}

impl Sheet {
    /// Reads a text; `is_known` tells the plain names of columns.
    pub(crate) fn parse(text: &str, is_known: &dyn Fn(&str) -> bool) -> Result<Self, Vec<TableMistake>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let unified;
        let text = if text.contains('\r') {
            unified = text.replace("\r\n", "\n").replace('\r', "\n");
            unified.as_str()
        } else {
            text
        };
        let last = u64::try_from(text.lines().count()).unwrap_or(u64::MAX).max(1);
        let Some(found) = header(text, is_known) else {
            return Err(vec![TableMistake::new(last, "the table is empty", "a header and a row for each point")]);
        };
        let above = u64::try_from(found.index).unwrap_or(u64::MAX);
        let mut settings = settings(text, found.index, found.separator);
        let mut records = Vec::new();
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(found.separator)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(found.start.as_bytes());
        for record in reader.records() {
            match record {
                Ok(fields) => {
                    let line = fields.position().map_or(0, |at| above + line_of(found.start, at));
                    if fields.iter().any(|field| !field.is_empty()) {
                        records.push(Row { line, fields });
                    }
                }
                Err(error) => {
                    let line = above + error.position().map_or(1, csv::Position::line);
                    return Err(vec![TableMistake::new(line, error.to_string(), "separated values")]);
                }
            }
        }
        settings.sort_by_key(|setting| setting.line);
        let mut records = records.into_iter();
        let Some(header) = records.next() else {
            return Err(vec![TableMistake::new(last, "the table is empty", "a header and a row for each point")]);
        };
        let mut names: Vec<&str> = header.fields.iter().collect();
        while names.last().is_some_and(|name| name.is_empty()) {
            names.pop();
        }
        let mut headings: Vec<Heading> = names.into_iter().map(|name| Heading::parse(name, is_known)).collect();
        let mut rows: Vec<Row> = records.filter(|row| row.fields != header.fields).collect();
        if rows.first().is_some_and(|row| heading::is_of_units(&row.fields)) {
            let units = rows.remove(0);
            for (heading, unit) in headings.iter_mut().zip(&units.fields) {
                heading.add_unit(unit);
            }
        }
        let mut sheet = Self {
            settings,
            header_line: header.line,
            headings,
            rows,
            last,
            separator: found.separator,
            decimal_comma: false,
        };
        sheet.find_decimals()?;
        Ok(sheet)
    }

    /// Whether decimals have commas; refused where points and commas are in one number.
    fn find_decimals(&mut self) -> Result<(), Vec<TableMistake>> {
        if self.separator == b',' {
            return Ok(());
        }
        let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        let mut pointed = None;
        for row in &self.rows {
            for field in &row.fields {
                let number = field.trim_start_matches(['-', '+', '−']);
                let Some((whole, rest)) = number.split_once(',') else {
                    if pointed.is_none() && number.contains('.') && number.parse::<f64>().is_ok() {
                        pointed = Some((row.line, field.to_owned()));
                    }
                    continue;
                };
                let decimals = rest.split(['e', 'E']).next().unwrap_or_default();
                if rest.contains(',') || whole.contains('.') || rest.contains('.') {
                    if number.bytes().all(|byte| byte.is_ascii_digit() || byte == b',' || byte == b'.') {
                        let what = format!("`{field}` has separators of thousands");
                        let valid = format!("`{}`", field.replace('.', ""));
                        return Err(vec![TableMistake::new(row.line, what, valid)]);
                    }
                } else if is_digits(decimals) && (whole.is_empty() || is_digits(whole)) {
                    self.decimal_comma = true;
                }
            }
        }
        match pointed {
            Some((line, field)) if self.decimal_comma => {
                let what = format!("`{field}` has a point, other numbers of the table have decimal commas");
                Err(vec![TableMistake::new(line, what, "decimal points or decimal commas, not both")])
            }
            _ => Ok(()),
        }
    }

    /// A finite number.
    pub(crate) fn number(&self, text: &str) -> Option<f64> {
        let plain = text.parse::<f64>();
        let found = match plain {
            Ok(x) => x,
            Err(_) if self.decimal_comma || text.contains('−') => {
                let text = text.replace('−', "-");
                let text = if self.decimal_comma { text.replace(',', ".") } else { text };
                text.parse().ok()?
            }
            Err(_) => return None,
        };
        // Rust reads `nan` and `inf` too.
        found.is_finite().then_some(found)
    }

    /// The columns whose plain name is one of these.
    pub(crate) fn columns<'s>(&'s self, is_named: &'s dyn Fn(&str) -> bool) -> impl Iterator<Item = usize> + 's {
        (0..self.headings.len()).filter(move |&column| is_named(&self.headings[column].plain))
    }

    /// The mistake of a row with another number of fields than the header; empty fields at its end do not count.
    pub(crate) fn incomplete(&self, row: &Row) -> Option<TableMistake> {
        let (found, expected) = (row.fields.len(), self.headings.len());
        let spare = (expected..found).all(|k| row.fields.get(k).is_none_or(str::is_empty));
        if found >= expected && spare {
            return None;
        }
        let mut valid = format!("{expected} fields");
        if self.separator == b',' && found == 2 * expected {
            valid += "; where decimals have commas, put semicolons or tabs between the fields";
        }
        Some(TableMistake::new(row.line, format!("a row of {found} fields"), valid))
    }

    /// "`a`, `b`": the names of all columns.
    pub(crate) fn names(&self) -> String {
        let names: Vec<String> = self.headings.iter().map(|heading| format!("`{}`", heading.written)).collect();
        names.join(", ")
    }

    /// Keeps the rows whose field in a column is this text, or the same number.
    ///
    /// The error is the mistake of a column that is not there, or a value that no row has.
    pub(crate) fn keep_only(&mut self, column: &str, value: &str) -> Result<(), TableMistake> {
        let wanted = plain(column);
        let Some(at) = self.headings.iter().position(|heading| heading.plain == wanted) else {
            let what = format!("no column is called `{column}`");
            return Err(TableMistake::new(self.header_line, what, format!("one of {}", self.names())));
        };
        let is_same = |field: &str| match (self.number(field), self.number(value)) {
            (Some(a), Some(b)) => a.total_cmp(&b).is_eq(),
            _ => field == value,
        };
        let rows: Vec<Row> = self.rows.iter().filter(|row| row.fields.get(at).is_some_and(is_same)).cloned().collect();
        if rows.is_empty() {
            let mut values: Vec<&str> = self.rows.iter().filter_map(|row| row.fields.get(at)).collect();
            values.dedup();
            values.truncate(20);
            let what = format!("no row has {column} = {value}");
            return Err(TableMistake::new(self.header_line, what, format!("one of {}", values.join(", "))));
        }
        self.rows = rows;
        Ok(())
    }
}

/// The line of a record: its position is where the one before it ends, comments and empty lines come between.
fn line_of(text: &str, position: &csv::Position) -> u64 {
    let start = usize::try_from(position.byte()).unwrap_or(usize::MAX);
    let between = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    let skipped = text.get(start..).unwrap_or_default().lines().take_while(between).count();
    position.line() + u64::try_from(skipped).unwrap_or(0)
}

/// The header: of all lines and separators, the one with the most known names and fields; otherwise the first line that is no comment.
fn header<'t>(text: &'t str, is_known: &dyn Fn(&str) -> bool) -> Option<Found<'t>> {
    let mut best: Option<((usize, usize), Found<'t>)> = None;
    let mut first: Option<Found<'t>> = None;
    let mut stated = None;
    let mut rest = text;
    for index in 0.. {
        let line = rest.lines().next().unwrap_or_default();
        if rest.is_empty() || HEAD < index {
            break;
        }
        let start = rest;
        rest = rest.split_once('\n').map_or("", |(_, rest)| rest);
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        if let Some(separator) = stated_separator(line) {
            stated = Some(separator);
            continue;
        }
        for separator in SEPARATORS.into_iter().filter(|separator| stated.is_none_or(|stated| stated == *separator)) {
            let fields: Vec<&str> =
                line.split(char::from(separator)).map(|field| field.trim().trim_matches('"')).collect();
            let known = fields.iter().filter(|field| is_known(&Heading::parse(field, is_known).plain)).count();
            let rank = (known, fields.len());
            if 0 < known && best.as_ref().is_none_or(|(most, _)| *most < rank) {
                best = Some((rank, Found { index, start, separator }));
            }
        }
        if first.is_none() {
            let count = |separator: &u8| line.bytes().filter(|byte| byte == separator).count();
            let separator = stated.or_else(|| SEPARATORS.into_iter().max_by_key(count)).unwrap_or(b',');
            first = Some(Found { index, start, separator });
        }
        // Numbers follow the header.
        if line.trim_start().starts_with(|c: char| c.is_ascii_digit()) && best.is_some() {
            break;
        }
    }
    best.map(|(_, found)| found).or(first)
}

/// Keys and values of all comments, and of the lines above the header.
fn settings(text: &str, header: usize, separator: u8) -> Vec<Setting> {
    let setting = |(index, line): (usize, &str)| {
        let (is_comment, body) = match line.strip_prefix('#') {
            Some(body) => (true, body),
            None => (false, line),
        };
        if !is_comment && header <= index {
            return None;
        }
        let split = body
            .split_once([':', '='])
            .or_else(|| if is_comment { None } else { body.split_once(char::from(separator)) });
        let (key, value) = split?;
        let value = value.trim().trim_matches(['"', ';', '\t', ',']).trim();
        let line = u64::try_from(index + 1).unwrap_or(u64::MAX);
        Some(Setting { line, key: plain(key.trim_matches('"')), value: value.to_owned() })
    };
    text.lines()
        .enumerate()
        .filter(|(index, line)| *index < header || line.starts_with('#'))
        .filter_map(setting)
        .collect()
}
