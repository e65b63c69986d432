//! References: tables of positions and closed forms.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::{Builder, System, TimeSpan};
use piola_document::{Record, words};
use piola_gravitation::kepler::KeplerMotion;

/// A reference with the way of measuring errors against it.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Name in figures and on the terminal.
    pub label: String,
    /// The reference itself.
    pub kind: ReferenceKind,
    /// Index of the body from which distances are measured.
    pub relative_to: Option<usize>,
}

/// Kinds of references.
#[derive(Debug, Clone)]
pub enum ReferenceKind {
    /// Positions at listed instants.
    Table(ReferenceTable),
    /// Positions at any instant.
    ClosedForm(ClosedForm),
}

/// Closed forms.
#[derive(Debug, Clone)]
pub enum ClosedForm {
    /// Elliptic motion of each body about the centre.
    Kepler(Vec<KeplerMotion>),
}

/// Positions of some bodies at some instants.
#[derive(Debug, Clone)]
pub struct ReferenceTable {
    /// The file.
    pub path: PathBuf,
    /// Instants, s, in the order of the run.
    pub times: Vec<f64>,
    /// For each instant the bodies (by index) with their positions, m.
    pub positions: Vec<Vec<(usize, [f64; 3])>>,
}

/// A reference table with more bytes than this is refused (64 MiB).
const LARGEST_TABLE: u64 = 64 << 20;

const COLUMNS: [&str; 5] = ["time_s", "body", "x_m", "y_m", "z_m"];

impl Builder<'_> {
    /// The outer `None` says that a mistake was made.
    #[expect(clippy::option_option, reason = "absent because not asked for, or because of a mistake")]
    pub(super) fn reference(
        &mut self,
        scene: &Record,
        system: Option<&System>,
        time: Option<TimeSpan>,
    ) -> Option<Option<Reference>> {
        let Some(table) = scene.record("reference") else {
            return if scene.has("reference") { None } else { Some(None) };
        };
        if table.has("file") == table.has("closed_form") {
            let what =
                if table.has("file") { "both `file` and `closed_form`" } else { "neither `file` nor `closed_form`" };
            let place = if table.has("file") { table.place_of("closed_form") } else { table.place.clone() };
            return self.refused(place, format!("[reference] has {what}"), "one of them");
        }
        // A missing file is found even when the system has mistakes.
        let known = self.kept.and_then(|kept| kept.reference.get());
        let file = if table.has("file") && known.is_none() { Some(self.reference_text(table)?) } else { None };
        let system = system?;
        let names = system.names();
        let relative_to =
            if table.has("relative_to") { Some(self.find(table, "relative_to", "body", &names)?) } else { None };
        let label = |default: &str| table.text("label").unwrap_or(default).to_string();
        let rows = match (known, file) {
            (Some(known), _) => Some(Cow::Borrowed(known)),
            (None, Some((path, text))) => {
                let rows = self.rows(table, &path, &text, &names)?;
                match self.kept {
                    Some(kept) => Some(Cow::Borrowed(kept.reference.get_or_init(|| (path, rows)))),
                    None => Some(Cow::Owned((path, rows))),
                }
            }
            (None, None) => None,
        };
        Some(Some(match rows {
            Some(rows) => Reference {
                label: label(&rows.0.file_stem().unwrap_or_default().to_string_lossy()),
                kind: ReferenceKind::Table(self.reference_table(table, &rows, time?)?),
                relative_to,
            },
            None => Reference {
                label: label("closed form"),
                kind: ReferenceKind::ClosedForm(self.closed_form(table, system)?),
                relative_to,
            },
        }))
    }

    fn closed_form(&mut self, table: &Record, system: &System) -> Option<ClosedForm> {
        table.text("closed_form")?;
        let place = || table.place_of("closed_form");
        let System::Central(central) = system else {
            return self.refused(
                place(),
                "the closed form `kepler` in a scene that is not of [central]",
                "[central], or a reference file",
            );
        };
        let mut motions = Vec::new();
        for body in &central.bodies {
            match KeplerMotion::new(central.gm, body.position, body.velocity) {
                Ok(motion) => motions.push(motion),
                Err(error) => self.refuse(
                    place(),
                    format!("the closed form `kepler` with the body {}: {error}", body.name),
                    "bodies on ellipses",
                ),
            }
        }
        (motions.len() == central.bodies.len()).then_some(ClosedForm::Kepler(motions))
    }

    fn reference_text(&mut self, table: &Record) -> Option<(PathBuf, String)> {
        let path = self.document.folder().join(table.text("file")?);
        let mut text = String::new();
        let read = std::fs::File::open(&path).and_then(|file| file.take(LARGEST_TABLE + 1).read_to_string(&mut text));
        let cause = match read {
            Ok(_) if LARGEST_TABLE < text.len() as u64 => format!("it has more than {LARGEST_TABLE} bytes"),
            Ok(_) => return Some((path, text)),
            Err(error) => error.to_string(),
        };
        self.refused(
            table.place_of("file"),
            format!("the reference file `{}` cannot be read: {cause}", path.display()),
            "the path of a readable file, relative to the scene's folder",
        )
    }

    fn rows(&mut self, table: &Record, path: &Path, text: &str, names: &[&str]) -> Option<Vec<Row>> {
        rows(text, names)
            .map_err(|(line, found, valid)| {
                let shown = format!("line {line} of `{}`: {found}", path.display());
                self.refuse(table.place_of("file"), shown, valid);
            })
            .ok()
    }

    fn reference_table(
        &mut self,
        table: &Record,
        (path, rows): &(PathBuf, Vec<Row>),
        time: TimeSpan,
    ) -> Option<ReferenceTable> {
        let mut instants: Vec<f64> = rows.iter().map(|row| row.0).collect();
        time.sort(&mut instants);
        instants.dedup_by(|a, b| time.order(*a, *b).is_eq());
        instants.retain(|t| time.holds(*t));
        if instants.is_empty() {
            return self.refused(
                table.place_of("file"),
                format!(
                    "no instant of `{}` is between {} s and {} s",
                    path.display(),
                    words::number(time.start),
                    words::number(time.end)
                ),
                "a table that overlaps the span of time",
            );
        }
        let mut positions = vec![Vec::new(); instants.len()];
        for &(t, body, position) in rows {
            if let Ok(instant) = instants.binary_search_by(|probe| time.order(*probe, t)) {
                positions[instant].push((body, position));
            }
        }
        let (first, last) = (time.start.min(time.end), time.start.max(time.end));
        let clamped = instants.into_iter().map(|t| t.clamp(first, last)).collect();
        Some(ReferenceTable { path: path.clone(), times: clamped, positions })
    }
}

/// Time, body and position.
pub(super) type Row = (f64, usize, [f64; 3]);

/// The rows of a table, or the line of the first mistake with what was found and what would be valid.
fn rows(text: &str, names: &[&str]) -> Result<Vec<Row>, (u64, String, String)> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let malformed = |error: &csv::Error| {
        let line = error.position().map_or(1, csv::Position::line);
        (line, error.to_string(), "rows of comma-separated values, all of one length".to_string())
    };
    let header = reader.headers().map_err(|error| malformed(&error))?.clone();
    let at: Vec<usize> = COLUMNS
        .iter()
        .map(|name| {
            header.iter().position(|column| column == *name).ok_or_else(|| {
                let line = header.position().map_or(1, csv::Position::line);
                let found: Vec<&str> = header.iter().take(12).collect();
                (line, format!("no column `{name}` among {}", words::list(&found)), COLUMNS.join(", "))
            })
        })
        .collect::<Result<_, _>>()?;
    let index: HashMap<&str, usize> = names.iter().enumerate().map(|(i, name)| (*name, i)).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| malformed(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        let field = |column: usize| record.get(at[column]).unwrap_or_default();
        let number = |column: usize| {
            field(column).parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(|| {
                (line, format!("`{}` in the column {}", field(column), COLUMNS[column]), "a finite number".to_string())
            })
        };
        let body = *index.get(field(1)).ok_or_else(|| {
            let valid = words::one_of(field(1), names.iter().copied());
            (line, format!("the reference has a body `{}` that is not in the scene", field(1)), valid)
        })?;
        rows.push((number(0)?, body, [number(2)?, number(3)?, number(4)?]));
    }
    Ok(rows)
}
