//! TOML → config (RUN "Config"): one file, every key with its unit and default, errors with line and cure.
