#!/usr/bin/env bash
# How what the kernels compute differs from what they computed at a commit (the last one, if none is named): as a diff of what Gappa
# and Coq read. Nothing is changed here.
#
#   verification/traced/difference.sh [COMMIT]
set -euo pipefail
commit=${1:-HEAD}
cd "$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)"

folder=$(mktemp -d)
trap 'git worktree remove --force "$folder/sources" 2>/dev/null; rm -rf "$folder"' EXIT
git worktree add --quiet --detach "$folder/sources" "$commit"
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}

# The program fails where the texts are not accepted ones, which is no news here; without texts something else is wrong.
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
if diff --recursive --unified before now; then
    echo "nothing that Gappa or Coq reads has changed"
fi
