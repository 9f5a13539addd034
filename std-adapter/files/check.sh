#!/usr/bin/env bash
# Reads every file of the zoo, and the files that this crate writes, with two other readers: triangles must be the same, to the last bit.
# Needs Python 3.10 or newer with venv, and a package index (PyPI). --present: skips the check where they are missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# shellcheck source=std-adapter/checks.bash
source ../checks.bash

python=${PYTHON:-python3}
command -v "$python" >/dev/null 2>&1 || missing "Python is missing; install it, 3.10 or newer"

environment=${CARGO_TARGET_DIR:-$PWD/../../target}/other-readers
if ! "$environment/bin/python" -c 'import trimesh, meshio' 2>/dev/null; then
    "$python" -m venv "$environment" || missing "Python's module venv is missing (Debian: apt install python3-venv)"
    "$environment/bin/pip" install --quiet --disable-pip-version-check "trimesh>=4,<6" "meshio>=5,<6" numpy ||
        missing "no package index can be reached"
fi

say "other readers: the zoo, and what is written of it"
cargo build --quiet --profile test --package selvedge-files --features gltf --example convert
"$environment/bin/python" other-readers.py "${CARGO_TARGET_DIR:-../../target}/debug/examples/convert"
