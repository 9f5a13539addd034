#!/usr/bin/env bash
# Runs every test of the workspace: all crates, their documentation's examples, and the kept inputs of the fuzz targets. .ci/run has the
# proofs as well, and .ci/bindings what has a lock file of its own.
# Needs Rust (rustup) and a C compiler. `cargo run --release`, the main job, needs Rust alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

export CARGO_TERM_COLOR=never

say() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }
give_up() {
    printf 'test.sh: %s\n' "$*" >&2
    exit 1
}
is_there() { command -v "$1" >/dev/null 2>&1; }

# cargo asks rustc through it, and fails on text that it does not know if a program run by root put a file there.
if [ ! -c /dev/null ]; then
    [ "$(id -u)" -eq 0 ] && rm -f /dev/null && mknod -m 666 /dev/null c 1 3 ||
        give_up "/dev/null is a file, not the null device; put it back (rm /dev/null; mknod -m 666 /dev/null c 1 3)"
    # What cargo remembers of rustc may come from that text.
    rm -f "${CARGO_TARGET_DIR:-target}/.rustc_info.json"
fi
is_there cargo || give_up "Rust is missing; install it from https://rustup.rs and start again"
{ is_there cc || is_there gcc || is_there clang; } || give_up "a C compiler is missing, for what tests C's interface; install one and start again"

say "every crate: its own tests, exact oracle and properties, kept inputs of the fuzz targets"
# Examples and benchmarks are compiled by .ci/run's lints.
cargo test --workspace --tests
say "a program in development: every kernel and the whole detector without optimisation, in little stack"
cargo test --profile dev --package selvedge --test builds_without_optimisation
say "the documentation's examples"
cargo test --workspace --doc

say "all tests passed"
