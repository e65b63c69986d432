//! What figures show stands where the numbers say.

use core::f64::consts::PI;

use piola_scene::studies::{Findings, SolidFindings};
use piola_testkit::svg::Element;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::support::{ORBIT, replaced};
use crate::svg::{FINE, Svg, extent, figure, trajectory};

const BLUE: &str = "#0072B2";
const INK: &str = "#282828";
const WHITE: &str = "#FFFFFF";
/// The darkest colour of maps.
const DARK: &str = "#440154";

const BLOCK: &str = "[bending]\nthickness = 2.0\nlength = 8.0\nheight = 3.0\nangle = \"90 deg\"\n\
                     [law]\ntype = \"neo-hookean\"\nshear_modulus = \"2 kPa\"\n";
const TUBE: &str = "[laminated_tube]\ninner_radius = 1.0\ninner_pressure = \"1.2 kPa\"\n\
                    [law]\ntype = \"neo-hookean\"\nshear_modulus = \"8 kPa\"\n\
                    [[layer]]\nthickness = 0.4\nhoop_growth = 1.1\n[[layer]]\nthickness = 0.6\n";

/// Places in the drawing, which are whole: one and that with which it is compared are off by 3/2 together.
#[track_caller]
fn assert_drawn(what: &str, found: &[f64], expected: &[f64]) {
    let paper = 1e4;
    let tolerance = Tol::stated(1.5e-4, "3/2 of the ten thousand coordinates of a figure, which are whole");
    let differences: Vec<f64> = found.iter().zip(expected).map(|(found, expected)| found - expected).collect();
    assert_eq!(found.len(), expected.len(), "{what}");
    assert_close_at_scale(what, &differences, &vec![0.0; expected.len()], paper, tolerance);
}

fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

/// The extents of places along both axes.
fn extents(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    [0, 1].map(|k| extent(points.iter().map(|point| point[k])))
}

/// The plot of a figure, as far as the lines of its grid reach.
fn plot(svg: &Svg) -> [[f64; 2]; 2] {
    let ends = |names: [&str; 2]| extent(svg.all("line").flat_map(|line| names.map(|name| line.number(name))));
    [ends(["x1", "x2"]), ends(["y1", "y2"])]
}

#[test]
fn circular_orbit_fills_the_plot_but_for_its_air() {
    let svg = trajectory(&replaced(&replaced(ORBIT, "eccentricity = 0.5", "eccentricity = 0.0"), "= 2\n", "= 1\n"));
    let path: Vec<[f64; 2]> = svg.curves(BLUE, 1.0).concat();
    let ([across, up], [left_right, top_bottom]) = (extents(&path), plot(&svg));
    let (width, height) = (across[1] - across[0], up[1] - up[0]);
    assert_drawn("middle", &[middle(across), middle(up)], &[middle(left_right), middle(top_bottom)]);
    let tolerance = Tol::stated(2e-2, "labels and margins take 70 pixels of 584, and 75 are reckoned");
    assert_close("height", &[height], &[(top_bottom[1] - top_bottom[0]) / 1.08], tolerance);
    assert_close("width", &[width], &[height], tolerance);
}

#[test]
fn bodies_of_a_far_smaller_reach_have_a_panel_but_a_sun_by_itself_has_none() {
    let body = |name: &str, x: f64| {
        format!("[[body]]\nname = '{name}'\ngm = 1e-9\nposition = [{x:?}, 0.0, 0.0]\nvelocity = [0.0, 0.0, 0.0]\n")
    };
    let text = ["[gravity]\n", &body("sun", 1.0), &body("near", 100.0), &body("far", 1e4), "[time]\nend = 1.0\n"];
    let widths = [text.concat(), text.concat() + &body("nearer", 60.0)].map(|text| {
        let svg = trajectory(&text);
        svg.all("svg").map(|root| root.number::<f64>("width")).sum::<f64>()
    });
    assert_eq!(widths.map(f64::to_bits), [780.0, 1180.0].map(f64::to_bits));
}

#[test]
fn axes_count_in_the_units_that_they_name() {
    for (text, name, units) in [
        (BLOCK, "bending.svg", ["M (kN m)", "T (kPa)", "T_θθ (kPa)"]),
        (TUBE, "tube.svg", ["T (kPa)", "T_θθ (kPa)", "p (kPa)"]),
    ] {
        let (_, svg) = figure(text, name);
        let shown: Vec<&str> = svg.all("text").map(Element::text).collect();
        for unit in units {
            assert!(shown.contains(&unit), "{unit} is not in {shown:?}");
        }
        // A unit has a prefix so that its numbers stay below a thousand.
        let numbers: Vec<f64> = shown.iter().filter_map(|text| text.parse().ok()).collect();
        assert!(20 < numbers.len() && numbers.iter().all(|number| number.abs() < 1000.0), "{numbers:?}");
    }
}

#[test]
fn lines_in_a_bent_block_cut_its_thickness_into_equal_parts() {
    let (run, svg) = figure(BLOCK, "bending.svg");
    let Findings::Solid(SolidFindings::Bending(found)) = &run.findings else { panic!("a block") };
    let [inner, outer] = found.shown_states[0].radii;
    // The reference beside it is 2 m thick, its upper face as high as the outermost place.
    let [_, [top, bottom]] = extents(&svg.curves(INK, 2.0).concat());
    let metre = (bottom - top) / 2.0;
    let arcs = svg.curves(INK, 1.0).into_iter().filter(|curve| 6 < curve.len());
    let mut heights: Vec<f64> = arcs.map(|arc| extents(&arc)[1][0]).collect();
    heights.sort_by(f64::total_cmp);
    // No volume changes: quarters of the thickness are quarters of the area.
    let radius = |quarter: f64| (outer * outer - 0.25 * quarter * (outer * outer - inner * inner)).sqrt();
    let expected = [0.0, 1.0, 2.0, 3.0, 4.0].map(|quarter| top + metre * (outer - radius(quarter)));
    assert_drawn("arcs", &heights, &expected);
}

#[test]
fn colours_of_a_stress_go_evenly_from_pressure_over_white_to_tension() {
    let (_, svg) = figure(BLOCK, "bending.svg");
    let channels = |element: &Element| -> Vec<f64> {
        let fill = element.get("fill").trim_start_matches('#').to_string();
        let byte =
            |from: usize| u8::from_str_radix(&fill[from..from + 2], 16).unwrap_or_else(|error| panic!("{error}"));
        [0, 2, 4].map(|from| f64::from(byte(from))).to_vec()
    };
    // The first rectangle is the paper.
    let bar: Vec<Vec<f64>> = svg.all("rect").skip(1).map(channels).collect();
    let last = bar.len() - 1;
    assert!(8 < last && last.is_multiple_of(2), "{last}");
    // Blue presses and red pulls.
    assert!(bar[0][0] < 64.0 && bar[last][2] < 64.0);
    for (step, found) in bar.iter().enumerate() {
        let share = 2.0 * step as f64 / last as f64 - 1.0;
        let end = if share < 0.0 { &bar[0] } else { &bar[last] };
        let expected: Vec<f64> = end.iter().map(|end| 255.0 + share.abs() * (end - 255.0)).collect();
        assert_close_at_scale("colour", found, &expected, 255.0, Tol::stated(0.501 / 255.0, "channels are whole"));
    }
}

#[test]
fn map_of_a_box_shows_its_middle_and_no_more() {
    // Along its wave (1, 0, 2), u = f/(25 π²): in the plane z = 1/2 m the largest displacement along x is 24 mm.
    let force = 25.0 * PI * PI * 0.024;
    let text = format!(
        "[box]\ntype = 'static'\nsides = [1.0, 0.5, 1.0]\npoints = [9, 5, 7]\nlocation = 'nodes'\n\
         first_lame_parameter = 2.0\nshear_modulus = 1.5\n\
         [[load]]\ntype = 'mode'\nindices = [1, 0, 2]\nforce_per_volume = [{force:?}, 0.0, {:?}]\n",
        2.0 * force
    );
    let (_, svg) = figure(&text, "displacement.svg");
    let title = svg.all("text").map(Element::text).next().unwrap_or("");
    // The largest is drawn as 0.06 of the longer side.
    assert!(title.ends_with(", z = 0.5 m (grid: displacement times 2.5)"), "{title}");
    let outline = extents(&svg.curves(INK, 2.0).concat());
    let Some(ground) = svg.all("polygon").find(|polygon| polygon.get("fill") == DARK) else { panic!("no map") };
    assert_drawn("ground", &extents(&ground.points()).concat(), &outline.concat());
}

#[test]
fn lines_across_a_push_stay_straight_and_even() {
    let flow = |sides: &str| {
        let text = format!(
            "[box]\ntype = 'flow'\nsides = {sides}\npoints = [16, 8]\nshear_viscosity = 1.0\nduration = 0.1\n\
             [[load]]\ntype = 'mode'\nindices = [1, 0]\nforce_per_volume = [1.0, 0.0]\n"
        );
        figure(&text, "flow.svg").1
    };
    let svg = flow("[1.0, 0.5]");
    let [_, [top, bottom]] = extents(&svg.curves(INK, 2.0).concat());
    let lines = svg.curves(WHITE, 1.0);
    // 15 lines across the push, and 7 along it, each the lower border of what lies above.
    assert_eq!(lines.len(), 22);
    let lower: Vec<f64> = lines[15..].iter().map(|line| extents(line)[1][1]).collect();
    let expected: Vec<f64> = (1..8).map(|line| bottom + f64::from(line) / 8.0 * (top - bottom)).collect();
    assert_drawn("lines", &lower, &expected);
    // However narrow it is, one line goes along the middle.
    assert_eq!(flow("[1.0, 0.001]").curves(WHITE, 1.0).len(), 16);
}

#[test]
fn lattice_below_a_circuit_lies_around_it_in_the_middle_of_its_half() {
    let text = "[dislocation]\ntype = \"uniform\"\ndensity = \"0.5 1/m\"\nradii = [0.5, 2.0]\n";
    let (_, svg) = figure(text, "burgers.svg");
    let half = 1120.0 / 2.0 * FINE;
    let left = |curves: Vec<Vec<[f64; 2]>>| -> Vec<[f64; 2]> {
        curves.into_iter().filter(|curve| curve.iter().all(|point| point[0] < half)).flatten().collect()
    };
    let faint = |line: &&Element| line.get("stroke") == INK && line.get("opacity") == "0.25";
    let lattice = extents(&left(svg.all("polyline").filter(faint).map(Element::points).collect()));
    let circuit = extents(&left(svg.curves(BLUE, 3.0).into_iter().filter(|curve| 6 < curve.len()).collect()));
    assert_drawn("circuit", &circuit.map(middle), &lattice.map(middle));
    // Twelve pixels of margin at the left of the figure, and ten around the plot.
    assert_drawn("half", &[middle(lattice[0])], &[0.5 * (12.0 + 10.0 + 560.0 - 10.0) * FINE]);
    assert!(circuit[0][1] - circuit[0][0] < lattice[0][1] - lattice[0][0]);
}
