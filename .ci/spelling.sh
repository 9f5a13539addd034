#!/usr/bin/env bash
# Checks the spelling by typos (https://github.com/crate-ci/typos); .typos.toml has our words. Without the program, its package
# for Python is installed into the target folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=1.52.0

if command -v typos >/dev/null; then
    exec typos
fi
command -v python3 >/dev/null || {
    echo "spelling: skipped, since neither typos nor python3 is there"
    exit 0
}
environment=${CARGO_TARGET_DIR:-target}/typos-$version
if [ ! -x "$environment/bin/typos" ]; then
    rm -rf "$environment"
    python3 -m venv "$environment"
    "$environment/bin/pip" install --quiet --disable-pip-version-check "typos==$version"
fi
"$environment/bin/typos"
