#!/usr/bin/env bash
# What effects cost, in instructions of a simulation's steps (valgrind).
#
#   run.sh                              all effects: that each costs nothing in a scene that does not name it, and what a step costs with it
#   run.sh --each                       the same, with a program for each effect instead of two for all: half an hour
#   run.sh SCENE.toml [BEFORE STEPS]    that the effects which this scene does not name cost it nothing: 20 steps after 10
#
# A scene's steps are counted in two programs, one with all effects and one from which effects that the scene does not name were left out
# when it was compiled. Both must end with the same positions, to the last bit, and take as many instructions. The scenes for all effects
# are parts of every-effect.toml, which has a table for each.
#
# Needs Rust and valgrind. The exit status is 1 if counts or positions differ.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(realpath -m "${CARGO_TARGET_DIR:-$here/../../../target}/instruction-counts")
every=$here/every-effect.toml
mkdir -p "$work"
export LC_ALL=C

give_up() {
    echo "run.sh: $*" >&2
    exit 1
}
command -v valgrind >/dev/null 2>&1 || give_up "valgrind is missing; install it (apt-get install valgrind) and start again"

# All effects, in the order in which they run.
registry() { sed -n '/= registry!\[/,/^\];/s/^ .*"\(.*\)"$/\1/p' "$here/../src/effects/mod.rs"; }

# The effects that a scene names.
named() { sed -n 's/^\[*effects\.\([a-z_]*\).*/\1/p' "$1" | sort -u; }

# All effects but these.
but() { registry | grep -vxF -e "$1"; }

# every-effect.toml with the tables of these effects alone: the path of such a scene.
scene_with() {
    cp "$here/ball.obj" "$work"
    awk -v wanted="$(tr '\n' ' ' <<<" $1 ")" '
        /^\[/ {
            split($0, words, /[][.]+/)
            keep = words[2] != "effects" || index(wanted, " " words[3] " ")
            begun = 1
        }
        keep || !begun' "$every" >"$work/$2.toml"
    echo "$work/$2.toml"
}

# Builds the program without these effects. What is compiled is selvedge-cloth and the program alone: the compiler's arguments for the rest
# stay as they are.
build() {
    cat >"$work/rustc" <<'END'
#!/bin/sh
case " $* " in
*" --crate-name selvedge_cloth "*) exec "$@" $LEFT_OUT ;;
esac
exec "$@"
END
    chmod +x "$work/rustc"
    local effect left_out="-Adead_code"
    for effect in $1; do
        left_out+=" --cfg without_effect=\"$effect\""
    done
    cd "$here"
    cargo clean --quiet --release --target-dir "$work/build" -p selvedge-cloth -p steps
    LEFT_OUT=$left_out RUSTC_WRAPPER=$work/rustc cargo build --quiet --release --target-dir "$work/build"
    cp "$work/build/release/steps" "$work/$2"
}

# What is not counted: how the clock subtracts two moments depends on the moments, and how the C library copies bytes on where they lie.
# (That more is copied would show where it is called.)
uncounted='std::time|Timespec|clock_gettime|vdso|:__mem(cpy|move|set|cmp)_'

# Instructions of each function that a program's last count has.
functions() {
    awk -v uncounted="$uncounted" '$1 ~ /^[0-9,]+$/ && /:/ && $0 !~ uncounted { sub(/^ +/, ""); sub(/ \[.*$/, ""); print }' "$work/$1.txt" | sort -k2
}

# Instructions of steps of a scene in a program.
count() {
    local program=$1 scene=$2 before=$3 steps=$4
    # Of one name, so that the stack begins where it does.
    cp "$work/$program" "$work/steps"
    env -i "$(command -v valgrind)" --tool=callgrind --callgrind-out-file="$work/$program.out" --collect-atstart=no \
        --toggle-collect='*counted_steps*' "$work/steps" "$scene" "$before" "$steps" 2>/dev/null >"$work/$program.positions"
    callgrind_annotate --auto=no --threshold=100 --show=Ir "$work/$program.out" >"$work/$program.txt" 2>/dev/null
    functions "$program" | awk '{ gsub(",", "", $1); sum += $1 } END { printf "%.0f\n", sum }'
}

# Whether a program without these effects does the same steps of a scene in as many instructions as one with all: says it, and if not where.
compare() {
    local scene=$1 before=$2 steps=$3 left_out=$4 all without
    build "$left_out" without
    all=$(count all "$scene" "$before" "$steps")
    without=$(count without "$scene" "$before" "$steps")
    printf '%s, %s steps\n  with all effects in the program: %s instructions\n  without %s: %s\n' \
        "$(basename "$scene")" "$steps" "$all" "${left_out//$'\n'/, }" "$without"
    cmp "$work/all.positions" "$work/without.positions" || return 1
    [ "$all" = "$without" ] && return
    echo "  functions that differ:"
    diff <(functions all) <(functions without) | grep '^[<>]' || true
    return 1
}

# A table of what a step costs with the first effect, with the first two, and so on.
costs() {
    local before=$1 steps=$2 vertices scene last=0 now names= effect
    vertices=$(grep -c '^v ' "$here/ball.obj")
    printf '| effect | instructions a step | and for each vertex |\n|---|---:|---:|\n'
    for effect in none $(registry); do
        names+=$effect$'\n'
        scene=$(scene_with "$names" costs)
        now=$(count all "$scene" "$before" "$steps")
        awk -v name="$effect" -v more=$(((now - last) / steps)) -v vertices="$vertices" \
            'BEGIN { printf "| `%s` | %d | %.0f |\n", name, more, more / vertices }'
        last=$now
    done
    awk -v all=$((now / steps)) -v vertices="$vertices" 'BEGIN { printf "| all | %d | %.0f |\n", all, all / vertices }'
}

build "" all
status=0
if [ $# -gt 0 ] && [ "$1" != --each ]; then
    scene=$(realpath "$1")
    compare "$scene" "${2:-10}" "${3:-20}" "$(but "$(named "$scene")")" || status=1
    exit $status
fi

missing=$(but "$(named "$every")" || true)
[ -z "$missing" ] || give_up "every-effect.toml has no table of ${missing//$'\n'/, }: give it one"
before=50 steps=50
# What acts from outside, and what cloth does by itself: what an effect needs is in the same half.
halves=("$(registry | sed '/^stretch$/,$d')" "$(registry | sed -n '/^stretch$/,$p')")
for half in 0 1; do
    left_out=${halves[1 - half]}
    scene=$(scene_with "${halves[half]}" "half-$((half + 1))")
    if [ "${1:-}" = --each ]; then
        for effect in $left_out; do
            compare "$scene" $before $steps "$effect" || status=1
        done
    else
        compare "$scene" $before $steps "$left_out" || status=1
    fi
done
costs $before $steps
exit $status
