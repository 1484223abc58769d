//! Who evaluates: one small interface, served by threads now and by a cluster later.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;

use rayon::prelude::*;

use super::problem::{Evaluation, Identity, Problem};
use super::threads::{ThreadsError, thread_pool};
use crate::grammar::Tokens;

/// Evaluates batches of strings.
pub trait Server {
    /// What each string means, in order; `Err` with a message where identifying it panicked.
    fn identify(&self, batch: &[Tokens]) -> Vec<Result<Identity, String>>;

    /// Evaluates `batch` and hands each result over with its index as soon as it is there, in any order, on the
    /// caller's thread. Once `stop` returns true nothing new is begun, and what is in flight is still handed over.
    /// Returns when nothing is in flight.
    fn serve(
        &self,
        batch: &[Tokens],
        stop: &(dyn Fn() -> bool + Sync),
        done: &mut dyn FnMut(usize, Evaluation),
    );
}

/// Evaluates on a pool of threads, one thread per design.
pub struct ThreadServer<'a, P: Problem> {
    problem: &'a P,
    pool: rayon::ThreadPool,
}

impl<'a, P: Problem> ThreadServer<'a, P> {
    /// A server with `threads` threads; 0 = one per core.
    ///
    /// # Errors
    /// If the operating system does not give the threads.
    pub fn new(problem: &'a P, threads: usize) -> Result<Self, ThreadsError> {
        Ok(Self { problem, pool: thread_pool(threads)? })
    }
}

impl<P: Problem> Server for ThreadServer<'_, P> {
    fn identify(&self, batch: &[Tokens]) -> Vec<Result<Identity, String>> {
        let identify = |tokens: &Tokens| {
            let identity = catch_unwind(AssertUnwindSafe(|| self.problem.identify(tokens)));
            identity.map_err(|panic| format!("panic: {}", message(&*panic)))
        };
        self.pool.install(|| batch.par_iter().map(identify).collect())
    }

    fn serve(
        &self,
        batch: &[Tokens],
        stop: &(dyn Fn() -> bool + Sync),
        done: &mut dyn FnMut(usize, Evaluation),
    ) {
        let (sender, results) = mpsc::channel();
        // `in_place_scope_fifo` keeps this thread outside the pool, free to take results while the pool works.
        self.pool.in_place_scope_fifo(|scope| {
            for (index, tokens) in batch.iter().enumerate() {
                let sender = sender.clone();
                scope.spawn_fifo(move |_| {
                    if !stop() {
                        // The receiver outlives the scope, so a send cannot fail.
                        let _ = sender.send((index, evaluate(self.problem, tokens)));
                    }
                });
            }
            drop(sender);
            for (index, evaluation) in results {
                done(index, evaluation);
            }
        });
    }
}

/// One evaluation, a panic turned into data.
pub fn evaluate(problem: &impl Problem, tokens: &Tokens) -> Evaluation {
    catch_unwind(AssertUnwindSafe(|| problem.evaluate(tokens)))
        .unwrap_or_else(|panic| Evaluation::failed(format!("panic: {}", message(&*panic)), false))
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message")
}
