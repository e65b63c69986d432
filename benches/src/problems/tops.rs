//! Rigid bodies about a fixed point, their attitudes as quaternions.

use piola_numerics::Real;

use super::reference::{array, numbers, read_golden};
use super::{Equations, LONGEST_RUN, Problem, ReferenceError};

/// A top with the state (q, Ω), q a unit quaternion (body to space) and Ω the angular velocity in the body:
///
/// ```text
/// q̇ = ½ q (0, Ω),    J Ω̇ = J Ω × Ω + w × Rᵀ(0, 0, −1)
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Top {
    /// The principal moments of inertia about the fixed point, kg m².
    pub inertia: [f64; 3],
    /// Weight times the arm to the centre of mass, in the body, N m.
    pub weight: [f64; 3],
}

impl Top {
    /// Ω̇ of a state (q, Ω).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn angular_acceleration<T: Real>(&self, q: [T; 4], omega: [T; 3]) -> [T; 3] {
        let [j1, j2, j3] = self.inertia;
        let mut moment = [
            T::lit(j2 - j3) * omega[1] * omega[2],
            T::lit(j3 - j1) * omega[2] * omega[0],
            T::lit(j1 - j2) * omega[0] * omega[1],
        ];
        if self.weight.iter().any(|w| w.abs() > 0.0) {
            let [q0, q1, q2, q3] = q;
            let two = T::lit(2.0);
            let up = [two * (q1 * q3 - q0 * q2), two * (q2 * q3 + q0 * q1), q0 * q0 - q1 * q1 - q2 * q2 + q3 * q3];
            let w = self.weight.map(T::lit);
            moment[0] += up[1] * w[2] - up[2] * w[1];
            moment[1] += up[2] * w[0] - up[0] * w[2];
            moment[2] += up[0] * w[1] - up[1] * w[0];
        }
        [moment[0] * T::lit(1.0 / j1), moment[1] * T::lit(1.0 / j2), moment[2] * T::lit(1.0 / j3)]
    }
}

impl Equations<7> for Top {
    const POSITIONS: usize = 4;
    const SECOND_ORDER: bool = false;
    #[inline]
    fn rate(&self, y: &[f64; 7], rate: &mut [f64; 7]) {
        let &[q0, q1, q2, q3, a, b, c] = y;
        let [da, db, dc] = self.angular_acceleration([q0, q1, q2, q3], [a, b, c]);
        *rate = [
            -0.5 * (q1 * a + q2 * b + q3 * c),
            0.5 * (q0 * a + q2 * c - q3 * b),
            0.5 * (q0 * b + q3 * a - q1 * c),
            0.5 * (q0 * c + q1 * b - q2 * a),
            da,
            db,
            dc,
        ];
    }
}

/// A case of `golden/tops.json`, to its last time.
fn top(name: &'static str, title: &'static str, case: &str) -> Result<Problem<Top, 7>, ReferenceError> {
    let data = read_golden("tops")?;
    let cases = data["cases"].as_array().ok_or("tops.json has no cases")?;
    let case = cases.iter().find(|entry| entry["name"] == case).ok_or("tops.json lacks the case")?;
    let last = case["states"].as_array().and_then(|states| states.last()).ok_or("the case has no states")?;
    let state = |of: &serde_json::Value| -> Result<[f64; 7], ReferenceError> {
        array(&[numbers(&of["attitude"])?, numbers(&of["angular_velocity"])?].concat())
    };
    Ok(Problem {
        name,
        title,
        equations: Top {
            inertia: array(&numbers(&case["inertia"])?)?,
            weight: array(&numbers(&case["weight_times_arm"])?)?,
        },
        start: state(case)?,
        end: numbers(&last["t"])?.first().copied().unwrap_or(f64::NAN),
        reference: state(last)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}

/// A free top with three different moments of inertia, 20 s.
///
/// # Errors
/// The reference cannot be read.
pub fn free_top() -> Result<Problem<Top, 7>, ReferenceError> {
    top("free-top", "Free asymmetric top, 20 s", "free asymmetric top")
}

/// The heavy top of the test set of Brüls, Cardona and Arnold, 2 s, in which it turns by 300 rad.
///
/// # Errors
/// The reference cannot be read.
pub fn heavy_top() -> Result<Problem<Top, 7>, ReferenceError> {
    top("heavy-top", "Heavy top of the test set, 2 s", "heavy top of the test set")
}
