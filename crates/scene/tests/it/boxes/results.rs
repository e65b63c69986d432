//! Plans, summaries, tables and figures of fields on a box.

use std::ops::ControlFlow;

use piola_charts::Folder;
use piola_scene::run::Outcome;
use piola_scene::studies::{self, StudyPlan};

use super::{STIR, field, history, in_box, in_rectangle, run};
use crate::support::{replaced, study};

const BLOCK: &str = r#"
[box]
type = "static"
sides = [1.0, 2.0, 3.0]
points = [8, 9, 10]
young_modulus = "2 MPa"
poisson_ratio = 0.25
[[load]]
type = "gaussian"
at = [0.5, 1.0, 1.5]
radius = 0.4
force_per_volume = "[0, 0, -1] kN/m^3"
[[load]]
type = "point"
at = [0.25, 0.5, 0.75]
force = "[1, 2, 3] N"
[[probe]]
name = "tip"
at = [1.0, 2.0, 3.0]
"#;

const BAR: &str = r#"
[box]
type = "motion"
sides = [1.0, 1.0]
modes = [3, 2]
first_lame_parameter = 2.0
shear_modulus = 1.0
density = 2.0
duration = 2.0
[[load]]
type = "uniform"
force_per_volume = [1.0, 0.0]
[[probe]]
name = "middle"
at = [0.5, 0.2]
"#;

#[test]
fn every_planned_file_is_written_whole() {
    for (name, text, files) in [
        ("static", BLOCK, vec!["summary.json", "field.csv", "displacement.svg"]),
        ("motion", BAR, vec!["summary.json", "energy.csv", "probes.csv", "motion.svg"]),
        ("flow", STIR, vec!["summary.json", "flow.csv", "particles.csv", "flow.svg"]),
    ] {
        let study = study(text);
        let plan = StudyPlan::of(&study);
        assert_eq!(plan.files, files);
        let run = run(text);
        let folder = std::env::temp_dir().join(format!("piola-box-{name}-{}", std::process::id()));
        let prepared = Folder::prepare(&folder).unwrap_or_else(|error| panic!("{error}"));
        let written = run.write(&prepared, &study, &plan);
        assert!(written.failures.is_empty() && written.files.len() == files.len());
        for path in &written.files {
            let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{error}"));
            assert!(!text.contains("NaN") && !text.contains("could not be drawn"), "{}", path.display());
        }
        std::fs::remove_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn plan_names_the_cost_and_what_is_skipped() {
    let plan = StudyPlan::of(&study(BLOCK)).to_string();
    for words in [
        "box of 1 × 2 × 3 m between sliding walls",
        "8 × 9 × 10 cells",
        "720 points",
        "720 modes of 3 components",
        "of memory",
        "tip",
    ] {
        assert!(plan.contains(words), "`{words}` is not in\n{plan}");
    }
    let plan = StudyPlan::of(&study(BAR)).to_string();
    for words in [
        "the instants of the output alone fix the cost",
        "12 modes of 2 components",
        "201 instants",
        "drift of the energy: drag or loads",
    ] {
        assert!(plan.contains(words), "`{words}` is not in\n{plan}");
    }
    let plan = StudyPlan::of(&study(&replaced(STIR, "points = [8, 8]", "points = [400, 400]"))).to_string();
    for words in ["160000 points", "one of 2 along each axis", "once: the loads are steady", "there is no [[probe]]"] {
        assert!(plan.contains(words), "`{words}` is not in\n{plan}");
    }
}

#[test]
fn resultant_has_the_forces_at_points_and_the_volume_of_the_patch() {
    let run = run(BLOCK);
    let found = field(in_box(&run));
    let Some([x, y, z]) = found.resultant else { panic!("no resultant") };
    // ∫ exp(−r²/a²) = (√π a)³ where the box is wide; at ±1.25 radii of the narrow side a share of erf(1.25) is left.
    let share = 0.922_900_1;
    let patch = -1000.0 * core::f64::consts::PI.powf(1.5) * 0.4_f64.powi(3) * share;
    assert!((x - 1.0).abs() < 1e-12 && (y - 2.0).abs() < 1e-12, "{x} {y}");
    assert!(((z - 3.0 - patch) / patch).abs() < 5e-3, "{z} {patch}");
    assert!(found.unbalance().is_some_and(|share| share < 0.1));
}

#[test]
fn interrupted_motion_and_equilibrium_keep_what_they_found() {
    let stop =
        |after: f64| move |done: f64| if done < after { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let moved = studies::run(&study(BAR), stop(0.25));
    assert_eq!(moved.outcome, Outcome::Interrupted);
    assert_eq!(history(in_rectangle(&moved)).instants.len(), 51);
    let bent = studies::run(&study(BLOCK), stop(0.3));
    assert_eq!(bent.outcome, Outcome::Interrupted);
    let found = field(in_box(&bent));
    assert!(found.displacement[0].len() == 720 && found.stress[0][0].is_empty() && found.energy.is_none());
    let plan = StudyPlan::of(&study(BLOCK));
    let summary = bent.summary(&plan);
    assert!(
        summary.contains("\"status\": \"interrupted\"") && summary.contains("\"elastic_energy_J\": null"),
        "{summary}"
    );
    let folder = std::env::temp_dir().join(format!("piola-box-stopped-{}", std::process::id()));
    let prepared = Folder::prepare(&folder).unwrap_or_else(|error| panic!("{error}"));
    for after in [0.0, 0.3, 0.5] {
        let run = studies::run(&study(BLOCK), stop(after));
        assert!(run.write(&prepared, &study(BLOCK), &plan).failures.is_empty());
    }
    std::fs::remove_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn load_beyond_the_range_of_numbers_fails_by_name() {
    let run = studies::run(&study(&replaced(BLOCK, "[1, 2, 3] N", "[1e300, 2, 3] N")), |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = &run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.contains("elastic energy") && why.contains("is not finite"), "{why}");
}
