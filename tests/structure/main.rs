//! The frame solver and the gridshell model made of patterns.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod actions;
mod cable_net;
mod cases;
mod cli;
mod edges;
mod faults;
mod gridshell;
mod independent;
mod joints;
mod laws;
mod robust;
mod sizing;
mod support;
mod textbook;
