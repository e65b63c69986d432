//! What is written is read again, and checked.

use piola_characteristics::{CauchyProblem, Classification, Front, ParameterInterval, Ray, Refinement, Sheet};

use super::systems::{Eikonal, Parabola};

#[test]
fn reports_survive_being_written() {
    let problem = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap().near(&[0.0, 1.0]).unwrap();
    let interval = [ParameterInterval { from: -1.0, to: 1.0, parts: 4 }];
    let class = problem.classify(&interval).unwrap();
    let read: Classification = serde_json::from_str(&serde_json::to_string(&class).unwrap()).unwrap();
    assert_eq!(read, class);
    let solution = problem.solve(&interval, (0.0, 0.5), Refinement::to(1e-2)).unwrap();
    let ray: Ray = serde_json::from_str(&serde_json::to_string(&solution.rays()[1]).unwrap()).unwrap();
    assert_eq!(&ray, &solution.rays()[1]);
    let sheet = solution.at(&[0.1, 0.4]).unwrap();
    let read: Sheet = serde_json::from_str(&serde_json::to_string(&sheet).unwrap()).unwrap();
    assert_eq!(read, sheet);
    let front = problem.front(&interval).unwrap();
    let text = serde_json::to_string(&front).unwrap();
    assert_eq!(serde_json::from_str::<Front>(&text).unwrap(), front);
    assert!(serde_json::from_str::<Front>(r#"{"variables":2,"rows":[1.0,2.0],"s":0.0}"#).is_err());
}
