#!/usr/bin/env bash
# Reads every file of the zoo with trimesh and meshio, and with them and Blender what this crate and the command write: the same
# triangles, to the last bit that the reader holds. The Khronos validator looks at a written glTF file.
# Needs Python 3.10 or newer with venv, and a package index (PyPI). --present: skips the check where they are missing. Blender
# (bpy) exists for Python 3.11, the validator needs npm; without them, their parts are skipped.
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

if ! "$environment/bin/python" -c 'import bpy' 2>/dev/null; then
    "$environment/bin/pip" install --quiet --disable-pip-version-check "bpy>=4.2,<5" || echo "Blender is skipped: no bpy for this Python"
fi

say "other readers: the zoo, and what is written"
cargo build --quiet --profile test --package selvedge-files --features gltf --example convert
[ -n "${SELVEDGE_COMMAND:-}" ] || cargo build --quiet --profile test --package selvedge-command
target=$(cd "${CARGO_TARGET_DIR:-../../target}" && pwd)
"$environment/bin/python" other-readers.py "$target/debug/examples/convert" "${SELVEDGE_COMMAND:-$target/debug/selvedge}" "$environment/scene.glb"

if command -v npm >/dev/null 2>&1 && npm install --silent --no-save --prefix "$environment/npm" "gltf-validator@2.0.0-dev.3.10" >/dev/null 2>&1; then
    say "glTF: the Khronos validator"
    NODE_PATH=$environment/npm/node_modules node -e '
        const { validateBytes } = require("gltf-validator");
        validateBytes(new Uint8Array(require("fs").readFileSync(process.argv[1]))).then(({ issues }) => {
            console.log(`${issues.numErrors} errors, ${issues.numWarnings} warnings`);
            issues.messages.forEach(({ code, message, pointer }) => console.log(code, pointer, message));
            process.exit(issues.numErrors + issues.numWarnings ? 1 : 0);
        });' "$environment/scene.glb"
else
    say "skipped: the glTF validator, since npm or its registry is missing"
fi
