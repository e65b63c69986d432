//! MJCF files: two models against `MuJoCo`, and what is refused, with its line.

use piola_multibody::{
    FileFault, FileInertias, JointKind, LoopClosure, Mjcf, MjcfOptions, MultibodyError, VisualShape,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

const ROUNDING: Tol = Tol::stated(1e-12, "the reference was computed in double precision");
const DATA: &str = include_str!("../../../../testdata/reference/mujoco_models.json");
const LIMBS: &str = include_str!("../../../../testdata/reference/mjcf_limbs.xml");
const LINKAGE: &str = include_str!("../../../../testdata/reference/mjcf_linkage.xml");

fn models() -> [(Mjcf, Value); 2] {
    let data: Value = serde_json::from_str(DATA).unwrap();
    let read = |text| Mjcf::parse(text, MjcfOptions::default()).unwrap();
    [(read(LIMBS), data["models"][0].clone()), (read(LINKAGE), data["models"][1].clone())]
}

#[test]
fn models_move_and_weigh_as_in_mujoco() {
    let mut compared = 0;
    for (model, expected) in models() {
        let tree = &model.tree;
        let n = tree.freedoms();
        let (mut work, mut out) = (tree.workspace(), vec![0.0; n]);
        assert_close("home", &model.home, &golden::vector(&expected["home"]), ROUNDING);
        for state in expected["states"].as_array().unwrap() {
            let [q, v] = ["q", "v"].map(|key| golden::vector(&state[key]));
            let mut mass_matrix = vec![0.0; n * n];
            tree.mass_matrix(&mut work, &q, &mut mass_matrix).unwrap();
            // Rows are in kg and kg m²: each entry over √(Mᵢᵢ Mⱼⱼ), and forces over √Mᵢᵢ.
            let root: Vec<f64> = (0..n).map(|i| mass_matrix[i * n + i].sqrt()).collect();
            let scaled = |values: &[f64]| values.iter().zip(&root).map(|(x, root)| x / root).collect::<Vec<_>>();
            let rows = golden::matrix(&state["mass_matrix"]).concat();
            for (j, (found, expected)) in mass_matrix.chunks(n).zip(rows.chunks(n)).enumerate() {
                let over = |row: &[f64]| scaled(row).iter().map(|x| x / root[j]).collect::<Vec<_>>();
                assert_close_at_scale("mass matrix", &over(found), &over(expected), 1.0, ROUNDING);
            }
            tree.bias_forces(&mut work, &q, &v, &mut out).unwrap();
            assert_close("bias", &scaled(&out), &scaled(&golden::vector(&state["bias"])), ROUNDING);
            tree.gravity_forces(&mut work, &q, &mut out).unwrap();
            assert_close("gravity", &scaled(&out), &scaled(&golden::vector(&state["gravity"])), ROUNDING);
            tree.forward_kinematics(&mut work, &q).unwrap();
            let places = state["positions"].as_array().unwrap().iter().zip(state["rotations"].as_array().unwrap());
            let moving = tree.joints().iter().map(|place| place.child);
            let mut bodies: Vec<_> = moving.collect();
            bodies.dedup();
            for (body, (position, rotation)) in bodies.into_iter().zip(places) {
                let found = tree.place_of(&work, body).unwrap();
                assert_close(tree.body_name(body), &found.origin, &golden::vector(position), ROUNDING);
                let rows = golden::matrix(rotation).concat();
                assert_close(tree.body_name(body), found.rotation.as_flattened(), &rows, ROUNDING);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 3 * (5 + 5));
}

/// Coulomb friction is a condition of `MuJoCo`'s solver, not one of its forces: the file is read without it.
#[test]
fn springs_and_dampers_act_as_in_mujoco() {
    let [(_, limbs), (_, linkage)] = models();
    for (text, expected) in [(LIMBS.replace("frictionloss=\"0.2\"", ""), limbs), (LINKAGE.to_owned(), linkage)] {
        let tree = Mjcf::parse(&text, MjcfOptions::default()).unwrap().tree;
        let mut out = vec![0.0; tree.freedoms()];
        for state in expected["states"].as_array().unwrap() {
            let [q, v] = ["q", "v"].map(|key| golden::vector(&state[key]));
            tree.joint_forces(&q, &v, 0.1, &mut out).unwrap();
            assert_close("forces", &out, &golden::vector(&state["springs_and_dampers"]), ROUNDING);
        }
    }
}

/// G v̇ = 0 from rest, with the rows G of `MuJoCo`'s equalities.
#[test]
fn equalities_are_closures_with_the_rows_of_mujoco() {
    let [_, (model, expected)] = models();
    let closed = model.with_closures().unwrap();
    assert_eq!(closed.conditions(), 3 + 6 + 1);
    let n = model.tree.freedoms();
    let (mut work, mut out) = (closed.workspace(), vec![0.0; n]);
    let tau: Vec<f64> = (0..n).map(|k| 1.0 - 0.25 * k as f64).collect();
    closed.accelerations(&mut work, &model.home, &vec![0.0; n], &tau, 0.0, &mut out).unwrap();
    let rows = golden::matrix(&expected["closure_rows"]);
    assert_eq!(rows.len(), 10);
    let largest = out.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(0.1 < largest);
    for row in rows {
        let rate: f64 = row.iter().zip(&out).map(|(g, a)| g * a).sum();
        let size: f64 = row.iter().zip(&out).map(|(g, a)| (g * a).abs()).sum();
        let kappa = Tol::stated(1e-11, "the solve of the conditions loses some digits");
        assert_close("row of a closure", &[rate / size.max(largest)], &[0.0], kappa);
    }
    // The gear is open by its constant where the file places the bodies, as in MuJoCo; projection closes it.
    assert_close("residual", &[golden::vector(&expected["closure_residuals"])[9]], &[-0.1], ROUNDING);
    let (mut q, mut v) = (model.home.clone(), vec![0.0; n]);
    closed.project(&mut work, &mut q, &mut v, 0.0).unwrap();
    let place = |name: &str| model.tree.joints().iter().find(|p| p.joint.name == name).unwrap().first_coordinate;
    assert_close("gear", &[q[place("e")] + 1.5 * q[place("a")]], &[0.1], ROUNDING);
}

#[test]
fn data_of_joints_motors_and_pictures_are_read_and_the_rest_is_listed() {
    let [(limbs, _), (linkage, _)] = models();
    assert_eq!((limbs.name.as_str(), limbs.tree.gravity()), ("limbs", [0.5, -0.25, -9.81]));
    let joint = |name: &str| &limbs.tree.joints().iter().find(|place| place.joint.name == name).unwrap().joint;
    let bend = joint("wrist bend");
    assert_eq!((bend.damping, bend.friction, bend.armature, bend.stiffness), (0.5, 0.2, 0.01, 3.0));
    assert_close("limits", &bend.limits, &[-60f64.to_radians(), 90f64.to_radians()], Tol::ulps(2.0));
    assert_close("rest", &[bend.rest], &[10f64.to_radians()], Tol::ulps(2.0));
    let hip = joint("hip");
    assert_eq!((hip.limits, hip.armature, hip.rest), ([-0.1, 0.2], 0.3, 0.02));
    assert!(matches!(hip.kind, JointKind::Prismatic { .. }));
    assert!(limbs.tree.frame("chest").is_ok());
    let skipped: Vec<_> = limbs.skipped.iter().map(|skipped| (skipped.line, skipped.element.as_str())).collect();
    assert_eq!(skipped, [(5, "visual"), (18, "texture"), (20, "light"), (37, "camera")]);
    let balls = limbs.visuals.iter().filter(|visual| matches!(visual.shape, VisualShape::Sphere { .. })).count();
    // The head, and the two ends of the arm's capsule.
    assert_eq!((limbs.visuals.len(), balls), (8, 3));
    let motor = &linkage.motors[0];
    assert_eq!((motor.name.as_str(), motor.joint.as_str(), motor.gear), ("drive", "a", 15.0));
    assert_close("controls", &motor.controls, &[-2.0, 2.0], Tol::ulps(0.0));
    assert_close("limits", &linkage.tree.joints()[0].joint.limits, &[-3.0, 3.0], Tol::ulps(0.0));
}

/// A body with something in it, between what stands before and behind the ground.
fn model(before: &str, body: &str, behind: &str) -> String {
    format!("<mujoco>\n{before}\n<worldbody>\n<body name=\"b\">\n{body}\n</body>\n</worldbody>\n{behind}\n</mujoco>")
}

const HINGE: &str = "<joint name=\"h\"/><geom size=\"0.1\"/>";

fn fault(text: &str) -> (usize, FileFault) {
    match Mjcf::parse(text, MjcfOptions::default()) {
        Err(MultibodyError::InFile { line, fault }) => (line, fault),
        other => panic!("not a fault at a line: {other:?}"),
    }
}

#[test]
fn what_is_not_read_is_refused_with_its_line() {
    assert!(Mjcf::parse(&model("", HINGE, ""), MjcfOptions::default()).is_ok());
    let cases = [
        ("", HINGE, "<tendon><spatial/></tendon>", 8, "tendon"),
        ("", HINGE, "<actuator>\n<position joint=\"h\"/></actuator>", 9, "position"),
        ("", HINGE, "<contact><pair geom1=\"a\" geom2=\"b\"/></contact>", 8, "pair"),
        ("", HINGE, "<equality>\n<tendon tendon1=\"x\"/></equality>", 9, "tendon"),
        ("<include file=\"x.xml\"/>", HINGE, "", 2, "include"),
        ("<compiler coordinate=\"global\"/>", HINGE, "", 2, "coordinate=\"global\" of compiler"),
        ("<compiler speed=\"1\"/>", HINGE, "", 2, "attribute speed of compiler"),
        ("<option density=\"1.2\"/>", HINGE, "", 2, "density=\"1.2\" of option"),
        ("<option><flag spring=\"disable\"/></option>", HINGE, "", 2, "spring=\"disable\" of flag"),
        ("", "<joint/><geom type=\"mesh\" mesh=\"m\"/>", "", 5, "inertia of a geom of type mesh"),
        ("", "<joint/><geom type=\"sdf\" size=\"1\"/>", "", 5, "geom of type sdf"),
        ("", "<joint type=\"ball\" range=\"0 30\"/><geom size=\"1\"/>", "", 5, "range of a ball or free joint"),
        ("", "<joint type=\"ball\" stiffness=\"1\"/><geom size=\"1\"/>", "", 5, "stiffness=\"1\" of joint"),
        ("", "<freejoint/><joint/><geom size=\"1\"/>", "", 5, "free joint in a series or below another body"),
        ("", "<composite/>", "", 5, "composite"),
        ("", "<joint springdamper=\"1 2\"/><geom size=\"1\"/>", "", 5, "springdamper=\"1 2\" of joint"),
        ("<default><joint speed=\"1\"/></default>", HINGE, "", 2, "attribute speed of joint"),
        ("<option speed=\"1\"/>", HINGE, "", 2, "attribute speed of option"),
        ("<option><flags/></option>", HINGE, "", 2, "flags"),
        ("<option><flag speed=\"enable\"/></option>", HINGE, "", 2, "attribute speed of flag"),
        ("<asset><mesh file=\"a\" speed=\"1\"/></asset>", HINGE, "", 2, "attribute speed of mesh"),
        ("", "<joint/><geom size=\"1\"/><site speed=\"1\"/>", "", 5, "attribute speed of site"),
        ("", "<joint type=\"free\" armature=\"0.1\"/><geom size=\"1\"/>", "", 5, "armature=\"0.1\" of joint"),
        (
            "",
            "<joint actuatorfrcrange=\"-1 100\"/><geom size=\"1\"/>",
            "",
            5,
            "an actuatorfrcrange that is not symmetric",
        ),
    ];
    for (before, body, behind, line, element) in cases {
        let expected = (line, FileFault::Unsupported { element: element.to_owned() });
        assert_eq!(fault(&model(before, body, behind)), expected);
    }
    assert_eq!(fault("<robot/>"), (1, FileFault::Unsupported { element: "robot".to_owned() }));
    let of_root = FileFault::Unsupported { element: "attribute speed of mujoco".to_owned() };
    assert_eq!(fault("<mujoco speed=\"1\"/>"), (1, of_root));
    let of_world = FileFault::Unsupported { element: "attribute pos of worldbody".to_owned() };
    assert_eq!(fault("<mujoco><worldbody pos=\"1\"/></mujoco>"), (1, of_world));
}

fn read(text: &str) -> Mjcf {
    Mjcf::parse(text, MjcfOptions::default()).unwrap()
}

/// Two hinges at given angles; coefficients that are not written are 0 1 0 0 0.
#[test]
fn joint_equalities_take_the_coefficients_that_are_not_written() {
    let bodies = "<joint name=\"h\" ref=\"2\"/><geom size=\"0.1\"/>\n<body><joint name=\"k\" ref=\"3\"/><geom size=\"0.1\"/></body>";
    let gear = |attributes: &str| {
        let tie = format!("<equality><joint joint1=\"k\" {attributes}/></equality>");
        let text = model("<compiler angle=\"radian\"/>", bodies, &tie);
        match read(&text).closures[0].1 {
            LoopClosure::Gear { follower, leader, ratio, offset } => (follower, leader, ratio, offset),
            ref other => panic!("{other:?}"),
        }
    };
    // k = 3 + constant + ratio (h − 2)
    assert_eq!(gear("joint2=\"h\""), (1, 0, 1.0, 1.0));
    assert_eq!(gear("joint2=\"h\" polycoef=\"0.5\""), (1, 0, 1.0, 1.5));
    assert_eq!(gear("joint2=\"h\" polycoef=\"0.5 -2\""), (1, 0, -2.0, 7.5));
    assert_eq!(gear(""), (1, 1, 0.0, 3.0));
    assert_eq!(gear("polycoef=\"0.25\""), (1, 1, 0.0, 3.25));
}

/// A body at (1, 0, 0) whose site stands at (0, 0, 2) in it, beside a site of the ground.
#[test]
fn welds_and_connects_at_sites_and_bodies_are_closures() {
    let closure = |tie: &str| {
        let sites = "<site name=\"on body\" pos=\"0 0 2\"/>";
        let body = format!("<body name=\"b\" pos=\"1 0 0\"><freejoint/><geom size=\"0.1\"/>{sites}</body>");
        let world = format!("<worldbody>{body}<site name=\"on ground\" pos=\"0 3 0\"/></worldbody>");
        let model = read(&format!("<mujoco>{world}<equality>{tie}</equality></mujoco>"));
        (model.closures[0].1, model.tree)
    };
    let points = |tie: &str| match closure(tie).0 {
        LoopClosure::Point { first, second } => [first.at, second.at],
        other => panic!("{other:?}"),
    };
    assert_eq!(points("<connect site1=\"on body\" site2=\"on ground\"/>"), [[0.0, 0.0, 2.0], [0.0, 3.0, 0.0]]);
    assert_eq!(points("<connect body1=\"b\" anchor=\"0 0 1\"/>"), [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]);
    // Without a torque a weld is a point.
    let free = "torquescale=\"0\"";
    let at_sites = points(&format!("<weld {free} site1=\"on body\" site2=\"on ground\"/>"));
    assert_eq!(at_sites, [[0.0, 0.0, 2.0], [0.0, 3.0, 0.0]]);
    let weld = format!("<weld {free} body1=\"b\" anchor=\"4 5 6\" relpose=\"1 2 3 1 0 0 0\"/>");
    assert_eq!(points(&weld), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let (weld, tree) = closure("<weld site1=\"on body\" site2=\"on ground\"/>");
    let [first, second] = ["on body", "on ground"].map(|name| tree.frame(name).unwrap());
    assert!(matches!(weld, LoopClosure::Frame { first: a, second: b } if (a, b) == (first, second)), "{weld:?}");
    // relpose: the anchor of the second body stands at (1, 2, 3) in the first, turned by 90° about z.
    let (weld, tree) = closure("<weld name=\"w\" body1=\"b\" anchor=\"4 5 6\" relpose=\"1 2 3 1 0 0 1\"/>");
    let [first, second] = ["w on the first body", "w on the second body"].map(|name| tree.frame(name).unwrap());
    assert!(matches!(weld, LoopClosure::Frame { first: a, second: b } if (a, b) == (first, second)), "{weld:?}");
    let mut work = tree.workspace();
    tree.forward_kinematics(&mut work, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
    let place = tree.place_of_frame(&work, first).unwrap();
    assert_close("origin", &place.origin, &[1.0, 2.0, 3.0], Tol::ulps(4.0));
    let quarter = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    assert_close("turn", place.rotation.as_flattened(), &quarter, Tol::ulps(4.0));
    assert_close("anchor", &tree.place_of_frame(&work, second).unwrap().origin, &[4.0, 5.0, 6.0], Tol::ulps(4.0));
    let text = "<mujoco><worldbody><body name=\"b\"><freejoint/><geom size=\"1\"/></body></worldbody>\n<equality><weld body1=\"b\" torquescale=\"-1\"/></equality></mujoco>";
    assert_eq!(fault(text), (2, FileFault::Negative { attribute: "torquescale", value: -1.0 }));
}

/// `inertiafromgeom="true"` takes the geoms, but not where none has mass.
#[test]
fn given_inertias_stay_where_no_geom_is_weighed() {
    let mass = |groups: &str, group: u8| {
        let body = format!(
            "<joint/><inertial pos=\"0 0 0\" mass=\"7\" diaginertia=\"1 1 1\"/><geom size=\"1\" mass=\"3\" group=\"{group}\"/>"
        );
        read(&model(&format!("<compiler {groups} inertiagrouprange=\"0 2\"/>"), &body, "")).tree.total_mass()
    };
    let of_geoms = "inertiafromgeom=\"true\"";
    assert_close("mass", &[mass("", 1), mass(of_geoms, 1), mass(of_geoms, 4)], &[7.0, 3.0, 7.0], Tol::ulps(1.0));
}

/// Names made up for what has none stay clear of those of the file.
#[test]
fn made_up_names_are_unlike_those_of_the_file() {
    let text = "<mujoco><worldbody><body><joint/><geom size=\"1\"/>
        <body name=\"body 1\"><joint name=\"body 1 (2) joint 1\" pos=\"1 0 0\"/><joint name=\"frame of body 1\"/><geom size=\"1\"/></body>
        <body name=\"fixed\"/></body><body name=\"last\" pos=\"1 0 0\"/><body name=\"frame of last\"/></worldbody>
        <equality><connect body1=\"fixed\" anchor=\"0 0 0\"/><connect name=\"connect 0\" body1=\"last\" anchor=\"0 0 0\"/></equality></mujoco>";
    let model = read(text);
    let joints: Vec<_> = model.tree.joints().iter().map(|place| place.joint.name.as_str()).collect();
    assert!(joints.contains(&"body 1 (2) joint 1 (2)") && joints.contains(&"frame of last (2)"), "{joints:?}");
    assert!(model.tree.body("body 1 (2)").is_ok());
    assert_eq!(model.closures[0].0, "connect 0 (2)");
}

/// The line of each element is not counted from the start of the file.
#[test]
fn large_files_are_read_in_one_pass() {
    let many = 20_000;
    let geoms = "<geom size=\"0.1\"/>\n<light/>\n".repeat(many);
    let model = read(&format!("<mujoco>\n<worldbody>\n<body><joint/>\n{geoms}</body></worldbody></mujoco>"));
    assert_eq!(model.skipped.len(), many);
    assert_eq!((model.skipped[0].line, model.skipped[many - 1].line), (5, 3 + 2 * many));
}

#[test]
fn wrong_values_and_names_are_refused_with_their_line() {
    let of_body = |body: &str| fault(&model("", body, ""));
    let behind = |behind: &str| fault(&model("", HINGE, behind));
    let missing = |what, element: &str| FileFault::Missing { what, element: element.to_owned() };
    let nameless = |what, name: &str| FileFault::Invalid {
        source: Box::new(MultibodyError::NoSuchName { what, name: name.to_owned() }),
    };
    let out_of_range = |attribute, value, condition| FileFault::OutOfRange { attribute, value, condition };
    assert_eq!(of_body("<joint class=\"x\"/>"), (5, nameless("class", "x")));
    assert_eq!(
        of_body("<geom size=\"1\" quat=\"1 0 0 0\"\n euler=\"1 0 0\"/>"),
        (5, FileFault::TwoAttributes { element: "geom".to_owned(), first: "quat", second: "euler" })
    );
    assert_eq!(of_body("<geom size=\"0\"/>"), (5, out_of_range("size", 0.0, "0 < x")));
    assert_eq!(of_body("<geom size=\"1\" quat=\"0 0 0 0\"/>"), (5, out_of_range("quat", 0.0, "0 < length")));
    assert_eq!(of_body("<joint axis=\"0 0 0\"/><geom size=\"1\"/>"), (5, out_of_range("axis", 0.0, "0 < length")));
    assert_eq!(
        of_body("<joint damping=\"-1\"/><geom size=\"1\"/>"),
        (5, FileFault::Negative { attribute: "damping", value: -1.0 })
    );
    assert_eq!(
        of_body("<geom size=\"one\"/>"),
        (5, FileFault::NotNumbers { attribute: "size", text: "one".to_owned() })
    );
    assert_eq!(
        fault(&model("<compiler angle=\"grad\"/>", HINGE, "")),
        (2, FileFault::NoSuchWord { attribute: "angle", text: "grad".to_owned(), valid: "degree or radian" })
    );
    let unlimited = model("<compiler autolimits=\"false\"/>", "<joint range=\"0 1\"/><geom size=\"1\"/>", "");
    assert_eq!(fault(&unlimited), (5, missing("limited", "joint")));
    assert_eq!(of_body("<inertial mass=\"1\"/>"), (5, missing("pos", "inertial")));
    let (line, wrong) = of_body("<joint/>\n<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 3\"/>");
    assert!(line == 6 && matches!(wrong, FileFault::Invalid { .. }), "{line}: {wrong}");
    let text = model("", "<joint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 3\"/>", "");
    assert!(Mjcf::parse(&text, MjcfOptions { inertias: FileInertias::AsGiven }).is_ok());
    let (line, wrong) = of_body("<joint/><geom size=\"1\"/>\n<body name=\"b\"/>");
    assert!(line == 6 && matches!(wrong, FileFault::Invalid { .. }), "{line}: {wrong}");
    assert_eq!(behind("<equality><connect body1=\"x\"/></equality>"), (8, nameless("body", "x")));
    assert_eq!(behind("<equality><connect body1=\"b\"/></equality>"), (8, missing("anchor", "connect")));
    assert_eq!(behind("<equality><joint joint1=\"x\"/></equality>"), (8, nameless("joint", "x")));
    assert_eq!(
        behind("<equality><joint joint1=\"h\" joint2=\"h\" polycoef=\"0 1 2\"/></equality>"),
        (8, out_of_range("polycoef", 2.0, "x = 0 from the third coefficient on"))
    );
    assert_eq!(behind("<actuator><motor joint=\"x\"/></actuator>"), (8, nameless("joint", "x")));
    assert!(matches!(fault("<mujoco>\n<worldbody>").1, FileFault::Syntax { .. }));
    // A hinge that moves nothing is refused by the tree.
    let error = Mjcf::parse(&model("", "<joint name=\"h\"/>", ""), MjcfOptions::default()).unwrap_err();
    assert!(matches!(error, MultibodyError::NoInertia { joint, .. } if joint == "h"));
}

/// Bodies of a chain nest as deep as it is long.
#[test]
fn long_chains_are_read() {
    let (links, open) = (2000, "<body pos=\"0 0 1\"><joint axis=\"0 1 0\"/><geom size=\"0.1\"/>");
    let text = format!("<mujoco><worldbody>{}{}</worldbody></mujoco>", open.repeat(links), "</body>".repeat(links));
    let model = Mjcf::parse(&text, MjcfOptions::default()).unwrap();
    assert_eq!((model.tree.freedoms(), model.home.len()), (links, links));
}
