//! Shards of a campaign, joined, are the single run, however often they were killed. Everything that is not one run is refused.

use crate::support::prelude::*;
use proptest::collection::vec;
use selvedge_verification::campaign::exact::{self, Claim, Scenes};
use selvedge_verification::campaign::{
    AnotherRun, Chunks, Digest, FileError, Findings, Progress, Refusal, Shard, StateFile, merge, read, run,
};
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;
use std::time::Duration;

/// A campaign whose findings cost nothing: one number for each chunk.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Numbers {
    sum: u64,
    least: Option<u64>,
}

impl Findings for Numbers {
    const CAMPAIGN: &'static str = "numbers";
    type OfChunk = u64;

    fn add(&mut self, _: u64, number: u64) {
        self.join(Self {
            sum: number,
            least: Some(number),
        });
    }

    fn join(&mut self, other: Self) {
        self.sum = self.sum.wrapping_add(other.sum);
        self.least = self.least.into_iter().chain(other.least).min();
    }

    fn wrong(&self) -> u64 {
        0
    }
}

const fn number(chunk: u64) -> u64 {
    (chunk + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

fn numbers(chunks: u64) -> Progress<Numbers> {
    Progress::with_nothing_done(7, chunks, 1, &[("numbers", "all".to_owned())], Numbers::default())
}

fn shard(text: &str) -> Shard {
    text.parse().expect("a shard")
}

fn of_shard(chunks: u64, part: &str) -> Progress<Numbers> {
    numbers(chunks).of_shard(shard(part), Some("a commit"), "the command")
}

fn to_the_end(progress: Progress<Numbers>) -> Progress<Numbers> {
    run(progress, 1, number, |_| {}, || false)
}

/// Writes the state as JSON and reads it back.
fn kept<F: Findings>(progress: &Progress<F>) -> Progress<F> {
    let kept = serde_json::to_string(progress).expect("JSON");
    serde_json::from_str(&kept).expect("what was written")
}

/// Finishes shards, in files of their names.
fn finished(chunks: u64, parts: &[&str]) -> Vec<(PathBuf, Progress<Numbers>)> {
    let of = |part: &&str| (PathBuf::from(part), to_the_end(of_shard(chunks, part)));
    parts.iter().map(of).collect()
}

proptest! {
    #[test]
    fn each_chunk_is_in_one_shard_and_shards_are_of_one_size(chunks in 0..2_000_000_000_000_u64, of in 1..300_u64) {
        let mut next = 0;
        for number in 1..=of {
            let range = shard(&format!("{number}/{of}")).range(chunks);
            prop_assert_eq!(range.start, next);
            let size = range.end - range.start;
            prop_assert!(size == chunks / of || size == chunks / of + 1);
            next = range.end;
        }
        prop_assert_eq!(next, chunks);
    }

    /// Each shard is stopped after so many chunks, again and again, and resumed from its file.
    #[test]
    fn shards_of_any_number_join_to_the_single_run_whatever_stops_them(
        chunks in 0..120_u64,
        of in 1..14_u64,
        threads in 1..4_usize,
        stops in vec(1..9_u64, 1..14),
        order in any::<prop::sample::Index>(),
    ) {
        let mut shards = Vec::new();
        for number_of_shard in 1..=of {
            let name = format!("{number_of_shard}/{of}");
            let mut progress = of_shard(chunks, &name);
            let after = stops[number_of_shard as usize % stops.len()];
            while !progress.is_finished() {
                let seen = AtomicU64::new(0);
                let count = |_: &_| { seen.fetch_add(1, Ordering::Relaxed); };
                progress = run(kept(&progress), threads, number, count, || seen.load(Ordering::Relaxed) >= after);
            }
            shards.push((PathBuf::from(name), kept(&progress)));
        }
        let from = order.index(shards.len());
        shards.rotate_left(from);
        prop_assert_eq!(merge(shards), Ok(to_the_end(of_shard(chunks, "1/1"))));
    }

    #[test]
    fn the_digest_differs_if_one_chunk_differs(
        chunks in 2..60_u64,
        one in any::<prop::sample::Index>(),
        other in any::<prop::sample::Index>(),
    ) {
        let (one, other) = (one.index(chunks as usize) as u64, other.index(chunks as usize) as u64);
        let digest = |found: &(dyn Fn(u64) -> u64 + Sync)| run(numbers(chunks), 1, found, |_| {}, || false).digest;
        let right = digest(&number);
        prop_assert_ne!(digest(&|chunk| number(chunk) + u64::from(chunk == one)), right);
        // The sum of findings is the same, but each is in the other's chunk.
        let exchanged = |chunk| number(if chunk == one { other } else if chunk == other { one } else { chunk });
        prop_assert_eq!(digest(&exchanged) == right, one == other);
        // Neither a missing nor a doubled chunk has the same digest.
        let mut twice = right;
        twice += Digest::of_chunk(one, &number(one));
        prop_assert_ne!(twice, right);
    }

    #[test]
    fn a_set_of_chunks_is_a_set(chunks in vec(0..40_u64, 0..80)) {
        let (mut set, mut model) = (Chunks::default(), BTreeSet::new());
        for chunk in chunks {
            prop_assert_eq!(set.insert(chunk), model.insert(chunk));
            prop_assert_eq!(set.len(), model.len() as u64);
        }
        for chunk in 0..41 {
            prop_assert_eq!(set.contains(chunk), model.contains(&chunk));
        }
        // The runs are in order and apart, otherwise the text could not be read back.
        let text = serde_json::to_string(&set).expect("JSON");
        prop_assert_eq!(serde_json::from_str::<Chunks>(&text).expect("what was written"), set);
    }

    #[test]
    fn merge_refuses_a_gap_and_names_the_shards_around_it(of in 2..9_u64, missing in any::<prop::sample::Index>()) {
        let missing = missing.index(of as usize) as u64 + 1;
        let name = |number: u64| format!("{number}/{of}");
        let names: Vec<String> = (1..=of).filter(|&number| number != missing).map(name).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let gap = shard(&name(missing)).range(100);
        let refusal = merge(finished(100, &names)).expect_err("a gap");
        let file = |number: u64| Some(PathBuf::from(name(number)));
        prop_assert_eq!(&refusal, &Refusal::Gap {
            before: file(missing - 1).filter(|_| missing > 1),
            after: file(missing + 1).filter(|_| missing < of),
            begin: gap.start,
            last: gap.end - 1,
        });
    }
}

#[test]
fn shards_of_different_counts_join_if_they_have_each_chunk_once() {
    let joined = merge(finished(50, &["3/4", "1/2", "4/4"])).expect("each chunk once");
    assert_eq!(joined, to_the_end(of_shard(50, "1/1")));
}

#[test]
fn merge_refuses_an_overlap_and_names_both_shards() {
    let refused = |parts: &[&str]| merge(finished(100, parts)).expect_err("an overlap");
    let overlap = |files: [&str; 2], begin, last| Refusal::Overlap {
        files: files.map(PathBuf::from),
        begin,
        last,
    };
    assert_eq!(refused(&["1/2", "2/2", "1/2"]), overlap(["1/2", "1/2"], 0, 49));
    assert_eq!(refused(&["2/4", "2/2", "1/2"]), overlap(["1/2", "2/4"], 25, 49));
    assert_eq!(
        refused(&["1/2", "2/3", "3/3"]).to_string(),
        "1/2 and 2/3: chunks 33 to 49 are in both"
    );
}

#[test]
fn merge_refuses_an_unfinished_shard_and_says_how_to_go_on() {
    let mut shards = finished(100, &["1/2", "2/2"]);
    let seen = AtomicU64::new(0);
    let count = |_: &_| {
        seen.fetch_add(1, Ordering::Relaxed);
    };
    shards[1].1 = run(of_shard(100, "2/2"), 1, number, count, || seen.load(Ordering::Relaxed) >= 3);
    let refusal = merge(shards).expect_err("an unfinished shard");
    assert_eq!(refusal.to_string(), "2/2: unfinished, 3 of 50 chunks; resume it: the command");
}

#[test]
fn merge_refuses_another_commit_an_unknown_one_and_every_other_setting() {
    let refused = |change: fn(&mut Progress<Numbers>)| {
        let mut shards = finished(100, &["1/2", "2/2"]);
        change(&mut shards[1].1);
        merge(shards).expect_err("another run").to_string()
    };
    let message = |what: &str| format!("1/2 and 2/2: different runs, as {what} in the other");
    assert_eq!(
        refused(|shard| shard.settings.commit = Some("another".to_owned())),
        message("commit is a commit in one and another")
    );
    assert_eq!(
        refused(|shard| shard.settings.commit = None),
        message("commit is a commit in one and unknown")
    );
    assert_eq!(refused(|shard| shard.settings.seed = 8), message("seed is 7 in one and 8"));
    assert_eq!(
        refused(|shard| shard.settings.chunks = 101),
        message("number of chunks is 100 in one and 101")
    );
    assert_eq!(
        refused(|shard| shard.settings.cases_per_chunk = 2),
        message("cases a chunk is 1 in one and 2")
    );
    assert_eq!(
        refused(|shard| {
            shard.settings.depends_on.insert("numbers".to_owned(), "some".to_owned());
        }),
        message("numbers is all in one and some")
    );
    let unknown = |part: &str| {
        let progress = numbers(100).of_shard(shard(part), None, "the command");
        (PathBuf::from(part), to_the_end(progress))
    };
    let refusal = merge(vec![unknown("1/2"), unknown("2/2")]).expect_err("unknown commits");
    assert_eq!(refusal, Refusal::UnknownCommit("1/2".into()));
    assert_eq!(merge::<Numbers>(Vec::new()), Err(Refusal::NoShards));
}

#[test]
fn a_state_goes_on_only_as_the_run_and_the_shard_that_it_is_of() {
    let half = || of_shard(100, "1/2");
    let again = half().resume(numbers(100).of_shard(shard("1/2"), Some("a commit"), "another command"));
    assert_eq!(again.expect("the same shard").command, "another command");
    assert_eq!(
        half().resume(of_shard(100, "2/2")),
        Err(AnotherRun::Shard { was: 0..50, is: 50..100 })
    );
    let refusal = half().resume(numbers(100).of_shard(shard("1/2"), Some("another"), "the command"));
    assert_eq!(
        refusal.expect_err("another program").to_string(),
        "the state of another run, whose commit is a commit, not another"
    );
}

#[test]
fn what_is_no_shard_is_refused() {
    for text in ["", "1", "0/4", "5/4", "1/0", "-1/4", "1/4/2", "a/b", "1/18446744073709551616"] {
        assert!(text.parse::<Shard>().is_err(), "{text}");
    }
}

#[test]
fn a_file_that_is_no_state_of_the_campaign_is_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("state.json");
    assert!(read::<Numbers>(&file).expect("no file is no error").is_none());
    let state = serde_json::to_string(&of_shard(100, "1/2")).expect("JSON");
    let changes = [
        ("\"numbers\",\"commit\"", "\"others\",\"commit\""),
        ("\"end\":50", "\"end\":101"),
        ("\"done\":[]", "\"done\":[[40,60]]"),
        ("\"done\":[]", "\"done\":[[3,3]]"),
        ("\"done\":[]", "\"done\":[[5,7],[7,8]]"),
        ("\"digest\":\"0", "\"digest\":\""),
        ("\"digest\":\"0", "\"digest\":\"+"),
    ];
    let changed = changes.map(|(from, to)| {
        assert!(state.contains(from), "{from} is not in {state}");
        state.replacen(from, to, 1)
    });
    for text in changed
        .into_iter()
        .chain([state[..state.len() / 2].to_owned(), String::new()])
    {
        fs::write(&file, &text).expect("a file");
        let error = read::<Numbers>(&file).expect_err(&text);
        assert!(matches!(error, FileError::NotAState { .. }), "{error}");
        assert!(error.to_string().starts_with(&file.display().to_string()), "{error}");
    }
}

#[test]
fn of_two_who_open_a_state_the_second_waits_for_the_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("state.json");
    let first = StateFile::open(&file, |message| panic!("{message}")).expect("a lock");
    let (says, hears) = mpsc::channel();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let _second = StateFile::open(&file, |_| says.send("waits").expect("somebody hears"));
            says.send("has it").expect("somebody hears");
        });
        assert_eq!(hears.recv(), Ok("waits"));
        assert!(hears.recv_timeout(Duration::from_millis(50)).is_err(), "two have it");
        drop(first);
        assert_eq!(hears.recv(), Ok("has it"));
    });
}

#[test]
fn shards_of_every_campaign_in_rust_join_to_the_single_run() {
    let parts = ["1/3", "2/3", "3/3"];
    let pairs = |part: &str| (PathBuf::from(part), kept(&run_exact(fresh_exact(part), 2, |_| {})));
    assert_eq!(merge(parts.map(pairs).into()), Ok(pairs("1/1").1));
}

/// Thirteen small chunks, so that each kind of chunk occurs.
fn fresh_exact(part: &str) -> exact::Progress {
    let fresh = exact::Progress::new(5, 13 * 256, 256, &Scenes::default(), &Claim::CERTIFIED);
    fresh.of_shard(shard(part), Some("a commit"), "the command")
}

fn run_exact(progress: exact::Progress, threads: usize, after_chunk: impl Fn(&exact::Progress) + Sync) -> exact::Progress {
    exact::run(progress, &Scenes::default(), best_level(), threads, after_chunk, || false)
}

const OF_CHILD: [&str; 3] = ["SHARD_TO_BE_KILLED", "STATE_TO_BE_KILLED", "CHUNKS_BEFORE_THE_KILL"];

/// The child process of the test below; it finishes a shard. After so many chunks it only writes its state, so that the kill
/// comes during a write.
#[test]
#[ignore = "a process of the next test"]
fn a_shard_in_a_process_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let [part, state, chunks] = OF_CHILD.map(|name| std::env::var(name).ok());
    let state = state.map_or_else(|| folder.path().join("state.json"), PathBuf::from);
    let chunks = chunks.map(|chunks| chunks.parse().expect("a number"));
    let asked = fresh_exact(&part.unwrap_or_else(|| "2/3".to_owned()));
    let file = StateFile::open(&state, |_| {}).expect("a lock");
    let progress = match read(&state).expect("a state or none") {
        Some(kept) => exact::Progress::resume(kept, asked).expect("the same shard"),
        None => asked,
    };
    let ended = run_exact(progress, 2, |progress| {
        file.keep(progress).expect("a state is kept");
        while chunks.is_some_and(|chunks: u64| progress.done.len() >= chunks) {
            file.keep(progress).expect("a state is kept");
        }
    });
    file.keep(&ended).expect("a state is kept");
    assert!(
        read::<exact::ExactFindings>(&state)
            .expect("a state")
            .expect("a file")
            .is_finished()
    );
}

/// Starts a child process on that shard. The test kills it once so many chunks are done, or never.
fn start(part: &str, state: &Path, chunks: Option<u64>) -> Child {
    let name = stringify!(a_shard_in_a_process_of_its_own);
    let name = module_path!()
        .split_once("::")
        .map_or(name.to_owned(), |(_, module)| format!("{module}::{name}"));
    let [of_part, of_state, of_chunks] = OF_CHILD;
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command
        .args(["--ignored", "--exact", &name])
        .env(of_part, part)
        .env(of_state, state);
    if let Some(chunks) = chunks {
        command.env(of_chunks, chunks.to_string());
    }
    command.stdout(std::process::Stdio::null()).spawn().expect("a process")
}

fn kill_after(chunks: u64, part: &str, state: &Path) -> ExitStatus {
    let mut child = start(part, state, Some(chunks));
    let done = || {
        read::<exact::ExactFindings>(state)
            .expect("old state or new")
            .map_or(0, |progress| progress.done.len())
    };
    while done() < chunks {
        assert_eq!(child.try_wait().expect("a process"), None, "it ended before it was killed");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("a process that runs");
    child.wait().expect("a process")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// Kills the processes (SIGKILL) while they write their states.
    #[test]
    fn shards_whose_processes_are_killed_join_to_the_single_run(of in 1..5_u64, kills in vec(vec(1..4_u64, 0..3), 4)) {
        let folder = tempfile::tempdir().expect("a folder");
        let mut shards = Vec::new();
        for (number, kills) in (1..=of).zip(kills) {
            let part = format!("{number}/{of}");
            let state = folder.path().join(format!("{number}.json"));
            let mut done = 0;
            for chunks in kills {
                // There must be more chunks than before: a process that has them already would not be killed.
                done += chunks;
                if done > fresh_exact(&part).range.count() as u64 {
                    break;
                }
                prop_assert!(!kill_after(done, &part, &state).success());
            }
            prop_assert!(start(&part, &state, None).wait().expect("a process").success());
            shards.push((state.clone(), read(&state).expect("a state").expect("a file")));
        }
        prop_assert_eq!(merge(shards), Ok(run_exact(fresh_exact("1/1"), 1, |_| {})));
    }
}
