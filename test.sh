#!/usr/bin/env bash
# Runs every test of the workspace: all crates, their documentation's examples, and the kept inputs of the fuzz targets. .ci/run
# adds lints, proofs and bindings.
# Needs Rust (rustup) and a C compiler; installs make and m4 if they are missing. `cargo run --release`, the main job, needs Rust
# alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

export CARGO_TERM_COLOR=never

say() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }
give_up() {
    printf 'test.sh: %s\n' "$*" >&2
    exit 1
}
is_there() { command -v "$1" >/dev/null 2>&1; }

# Installs a program with the machine's package manager, or says in one line how.
get() {
    local install as_root=""
    [ "$(id -u)" -eq 0 ] || as_root="sudo -n "
    for install in "apt-get install -y" "dnf install -y" "pacman -S --noconfirm" "apk add" "zypper --non-interactive install"; do
        is_there "${install%% *}" || continue
        install="$as_root$install $1"
        say "$1 is missing: $install"
        # A fresh machine has no package lists: apt-get gets them first.
        $install </dev/null || { ${as_root}apt-get update </dev/null && $install </dev/null; } || give_up "$1 is missing; run: $install"
        return
    done
    give_up "$1 is missing; install it and start again"
}

# Cargo queries rustc through /dev/null, and fails if a program run by root has put a file there.
if [ ! -c /dev/null ]; then
    [ "$(id -u)" -eq 0 ] && rm -f /dev/null && mknod -m 666 /dev/null c 1 3 ||
        give_up "/dev/null is a file, not the null device; put it back (rm /dev/null; mknod -m 666 /dev/null c 1 3)"
    # Cargo's cached answers of rustc may come from that file.
    rm -f "${CARGO_TARGET_DIR:-target}/.rustc_info.json"
fi
is_there cargo || give_up "Rust is missing; install it from https://rustup.rs and start again"
{ is_there cc || is_there gcc || is_there clang; } || give_up "a C compiler is missing; install one and start again"
# rug builds GMP, the exact arithmetic of the oracle, from source.
for program in make m4; do
    is_there "$program" || get "$program"
done

say "every crate: its own tests, exact oracle and properties, kept inputs of the fuzz targets"
# Examples and benchmarks are compiled by .ci/run's lints.
cargo test --workspace --tests
say "the whole detector without optimisation, on a small stack"
cargo test --profile dev --package selvedge --test builds_without_optimisation
say "the documentation's examples"
cargo test --workspace --doc

say "all tests passed"
