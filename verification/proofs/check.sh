#!/usr/bin/env bash
# Checks the proofs in this folder with Coq, and that their only axioms are those of the real numbers. Then extracts the checker
# of witnesses, and tests it.
#
#   check.sh [PROGRAM]    leaves the extracted checker there
#
# Installs what is missing (Debian's coq, libcoq-flocq, libzarith-ocaml-dev).
set -euo pipefail
program=${1:+$(realpath "$1")}
cd "$(dirname "${BASH_SOURCE[0]}")"

is_there() {
    command -v coqc ocamlfind >/dev/null 2>&1 && [ -e "$(coqc -where)/user-contrib/Flocq/Core/Core.vo" ] &&
        [ -e "$(ocamlfind query zarith 2>/dev/null)/zarith.cmxa" ]
}
as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi
}
install() { as_root apt-get install -y --no-install-recommends coq libcoq-flocq libzarith-ocaml-dev </dev/null >/dev/null; }

if ! is_there; then
    command -v apt-get >/dev/null || {
        echo "proofs: coq, flocq or zarith are missing, and this script knows only Debian's packages" >&2
        exit 1
    }
    install || { as_root apt-get update >/dev/null && install; }
fi

# In the order of their dependencies; the last one prints the axioms of its theorems.
files=(Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent Magnitudes Orders Boxes Apart Certificates
    Machine Nearness Corners Least Beyond Normals Separated Directions Held DirectionsBeyond Hull Volume Clipping VolumeSteps
    Lengths Bars VolumeBeyond Advance Advancing AdvanceBeyond AdvancingBeyond Checker Gap Gaps Nearest Witnesses Chains Kept
    Replay Programs Runs Replayed Narrowed Narrowing Words Integers Sampled Samples Verdicts Contact Theorems)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r ./*.v extracted "$folder"
manifest=$(realpath ../Cargo.toml)
# The kernels' terms. Changes that are not accepted are refused.
cargo run --quiet --manifest-path "$manifest" --package selvedge-traced -- coq "$folder"
cd "$folder"

# Others load those named `section`.
if [ "$(ls ./*.v | grep -vc '\.section\.v$')" -ne "${#files[@]}" ]; then
    echo "proofs: a file is missing in the list of check.sh" >&2
    exit 1
fi
if grep -nwE 'Admitted|Axiom|Axioms|Parameter|Parameters|Conjecture|Abort|admit|give_up' ./*.v; then
    echo "proofs: an axiom or an unfinished proof" >&2
    exit 1
fi
last=${files[-1]}
before=("${files[@]::${#files[@]}-1}")
coq_makefile -Q . Selvedge "${before[@]/%/.v}" -o Makefile >/dev/null
make --no-print-directory --silent --jobs="$(nproc)" >/dev/null || {
    echo "proofs: Coq does not accept what make names above" >&2
    exit 1
}
coqc -q -Q . Selvedge "$last.v" >says || {
    echo "proofs: Coq does not accept $last.v" >&2
    exit 1
}

# The axioms of Coq's real numbers and of their logic.
known='ClassicalDedekindReals.sig_forall_dec|ClassicalDedekindReals.sig_not_dec|FunctionalExtensionality.functional_extensionality_dep|Classical_Prop.classic'
if ! grep -q '^Axioms:' says; then
    echo "proofs: $last.v does not print its axioms" >&2
    exit 1
fi
# Any other line is refused. Indented lines continue a type.
if grep -vE "^( |Axioms:\$|Closed under the global context\$|($known)( |\$))" says; then
    echo "proofs: an axiom that is not of the real numbers" >&2
    exit 1
fi
echo "proofs: ${#files[@]} files accepted by Coq in $SECONDS s, $(grep -c '^Axioms:' says) theorems on the axioms of the real numbers alone"

cd extracted
coqc -q -Q .. Selvedge Extract.v
ocamlfind ocamlopt -package zarith -linkpkg checker.mli checker.ml check_witnesses.ml -o check_witnesses
python3 test.py ./check_witnesses cargo run --quiet --manifest-path "$manifest" --package selvedge-command --
[ -z "$program" ] || cp check_witnesses "$program"
