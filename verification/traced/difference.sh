#!/usr/bin/env bash
# Shows how the kernels' computations differ from those at a commit (the last one by default), as a diff of the texts for Gappa
# and Coq. Changes nothing.
#
#   verification/traced/difference.sh [COMMIT]
set -euo pipefail
commit=${1:-HEAD}
cd "$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)"

folder=$(mktemp -d)
trap 'git worktree remove --force "$folder/sources" 2>/dev/null; rm -rf "$folder"' EXIT
git worktree add --quiet --detach "$folder/sources" "$commit"
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}

# The program fails if the texts are not the accepted ones, which does not matter here. Without texts something else is wrong.
texts() {
    local prover
    for prover in gappa coq; do
        mkdir -p "$2/$prover"
        (cd "$1" && cargo run --quiet --package selvedge-traced -- "$prover" "$2/$prover" 2>"$folder/says") ||
            [ -n "$(ls "$2/$prover")" ] || { cat "$folder/says" >&2 && exit 1; }
    done
}
texts "$folder/sources" "$folder/before"
texts "$PWD" "$folder/now"
cd "$folder"
# Coq checks programs and runs itself; nobody accepts them.
if diff --recursive --unified --exclude=Programs.v --exclude=Runs.v before now; then
    echo "the texts for Gappa and Coq have not changed"
fi
