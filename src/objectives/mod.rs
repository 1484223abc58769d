//! What is minimised and reported: one metric a file, one line in a list.
