//! Who hears of a search: the user, and the manifest.

use super::progress::Display;
use quadrille::mesh::Code;
use quadrille::output::folder::Folder;
use quadrille::output::sitting::Sitting;
use quadrille::search::{Evaluation, GenerationRow, Observer, Progress};

/// Who hears of the search: the user, and the manifest.
pub struct Watch {
    /// Tells the user.
    pub display: Display,
    /// Tells the manifest.
    pub sitting: Sitting,
    /// Where that is.
    pub folder: Folder,
}

impl Observer for Watch {
    fn design(&mut self, code: Code, evaluation: &Evaluation) {
        self.display.design(code, evaluation);
    }

    fn evaluated(&mut self, progress: &Progress) {
        self.display.evaluated(progress);
    }

    fn generation(&mut self, row: &GenerationRow) {
        self.display.generation(row);
        // A manifest that cannot be written ends the run no sooner than a table that cannot.
        if let Err(error) = self.sitting.generation(&mut self.folder, row) {
            self.display.warning(&error.to_string());
        }
    }

    fn notice(&mut self, message: &str) {
        self.display.notice(message);
    }

    fn warning(&mut self, message: &str) {
        self.display.warning(message);
    }
}
