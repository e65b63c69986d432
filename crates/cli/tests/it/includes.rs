//! Scenes of several files.

use std::path::Path;

use crate::end_to_end::{Folder, err, out, read};

const SCENE: &str = "include = ['parts/system.toml']\n[time]\nrevolutions = 2\n";
const SYSTEM: &str =
    "[central]\ngm = 1.0\n[[body]]\nname = 'comet'\nsemi_major_axis = 1.0\neccentricity = 0.5\n[output]\nsamples = 5\n";

fn prepared(name: &str, system: &str) -> Folder {
    let folder = Folder::new(name);
    folder.scene(SCENE);
    let parts = folder.0.join("parts");
    std::fs::create_dir_all(&parts)
        .and_then(|()| std::fs::write(parts.join("system.toml"), system))
        .unwrap_or_else(|error| panic!("{error}"));
    folder
}

#[test]
fn a_scene_of_two_files_runs_and_its_report_shows_both() {
    let folder = prepared("include-run", SYSTEM);
    let output =
        folder.piola(&["run", "orbit.toml", "--report", "--out", "there", "--set", "body.comet.eccentricity=0.25"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(read(&folder.0.join("there/trajectory.csv")).lines().count(), 6);
    let html = read(&folder.0.join("there/report.html"));
    let system = Path::new("parts").join("system.toml").display().to_string();
    for name in ["orbit.toml", &system, "--set"] {
        assert!(html.contains(&format!("<h2>{name}</h2>")), "{name}");
    }
}

#[test]
fn a_mistake_in_an_included_file_is_shown_there() {
    let folder = prepared("include-mistake", &SYSTEM.replace("gm = 1.0", "gm = -1.0"));
    let output = folder.piola(&["check", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let place = format!("--> {}:2:6", Path::new("parts").join("system.toml").display());
    assert!(err(&output).contains(&place), "{}", err(&output));
}

#[test]
fn the_table_of_an_included_file_lies_beside_it() {
    let folder = prepared("include-table", &format!("{SYSTEM}[reference]\nfile = 'at-start.csv'\n"));
    let table = "time_s,body,x_m,y_m,z_m\n0,comet,0.5,0,0\n";
    std::fs::write(folder.0.join("parts/at-start.csv"), table).unwrap_or_else(|error| panic!("{error}"));
    let output = folder.piola(&["plan", "orbit.toml", "--explain", "reference"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let table = Path::new("parts").join("at-start.csv").display().to_string();
    assert!(out(&output).contains(&format!("error against reference: 1 instants of {table}")), "{}", out(&output));
}

#[test]
fn a_sweep_varies_included_values() {
    let folder = prepared("include-sweep", SYSTEM);
    let arguments = ["sweep", "orbit.toml", "--vary", "body.comet.eccentricity=0:0.5:3", "--out", "swept"];
    let output = folder.piola(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(out(&output).contains("members"), "{}", out(&output));
    assert_eq!(read(&folder.0.join("swept/members.csv")).lines().count(), 4);
}

#[test]
fn a_newer_format_is_refused_in_words() {
    let folder = Folder::new("format");
    folder.scene("format = 2\n[something]\nnew = 1\n");
    let output = folder.piola(&["check", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let shown = err(&output);
    assert!(shown.contains("error: this program reads format 1: a newer Piola is needed"), "{shown}");
    assert!(shown.contains("--> orbit.toml:1:10") && shown.contains("1 mistake"), "{shown}");
}
