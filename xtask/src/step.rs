//! Steps as data, and the one loop that runs them.

use std::time::{Duration, Instant};

use xshell::Cmd;

/// One thing to run or to check.
pub(crate) struct Step<'a> {
    pub(crate) name: String,
    pub(crate) command: Command<'a>,
    /// Shown when the step fails: what it means and what to do.
    pub(crate) why_it_failed: &'static str,
}

/// A program, or a check inside this one.
pub(crate) enum Command<'a> {
    Program(Cmd<'a>),
    Check(Box<dyn FnOnce() -> Outcome + 'a>),
}

/// A line to print, or every problem found.
pub(crate) type Outcome = Result<String, Vec<String>>;

impl<'a> Step<'a> {
    pub(crate) fn program(name: &str, command: Cmd<'a>, why_it_failed: &'static str) -> Self {
        Self { name: name.to_owned(), command: Command::Program(command), why_it_failed }
    }

    pub(crate) fn check(name: &str, check: impl FnOnce() -> Outcome + 'a, why_it_failed: &'static str) -> Self {
        Self { name: name.to_owned(), command: Command::Check(Box::new(check)), why_it_failed }
    }

    fn run(self) -> bool {
        match self.command {
            Command::Program(command) => match command.run() {
                Ok(()) => true,
                Err(error) => {
                    eprintln!("{error}");
                    false
                }
            },
            Command::Check(check) => match check() {
                Ok(line) => {
                    eprintln!("{line}");
                    true
                }
                Err(problems) => {
                    for problem in &problems {
                        eprintln!("error: {problem}");
                    }
                    eprintln!("{} problem(s)", problems.len());
                    false
                }
            },
        }
    }
}

/// Runs the steps in order and prints what each took; true if all passed.
///
/// Stops at the first failure unless `keep_going`. Everything of ours goes to the error stream, so that a command's own
/// output (JSON, say) stays clean.
pub(crate) fn run_all(steps: Vec<Step<'_>>, keep_going: bool) -> bool {
    let count = steps.len();
    let start = Instant::now();
    let mut rows: Vec<(String, Duration, bool)> = Vec::new();
    for (index, step) in steps.into_iter().enumerate() {
        let (name, why) = (step.name.clone(), step.why_it_failed);
        eprintln!("\n==> [{}/{count}] {name}", index + 1);
        let began = Instant::now();
        let passed = step.run();
        rows.push((name, began.elapsed(), passed));
        if !passed {
            eprintln!("note: {why}");
            if !keep_going {
                break;
            }
        }
    }
    if 1 < count {
        eprintln!();
        for (name, time, passed) in &rows {
            eprintln!("{:>8.1} s  {}  {name}", time.as_secs_f64(), if *passed { "ok    " } else { "FAILED" });
        }
        if rows.len() < count {
            eprintln!("            {} step(s) not run; `--keep-going` runs them all", count - rows.len());
        }
        eprintln!("{:>8.1} s  total", start.elapsed().as_secs_f64());
    }
    rows.iter().all(|(_, _, passed)| *passed)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::{Step, run_all};

    fn count_run(keep_going: bool) -> (bool, u32) {
        let ran = Cell::new(0);
        let step = |passes: bool| {
            let ran = &ran;
            Step::check(
                "step",
                move || {
                    ran.set(ran.get() + 1);
                    if passes { Ok(String::new()) } else { Err(vec!["wrong".into()]) }
                },
                "it was made to fail",
            )
        };
        let passed = run_all(vec![step(true), step(false), step(true)], keep_going);
        (passed, ran.get())
    }

    #[test]
    fn a_failed_step_stops_the_list_unless_told_to_keep_going() {
        assert_eq!(count_run(false), (false, 2));
        assert_eq!(count_run(true), (false, 3));
    }
}
