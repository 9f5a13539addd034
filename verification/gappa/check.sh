#!/usr/bin/env bash
# Checks every proof of core's rounding constants, for f32 and f64: Gappa finds the proofs, and Coq checks them.
#
#   check.sh            installs the tools where they are missing (Debian's gappa, coq, libcoq-gappa, libcoq-flocq)
#   check.sh --gappa    without Coq
#   check.sh --install  only installs the tools
#
# Also halves each constant that is marked `#!`, one at a time: then Gappa must fail.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

coq=true
check=true
for option in "$@"; do
    case $option in
    --gappa) coq=false ;;
    --install) check=false ;;
    *)
        echo "usage: check.sh [--gappa] [--install]" >&2
        exit 2
        ;;
    esac
done

is_there() { command -v "$1" >/dev/null 2>&1; }
as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi
}
library() { [ -e "$(coqc -where 2>/dev/null)/user-contrib/Gappa/Gappa_library.vo" ]; }
install() {
    is_there apt-get || {
        echo "gappa: $1 is missing, and this script knows only Debian's packages; see https://gappa.gitlabpages.inria.fr" >&2
        exit 1
    }
    as_root apt-get install -y --no-install-recommends "${@:2}" </dev/null >/dev/null ||
        { as_root apt-get update >/dev/null && as_root apt-get install -y --no-install-recommends "${@:2}" </dev/null >/dev/null; }
}

is_there gappa || install gappa gappa
if $coq && ! { is_there coqc && library; }; then
    install "coq with Gappa's library" coq libcoq-gappa libcoq-flocq
fi

$check || exit 0

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
proven=0
halved=0
checked=0

# The kernels' computations, step by step, written from the kernels. Changes that are not accepted are refused.
mkdir "$folder/traced"
cargo run --quiet --manifest-path ../Cargo.toml --package selvedge-traced -- gappa "$folder/traced"

gappa_says() { gappa -Wno-hint-difference "$1" >"$folder/says" 2>&1; }

for format in f32 f64; do
    for script in *.g "$folder"/traced/*.g; do
        name=$(basename "$script" .g)
        of_format=$folder/$name-$format.g
        sed -f "formats/$format.sed" "$script" >"$of_format"
        if grep -v '^#' "$of_format" | grep -q '@'; then
            echo "gappa: $script has a constant that formats/$format.sed does not know" >&2
            exit 1
        fi
        if ! gappa_says "$of_format"; then
            echo "gappa: NOT PROVEN: $script for $format" >&2
            grep -v Warning "$folder/says" >&2
            exit 1
        fi
        proven=$((proven + 1))
        # Half of each marked constant must not suffice.
        for line in $(grep -n '^[a-z_]* = [0-9]*; *#!' "$of_format" | cut -d: -f1); do
            sed -E "${line}s/= ([0-9]+);/= \1 * 0.5;/" "$of_format" >"$folder/halved.g"
            if gappa_says "$folder/halved.g"; then
                echo "gappa: half of a constant suffices, so the mark #! is wrong: $script: $(sed -n "${line}p" "$script")" >&2
                exit 1
            fi
            halved=$((halved + 1))
        done
        if $coq; then
            # Coq's names have no hyphens, and do not begin with a digit.
            source=$folder/proof_${name//-/_}_$format.v
            gappa -Wno-hint-difference -Bcoq "$of_format" >"$source" 2>/dev/null
            if grep -q '^Hypothesis\|^Axiom\|^Parameter' "$source"; then
                echo "gappa: the proof of $script has an axiom" >&2
                exit 1
            fi
            checked=$((checked + 1))
        fi
    done
done
# The longest part, on all cores.
accept() {
    coqc -q "$1" >/dev/null || {
        echo "gappa: Coq does not accept the proof $1" >&2
        return 1
    }
}
export -f accept
if $coq; then
    (cd "$folder" && printf '%s\0' proof_*.v | xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" bash -c 'accept "$0"')
fi
echo "gappa: $proven proofs found, $halved halved constants refused, $checked proofs accepted by Coq"
