//! The designs that a search goes on from: strings of the config, or the front of an earlier run.

use super::error::Problem;
use super::path::KeyPath;
use crate::files::names::PARETO;
use crate::grammar::Tokens;
use crate::io::{Input, Inputs, table, text};
use crate::search::params::{SearchParams, Seeds};
use std::path::PathBuf;

/// The file in which the strings stand, if they stand in one.
pub(super) fn file(seeds: &Seeds) -> Option<PathBuf> {
    match seeds {
        Seeds::Folder(folder) => Some(folder.join(PARETO)),
        Seeds::Strings(_) => None,
    }
}

/// The strings in order.
///
/// # Errors
/// Each string that is none or is too long, and a folder that has none.
pub fn strings(search: &SearchParams, inputs: &Inputs) -> Result<Vec<Tokens>, Vec<Problem>> {
    let key = KeyPath::of("search.seeds");
    let (texts, places): (Vec<String>, Vec<KeyPath>) = match &search.seeds {
        Seeds::Strings(texts) => (texts.clone(), (0..texts.len()).map(|i| key.clone().index(i)).collect()),
        Seeds::Folder(folder) => {
            let texts = front(search, inputs).map_err(|reason| {
                vec![Problem::new(key.clone(), format!("found \"{}\": {reason}", folder.display()))]
            })?;
            let places = vec![key; texts.len()];
            (texts, places)
        }
    };
    let (mut strings, mut problems) = (Vec::new(), Vec::new());
    for (text, place) in texts.iter().zip(places) {
        match text.parse::<Tokens>() {
            Err(error) => problems.push(Problem::new(place, format!("found \"{text}\": {error}"))),
            Ok(tokens) if tokens.len() > search.tokens.max => {
                let (count, most) = (tokens.len(), search.tokens.max);
                let message =
                    format!("found {count} tokens in \"{text}\"; allowed: at most search.tokens.max, {most}");
                problems.push(Problem::new(place, message));
            }
            Ok(tokens) => strings.push(tokens),
        }
    }
    if problems.is_empty() { Ok(strings) } else { Err(problems) }
}

/// The column `string` of the front of a results folder.
fn front(search: &SearchParams, inputs: &Inputs) -> Result<Vec<String>, String> {
    let file = file(&search.seeds).unwrap_or_default();
    let Input { bytes, .. } = inputs.get(&file).map_err(|error| {
        format!("{error}; allowed: a list of strings, or the folder of a finished run, which has a {PARETO}")
    })?;
    let text = text::owned(bytes).map_err(|error| format!("{PARETO}: {error}"))?;
    let (delimiter, has_hint) = table::delimiter(text.as_bytes());
    let body = if has_hint { text.split_once('\n').map_or("", |(_, body)| body) } else { &text };
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).from_reader(body.as_bytes());
    let wrong = |error: csv::Error| format!("{PARETO}: {error}");
    let header = reader.headers().map_err(wrong)?;
    let column = header.iter().position(|name| name == "string");
    let column = column.ok_or_else(|| format!("{PARETO} has no column `string`"))?;
    let rows = reader.records().map(|row| Ok(row?.get(column).unwrap_or_default().to_owned()));
    let strings: Vec<String> = rows.collect::<Result<_, _>>().map_err(wrong)?;
    if strings.is_empty() { Err(format!("{PARETO} has no design")) } else { Ok(strings) }
}
