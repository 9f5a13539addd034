#!/usr/bin/env bash
# Runs fuzz targets one after the other, each for some minutes. Shows progress, and a table at the end.
#
#   fuzz/campaign.sh [MINUTES] [TARGET...]      every target for 30 minutes by default
#
# Needs a nightly compiler; installs cargo-fuzz if it is missing. Interesting inputs are kept in $FUZZ_WORK (fuzz/campaign), and
# the next campaign continues from them, so it may be stopped at any time. Inputs that break a promise go to
# $FUZZ_WORK/TARGET.broken; then the exit status is 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

minutes=${1:-30}
case $minutes in
'' | *[!0-9]*)
    echo "usage: campaign.sh [MINUTES] [TARGET...]" >&2
    exit 2
    ;;
esac
shift || true
work=${FUZZ_WORK:-$PWD/campaign}
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
    for program in fuzz_targets/*.rs; do
        targets+=("$(basename "$program" .rs)")
    done
fi

command -v cargo-fuzz >/dev/null || cargo install cargo-fuzz --locked
mkdir -p "$work"
# Without the address sanitizer targets run up to fifteen times as fast. They have no unsafe code.
cargo +nightly fuzz build -s none
# Copies, so that a campaign is not disturbed by changes of its sources.
host=$(rustc +nightly -vV | sed -n 's/^host: //p')
mkdir -p "$work/programs"
for target in "${targets[@]}"; do
    cp "${CARGO_TARGET_DIR:-../target}/$host/release/$target" "$work/programs/"
done

options() {
    case $1 in
    obj | ply) echo "-max_len=2048 -dict=dictionaries/$1.dict -malloc_limit_mb=256" ;;
    stl | off | gltf) echo "-max_len=2048 -malloc_limit_mb=256" ;;
    scene) echo "-max_len=4096 -dict=dictionaries/$1.dict -malloc_limit_mb=1024" ;;
    *) echo "-max_len=700 -len_control=0" ;;
    esac
}
statistic() { sed -n "s/^stat::$1: *//p" "$2" | tail -n 1; }

table=$(printf '%-18s %8s %14s %10s %8s %s\n' target minutes executions 'a second' kept found)
broken=0
for target in "${targets[@]}"; do
    log=$work/$target.log
    mkdir -p "$work/$target" "$work/$target.broken"
    kept=("$work/$target" "corpus/$target")
    mkdir -p "corpus/$target"
    [ ! -d "regressions/$target" ] || kept+=("regressions/$target")
    # Files of other kinds in the zoo do no harm.
    case $target in obj | ply | stl | off | gltf) kept+=(../std-adapter/files/tests/zoo) ;; esac
    # shellcheck disable=SC2046 # words on purpose
    "$work/programs/$target" "${kept[@]}" $(options "$target") -max_total_time=$((60 * minutes)) \
        -print_final_stats=1 -timeout=60 -artifact_prefix="$work/$target.broken/" >"$log" 2>&1 &
    run=$!
    begin=$SECONDS
    while kill -0 "$run" 2>/dev/null; do
        sleep 2
        if [ -t 2 ]; then
            last=$(grep -a '^#[0-9]' "$log" | tail -n 1 | sed 's/[\t ][\t ]*/ /g' | cut -c 1-60)
            printf '\r\033[K%s: %d of %d s  %s' "$target" $((SECONDS - begin)) $((60 * minutes)) "$last" >&2
        fi
    done
    [ ! -t 2 ] || printf '\r\033[K' >&2
    found=none
    if ! wait "$run"; then
        broken=1
        found="$work/$target.broken"
    fi
    row=$(printf '%-18s %8s %14s %10s %8s %s\n' "$target" $(((SECONDS - begin + 30) / 60)) \
        "$(statistic number_of_executed_units "$log")" "$(statistic average_exec_per_sec "$log")" \
        "$(find "$work/$target" -type f | wc -l)" "$found")
    echo "$row" >&2
    table+=$'\n'$row
done
echo "$table"
exit $broken
