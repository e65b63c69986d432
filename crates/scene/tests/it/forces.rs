//! Forces of scenes: expressions with units, the balance of energy and work, and mistakes at their places.

use core::ops::ControlFlow;

use piola_scene::Plan;
use piola_scene::output::Summary;
use piola_scene::run::{self, Outcome, Run};
use piola_testkit::{Tol, assert_close};
use proptest::prelude::*;

use crate::support::{assert_mistake, replaced, report_with, scene};

/// A cart on a rail with a pendulum, a spring, a damper, air and a motor.
const CART: &str = r#"
[mechanism]

[parameters]
k = "40 N/m"
amplitude = "2 N"

[[joint]]
name = "rail"
type = "prismatic"
axis = [1, 0, 0]
displacement = "10 cm"

[[joint]]
name = "left arm"
parent = "rail"
type = "revolute"
axis = [0, -1, 0]
angle = "20 deg"

[[particle]]
name = "cart"
joint = "rail"
mass = "2 kg"

[[particle]]
name = "bob"
joint = "left arm"
mass = "500 g"
at = "[0, 0, -1] m"

[[force]]
name = "buffer"
type = "spring"
from = "ground"
from_at = [-1.0, 0.0, 0.0]
to = "cart"
stiffness = "30 N/m"
length = "1 m"
damping = "1 N s/m"

[[force]]
name = "air"
type = "drag"
quadratic = "0.1 kg/m"

[[force]]
name = "drive"
type = "motor"
coordinate = "rail"
drive = "amplitude * sin(3 [rad/s] * t) - 0.5 [N s/m] * rate(rail)"

[[force]]
name = "bend"
type = "potential"
energy = "0.5 * k * rail^2 + 1 [N m] * (1 - cos(`left arm`))"

[time]
end = "5 s"

[integrator]
tolerance = 1e-13
"#;

fn complete(text: &str) -> Run {
    let scene = scene(text);
    let run = run::run(&scene, &Plan::of(&scene), |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

#[test]
fn energy_less_work_is_kept_and_works_are_told_by_name() {
    let scene = scene(CART);
    let plan = Plan::of(&scene);
    assert_eq!(plan.equations, 7);
    assert!(plan.files.contains(&"works.csv".to_string()));
    let run = run::run(&scene, &plan, |_| ControlFlow::Continue(()));
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-11, "the tolerance times some hundred steps"));
    assert_eq!(run.history.work_names, ["buffer", "air", "drive"]);
    let summary = Summary::of(&scene, &plan, &run).to_json();
    assert!(summary.contains("works_J") && summary.contains("\"buffer\": -"), "{summary}");
    // What the cart and the air lost is far more than the drift.
    let last = run.history.invariants.last().unwrap_or_else(|| panic!("no record"));
    assert!(0.01 < last.work.abs(), "{}", last.work);
}

#[test]
fn a_run_without_forces_has_no_works_and_says_so() {
    let plain: String = CART.split("[[force]]").next().unwrap_or_default().to_string();
    let text = format!("{plain}\n[time]\nend = 1.0\n");
    let scene = scene(&text);
    let plan = Plan::of(&scene);
    let skipped: Vec<&str> = plan.skipped.iter().map(|item| item.what.as_str()).collect();
    assert!(skipped.contains(&"forces besides gravity") && skipped.contains(&"work"), "{skipped:?}");
    assert_eq!(plan.equations, 4);
}

#[test]
fn an_expression_equals_the_force_that_it_says() {
    // The spring on the rail as a potential, as a motor and as a joint-spring: one motion.
    let only = |force: &str| {
        let plain = CART.split("[[force]]").next().unwrap_or_default();
        format!("{plain}\n{force}\n[time]\nend = 2.0\n[integrator]\ntolerance = 1e-13\n")
    };
    let by = |text: &str| {
        let run = complete(&only(&format!("[[force]]\nname = 'it'\n{text}")));
        run.history.coordinates.last().cloned().unwrap_or_default()
    };
    let spring = by("type = 'joint-spring'\ncoordinate = 'rail'\nstiffness = 40.0\nrest = '5 cm'");
    let energy = by("type = 'potential'\nenergy = 'k/2 * (rail - 5 [cm])^2'");
    let motor = by("type = 'motor'\ncoordinate = 'rail'\ndrive = '-k * (rail - 0.05 [m])'");
    let tolerance = Tol::stated(1e-11, "the tolerance times some hundred steps");
    assert_eq!(spring.len(), 4);
    assert_close("potential", &energy, &spring, tolerance);
    assert_close("motor", &motor, &spring, tolerance);
}

#[test]
fn a_uniform_field_equals_gravity() {
    let gravity = complete(&replaced(CART, "[mechanism]", "[mechanism]\ngravity = [1.0, 0.5, -9.0]"));
    let field = "[[force]]\nname = 'wind of stars'\ntype = 'uniform-field'\nacceleration = [1.0, 0.5, 0.80665]\n";
    let both = complete(&replaced(CART, "[time]", &format!("{field}\n[time]")));
    let [one, other] = [&gravity, &both].map(|run| run.history.coordinates.last().cloned().unwrap_or_default());
    assert_close("state", &one, &other, Tol::stated(1e-11, "the tolerance times some hundred steps"));
}

#[test]
fn parameters_can_be_set() {
    let mistakes = report_with(CART, &["parameters.k=3 kg"]).to_string();
    assert!(mistakes.contains("`energy` is"), "{mistakes}");
}

#[test]
fn mistakes_in_forces_are_shown_at_their_places() {
    let drive = "\"amplitude * sin(3 [rad/s] * t) - 0.5 [N s/m] * rate(rail)\"";
    let cases = [
        ("\"amplitude * sin(t)\"", "the argument of sin has the dimension time"),
        ("\"amplitude * rail\"", "instead of mass length/time^2"),
        ("\"amplitude + rail\"", "length is added to mass length/time^2"),
        ("\"amplitud\"", "did you mean `amplitude`?"),
        ("\"amplitude * rate(rial)\"", "did you mean `rail`?"),
        ("\"amplitude *\"", "it ends where a number or a name must stand"),
        ("\"2 amplitude\"", "`amplitude` cannot stand there"),
        ("\"(amplitude\"", "it ends where `)` must close a bracket"),
        ("\"amplitude / 0\"", "instead of"),
        ("\"1 [N] / 0\"", "a part of it is inf"),
        ("\"3 [N\"", "a unit lacks its `]`"),
        ("\"3 [Nm]\"", "`Nm` is not a unit"),
        ("\"sine(1) * amplitude\"", "no function is named `sine`"),
        ("\"sqrt(amplitude) * amplitude\"", "the root of mass length/time^2 has no dimension"),
        ("\"amplitude ^ t\"", "an exponent has the dimension time"),
        ("\"amplitude # 2\"", "`#` cannot stand here"),
        ("\"\"", "it ends where a number or a name must stand"),
        ("\"1..2 [N]\"", "`1..2` is no finite number"),
    ];
    for (wrong, words) in cases {
        let valid = if wrong == "\"amplitude / 0\"" { continue } else { words };
        assert_mistake(&replaced(CART, drive, wrong), wrong, &["`drive` is", valid]);
    }
    // A bare number is in SI units, as everywhere.
    assert_eq!(complete(&replaced(CART, drive, "\"-2.5\"")).history.work_names.len(), 3);
    let twice = replaced(CART, "name = \"air\"", "name = \"buffer\"");
    let report = report_with(&twice, &[]).to_string();
    assert!(report.contains("the name `buffer` is taken"), "{report}");
    assert_mistake(
        &replaced(CART, "coordinate = \"rail\"", "coordinate = \"rial\""),
        "\"rial\"",
        &["did you mean `rail`"],
    );
    assert_mistake(&replaced(CART, "to = \"cart\"", "to = \"card\""), "\"card\"", &["did you mean `cart`"]);
    assert_mistake(
        &replaced(CART, "from = \"ground\"\nfrom_at = [-1.0, 0.0, 0.0]", "from = \"cart\""),
        "\"cart\"\nstiffness",
        &["both ends are on one body"],
    );
    let arm = replaced(CART, "from = \"ground\"\nfrom_at = [-1.0, 0.0, 0.0]", "from = \"left arm\"");
    assert_mistake(
        &replaced(&arm, "to = \"cart\"", "to = \"bob\""),
        "\"bob\"\nstiffness",
        &["both ends are on one body"],
    );
    let at_once = replaced(CART, "from_at = [-1.0, 0.0, 0.0]", "from_at = [0.1, 0.0, 0.0]");
    assert_mistake(&at_once, "\"cart\"\nstiffness", &["at one place at the start", "ends apart"]);
    // A plain spring of no length has its forces there.
    let plain = replaced(&at_once, "length = \"1 m\"\ndamping = \"1 N s/m\"", "length = 0.0");
    assert_eq!(complete(&plain).history.work_names, ["air", "drive"]);
    let ground = replaced(CART, "quadratic = \"0.1 kg/m\"", "part = \"ground\"");
    assert_mistake(&ground, "\"ground\"\n\n[[force]]\nname = \"drive\"", &["no force moves the ground"]);
    let pull = replaced(&ground, "type = \"drag\"", "type = \"constant-force\"\nforce = [1.0, 0.0, 0.0]");
    assert_mistake(&pull, "\"ground\"\n\n[[force]]\nname = \"drive\"", &["no force moves the ground"]);
    let reserved = replaced(CART, "name = \"air\"", "name = \"prescribed motion\"");
    assert_mistake(&reserved, "\"prescribed motion\"", &["the work of all drives"]);
    let named = replaced(CART, "name = \"cart\"", "name = \"ground\"");
    assert!(report_with(&named, &[]).to_string().contains("the name `ground` is taken"));
    // A joint may have any name where no expression reads it.
    let pi = replaced(&CART.replace("`left arm`", "1"), "\"left arm\"\nparent", "\"pi\"\nparent");
    let pi = replaced(&pi, "joint = \"left arm\"", "joint = \"pi\"");
    assert_mistake(&pi, "\"pi\"\nparent", &["`pi` has a meaning of its own in expressions"]);
    let silent = pi.split("[[force]]\nname = \"drive\"").next().unwrap_or_default();
    assert_eq!(complete(&format!("{silent}[time]\nend = 0.1\n")).history.coordinate_names, ["rail", "pi"]);
    let rate = replaced(CART, "1 [N m] *", "1 [N s^2/m] * rate(rail)^2 + 1 [N m] *");
    assert_mistake(&rate, "\"0.5 * k", &["the stored energy depends on a rate"]);
    assert_mistake(&replaced(CART, "k = \"40 N/m\"", "t = \"40 N/m\"\nk = \"1 N/m\""), "t = \"40", &["`t` is taken"]);
    assert_mistake(&replaced(CART, "k = \"40 N/m\"", "2k = 3\nk = \"1 N/m\""), "2k", &["no name of a parameter"]);
    assert_mistake(&replaced(CART, "\"40 N/m\"", "\"40 Nm\""), "\"40 Nm\"", &["`Nm` is not a unit"]);
    let lengths =
        replaced(CART, "type = \"drag\"\nquadratic = \"0.1 kg/m\"", "type = \"torsion-spring\"\ncoordinate = 'rail'");
    assert_mistake(&lengths, "'rail'", &["`rail` is a length", "joint-spring"]);
}

#[test]
fn forces_elsewhere_than_in_a_mechanism_are_refused() {
    let text = format!("{}\n[[force]]\nname = 'it'\ntype = 'drag'\n", crate::support::PAIR);
    let report = report_with(&text, &[]).to_string();
    assert!(report.contains("[[force]] in a scene of [gravity]"), "{report}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Texts of the tokens of expressions are read or refused, and never more than that.
    #[test]
    fn any_text_is_an_expression_or_a_mistake(
        pieces in prop::collection::vec(
            prop::sample::select(vec![
                "1", "2.5e-3", " [N]", " [s]", "rail", "rate(rail)", "t", "k", "pi", "+", "-", "*", "/", "^", "(", ")", ",",
                "sin(", "min(", "`left arm`", "`", "[", "]", "é", "1e999", " ",
            ]),
            0..25,
        ),
    ) {
        let drive = "amplitude * sin(3 [rad/s] * t) - 0.5 [N s/m] * rate(rail)";
        let text = replaced(CART, drive, &pieces.concat());
        let document = piola_scene::Document::parse("test.toml", &text);
        if let Err(error) = piola_scene::Scene::from_document(&document) {
            prop_assert!(error.to_string().contains("drive"), "{error}");
        }
    }
}
