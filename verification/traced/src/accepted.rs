//! Whether what the code gives a prover to read is what somebody has accepted: digests of it, term by term, in `accepted.sha256`.
//!
//! The texts themselves are thousands of lines that nobody reads. They are written anew where a proof is checked, and a digest
//! notices each change as well as a kept copy would.

use crate::{Prover, Text};
use sha2::{Digest as _, Sha256};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// The list of what is accepted.
#[must_use]
pub fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("accepted.sha256")
}

/// What the list would say of what the code gives now: a line for each term, with its digest first.
#[must_use]
pub fn list() -> String {
    Prover::ALL.into_iter().flat_map(lines).map(|line| line + "\n").collect()
}

/// Demands that what the code gives a prover is what was accepted.
///
/// # Errors
/// If it is not, or the list cannot be read: which terms have changed, how to see what has, and how to accept it.
pub fn check(prover: Prover) -> Result<(), String> {
    let path = path();
    let list = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    compare(prover, &lines(prover), &list)
}

/// What [`check`] does, of lines and a list.
///
/// # Errors
/// As there.
pub fn compare(prover: Prover, given: &[String], list: &str) -> Result<(), String> {
    let of_prover = |line: &&str| {
        line.split_once("  ")
            .is_some_and(|(_, term)| term.starts_with(&folder(prover)))
    };
    let accepted: Vec<&str> = list.lines().filter(of_prover).collect();
    if given == accepted {
        return Ok(());
    }
    let mut complaint =
        "what core's kernels compute is not what was accepted (look at the first: names in later ones count what stands before):"
            .to_owned();
    for line in given.iter().filter(|line| !accepted.contains(&line.as_str())) {
        let (_, term) = line.split_once("  ").expect("a digest and a term");
        write!(complaint, "\n    {term}").expect("a string has room");
    }
    let gone = accepted.iter().filter_map(|line| line.split_once("  "));
    for (_, term) in gone.filter(|(_, term)| !given.iter().any(|line| line.ends_with(term))) {
        write!(complaint, "\n    {term} (not there any more)").expect("a string has room");
    }
    complaint.push_str(
        "\nTo see what has changed since the last commit, or another: verification/traced/difference.sh [COMMIT]\
         \nTo accept it: cargo run -p selvedge-traced -- accept",
    );
    match prover {
        Prover::Gappa => complaint.push_str("; verification/gappa/check.sh then proves it anew"),
        Prover::Coq => complaint.push_str("; verification/proofs/check.sh then proves it anew"),
    }
    Err(complaint)
}

fn folder(prover: Prover) -> String {
    format!("{}/", prover.name())
}

fn lines(prover: Prover) -> Vec<String> {
    let terms = prover.texts().into_iter().flat_map(|text| match prover {
        Prover::Gappa => vec![text],
        Prover::Coq => definitions(text),
    });
    let digest = |text: &str| -> String { Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect() };
    terms
        .map(|(name, text)| format!("{}  {}{name}", digest(&text), folder(prover)))
        .collect()
}

/// A file for Coq, parted behind each definition that has a name of its own (`s12` and `m3` have none): what that is made of and
/// was not defined before stands ahead of it.
fn definitions((file, text): Text) -> Vec<Text> {
    let is_numbered = |name: &str| name[1..].bytes().all(|byte| byte.is_ascii_digit());
    let mut parts = Vec::new();
    let (mut module, mut part) = (String::new(), String::new());
    let mut defined = None;
    for line in text.lines() {
        part.push_str(line);
        part.push('\n');
        let mut words = line.split(' ');
        match (words.next(), words.next()) {
            (Some("Module"), Some(name)) => module = name.replace('.', "") + ".",
            (Some("Definition"), Some(name)) if !is_numbered(name) => defined = Some(name.to_owned()),
            _ => {}
        }
        if line.ends_with('.')
            && let Some(name) = defined.take()
        {
            parts.push((format!("{file} {module}{name}"), std::mem::take(&mut part)));
        }
    }
    if !part.is_empty() {
        parts.push((format!("{file} (its end)"), part));
    }
    parts
}
