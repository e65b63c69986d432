//! Error against time of profiles, discharges and torques: an SVG and a page in Markdown.
//!
//! Options: `--out FOLDER` (default: the current one): `viscometry-accuracy.md` there, its figure in `figures/`.

use std::error::Error;
use std::path::PathBuf;

use piola_benches::viscometry::accuracy::chart;
use piola_benches::viscometry::sheet::{figure, page};

fn main() -> Result<(), Box<dyn Error>> {
    let mut folder = PathBuf::from(".");
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match (argument.as_str(), arguments.next()) {
            ("--out", Some(value)) => folder = value.into(),
            _ => return Err(format!("{argument}: there is --out FOLDER").into()),
        }
    }
    let figures = folder.join("figures");
    std::fs::create_dir_all(&figures)?;
    let chart = chart()?;
    std::fs::write(figures.join("viscometry-accuracy.svg"), figure(&chart))?;
    std::fs::write(folder.join("viscometry-accuracy.md"), page(&chart))?;
    Ok(())
}
