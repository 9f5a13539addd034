#!/usr/bin/env bash
# selvedge-core links into a program without std, and the optimised program has no panic in it. No floating-point operation of the
# core, or of its code in the program, computes with an undefined value.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

target="${CARGO_TARGET_DIR:-$PWD/../../target}/no-std-check"
RUSTFLAGS="${RUSTFLAGS:-} --emit=llvm-ir" cargo build --release --target-dir "$target"
program="$target/release/no-std-check"
# The linker drops every function that the program cannot reach, so panic machinery remains only if a panic is possible.
cc main.c "$target/release/libno_std_check.a" -Wl,--gc-sections -o "$program"
"$program" || { echo "no-std-check: the program returned $?; main.c lists the expected results" >&2; exit 1; }

symbols="$(nm --defined-only "$program")"
grep -q ' T verdicts_f64$' <<<"$symbols" || { echo "no-std-check: nm lists no symbols" >&2; exit 1; }
if panics="$(grep -iE 'panic|rust_begin_unwind|_fail(_|$)|3std' <<<"$symbols")"; then
    printf 'no-std-check: the core can panic, or uses std:\n%s\n' "$panics" >&2
    exit 1
fi
echo "no-std-check: no std, no panic"

# Older builds may have left other files.
newest() { ls -t "$target/release/deps/$1"-*.ll | head -n 1; }
if ./undefined_inputs.py doubled.ll >/dev/null 2>&1; then
    echo "no-std-check: undefined_inputs.py finds nothing in doubled.ll, which multiplies an undefined number" >&2
    exit 1
fi
./undefined_inputs.py "$(newest selvedge_core)" "$(newest no_std_check)"
