//! Numbers as text.

use std::fmt::Write;

/// The shortest text that reads back as the same number; none for what is not finite.
///
/// Very large and very small numbers get an exponent (`1.5e-9`); −0 is written as 0, so that equal numbers are equal
/// text.
pub fn shortest(value: f64) -> Option<String> {
    if !value.is_finite() {
        return None;
    }
    let mut text = String::new();
    push_shortest(&mut text, value);
    Some(text)
}

/// Appends what [`shortest`] gives; nothing for what is not finite.
pub fn push_shortest(text: &mut String, value: f64) {
    if value == 0.0 {
        text.push('0');
    } else if (1e-5..1e16).contains(&value.abs()) {
        let mut buffer = zmij::Buffer::new();
        let digits = buffer.format_finite(value);
        text.push_str(digits.strip_suffix(".0").unwrap_or(digits));
    } else if value.is_finite() {
        let _ = write!(text, "{value:e}");
    }
}

/// Appends a whole number.
pub fn push_integer(text: &mut String, value: impl itoa::Integer) {
    text.push_str(itoa::Buffer::new().format(value));
}

/// At most `decimals` digits after the point, without trailing zeros: for pictures.
pub fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// Appends what [`rounded`] gives with one decimal, sooner: pictures have many coordinates.
pub fn push_tenths(text: &mut String, value: f64) {
    let scaled = value.abs() * 10.0;
    let whole = scaled.floor();
    // Near the middle of two tenths the exact decimals decide.
    if scaled >= 1e12 || scaled.is_nan() || (scaled - whole - 0.5).abs() < 1e-3 {
        return text.push_str(&rounded(value, 1));
    }
    let tenths = if scaled - whole > 0.5 { whole as u64 + 1 } else { whole as u64 };
    if value < 0.0 && tenths > 0 {
        text.push('-');
    }
    push_integer(text, tenths / 10);
    if tenths % 10 > 0 {
        text.push('.');
        push_integer(text, tenths % 10);
    }
}

/// Five significant digits: for people.
pub fn significant(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    shortest(rounded).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortest_reads_back() {
        for value in [0.1, 1.0 / 3.0, -36.625, 1e-9, 210e9, 1e16, 5e-324, f64::MAX, 22.245] {
            let text = shortest(value).unwrap();
            assert_eq!(text.parse::<f64>().unwrap(), value, "{text}");
        }
        assert_eq!(shortest(2.0).as_deref(), Some("2"));
        assert_eq!(shortest(-0.0).as_deref(), Some("0"));
        assert_eq!(shortest(1.5e-9).as_deref(), Some("1.5e-9"));
        assert_eq!(shortest(f64::NAN), None);
        assert_eq!(shortest(f64::INFINITY), None);
    }

    #[test]
    fn shortest_is_as_short_as_that_of_the_standard_library() {
        let mut random = crate::random::stream(1, 0, 0);
        let random = (0..200_000).map(|_| f64::from_bits(rand::Rng::next_u64(&mut random)));
        let bounds = [1e-5, 1e16, 1e-4, 1e15, f64::MIN_POSITIVE, f64::MAX];
        let around = bounds.into_iter().flat_map(|x| [x.next_down(), x, x.next_up()]);
        let powers = (-300..300).map(|e| 10f64.powi(e));
        let wholes = (0..1000u32).map(f64::from);
        for x in random.chain(around).chain(powers).chain(wholes).filter(|x| x.is_finite() && *x != 0.0) {
            let plain = (1e-5..1e16).contains(&x.abs());
            let expected = if plain { x.to_string() } else { format!("{x:e}") };
            let found = shortest(x).unwrap();
            // Where the number lies in the middle of two shortest texts, either will do.
            let as_good = found.len() == expected.len() && found.parse() == Ok(x);
            assert!(found == expected || as_good, "{found} {expected}");
        }
    }

    #[test]
    fn rounded_is_short() {
        assert_eq!(rounded(1.5000, 3), "1.5");
        assert_eq!(rounded(100.0, 2), "100");
        assert_eq!(rounded(-0.0001, 2), "0");
        let values = (-20_000..20_000).map(|k| f64::from(k) * 0.01);
        for value in values.chain([1e15, -1e300, f64::NAN, f64::INFINITY, 0.05, -0.05, 0.15, 0.25]) {
            let mut text = String::new();
            push_tenths(&mut text, value);
            assert_eq!(text, rounded(value, 1), "{value}");
        }
    }
}
