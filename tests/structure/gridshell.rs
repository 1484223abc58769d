//! A pattern as a grid shell: loads, supports, requirements, sizing.

use crate::support::{court, dome};
use quadrille::geometry::Pattern;
use quadrille::structure::gridshell::{AnalysisError, Proof, Response, analyse, analyse_detailed};
use quadrille::structure::model::Direction;
use quadrille::structure::params::{
    HeightParams, LoadParams, Quantity, RequirementParams, SectionParams, StructureParams, SupportParams,
    SupportPlace,
};
use quadrille::structure::section::Section;

/// The paper's structure, as a config without a `[structure]` key gives it.
fn paper() -> StructureParams {
    serde_json::from_str("{}").unwrap()
}

fn at_height(fixed_m: f64) -> StructureParams {
    StructureParams { height: HeightParams::Fixed { fixed_m }, ..paper() }
}

fn sized() -> StructureParams {
    StructureParams { height: HeightParams::Sized { min_m: 0.08, max_m: 0.6, step_m: 0.01 }, ..paper() }
}

fn meets(r: &Response) -> bool {
    r.violation() == 0.0
}

#[test]
fn reactions_balance_loads_and_mass_is_that_of_the_members() {
    let pattern = dome(8, 16.0, 2.0);
    let detailed = analyse_detailed(&pattern, &at_height(0.2), Proof::Certificate).unwrap();
    let section_area = 0.25 * 0.2 - 0.21 * 0.16;
    let response = &detailed.response;
    let mass = section_area * 7850.0 * response.member_length_m;
    assert!((response.mass_kg / mass - 1.0).abs() < 1e-12);
    // Plan projection of the whole: 16 m × 16 m; true area: that of the panels.
    let sls = detailed.combinations.iter().find(|c| c.name == "sls").unwrap();
    let up: f64 = sls.reactions.iter().filter_map(|(_, r)| r[2]).sum();
    let expected = 9.81 * mass + 600.0 * detailed.model.panel_area + 500.0 * 256.0;
    assert!((up / expected - 1.0).abs() < 1e-9, "{up} {expected}");
    assert!(detailed.mode.unwrap().certificate.unwrap().holds());
}

#[test]
fn combinations_of_first_order_are_linear() {
    let pattern = dome(6, 12.0, 1.5);
    let params = StructureParams { order: 1, ..at_height(0.15) };
    let single = |name: &str| {
        let mut params = params.clone();
        params.combinations.get_mut("sls").unwrap().retain(|case, _| case == name);
        let detailed = analyse_detailed(&pattern, &params, Proof::None).unwrap();
        detailed.combinations.into_iter().find(|c| c.name == "sls").unwrap().displacements
    };
    let parts: Vec<_> = ["self_weight", "glass", "snow"].map(single).into();
    let whole = analyse_detailed(&pattern, &params, Proof::None).unwrap();
    let uls = whole.combinations.iter().find(|c| c.name == "uls").unwrap();
    for (n, u) in uls.displacements.iter().enumerate() {
        for d in 0..6 {
            let sum = 1.35 * (parts[0][n][d] + parts[1][n][d]) + 1.5 * parts[2][n][d];
            assert!((u[d] - sum).abs() < 1e-9 * whole.response.deflection_m, "node {n}, {d}");
        }
    }
}

#[test]
fn sized_height_is_the_least_that_meets_all() {
    for pattern in [dome(8, 24.0, 3.0), dome(7, 16.0, 1.0), dome(10, 26.0, 4.5)] {
        let response = analyse(&pattern, &sized()).unwrap();
        assert!(meets(&response), "{response:?}");
        let below = analyse(&pattern, &at_height(response.height_m - 2e-4));
        assert!(below.as_ref().map_or(true, |r| !meets(r)), "{:?} {below:?}", response.height_m);
        assert!(response.height_rounded_m >= response.height_m);
        let again = analyse(&pattern, &at_height(response.height_m)).unwrap();
        assert_eq!(again.mass_kg, response.mass_kg);
        // Sizing comes to this height from its neighbours: the same but for the tolerance of second order.
        assert!((again.deflection_m / response.deflection_m - 1.0).abs() < 1e-6);
        assert!((again.buckling_factor / response.buckling_factor - 1.0).abs() < 1e-6);
    }
}

#[test]
fn no_height_is_a_response_with_its_excess() {
    let response = analyse(&court(40, 6), &sized()).unwrap();
    assert_eq!(response.height_m, 0.6);
    let sum: f64 = response.requirements.iter().map(|r| r.excess()).sum();
    assert!(sum > 0.0 && response.violation() == sum);
    assert!(response.governing().unwrap().used() > 1.0);
}

#[test]
fn a_roof_without_horizontal_support_is_a_mechanism() {
    let params = StructureParams {
        supports: vec![SupportParams {
            at: Some(SupportPlace::Boundary),
            fixed: vec![Direction::Uz],
            ..SupportParams::default()
        }],
        ..at_height(0.3)
    };
    let Err(AnalysisError::Mechanism(motion)) = analyse(&dome(6, 12.0, 1.5), &params) else {
        panic!("must be a mechanism")
    };
    assert!(matches!(motion.direction, Direction::Ux | Direction::Uy), "{motion:?}");
}

#[test]
fn a_roof_past_its_critical_load_is_unstable_and_first_order_says_so_by_its_factor() {
    let mut params = at_height(0.05);
    params.loads.insert("snow".into(), LoadParams::Projected { down_pa: 50_000.0, factor: None });
    let pattern = dome(8, 40.0, 1.0);
    assert!(matches!(analyse(&pattern, &params), Err(AnalysisError::Unstable { .. })));
    params.order = 1;
    assert!(analyse(&pattern, &params).unwrap().buckling_factor < 1.0);
}

#[test]
fn second_order_moves_further_and_tends_to_first_order_for_small_loads() {
    let pattern = dome(8, 30.0, 2.0);
    let deflection = |order, scale: f64| {
        let mut params = StructureParams { order, ..at_height(0.2) };
        for factors in params.combinations.values_mut() {
            factors.values_mut().for_each(|f| *f *= scale);
        }
        analyse(&pattern, &params).unwrap().deflection_m / scale
    };
    assert!(deflection(2, 1.0) > 1.01 * deflection(1, 1.0));
    assert!((deflection(2, 1e-6) / deflection(1, 1e-6) - 1.0).abs() < 1e-5);
}

#[test]
fn splitting_members_changes_little_on_a_fine_grid_and_lowers_the_factor() {
    let pattern = dome(12, 24.0, 3.0);
    let factor = |elements: &str| {
        let elements_per_member = serde_json::from_str(elements).unwrap();
        analyse(&pattern, &StructureParams { elements_per_member, ..at_height(0.12) })
            .unwrap()
            .buckling_factor
    };
    let (one, three) = (factor("1"), factor("3"));
    assert!(three < one && three > 0.98 * one, "{one} {three}");
    // Every edge is about as long as the target: "auto" splits none.
    assert_eq!(factor("\"auto\""), one);
}

#[test]
fn excluded_zones_leave_members_out_of_utilisation_only() {
    let pattern = dome(10, 20.0, 2.5);
    let all = analyse(&pattern, &at_height(0.4)).unwrap();
    let mut params = at_height(0.4);
    params.utilisation = serde_json::from_str(r#"{"exclude":[{"corners":true,"radius_m":4.0}]}"#).unwrap();
    let some = analyse(&pattern, &params).unwrap();
    assert_eq!(all.utilisation, all.utilisation_all);
    assert_eq!(some.utilisation_all, all.utilisation_all);
    assert!(some.utilisation < all.utilisation, "{} {}", some.utilisation, all.utilisation);
}

#[test]
fn a_section_of_given_properties_is_the_box_that_has_them() {
    let pattern = dome(6, 12.0, 1.5);
    for shear_deformation in [false, true] {
        let of_box = StructureParams { shear_deformation, ..at_height(0.2) };
        let s = Section::of_params(&of_box.section, 0.2).unwrap();
        let section = SectionParams::Properties {
            width_m: 0.25,
            area_m2: s.area,
            iy_m4: s.iy,
            iz_m4: s.iz,
            j_m4: s.j,
            wy_m3: s.wy,
            wz_m3: s.wz,
            asy_m2: s.asy,
            asz_m2: s.asz,
        };
        let given = StructureParams { section, ..of_box.clone() };
        let (a, b) = (analyse(&pattern, &of_box).unwrap(), analyse(&pattern, &given).unwrap());
        assert_eq!(
            (a.mass_kg, a.deflection_m, a.utilisation, a.buckling_factor),
            (b.mass_kg, b.deflection_m, b.utilisation, b.buckling_factor)
        );
        let sized = StructureParams { height: sized().height, ..given };
        assert!(sized.validate().iter().any(|(key, _)| key == "height"), "{:?}", sized.validate());
    }
}

#[test]
fn what_is_wrong_with_the_parameters_is_named() {
    let keys = |change: fn(&mut StructureParams)| {
        let mut params = sized();
        change(&mut params);
        params.validate().into_iter().map(|(key, _)| key).collect::<Vec<_>>()
    };
    assert!(keys(|_| ()).is_empty());
    assert_eq!(keys(|p| p.order = 3), ["order"]);
    assert!(keys(|p| p.material.poisson = 0.5).is_empty());
    assert_eq!(keys(|p| p.material.poisson = 0.501), ["material.poisson"]);
    assert_eq!(keys(|p| p.material.poisson = -1.0), ["material.poisson"]);
    assert_eq!(keys(|p| p.height = HeightParams::Fixed { fixed_m: 0.04 }), ["height.fixed_m"]);
    assert_eq!(keys(|p| p.height = HeightParams::Fixed { fixed_m: -1.0 }), ["height.fixed_m"]);
    assert_eq!(
        keys(|p| {
            p.combinations.get_mut("sls").unwrap().insert("wind".into(), 1.0);
        }),
        ["combinations.sls.wind"]
    );
    assert_eq!(keys(|p| p.requirements[0].combination = Some("als".into())), ["requirement[0].combination"]);
    assert_eq!(keys(|p| p.requirements[0].min = Some(1.0)), ["requirement[0].min"]);
    assert_eq!(keys(|p| p.requirements[1].max = None), ["requirement[1].max"]);
    assert_eq!(keys(|p| p.supports[0].at = None), ["support[0].at"]);
    assert_eq!(keys(|p| p.requirements[2].min = Some(f64::NAN)), ["requirement[2].min"]);
}

#[test]
fn deflection_comes_from_the_combination_its_requirement_names() {
    let pattern: Pattern = dome(6, 18.0, 2.0);
    let mut params = StructureParams { order: 1, ..at_height(0.2) };
    let sls = analyse(&pattern, &params).unwrap();
    params.requirements[0].combination = Some("uls".into());
    let uls = analyse(&pattern, &params).unwrap();
    assert!(uls.deflection_m > 1.3 * sls.deflection_m);
    params.requirements = Vec::<RequirementParams>::new();
    assert_eq!(analyse(&pattern, &params).unwrap().deflection_m, sls.deflection_m);
}

/// Three combinations, one of them with requirements that nothing meets, and every order of the requirements.
#[test]
fn metrics_are_the_worst_over_all_combinations_required_whatever_their_order() {
    let pattern: Pattern = dome(6, 18.0, 2.0);
    let mut params = at_height(0.2);
    let scaled = |factor: f64| [("self_weight", factor), ("glass", factor), ("snow", factor)];
    for (name, factor) in [("light", 0.5), ("heavy", 3.0), ("unasked", 9.0)] {
        let cases = scaled(factor).into_iter().map(|(case, factor)| (case.to_owned(), factor)).collect();
        params.combinations.insert(name.into(), cases);
    }
    let one = |quantity: Quantity, combination: &str| {
        let (max, min) =
            if quantity == Quantity::BucklingFactor { (None, Some(1.5)) } else { (Some(0.5), None) };
        RequirementParams { quantity: quantity.into(), combination: Some(combination.into()), max, min }
    };
    let quantities = [Quantity::Utilisation, Quantity::Deflection, Quantity::BucklingFactor];
    let all: Vec<_> = quantities
        .into_iter()
        .flat_map(|quantity| ["light", "heavy", "uls"].map(|name| one(quantity, name)))
        .collect();
    let alone = |name: &str| {
        let mut params = params.clone();
        params.requirements = quantities.map(|quantity| one(quantity, name)).into();
        analyse(&pattern, &params).unwrap()
    };
    let (light, heavy) = (alone("light"), alone("heavy"));
    assert!(heavy.utilisation > 2.0 * light.utilisation && heavy.buckling_factor < light.buckling_factor);
    for turn in 0..all.len() {
        params.requirements = all.clone();
        params.requirements.rotate_left(turn);
        let response = analyse(&pattern, &params).unwrap();
        assert_eq!(response.utilisation, heavy.utilisation);
        assert_eq!(response.utilisation_all, heavy.utilisation_all);
        assert_eq!(response.utilisation_von_mises, heavy.utilisation_von_mises);
        assert_eq!(response.deflection_m, heavy.deflection_m);
        assert_eq!(response.support_slide_m, heavy.support_slide_m);
        assert_eq!(response.buckling_factor, heavy.buckling_factor);
        let governing = &response.governing;
        assert_eq!(
            [&governing.utilisation, &governing.deflection, governing.buckling.as_ref().unwrap()],
            ["heavy"; 3]
        );
    }
    // A quantity that no requirement names follows its family.
    params.requirements =
        vec![one(Quantity::UtilisationAll, "light"), one(Quantity::UtilisationAll, "heavy")];
    let response = analyse(&pattern, &params).unwrap();
    assert_eq!((response.utilisation, response.governing.utilisation.as_str()), (heavy.utilisation, "heavy"));
    let detailed = analyse_detailed(&pattern, &params, Proof::None).unwrap();
    assert_eq!(detailed.enveloped, ["heavy", "light"]);
}
