#!/usr/bin/env bash
# Builds the wheel and checks it in a new virtual environment: tests, types, stubs, the README's example, the wheel's size.
# Needs Python 3.10 or newer with venv, and a package index (PyPI). --present: skips the check where they are missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# shellcheck source=std-adapter/checks.bash
source ../checks.bash

python=${PYTHON:-python3}
command -v "$python" >/dev/null 2>&1 || missing "Python is missing; install it, 3.10 or newer"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' || missing "Python is too old: 3.10 or newer is needed"

# The command, which the laboratory's functions run: the one that the tests built, or a new build.
if [ -z "${SELVEDGE_COMMAND:-}" ]; then
    cargo build --release --package selvedge-command --manifest-path ../../Cargo.toml
    SELVEDGE_COMMAND=${CARGO_TARGET_DIR:-$PWD/../../target}/release/selvedge
fi
export SELVEDGE_COMMAND

# A separate target folder, since workspace and profile differ.
target=${CARGO_TARGET_DIR:-$PWD/target}/python
export CARGO_TARGET_DIR=$target
mkdir -p "$target"
tools=$target/tools
environment=$target/environment
wheels=$target/wheels

# The environment is created again if a package is missing, as after a change of this list.
if ! "$tools/bin/python" -c 'import maturin, pytest, mypy, numpy, matplotlib' 2>/dev/null; then
    "$python" -m venv "$tools" || missing "Python's module venv is missing (Debian: apt install python3-venv)"
    "$tools/bin/pip" install --quiet --disable-pip-version-check "maturin>=1.16,<2" "pytest>=9,<10" "mypy>=2.4,<2.5" numpy matplotlib ||
        missing "no package index can be reached"
    # Not every Python has it; without it the tests of selvedge.usd are skipped.
    "$tools/bin/pip" install --quiet --disable-pip-version-check usd-core || echo "check.sh: usd-core is missing"
fi

say "Python: the wheel"
rm -rf "$wheels"
"$tools/bin/maturin" build --release --locked --compression-level 9 --interpreter "$tools/bin/python" --out "$wheels" </dev/null
size=$(stat -c %s "$wheels"/*.whl 2>/dev/null || stat -f %z "$wheels"/*.whl)
echo "$(basename "$wheels"/*.whl): $size bytes"
# A larger wheel needs a reason.
[ "$size" -le 1900000 ] || {
    echo "check.sh: the wheel is larger than 1.9 MB" >&2
    exit 1
}

say "Python: installed into an empty environment, the examples of the pages"
rm -rf "$environment"
"$python" -m venv "$environment"
"$environment/bin/pip" install --quiet --disable-pip-version-check "$wheels"/*.whl
for page in README.md ../../README.md ../../docs/tutorials/python.md ../../docs/guard.md; do
    sed -n '/^```python/,/^```/p' "$page" | sed '/^```/d' >"$target/page.py"
    (cd "$target" && environment/bin/python page.py)
done

say "Python: tests, types, stubs"
"$tools/bin/pip" install --quiet --disable-pip-version-check --force-reinstall --no-deps "$wheels"/*.whl
"$tools/bin/python" -m pytest -q --no-header -p no:cacheprovider
"$tools/bin/python" -m mypy --strict --cache-dir "$target/mypy" python/selvedge
configuration=$PWD/pyproject.toml
(cd "$target" && "$tools/bin/python" -m mypy.stubtest selvedge --concise --mypy-config-file "$configuration")
say "Python: everything passed"
