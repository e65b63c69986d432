//! `plan --explain TERM`.

use crate::end_to_end::{Folder, ORBIT, err, json, out};

#[test]
fn a_term_shows_lines_of_the_plan_and_keys_with_kind_and_default() {
    let folder = Folder::new("explain");
    let scene = folder.scene(ORBIT).display().to_string();
    let explained = |term: &str| {
        let output = folder.piola(&["plan", &scene, "--explain", term]);
        assert_eq!(output.status.code(), Some(0), "{term}: {}", err(&output));
        out(&output)
    };
    let momentum = explained("MOMENTUM");
    let expected = "computed  energy and angular momentum: conserved: at every recorded instant\n\
                    skipped   momentum: not conserved: the centre is held\n";
    assert!(momentum.starts_with(expected) && momentum.contains("key       coordinate.momentum\n"), "{momentum}");
    let end = explained("time.end");
    assert!(end.starts_with("key       time.end\n          Time at the end;"), "{end}");
    assert!(end.contains("time, a number in s") && end.contains("; may be absent\n"), "{end}");
    let name = explained("name");
    assert!(name.contains("key       body.name\n") && name.contains("; must be given\n"), "{name}");
    let simplify = explained("Simplify");
    assert!(
        simplify.contains("integrator.simplify") && simplify.contains("true or false; true when absent"),
        "{simplify}"
    );
    let method = explained("verner-98");
    assert!(method.contains("word      integrator.method = \"verner-98\"\n"), "{method}");
    let joint = explained("universal");
    assert!(joint.contains("joint.type = \"universal\""), "{joint}");
    let axis = explained("second_axis");
    assert!(axis.contains("joint.second_axis") && axis.contains("only of type universal"), "{axis}");
}

#[test]
fn json_of_an_explanation_has_the_same_lines_and_keys() {
    let folder = Folder::new("explain-json");
    let scene = folder.scene(ORBIT).display().to_string();
    let output = folder.piola(&["plan", &scene, "--json", "--explain", "tables"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let found = json(&out(&output));
    assert_eq!(found["term"], "tables");
    let key = &found["keys"][0];
    assert_eq!((key["path"].as_str(), key["default"].as_str()), (Some("output.tables"), Some("true")));
    assert_eq!((key["value"].as_str(), key["required"].as_bool()), (Some("true or false"), Some(false)));
    let output = folder.piola(&["plan", &scene, "--json", "--explain", "attitudes"]);
    let line = &json(&out(&output))["plan"][0];
    assert_eq!((line["heading"].as_str(), line["why"].as_str()), (Some("skipped"), Some("bodies without extent")));
}

#[test]
fn a_term_that_nothing_has_exits_with_2_and_names_near_ones() {
    let folder = Folder::new("explain-nothing");
    let scene = folder.scene(ORBIT).display().to_string();
    for (term, hint) in [
        ("tolerence", "near names: tolerance"),
        ("post_newt", "near names: post_newtonian"),
        ("qqqqqqqq", "`piola schema --markdown` prints all keys"),
        ("", "`piola schema --markdown` prints all keys"),
    ] {
        let output = folder.piola(&["plan", &scene, "--explain", term]);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{term}");
        assert!(err(&output).contains(hint), "{term}: {}", err(&output));
    }
    let output = folder.piola(&["plan", &scene, "--json", "--explain", "tolerence"]);
    assert_eq!((output.status.code(), &json(&out(&output))["valid"]), (Some(2), &false.into()));
}
