#!/usr/bin/env bash
# Builds the extension: one zip with the wheels inside, which Blender installs from disk.
#
#     ./build.sh                    with a wheel for this system, built now
#     ./build.sh WHEEL...           with these wheels, one for each platform
#
# The zip is std-adapter/blender/dist/selvedge_blender-VERSION.zip, or in the folder SELVEDGE_DIST.
set -euo pipefail
wheels=()
for wheel in "$@"; do
    wheels+=("$(realpath "$wheel")")
done
cd "$(dirname "${BASH_SOURCE[0]}")"
dist=${SELVEDGE_DIST:-$PWD/dist}

if [ ${#wheels[@]} = 0 ]; then
    command -v maturin >/dev/null || {
        echo "build.sh: give it a wheel, or install maturin (pip install maturin ziglang)" >&2
        exit 1
    }
    # With zig the wheel runs on any Linux since 2014; otherwise on systems as new as this one.
    old_linux=()
    if [ "$(uname)" = Linux ] && python3 -c 'import ziglang' 2>/dev/null; then
        old_linux=(--zig --compatibility manylinux_2_17)
    fi
    made=$(mktemp -d)
    (cd ../python && maturin build --release --locked "${old_linux[@]}" --out "$made" </dev/null)
    wheels=("$made"/*.whl)
fi

python3 - "$dist" "${wheels[@]}" <<'PACK'
import pathlib, re, sys, zipfile

dist, *wheels = map(pathlib.Path, sys.argv[1:])
platforms = {"linux-x64": "linux.*x86_64", "linux-arm64": "linux.*aarch64", "macos-x64": "macosx.*x86_64", "macos-arm64": "macosx.*arm64",
             "windows-x64": "win_amd64", "windows-arm64": "win_arm64"}
found = [name for name, tag in platforms.items() if any(re.search(tag, wheel.name) for wheel in wheels)]
if not found:
    sys.exit(f"build.sh: no wheel is for a platform of Blender: {', '.join(wheel.name for wheel in wheels)}")
listed = lambda entries: "[" + ", ".join(f'"{entry}"' for entry in entries) + "]"
source = pathlib.Path("selvedge_blender")
manifest = (source / "blender_manifest.toml").read_text()
manifest = manifest.replace("# build.sh writes the platforms and the wheels.\n", "")
manifest = manifest.replace("platforms = []", f"platforms = {listed(found)}")
manifest = manifest.replace("wheels = []", f"wheels = {listed('./wheels/' + wheel.name for wheel in wheels)}")
version = re.search(r'^version = "(.*)"', manifest, re.M)[1]
dist.mkdir(parents=True, exist_ok=True)
path = dist / f"selvedge_blender-{version}.zip"
with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
    archive.writestr("blender_manifest.toml", manifest)
    for file in sorted(source.glob("*.py")):
        archive.write(file, file.name)
    for licence in ("LICENSE-MIT", "LICENSE-APACHE"):
        archive.write(pathlib.Path("../..") / licence, licence)
    for wheel in wheels:
        archive.write(wheel, f"wheels/{wheel.name}")
print(f"{path}: {path.stat().st_size} bytes, for {', '.join(found)}")
PACK
