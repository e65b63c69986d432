//! Scenes run from a text.

use std::ops::ControlFlow;

use numpy::{PyArray1, PyArrayMethods};
use piola_scene::output::Summary;
use piola_scene::run::Run;
use piola_scene::{Document, Plan, SceneFile, run};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::refused;

/// Steps between looks at the keyboard.
const PATIENCE: u64 = 256;

/// Runs a scene: names, times, positions, velocities, coordinates as flat arrays, and the summary as JSON.
#[pyfunction]
pub(crate) fn run_scene<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyDict>> {
    let document = Document::parse("scene", text);
    let scene = match SceneFile::from_document(&document).map_err(refused)? {
        SceneFile::Motion(scene) => scene,
        SceneFile::Study(_) => {
            return Err(refused("this scene is a study; the program `piola` runs studies, Python runs motions"));
        }
    };
    let (run, summary, interrupt) = py.detach(|| {
        let plan = Plan::of(&scene);
        let (mut steps, mut interrupt) = (0_u64, None);
        let run = run::run(&scene, &plan, |_| {
            steps += 1;
            if steps.is_multiple_of(PATIENCE)
                && let Err(error) = looked_at_keyboard()
            {
                interrupt = Some(error);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        let summary = Summary::of(&scene, &plan, &run).to_json();
        (run, summary, interrupt)
    });
    match interrupt {
        Some(error) => Err(error),
        None => arrays(py, &run, &summary),
    }
}

/// An error where the user has pressed Ctrl-C.
#[expect(clippy::redundant_closure_for_method_calls, reason = "the method lives as long as one token only")]
fn looked_at_keyboard() -> PyResult<()> {
    Python::attach(|py| py.check_signals())
}

/// The record of a run as arrays.
fn arrays<'py>(py: Python<'py>, run: &Run, summary: &str) -> PyResult<Bound<'py, PyDict>> {
    let history = &run.history;
    let instants = history.times.len();
    let bodies = history.names.len();
    let result = PyDict::new(py);
    result.set_item("names", history.names.clone())?;
    result.set_item("coordinate_names", history.coordinate_names.clone())?;
    result.set_item("t", PyArray1::from_slice(py, &history.times))?;
    for (name, vectors) in [("positions", &history.positions), ("velocities", &history.velocities)] {
        if vectors.len() == instants {
            let flat: Vec<f64> = vectors.iter().flatten().flatten().copied().collect();
            result.set_item(name, PyArray1::from_vec(py, flat).reshape([instants, bodies, 3])?)?;
        }
    }
    if history.coordinates.len() == instants {
        let width = history.coordinates.first().map_or(0, Vec::len);
        let flat: Vec<f64> = history.coordinates.iter().flatten().copied().collect();
        result.set_item("coordinates", PyArray1::from_vec(py, flat).reshape([instants, width])?)?;
    }
    let energies: Vec<f64> = history.invariants.iter().map(|invariants| invariants.energy).collect();
    result.set_item("energy_times", PyArray1::from_vec(py, history.invariants.iter().map(|x| x.time).collect()))?;
    result.set_item("energy", PyArray1::from_vec(py, energies))?;
    result.set_item("summary", summary)?;
    Ok(result)
}
