#!/usr/bin/env bash
# Runs every test of the workspace: all crates, their documentation's examples, and the kept inputs of the fuzz targets. .ci/run has the
# proofs as well, and .ci/bindings what has a lock file of its own.
# Needs Rust (rustup), a C compiler and make. `cargo run --release`, the main job, needs Rust alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

export CARGO_TERM_COLOR=never

say() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }
give_up() {
    printf 'test.sh: %s\n' "$*" >&2
    exit 1
}
is_there() { command -v "$1" >/dev/null 2>&1; }

# GMP, on which the exact oracle counts, is built from source, and its build needs m4.
install_m4() {
    local manager command
    for manager in apt-get dnf pacman apk zypper brew; do
        is_there "$manager" || continue
        case $manager in
        apt-get) command="apt-get install -y m4" ;;
        dnf) command="dnf install -y m4" ;;
        pacman) command="pacman -S --noconfirm m4" ;;
        apk) command="apk add m4" ;;
        zypper) command="zypper --non-interactive install m4" ;;
        brew) command="brew install m4" ;;
        esac
        if [ "$manager" != brew ] && [ "$(id -u)" -ne 0 ]; then
            { is_there sudo && sudo -n true 2>/dev/null; } ||
                give_up "m4 is missing; install it (sudo $command) and start again"
            command="sudo -n $command"
        fi
        say "m4 is missing: $command"
        # shellcheck disable=SC2086 # words on purpose
        if ! $command </dev/null; then
            # A fresh machine has no package lists yet.
            if [ "$manager" = apt-get ]; then
                ${command%install*} update </dev/null && $command </dev/null ||
                    give_up "m4 could not be installed; install it and start again"
            else
                give_up "m4 could not be installed; install it and start again"
            fi
        fi
        # Homebrew keeps it out of the way of the system's own.
        [ "$manager" != brew ] || PATH="$(brew --prefix m4)/bin:$PATH"
        return
    done
    give_up "m4 is missing, and there is no package manager that we know; install it and start again"
}

# cargo asks rustc through it, and fails on text that it does not know if a program run by root put a file there.
if [ ! -c /dev/null ]; then
    [ "$(id -u)" -eq 0 ] && rm -f /dev/null && mknod -m 666 /dev/null c 1 3 ||
        give_up "/dev/null is a file, not the null device; put it back (rm /dev/null; mknod -m 666 /dev/null c 1 3)"
    # What cargo remembers of rustc may come from that text.
    rm -f "${CARGO_TARGET_DIR:-target}/.rustc_info.json"
fi
is_there cargo || give_up "Rust is missing; install it from https://rustup.rs and start again"
{ is_there cc || is_there gcc || is_there clang; } || give_up "a C compiler is missing; install one and start again"
is_there make || give_up "make is missing; install it and start again"
is_there m4 || install_m4

say "every crate: its own tests, exact oracle and properties, kept inputs of the fuzz targets"
# Examples and benchmarks are compiled by .ci/run's lints.
cargo test --workspace --tests
say "a program in development: every kernel and the whole detector without optimisation, in little stack"
cargo test --profile dev --package selvedge --test builds_without_optimisation
say "the documentation's examples"
cargo test --workspace --doc

say "all tests passed"
