//! Arguments that several subcommands share.

use clap::builder::{PossibleValuesParser, RangedI64ValueParser, TypedValueParser};
use selvedge::DEFAULT_MEMORY_LIMIT;
use selvedge::simd::{Level, available_levels, best_level};
use selvedge_laboratory::methods::Preset;

/// The largest number of threads. No machine has more cores, and each thread needs buffers of its own.
const MAX_THREADS: i64 = 1024;

/// The largest refinement: a sleeve of 13 million triangles, which fits into a large machine's memory.
const MAX_REFINEMENT: i64 = 10_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ScalarChoice {
    /// 32-bit floating point; positions are rounded.
    F32,
    /// 64-bit floating point.
    F64,
}

#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Simd {
    /// Compute with this instruction set instead of the machine's widest. Only the time changes
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(available_levels().into_iter().map(|(name, _)| name)))]
    simd: Option<String>,
}

impl Simd {
    /// Returns the instruction set of that name, or the machine's best.
    pub(crate) fn level(&self) -> Level {
        let named = self.simd.as_ref().and_then(|wanted| {
            let mut levels = available_levels().into_iter();
            levels.find(|(name, _)| name == wanted)
        });
        named.map_or_else(best_level, |(_, level)| level)
    }
}

#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Threads {
    /// Use this many threads; 0 means one for each core
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        value_parser = clap::value_parser!(u16).range(0..=MAX_THREADS)
    )]
    threads: u16,
}

impl Threads {
    pub(crate) fn get(self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            threads => threads.into(),
        }
    }
}

/// `--memory-limit`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct MemoryLimit {
    /// Refuse a mesh whose pairs and contacts take more than this many MiB; 0 is no limit
    #[arg(long, value_name = "MIB", default_value_t = (DEFAULT_MEMORY_LIMIT >> 20) as u32)]
    memory_limit: u32,
}

impl MemoryLimit {
    /// Returns the limit in bytes, if there is one.
    pub(crate) fn get(self) -> Option<u64> {
        (self.memory_limit > 0).then_some(u64::from(self.memory_limit) << 20)
    }
}

/// Parses a method's name. The error lists the known ones.
pub(crate) fn preset_parser() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::ALL.map(Preset::name)).try_map(|name| name.parse::<Preset>())
}

/// Parses a multiple of the sleeve's 1,345 triangles.
pub(crate) fn refinement_parser() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=MAX_REFINEMENT)
}
