//! Wrong boundaries, surfaces and meshes, through the program: exit code 2, and the culprit by name (issue 5).

use assert_cmd::Command;
use std::fs;
use std::path::Path;

const LOOP: &str = "kind = \"polyline\"\npoints_m = [[0, 0], [10, 0], [10, 10], [0, 10]]";
const SURFACE: &str = "kind = \"plane\"";
const INITIAL: &str = "{ grid = [2, 2] }";

fn config(boundary: &str, more_loops: &str, surface: &str, initial: &str) -> String {
    format!(
        "version = 1\n[[domain.loop]]\n{boundary}\n{more_loops}\n[surface]\n{surface}\n[topology]\ninitial = {initial}\n\
         [objectives]\nminimise = [\"curvature\"]\n"
    )
}

fn circle(x: f64, y: f64, radius: f64) -> String {
    format!("[[domain.loop]]\nkind = \"circle\"\ncenter_m = [{x:?}, {y:?}]\nradius_m = {radius:?}\n")
}

/// Exit code and stderr of `check` on a config with these files beside it.
fn check(folder: &Path, text: &str) -> (Option<i32>, String) {
    fs::write(folder.join("c.toml"), text).unwrap();
    let output =
        Command::cargo_bin("quadrille").unwrap().current_dir(folder).args(["check", "c.toml"]).output();
    let output = output.unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn the_culprit_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n";
    for (name, end) in [
        ("open.obj", "l 1 2 3 4\n"),
        ("index.obj", "l 1 2 3 7 1\nf 1 2 3 4\n"),
        ("number.obj", "v 1 x 0\nf 1 2 3 4\n"),
        ("winding.obj", "v 5 5 5\nf 1 2 3 4\nf 1 2 5 4\n"),
        ("small.obj", "v 4 10 0\nv 4 0 0\nf 1 6 5 4\n"),
        ("pole.obj", "v 5 5 0\nf 5 1 2\nf 5 2 3\nf 5 3 4\nf 5 4 1\n"),
    ] {
        fs::write(folder.path().join(name), format!("{square}{end}")).unwrap();
    }
    let boundary = |text: &str| config(text, "", SURFACE, INITIAL);
    let polyline = |points: &str| boundary(&format!("kind = \"polyline\"\npoints_m = {points}"));
    let file = |name: &str| boundary(&format!("kind = \"obj\"\nfile = \"{name}\""));
    let loops = |more: &str| config(LOOP, more, SURFACE, INITIAL);
    let on = |surface: &str| config(LOOP, "", surface, INITIAL);
    let height = |expression: &str| on(&format!("kind = \"height\"\nexpression = \"{expression}\""));
    let from = |name: &str| config(LOOP, "", SURFACE, &format!("{{ file = \"{name}\" }}"));
    let tiny = "kind = \"circle\"\ncenter_m = [0, 0]\nradius_m = 1e-300";
    let round = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::TAU / 500.0;
        format!("[{:?}, {:?}]", 10.0 * angle.cos(), 10.0 * angle.sin())
    };
    let many = format!("[{}]", (0..500).map(round).collect::<Vec<_>>().join(", "));
    for (text, parts) in [
        (boundary(LOOP), &[][..]),
        (boundary(tiny), &["c.toml:2", "domain.loop[0]", "1e-6 to 1e9 m"]),
        (
            config(&format!("kind = \"polyline\"\npoints_m = {many}"), "", SURFACE, "\"skeleton\""),
            &["500 corners, at most 112", "corners = \"auto\""],
        ),
        (
            polyline("[[0, 0], [10, 10], [10, 0], [0, 10]]"),
            &["c.toml:4", "domain.loop[0]", "edge 0–1 meets edge 2–3"],
        ),
        (polyline("[[0, 0], [10, 0], [nan, 10]]"), &["c.toml:4", "domain.loop[0].points_m[2][0]", "nan"]),
        (polyline("[[0, 0], [10, 0], [10, 0], [0, 10]]"), &["c.toml:4", "points_m[1]", "the same point"]),
        (polyline("[[0, 0], [10, 0], [0, 10], [0, 0]]"), &["points_m[3]", "leave the last point out"]),
        (config(LOOP, "", SURFACE, "{ grid = [1000, 1000] }"), &["grid = [1000, 1000]", "at most 10000"]),
        (loops(&circle(20.0, 20.0, 2.0)), &["c.toml:5", "loop 1, a hole, lies outside loop 0"]),
        (loops(&circle(5.0, 5.0, 20.0)), &["c.toml:5", "loop 1, a hole, lies outside loop 0"]),
        (loops(&circle(5.0, 2.0, 2.0)), &["loops 0 and 1 cross or touch near (5.000000, 0.000000)"]),
        (
            loops(&(circle(3.0, 5.0, 1.0) + &circle(5.0, 5.0, 1.0))),
            &["c.toml:9", "loops 1 and 2 cross or touch"],
        ),
        (
            loops(&(circle(5.0, 5.0, 3.0) + &circle(5.0, 5.0, 1.0))),
            &["c.toml:9", "loop 2, a hole, lies inside loop 1"],
        ),
        (loops(&circle(5.0, 5.0, -1.0)), &["c.toml:8", "domain.loop[1].radius_m", "allowed: a number > 0"]),
        (file("open.obj"), &["c.toml:4", "open.obj:5", "the polyline is open"]),
        (file("index.obj"), &["index.obj:5", "vertex 7 does not exist: the file has 4"]),
        (file("number.obj"), &["number.obj:5", "y is `x`"]),
        (
            on("kind = \"mesh\"\nfile = \"small.obj\""),
            &["c.toml:8", "it does not cover the domain", "x 0 to 4"],
        ),
        (
            on("kind = \"sphere\"\ncenter_m = [5, 5, 0]\nradius_m = 6"),
            &["c.toml:7", "it does not cover the domain"],
        ),
        (height("x + foo * y"), &["c.toml:8", "surface.expression, column 5: unknown name `foo`"]),
        (height("x + * y"), &["column 5: `*` where a number or a name should be"]),
        (
            height("sqrt((x - 5)^2 + (y - 5)^2 - 0.04)"),
            &["no finite height at (4.", "gives no finite number there"],
        ),
        (from("winding.obj"), &["winding.obj:7", "the winding is inconsistent"]),
        (
            from("pole.obj"),
            &["c.toml:9", "pole.obj:6", "an OBJ file has no place for them", "[topology.initial]"],
        ),
        (from("small.obj"), &["c.toml:9", "small.obj:2", "vertex 1 belongs to no face"]),
        (from("none.obj"), &["c.toml", "there is no file ./none.obj"]),
    ] {
        let (code, message) = check(folder.path(), &text);
        assert_eq!(code, Some(if parts.is_empty() { 0 } else { 2 }), "{text}\n{message}");
        assert!(parts.iter().all(|part| message.contains(part)), "{parts:?} in\n{message}");
    }
}

#[test]
fn every_command_tells_the_line() {
    let folder = tempfile::tempdir().unwrap();
    let text = config(LOOP, "", SURFACE, "{ grid = [2000, 2] }");
    fs::write(folder.path().join("c.toml"), text).unwrap();
    for command in ["decode", "evaluate", "skeleton"] {
        let string = if command == "skeleton" { &[][..] } else { &["--string", ""] };
        let mut run = Command::cargo_bin("quadrille").unwrap();
        let output = run.current_dir(folder.path()).args([command, "c.toml"]).args(string).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}: {message}");
        assert!(message.contains("c.toml:9: topology.initial"), "{command}: {message}");
    }
}

/// What no rule forbids, and what a look at the real sizes shows.
#[test]
fn what_is_seldom_meant_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let millimetres = "v -1000 -1000 0\nv 11000 -1000 0\nv 11000 11000 0\nv -1000 11000 0\nf 1 2 3 4\n";
    fs::write(folder.path().join("mm.obj"), millimetres).unwrap();
    let surface = |surface: &str, pattern: &str| {
        let text = config(LOOP, "", surface, INITIAL) + pattern;
        let (code, stderr) = check(folder.path(), &text);
        assert_eq!(code, Some(0), "{stderr}");
        stderr
    };
    let mesh = "kind = \"mesh\"\nfile = \"mm.obj\"";
    assert!(
        surface(mesh, "")
            .contains("the mesh is 16971 m across, the domain 14.142136 m: is its file in another unit? (surface.unit = \"mm\"")
    );
    // 100 panels of 1 m.
    let limit = |least: f64| format!("[pattern]\npanels = 100\nlimits = {{ min_edge_m = {least} }}\n");
    assert!(
        surface(SURFACE, &limit(0.8))
            .contains("min_edge_m = 0.8 is 0.80 of the panels' mean side, about 1.000 m")
    );
    let support = "[structure]\nsupport = [{ at = 'corners', fixed = ['ux'] }, { at = 'boundary', fixed = ['uz', 'rx'] }]\n";
    assert!(
        surface(SURFACE, support)
            .contains("structure.support: nothing fixes uy: every design is a mechanism")
    );
    assert!(!surface(SURFACE, "[structure]\n").contains("mechanism"));
    let quiet = surface(SURFACE, &limit(0.5));
    assert!(!quiet.contains("min_edge_m") && !quiet.contains("across"), "{quiet}");
}

/// A slip of a digit in one point or one height asks for more panels than memory holds: the pattern is refused, and nothing is allocated
/// for it. (These ended in "memory allocation failed".)
#[test]
fn a_point_far_away_takes_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let n = 10;
    let vertex = |k: usize| {
        let (i, j) = (k / (n + 1), k % (n + 1));
        format!("v {i} {j} {}\n", if k == 60 { 1e7 } else { 0.1 * i as f64 })
    };
    let face = |k: usize| {
        let a = k / n * (n + 1) + k % n + 1;
        format!("f {a} {} {} {}\n", a + n + 1, a + n + 2, a + 1)
    };
    let mesh: String =
        (0..(n + 1) * (n + 1)).map(vertex).chain((0..n * n).map(face)).collect::<Vec<_>>().concat();
    fs::write(folder.path().join("spike.obj"), mesh).unwrap();
    let far = "kind = \"polyline\"\npoints_m = [[0, 0], [1e7, 0], [12, 12], [0, 12]]";
    let spike = "kind = \"mesh\"\nfile = \"spike.obj\"";
    for text in [config(far, "", SURFACE, INITIAL), config(LOOP, "", spike, INITIAL)] {
        for text in [&text, &text.replace(INITIAL, "\"skeleton\"")] {
            let (code, told) = check(folder.path(), text);
            assert!(code == Some(0) || code == Some(2), "{code:?} {told}");
            assert!(!told.contains("memory allocation"), "{told}");
        }
    }
}
