//! Reference tables: what is read, and what is refused with its line.

use std::path::PathBuf;

use piola_scene::{Plan, Report, Scene, SceneError, run};

use crate::support::PAIR;

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, table: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("piola-reference-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
        let scene = format!("{PAIR}[reference]\nfile = \"table.csv\"\nlabel = \"table\"\n");
        std::fs::write(folder.join("scene.toml"), scene).unwrap_or_else(|error| panic!("{error}"));
        std::fs::write(folder.join("table.csv"), table).unwrap_or_else(|error| panic!("{error}"));
        Self(folder)
    }

    fn load(&self) -> Result<Scene, SceneError> {
        Scene::load(&self.0.join("scene.toml"), &[])
    }

    fn report(&self) -> Report {
        match self.load() {
            Err(SceneError::Invalid(report)) => report,
            other => panic!("{other:?}"),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn error_equals_the_distance_that_was_put_in() {
    let folder = Folder::new("distance", "# source\ntime_s,body,x_m,y_m,z_m\n0,one,1.5,0,0\n0,other,-1,0,0\n");
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let run = run::run(&scene, &Plan::of(&scene), |_| core::ops::ControlFlow::Continue(()));
    let errors = run.errors.unwrap_or_else(|| panic!("no errors"));
    assert_eq!(errors.label, "table");
    assert_eq!(errors.bodies[0].largest.to_bits(), 0.5_f64.to_bits());
    // Divided by the largest distance from the origin.
    assert_eq!(errors.bodies[0].largest_relative.to_bits(), (0.5_f64 / 1.5).to_bits());
    assert_eq!(errors.bodies[1].largest.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn wrong_tables_are_refused_with_their_line() {
    let header = "time_s,body,x_m,y_m,z_m\n";
    let cases = [
        ("a body", format!("{header}0,sun,1,0,0\n"), vec!["line 2", "`sun` that is not in the scene", "one, other"]),
        ("a column", "time_s,body,x_m,y_m\n0,one,1,0\n".to_string(), vec!["line 1", "no column `z_m`"]),
        ("a number", format!("{header}0,one,1,nan,0\n"), vec!["line 2", "`nan` in the column y_m", "finite"]),
        ("a row", format!("{header}0,one,1,0,0\n0,one,1\n"), vec!["line 3"]),
        ("a time", format!("{header}99,one,1,0,0\n"), vec!["no instant", "between 0 s and 10 s"]),
    ];
    for (what, table, words) in cases {
        let report = Folder::new(&what.replace(' ', "-"), &table).report();
        let shown = report.to_string();
        assert_eq!(report.mistakes.len(), 1, "{what}: {shown}");
        for word in words {
            assert!(shown.contains(word), "{what}: `{word}` is not in\n{shown}");
        }
    }
}
