#!/usr/bin/env bash
# Checks the extension in Blender without a window: bpy from PyPI (373 MB, 1 GB installed), one process a scene, at most five
# minutes. Needs Python 3.11 with venv, and a package index (PyPI). --present: skips the check where they are missing.
# WHEEL is the package's wheel; without it, ../python/check.sh has built one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# shellcheck source=std-adapter/checks.bash
source ../checks.bash

python=${PYTHON:-python3.11}
command -v "$python" >/dev/null 2>&1 || python=python3
command -v "$python" >/dev/null 2>&1 || missing "Python is missing; install Python 3.11"
# The wheels of bpy 4.2 to 5.0 are for one version of Python.
"$python" -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || missing "bpy needs Python 3.11"

target=${CARGO_TARGET_DIR:-$PWD/target}/blender
wheel=${WHEEL:-}
if [ -z "$wheel" ]; then
    for built in "${CARGO_TARGET_DIR:-$PWD/../python/target}"/python/wheels/*.whl; do
        wheel=$built
    done
fi
[ -f "$wheel" ] || missing "there is no wheel of the Python package: run std-adapter/python/check.sh first"
mkdir -p "$target"

# Creates an environment with a version of bpy, unless it is there.
environment() { # NAME BPY
    if ! "$target/$1/bin/python" -c 'import importlib.util, sys; sys.exit(importlib.util.find_spec("bpy") is None)' 2>/dev/null; then
        "$python" -m venv "$target/$1" || missing "Python's module venv is missing (Debian: apt install python3-venv)"
        "$target/$1/bin/pip" install --quiet --disable-pip-version-check "$2" numpy || missing "no package index can be reached"
    fi
}

say "Blender: the extension"
SELVEDGE_DIST=$target ./build.sh "$wheel"
archive=$(ls "$target"/selvedge_blender-*.zip)

say "Blender: scenes"
environment scenes "bpy==4.5.*"
"$target/scenes/bin/pip" install --quiet --disable-pip-version-check --force-reinstall --no-deps "$wheel"
"$target/scenes/bin/python" tests/run.py

say "Blender: the zip installs into an empty user folder"
"$target/scenes/bin/pip" uninstall --quiet --yes selvedge
timeout 120 "$target/scenes/bin/python" tests/install.py "$archive"
# SELVEDGE_BPY=5.0 also tries the newest Blender for this Python: another 400 MB.
if [ -n "${SELVEDGE_BPY:-}" ]; then
    environment "newest" "bpy==$SELVEDGE_BPY.*"
    timeout 120 "$target/newest/bin/python" tests/install.py "$archive"
fi
say "Blender: everything passed"
