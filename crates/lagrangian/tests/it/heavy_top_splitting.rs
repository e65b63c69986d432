//! A heavy top by free rotations between kicks of its weight.

use nalgebra::{Matrix3, Vector3};
use piola_integrators::Order;
use piola_kinematics::{Attitude, FreeRotation, Inertia};
use piola_testkit::{Tol, assert_close_at_scale, golden};

/// A top whose centre of mass is `arm` (kg m) up its axis, about its fixed point.
struct Top {
    moments: [f64; 3],
    /// m g h, N m.
    arm: f64,
    free: FreeRotation,
    attitude: Attitude<f64>,
    omega: Vector3<f64>,
}

impl Top {
    fn new(moments: [f64; 3], arm: f64, attitude: Attitude<f64>, omega: Vector3<f64>) -> Self {
        let inertia = Inertia::principal(moments).unwrap();
        let free = FreeRotation::new(&inertia, attitude, omega).unwrap();
        Self { moments, arm, free, attitude, omega }
    }

    fn kick(&mut self, h: f64) {
        let moment = Vector3::z().cross(&self.attitude.to_body(&Vector3::new(0.0, 0.0, -self.arm)));
        for (axis, inertia) in self.moments.iter().enumerate() {
            self.omega[axis] += h * moment[axis] / inertia;
        }
    }

    fn step(&mut self, order: Order, h: f64) {
        for h in order.substeps().map(|part| part * h) {
            self.kick(0.5 * h);
            self.free = self.free.restarted(self.attitude, self.omega).unwrap();
            (self.attitude, self.omega) = self.free.at(h);
            self.kick(0.5 * h);
        }
    }

    fn energy(&self) -> f64 {
        let turning: f64 =
            self.moments.iter().zip(self.omega.iter()).map(|(inertia, omega)| inertia * omega * omega).sum();
        0.5 * turning + self.arm * self.attitude.to_space(&Vector3::z()).z
    }

    /// The angular momentum about the vertical.
    fn upright(&self) -> f64 {
        let spin = Vector3::from([0, 1, 2].map(|axis| self.moments[axis] * self.omega[axis]));
        self.attitude.to_space(&spin).z
    }
}

#[test]
fn top_of_order_eight_follows_its_reference() {
    let golden = golden::load("trajectories");
    let mut compared = 0;
    for case in golden.cases.iter().filter(|case| golden::text(&case["system"]) == "heavy_top") {
        let of = |name: &str| golden::number(&case["parameters"][name]);
        let states = case["states"].as_array().unwrap();
        let attitude = |state: &serde_json::Value| -> Vec<f64> { golden::matrix(&state["Q"]).concat() };
        let start = Attitude::from_matrix(&Matrix3::from_row_slice(&attitude(&states[0]))).unwrap();
        let omega = Vector3::from_column_slice(&golden::vector(&states[0]["omega_body"]));
        let mut top = Top::new([of("A"), of("A"), of("C")], of("m") * of("g") * of("h"), start, omega);
        let mut time = golden::number(&states[0]["t"]);
        for state in &states[1..] {
            let end = golden::number(&state["t"]);
            let steps = 400;
            for _ in 0..steps {
                top.step(Order::Eight, (end - time) / f64::from(steps));
            }
            time = end;
            let tolerance = Tol::stated(3e-11, "rounding and the eighth power of the step, which the motion enlarges");
            let found = top.attitude.to_matrix().transpose();
            assert_close_at_scale("Q", found.as_slice(), &attitude(state), 1.0, tolerance);
            let expected = golden::vector(&state["omega_body"]);
            assert_close_at_scale("ω", top.omega.as_slice(), &expected, top.omega.norm(), tolerance);
            compared += 1;
        }
    }
    assert_eq!(compared, 6);
}

#[test]
fn energy_of_a_top_does_not_drift_and_what_is_kept_is_kept() {
    let start = Attitude::about_x(1.0);
    for (moments, is_symmetric) in [([1.0, 1.0, 0.25], true), ([1.0, 1.5, 0.75], false)] {
        let mut top = Top::new(moments, 4.9, start, Vector3::new(0.25, 0.5, 6.0));
        let (energy, upright, spin) = (top.energy(), top.upright(), top.omega.z);
        let mut largest = [0.0_f64; 2];
        for step in 0..20_000 {
            top.step(Order::Four, 0.02);
            let half = step / 10_000;
            largest[half] = largest[half].max((top.energy() / energy - 1.0).abs());
        }
        assert!(largest[0] < 1e-5 && largest[1] < 1.02 * largest[0], "{largest:?}");
        let rounding = Tol::ulps_because(2048.0, "a hundred thousand free rotations of an ulp each, at random");
        assert_close_at_scale("H upright", &[top.upright()], &[upright], upright.abs(), rounding);
        if is_symmetric {
            assert_close_at_scale("ω₃", &[top.omega.z], &[spin], spin.abs(), rounding);
        }
        let length = top.attitude.squared_length();
        assert_close_at_scale("|q|²", &[length], &[1.0], 1.0, rounding);
    }
}
