#!/usr/bin/env bash
# Mutations of core's decisions that no test notices: README.md here. Installs cargo-mutants and, in a folder of its own, what the
# scripts need.
#
#   verification/mutants/run.sh FOLDER [--shard I/N] [--longest SECONDS] [--cases N] [--report]
set -euo pipefail
if [ $# -eq 0 ]; then
    echo "usage: run.sh FOLDER [--shard I/N] [--longest SECONDS] [--cases N] [--report]" >&2
    exit 2
fi
folder=$(realpath -m "$1")
shift
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
command -v cargo-mutants >/dev/null || cargo install cargo-mutants --locked
if [ ! -x "$folder/python/bin/python" ]; then
    python3 -m venv "$folder/python"
    "$folder/python/bin/pip" install --quiet tree_sitter==0.26.1 tree_sitter_rust==0.24.2 tqdm
fi
exec "$folder/python/bin/python" "$here/hunt.py" "$folder" "$@"
