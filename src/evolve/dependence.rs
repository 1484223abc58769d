//! Whether objectives tell designs apart, each in its own way: an objective that is constant, or a function of another,
//! adds nothing to a search but non-dominated designs.

/// Fewer different values than this say nothing about a function.
const ENOUGH: usize = 6;
/// Values nearer than this, relative to the larger, are equal.
const EQUAL: f64 = 1e-9;

/// Something that is wrong with the objectives of a sample.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Redundancy {
    /// An objective has one value.
    Constant {
        /// Its index.
        objective: usize,
        /// The value.
        value: f64,
    },
    /// Two objectives put all points in the same order, or in opposite ones: each is a function of the other.
    Dependent {
        /// Their indices, the smaller first.
        objectives: [usize; 2],
        /// What makes one smaller makes the other larger.
        opposed: bool,
    },
}

/// The redundancies in a sample of objective values, one row a point; by objective, then by the second one.
///
/// Two objectives count as dependent when one is a monotone function of the other over the whole sample: equal exactly
/// where the other is equal, and smaller always, or never, where the other is smaller. Nothing is said about fewer than
/// six points, or six different values.
pub fn redundancies(points: &[Vec<f64>]) -> Vec<Redundancy> {
    let count = points.iter().map(Vec::len).min().unwrap_or(0);
    if points.len() < ENOUGH {
        return Vec::new();
    }
    let mut found = Vec::new();
    let constant = |m: usize| points.iter().all(|p| compare(p[m], points[0][m]) == 0);
    for a in 0..count {
        if constant(a) {
            found.push(Redundancy::Constant { objective: a, value: points[0][a] });
        }
        let others = (a + 1..count).filter_map(|b| Some((b, opposed(points, a, b)?)));
        found.extend(others.map(|(b, opposed)| Redundancy::Dependent { objectives: [a, b], opposed }));
    }
    found
}

/// Whether two dependent objectives are opposed; `None` where they are independent.
fn opposed(points: &[Vec<f64>], a: usize, b: usize) -> Option<bool> {
    let mut direction = 0;
    let mut different = 0;
    for (i, p) in points.iter().enumerate() {
        let mut new = true;
        for q in &points[..i] {
            let (by_a, by_b) = (compare(p[a], q[a]), compare(p[b], q[b]));
            new &= by_a != 0;
            match by_a * by_b {
                0 if by_a == by_b => {}
                0 => return None,
                same if direction == 0 => direction = same,
                same if same != direction => return None,
                _ => {}
            }
        }
        different += usize::from(new);
    }
    (different >= ENOUGH).then_some(direction < 0)
}

/// −1, 0 or 1: less, equal, more.
fn compare(x: f64, y: f64) -> i32 {
    let difference = x - y;
    match difference.abs() <= EQUAL * x.abs().max(y.abs()) {
        true => 0,
        false if difference < 0.0 => -1,
        false => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_and_functions_are_found_and_nothing_else() {
        let xs = [3.0, 1.0, 4.0, 1.5, 9.0, 2.6, 5.0, 3.0];
        // x, a constant, a growing and a falling function of x, a function that is not monotone, something else.
        let row = |x: &f64| vec![*x, 7.0, x * x + 1.0, 1.0 / x, (x - 3.0).abs(), (x * 12.9898).sin()];
        let found = redundancies(&xs.iter().map(row).collect::<Vec<_>>());
        let dependent = |a, b, opposed| Redundancy::Dependent { objectives: [a, b], opposed };
        assert_eq!(
            found,
            [
                dependent(0, 2, false),
                dependent(0, 3, true),
                Redundancy::Constant { objective: 1, value: 7.0 },
                dependent(2, 3, true),
            ]
        );
    }

    #[test]
    fn few_points_or_few_values_say_nothing() {
        let line = |count: usize, values: usize| -> Vec<Vec<f64>> {
            (0..count).map(|i| vec![(i % values) as f64, 2.0 * (i % values) as f64]).collect()
        };
        assert_eq!(redundancies(&line(5, 5)), []);
        assert_eq!(redundancies(&line(20, 5)), []);
        assert_eq!(redundancies(&line(20, 6)).len(), 1);
        assert_eq!(redundancies(&[]), []);
    }

    #[test]
    fn rounding_is_no_difference() {
        let points: Vec<Vec<f64>> = (0..9).map(|i| vec![1.0 + 1e-12 * f64::from(i), f64::from(i)]).collect();
        assert_eq!(redundancies(&points), [Redundancy::Constant { objective: 0, value: 1.0 }]);
    }
}
