//! A config with the files that it names, as they were when it was read.

use super::error::{ConfigError, Place, Problem};
use super::path::KeyPath;
use super::source::Source;
use super::{Config, read_inputs, resolved, rules, schema, seeds};
use crate::files::names::MANIFEST;
use crate::grammar::Tokens;
use crate::io::Inputs;
use std::path::{Path, PathBuf};
use toml::Table;

/// A config that passed every check, defaults filled in, with the files that it names and the designs that a search goes on
/// from. Each file was read once: nothing that happens to one on the disk from now on changes anything.
///
/// It is made from a file, from text or from values; all rules are checked then, and a [`Study`](crate::study::Study) is made of
/// nothing else.
#[derive(Debug)]
pub struct ResolvedConfig {
    config: Config,
    inputs: Inputs,
    seeds: Vec<Tokens>,
    folder: PathBuf,
    source: Source,
}

impl ResolvedConfig {
    /// Reads a config file, `-` for stdin, with `key=value` arguments laid over it, and the files that it names.
    ///
    /// # Errors
    /// [`ConfigError`]: the file cannot be read, is not TOML, or says something that is not allowed; then all problems
    /// found are listed.
    pub fn open(file: &Path, sets: &[String]) -> Result<Self, ConfigError> {
        Self::of_source(Source::read(file, sets)?, file)
    }

    /// As [`ResolvedConfig::open`], from text. `file` stands for it in messages, gives the run its name, and its folder is where the
    /// paths in the text start; it need not be there.
    ///
    /// # Errors
    /// As [`ResolvedConfig::open`].
    pub fn parse(text: &str, file: &Path, sets: &[String]) -> Result<Self, ConfigError> {
        Self::of_source(Source::parse(file, text.to_owned(), sets)?, file)
    }

    /// As [`ResolvedConfig::parse`], from values, as a program makes them.
    ///
    /// # Errors
    /// As [`ResolvedConfig::open`].
    pub fn of(values: Table, file: &Path) -> Result<Self, ConfigError> {
        Self::of_source(Source::of(values, file), file)
    }

    /// A config as a run recorded it ([`recorded`](super::recorded)), with its inputs found again, in `folder`.
    ///
    /// # Errors
    /// [`ConfigError::Invalid`]: it does not pass the checks of today.
    pub fn again(config: &Config, inputs: Inputs, folder: &Path) -> Result<Self, ConfigError> {
        let file = folder.join(MANIFEST);
        let values = Table::try_from(config).map_err(|error| ConfigError::Syntax {
            file: file.clone(),
            line: 1,
            message: error.to_string(),
        })?;
        Self::with_inputs(Source::of(values, &file), folder, |_| inputs)
    }

    fn of_source(source: Source, file: &Path) -> Result<Self, ConfigError> {
        let stem = file.file_stem().filter(|_| !is_stream(file));
        let stem = stem.map_or("run".into(), |stem| name_of(&stem.to_string_lossy()));
        let folder = folder_of(file);
        let mut resolved = Self::with_inputs(source, folder, |config| {
            config.run.name.get_or_insert(stem);
            read_inputs(config, folder)
        })?;
        resolved.folder = from_the_root(folder);
        Ok(resolved)
    }

    /// Checks everything, once.
    fn with_inputs(
        source: Source,
        folder: &Path,
        inputs: impl FnOnce(&mut Config) -> Inputs,
    ) -> Result<Self, ConfigError> {
        let mut config = parse(&source)?;
        resolved::fill_in(&mut config, source.values());
        let inputs = inputs(&mut config);
        let mut problems = rules::check(&config, &inputs);
        let seeds = seeds::strings(&config.search, &inputs).unwrap_or_else(|wrong| {
            problems.extend(wrong);
            Vec::new()
        });
        if !problems.is_empty() {
            return Err(source.locate(problems));
        }
        Ok(Self { config, inputs, seeds, folder: folder.to_path_buf(), source })
    }

    /// The config.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The files that it names.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// The designs that a search goes on from.
    pub fn seeds(&self) -> &[Tokens] {
        &self.seeds
    }

    /// The folder to which the names of its files are relative, from the root and without `..`.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Gives a run that has no seed one: all that may still change, since no design's worth depends on it.
    pub fn seed_with(&mut self, seed: u64) {
        self.config.run.seed.get_or_insert(seed);
    }

    /// Where the config says something, for errors that only show when it is put to use.
    pub fn place(&self, key: &str) -> Place {
        self.source.place(&KeyPath::of(key))
    }
}

/// The name of a run whose config file is called so: what a folder's name cannot have becomes `_`, since what a file is called makes no
/// config invalid.
fn name_of(stem: &str) -> String {
    let fits = |c: char| if rules::fits_in_a_name(c) { c } else { '_' };
    let name: String = stem.chars().map(fits).collect();
    let name = name.trim_end_matches(['.', ' ']);
    match name {
        "" => "run".to_owned(),
        name if rules::is_name_of_a_folder(name) => name.to_owned(),
        device => format!("{device}_"),
    }
}

fn parse(source: &Source) -> Result<Config, ConfigError> {
    let problems = schema::check(source.values());
    if !problems.is_empty() {
        return Err(source.locate(problems));
    }
    serde_path_to_error::deserialize(source.values().clone()).map_err(|error| {
        // The schema lets nothing through that serde refuses; should it, the key is still named.
        let key = KeyPath::of(&error.path().to_string());
        source.locate(vec![Problem::new(key, error.inner().message().to_owned())])
    })
}

/// The folder to which the paths in a config file are relative; of one that comes through a pipe, the current one.
pub fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !is_stream(file) => folder,
        _ => Path::new("."),
    }
}

/// Whether a config comes from stdin or a pipe, as `-`, `/dev/stdin` and `<(…)` of a shell do.
fn is_stream(file: &Path) -> bool {
    let device = ["-", "/dev", "/proc"].iter().any(|start| file.starts_with(start));
    device || (file.exists() && !file.is_file() && !file.is_dir())
}

/// A folder by a path without `..`, `.` and links, so that it is found again from anywhere.
fn from_the_root(folder: &Path) -> PathBuf {
    // Windows' own form of such a path begins with `\\?\`, which few programs take; `absolute` removes `..` there.
    let real = if cfg!(windows) { std::path::absolute(folder) } else { folder.canonicalize() };
    real.unwrap_or_else(|_| folder.to_path_buf())
}
