//! The last rule dropped.

use super::rule_ends;
use crate::grammar::Tokens;

/// An expressed string without its last rule and the walk to it; `None` if there is no rule.
pub fn drop_last(expressed: &Tokens) -> Option<Tokens> {
    let ends = rule_ends(expressed);
    let kept = match ends.as_slice() {
        [] => return None,
        [_] => 0,
        [.., last_but_one, _] => *last_but_one,
    };
    Some(expressed[..kept].iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_stays() {
        let dropped = |text: &str| drop_last(&text.parse().unwrap()).map(|t| t.to_string());
        assert_eq!(dropped("TDPATTA").as_deref(), Some("TD"));
        assert_eq!(dropped("PATTA*").as_deref(), Some(""));
        assert_eq!(dropped("TTP"), None);
    }
}
