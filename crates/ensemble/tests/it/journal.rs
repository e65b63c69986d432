//! Threads, parts, interruptions and damaged journals: the same bytes.

use core::ops::ControlFlow;
use std::path::{Path, PathBuf};

use piola_ensemble::{Ensemble, EnsembleError, Options, Portion, Results, compute};
use piola_scene::Document;

/// An orbit of one revolution.
pub(crate) fn orbit() -> Document {
    let text = "[central]\ngm = 1.0\n[[body]]\nname = 'comet'\nsemi_major_axis = 1.0\neccentricity = 0.5\n[time]\nrevolutions = 1\n";
    Document::parse("orbit.toml", text)
}

pub(crate) fn ensemble() -> Ensemble {
    let ranges = vec!["body.comet.semi_major_axis=1:4:8".parse().unwrap_or_else(|error| panic!("{error}"))];
    let random = vec!["body.comet.eccentricity=uniform(0, 0.8)".parse().unwrap_or_else(|error| panic!("{error}"))];
    Ensemble::new(orbit(), ranges, random, 5, 3).unwrap_or_else(|error| panic!("{error}"))
}

/// A folder of its own, removed at the end.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-ensemble-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Table and summary of what a folder holds.
pub(crate) fn bytes(ensemble: &Ensemble, folder: &Folder) -> [String; 3] {
    let results = Results::collect(ensemble, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    [results.table(), results.summary(), results.report()]
}

pub(crate) fn run(ensemble: &Ensemble, folder: &Folder, options: Options) {
    let found = compute(ensemble, folder.path(), options, |_| ControlFlow::Continue(()));
    assert!(!found.unwrap_or_else(|error| panic!("{error}")).interrupted);
}

#[test]
fn any_number_of_threads_and_parts_gives_the_same_bytes() {
    let ensemble = ensemble();
    let (one, four, parts) = (Folder::new("one"), Folder::new("four"), Folder::new("parts"));
    run(&ensemble, &one, Options::default().with_threads(1));
    run(&ensemble, &four, Options::default().with_threads(4));
    for part in ["3/3", "1/3", "2/3"] {
        let part: Portion = part.parse().unwrap_or_else(|error| panic!("{error}"));
        let missing = Results::collect(&ensemble, parts.path());
        assert!(matches!(missing, Err(EnsembleError::Missing { members: 40, .. })));
        run(&ensemble, &parts, Options::default().with_part(part));
    }
    let expected = bytes(&ensemble, &one);
    assert_eq!(expected[0].lines().count(), 41);
    assert_eq!(bytes(&ensemble, &four), expected);
    assert_eq!(bytes(&ensemble, &parts), expected);
}

#[test]
fn an_interrupted_ensemble_goes_on_and_does_nothing_twice() {
    let ensemble = ensemble();
    let (whole, cut) = (Folder::new("whole"), Folder::new("cut"));
    run(&ensemble, &whole, Options::default());
    let mut seen = 0;
    let stopped = compute(&ensemble, cut.path(), Options::default().with_threads(1), |_| {
        seen += 1;
        if seen == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let stopped = stopped.unwrap_or_else(|error| panic!("{error}"));
    assert!(stopped.interrupted && 7 <= stopped.computed && stopped.computed < 40, "{stopped:?}");
    // Killed while a line was written.
    let journal = cut.path().join("members-1-of-1.journal");
    let text = std::fs::read_to_string(&journal).unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(&journal, &text[..text.len() - 9]).unwrap_or_else(|error| panic!("{error}"));
    let again = compute(&ensemble, cut.path(), Options::default().with_resume(), |_| ControlFlow::Continue(()));
    let again = again.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((again.kept, again.computed, again.interrupted), (stopped.computed - 1, 41 - stopped.computed, false));
    assert_eq!(bytes(&ensemble, &cut), bytes(&ensemble, &whole));
    let nothing = compute(&ensemble, cut.path(), Options::default().with_resume(), |_| ControlFlow::Continue(()));
    assert_eq!(nothing.map(|found| (found.kept, found.computed)), Ok((40, 0)));
}

/// Lines that are JSON and yet no members of this ensemble: too few values, too many, and a member beyond the last.
#[test]
fn changed_lines_of_a_journal_are_computed_again() {
    let ensemble = ensemble();
    let (whole, changed) = (Folder::new("unchanged"), Folder::new("changed"));
    run(&ensemble, &whole, Options::default().with_threads(1));
    let expected = bytes(&ensemble, &whole);
    let journal = "members-1-of-1.journal";
    let text = std::fs::read_to_string(whole.path().join(journal)).unwrap_or_else(|error| panic!("{error}"));
    let values = format!("[{}]", vec!["1.0"; ensemble.columns().len()].join(","));
    let lines: Vec<&str> = text.lines().collect();
    for line in [
        "{\"member\":3,\"values\":[]}".to_owned(),
        "{\"member\":3,\"values\":[1.0]}".to_owned(),
        format!("{{\"member\":3,\"values\":{}}}", values.replacen('[', "[1.0,", 1)),
        format!("{{\"member\":40,\"values\":{values}}}"),
        format!("{{\"member\":{},\"values\":{values}}}", u64::MAX),
    ] {
        let damaged = [&lines[..5], &[line.as_str()], &lines[6..]].concat().join("\n") + "\n";
        std::fs::write(changed.path().join(journal), damaged).unwrap_or_else(|error| panic!("{error}"));
        let found = Results::collect(&ensemble, changed.path());
        assert!(matches!(found, Err(EnsembleError::Missing { missing: 36, members: 40, .. })), "{line}: {found:?}");
        let again = compute(&ensemble, changed.path(), Options::default().with_resume(), |_| ControlFlow::Continue(()));
        assert_eq!(again.map(|found| (found.kept, found.computed)), Ok((4, 36)), "{line}");
        assert_eq!(bytes(&ensemble, &changed), expected, "{line}");
    }
    // A whole set of members and one beyond.
    let beyond = format!("{text}{{\"member\":40,\"values\":{values}}}\n");
    std::fs::write(changed.path().join(journal), beyond).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(bytes(&ensemble, &changed), expected);
}

#[test]
fn other_files_are_written_in_the_set_of_the_results() {
    let ensemble = ensemble();
    let folder = Folder::new("set");
    run(&ensemble, &folder, Options::default());
    let results = Results::collect(&ensemble, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let set = piola_charts::Folder::prepare(folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let names = |written: piola_charts::Written| -> Vec<String> {
        assert!(written.failures.is_empty(), "{:?}", written.failures);
        let names = written.files.iter().filter_map(|path| path.file_name());
        names.map(|name| name.to_string_lossy().into_owned()).collect()
    };
    let with = names(results.write_with(&set, [("members.parquet", vec![0, 255])]));
    assert_eq!(with, ["members.csv", "summary.json", "members.svg", "members.parquet"]);
    assert_eq!(std::fs::read(folder.path().join("members.parquet")).ok(), Some(vec![0, 255]));
    assert_eq!(names(results.write(&set)), with[..3]);
    assert!(!folder.path().join("members.parquet").exists());
}

#[test]
fn a_journal_of_another_ensemble_is_refused() {
    let folder = Folder::new("other");
    run(&ensemble(), &folder, Options::default());
    let other = Ensemble::new(
        orbit(),
        vec!["body.comet.eccentricity=0:0.5:3".parse().unwrap_or_else(|error| panic!("{error}"))],
        Vec::new(),
        1,
        0,
    );
    let other = other.unwrap_or_else(|error| panic!("{error}"));
    let resumed = compute(&other, folder.path(), Options::default().with_resume(), |_| ControlFlow::Continue(()));
    assert!(matches!(resumed, Err(EnsembleError::OtherEnsemble { .. })));
    assert!(matches!(Results::collect(&other, folder.path()), Err(EnsembleError::OtherEnsemble { .. })));
    // Anew it is computed, in place of the other.
    run(&other, &folder, Options::default());
    assert_eq!(bytes(&other, &folder)[0].lines().count(), 4);
}

/// An eccentricity beyond 1 is no ellipse: that member says why, the others have their numbers.
#[test]
fn members_that_fail_say_why_and_the_others_have_their_numbers() {
    let ranges = vec!["body.comet.eccentricity=0.5:1.5:3".parse().unwrap_or_else(|error| panic!("{error}"))];
    let ensemble = Ensemble::new(orbit(), ranges, Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"));
    let folder = Folder::new("failing");
    run(&ensemble, &folder, Options::default());
    let results = Results::collect(&ensemble, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    assert!(0 < results.failures() && results.failures() < 3, "{}", results.table());
    let last = results.members().last().unwrap_or_else(|| panic!("three"));
    assert!(last.failure.as_ref().is_some_and(|why| !why.is_empty()) && last.values.iter().all(|x| x.is_nan()));
    let times = results.column("time (s)").unwrap_or_default();
    assert!((times[0] - core::f64::consts::TAU).abs() < 1e-12 && times[2].is_nan());
    assert!(results.table().lines().nth(3).is_some_and(|row| row.starts_with("2,1.5,,")), "{}", results.table());
    assert!(!results.summary().contains("NaN"));
}
