//! Figures, read as a reader does: points between the marks of the axes, sizes, legends.

use core::f64::consts::PI;

use piola_charts::FINE;
use piola_measured::MeasuredError;
use piola_measured::fitting::{self, Measurements};
use piola_measured::rheology::{
    FlowKind, Measured, Noise, RecoveryRequest, Request, compare, recover, recover_without_ends, recover_without_slip,
};
use piola_testkit::svg::{Element, elements};
use piola_testkit::{Tol, assert_each_close};

use crate::newtonian::written;
use crate::rheology::csv;

/// The value of a mark of a logarithmic axis, such as 10⁻³.
fn power_of_ten(mark: &Element) -> Option<f64> {
    let digits = mark.text().strip_prefix("10")?.chars().map(|c| match c {
        '⁻' => Some('-'),
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip('0'..='9').find(|(above, _)| *above == c).map(|(_, digit)| digit),
    });
    digits.collect::<Option<String>>()?.parse().ok().map(|exponent| 10.0_f64.powi(exponent))
}

/// What a panel with logarithmic axes shows, in the units of its axes.
struct LogPanel {
    marks: Vec<[f64; 2]>,
    curves: Vec<Vec<[f64; 2]>>,
}

/// The panel below these words.
fn panel(svg: &str, title: &str) -> LogPanel {
    let all = elements(svg);
    let from = all.iter().position(|element| element.text() == title).unwrap_or_else(|| panic!("{title}"));
    let size = all[from].get("font-size");
    // The next panel begins with words of the same size.
    let inside =
        all[from + 1..].iter().take_while(|element| element.tag() != "text" || element.get("font-size") != size);
    let inside: Vec<&Element> = inside.collect();
    // Marks of an axis, by the side of their text that is at the axis.
    let axis = |anchor: &str, coordinate: &str| {
        let marks = inside.iter().filter(|element| element.tag() == "text" && element.get("text-anchor") == anchor);
        let mut marks: Vec<(f64, f64)> =
            marks.filter_map(|mark| Some((mark.number(coordinate), power_of_ten(mark)?.ln()))).collect();
        marks.sort_by(|a, b| a.1.total_cmp(&b.1));
        let [(a, low), .., (b, high)] = marks.as_slice() else { panic!("{title}: {marks:?}") };
        let (a, low, slope) = (*a, *low, (high - low) / (b - a));
        move |at: f64| (low + slope * (at - a)).exp()
    };
    let (across, up) = (axis("middle", "x"), axis("end", "y"));
    let place = |x: f64, y: f64| [across(x), up(y)];
    let circles = inside.iter().filter(|element| element.tag() == "circle");
    // Curves are two pixels wide, axes and what marks them one.
    let width = (2 * FINE).to_string();
    let lines = inside.iter().filter(|element| element.tag() == "polyline" && element.get("stroke-width") == width);
    let points = |line: &&Element| line.points().into_iter().map(|[x, y]| place(x, y)).collect();
    LogPanel {
        marks: circles.map(|circle| place(circle.number("cx"), circle.number("cy"))).collect(),
        curves: lines.map(points).collect(),
    }
}

const READ: Tol =
    Tol::stated(0.01, "an eighth of a pixel, in logarithmic axes with fifty pixels or more for a factor of ten");

fn assert_read(what: &str, found: &[[f64; 2]], expected: &[[f64; 2]]) {
    assert_each_close(what, found.as_flattened(), expected.as_flattened(), READ);
}

/// Thirteen stresses from 3 Pa to 3 kPa, evenly in the logarithm.
fn stresses() -> impl Iterator<Item = f64> {
    (0..13).map(|i| 3.0 * 10.0_f64.powf(0.25 * f64::from(i)))
}

fn table(
    name: &str,
    kind: FlowKind,
    head: &str,
    rows: impl Iterator<Item = [f64; 2]>,
) -> Result<Measured, MeasuredError> {
    Measured::parse(name, &csv(head, rows), kind, &[])
}

/// All texts stand within the figure.
fn assert_within(svg: &str) {
    let all = elements(svg);
    let size: Vec<f64> = all[0].get("viewBox").split(' ').map(|x| x.parse().expect("a number")).collect();
    let texts: Vec<&Element> = all.iter().filter(|element| element.tag() == "text").collect();
    assert!(10 < texts.len(), "{} texts", texts.len());
    for text in texts {
        let (x, y) = (text.number::<f64>("x"), text.number::<f64>("y"));
        assert!((0.0..=size[2]).contains(&x) && (0.0..=size[3]).contains(&y), "`{}` at {x}, {y}", text.text());
    }
}

/// The legend's names stand within the figure, on the right of all that is drawn.
fn assert_legend(svg: &str, names: &[&str]) {
    assert_within(svg);
    let all = elements(svg);
    let drawn = all.iter().filter(|element| element.tag() == "circle").map(|circle| circle.number("cx"));
    let right = drawn.fold(0.0, f64::max);
    assert!(0.0 < right);
    for name in names {
        let text = all.iter().find(|element| element.text().starts_with(name)).unwrap_or_else(|| panic!("{name}"));
        assert!(right < text.number::<f64>("x"), "{name}");
    }
}

#[test]
fn discharges_of_pipes_that_slip_are_drawn_as_rates_over_stresses() -> Result<(), MeasuredError> {
    // A viscosity of 2 and the slip u = 25 µm/s for each Pa: 4Q/(πR³) = τ/2 + 4 u/R.
    let radii = [0.5e-3, 1e-3, 2e-3];
    let apparent = |radius: f64| stresses().map(move |t| [t, t * (0.5 + 1e-4 / radius)]);
    let pipe = |radius: f64| {
        let rows = apparent(radius).map(|[t, rate]| [2.0 * t / radius, 0.25 * PI * radius.powi(3) * rate]);
        table("pipe.csv", FlowKind::Pipe, &format!("# radius: {radius} m\npressure_gradient,discharge"), rows)
    };
    let pipes = radii.map(pipe).into_iter().collect::<Result<Vec<_>, _>>()?;
    let recovery = recover_without_slip(&pipes, &RecoveryRequest::default())?;
    let [svg] = written("slip", ["flow-curve.svg"], |folder| recovery.write(folder, &pipes));
    assert_within(&svg);
    let raw = panel(&svg, "without correction");
    let expected: Vec<Vec<[f64; 2]>> = radii.iter().map(|radius| apparent(*radius).collect()).collect();
    assert_read("marks", &raw.marks, &expected.concat());
    assert_eq!(raw.curves.len(), 3);
    raw.curves.iter().zip(&expected).for_each(|(curve, expected)| assert_read("curve", curve, expected));
    let flow = panel(&svg, "flow curve with its band");
    assert_read("without slip", &flow.marks, &stresses().map(|t| [t, 0.5 * t]).collect::<Vec<_>>());
    let slip = panel(&svg, "slip at the walls");
    assert_read("slip", &slip.marks, &stresses().map(|t| [t, 25e-6 * t]).collect::<Vec<_>>());
    Ok(())
}

#[test]
fn pressures_of_capillaries_with_ends_are_drawn_as_rates_over_stresses() -> Result<(), MeasuredError> {
    // A viscosity of 2 in capillaries of a radius of 1 mm, whose ends take 4 τ as 2 mm more would: Δp = 2 τ (L + 2 mm)/R.
    let (radius, lengths) = (1e-3, [10e-3, 20e-3, 40e-3]);
    let apparent = |length: f64| stresses().map(move |t| [t * (1.0 + 2e-3 / length), 0.5 * t]);
    let capillary = |length: f64| {
        let rows = apparent(length).map(|[t, rate]| [0.25 * PI * 1e-9 * rate, 2.0 * t * length / radius]);
        let head = format!("# radius: {radius} m\n# length: {length} m\ndischarge,pressure_difference");
        table("capillary.csv", FlowKind::Capillary, &head, rows)
    };
    let capillaries = lengths.map(capillary).into_iter().collect::<Result<Vec<_>, _>>()?;
    let recovery = recover_without_ends(&capillaries, &RecoveryRequest::default())?;
    let [svg] = written("lost", ["flow-curve.svg"], |folder| recovery.write(folder, &capillaries));
    assert_within(&svg);
    let raw = panel(&svg, "without correction");
    let expected: Vec<Vec<[f64; 2]>> = lengths.iter().map(|length| apparent(*length).collect()).collect();
    assert_read("marks", &raw.marks, &expected.concat());
    let flow = panel(&svg, "flow curve with its band");
    assert_read("without ends", &flow.marks, &stresses().map(|t| [t, 0.5 * t]).collect::<Vec<_>>());
    let ends = panel(&svg, "pressure lost at the ends");
    assert_read("ends", &ends.marks, &stresses().map(|t| [t, 4.0 * t]).collect::<Vec<_>>());
    Ok(())
}

#[test]
fn the_smoothed_curve_of_noisy_discharges_is_drawn_near_that_without_noise() -> Result<(), MeasuredError> {
    // A viscosity of 2 in a pipe of a radius of 1 mm, every discharge 15 % too large or too small in turn.
    let exact: Vec<[f64; 2]> = stresses().map(|t| [2.0 * t / 1e-3, PI * 1e-9 * t / 8.0]).collect();
    let factors = [1.15, 0.85].into_iter().cycle();
    let rows: Vec<[f64; 2]> = exact.iter().zip(factors).map(|([c, q], factor)| [*c, q * factor]).collect();
    let head = "# radius: 1 mm\npressure_gradient,discharge";
    let measured = table("noisy.csv", FlowKind::Pipe, head, rows.iter().copied())?;
    let mut request = RecoveryRequest::default();
    request.noise = Noise::Relative(0.15);
    let recovery = recover(&measured, &request)?;
    let tables = core::slice::from_ref(&measured);
    let [svg] = written("noisy", ["flow-curve.svg"], |folder| recovery.write(folder, tables));
    let data = panel(&svg, "measured and smoothed");
    assert_read("marks", &data.marks, &rows);
    let [smooth] = data.curves.as_slice() else { panic!("{} curves", data.curves.len()) };
    let near = Tol::stated(0.1, "less than the noise of 15 %: neighbours make up for each other");
    assert_each_close("smoothed", smooth.as_flattened(), exact.as_flattened(), near);
    Ok(())
}

#[test]
fn thrusts_that_pull_and_push_are_drawn_alike() -> Result<(), MeasuredError> {
    // Sizes of normal stresses are drawn: N₁ − N₂ = ±k^1.5 between plates of 20 mm at 0.5 mm, F = ±πR² k^1.5/3.5.
    let drawn = |sign: f64| -> Result<String, MeasuredError> {
        let rate = |i: u32| 10.0_f64.powf(0.25 * f64::from(i));
        let rows = (0..13).map(rate).map(|k| [0.025 * k, sign * PI * 4e-4 * k.powf(1.5) / 3.5]);
        let head = "# radius: 20 mm\n# gap: 0.5 mm\nangular_velocity,thrust";
        let measured = table("plates.csv", FlowKind::Plates, head, rows)?;
        let recovery = recover(&measured, &RecoveryRequest::default())?;
        let name = if sign < 0.0 { "pull" } else { "push" };
        let tables = core::slice::from_ref(&measured);
        let [svg] = written(name, ["normal-stress.svg"], |folder| recovery.write(folder, tables));
        Ok(svg)
    };
    let push = drawn(1.0)?;
    assert_within(&push);
    assert!(push.contains("<polygon"), "there is no band");
    assert!(push == drawn(-1.0)?, "figures differ");
    Ok(())
}

#[test]
fn fluids_are_named_beside_their_curves() -> Result<(), MeasuredError> {
    // τ = 3 √k: the response and the viscosity 3/√k, drawn over the rate.
    let rows = || (0..13).map(|i| 10.0_f64.powf(0.25 * f64::from(i))).map(|k| [k, 3.0 * k.sqrt()]);
    let measured = table("power.csv", FlowKind::Curve, "shear_rate,shear_stress", rows())?;
    let comparison = compare(&measured, &Request::of(vec!["power-law".parse()?, "newtonian".parse()?]))?;
    let [svg] = written("fluids", ["fit.svg"], |folder| comparison.write(folder, &measured));
    assert_legend(&svg, &["power-law", "newtonian"]);
    let data = panel(&svg, "measured and fitted");
    let rows: Vec<[f64; 2]> = rows().collect();
    assert_read("marks", &data.marks, &rows);
    assert_read("power law", &data.curves[0], &rows);
    let viscosity = panel(&svg, "viscosity");
    assert_eq!(viscosity.curves[0].len(), 121);
    viscosity.curves[0].iter().for_each(|[k, eta]| assert_read("viscosity", &[[*k, *eta]], &[[*k, 3.0 / k.sqrt()]]));
    Ok(())
}

#[test]
fn a_figure_of_laws_grows_by_panels_of_one_size_three_beside_each_other() -> Result<(), MeasuredError> {
    let modes = ["uniaxial", "equibiaxial", "planar", "simple shear"];
    let drawn = |count: usize| -> Result<[u32; 2], MeasuredError> {
        let rows = modes.iter().take(count).flat_map(|mode| [1.5, 2.0, 3.0].map(|x| format!("{mode},{x},{x}\n")));
        let text = format!("mode,stretch,stress\n{}", rows.collect::<String>());
        let measurements = Measurements::parse("rubber.csv", &text)?;
        let comparison = fitting::compare(&measurements, &fitting::Request::of(vec!["neo-hookean".parse()?]))?;
        let name = format!("panels-{count}");
        let [svg] = written(&name, ["fit.svg"], |folder| comparison.write(folder, &measurements));
        assert_legend(&svg, &["neo-hookean"]);
        let all = elements(&svg);
        assert_eq!(all.iter().filter(|element| element.tag() == "circle").count(), 3 * count);
        Ok(["width", "height"].map(|side| all[0].get(side).parse().expect("a whole number")))
    };
    let [one, two, three, four] = [drawn(1)?, drawn(2)?, drawn(3)?, drawn(4)?];
    let panel = [two[0] - one[0], four[1] - three[1]];
    assert!(panel.iter().all(|side| (200..500).contains(side)), "{panel:?}");
    assert_eq!([two, three], [1, 2].map(|more| [one[0] + more * panel[0], one[1]]));
    assert_eq!(four, [three[0], three[1] + panel[1]]);
    Ok(())
}
