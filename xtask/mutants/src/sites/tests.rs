//! What is an operator of a formula and what is not.

use super::{Change, Sign, of_file};

fn signs(text: &str) -> Vec<(usize, &'static str)> {
    let mut sites = of_file("crates/a/src/b.rs", text).map(|found| found.sites).unwrap_or_default();
    sites.sort();
    sites.iter().map(|site| (site.line, site.sign.text())).collect()
}

#[test]
fn operators_of_bodies_are_found() {
    let text =
        "fn f(a: f64) -> f64 {\n    let mut b = -a * 2.0;\n    b += a;\n    v.map(|x| x / 3.0)[i - 1] % 2.0 < 1.0\n}";
    assert_eq!(signs(text), [(2, "-"), (2, "*"), (3, "+="), (4, "/"), (4, "-")]);
}

#[test]
fn what_the_compiler_computes_is_passed_over() {
    for text in [
        "const A: f64 = 1.0 + 2.0;",
        "static A: f64 = 1.0 + 2.0;",
        "const fn f(a: u32) -> u32 { a + 1 }",
        "impl B { const A: u32 = 1 + 2; const fn f(a: u32) -> u32 { a + 1 } }",
        "fn f() -> [u32; 1 + 2] { [0; 1 + 2] }",
        "fn f() { g::<{ 1 + 2 }>() }",
        "fn f(a: i32) -> bool { match a { -1 => true, _ => false } }",
        "fn f() -> f64 { -1.0 }",
        "fn f() { const { 1 + 2 } }",
        "enum A { B = 1 + 2 }",
        "macro_rules! m { () => { 1 + 2 } }",
        "fn f() { assert!(1 + 2 < 4) }",
        "#[cfg(test)] mod tests { fn f() -> u32 { 1 + 2 } }",
        "#[cfg(not(feature = \"wide\"))] fn f() -> u32 { 1 + 2 }",
        "#[cfg(any(test, doc))] impl A { fn f() -> u32 { 1 + 2 } }",
        "#[doc = \"1 + 2\"] fn f() {}",
    ] {
        assert_eq!(signs(text), [], "{text}");
    }
    assert_eq!(signs("#[cfg(all(feature = \"wide\", not(test)))] fn f() -> u32 { 1 + 2 }"), [(1, "+")]);
}

#[test]
fn a_module_stands_beside_its_parent() {
    let modules = |file: &str, text: &str| -> Vec<_> {
        let found = of_file(file, text).map(|found| found.modules).unwrap_or_default();
        found.into_iter().map(|module| module.folder.join(module.name)).collect()
    };
    assert_eq!(modules("c/src/lib.rs", "mod a; #[cfg(test)] mod tests;"), [std::path::Path::new("c/src/a")]);
    assert_eq!(modules("c/src/a/mod.rs", "mod b;"), [std::path::Path::new("c/src/a/b")]);
    assert_eq!(modules("c/src/a.rs", "mod b { mod d; }"), [std::path::Path::new("c/src/a/b/d")]);
}

#[test]
fn a_change_stands_behind_the_switch() {
    let text = "fn f(a: f64, b: f64) -> f64 { a * 2.0 * -b }";
    let mut sites = of_file("a.rs", text).map(|found| found.sites).unwrap_or_default();
    sites.sort();
    let changed: Vec<_> = sites.iter().map(|site| site.switched(text, 7, Change::Inverse)).collect();
    let switch = |changed: &str, original: &str| {
        format!("(if crate::mutant_switch::is(7) {{ ({changed}) }} else {{ ({original}) }})")
    };
    let expected = [switch("a / 2.0", "a * 2.0"), switch("a * 2.0 / -b", "a * 2.0 * -b"), switch("b", "-b")];
    assert_eq!(changed, expected);
    assert_eq!(sites[0].switched(text, 7, Change::Negated), switch("-(a * 2.0)", "a * 2.0"));
    assert_eq!(Sign::Mul.after(Change::Inverse), Some(Change::Negated));
    assert_eq!(Sign::Add.after(Change::Inverse), None);
}
