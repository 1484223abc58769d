//! Results folder and interchange formats: one exporter a file, each returns bytes.
