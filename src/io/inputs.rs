//! The files that a config names: read once, then used from memory.

use super::ReadError;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A file in memory.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// Where it was, for messages; its extension tells the format.
    pub file: &'a Path,
    /// What it holds.
    pub bytes: &'a [u8],
}

/// Files by the names that a config has for them. What happens to them on the disk afterwards changes nothing here.
#[derive(Clone, Debug, Default)]
pub struct Inputs(BTreeMap<PathBuf, Given>);

/// One of them, or why it could not be read: that is told where it is asked for, by the key that names it.
#[derive(Clone, Debug)]
struct Given {
    place: PathBuf,
    content: Result<Content, String>,
}

#[derive(Clone, Debug)]
struct Content {
    bytes: Vec<u8>,
    sha256: String,
}

impl Inputs {
    /// Reads files, each once; `folder` is where relative names start.
    pub fn read(folder: &Path, files: impl IntoIterator<Item = PathBuf>) -> Self {
        let mut inputs = Self::default();
        for file in files {
            if !inputs.0.contains_key(&file) {
                inputs.read_at(file.clone(), found(folder, &file));
            }
        }
        inputs
    }

    /// Reads the file that is called `name` from `place`.
    pub fn read_at(&mut self, name: PathBuf, place: PathBuf) {
        // A folder has no bytes, and a pipe may never end.
        let is_file = std::fs::metadata(&place).map(|data| data.is_file());
        let read = is_file.and_then(|is_file| is_file.then(|| std::fs::read(&place)).transpose());
        match read {
            Ok(Some(bytes)) => self.insert(name, place, bytes),
            refused => {
                let reason = refused.err().map_or("it is no file".to_owned(), |error| error.to_string());
                self.0.insert(name, Given { place, content: Err(reason) });
            }
        }
    }

    /// Puts in a file that is in memory already; `place` is what messages call it.
    pub fn insert(&mut self, name: PathBuf, place: PathBuf, bytes: Vec<u8>) {
        let sha256 = sha256(&bytes);
        self.0.insert(name, Given { place, content: Ok(Content { bytes, sha256 }) });
    }

    /// The file that is called `name`.
    ///
    /// # Errors
    /// [`ReadError::Open`]: it could not be read.
    pub fn get(&self, name: &Path) -> Result<Input<'_>, ReadError> {
        let refused =
            |file: &Path, reason: &str| ReadError::Open { file: file.into(), reason: reason.into() };
        let given = self.0.get(name).ok_or_else(|| refused(name, "it was not read with the config"))?;
        match &given.content {
            Ok(content) => Ok(Input { file: &given.place, bytes: &content.bytes }),
            Err(reason) => Err(refused(&given.place, reason)),
        }
    }

    /// SHA-256 of each file that could be read, by its name.
    pub fn hashes(&self) -> BTreeMap<String, String> {
        let read = |(name, given): (&PathBuf, &Given)| {
            Some((name.display().to_string(), given.content.as_ref().ok()?.sha256.clone()))
        };
        self.0.iter().filter_map(read).collect()
    }
}

/// Where a file is that is called `name` in `folder`: a name written on Windows is understood elsewhere too.
pub fn found(folder: &Path, name: &Path) -> PathBuf {
    let place = folder.join(name);
    let text = name.to_string_lossy();
    if cfg!(windows) || place.exists() || !text.contains('\\') {
        return place;
    }
    let turned = folder.join(text.replace('\\', "/"));
    if turned.exists() { turned } else { place }
}

/// SHA-256 in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Bytes as hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut hex, byte| {
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn what_is_read_stays_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("data")).unwrap();
        let file = folder.path().join("data/roof.obj");
        fs::write(&file, b"v 0 0 0").unwrap();
        let names = ["data/roof.obj", r"data\roof.obj", "none.obj"].map(PathBuf::from);
        let inputs = Inputs::read(folder.path(), names.clone());
        fs::remove_file(&file).unwrap();
        assert_eq!(inputs.get(&names[0]).unwrap().bytes, b"v 0 0 0");
        assert_eq!(inputs.get(&names[1]).unwrap().bytes, b"v 0 0 0");
        let error = inputs.get(&names[2]).unwrap_err().to_string();
        assert!(error.contains("none.obj: "), "{error}");
        assert_eq!(inputs.hashes().len(), 2);
    }

    #[test]
    fn the_hash_is_the_published_one() {
        // FIPS 180-2, B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), abc);
    }
}
