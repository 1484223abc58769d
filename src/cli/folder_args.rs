//! A folder as an argument: one to write into, or a results folder, read back.

use super::config_args::located;
use super::{CliError, Console};
use quadrille::config::ResolvedConfig;
use quadrille::files::lock::Lock;
use quadrille::grammar::Tokens;
use quadrille::mesh::Code;
use quadrille::output::designs::{digits, id};
use quadrille::output::inputs;
use quadrille::output::load::{self, Loaded};
use quadrille::search::EvaluatedRow;
use quadrille::study::Study;
use std::path::{Path, PathBuf};

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

/// Refuses a file that is there and of another kind than what will be written: a config, say, named by mistake.
pub fn refuse_other_kind(flag: &str, file: &Path, extension: &str) -> Result<(), CliError> {
    let is_of_kind = file.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension));
    match file.is_file() && !is_of_kind {
        true => Err(CliError::Input(format!(
            "{flag} {}: is there and does not end in .{extension}; allowed: a new file, or one that ends in .{extension}",
            file.display()
        ))),
        false => Ok(()),
    }
}

/// The results folder of a run, and where its inputs are.
#[derive(clap::Args)]
pub struct FolderArgs {
    /// The results folder of a run.
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Folder of the files that the config names, where they are no longer as and where they were.
    #[arg(long, value_name = "DIR")]
    inputs: Option<PathBuf>,
}

impl FolderArgs {
    /// Reads the folder as the run stands, and makes its config ready.
    pub fn look(&self, console: &Console) -> Result<(Loaded, Study), CliError> {
        let loaded = load::look(&self.folder).map_err(|error| CliError::Input(error.to_string()))?;
        if loaded.is_unfinished {
            console.note(&unfinished(&self.folder, &loaded));
        }
        let study = self.study(&loaded)?;
        Ok((loaded, study))
    }

    /// Reads the tables of the folder and makes the config ready.
    pub fn load(&self) -> Result<(Loaded, Study), CliError> {
        let loaded = load::load(&self.folder).map_err(|error| CliError::Input(error.to_string()))?;
        let study = self.study(&loaded)?;
        Ok((loaded, study))
    }

    /// The folder of `--inputs`, if it is there.
    pub fn inputs(&self) -> Result<Option<&Path>, CliError> {
        match &self.inputs {
            Some(folder) if !folder.is_dir() => {
                Err(CliError::Input(format!("--inputs {}: there is no such folder", folder.display())))
            }
            folder => Ok(folder.as_deref()),
        }
    }

    fn study(&self, loaded: &Loaded) -> Result<Study, CliError> {
        let Loaded { manifest, config, .. } = loaded;
        let inputs = inputs::again(manifest, config, self.inputs()?);
        let inputs = inputs.map_err(|wrong| {
            CliError::Input(wrong.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
        })?;
        let resolved = ResolvedConfig::again(config, inputs, &self.folder)?;
        Study::of(&resolved).map_err(|error| located(&resolved, &error))
    }
}

/// What is said of a run that is not finished.
pub fn unfinished(folder: &Path, loaded: &Loaded) -> String {
    let state = if Lock::is_held(folder) { "goes on" } else { "was interrupted" };
    let counts = &loaded.manifest.counts;
    format!(
        "the run in {} {state}: what it had found after generation {}, {} designs evaluated",
        folder.display(),
        counts.generations,
        counts.evaluations
    )
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
