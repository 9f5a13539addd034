#!/usr/bin/env bash
# Counts the instructions of the certified filter: the same on every run, unlike wall-clock time.
# Needs Rust and valgrind; installs gungraun's runner into the build folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

command -v valgrind >/dev/null 2>&1 || {
    echo "run.sh: valgrind is missing; install it (apt-get install valgrind) and start again" >&2
    exit 1
}
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$PWD/target}"
# The runner's version must be the library's.
version=$(sed -n 's/^gungraun = "=\(.*\)"$/\1/p' Cargo.toml)
root="$CARGO_TARGET_DIR/gungraun-$version"
[ -x "$root/bin/gungraun-runner" ] ||
    cargo install --quiet --root "$root" --version "$version" gungraun-runner
GUNGRAUN_RUNNER="$root/bin/gungraun-runner" cargo bench "$@"
