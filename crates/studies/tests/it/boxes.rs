//! Motions and flows on a box that are stopped and go on.

use core::ops::ControlFlow;

use piola_spectral::{BoxGrid, LameParameters, Walls};
use piola_studies::StudyCheckpointKeeper;
use piola_studies::boxes::{
    BoxCheckpoint, BoxFields, BoxFindings, BoxStudy, FlowTask, Form, Found, Load, MotionTask, Probe, Start, Task,
};
use piola_studies::{Observer, Outcome};

/// The last checkpoint, as it comes out of a file.
#[derive(Default)]
struct Last(Option<String>);

impl StudyCheckpointKeeper<BoxCheckpoint> for Last {
    fn is_due(&mut self) -> bool {
        false
    }
    fn keep(&mut self, checkpoint: &BoxCheckpoint) {
        self.0 = serde_json::to_string(checkpoint).ok();
    }
}

impl Last {
    fn read(&self) -> BoxCheckpoint {
        let text = self.0.as_deref().unwrap_or_default();
        serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// All that was found, with all digits.
fn digits(found: &BoxFindings) -> String {
    match found {
        BoxFindings::Rectangle(Found::Motion(motion)) => format!("{motion:?}"),
        BoxFindings::Rectangle(Found::Flow(flow)) => format!("{flow:?}"),
        BoxFindings::Box(Found::Motion(motion)) => format!("{motion:?}"),
        BoxFindings::Box(Found::Flow(flow)) => format!("{flow:?}"),
        other => panic!("{other:?}"),
    }
}

/// Stopped after each of some parts and gone on from the file, the run finds what the one finds that was never stopped.
fn compare(study: &BoxStudy) -> String {
    let go_on: &mut Observer<'_> = &mut |_| ControlFlow::Continue(());
    let (whole, outcome) = study.run(go_on);
    assert_eq!(outcome, Outcome::Completed);
    let mut last = Last::default();
    let mut from = None;
    for part in [0.2, 0.35, 0.8] {
        let stop: &mut Observer<'_> =
            &mut |done| if done < part { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        let (_, outcome) = study.run_with_checkpoints(from, Some(&mut last), stop);
        assert_eq!(outcome, Outcome::Interrupted);
        let checkpoint = last.read();
        assert!(checkpoint.check(study).is_ok() && 0.0 < checkpoint.time());
        from = Some(checkpoint);
    }
    let (continued, outcome) = study.run_with_checkpoints(from, None, go_on);
    assert_eq!(outcome, Outcome::Completed);
    let digits = [&whole, &continued].map(digits);
    assert!(digits[0] == digits[1], "the run that went on differs");
    let [digits, _] = digits;
    digits
}

fn motion<const D: usize>(sides: [f64; D], modes: [usize; D]) -> BoxFields<D> {
    let at = sides.map(|side| 0.3 * side);
    let start = Start { form: Form::Gaussian { value: [1e-3; D], at, radius: 0.2 }, is_velocity: true };
    let load = Load { form: Form::Uniform { value: [0.5; D] }, span: [0.11, 0.52], course: vec![0.0, 1.0, -1.0] };
    let task = MotionTask { modes, density: 2.0, drag: 0.1, duration: 1.0, interval: 0.07, starts: vec![start] };
    BoxFields {
        sides,
        walls: Walls::Sliding,
        lame: LameParameters::new(2.0, 1.0).unwrap_or_else(|error| panic!("{error}")),
        loads: vec![load],
        probes: vec![Probe { name: "middle".into(), at: sides.map(|side| 0.5 * side) }],
        task: Task::Motion(task),
    }
}

#[test]
fn a_motion_that_is_stopped_goes_on_bit_for_bit() {
    compare(&BoxStudy::Rectangle(motion([1.0, 0.5], [7, 5])));
    compare(&BoxStudy::Box(motion([1.0, 0.5, 0.75], [3, 2, 4])));
}

/// The displacement is put away several times, and a step that was chosen is kept.
#[test]
fn a_flow_that_is_stopped_goes_on_bit_for_bit() {
    let grid = BoxGrid::cells([16, 12], [1.0 / 16.0, 1.0 / 12.0]).unwrap_or_else(|error| panic!("{error}"));
    let form = Form::Gaussian { value: [40.0, 10.0], at: [0.4, 0.45], radius: 0.3 };
    let task = FlowTask { grid, modes: None, duration: 1.0, step: None, least_jacobian: 0.6 };
    let fields = BoxFields {
        sides: [1.0, 1.0],
        walls: Walls::Sliding,
        lame: LameParameters::new(0.0, 1.0).unwrap_or_else(|error| panic!("{error}")),
        loads: vec![Load { form, span: [0.0, f64::INFINITY], course: vec![1.0] }],
        probes: vec![],
        task: Task::Flow(task),
    };
    let digits = compare(&BoxStudy::Rectangle(fields));
    assert!(digits.contains("regriddings: 2"), "the displacement is put away less than twice");
}

#[test]
fn a_checkpoint_of_another_study_and_one_that_was_changed_are_refused() {
    let study = BoxStudy::Rectangle(motion([1.0, 0.5], [3, 3]));
    let mut last = Last::default();
    let _ = study.run_with_checkpoints(None, Some(&mut last), &mut |_| ControlFlow::Break(()));
    let other = BoxStudy::Rectangle(motion([1.0, 0.5], [3, 4]));
    let words = |error: Result<(), piola_simulation::SimulationError>| error.err().map(|error| error.to_string());
    assert!(words(last.read().check(&other)).is_some_and(|text| text.contains("of another run")));
    let text = last.0.clone().unwrap_or_default();
    last.0 = Some(text.replacen("\"steps\":", "\"steps\":1", 1));
    assert!(words(last.read().check(&study)).is_some_and(|text| text.contains("was changed")));
}
