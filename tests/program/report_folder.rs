//! `quadrille report DIR`: the page shows what the files of a results folder say, and bad files are named.

use assert_cmd::Command;
use quadrille::config::{self, ResolvedConfig};
use quadrille::output::report::{Mark, ReportData, read};
use std::fs;
use std::path::Path;

const PARETO: &str = "id,string,expressed,code,generation,feasible,mass_kg,edge_spread_m,faces\n\
    aaaaaaaaaaaa,ATTPA,ATTPA,aaaaaaaaaaaa0000,1,true,100.5,0.25,3\n\
    bbbbbbbbbbbb,D,D,bbbbbbbbbbbb0000,0,true,200,0.125,\n";
const HISTORY: &str = "id,string,expressed,code,generation,feasible,mass_kg,edge_spread_m,faces,violation_stage,violation,reason\n\
    cccccccccccc,TT,,cccccccccccc0000,0,false,300,,4,1,0.5,\"too heavy, by far\"\n\
    bbbbbbbbbbbb,D,D,bbbbbbbbbbbb0000,0,true,200,0.125,,0,0,\n\
    dddddddddddd,DD,DD,dddddddddddd0000,0,true,250,0.5,5,0,0,\n\
    aaaaaaaaaaaa,ATTPA,ATTPA,aaaaaaaaaaaa0000,1,true,100.5,0.25,3,0,0,\n";
const GENERATIONS: &str = "generation,evaluations,structural_evaluations,feasible,front_size,hypervolume,bred,\
    duplicates_refused,neighbours_refused,rejected_by_topology,cached,immigrants,empty_slots\n\
    0,3,3,2,2,,3,0,0,0,0,0,0\n1,4,4,3,2,0.75,3,1,1,0,0,0,0\n";
/// Three quads around vertex 0.
const MESH: &str = r#"{"dtype":"compas.datastructures/Mesh","data":{"vertex":{"0":{"x":0,"y":0,"z":0},"1":{"x":1,"y":0,"z":0},
"2":{"x":1,"y":1,"z":0},"3":{"x":-1,"y":1,"z":0},"4":{"x":-1.5,"y":0,"z":0},"5":{"x":-1,"y":-1,"z":0},"6":{"x":1,"y":-1,"z":0}},
"face":{"0":[0,1,2,3],"1":[0,3,4,5],"2":[0,5,6,1]}}}"#;
const MEMBERS: &str = "member,from,to,utilisation\n0,0,1,0.5\n1,1,0,0.75\n2,2,1,0.25\n3,3,4,\n";

fn manifest() -> String {
    let config = include_str!("../../configs/ci.toml").replace(
        "minimise = [\"deflection\", \"curvature\", \"edge_spread\"]",
        "minimise = [\"mass\", \"edge_spread\"]",
    );
    let config = config.replace("ideal = [0.0, 0.0, 0.0]", "ideal = [0.0, 0.0]");
    let config = config.replace("reference = [0.15, 0.02, 1.5]", "reference = [1e4, 1.5]");
    // Manifests record what a config means, all defaults in it.
    let config =
        config::to_toml(ResolvedConfig::parse(&config, "ci.toml".as_ref(), &[]).expect("a config").config());
    serde_json::json!({
        "manifest_version": 1, "program": "quadrille", "program_version": "0.1.0", "name": "tripod",
        "objectives": ["mass_kg", "edge_spread_m"], "seed": u64::MAX, "threads": 2, "status": "finished",
        "ended_by": "all generations are done", "started": "2026-11-22T14:00:00Z", "ended": "2026-11-22T14:00:09Z",
        "counts": {"generations": 1, "evaluations": 4, "structural_evaluations": 3, "feasible": 3, "front_size": 2,
            "bred": 6, "duplicates_refused": 1, "neighbours_refused": 1},
        "seconds": 9.0, "host": {"os": "linux", "architecture": "x86_64", "processors": 2}, "config": config,
        "config_folder": "/tmp", "config_sha256": "", "input_files": {}
    })
    .to_string()
}

fn folder(change: impl Fn(&Path)) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let manifest = manifest();
    let files = [
        ("manifest.json", manifest.as_str()),
        ("pareto.csv", PARETO),
        ("history.csv", HISTORY),
        ("generations.csv", GENERATIONS),
        ("designs/aaaaaaaaaaaa.json", MESH),
        ("designs/aaaaaaaaaaaa_members.csv", MEMBERS),
    ];
    fs::create_dir(folder.path().join("designs")).expect("a new folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a new file");
    }
    change(folder.path());
    folder
}

fn data() -> ReportData {
    read(folder(|_| ()).path()).expect("a good folder")
}

#[test]
fn numbers_are_those_of_the_files() {
    let data = data();
    let columns: Vec<&str> = data.metrics.iter().map(|m| m.column.as_str()).collect();
    assert_eq!(columns, ["mass_kg", "edge_spread_m", "faces"]);
    assert_eq!((data.metrics[1].label.as_str(), data.metrics[1].unit.as_str()), ("Edge spread", "m"));
    assert_eq!(data.objectives, [0, 1]);
    assert_eq!(data.front[0].values, [Some(100.5), Some(0.25), Some(3.0)]);
    assert_eq!(data.front[1].values[2], None);
    assert_eq!((data.run.seed.as_str(), data.run.duplicates_refused), ("18446744073709551615", 2));
    assert_eq!(data.generations[0].hypervolume, None);
    assert_eq!((data.generations[1].front, data.generations[1].duplicates_refused), (2, 2));
}

#[test]
fn the_baseline_is_the_design_of_which_nothing_is_expressed() {
    let baseline = data().baseline.unwrap();
    assert_eq!((baseline.id.as_str(), baseline.feasible), ("cccccccccccc", false));
    assert_eq!(baseline.reason.as_deref(), Some("too heavy, by far"));
}

#[test]
fn spread_takes_the_feasible_designs_of_the_first_and_last_generation() {
    let spread = data().spread;
    assert_eq!(spread.first.label, "generation 0");
    assert_eq!(spread.first.rows, [[Some(200.0), Some(0.125)], [Some(250.0), Some(0.5)]]);
    assert_eq!(spread.last.rows, [[Some(100.5), Some(0.25)]]);
}

#[test]
fn pictures_come_from_the_designs_files() {
    let data = data();
    let mesh = data.front[0].mesh.as_ref().unwrap();
    assert_eq!(mesh.edges[..2], [[0, 1], [0, 3]]);
    // Two members on edge 0–1: the larger counts.
    assert_eq!(mesh.utilisation[0], Some(0.75));
    assert_eq!(mesh.utilisation.iter().flatten().count(), 2);
    assert_eq!(mesh.singular.iter().map(|s| (s.vertex, s.mark)).collect::<Vec<_>>(), [(0, Mark::Fewer)]);
    assert_eq!(data.design_files, [".json", "_members.csv"]);
    assert!(data.front[1].mesh.is_none());
}

/// What `decode --format json` counts of a string.
fn decoded(string: &str) -> serde_json::Value {
    let mut command = Command::cargo_bin("quadrille").expect("the program");
    command.args([
        "decode",
        concat!(env!("CARGO_MANIFEST_DIR"), "/configs/ci.toml"),
        "--string",
        string,
        "--format",
        "json",
    ]);
    let printed = command.output().expect("it runs").stdout;
    serde_json::from_slice::<serde_json::Value>(&printed).expect("JSON")["summary"]["singularities"].clone()
}

#[test]
fn singularities_are_those_that_decode_counts() {
    let strings = ["ATTPA", "D", "A*TPTTTPPTTDPTA*D", "AoTPTTTPPTTDPTAD"];
    let rows = strings
        .map(|string| format!("aaaaaaaaaaa{},{string},,aaaaaaaaaaa{0}0000,0,true,1,1,3", string.len() % 10));
    let header = PARETO.lines().next().unwrap();
    let data = read(
        folder(|f| {
            fs::write(f.join("pareto.csv"), format!("{header}\n{}\n", rows.join("\n"))).unwrap();
            let history = rows.clone().map(|row| row + ",0,0,").join("\n");
            let header = HISTORY.lines().next().unwrap();
            fs::write(f.join("history.csv"), format!("{header}\n{history}\n")).unwrap();
        })
        .path(),
    )
    .unwrap();
    for (string, design) in strings.iter().zip(&data.front) {
        let told = serde_json::to_value(design.singularities.as_ref().unwrap()).unwrap();
        assert_eq!(told, decoded(string), "{string}");
    }
}

fn report(folder: &Path) -> assert_cmd::assert::Assert {
    Command::cargo_bin("quadrille").expect("the program").arg("report").arg(folder).assert()
}

#[test]
fn the_command_writes_the_page_and_says_where() {
    let folder = folder(|_| ());
    let path = folder.path().join("report.html");
    let printed = report(folder.path()).success().get_output().stdout.clone();
    assert_eq!(String::from_utf8(printed).unwrap(), format!("{}\n", path.display()));
    let page = fs::read(&path).unwrap();
    report(folder.path()).success();
    assert_eq!(fs::read(&path).unwrap(), page);
}

#[test]
fn bad_files_are_named_with_line_and_column() {
    let says = |change: &dyn Fn(&Path)| {
        let folder = folder(change);
        let error = report(folder.path()).code(2).get_output().stderr.clone();
        assert!(!folder.path().join("report.html").exists());
        String::from_utf8(error).unwrap()
    };
    let text = says(&|f| fs::remove_file(f.join("pareto.csv")).unwrap());
    assert!(text.contains("pareto.csv"), "{text}");
    let text = says(&|f| fs::write(f.join("pareto.csv"), PARETO.replace("0.125", "wide")).unwrap());
    assert!(text.contains("pareto.csv: line 3: edge_spread_m: found \"wide\""), "{text}");
    let text = says(&|f| {
        fs::write(f.join("designs/aaaaaaaaaaaa.json"), MESH.replace("[0,5,6,1]", "[0,5,6,9]")).unwrap()
    });
    assert!(text.contains("face 2 is no triangle or quad of its vertices"), "{text}");
}
