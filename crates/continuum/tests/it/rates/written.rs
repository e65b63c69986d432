//! Rates written and read again; what is read is validated.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::CauchyStress;
use piola_continuum::rates::strain::GreenStrainRate;
use piola_continuum::{
    rates::{
        ExponentialMotion, HomogeneousMotion, MotionRates, RateOfDeformation, RelativeDeformation, Spin,
        VelocityGradient,
    },
    stress::rates::JaumannRate,
};

#[test]
fn rates_read_equal_rates_written() {
    let l = VelocityGradient::new(Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)).expect("finite");
    let text = serde_json::to_string(&l).expect("finite");
    assert_eq!(text, "[[1.0,2.0,3.0],[4.0,5.0,6.0],[7.0,8.0,9.0]]");
    assert_eq!(serde_json::from_str::<VelocityGradient>(&text).expect("as written"), l);
    let spin = Spin::new(Vector3::new(1.0, 2.0, 3.0)).expect("finite");
    let text = serde_json::to_string(&spin).expect("finite");
    assert_eq!(serde_json::from_str::<Spin>(&text).expect("as written"), spin);
    let d = RateOfDeformation::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0).expect("finite");
    let text = serde_json::to_string(&d).expect("finite");
    assert_eq!(serde_json::from_str::<RateOfDeformation>(&text).expect("as written"), d);
    let motion = ExponentialMotion::new(l.0, Matrix3::identity()).expect("0 < det F");
    let text = serde_json::to_string(&motion).expect("finite");
    assert_eq!(serde_json::from_str::<ExponentialMotion>(&text).expect("as written"), motion);
    let rates = motion.rates(0.1).expect("0 < det F");
    let text = serde_json::to_string(&rates).expect("finite");
    assert_eq!(serde_json::from_str::<MotionRates>(&text).expect("as written"), rates);
    let relative = motion.relative(0.1, -0.05).expect("0 < det F");
    let text = serde_json::to_string(&relative).expect("finite");
    assert_eq!(serde_json::from_str::<RelativeDeformation>(&text).expect("as written"), relative);
    let strain = GreenStrainRate::new(-1.0, 2.0, 3.0, 4.0, 5.0, 6.0).expect("finite");
    let text = serde_json::to_string(&strain).expect("finite");
    assert_eq!(serde_json::from_str::<GreenStrainRate>(&text).expect("as written"), strain);
    let rate = JaumannRate(CauchyStress::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0).expect("finite"));
    let text = serde_json::to_string(&rate).expect("finite");
    assert_eq!(serde_json::from_str::<JaumannRate<CauchyStress>>(&text).expect("as written"), rate);
}

#[test]
fn bad_rates_are_not_read() {
    assert!(serde_json::from_str::<Spin>("[1e999, 0.0, 0.0]").is_err());
    let inside_out = "[[[0,0,0],[0,0,0],[0,0,0]],[[-1,0,0],[0,1,0],[0,0,1]]]";
    assert!(serde_json::from_str::<ExponentialMotion>(inside_out).is_err());
    assert!(serde_json::from_str::<RelativeDeformation>("[[-2,0,0],[0,0,0],[0,0,0]]").is_err());
    assert!(serde_json::from_str::<GreenStrainRate>("[1e999,0,0,0,0,0]").is_err());
}
