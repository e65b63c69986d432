//! The stability sheet: worst relative errors at adversarial inputs, as Markdown.
//!
//! Options: `--out FILE` (default: standard output), `--steps N` (of the free top, default 10 000 000).

use std::error::Error;
use std::fmt::Write as _;
use std::io::Write as _;

use piola_benches::stability::tables;

const HEAD: &str = "# Stability

What rounding leaves of a result where the input is made to spoil it. Written by `cargo xtask stability`; the same tables, with
a shorter run of the top, are held to bounds by `benches::it::stability`.

Each quantity is computed in doubles and, by the same formula, in doubled precision (31 digits) from the same doubles. The
difference, norm-wise and relative to the exact result, is rounding alone; the largest over the states is shown. An ulp is
2.2e-16.
";

fn main() -> Result<(), Box<dyn Error>> {
    let (mut out, mut steps) = (None, 10_000_000);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{argument} wants a value"))?;
        match argument.as_str() {
            "--out" => out = Some(value),
            "--steps" => steps = value.parse()?,
            _ => return Err(format!("unknown option {argument}: --out FILE, --steps N").into()),
        }
    }
    let mut page = HEAD.to_owned();
    let mut failed = 0;
    for table in tables(steps)? {
        write!(page, "\n## {}\n\n{}\n\n| {} |\n", table.title, table.text, table.columns.join(" | "))?;
        writeln!(page, "|{}", "---|".repeat(table.columns.len()))?;
        for row in &table.rows {
            let errors: Vec<String> = row.errors.iter().map(|error| format!("{error:.1e}")).collect();
            writeln!(page, "| {} | {} |", row.input, errors.join(" | "))?;
        }
        failed += table.exceeding().count();
    }
    match out {
        Some(path) => std::fs::write(path, page)?,
        None => std::io::stdout().write_all(page.as_bytes())?,
    }
    if failed == 0 { Ok(()) } else { Err(format!("{failed} rows exceed what is allowed").into()) }
}
