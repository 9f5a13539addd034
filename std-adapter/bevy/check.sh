#!/usr/bin/env bash
# Checks the plugin: formatting, lints, documentation, tests, without a window. Needs Rust 1.95 or newer, and crates.io.
# --present: skips the check where they are missing. example/ is built by hand. SELVEDGE_ENGINES names the physics engines to test
# with, by default "avian rapier".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# shellcheck source=std-adapter/checks.bash
source ../checks.bash

# This is the version in Cargo.toml.
least=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
rust=$(rustc --version | cut -d ' ' -f 2)
[ "$(printf '%s\n' "$least" "$rust" | sort -V | head -n 1)" = "$least" ] || missing "Rust $rust is too old: Bevy needs $least"
cargo fetch --locked </dev/null || missing "crates.io cannot be reached"

# A separate target folder, since workspace and features differ.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}/bevy

say "Bevy: formatting, lints, documentation"
cargo fmt --check
cargo fmt --check --manifest-path example/Cargo.toml
# Clippy serves as the compiler, so that Bevy's crates are built once for lints and tests.
export RUSTFLAGS="-D warnings"
test_with_clippy() { RUSTC_WORKSPACE_WRAPPER=clippy-driver cargo test --locked "$@"; }
# The engines depend on the whole of Bevy, which asks for a newer Rust than they need.
engines=(--ignore-rust-version --features "${SELVEDGE_ENGINES:-avian rapier}")
test_with_clippy "${engines[@]}" --all-targets --no-run
RUSTDOCFLAGS="-D warnings" cargo doc --locked --no-deps

say "Bevy: tests"
test_with_clippy "${engines[@]}"
say "Bevy: everything passed"
