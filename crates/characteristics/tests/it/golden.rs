//! Reference values of characteristics, caustics and ray maps.

use piola_characteristics::{CauchyProblem, FirstOrderPde, InitialManifold, ParameterInterval, Refinement};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

use super::systems::{Burgers, Circle, Eikonal, Line, Oscillator, Parabola, Product};

/// Characteristics integrated with a local error of 1e-13.
fn integrated() -> Tol {
    Tol::stated(1e-13, "a few dozen steps of local error 1e-13")
}

fn check<P: FirstOrderPde, M: InitialManifold>(case: &Value, equation: &P, manifold: &M, guess: [f64; 2]) {
    let name = text(&case["name"]);
    let s = text(&case["characteristic_parameter"]);
    let problem = CauchyProblem::new(equation, manifold, 2).unwrap().near(&guess).unwrap();
    for point in case["points"].as_array().unwrap() {
        let ray = problem.characteristic(&[number(&point["sigma"])], number(&point[s])).unwrap();
        assert_close(&format!("{name} x"), &ray.x, &vector(&point["x"]), integrated());
        assert_close_at_scale(&format!("{name} u"), &[ray.u], &[number(&point["u"])], 1.0, integrated());
        assert_close(&format!("{name} p"), &ray.xi, &vector(&point["p"]), integrated());
        assert_close(&format!("{name} J"), &[ray.determinant], &[number(&point["jacobian"])], integrated());
        // Φ is an integral; ∇u is divided by the ray map.
        assert!(ray.equation.abs() < 1e-12 && ray.gradient_residual < 1e-11, "{name} {ray:?}");
    }
    for point in case.get("caustic_points").and_then(Value::as_array).into_iter().flatten() {
        let (sigma, at) = (number(&point["sigma"]), number(&point["s"]));
        let caustic = problem.caustic_points(&[sigma], 0.0, 2.0 * at).unwrap();
        assert_eq!(caustic.len(), 1, "{name}");
        assert_close(&format!("{name} caustic s"), &[caustic[0].s], &[at], integrated());
        assert_close(&format!("{name} caustic x"), &caustic[0].x, &vector(&point["x"]), integrated());
        assert_close(&format!("{name} caustic u"), &[caustic[0].u], &[number(&point["u"])], integrated());
    }
}

fn with_case(mut visit: impl FnMut(&Value, &str)) {
    let golden = golden::load("characteristics");
    assert_eq!(golden.cases.len(), 9);
    for case in &golden.cases {
        visit(case, text(&case["name"]));
    }
}

#[test]
fn points_of_characteristics_equal_reference() {
    with_case(|case, name| {
        let p = &case["parameters"];
        match name {
            "eikonal_circle_outward" | "eikonal_circle_inward" => {
                let centre = vector(&p["centre"]);
                let outward = text(&p["direction"]) == "outward";
                let circle = Circle { radius: number(&p["R"]), centre: [centre[0], centre[1]], outward };
                check(case, &Eikonal, &circle, [0.0; 2]);
            }
            "eikonal_parabola_inside" => check(case, &Eikonal, &Parabola(number(&p["a"])), [0.0, 1.0]),
            "eikonal_parabola_outside" => check(case, &Eikonal, &Parabola(number(&p["a"])), [0.0, -1.0]),
            "product_ux_uy_u" => check(case, &Product, &Line::Square, [0.0; 2]),
            "burgers_sine" => check(case, &Burgers, &Line::Sine, [0.0; 2]),
            "burgers_gaussian" => check(case, &Burgers, &Line::Gaussian, [0.0; 2]),
            _ => {
                let line = Line::Quadratic([number(&p["a"]), number(&p["b"]), number(&p["c"])]);
                let oscillator = Oscillator { mass: number(&p["m"]), omega: number(&p["omega"]) };
                check(case, &oscillator, &line, [0.0; 2]);
            }
        }
    });
}

/// The first loss on the interval of σ, which no vertex of the mesh halves at the reference.
fn check_loss<P: FirstOrderPde + Sync, M: InitialManifold + Sync>(
    case: &Value,
    equation: &P,
    manifold: &M,
    guess: [f64; 2],
    (from, to): (f64, f64),
) -> bool {
    let name = text(&case["name"]);
    let s = text(&case["characteristic_parameter"]);
    let problem = CauchyProblem::new(equation, manifold, 2).unwrap().near(&guess).unwrap();
    let interval = [ParameterInterval { from, to, parts: 7 }];
    let solution = problem.solve(&interval, (0.0, 1.6), Refinement::to(1e-2)).unwrap();
    let loss = solution.first_loss_of_invertibility().unwrap();
    let expected = &case["first_loss_of_invertibility"];
    assert_eq!(loss.is_some(), expected["occurs"].as_bool().unwrap(), "{name}");
    let Some(loss) = loss else { return false };
    assert_close(&format!("{name} s"), &[loss.point.s], &[number(&expected[s])], integrated());
    let place = if expected["where"].is_array() { &expected["where"] } else { &expected["x"] };
    // σ is a zero of the exact ∂s*/∂σ.
    let located = Tol::stated(1e-10, "a zero of the derivative of the integrated ray map");
    assert_close(&format!("{name} where"), &loss.point.x, &vector(place), located);
    if expected["where_sigma"].is_number() {
        assert_close(&format!("{name} σ"), &loss.point.parameters, &[number(&expected["where_sigma"])], located);
        assert_close_at_scale(&format!("{name} u"), &[loss.point.u], &[number(&expected["u"])], 1.0, located);
        assert!(!loss.at_edge, "{name}");
    }
    true
}

#[test]
fn first_losses_of_invertibility_equal_reference() {
    let mut lost = 0;
    with_case(|case, name| {
        let p = &case["parameters"];
        let found = match name {
            "eikonal_circle_outward" | "eikonal_circle_inward" => {
                let centre = vector(&p["centre"]);
                let outward = text(&p["direction"]) == "outward";
                let circle = Circle { radius: number(&p["R"]), centre: [centre[0], centre[1]], outward };
                check_loss(case, &Eikonal, &circle, [0.0; 2], (0.0, 6.0))
            }
            "eikonal_parabola_inside" => {
                check_loss(case, &Eikonal, &Parabola(number(&p["a"])), [0.0, 1.0], (-1.1, 1.3))
            }
            "eikonal_parabola_outside" => {
                check_loss(case, &Eikonal, &Parabola(number(&p["a"])), [0.0, -1.0], (-1.1, 1.3))
            }
            // At σ = 0 the characteristic stands still.
            "product_ux_uy_u" => check_loss(case, &Product, &Line::Square, [0.0; 2], (0.1, 2.0)),
            "burgers_sine" => check_loss(case, &Burgers, &Line::Sine, [0.0; 2], (0.1, 6.0)),
            "burgers_gaussian" => check_loss(case, &Burgers, &Line::Gaussian, [0.0; 2], (-2.0, 2.1)),
            _ => {
                let line = Line::Quadratic([number(&p["a"]), number(&p["b"]), number(&p["c"])]);
                let oscillator = Oscillator { mass: number(&p["m"]), omega: number(&p["omega"]) };
                check_loss(case, &oscillator, &line, [0.0; 2], (-1.0, 1.5))
            }
        };
        lost += usize::from(found);
    });
    assert_eq!(lost, 6);
}
