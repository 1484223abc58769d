//! The program as users meet it: commands, configs, folders, reports, kills.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod cli_arguments;
mod cli_axes;
mod cli_basics;
mod cli_combinations;
mod cli_config;
mod cli_objectives;
mod cli_requirements;
mod cli_run;
mod cli_sittings;
mod cli_user;
mod cli_wrong_geometry;
mod config_files;
mod config_reference;
mod files_of_others;
mod handed_on;
mod one_way;
mod report_folder;
mod report_numbers;
mod report_page;
mod reproducible;
mod results_names;
mod roof;
mod run_folders;
mod run_inputs;
mod run_kills;
mod study_designs;
mod synthetic;
mod verify_tables;
