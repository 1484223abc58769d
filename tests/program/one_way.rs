//! The modules' arrows (docs/ARCHITECTURE.md): a stage uses only stages before it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The rows of the table in docs/ARCHITECTURE.md, in order: each module with what it may use of the crate besides itself.
fn arrows() -> Vec<(String, BTreeSet<String>)> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/ARCHITECTURE.md");
    let page = fs::read_to_string(page).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("| module |")).skip(2);
    let words = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').collect();
            (words(cells[0]).concat(), words(cells[cells.len() - 1]).into_iter().collect())
        })
        .collect()
}

/// The modules that `lib.rs` declares.
fn modules(src: &Path) -> BTreeSet<String> {
    let library = fs::read_to_string(src.join("lib.rs")).unwrap();
    let declared = library.lines().filter_map(|line| line.trim_start_matches("pub ").strip_prefix("mod "));
    declared.filter_map(|rest| rest.strip_suffix(';')).map(str::to_owned).collect()
}

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
fn the_table_lists_every_module_and_points_up_only() {
    let arrows = arrows();
    let listed: BTreeSet<String> = arrows.iter().map(|(module, _)| module.clone()).collect();
    assert_eq!(listed, modules(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")));
    for (row, (module, allowed)) in arrows.iter().enumerate() {
        let above: BTreeSet<String> = arrows[..row].iter().map(|(module, _)| module.clone()).collect();
        let below: Vec<&String> = allowed.difference(&above).collect();
        assert!(below.is_empty(), "{module} may use {below:?}, which do not stand above it");
    }
}

#[test]
fn every_module_uses_what_its_row_says() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut checked = 0;
    let mut wrong = Vec::new();
    for (module, allowed) in arrows() {
        let mut files = Vec::new();
        let (folder, file) = (src.join(&module), src.join(&module).with_extension("rs"));
        if folder.is_dir() {
            rust_files(&folder, &mut files);
        }
        files.extend(file.is_file().then_some(file));
        let mut used_of_row = BTreeSet::new();
        for file in files {
            for used in uses(&fs::read_to_string(&file).unwrap()) {
                checked += 1;
                if used == module {
                    continue;
                }
                if !allowed.contains(&used) {
                    wrong.push(format!("{} uses crate::{used}", file.display()));
                }
                used_of_row.insert(used);
            }
        }
        for idle in allowed.difference(&used_of_row) {
            wrong.push(format!("{module} has {idle} in its row and does not use it"));
        }
    }
    assert!(checked > 50, "the test found only {checked} uses: it looks in the wrong place");
    assert!(wrong.is_empty(), "the table and the code differ:\n{}", wrong.join("\n"));
}
