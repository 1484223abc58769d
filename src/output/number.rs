//! Numbers as text.

/// The shortest text that reads back as the same number; none for what is not finite.
///
/// Very large and very small numbers get an exponent (`1.5e-9`); −0 is written as 0, so that equal numbers are equal
/// text.
pub fn shortest(value: f64) -> Option<String> {
    if !value.is_finite() {
        return None;
    }
    let magnitude = value.abs();
    Some(if magnitude == 0.0 {
        "0".into()
    } else if (1e-5..1e16).contains(&magnitude) {
        value.to_string()
    } else {
        format!("{value:e}")
    })
}

/// At most `decimals` digits after the point, without trailing zeros: for pictures.
pub fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
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
    fn rounded_is_short() {
        assert_eq!(rounded(1.5000, 3), "1.5");
        assert_eq!(rounded(100.0, 2), "100");
        assert_eq!(rounded(-0.0001, 2), "0");
    }
}
