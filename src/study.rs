//! The pipeline in one place: string → evaluated design.
