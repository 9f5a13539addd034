#!/usr/bin/env bash
# Runs fuzz targets one after the other, each for some minutes. Shows progress, and a table at the end.
#
#   fuzz/campaign.sh [MINUTES] [TARGET...]                  every target for 30 minutes by default
#   fuzz/campaign.sh --background HOURS [TARGET...]         so many hours in all, in the background of a working day
#   fuzz/campaign.sh --record                               writes the totals of the record into README.md
#
# In the background all targets take turns of five minutes, at the lowest priority, so that each gets its share whenever it is
# stopped: kill the number that it prints. Each turn that ends adds a line to record.csv (date, target, executions, seconds of
# processor time, findings).
#
# The target `npm` calls the npm package with any values (std-adapter/web/tests/border.mjs). It takes part where Node and the
# package are there: std-adapter/web/build.sh writes it to target/web.
#
# Needs a nightly compiler; installs cargo-fuzz if it is missing. Interesting inputs are kept in $FUZZ_WORK (fuzz/campaign), and
# the next campaign continues from them, so it may be stopped at any time. Inputs that break a promise go to
# $FUZZ_WORK/TARGET.broken; then the exit status is 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
    echo "usage: campaign.sh [MINUTES] [TARGET...], campaign.sh --background HOURS [TARGET...], or campaign.sh --record" >&2
    exit 2
}

work=${FUZZ_WORK:-$PWD/campaign}
record=${FUZZ_RECORD:-$PWD/record.csv}

# Writes the totals of the record between two marks of README.md.
show_record() {
    local readme=${FUZZ_README:-$PWD/README.md} table
    table=$(awk -F, '
        NR > 1 && NF == 5 { runs[$2] += $3; seconds[$2] += $4; found[$2] += $5; if ($1 > last[$2]) last[$2] = $1 }
        END {
            for (target in runs)
                printf "| `%s` | %s | %.2f | %d | %s |\n", target, runs[target], seconds[target] / 3600, found[target], last[target]
        }' "$record" | sort)
    awk -v table="$table" '
        /<!-- end of the record -->/ { inside = 0 }
        !inside { print }
        /<!-- record -->/ {
            inside = 1
            print "| target | executions | hours of processor time | findings | last run |\n|---|---|---|---|---|"
            if (table != "") print table
        }' "$readme" >"$readme.new"
    # The file keeps its permissions.
    cat "$readme.new" >"$readme" && rm "$readme.new"
}

case ${1:-30} in
--record)
    show_record
    exit
    ;;
--background)
    hours=${2:-}
    case $hours in '' | 0 | *[!0-9]*) usage ;; esac
    shift 2
    mkdir -p "$work"
    FUZZ_HOURS=$hours nohup nice -n 19 "$PWD/campaign.sh" 5 "$@" >"$work/background.log" 2>&1 &
    echo "$! runs for $hours h: see $work/background.log; kill $! stops it"
    exit
    ;;
*[!0-9]*) usage ;;
*) minutes=${1:-30} ;;
esac
shift || true
targets=("$@")
package=${CARGO_TARGET_DIR:-$PWD/../target}/web/package
if [ ${#targets[@]} -eq 0 ]; then
    for program in fuzz_targets/*.rs; do
        targets+=("$(basename "$program" .rs)")
    done
    if command -v node >/dev/null && [ -d "$package" ]; then targets+=(npm); fi
fi

mkdir -p "$work/programs"
if [ "${targets[*]}" != npm ]; then
    command -v cargo-fuzz >/dev/null || cargo install cargo-fuzz --locked
    # Without the address sanitizer targets run up to fifteen times as fast. All but c_interface have no unsafe code.
    cargo +nightly fuzz build -s none
fi
# Copies, so that a campaign is not disturbed by changes of its sources.
for target in "${targets[@]}"; do
    if [ "$target" = npm ]; then
        # The program finds its scene beside it, as in std-adapter.
        mkdir -p "$work/programs"/{web/tests,c/tests/messages}
        cp -r "$package" "$work/programs/"
        cp ../std-adapter/web/tests/border.mjs "$work/programs/web/tests/"
        cp ../std-adapter/c/tests/messages/scene.toml "$work/programs/c/tests/messages/"
    else
        host=${host:-$(rustc +nightly -vV | sed -n 's/^host: //p')}
        cp "${CARGO_TARGET_DIR:-../target}/$host/release/$target" "$work/programs/"
    fi
done

# Runs a target for some seconds. Findings are files: an input, or what the package said.
run_target() { # TARGET SECONDS INPUTS...
    local target=$1 seconds=$2 said status=0
    shift 2
    if [ "$target" = npm ]; then
        said=$(mktemp)
        node "$work/programs/web/tests/border.mjs" "$work/programs/package" "$seconds" 2>"$said" || status=$?
        cat "$said"
        [ "$status" = 0 ] || cp "$said" "$work/npm.broken/$(date +%s)"
        rm "$said"
        return "$status"
    fi
    # shellcheck disable=SC2046 # words on purpose
    "$work/programs/$target" "$@" $(options "$target") -max_total_time="$seconds" \
        -print_final_stats=1 -timeout=60 -artifact_prefix="$work/$target.broken/"
}

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
# In the background, as many turns as the hours have.
[ -z "${FUZZ_HOURS:-}" ] || turns=$(((60 * FUZZ_HOURS + minutes - 1) / minutes))
[ -n "${FUZZ_HOURS:-}" ] || turns=${#targets[@]}
# A campaign that is stopped leaves no program behind: each turn is a group of processes of its own.
set -m
run=
trap '[ -z "$run" ] || kill -- "-$run" 2>/dev/null || true' EXIT
trap 'exit 143' INT TERM
[ -e "$record" ] || echo "date,target,executions,seconds of processor time,findings" >"$record"
for ((turn = 0; turn < turns; turn++)); do
    target=${targets[turn % ${#targets[@]}]}
    log=$work/$target.log
    mkdir -p "$work/$target" "$work/$target.broken"
    kept=("$work/$target")
    [ ! -d "corpus/$target" ] || kept+=("corpus/$target")
    [ ! -d "regressions/$target" ] || kept+=("regressions/$target")
    # Files of other kinds in the zoo do no harm.
    case $target in obj | ply | stl | off | gltf) kept+=(../std-adapter/files/tests/zoo) ;; esac
    before=$(find "$work/$target.broken" -type f | wc -l)
    {
        TIMEFORMAT='%U %S'
        time run_target "$target" $((60 * minutes)) "${kept[@]}" >"$log" 2>&1
    } 2>"$work/$target.time" &
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
    run=
    row=$(printf '%-18s %8s %14s %10s %8s %s\n' "$target" $(((SECONDS - begin + 30) / 60)) \
        "$(statistic number_of_executed_units "$log")" "$(statistic average_exec_per_sec "$log")" \
        "$(find "$work/$target" -type f | wc -l)" "$found")
    echo "$row" >&2
    findings=$(($(find "$work/$target.broken" -type f | wc -l) - before))
    executions=$(statistic number_of_executed_units "$log")
    printf '%s,%s,%s,%s,%s\n' "$(date +%F)" "$target" "${executions:-0}" \
        "$(awk '{ seconds = $1 + $2 } END { printf "%.0f", seconds }' "$work/$target.time")" "$findings" >>"$record"
    show_record
    table+=$'\n'$row
done
echo "$table"
exit $broken
