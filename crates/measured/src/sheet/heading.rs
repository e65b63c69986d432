//! Names of columns with their units, in the usual ways of writing them.

use csv::StringRecord;

use super::spelled;

/// A column: its name and its unit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Heading {
    /// As the file has it.
    pub(crate) written: String,
    /// The name in small letters, with blanks for all that separates words: `shear rate`.
    pub(crate) plain: String,
    /// The unit as written.
    pub(crate) unit: Option<String>,
}

/// A name in small letters, with one blank for whatever separates words.
pub(crate) fn plain(name: &str) -> String {
    let words = name.split(|c: char| c.is_whitespace() || matches!(c, '_' | '-' | '.'));
    let words: Vec<String> = words.filter(|word| !word.is_empty()).map(str::to_lowercase).collect();
    words.join(" ")
}

impl Heading {
    /// `stress [Pa]`, `stress (Pa)`, `stress / Pa`, `stress, Pa`, `stress in Pa`, `stress_Pa`, `stress Pa`.
    pub(crate) fn parse(written: &str, is_known: &dyn Fn(&str) -> bool) -> Self {
        let written = written.trim();
        let of = |name: &str, unit: Option<&str>| Self {
            written: written.to_owned(),
            plain: plain(name),
            unit: unit.map(|unit| unit.trim().to_owned()).filter(|unit| !unit.is_empty()),
        };
        if let Some((name, unit)) = written.split_once('[') {
            return of(name, Some(unit.trim_end().trim_end_matches(']')));
        }
        if is_known(&plain(written)) {
            return of(written, None);
        }
        if let Some((name, unit)) = written.strip_suffix(')').and_then(|text| text.rsplit_once('(')) {
            // A symbol in brackets is no unit.
            let is_symbol = spelled(unit).is_none() && unit.trim().chars().count() <= 2;
            return of(name, Some(unit).filter(|_| !is_symbol));
        }
        for sign in ["/", ",", " in "] {
            for (at, _) in written.match_indices(sign) {
                let (name, unit) = (&written[..at], &written[at + sign.len()..]);
                if is_known(&plain(name)) && spelled(unit).is_some() {
                    return of(name, Some(unit));
                }
            }
        }
        for (at, sign) in written.match_indices(['_', ' ']) {
            let (name, unit) = (&written[..at], &written[at + sign.len()..]);
            if !is_known(&plain(name)) {
                continue;
            }
            // `shear_rate_1_s`, `viscosity_Pa_s`.
            let sign = if unit.ends_with("Pa_s") || unit.ends_with("N_m") { " " } else { "/" };
            let spellings = [unit.to_owned(), unit.replace('_', sign)];
            if let Some(unit) = spellings.iter().find(|unit| spelled(unit).is_some()) {
                return of(name, Some(unit));
            }
        }
        of(written, None)
    }

    /// The unit of the line below the header.
    pub(super) fn add_unit(&mut self, text: &str) {
        let text = bare(text);
        if self.unit.is_none() && !text.is_empty() && text != "-" {
            self.unit = Some(text.to_owned());
        }
    }
}

/// Without brackets.
fn bare(text: &str) -> &str {
    text.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim()
}

/// Whether a row holds units: no numbers, and at least half of what stands in it are units.
pub(super) fn is_of_units(fields: &StringRecord) -> bool {
    let filled: Vec<&str> = fields.iter().filter(|field| !field.is_empty()).collect();
    let is_number = |field: &&str| field.replace(',', ".").parse::<f64>().is_ok();
    let is_unit = |field: &&&str| matches!(bare(field), "-" | "") || spelled(bare(field)).is_some();
    !filled.is_empty() && !filled.iter().any(is_number) && filled.len() <= 2 * filled.iter().filter(is_unit).count()
}
