//! Tables and the figure.

use core::fmt::Write as _;

use super::{Balloon, BalloonCurve, is_stable};
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::stresses::stress_table;
use piola_charts::figure;

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &BalloonCurve, asked: &Balloon, title: &str, name: &str) -> Option<String> {
    match name {
        "curve.csv" => Some(curve_table(found, asked)),
        "states.csv" => Some(states_table(found, asked)),
        "stress.csv" => Some(stress_table(named_states(found))),
        "balloon.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn curve_table(found: &BalloonCurve, asked: &Balloon) -> String {
    let mut text = String::from("stretch,pressure_Pa,slope_Pa,thin_wall_pressure_Pa\n");
    for point in &found.curve {
        let thin = asked.thin_wall_pressure(point.parameter);
        let _ = writeln!(text, "{:?},{:?},{:?},{thin:?}", point.parameter, point.load, point.slope);
    }
    text
}

fn states_table(found: &BalloonCurve, asked: &Balloon) -> String {
    let mut text = String::from("state,stretch,pressure_Pa,slope_Pa,inner_radius_m,outer_radius_m\n");
    let [inner, outer] = asked.radii();
    let limits = found.limits.iter().map(|state| (if found.is_maximum(state) { "maximum" } else { "minimum" }, state));
    let states = found.states.iter().map(|state| (if is_stable(state) { "stable" } else { "unstable" }, state));
    for (kind, state) in limits.chain(states) {
        let place = inner * state.parameter;
        let far = (outer.powi(3) - inner.powi(3) + place.powi(3)).cbrt();
        let _ = writeln!(text, "{kind},{:?},{:?},{:?},{place:?},{far:?}", state.parameter, state.load, state.slope);
    }
    text
}

fn named_states(found: &BalloonCurve) -> impl Iterator<Item = (String, &[crate::studies::StressAt])> {
    let names = found.states.iter().map(|state| format!("λ = {:.4}", state.parameter));
    names.zip(found.stresses.iter().map(Vec::as_slice))
}

fn drawing(found: &BalloonCurve, asked: &Balloon, title: &str) -> String {
    let (pascal, unit) = prefixed("Pa", largest(found.curve.iter().map(|point| point.load)));
    let thin = found.curve.iter().map(|point| (point.parameter, asked.thin_wall_pressure(point.parameter) / unit));
    let mut pressure = Panel::new("pressure inside", "stretch of the inner face λ", format!("p ({pascal})"))
        .curve("this shell", 0, found.curve.iter().map(|point| (point.parameter, point.load / unit)))
        .dashed("thin wall", 11, thin);
    for limit in &found.limits {
        let place = (limit.parameter, limit.load / unit);
        pressure = if found.is_maximum(limit) {
            pressure.mark("maximum", 1, place, true)
        } else {
            pressure.mark_below("minimum", 1, place)
        };
    }
    if asked.pressure.is_some() {
        for (index, state) in found.states.iter().enumerate() {
            let name = format!("{}", index + 1);
            pressure = pressure.mark(&name, 2, (state.parameter, state.load / unit), is_stable(state));
        }
    }
    let [inner, outer] = asked.radii();
    let share = |reference: f64| (reference - inner) / (outer - inner);
    let mut wall = Panel::new("hoop stress through the wall", "(R − R_i)/(R_o − R_i)", "T_θθ over its mean");
    for (index, (name, particles)) in named_states(found).enumerate() {
        let name = if asked.pressure.is_some() { format!("{}: {name}", index + 1) } else { name };
        let mean = particles.iter().map(|at| at.stress[1]).sum::<f64>() / particles.len().max(1) as f64;
        wall = wall.curve(&name, index + 2, particles.iter().map(|at| (share(at.reference), at.stress[1] / mean)));
    }
    figure((1080, 500), title, &|area| {
        let parts = area.split_evenly((1, 2));
        pressure.draw(&parts[0])?;
        wall.draw(&parts[1])
    })
}
