//! Files as other programs write them, through the program: read, or refused in one line that says what is wrong and where (issue 15).

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SQUARE: &str = "v 0 0 0\nv 16 0 0\nv 16 10 0\nv 0 10 0\n";

fn quadrille(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_quadrille")).args(arguments).current_dir(folder).output().unwrap()
}

/// `check` of a config whose boundary is `b.obj`, whose surface and initial mesh are those given.
fn check(folder: &Path, surface: &str, initial: &str) -> (Option<i32>, String) {
    let text = format!(
        "version = 1\n[[domain.loop]]\nkind = \"obj\"\nfile = \"b.obj\"\n[surface]\n{surface}\n[topology]\ninitial = {initial}\n\
         [objectives]\nminimise = [\"curvature\"]\n"
    );
    fs::write(folder.join("c.toml"), text).unwrap();
    let output = quadrille(folder, &["check", "c.toml"]);
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

fn utf16(text: &str) -> Vec<u8> {
    std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}

/// The boundary is the 16 m × 10 m outline, whatever stands around it.
#[test]
fn boundaries() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let hole = "v 6 4 0\nv 9 4 0\nv 9 6 0\nv 6 6 0\nl 5 6 7 8 5\n";
    let faults = Path::new("tests/data/faults");
    let given = fs::read(faults.join("boundary_comment_backslash.obj")).unwrap();
    let text = |text: String| text.into_bytes();
    for (name, bytes, told) in [
        ("a comment that ends in a backslash", given, ""),
        ("a name that does", text(format!("{SQUARE}g C:\\roofs\\\nl 1 2 3 4 1\n{hole}")), ""),
        ("an unknown word that does", text(format!("{SQUARE}layer C:\\roofs\\\nl 1 2 3 4 1\n{hole}")), ""),
        ("colours", text(format!("vc 1 0 0\n{SQUARE}fo 1 2 3\nl 1 2 3 4 1\n{hole}")), ""),
        ("CR alone", text(format!("# a\n{SQUARE}l 1 2 3 4 1\n{hole}").replace('\n', "\r")), ""),
        ("UTF-16", utf16(&format!("{SQUARE}l 1 2 3 4 1\n{hole}")), ""),
        ("continued", text(format!("{SQUARE}l 1 2 \\\n 3 4 \\ # so\n 1\n{hole}")), ""),
        (
            "pieces with vertices of their own",
            text(format!("{SQUARE}v 0 10 0\nv 0 0 0\nl 1 2 3 4\nl 5 6\n")),
            "",
        ),
        ("a gap", text(format!("{SQUARE}v 0 0.000001 0\nl 1 2 3 4 5\n")), "a gap of 1.000e-6 m"),
        (
            "a gap between pieces",
            text(format!("{SQUARE}v 0 10.001 0\nl 1 2 3 4\nl 5 1\n")),
            "a gap of 1.000e-3 m",
        ),
    ] {
        fs::write(folder.join("b.obj"), bytes).unwrap();
        let (code, message) = check(folder, "kind = \"plane\"", "{ grid = [2, 2] }");
        assert_eq!(code, Some(0), "{name}: {message}");
        assert!(message.contains(told) && told.is_empty() != message.contains("gap"), "{name}: {message}");
        let skeleton = quadrille(folder, &["evaluate", "c.toml", "--string", ""]);
        let table = String::from_utf8(skeleton.stdout).unwrap();
        // 160 m² in about as many panels as asked for, so edges of this length.
        let edge = table.lines().find(|line| line.starts_with("edge_mean_m")).unwrap();
        let edge: f64 = edge.split_whitespace().nth(1).unwrap().parse().unwrap();
        let faces = table.lines().find(|line| line.starts_with("faces")).unwrap();
        let faces: f64 = faces.split_whitespace().nth(1).unwrap().parse().unwrap();
        assert!((edge * edge * faces - 160.0).abs() < 3.0, "{name}: {edge} {faces}");
    }
    for (name, text, words) in [
        (
            "y up",
            "v 0 3 0\nv 16 3 0\nv 16 3 -10\nv 0 3 -10\nl 1 2 3 4 1\n",
            &["b.obj:5: the polyline has its area in x and z"][..],
        ),
        ("y up, uneven", "v 0 3 0\nv 16 3.5 0\nv 16 3 -10\nv 0 3.5 -10\nl 1 2 3 4 1\n", &["b.obj:5", "y up"]),
        (
            "a point twice",
            "v 0 0 0\nv 16 0 0\nv 16 0 0\nv 16 10 0\nv 0 10 0\nl 1 2 3 4 5 1\n",
            &["points 1 and 2 coincide", "b.obj:2 and 3"],
        ),
        (
            "nearly twice",
            "v 0 0 0\nv 16 0 0\nv 16 0.00000000001 0\nv 16 10 0\nv 0 10 0\nl 1 2 3 4 5 1\n",
            &["points 1 and 2 coincide", "b.obj:2 and 3"],
        ),
        ("crossing", "v 0 0 0\nv 16 10 0\nv 16 0 0\nv 0 10 0\nl 1 2 3 4 1\n", &["crosses", "b.obj:1 and 3"]),
        (
            "open",
            "v 0 0 0\nv 16 0 0\nv 16 10 0\nv 0 10 0\nl 1 2 3 4\n",
            &["b.obj:5", "its ends are 10.000000 m apart"],
        ),
        ("no OBJ", "solid roof\nfacet normal 0 0 1\n", &["line 1 begins with `solid`", "no keyword of OBJ"]),
        ("empty", "", &["0 polylines", "no vertices"]),
        ("overflow", "v 1e400 0 0\n", &["b.obj:1", "not finite"]),
        ("beyond", "v 0 0 0\nv 1e300 0 0\n", &["b.obj:2", "beyond"]),
        ("no number", "v 0 0 0\nv NaN 0 0\n", &["b.obj:2", "x is `NaN`"]),
        ("one vertex", "v 0 0 0\nl 1\n", &["b.obj:2", "at least 2"]),
        ("zeros", "v 0 0 0\n\0\0", &["b.obj:2", "no text file"]),
    ] {
        fs::write(folder.join("b.obj"), text).unwrap();
        let (code, message) = check(folder, "kind = \"plane\"", "{ grid = [2, 2] }");
        assert_eq!(code, Some(2), "{name}: {message}");
        assert!(words.iter().all(|word| message.contains(word)), "{name}: {words:?} in {message}");
        assert_eq!(message.lines().count(), 1, "{name}: {message}");
    }
}

#[test]
fn surfaces() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    fs::write(folder.join("b.obj"), format!("{SQUARE}l 1 2 3 4 1\n")).unwrap();
    for (text, words) in [
        (
            "v -9 0 20\nv 20 0 20\nv 20 3 -20\nv -9 3 -20\nf 1 2 3 4\n",
            &["s.obj:5: most of the mesh faces y", "z up"][..],
        ),
        ("ply\nformat ascii 1.0\n", &["no face", "line 1 begins with `ply`"]),
        ("", &["no face", "no vertices"]),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", &["no face that could carry"]),
        ("v 0 0 0\nv 1 0 0\nf 1 2\n", &["s.obj:3", "at least 3"]),
        ("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 \\\n 7\n", &["s.obj:4", "vertex 7"]),
    ] {
        fs::write(folder.join("s.obj"), text).unwrap();
        let (code, message) = check(folder, "kind = \"mesh\"\nfile = \"s.obj\"", "{ grid = [2, 2] }");
        assert_eq!(code, Some(2), "{text}: {message}");
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} in {message}");
    }
    let tilted = "o C:\\roof\\\nusemtl a\nv -1 -1 0\nv 17 -1 1\nv 17 11 2\nv -1 11 1\nvn 0 0 1\ns off\nf -4//1 -3//1 \\\n -2//1 -1//1\n";
    fs::write(folder.join("s.obj"), tilted).unwrap();
    let (code, message) = check(folder, "kind = \"mesh\"\nfile = \"s.obj\"", "{ grid = [2, 2] }");
    assert_eq!(code, Some(0), "{message}");
}

#[test]
fn initial_meshes() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    // A corner that three decimals round.
    fs::write(folder.join("b.obj"), "v 0 0 0\nv 16.00049 0 0\nv 16.00049 10 0\nv 0 10 0\nl 1 2 3 4 1\n")
        .unwrap();
    let json = |x: &str| {
        format!(
            "{{\"vertices\": [[0, 0, 0], [{x}, 0, 0], [{x}, 10, 0], [0, 10, 0]], \"faces\": [[0, 1, 2, 3]]}}"
        )
    };
    let compas = |x: &str| {
        format!(
            "{{\"data\": {{\"vertex\": {{\"0\": {{\"x\": 0, \"y\": 0, \"z\": 0}}, \"1\": {{\"x\": {x}, \"y\": 0, \"z\": 0}},\n\
             \"2\": {{\"x\": 16, \"y\": 10, \"z\": 0}}, \"3\": {{\"x\": 0, \"y\": 10, \"z\": 0}}}}, \"face\": {{\"0\": [0, 1, 2, 3]}}}}}}"
        )
    };
    let obj = |x: &str| format!("v 0 0 0\nv {x} 0 0\nv {x} 10 0\nv 0 10 0\nf 1 2 3 4\n");
    let marked = |text: String| format!("\u{feff}{text}");
    for (name, text) in [
        ("a.obj", obj("16.000")),
        ("b.json", json("16.000")),
        ("c.json", marked(json("16.000"))),
        ("d.json", marked(compas("16.000"))),
    ] {
        fs::write(folder.join(name), text).unwrap();
        let (code, message) = check(folder, "kind = \"plane\"", &format!("{{ file = \"{name}\" }}"));
        assert_eq!(code, Some(0), "{name}: {message}");
    }
    fs::write(folder.join("e.json"), utf16(&json("16"))).unwrap();
    assert_eq!(check(folder, "kind = \"plane\"", "{ file = \"e.json\" }").0, Some(0));
    for (name, text, words) in [
        ("f.obj", obj("15.9"), &["corner 1", "the nearest is 0.100490 m away"][..]),
        ("g.json", json("NaN"), &["vertices[1][0]: found NaN", "line 1"]),
        ("h.json", json("-Infinity"), &["vertices[1][0]: found -Infinity"]),
        ("i.json", compas("nan"), &["data.vertex.1.x: found nan", "line 1"]),
        ("j.json", json("1e400"), &["vertices[1][0]", "number out of range"]),
        ("k.obj", "v 0 3 0\nv 16 3 0\nv 16 3 -10\nv 0 3 -10\nf 1 2 3 4\n".into(), &["y up"]),
    ] {
        fs::write(folder.join(name), text).unwrap();
        let (code, message) = check(folder, "kind = \"plane\"", &format!("{{ file = \"{name}\" }}"));
        assert_eq!(code, Some(2), "{name}: {message}");
        assert!(words.iter().all(|word| message.contains(word)), "{name}: {words:?} in {message}");
    }
}

/// What a config file is called names the run, and is no reason to refuse it.
#[test]
fn names_of_files() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let text = "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [9, 0], [9, 9], [0, 9]]\n\
                [topology]\ninitial = { grid = [2, 2] }\n[objectives]\nminimise = [\"curvature\", \"skewness\"]\n\
                [search]\npopulation = 8\ngenerations = 1\n";
    for (file, name) in [
        ("roof (1)", "roof (1)"),
        ("cafe\u{301}", "cafe\u{301}"),
        ("a#b, c; 100 % 'd' [e] = {f} & g", "a#b, c; 100 % 'd' [e] = {f} & g"),
        ("what? a\"b*", "what_ a_b_"),
        ("two\nlines", "two_lines"),
        ("aux", "aux_"),
        ("ends in dots..", "ends in dots"),
        ("屋根 😀", "屋根 😀"),
    ] {
        let config = format!("{file}.toml");
        fs::write(folder.join(&config), text).unwrap();
        let output = quadrille(folder, &["run", &config, "--seed", "1", "--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{file:?}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(folder.join("results").join(name).join("pareto.csv").exists(), "{name:?}");
    }
    for name in ["a/b", "..", " ", "a\\\\b", "a:b", "con", "LPT1.x", "roof."] {
        fs::write(
            folder.join("c.toml"),
            text.replace("[topology]", &format!("[run]\nname = \"{name}\"\n[topology]")),
        )
        .unwrap();
        let output = quadrille(folder, &["check", "c.toml"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && message.contains("run.name"), "{name:?}: {message}");
    }
    fs::write(folder.join("wide.toml"), utf16(text)).unwrap();
    assert_eq!(quadrille(folder, &["check", "wide.toml"]).status.code(), Some(0));
}

/// A results folder whose tables a spreadsheet saved again: `;`, decimal commas, `TRUE`, a byte order mark.
#[test]
fn tables_that_a_spreadsheet_saved() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let text = "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [9, 0], [8, 9], [0, 7]]\n\
                [topology]\ninitial = { grid = [2, 2] }\n[objectives]\nminimise = [\"skewness\", \"edge_spread\"]\n\
                [search]\npopulation = 8\ngenerations = 2\n[pattern]\npanels = 60\n";
    fs::write(folder.join("c.toml"), text).unwrap();
    let output = quadrille(folder, &["run", "c.toml", "--seed", "1", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let before = quadrille(folder, &["verify", "results/c"]);
    assert_eq!(before.status.code(), Some(0), "{}", String::from_utf8_lossy(&before.stdout));
    for name in ["pareto.csv", "history.csv", "generations.csv"] {
        let file = folder.join("results/c").join(name);
        let mut reader = csv::Reader::from_path(&file).unwrap();
        let mut lines = vec![reader.headers().unwrap().iter().collect::<Vec<_>>().join(";")];
        for record in reader.records() {
            let cell = |cell: &str| match cell {
                "true" | "false" => cell.to_uppercase(),
                number if number.parse::<f64>().is_ok() => number.replace('.', ","),
                words => format!("\"{words}\""),
            };
            lines.push(record.unwrap().iter().map(cell).collect::<Vec<_>>().join(";"));
        }
        fs::write(&file, format!("\u{feff}{}\r\n", lines.join("\r\n"))).unwrap();
    }
    let after = quadrille(folder, &["verify", "results/c"]);
    assert_eq!(String::from_utf8_lossy(&after.stdout), String::from_utf8_lossy(&before.stdout));
}
