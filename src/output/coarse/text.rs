//! A decoded string told in words.

use super::{Reading, singularities};
use crate::grammar::{Decoded, Effect};
use crate::mesh::{Equivalence, QuadMesh, strips};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The trace one token a line, then the mesh, its singular vertices, its loops and its strips; of a symmetric one first the part that was
/// decoded, then the whole.
pub fn text(reading: Reading<'_>) -> String {
    let decoded = reading.decoded;
    let mesh = &decoded.mesh;
    let quoted = |tokens: String| if tokens.is_empty() { "(empty)".into() } else { tokens };
    let mut text = format!(
        "string     {}\nexpressed  {}\n",
        quoted(reading.string.to_string()),
        quoted(decoded.expressed.to_string())
    );
    if !decoded.trace.is_empty() {
        text.push_str("\ntrace\n");
    }
    for (i, (token, effect)) in reading.string.iter().zip(&decoded.trace).enumerate() {
        let _ = writeln!(text, "  {i:>3}  {:<2}  {}", token.as_str(), told(effect));
    }
    if let Some(part) = reading.part {
        text.push_str("\npart that is decoded, with seams along which it goes on in its image; the trace names its strips");
        tell_mesh(&mut text, part);
        tell_seams(&mut text, &part.mesh);
        tell_strips(&mut text, &part.mesh);
        text.push_str("\nwhole mesh, unfolded");
    }
    tell_mesh(&mut text, decoded);
    let _ = writeln!(text, "code       {} (placed and reduced)", Equivalence::default().code(mesh));
    tell_singularities(&mut text, mesh);
    tell_loops(&mut text, mesh);
    tell_strips(&mut text, mesh);
    text
}

fn tell_mesh(text: &mut String, decoded: &Decoded) {
    let mesh = &decoded.mesh;
    let _ = write!(
        text,
        "\nmesh       {} vertices, {} edges, {} faces, Euler characteristic {}\nmarker     from vertex {} to {}\n",
        mesh.vertex_count(),
        mesh.edge_count(),
        mesh.face_count(),
        mesh.euler_characteristic(),
        mesh.origin(decoded.marker).0,
        mesh.end(decoded.marker).0,
    );
}

/// The seams of each fold, edge by edge.
fn tell_seams(text: &mut String, mesh: &QuadMesh) {
    let mut seams: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    for d in mesh.darts() {
        if let Some(fold) = mesh.left(d).as_seam() {
            let edge = format!("{}-{}", mesh.origin(d).0, mesh.end(d).0);
            seams.entry(fold).or_default().push(edge);
        }
    }
    for (fold, edges) in seams {
        let _ = writeln!(text, "seam {fold}     {}", edges.join(" "));
    }
}

fn told(effect: &Effect) -> String {
    match effect {
        Effect::Turned => "turned".into(),
        Effect::Pivoted => "pivoted".into(),
        Effect::Collecting => "collecting".into(),
        Effect::Added(added) => format!(
            "added strip {}: {}, {}, {}",
            added.strip.0,
            counted(added.edges, "edge"),
            counted(added.faces, "face"),
            added.ends().join(" to ")
        ),
        Effect::Deleted(deleted) => {
            let refined: Vec<String> = deleted
                .refined
                .iter()
                .map(|(strip, into)| format!(", after splitting strip {} in {into}", strip.0))
                .collect();
            format!("deleted strip {}{}", deleted.strip.0, refined.concat())
        }
        Effect::Skipped(skip) => format!("skipped: {skip}"),
    }
}

fn tell_singularities(text: &mut String, mesh: &QuadMesh) {
    let counts = singularities(mesh);
    let by_valence = |counts: &BTreeMap<usize, usize>| {
        let parts: Vec<String> =
            counts.iter().map(|(valence, count)| format!("{count} × {valence}-valent")).collect();
        if parts.is_empty() { "none".into() } else { parts.join(", ") }
    };
    let _ = writeln!(text, "\nsingular vertices");
    let _ = writeln!(text, "  inside     {}", by_valence(&counts.inner));
    let _ = writeln!(text, "  boundary   {}", by_valence(&counts.boundary));
    let _ = writeln!(text, "  poles      {}", counts.poles);
}

fn tell_loops(text: &mut String, mesh: &QuadMesh) {
    let corners = mesh.corners();
    for (label, darts) in mesh.loops().iter().enumerate() {
        let on_loop: Vec<String> = (0..corners.len())
            .filter(|&k| darts.iter().any(|&d| corners[k].contains(&mesh.origin(d))))
            .map(|k| k.to_string())
            .collect();
        let with =
            if on_loop.is_empty() { String::new() } else { format!(", corners {}", on_loop.join(" ")) };
        let _ = writeln!(
            text,
            "{}loop {label}     {} edges{with}",
            if label == 0 { "\n" } else { "" },
            darts.len()
        );
    }
}

fn tell_strips(text: &mut String, mesh: &QuadMesh) {
    text.push_str("\nstrips\n");
    for chain in strips::all(mesh) {
        let vertices = chain.darts.iter().map(|&d| format!("{}-{}", mesh.origin(d).0, mesh.end(d).0));
        let end = |pole: bool| if pole { "pole" } else { "boundary" };
        let course = if chain.closed {
            "closed".to_string()
        } else {
            format!("{} to {}", end(chain.poles[0]), end(chain.poles[1]))
        };
        let edges: Vec<String> = vertices.collect();
        let _ = writeln!(text, "  {:>3}  {course}: {}", chain.label.0, edges.join(" "));
    }
}

fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
