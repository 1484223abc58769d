//! A folder as an argument: one to write into, or a results folder, read back.

use super::CliError;
use quadrille::grammar::Tokens;
use quadrille::mesh::Code;
use quadrille::output::designs::{digits, id};
use quadrille::output::load::{Loaded, load};
use quadrille::search::EvaluatedRow;
use quadrille::study::Study;
use std::path::Path;

/// Refuses an --out that is a file, before anything is done for it.
pub fn refuse_file(out: &Path) -> Result<(), CliError> {
    match out.is_file() {
        true => Err(CliError::Input(format!("--out {}: a file; allowed: a folder", out.display()))),
        false => Ok(()),
    }
}

/// Refuses a file in a folder that is not there, before anything is done for it.
pub fn folder_exists(file: &Path) -> Result<(), String> {
    match file.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => Err(format!("there is no folder {}; make it first", folder.display())),
        None => Ok(()),
    }
}

/// Reads a results folder and makes its config ready.
pub fn open(folder: &Path) -> Result<(Loaded, Study), CliError> {
    let loaded = load(folder).map_err(|error| CliError::Input(error.to_string()))?;
    let study = Study::new(&loaded.config, &loaded.config_folder)
        .map_err(|error| CliError::Input(format!("{}: {error}", folder.display())))?;
    Ok((loaded, study))
}

/// The evaluated design whose id begins with `text`, with its letter or, as in results of quadrille 0.1, without.
pub fn find<'a>(loaded: &'a Loaded, text: &str) -> Result<&'a EvaluatedRow, CliError> {
    let begins = |row: &&EvaluatedRow| !text.is_empty() && row.code.to_string().starts_with(digits(text));
    let matching: Vec<&EvaluatedRow> = loaded.evaluated.iter().filter(begins).collect();
    match matching.as_slice() {
        [one] => Ok(one),
        [] => {
            Err(CliError::Input(format!("no design has an id that begins with \"{text}\"; see history.csv")))
        }
        several => {
            let ids: Vec<String> = several.iter().take(5).map(|row| id(row.code)).collect();
            Err(CliError::Input(format!(
                "several designs have ids that begin with \"{text}\": {}",
                ids.join(", ")
            )))
        }
    }
}

/// Whether a string still means the topology that it was recorded with.
pub fn same_code(study: &Study, tokens: &Tokens, recorded: Code) -> bool {
    // Files hold the first 64 bits.
    study.topology(tokens).code.to_string() == recorded.to_string()
}
