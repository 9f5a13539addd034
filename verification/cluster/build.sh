#!/usr/bin/env bash
# Builds exact_campaign and merge into FOLDER, which all machines of a cluster see. The programs know the commit that
# they are built from, so `merge` can refuse shards of another commit.
#
#   verification/cluster/build.sh FOLDER
set -euo pipefail
if [ $# -ne 1 ]; then
    echo "usage: build.sh FOLDER" >&2
    exit 2
fi
mkdir -p "$1"
folder=$(realpath "$1")
cd "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/../.."
if [ -n "$(git status --porcelain --untracked-files=no)" ]; then
    echo "build.sh: commit your changes first" >&2
    exit 1
fi
SELVEDGE_COMMIT=$(git rev-parse HEAD)
export SELVEDGE_COMMIT
programs=(exact_campaign merge)
cargo build --release -p selvedge-verification "${programs[@]/#/--example=}"
for program in "${programs[@]}"; do
    # Replaces the file instead of overwriting it, since a campaign may be running.
    cp "${CARGO_TARGET_DIR:-target}/release/examples/$program" "$folder/$program.next"
    mv "$folder/$program.next" "$folder/$program"
done
echo "$SELVEDGE_COMMIT: $folder"
