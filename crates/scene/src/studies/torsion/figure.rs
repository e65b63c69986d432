//! Tables and the figure.

use core::fmt::Write as _;

use super::{RodCurves, TwistedRod, TwistedState};
use crate::studies::panel::{Panel, largest, prefixed};
use crate::studies::stresses::{COMPONENTS, stress_table};
use piola_charts::{figure, format_short};

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &RodCurves, asked: &TwistedRod, title: &str, name: &str) -> Option<String> {
    match name {
        "torsion.csv" => Some(table(found)),
        "stress.csv" => Some(stress_table(
            found.stresses.iter().map(|(state, particles)| (state.replace(',', " at"), particles.as_slice())),
        )),
        "torsion.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn table(found: &RodCurves) -> String {
    let mut text =
        String::from("twist_rad_per_m,held_torque_N_m,held_axial_force_N,pulled_torque_N_m,pulled_axial_stretch\n");
    for TwistedState { held, pulled } in &found.states {
        let _ = writeln!(
            text,
            "{:?},{:?},{:?},{:?},{:?}",
            held.twist, held.torque, held.axial_force, pulled.torque, pulled.axial_stretch
        );
    }
    text
}

fn drawing(found: &RodCurves, asked: &TwistedRod, title: &str) -> String {
    const TWIST: &str = "twist ψ (rad/m)";
    let over = |pick: fn(&TwistedState) -> f64, unit: f64| {
        found.states.iter().map(move |state| (state.held.twist, pick(state) / unit))
    };
    let pulled = if asked.axial_force.abs() <= 0.0 {
        "no axial force".to_string()
    } else {
        let (newton, unit) = prefixed("N", asked.axial_force);
        format!("axial force {:.4} {newton}", asked.axial_force / unit)
    };
    let held = format!("held at λ = {}", asked.axial_stretch);
    let both = found.states.iter().flat_map(|state| [state.held.torque, state.pulled.torque]);
    let (moment, unit) = prefixed("N m", largest(both));
    let mut torque = Panel::new("torque", TWIST, format!("M ({moment})"))
        .curve(&held, 0, over(|state| state.held.torque, unit))
        .curve(&pulled, 1, over(|state| state.pulled.torque, unit));
    for point in &found.under_torque {
        torque = torque.mark("", 2, (point.parameter, point.load / unit), 0.0 < point.slope);
    }
    let (newton, unit) = prefixed("N", largest(found.states.iter().map(|state| state.held.axial_force)));
    let force = Panel::new(&format!("axial force, {held}"), TWIST, format!("N ({newton})")).curve(
        "",
        0,
        over(|state| state.held.axial_force, unit),
    );
    let stretch = Panel::new(&format!("axial stretch, {pulled}"), TWIST, "λ").curve(
        "",
        1,
        over(|state| state.pulled.axial_stretch, 1.0),
    );
    let (pascal, unit) = prefixed("Pa", largest(found.stresses.iter().flat_map(|(_, at)| at).flat_map(|at| at.stress)));
    let shown = found.stresses.last();
    let twist = found.under_torque.last().map_or(asked.twist, |point| point.parameter);
    let name = format!("stress at {} rad/m, {pulled}", format_short(twist));
    let (metre, length) = prefixed("m", asked.tube.outer());
    let mut through = Panel::new(&name, format!("R ({metre})"), format!("T ({pascal})"));
    for (index, component) in COMPONENTS.iter().enumerate() {
        let points = shown.into_iter().flat_map(|(_, particles)| particles);
        through =
            through.curve(component, index + 2, points.map(|at| (at.reference / length, at.stress[index] / unit)));
    }
    figure((1080, 860), title, &|area| {
        let parts = area.split_evenly((2, 2));
        for (panel, part) in [&torque, &through, &force, &stretch].into_iter().zip(&parts) {
            panel.draw(part)?;
        }
        Ok(())
    })
}
