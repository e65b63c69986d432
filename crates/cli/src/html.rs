//! `--report`: one HTML file with figures, tables, plan and inputs, which opens without a network.

use core::fmt::Write as _;
use std::path::Path;

use piola_charts::{Folder, Written};
use piola_document::{Document, Source};

use crate::arguments::SceneArguments;

/// Rows of a table that are shown; the file has all.
const ROWS: usize = 20;

/// Wide text and tables scroll within their boxes. On a narrow screen so do figures: their labels would be too small if they shrank.
const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;margin:0 auto;max-width:70rem;padding:1rem;color:#222}\
h1,h2{line-height:1.2;overflow-wrap:anywhere}.figure{overflow-x:auto}svg{max-width:100%;height:auto}\
@media(max-width:50rem){.figure svg{max-width:none}}\
pre,.table{overflow-x:auto;background:#f6f6f6;padding:.5rem}\
table{border-collapse:collapse;font-size:.85rem}td,th{padding:.1rem .5rem;text-align:right;white-space:nowrap}\
th{border-bottom:1px solid #999}";

/// The text between tags.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // What XML does not have.
            c if c.is_control() && c != '\n' && c != '\t' => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

/// A page of texts, and of the figures and tables that were written.
pub(crate) fn page(title: &str, texts: &[(&str, String)], written: &Written, inputs: &[Source]) -> String {
    let title = escaped(title);
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    for (head, text) in texts {
        let _ = write!(html, "<h2>{}</h2>\n<pre>{}</pre>\n", escaped(head), escaped(text.trim_end()));
    }
    for path in &written.files {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        // What cannot be read back is left out; the list of files names it.
        let Ok(text) = std::fs::read_to_string(path) else { continue };
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("svg") => {
                let drawing = text.find("<svg").map_or("", |start| &text[start..]);
                let _ = write!(html, "<h2>{}</h2>\n<div class=\"figure\">{drawing}</div>\n", escaped(name));
            }
            Some("csv") => {
                let _ = write!(html, "<h2>{}</h2>\n{}", escaped(name), table(&text));
            }
            _ => {}
        }
    }
    for input in inputs {
        let _ = write!(html, "<h2>{}</h2>\n<pre>{}</pre>\n", escaped(&input.name), escaped(input.text.trim_end()));
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (version, system, machine) = (env!("CARGO_PKG_VERSION"), std::env::consts::OS, std::env::consts::ARCH);
    let _ = write!(html, "<p>Piola {version} on {system}, {machine}, {cores} cores.</p>\n</body>\n</html>\n");
    html
}

/// The first rows of a table.
fn table(csv: &str) -> String {
    let mut html = String::from("<div class=\"table\"><table>\n");
    for (index, line) in csv.lines().take(ROWS + 1).enumerate() {
        let tag = if index == 0 { "th" } else { "td" };
        html.push_str("<tr>");
        for cell in line.split(',') {
            let _ = write!(html, "<{tag}>{}</{tag}>", escaped(cell.trim_matches('"')));
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</table></div>\n");
    let rows = csv.lines().count().saturating_sub(1);
    if ROWS < rows {
        let _ = writeln!(html, "<p>The first {ROWS} of {rows} rows.</p>");
    }
    html
}

/// Adds `report.html` to the results of a scene.
pub(crate) fn add(
    scene: &SceneArguments,
    title: &str,
    texts: &[(&str, String)],
    (folder, written): (&Folder, &mut Written),
) {
    let sources = |path: &Path| Document::read_with(path, &scene.settings).map(|document| document.sources().to_vec());
    let page = page(title, texts, written, &sources(&scene.scene).unwrap_or_default());
    written.add(folder, [("report.html", page)]);
}
