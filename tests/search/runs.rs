//! The search on a cheap problem: reproducible, never the same design twice, failures are data.

use std::collections::BTreeSet;
use std::sync::atomic::Ordering;

use quadrille::evolve::{Domination, FAILED, Violation, compare_objectives, visible};
use quadrille::grammar::Tokens;
use quadrille::random::Rng;
use quadrille::search::{
    Breeding, Ended, Evaluation, Identity, Observer, Outcome, Problem, Progress, RuleOperator, Silent,
    StopFlag, ThreadServer, run,
};

use crate::support::{Counting, Planted, island_settings, run_silently, settings};

/// The front is exactly the non-dominated set of all feasible rows to six digits, the earliest of equal ones.
fn check_front(outcome: &Outcome) {
    let feasible: Vec<usize> =
        (0..outcome.evaluated.len()).filter(|&i| outcome.evaluated[i].is_feasible()).collect();
    let objectives = |i: usize| visible(&outcome.evaluated[i].objectives);
    let free = |&i: &usize| {
        let before = |j: usize| j < i && objectives(j) == objectives(i);
        let beaten = |j: usize| compare_objectives(&objectives(j), &objectives(i)) == Domination::First;
        feasible.iter().all(|&j| !before(j) && !beaten(j))
    };
    let expected: BTreeSet<usize> = feasible.iter().copied().filter(free).collect();
    assert_eq!(outcome.front.iter().copied().collect::<BTreeSet<_>>(), expected);
    assert!(outcome.front.windows(2).all(|w| objectives(w[0])[0] <= objectives(w[1])[0]), "sorted");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let reference = run_silently(&Counting::new(), &settings(12), 1);
    assert_eq!(reference.ended, Ended::Generations);
    assert_eq!(reference.generations.len(), 13);
    check_front(&reference);
    for threads in [2, 3, 8] {
        assert_eq!(run_silently(&Counting::new(), &settings(12), threads), reference, "{threads} threads");
    }
}

#[test]
fn islands_are_the_same_for_any_number_of_threads_and_exchange_their_best() {
    let search = |migrate: u32, threads: usize| {
        let mut settings = island_settings(12);
        settings.search.migrate = migrate;
        run_silently(&Counting::new(), &settings, threads)
    };
    let reference = search(2, 1);
    check_front(&reference);
    for threads in [2, 3, 8] {
        assert_eq!(search(2, threads), reference, "{threads} threads");
    }
    let apart = search(1000, 1);
    let until = |outcome: &Outcome, generation: u32| {
        outcome.evaluated.iter().filter(|row| row.generation <= generation).cloned().collect::<Vec<_>>()
    };
    assert_eq!(until(&apart, 1), until(&reference, 1), "nobody has moved yet");
    assert_ne!(until(&apart, 12), until(&reference, 12), "and then somebody has");
    let of_generation = |g: u32| reference.evaluated.iter().filter(|row| row.generation == g).count();
    assert!((1..=12).all(|g| of_generation(g) <= 18), "three times the population");
    assert!(of_generation(1) > 12);
}

#[test]
fn what_is_near_comes_first_in_a_fixed_order_and_each_design_once() {
    let first = |seed: u64, budget: Option<u64>, share: f64| {
        let mut settings = island_settings(3);
        (settings.seed, settings.search.evaluations) = (seed, budget);
        settings.search.initial.near_share = share;
        let outcome = run_silently(&Counting::new(), &settings, 2);
        let strings = outcome.evaluated.iter().filter(|row| row.generation == 0);
        strings.map(|row| row.tokens.to_string()).collect::<Vec<_>>()
    };
    let found = first(1, None, 0.4);
    assert_eq!(found.len(), 36, "0.4 of what three generations of 18 are 0.6 of");
    assert_eq!(first(2, None, 0.4), found, "no chance involved");
    // One step, then two, from each of them in order.
    assert_eq!(found[..9], ["", "D", "PD", "PPD", "TD", "PTD", "ATA", "ATTA", "AoTAo"]);
    assert_eq!(found[9..12], ["DD", "DPD", "DPPD"]);
    assert!(!found.contains(&"PDD".to_owned()), "as DPD");
    assert_eq!(first(1, Some(100), 0.3), found[..30]);
    assert_eq!(first(1, Some(1000), 0.005), found[..18], "the population at least");
    let all = first(1, Some(1000), 0.4);
    let simple = all.iter().position(|string| string == "TATA*").expect("the simple polyedges come last");
    assert_eq!((all.len(), all[simple + 1].as_str()), (simple + 2, "PPATA"), "and then nothing is left");
}

#[test]
fn geometry_chooses_among_candidates() {
    let search = |screen: usize, planted: Planted, threads: usize| {
        let problem = Counting { previews: true, planted, ..Counting::new() };
        let mut settings = settings(12);
        settings.search.screen = screen;
        run_silently(&problem, &settings, threads)
    };
    let (plain, screened) = (search(1, Planted::Nothing, 1), search(3, Planted::Nothing, 1));
    assert_eq!(plain, run_silently(&Counting::new(), &settings(12), 1), "one candidate is no choice");
    let Breeding { bred, duplicates, rejected, screened: passed_over, .. } = screened.breeding;
    assert!(passed_over > screened.evaluated.len() as u64, "{passed_over} passed over");
    assert_eq!(bred, duplicates + rejected + passed_over + screened.evaluated.len() as u64 - 1);
    // What geometry knows to be infeasible is analysed only where nothing else was bred.
    let infeasible =
        |o: &Outcome| o.evaluated.iter().filter(|r| r.generation > 1 && !r.is_feasible()).count();
    assert!(infeasible(&screened) < infeasible(&plain), "{} {}", infeasible(&screened), infeasible(&plain));
    for threads in [2, 3, 8] {
        assert_eq!(search(3, Planted::Nothing, threads), screened, "{threads} threads");
    }
    let panicking = search(3, Planted::Panic, 2);
    assert_eq!(panicking.ended, Ended::Generations);
    check_front(&panicking);
}

#[test]
fn another_seed_is_another_run() {
    let mut other = settings(3);
    other.seed = 8;
    let (a, b) = (run_silently(&Counting::new(), &settings(3), 2), run_silently(&Counting::new(), &other, 2));
    assert_ne!(a.evaluated, b.evaluated);
    assert_eq!(a.evaluated[0].tokens.len(), 0, "the empty string is always evaluated, and first");
}

#[test]
fn nothing_is_evaluated_twice_and_everything_is_counted() {
    for min_distance in [0, 1, 2] {
        let mut settings = settings(15);
        settings.search.duplicates.min_distance = min_distance;
        let problem = Counting::new();
        let outcome = run_silently(&problem, &settings, 2);
        let codes: BTreeSet<u128> = outcome.evaluated.iter().map(|r| r.code.0).collect();
        assert_eq!(codes.len(), outcome.evaluated.len(), "one row a code");
        assert_eq!(problem.evaluated.load(Ordering::Relaxed) as usize, outcome.evaluated.len());
        let Breeding { bred, duplicates, neighbours, rejected, cached, .. } = outcome.breeding;
        // The seed, the empty string, was not bred.
        let accepted = outcome.evaluated.len() as u64 - 1 + cached;
        assert_eq!(bred, duplicates + neighbours + rejected + accepted);
        match min_distance {
            0 => assert!(cached > 0 && duplicates == 0 && neighbours == 0),
            1 => assert!(cached == 0 && duplicates > 0 && neighbours == 0),
            _ => assert!(cached == 0 && duplicates > 0 && neighbours > 0),
        }
        assert!(rejected > 0);
        check_front(&outcome);
    }
}

#[test]
fn the_hypervolume_never_falls_and_waits_for_twenty_feasible_designs() {
    for objectives in [3, 5] {
        let mut settings = settings(12);
        settings.objectives = objectives;
        let outcome = run_silently(&Counting { objectives, ..Counting::new() }, &settings, 2);
        let known: Vec<f64> = outcome.generations.iter().filter_map(|g| g.hypervolume).collect();
        assert!(known.windows(2).all(|w| w[0] <= w[1]), "{known:?}");
        assert!(known[0] < known[known.len() - 1]);
        for row in &outcome.generations {
            assert_eq!(row.hypervolume.is_some(), row.feasible >= 20, "generation {}", row.generation);
        }
    }
}

#[test]
fn given_ideal_and_reference_are_used_from_the_start() {
    let mut settings = settings(2);
    (settings.ideal, settings.reference) = (vec![0.0; 3], vec![40.0; 3]);
    let outcome = run_silently(&Counting::new(), &settings, 2);
    assert!(outcome.generations.iter().all(|g| g.hypervolume.is_some()));
    assert_eq!(outcome.normalisation.expect("given").reference, [40.0; 3]);
}

#[test]
fn a_budget_of_evaluations_is_kept_exactly() {
    for budget in [1, 17, 50, 100] {
        let mut settings = settings(1000);
        settings.search.evaluations = Some(budget);
        settings.search.rebreed_rejected = false;
        let outcome = run_silently(&Counting::new(), &settings, 3);
        assert_eq!(outcome.ended, Ended::Evaluations);
        assert_eq!(outcome.evaluated.iter().filter(|r| r.structural).count() as u64, budget);
        assert_eq!(outcome.generations.last().map(|g| g.structural), Some(budget));
        check_front(&outcome);
    }
}

#[test]
fn a_search_that_stalls_or_runs_out_of_designs_ends() {
    let mut stalling = settings(10_000);
    stalling.search.stall_generations = Some(5);
    assert_eq!(run_silently(&Counting::new(), &stalling, 2).ended, Ended::Stall);

    let mut tiny = settings(10_000);
    tiny.search.tokens.max = 4;
    let problem = Counting { bounds: tiny.search.tokens, ..Counting::new() };
    let outcome = run_silently(&problem, &tiny, 2);
    assert_eq!(outcome.ended, Ended::Exhausted);
    assert!(outcome.breeding.empty > 0 && outcome.evaluated.len() > 100);
}

#[test]
fn a_search_that_has_found_nothing_yet_does_not_stall() {
    let generations = |reference: f64| {
        let mut settings = settings(60);
        settings.search.stall_generations = Some(2);
        (settings.ideal, settings.reference) = (vec![0.0; 3], vec![reference; 3]);
        let outcome = run_silently(&Counting::new(), &settings, 2);
        (outcome.ended, outcome.generations)
    };
    // Out of reach: the hypervolume is 0 throughout.
    let (ended, rows) = generations(0.01);
    assert!(rows.iter().all(|row| row.hypervolume == Some(0.0)));
    assert_eq!((ended, rows.len()), (Ended::Generations, 61));
    // Within reach, but not at once.
    let late = (1..40).map(|k| generations(0.2 * f64::from(k))).find(|(_, rows)| {
        rows[0].hypervolume == Some(0.0) && rows.last().is_some_and(|row| row.hypervolume > Some(0.0))
    });
    let (ended, rows) = late.expect("some reference is reached late");
    let volumes: Vec<f64> = rows.iter().filter_map(|row| row.hypervolume).collect();
    let counted = volumes.windows(3).filter(|w| w[0] > 0.0 && w[0] == w[2]).count();
    assert_eq!((ended, counted), (Ended::Stall, 1), "{volumes:?}");
    assert!(volumes.iter().filter(|&&volume| volume == 0.0).count() > 0);
}

/// A problem of which only the design with this code is feasible.
struct Rare(Counting, u128);

impl Problem for Rare {
    fn identify(&self, tokens: &Tokens) -> Identity {
        self.0.identify(tokens)
    }
    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        let mut evaluation = self.0.evaluate(tokens);
        if self.identify(tokens).code.0 != self.1 {
            evaluation.violation = Violation::new(1, 1.0);
        }
        evaluation
    }
    fn random(&self, rng: &mut Rng) -> Tokens {
        self.0.random(rng)
    }
    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        self.0.vary(operator, expressed, rng)
    }
}

#[test]
fn before_the_axes_are_known_a_generation_without_a_feasible_design_is_one_without_progress() {
    let ended = |feasible: u128| {
        let mut few = settings(30);
        (few.search.population, few.search.stall_generations) = (2, Some(4));
        let problem = Rare(Counting::new(), feasible);
        let server = ThreadServer::new(&problem, 2).expect("threads");
        let outcome = run(&problem, &server, &few, &StopFlag::new(), None, &mut Silent).expect("no store");
        assert!(outcome.generations.iter().all(|row| row.hypervolume.is_none()));
        (outcome.ended, outcome.generations.len())
    };
    // The empty string is evaluated first.
    assert_eq!(ended(0), (Ended::Stall, 5));
    assert_eq!(ended(u128::MAX), (Ended::Generations, 31), "nothing feasible, nothing stalls");
}

#[test]
fn the_time_limit_ends_a_run_in_good_order() {
    let mut settings = settings(u32::MAX - 1);
    settings.search.minutes = Some(0.002);
    let outcome = run_silently(&Counting::new(), &settings, 2);
    assert!(matches!(outcome.ended, Ended::Minutes | Ended::Exhausted), "{:?}", outcome.ended);
    check_front(&outcome);
}

#[test]
fn failures_are_data() {
    let sound = run_silently(&Counting::new(), &settings(10), 2);
    for planted in [Planted::Panic, Planted::NaN, Planted::Error] {
        let problem = Counting { planted, ..Counting::new() };
        let outcome = run_silently(&problem, &settings(10), 2);
        assert_eq!(outcome.ended, Ended::Generations);
        let failed: Vec<_> = outcome.evaluated.iter().filter(|r| r.violation.stage == FAILED).collect();
        assert!(failed.len() >= 5, "{planted:?}: {}", failed.len());
        let word = match planted {
            Planted::Panic => "panic: planted",
            Planted::NaN => "not finite",
            _ => "planted error",
        };
        assert!(failed.iter().all(|r| r.reason.contains(word) && r.objectives.is_empty()));
        assert!(outcome.front.iter().all(|&i| outcome.evaluated[i].is_feasible()));
        for row in &outcome.evaluated {
            assert!(row.objectives.iter().all(|f| f.is_finite()) && row.violation.measure.is_finite());
            assert!(row.metrics.iter().flatten().all(f64::is_finite));
        }
        check_front(&outcome);
        assert_ne!(outcome.evaluated, sound.evaluated);
    }
}

#[test]
fn search_beats_random_sampling_here() {
    let volume = |immigrants: f64, seed: u64| {
        let mut settings = settings(u32::MAX - 1);
        settings.search.evaluations = Some(400);
        settings.search.immigrants = immigrants;
        settings.seed = seed;
        (settings.ideal, settings.reference) = (vec![0.0; 3], vec![40.0; 3]);
        let outcome = run_silently(&Counting::new(), &settings, 2);
        outcome.generations.last().and_then(|g| g.hypervolume).expect("given axes")
    };
    let wins = (1..=7).filter(|&seed| volume(0.0, seed) > volume(1.0, seed)).count();
    assert!(wins >= 6, "{wins} of 7");
}

#[test]
fn the_observer_sees_every_evaluation_and_generation() {
    #[derive(Default)]
    struct Counter(u64, u64);
    impl Observer for Counter {
        fn evaluated(&mut self, progress: &Progress) {
            self.0 += 1;
            assert_eq!(progress.evaluations, self.0);
        }
        fn generation(&mut self, _row: &quadrille::search::GenerationRow) {
            self.1 += 1;
        }
    }
    let problem = Counting::new();
    let server = ThreadServer::new(&problem, 2).expect("threads");
    let mut counter = Counter::default();
    let outcome =
        run(&problem, &server, &settings(4), &StopFlag::new(), None, &mut counter).expect("no store");
    assert_eq!((counter.0, counter.1), (outcome.evaluated.len() as u64, 5));
    assert_eq!(outcome, run_silently(&problem, &settings(4), 1), "being watched changes nothing");
}

#[test]
fn cheap_failures_do_not_use_a_generation_up() {
    let structural = |refills: u32| {
        let mut settings = settings(0);
        settings.search.refills = refills;
        // Rejected designs are evaluated here, and fail before their structure is analysed.
        settings.search.rebreed_rejected = false;
        settings.search.population = 60;
        let outcome = run_silently(&Counting { fragile: true, ..Counting::new() }, &settings, 2);
        let analysed = outcome.evaluated.iter().filter(|r| r.structural).count();
        assert!(outcome.evaluated.len() > analysed);
        analysed
    };
    assert!(structural(0) < 50);
    assert!((55..=60).contains(&structural(5)));
}
