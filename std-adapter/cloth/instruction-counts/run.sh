#!/usr/bin/env bash
# What an effect costs that a scene does not name: counts the instructions of its steps in two programs, one with all effects and
# one without those that the scene does not name. Both must end with the same positions, to the last bit.
#
#   run.sh [SCENE.toml [STEPS_BEFORE STEPS]]      scenes/hanging.toml, 20 steps after 10
#
# Needs Rust and valgrind. Both programs are built anew: some minutes. The exit status is 1 if the counts differ.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scene=$(realpath "${1:-$here/../scenes/hanging.toml}")
before=${2:-10}
steps=${3:-20}
cd "$here"

command -v valgrind >/dev/null 2>&1 || {
    echo "run.sh: valgrind is missing; install it (apt-get install valgrind) and start again" >&2
    exit 1
}
work=${CARGO_TARGET_DIR:-$PWD/../../../target}/instruction-counts
registry=$(sed -n '/= registry!\[/,/^\];/s/^ .*"\(.*\)"$/\1/p' ../src/effects/mod.rs)
named=$(sed -n 's/^\[*effects\.\([a-z_]*\).*/\1/p' "$scene")
flags="-Adead_code"
out=
for effect in $registry; do
    if ! grep -qx "$effect" <<<"$named"; then
        flags+=" --cfg without_effect=\"$effect\""
        out+=" $effect"
    fi
done
mkdir -p "$work"

build() {
    RUSTFLAGS="$1" cargo build --quiet --release --target-dir "$work/build"
}

# Instructions of the counted steps. Without those of the clock: how it subtracts two moments depends on the moments.
count() {
    local program=$work/steps
    cp "$work/build/release/steps" "$program"
    env -i "$(command -v valgrind)" --tool=callgrind --callgrind-out-file="$work/$1.out" --collect-atstart=no \
        --toggle-collect='*counted_steps*' "$program" "$scene" "$before" "$steps" 2>/dev/null >"$work/$1.positions"
    callgrind_annotate --auto=no --threshold=100 --show=Ir "$work/$1.out" >"$work/$1.txt" 2>/dev/null
    awk '$1 ~ /^[0-9,]+$/ && /:/ && !/std::time|Timespec|clock_gettime|vdso/ { gsub(",", "", $1); sum += $1 }
        END { printf "%.0f\n", sum }' "$work/$1.txt"
}

build ""
all=$(count all)
build "$flags"
without=$(count without)
cmp "$work/all.positions" "$work/without.positions"
printf '%s, %s steps\n  all effects compiled in:              %15s instructions\n  without%s:\n%39s %15s instructions\n' \
    "$(basename "$scene")" "$steps" "$all" "$out" "" "$without"
[ "$all" = "$without" ]
