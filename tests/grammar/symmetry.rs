//! Strings on halves and quarters: what they unfold to is a valid symmetric mesh of the domain's topology (docs/symmetry.md).

use quadrille::config::ResolvedConfig;
use quadrille::geometry::images::Image;
use quadrille::grammar::random::{self, Shares};
use quadrille::grammar::{Effect, Tokens, decode};
use quadrille::mesh::automorphism::Shape;
use quadrille::mesh::unzip::{Course, End};
use quadrille::mesh::validate;
use quadrille::random::stream;
use quadrille::study::Study;

fn study(text: &str) -> Study {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    std::fs::write(&file, format!("version = 1\n{text}")).unwrap();
    let config = ResolvedConfig::open(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    Study::of(&config).unwrap_or_else(|error| panic!("{error}"))
}

fn court(symmetry: &str) -> Study {
    study(&format!(
        "[[domain.loop]]\nkind = \"polyline\"\n\
         points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]\n\
         [[domain.loop]]\nkind = \"circle\"\ncenter_m = [0, 0]\nradius_m = 22.245\n\
         [surface]\nkind = \"great-court\"\n[topology]\nsymmetry = {symmetry}\n"
    ))
}

fn square(symmetry: &str) -> Study {
    study(&format!(
        "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n\
         [surface]\nkind = \"paraboloid\"\nhalf_spans_m = [14.142135623730951, 14.142135623730951]\nrise_m = 4\n\
         [topology]\ninitial = {{ grid = [2, 2] }}\nsymmetry = {symmetry}\n"
    ))
}

/// A hall with two round openings on its long axis and two square ones beside it.
fn hall(symmetry: &str) -> Study {
    study(&format!(
        "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[-30, -20], [30, -20], [30, 20], [-30, 20]]\n\
         [[domain.loop]]\nkind = \"circle\"\ncenter_m = [-15, 0]\nradius_m = 5\n\
         [[domain.loop]]\nkind = \"circle\"\ncenter_m = [15, 0]\nradius_m = 5\n\
         [surface]\nkind = \"plane\"\n[topology]\nsymmetry = {symmetry}\n"
    ))
}

/// Decodes random strings; each unfolds to a valid mesh that has the symmetry, with loops and Euler characteristic of the whole.
fn check_strings(study: &Study, count: u64) {
    let whole = &study.initial.mesh;
    let symmetries = study.domain.own_symmetries();
    let (mut additions, mut deletions, mut lost) = (0, 0, 0);
    for index in 0..count {
        let mut rng = stream(17, 0, index as u32);
        let tokens = match index % 3 {
            0 => random::uniform(&mut rng, 4..=40),
            1 => {
                random::structured(&mut rng, 4..=40, &Shares { closed: 0.3, pole: 0.15, ..Shares::default() })
            }
            _ => random::aware(
                &mut rng,
                4..=40,
                &Shares { closed: 0.3, ..Shares::default() },
                &study.start.part,
                study.rules,
            ),
        };
        let part = study.decode_part(&tokens);
        validate::check_invariants(&part.mesh).unwrap_or_else(|fault| panic!("{tokens}: part: {fault}"));
        validate::check(&part.mesh).unwrap_or_else(|fault| panic!("{tokens}: part: {fault}"));
        for effect in &part.trace {
            additions += usize::from(matches!(effect, Effect::Added(_)));
            deletions += usize::from(matches!(effect, Effect::Deleted(_)));
        }
        let decoded = study.decode(&tokens);
        validate::check_invariants(&decoded.mesh).unwrap_or_else(|fault| panic!("{tokens}: {fault}"));
        validate::check(&decoded.mesh).unwrap_or_else(|fault| panic!("{tokens}: {fault}"));
        assert!(!decoded.mesh.is_folded(), "{tokens}");
        assert_eq!(decoded.mesh.euler_characteristic(), whole.euler_characteristic(), "{tokens}");
        assert_eq!(decoded.mesh.loop_count(), whole.loop_count(), "{tokens}");
        assert!(decoded.mesh.loops().iter().all(|darts| darts.len() >= 3), "{tokens}");
        assert_eq!(decoded.mesh.corner_count(), whole.corner_count(), "{tokens}");
        assert!(decoded.mesh.corners().iter().all(|carriers| carriers.len() == 1), "{tokens}");
        let shape = Shape::of(&decoded.mesh, whole.corner_count());
        for (kind, symmetry) in symmetries.iter().filter(|(kind, _)| study.mirrors().contains(kind)) {
            assert!(shape.find(symmetry).is_some(), "{tokens}: not {}", kind.name());
        }
        let again = decode(&study.start.part, &part.expressed, study.rules);
        assert!(again.trace.iter().all(|effect| !matches!(effect, Effect::Skipped(_))), "{tokens}");
        // Merging parallel strips may keep one of a pair on one side only: such designs are refused.
        lost +=
            usize::from(Image::all(&study.topology(&tokens), &study.domain).len() < study.mirrors().len());
    }
    assert!(additions > count as usize / 4 && deletions > count as usize / 20, "{additions} {deletions}");
    assert!(
        lost * 20 <= count as usize,
        "{lost} of {count} lose the symmetry when parallel strips are merged"
    );
}

fn strings(fallback: u64) -> u64 {
    std::env::var("QUADRILLE_STRINGS").ok().and_then(|n| n.parse().ok()).unwrap_or(fallback)
}

#[test]
fn halves_of_the_great_court() {
    check_strings(&court("[\"mirror-x\"]"), strings(10_000));
}

#[test]
fn quarters_of_a_square() {
    check_strings(&square("[\"mirror-x\", \"mirror-y\"]"), strings(10_000));
}

#[test]
fn halves_and_quarters_of_a_hall_with_holes_on_an_axis() {
    for symmetry in ["[\"mirror-x\"]", "[\"mirror-y\"]", "[\"mirror-y\", \"mirror-x\"]"] {
        check_strings(&hall(symmetry), strings(3_000));
    }
}

#[test]
fn the_empty_string_keeps_its_id() {
    for (make, symmetry) in [
        (court as fn(&str) -> Study, "[\"mirror-x\"]"),
        (square, "[\"mirror-x\"]"),
        (square, "[\"mirror-y\", \"mirror-x\"]"),
        (hall, "[\"mirror-x\", \"mirror-y\"]"),
    ] {
        let (plain, folded) = (make("[]"), make(symmetry));
        assert_eq!(plain.baseline(), folded.baseline(), "{symmetry}");
        assert!(folded.start.part.mesh.face_count() < folded.initial.mesh.face_count() * 2);
        assert_eq!(folded.topology(&Tokens::default()), plain.topology(&Tokens::default()));
    }
}

#[test]
fn a_ring_along_the_outer_wall_takes_two_rules() {
    let study = court("[\"mirror-x\"]");
    // Deletes the ring around the opening, then adds a strip along the outer wall from seam to seam: a ring in the whole.
    let tokens: Tokens = "TTTDTTTTATTTTTTTA".parse().unwrap();
    let part = study.decode_part(&tokens);
    let applied = part.trace.iter().filter(|effect| effect.is_applied()).count();
    assert_eq!((applied, part.expressed.clone()), (2, tokens.clone()));
    assert!(study.topology(&tokens).code.to_string().starts_with("be89fb2b75a5"));
}

fn seam_edges(mesh: &quadrille::mesh::QuadMesh) -> usize {
    mesh.darts().filter(|&d| mesh.left(d).as_seam().is_some()).count()
}

#[test]
fn a_strip_from_inside_ends_on_the_seam_where_its_token_says_so() {
    let study = court("[\"mirror-x\"]");
    let mut found = 0;
    for index in 0..4_000 {
        let shares = Shares { closed: 0.6, ..Shares::default() };
        let mut rng = stream(23, 0, index);
        let tokens = random::aware(&mut rng, 12..=40, &shares, &study.start.part, study.rules);
        let seams_after =
            |count: usize| seam_edges(&study.decode_part(&Tokens(tokens[..count].to_vec())).mesh);
        for (i, effect) in study.decode_part(&tokens).trace.iter().enumerate() {
            let Effect::Added(added) = effect else { continue };
            let Course::Open(ends) = added.course else { continue };
            let told = ends.iter().filter(|&&end| end == End::OnSeam).count();
            if told > 0 {
                let grown = seams_after(i + 1) - seams_after(i);
                assert!(grown >= told, "{tokens} at {i}: {told} ends on seams, {grown} more edges there");
                found += told;
            }
        }
    }
    assert!(found > 10, "{found}");
}

#[test]
fn meshes_that_are_not_symmetric_are_refused_with_the_place() {
    let refused = |text: &str| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("case.toml");
        std::fs::write(&file, format!("version = 1\n{text}")).unwrap();
        let config = ResolvedConfig::open(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
        Study::of(&config).err().unwrap().to_string()
    };
    let square = "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [20, 0], [20, 20], [0, 20]]\n[surface]\nkind = \"plane\"\n[topology]\n";
    let inline = |vertices: &str, faces: &str| {
        refused(&format!(
            "{square}symmetry = [\"mirror-x\"]\ninitial = {{ vertices = {vertices}, faces = {faces} }}\n"
        ))
    };
    // Three faces on the left, two on the right.
    let vertices = "[[0,0,0],[10,0,0],[20,0,0],[20,20,0],[10,20,0],[0,20,0],[0,12,0],[10,12,0]]";
    let message = inline(vertices, "[[0,1,7,6],[6,7,4,5],[1,2,3,7]]");
    assert!(message.contains("not"), "{message}");
    let twice =
        refused(&format!("{square}initial = {{ grid = [2, 2] }}\nsymmetry = [\"mirror-x\", \"mirror-x\"]\n"));
    assert!(twice.contains("topology.symmetry: `mirror-x` is listed twice"), "{twice}");
    let tilted = "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [20, 0], [25, 20], [0, 20]]\n[surface]\nkind = \"plane\"\n\
         [topology]\nsymmetry = [\"mirror-x\"]\n";
    let message = refused(tilted);
    assert!(message.contains("topology.symmetry: the domain does not have `mirror-x`"), "{message}");
}
