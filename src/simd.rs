//! The widest vectors of the processor at hand, for plain loops.

/// Runs `f` compiled for the processor's own vector instructions, chosen when the program runs. `f` must be inlined
/// (`#[inline(always)]`), with all it calls, to gain by it. Nothing is reassociated or fused: the result is the same
/// to the bit on every processor.
pub fn wide<R>(f: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(f)
}
