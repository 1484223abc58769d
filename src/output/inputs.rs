//! The input files of a run, found again: as they were when it began, or told which is not.

use super::manifest::Manifest;
use crate::config::{self, Config};
use crate::io::{Inputs, found, sha256};
use std::path::{Path, PathBuf};

/// Why the inputs of a run are not those that it had.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InputError {
    /// A file holds something else now.
    #[error("{}: was changed since the run (`{name}` in its config); give the folder that has it as it was: --inputs DIR", place.display())]
    Changed {
        /// The name that the config has for it.
        name: String,
        /// Where it was found.
        place: PathBuf,
    },
    /// A file is gone.
    #[error("{}: is no longer there (`{name}` in the config of the run); give the folder that has it now: --inputs DIR", place.display())]
    Missing {
        /// The name that the config has for it.
        name: String,
        /// Where it was looked for.
        place: PathBuf,
    },
    /// The config in the manifest is not the one that the run had.
    #[error("manifest.json: its config was changed since the run")]
    Config,
}

/// The files that the config of a run names, as its manifest knows them: where they were, or in the folder `moved`, there
/// under the same name or without the folders in it.
///
/// # Errors
/// [`InputError`] for each that is not as it was.
pub fn again(manifest: &Manifest, config: &Config, moved: Option<&Path>) -> Result<Inputs, Vec<InputError>> {
    let mut inputs = Inputs::default();
    let mut wrong = Vec::new();
    // The oldest manifests have no hash of it.
    if !manifest.config_sha256.is_empty() && sha256(manifest.config.as_bytes()) != manifest.config_sha256 {
        wrong.push(InputError::Config);
    }
    for file in config::input_files(config) {
        let name = file.display().to_string();
        let places = match moved {
            Some(folder) => vec![found(folder, &file), folder.join(last(&name))],
            None => vec![found(Path::new(&manifest.config_folder), &file)],
        };
        let is_same = |inputs: &Inputs| {
            let hashes = inputs.hashes();
            manifest.input_files.get(&name).is_none_or(|recorded| hashes.get(&name) == Some(recorded))
        };
        let same = places.iter().any(|place| {
            inputs.read_at(file.clone(), place.clone());
            is_same(&inputs) && inputs.get(&file).is_ok()
        });
        if same {
            continue;
        }
        let there = places.iter().find(|place| place.is_file());
        wrong.push(match there.or(places.first()) {
            Some(place) if there.is_some() => InputError::Changed { name, place: place.clone() },
            place => InputError::Missing { name, place: place.cloned().unwrap_or_default() },
        });
    }
    if wrong.is_empty() { Ok(inputs) } else { Err(wrong) }
}

/// A file's own name, on whichever system its path was written.
fn last(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::manifest::Status;
    use std::fs;

    #[test]
    fn a_file_is_found_where_it_went_and_by_its_hash() {
        let temporary = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| {
            let path = temporary.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        let config: Config = toml::from_str(
            "domain.loop = [{ kind = 'obj', file = '..\\in\\a.obj' }]\nsurface = { kind = 'mesh', file = 'b.obj' }",
        )
        .unwrap();
        let mut manifest = Manifest::sample(Status::Finished);
        manifest.config_folder = temporary.path().join("gone").display().to_string();
        manifest.input_files = [(r"..\in\a.obj", "a"), ("b.obj", "b")]
            .map(|(name, text)| (name.to_owned(), sha256(text.as_bytes())))
            .into();
        let told = |moved: Option<&str>| {
            let moved = moved.map(|name| temporary.path().join(name));
            let wrong = again(&manifest, &config, moved.as_deref()).err().unwrap_or_default();
            wrong.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        };
        assert_eq!(told(None).matches("is no longer there").count(), 2, "{}", told(None));
        put("flat/a.obj", "a");
        put("flat/b.obj", "b");
        assert_eq!(told(Some("flat")), "");
        put("deep/in/a.obj", "a");
        put("deep/here/b.obj", "other");
        let changed = told(Some("deep/here"));
        assert!(changed.contains("b.obj: was changed") && changed.lines().count() == 1, "{changed}");
        put("gone/b.obj", "b");
        put("in/a.obj", "a");
        assert_eq!(told(None), "");
    }
}
