//! `--report` in a browser: headless Chromium on a screen 390 px wide. Where it is not installed the test says so and passes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The browser, if there is one.
fn chromium() -> Option<&'static str> {
    let is_there =
        |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(is_there)
}

/// A script in the page measures its width, its smallest text, and the drawn parts and smallest label of each figure. A frame of
/// another file is foreign to a page, so the page sends its numbers to the outer one.
const MEASURE: &str = r"<script>addEventListener('load', () => {
    const size = e => parseFloat(getComputedStyle(e).fontSize);
    const least = all => all.reduce((a, b) => Math.min(a, b), 1e9);
    const figures = [...document.querySelectorAll('svg')].map(s => {
        const box = s.getBoundingClientRect();
        const scale = m => Math.hypot(m.a, m.b);
        const labels = [...s.querySelectorAll('text')].map(t => size(t) * scale(t.getScreenCTM()));
        return [box.width, box.height, s.querySelectorAll('path,polyline,line,circle,polygon').length, least(labels)];
    });
    const texts = [...document.querySelectorAll('p,pre,td,th,h1,h2')].map(size);
    const page = document.documentElement;
    const pictures = document.querySelectorAll('img,object,iframe,link').length;
    parent.postMessage([innerWidth, page.scrollWidth, least(texts), pictures, ...figures.flat()].join(' '), '*');
});</script>";

const FRAME: &str = "<!DOCTYPE html><html><head><script>addEventListener('message', message => \
    document.documentElement.setAttribute('data-measured', message.data))</script></head>\
    <body><iframe src='inner.html' style='border:0;width:390px;height:844px'></iframe></body></html>";

/// What the page says of itself, and what the browser has logged.
fn measured(browser: &str, folder: &Path) -> (Vec<f64>, String) {
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{error}"));
    let write =
        |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap_or_else(|error| panic!("{error}"));
    let report = read("report.html");
    assert_eq!(report.matches("</body>").count(), 1);
    write("inner.html", &report.replace("</body>", &format!("{MEASURE}</body>")));
    write("frame.html", FRAME);
    let mut command = Command::new(browser);
    // A sandbox needs rights that a container may lack; the page is our own.
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--dump-dom"]);
    command.args(["--virtual-time-budget=5000", "--window-size=800,900"]);
    command.arg(format!("--user-data-dir={}", folder.join("profile").display()));
    command.arg(format!("file://{}", folder.join("frame.html").display())).stdin(Stdio::null());
    let output = command.output().unwrap_or_else(|error| panic!("{error}"));
    let (dom, log) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let numbers = dom.split_once("data-measured=\"").and_then(|(_, rest)| rest.split_once('"'));
    let Some((numbers, _)) = numbers else { panic!("the page says nothing: {dom}\n{log}") };
    let numbers = numbers.split(' ').map(|number| number.parse().unwrap_or(f64::NAN)).collect();
    (numbers, log.lines().filter(|line| line.contains("CONSOLE")).collect())
}

fn report(name: &str, arguments: &[&str]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("piola-rendering-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(format!("{name}.toml"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    command.args(&arguments[..1]).arg(scene).args(&arguments[1..]).arg("--report").arg("--out").arg(&folder);
    let output = command.output().unwrap_or_else(|error| panic!("{error}"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

#[test]
fn reports_have_every_figure_no_error_and_readable_text_on_a_phone() {
    let Some(browser) = chromium() else {
        eprintln!(
            "1 test skipped: reports_have_every_figure_no_error_and_readable_text_on_a_phone: Chromium is not installed"
        );
        return;
    };
    let sweep = ["sweep", "--set", "time.end=1 s", "--vary", "joint.elbow.angle=0:1:5 rad"];
    let reports: [(&str, &[&str]); 3] =
        [("balloon", &["run"]), ("wavefront-lens", &["run"]), ("double-pendulum", &sweep)];
    for (name, arguments) in reports {
        let folder = report(name, arguments);
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{error}"));
        let files = entries.flatten().filter(|entry| entry.path().extension().is_some_and(|end| end == "svg")).count();
        let (numbers, errors) = measured(browser, &folder);
        let _ = std::fs::remove_dir_all(&folder);
        assert_eq!(errors, "", "{name}");
        let [width, scrolled, text, pictures, figures @ ..] = &numbers[..] else { panic!("{name}: {numbers:?}") };
        assert_eq!([*width, *pictures].map(f64::to_bits), [390.0, 0.0].map(f64::to_bits), "{name}");
        assert!(*scrolled <= *width && 12.0 <= *text, "{name}: {numbers:?}");
        assert!(0 < files && figures.len() == 4 * files, "{name}: {files} figures, {numbers:?}");
        for figure in figures.chunks(4) {
            let [wide, high, drawn, label] = figure else { panic!("{figure:?}") };
            assert!(300.0 <= *wide && 200.0 <= *high && 10.0 <= *drawn && 10.0 <= *label, "{name}: {figure:?}");
        }
    }
}
