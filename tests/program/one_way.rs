//! The modules' arrows (docs/ARCHITECTURE.md): a stage uses only stages before it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// For each module, what it may use of the crate besides itself.
const ARROWS: &[(&str, &[&str])] = &[
    ("random", &[]),
    ("json", &[]),
    ("simd", &[]),
    ("mesh", &["json"]),
    ("grammar", &["mesh", "random"]),
    ("io", &["json", "mesh"]),
    ("surface", &["io", "simd"]),
    ("domain", &["mesh", "io", "surface"]),
    ("skeleton", &["json", "mesh", "io", "surface", "domain", "geometry"]),
    ("geometry", &["mesh", "surface", "domain", "simd"]),
    ("structure", &["geometry", "json", "random", "simd"]),
    ("objectives", &["mesh", "geometry", "structure"]),
    ("evolve", &["random"]),
    ("search", &["mesh", "grammar", "evolve", "random", "output"]),
];

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The first path segments after each `crate::` (also of `crate::{a::b, c}`) outside comments and test modules.
fn uses(source: &str) -> Vec<String> {
    let code = source.split("#[cfg(test)]").next().unwrap_or("");
    let code: String =
        code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let word = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let Some(group) = rest.strip_prefix('{') else {
            found.push(word(rest));
            continue;
        };
        let mut depth = 0;
        let mut item = String::new();
        for c in group.chars() {
            match c {
                '}' if depth == 0 => break,
                ',' if depth == 0 => found.push(word(std::mem::take(&mut item).trim())),
                _ => {
                    depth += i32::from(c == '{') - i32::from(c == '}');
                    item.push(c);
                }
            }
        }
        found.push(word(item.trim()));
    }
    found.retain(|name| !name.is_empty());
    found
}

#[test]
fn uses_are_found() {
    let source = "use crate::a;\n// use crate::no;\nuse crate::{b::{x, y}, c};\nlet z = crate::d::f();";
    assert_eq!(uses(source), ["a", "b", "c", "d"]);
}

#[test]
fn every_arrow_points_forward() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let arrows: BTreeMap<_, _> = ARROWS.iter().copied().collect();
    let mut checked = 0;
    let mut wrong = Vec::new();
    for (module, allowed) in &arrows {
        let mut files = Vec::new();
        let folder = src.join(module);
        if folder.is_dir() {
            rust_files(&folder, &mut files);
        } else {
            files.push(folder.with_extension("rs"));
        }
        for file in files {
            for used in uses(&fs::read_to_string(&file).unwrap()) {
                checked += 1;
                if used != *module && !allowed.contains(&used.as_str()) {
                    wrong.push(format!("{} uses crate::{used}", file.display()));
                }
            }
        }
    }
    assert!(checked > 50, "the test found only {checked} uses: it looks in the wrong place");
    assert!(wrong.is_empty(), "arrows that point back:\n{}", wrong.join("\n"));
}
