//! Compares the texts for the provers with the accepted ones. `accepted.sha256` has a digest of each term.
//!
//! The texts have thousands of lines, and are written again whenever a proof is checked. A digest notices each change as well as
//! a kept copy would.

use crate::{Prover, Text};
use sha2::{Digest as _, Sha256};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// The list of accepted terms.
pub fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("accepted.sha256")
}

/// Returns the list for the current code: a line for each term, with its digest first.
pub fn list() -> String {
    Prover::ALL
        .into_iter()
        .flat_map(digest_lines)
        .map(|line| line + "\n")
        .collect()
}

/// Checks that the current code gives the provers the accepted texts.
///
/// # Errors
/// Returns an error if it does not, or the list cannot be read. The message names the changed terms and says how to see and to
/// accept the changes.
pub fn check(prover: Prover) -> Result<(), String> {
    let path = path();
    let list = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    compare(prover, &digest_lines(prover), &list)
}

/// Checks lines against a list, for [`check`].
///
/// # Errors
/// Returns the errors of [`check`].
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
        "the terms of core's kernels are not the accepted ones (start with the first, since names in later ones depend on it):"
            .to_owned();
    for line in given.iter().filter(|line| !accepted.contains(&line.as_str())) {
        let (_, term) = line.split_once("  ").expect("a digest and a term");
        write!(complaint, "\n    {term}").expect("a string has room");
    }
    let gone = accepted.iter().filter_map(|line| line.split_once("  "));
    for (_, term) in gone.filter(|(_, term)| !given.iter().any(|line| line.ends_with(term))) {
        write!(complaint, "\n    {term} (removed)").expect("a string has room");
    }
    complaint.push_str(
        "\nTo see the changes since the last commit, or another one: verification/traced/difference.sh [COMMIT]\
         \nTo accept them: cargo run -p selvedge-traced -- accept",
    );
    match prover {
        Prover::Gappa => complaint.push_str("; then prove them: verification/gappa/check.sh"),
        Prover::Coq => complaint.push_str("; then prove them: verification/proofs/check.sh"),
    }
    Err(complaint)
}

fn folder(prover: Prover) -> String {
    format!("{}/", prover.name())
}

fn digest_lines(prover: Prover) -> Vec<String> {
    let terms = prover.texts().into_iter().flat_map(|text| match prover {
        Prover::Gappa => vec![text],
        Prover::Coq => definitions(text),
    });
    let digest = |text: &str| -> String { Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect() };
    terms
        .map(|(name, text)| format!("{}  {}{name}", digest(&text), folder(prover)))
        .collect()
}

/// Splits a file for Coq after each definition with a name of its own (`s12` and `m3` have none). The auxiliary definitions that
/// it needs stand before it.
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
