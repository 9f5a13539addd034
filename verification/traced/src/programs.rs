//! Programs for the interpreter in `verification/proofs/Replay.v`: the terms of each proof of a round, as lists of steps.
//!
//! A term has millions of parts, since it repeats what it uses twice. A program computes each of its steps once. Coq checks that
//! its steps are those of the terms in `Advance.v` and `AdvanceBeyond.v`, so nobody has to accept them.

use crate::{Text, beyond, coq};
use std::collections::BTreeMap;
use std::fmt::Write;

const HEAD: &str = "\
(* The terms of Advance.v and AdvanceBeyond.v as programs: each step once, in an order in which it uses those before.
   Written from the code by verification/traced/src/programs.rs. *)
From Coq Require Import ZArith List FMapPositive.
From Selvedge Require Import Expressions Machine Replay.
From Selvedge Require Advance AdvanceBeyond.
Import ListNotations.
Notation at_ k := (Input (Saved k)).

";

/// Each proof of a round: the name of its mask, and of its number if it has one.
const PROOFS: [(&str, &str, Option<&str>); 4] = [
    ("held", "held", Some("until_held")),
    ("turning", "turning", None),
    ("curving", "curving", None),
    ("volume", "volume_to_the_end", Some("until_volume")),
];

pub(crate) fn file() -> Text {
    let mut text = String::from(HEAD);
    let files = [
        ("Advance", "", coq::advance()),
        ("AdvanceBeyond", "_beyond", beyond::advance()),
    ];
    for (file, suffix, terms) in files {
        for of in ["a_vertex_and_a_face", "two_edges"] {
            let definitions = Definitions::of_module(&terms, of);
            writeln!(text, "Module {of}{suffix}.\nModule Terms := {file}.{of}.").expect("a string");
            for (name, mask, number) in PROOFS {
                definitions.program(name, mask, number, &mut text);
            }
            writeln!(
                text,
                "Definition all := Programs Terms.in_range held turning curving volume.\nEnd {of}{suffix}.\n"
            )
            .expect("a string");
        }
    }
    ("Programs.v".to_owned(), text)
}

/// The definitions of a module, by name, and the names in their order.
struct Definitions<'a> {
    terms: BTreeMap<&'a str, &'a str>,
    order: Vec<&'a str>,
}

impl<'a> Definitions<'a> {
    fn of_module(text: &'a str, name: &str) -> Self {
        let is_end = |line: &&str| *line != format!("End {name}.");
        let lines = text
            .lines()
            .skip_while(|line| *line != format!("Module {name}."))
            .take_while(is_end);
        let definition = |line: &'a str| {
            let (name, term) = line.strip_prefix("Definition ")?.strip_suffix('.')?.split_once(" := ")?;
            Some((name.split(' ').next()?, term))
        };
        let all: Vec<_> = lines.filter_map(definition).collect();
        Self {
            order: all.iter().map(|&(name, _)| name).collect(),
            terms: all.into_iter().collect(),
        }
    }

    /// Writes the program of a mask and a number, and the terms of its places.
    fn program(&self, name: &str, mask: &str, number: Option<&str>, text: &mut String) {
        let number = number.map_or("Input (Moment 1)", |number| self.terms[number]);
        let roots = [self.terms[mask], number];
        let mut pending: Vec<&str> = roots.to_vec();
        let mut used = BTreeMap::new();
        while let Some(term) = pending.pop() {
            for word in words(term) {
                if let Some(term) = self.terms.get(word)
                    && used.insert(word, 0).is_none()
                {
                    pending.push(term);
                }
            }
        }
        let steps: Vec<&str> = self.order.iter().copied().filter(|name| used.contains_key(name)).collect();
        for (place, step) in steps.iter().enumerate() {
            used.insert(step, place + 1);
        }
        let rewritten = |term: &str| with_places(term, &used);
        let lines: Vec<String> = steps.iter().map(|step| rewritten(self.terms[step])).collect();
        let [mask, number] = roots.map(rewritten);
        writeln!(
            text,
            "Definition {name} := Program [\n{}\n] ({mask}) ({number}).",
            lines.join(";\n")
        )
        .expect("a string");
        let terms: Vec<String> = steps.iter().map(|step| format!("Terms.{step}")).collect();
        writeln!(
            text,
            "Definition {name}_places := Eval cbv beta iota delta [in_places Pos.succ PositiveMap.add PositiveMap.empty] in\n  \
             in_places 1 [{}] (PositiveMap.empty _).",
            terms.join("; ")
        )
        .expect("a string");
    }
}

fn words(term: &str) -> impl Iterator<Item = &str> {
    term.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'))
        .filter(|word| !word.is_empty())
}

/// Returns a term with the places of steps in the place of their names.
fn with_places(term: &str, places: &BTreeMap<&str, usize>) -> String {
    let mut out = String::new();
    for part in term.split_inclusive([' ', '(', ')']) {
        let word = part.trim_end_matches([' ', '(', ')']);
        match places.get(word) {
            Some(place) => write!(out, "(at_ {place}){}", &part[word.len()..]).expect("a string"),
            None => out.push_str(part),
        }
    }
    out
}
