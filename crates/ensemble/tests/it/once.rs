//! Scenes that are read once, and members that are integrated together: the same bits as each by itself.

use std::path::Path;

use piola_ensemble::{Ensemble, Member, ValueRange};
use piola_scene::{Document, SceneFile};

fn shipped(name: &str, settings: &[&str]) -> Document {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
    Document::read_with(&path, &settings).unwrap_or_else(|error| panic!("{error}"))
}

fn ranges(texts: &[&str]) -> Vec<ValueRange> {
    texts.iter().map(|text| text.parse().unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn ensemble(document: &Document, texts: &[&str]) -> Ensemble {
    Ensemble::new(document.clone(), ranges(texts), Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"))
}

/// Three bodies that take the same steps in all members.
const THREE: &str = "
[gravity]
softening = 1e-3
[[body]]
name = 'sun'
gm = 1.0
position = [0, 0, 0]
velocity = [0, 0, 0]
[[body]]
name = 'planet'
gm = 1e-3
position = '[1, 0, 0] m'
velocity = [0, 1, 0]
[[body]]
name = 'moon'
gm = 1e-9
position = [1.01, 0, 0]
velocity = [0, 1.3, 0]
[time]
end = '3 s'
[output]
samples = 5
[integrator]
method = 'composition-6'
step = '5 ms'
";

/// The scene of every member, with all its numbers to the last digit, or its mistakes.
#[test]
fn scenes_read_once_are_those_of_settings() {
    let three = Document::parse("three.toml", THREE);
    let cases: [(Document, &[&str]); 8] = [
        (shipped("driven-cart.toml", &[]), &["force.buffer.stiffness=20:30:2 N/m", "parameters.frequency=3:4:2 rad/s"]),
        (shipped("double-pendulum.toml", &[]), &["joint.elbow.angle=0:90:3 deg", "particle[1].mass=2:1:3"]),
        (shipped("double-pendulum.toml", &[]), &["time.end=1:2:2", "integrator.tolerance=1e-9:1e-10:2"]),
        (three.clone(), &["body.moon.velocity[1]=1.2:1.4:3", "gravity.softening=0:1:2 mm"]),
        (three.clone(), &["body.moon.mass=1:2:2"]),
        (three.clone(), &["body[2].gm=1e-9:-1e-9:3"]),
        (three, &["body.moon.position[0]=1:1.02:3", "integrator.step=5:10:2 ms"]),
        (shipped("henon-heiles.toml", &[]), &["time.end=1:2:3 min"]),
    ];
    for (document, texts) in cases {
        let ranges = ranges(texts);
        let Ok(ensemble) = Ensemble::new(document.clone(), ranges.clone(), Vec::new(), 1, 0) else {
            assert_eq!(texts, ["body.moon.mass=1:2:2"], "both gm and mass");
            continue;
        };
        for member in 0..ensemble.members() {
            let mut other = document.clone();
            for (index, range) in ranges.iter().enumerate() {
                let below: u64 = ranges[index + 1..].iter().map(|range| range.count).product();
                other.set(&range.setting(member / below % range.count));
            }
            let expected = SceneFile::from_document(&other).map_err(|error| error.to_string());
            let found = ensemble.scene(member).map_err(|error| error.to_string());
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{texts:?}, member {member}");
        }
    }
}

/// Numbers with their bits.
fn bits(member: &Member) -> (Option<&String>, Vec<u64>) {
    (member.failure.as_ref(), member.values.iter().map(|x| x.to_bits()).collect())
}

/// Eleven members fill one vector and leave three for the next.
#[test]
fn members_together_have_the_bits_of_members_alone() {
    let ensemble = ensemble(&Document::parse("three.toml", THREE), &["body.moon.velocity[1]=1.2:1.4:11"]);
    assert_eq!(ensemble.at_once(), 8);
    let members: Vec<u64> = (0..11).collect();
    let together = ensemble.together(&members, || false);
    for (member, found) in members.into_iter().zip(&together) {
        let found = found.as_ref().unwrap_or_else(|| panic!("{member} is none"));
        assert_eq!(found.failure, None);
        assert_eq!(bits(found), bits(&ensemble.member(member)), "{member}");
    }
    assert_eq!(ensemble.together(&[0, 1, 2], || true), [None, None, None]);
}

/// Other steps, other bodies, a member that is no scene: then each goes by itself.
#[test]
fn what_cannot_go_together_goes_alone() {
    let document = Document::parse("three.toml", THREE);
    for text in ["integrator.step=5:6:3 ms", "body.moon.gm=1e-9:2e-9:3", "body.moon.gm=1e-9:-1e-9:3", "time.end=2:3:3"]
    {
        let ensemble = ensemble(&document, &[text]);
        for (member, found) in (0..3).zip(ensemble.together(&[0, 1, 2], || false)) {
            let found = found.unwrap_or_else(|| panic!("{text}: {member} is none"));
            assert_eq!(bits(&found), bits(&ensemble.member(member)), "{text}, {member}");
        }
    }
}
