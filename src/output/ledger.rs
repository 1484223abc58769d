//! Which files of a results folder the program has written. Only these are ever replaced or removed; of these, one that
//! was changed since is kept too.

use super::manifest::Files;
use super::refusal::FolderError;
use crate::io::hex;
use sha2::{Digest, Sha256};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// The files of a folder, before this process and by it.
#[derive(Debug, Default)]
pub struct Ledger {
    folder: PathBuf,
    before: Files,
    now: Files,
    told: Vec<String>,
}

impl Ledger {
    /// Of a folder in which these files were listed before. Names that lead out of the folder do not count.
    pub fn new(folder: &Path, mut before: Files) -> Self {
        before.retain(|name, _| Path::new(name).components().all(|c| matches!(c, Component::Normal(_))));
        Self { folder: folder.to_path_buf(), before, now: Files::new(), told: Vec::new() }
    }

    /// All files that are the program's.
    pub fn files(&self) -> Files {
        self.before.iter().chain(&self.now).map(|(name, sum)| (name.clone(), sum.clone())).collect()
    }

    /// Whether a file is listed.
    pub fn lists(&self, name: &str) -> bool {
        self.before.contains_key(name) || self.now.contains_key(name)
    }

    /// What had to be kept of others and of the user's changes, each told once.
    pub fn take_told(&mut self) -> Vec<String> {
        std::mem::take(&mut self.told)
    }

    /// Names that are about to be written. Listed before they are, a kill leaves none without its owner; what somebody
    /// else has put there already is not listed.
    pub fn announce(&mut self, names: impl IntoIterator<Item = String>) {
        for name in names {
            if !self.folder.join(&name).exists() {
                self.before.entry(name).or_insert(None);
            }
        }
    }

    /// Names of files as they were written that are about to be replaced: whether a kill leaves the old or the new one, it is the
    /// program's. One that was changed since keeps its sum, by which that is known.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn replace(&mut self, names: impl IntoIterator<Item = String>) -> Result<(), FolderError> {
        for name in names {
            let Some(Some(sum)) = self.before.get(&name) else { continue };
            let path = self.folder.join(&name);
            if !path.is_dir() && self.is_as_written(&path, sum)? {
                self.before.insert(name, None);
            }
        }
        Ok(())
    }

    /// Makes way for a file: one of that name that is not the program's, or not as it was written, is renamed. `bytes` is
    /// what will be written, where it is known.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn make_way(&mut self, name: &str, bytes: Option<&[u8]>) -> Result<(), FolderError> {
        let path = self.folder.join(name);
        let is_ours = match self.before.get(name) {
            _ if self.now.contains_key(name) => true,
            _ if path.is_dir() => false,
            Some(None) => true,
            Some(Some(sum)) => self.is_as_written(&path, sum)?,
            None => false,
        };
        if is_ours || !path.exists() {
            return Ok(());
        }
        if let Some(bytes) = bytes
            && path.is_file()
            && self.is_as_written(&path, &crate::io::sha256(bytes))?
        {
            return Ok(());
        }
        let kept = free_name(&path);
        fs::rename(&path, &kept).map_err(io_error(&path))?;
        let what = match self.before.contains_key(name) {
            true => "was changed after the run wrote it",
            false => "was not written by a run",
        };
        let kept = kept.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        self.told.push(format!("{}: {what}; it is kept as {kept}", path.display()));
        Ok(())
    }

    /// Lists a file that was written.
    pub fn written(&mut self, name: &str, sum: Option<String>) {
        self.now.insert(name.to_owned(), sum);
    }

    /// Removes the files that are listed and were not written again, but for those that `stays` names; one that was changed
    /// since it was written stays, and is listed no more.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn retire(&mut self, stays: impl Fn(&str) -> bool) -> Result<(), FolderError> {
        let old: Files = self
            .before
            .iter()
            .filter(|(name, _)| !self.now.contains_key(*name) && !stays(name))
            .map(|(name, sum)| (name.clone(), sum.clone()))
            .collect();
        for (name, sum) in old {
            let path = self.folder.join(&name);
            let is_ours = match &sum {
                _ if path.is_dir() => false,
                Some(sum) => self.is_as_written(&path, sum)?,
                None => true,
            };
            if !is_ours {
                self.told.push(format!("{}: was changed after the run wrote it; it stays", path.display()));
            } else {
                remove_file(&path)?;
            }
            self.before.remove(&name);
        }
        Ok(())
    }

    fn is_as_written(&self, path: &Path, sum: &str) -> Result<bool, FolderError> {
        let digest = || -> io::Result<String> {
            let mut hasher = Sha256::new();
            let (mut file, mut part) = (File::open(path)?, vec![0; 1 << 16]);
            loop {
                match file.read(&mut part)? {
                    0 => break,
                    count => hasher.update(&part[..count]),
                }
            }
            Ok(hex(&hasher.finalize()))
        };
        match digest() {
            Ok(found) => Ok(found == sum),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(true),
            Err(error) => Err(io_error(path)(error)),
        }
    }
}

/// Removes a file, if it is there.
pub(super) fn remove_file(path: &Path) -> Result<(), FolderError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(io_error(path)(error)),
        _ => Ok(()),
    }
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> FolderError {
    let path = path.to_path_buf();
    |source| FolderError::Io { path, source }
}

/// `pareto.csv.bak`, or with a number where there is one already.
fn free_name(path: &Path) -> PathBuf {
    let named = |number: String| {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".bak{number}"));
        PathBuf::from(name)
    };
    let numbers = std::iter::once(String::new()).chain((2u32..).map(|number| number.to_string()));
    numbers.map(named).find(|path| !path.exists()).unwrap_or_else(|| named(String::new()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kill_between_a_file_and_its_listing_does_not_make_it_the_users() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        let names = ["ours", "edited"].map(str::to_owned);
        let sum = |name: &String| (name.clone(), Some(crate::io::sha256(name.as_bytes())));
        put("ours", "ours");
        put("edited", "by me");
        let mut ledger = Ledger::new(folder.path(), names.each_ref().map(sum).into());
        ledger.replace(names.clone()).unwrap();
        // Killed here, with the new file there: the next process reads this listing.
        put("ours", "new");
        let mut next = Ledger::new(folder.path(), ledger.files());
        names.iter().for_each(|name| next.make_way(name, Some(b"newer")).unwrap());
        assert!(folder.path().join("edited.bak").exists() && !folder.path().join("ours.bak").exists());
    }

    #[test]
    fn nothing_of_others_is_replaced_or_removed() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        let text = |name: &str| fs::read_to_string(folder.path().join(name)).ok();
        let sum = |text: &str| Some(crate::io::sha256(text.as_bytes()));
        for name in ["ours", "edited", "stale", "stale-edited", "theirs"] {
            put(name, name);
        }
        let listed = ["ours", "edited", "stale", "stale-edited", "../out"];
        let files = listed.map(|name| (name.to_owned(), sum(name))).into();
        let mut ledger = Ledger::new(folder.path(), files);
        assert!(!ledger.lists("../out"));
        put("edited", "by me");
        put("stale-edited", "by me too");
        for name in ["ours", "edited", "theirs"] {
            ledger.make_way(name, Some(b"new")).unwrap();
            put(name, "new");
            ledger.written(name, sum("new"));
        }
        ledger.retire(|_| false).unwrap();
        assert_eq!(text("edited.bak").as_deref(), Some("by me"));
        assert_eq!(text("theirs.bak").as_deref(), Some("theirs"));
        assert_eq!(text("ours.bak"), None);
        assert_eq!(text("stale"), None);
        assert_eq!(text("stale-edited").as_deref(), Some("by me too"));
        assert_eq!(ledger.take_told().len(), 3);
        assert_eq!(ledger.files().into_keys().collect::<Vec<_>>(), ["edited", "ours", "theirs"]);
    }
}
