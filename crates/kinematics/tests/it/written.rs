//! What is written is read back, what is impossible is not.

use nalgebra::Vector3;
use piola_kinematics::euler_angles::{AnglesOfAttitude, EulerRates};
use piola_kinematics::twist::ScrewAxis;
use piola_kinematics::{
    Attitude, BodyMotion, BodyPose, BodyTwist, BodyVelocity, EulerAngles, EulerChart, EulerSequence, Solid, SpaceTwist,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Reads back what was written, and refuses it when `part` is replaced.
fn read_and_refuse<D: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(data: &D, [part, by]: [&str; 2]) {
    let text = serde_json::to_string(data).expect("text");
    assert_eq!(&serde_json::from_str::<D>(&text).expect("as written"), data, "{text}");
    assert!(text.contains(part), "{text}");
    let read = serde_json::from_str::<D>(&text.replacen(part, by, 1));
    assert!(read.is_err(), "{read:?}");
}

#[test]
fn motions_of_bodies_are_read_as_written() {
    let turned = Attitude { w: 0.0, x: 0.0, y: 0.0, z: 1.0 };
    let pose = BodyPose { position: Vector3::new(1.0, 2.0, 3.0), attitude: turned };
    read_and_refuse(&pose, ["[0.0,0.0,0.0,1.0]", "[0.0,0.0,0.0,2.0]"]);
    read_and_refuse(&pose, ["1.0", "null"]);
    let velocity = BodyVelocity { velocity: Vector3::<f64>::x(), angular_velocity: Vector3::y() };
    read_and_refuse(&velocity, ["[1.0,0.0,0.0]", "[1.0,0.0]"]);
    read_and_refuse(&BodyMotion::<f64>::at_rest(), ["angular_acceleration", "angular"]);
    let twist = BodyTwist::new(Vector3::new(0.0, 0.0, 0.5), Vector3::<f64>::x());
    assert_eq!(serde_json::to_string(&twist).expect("text"), r#"{"angular":[0.0,0.0,0.5],"linear":[1.0,0.0,0.0]}"#);
    read_and_refuse(&twist, ["0.5", "null"]);
    let screw = SpaceTwist::screw(&Vector3::x(), &Vector3::z(), 0.25).and_then(|screw| screw.screw_axis());
    let screw: ScrewAxis = screw.expect("a screw");
    read_and_refuse(&screw, ["screw", "nail"]);
    let placed = Solid::Cone { radius: 1.0, height: 2.0 }.body(3.0).expect("a body");
    read_and_refuse(&placed, ["\"mass\":3.0", "\"mass\":-3.0"]);
}

#[test]
fn angles_and_charts_are_read_as_written() {
    let chart = EulerChart::new(EulerAngles::zyz([0.25, 0.5, 0.75]), [1.0, 2.0, 3.0], 4.0).expect("a chart");
    read_and_refuse(&chart, ["4.0", "1.5"]);
    let angles: AnglesOfAttitude = EulerAngles::of_attitude(EulerSequence::Zyz, Attitude::about_z(0.5));
    read_and_refuse(&angles, ["gimbal", "gimball"]);
    let rates: EulerRates = EulerAngles::zyz([0.0, 1.5, 0.0]).rates(&Vector3::new(-2.0, 0.0, 0.0)).expect("regular");
    read_and_refuse(&rates, ["\"rates\":[", "\"rates\":[null,"]);
}
