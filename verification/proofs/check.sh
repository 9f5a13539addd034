#!/usr/bin/env bash
# Has Coq check the proofs in this folder, and that they take nothing for granted but the real numbers.
#
# Installs what is missing (Debian's coq, libcoq-flocq).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

is_there() { command -v coqc >/dev/null 2>&1 && [ -e "$(coqc -where)/user-contrib/Flocq/Core/Core.vo" ]; }
as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi
}
install() { as_root apt-get install -y --no-install-recommends coq libcoq-flocq </dev/null >/dev/null; }

if ! is_there; then
    command -v apt-get >/dev/null || {
        echo "proofs: coq and flocq are missing, and only Debian's packages are known here" >&2
        exit 1
    }
    install || { as_root apt-get update >/dev/null && install; }
fi

# In the order in which they build on each other; the last one prints what its theorems assume. mutations.py reads what stands above those
# that are written from the kernels:
# above Filter: Permanent Magnitudes Witnesses Theorems
# above Boxes: Apart Certificates Witnesses Theorems
files=(Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent Magnitudes Orders Boxes Apart Certificates Nearest
    Witnesses Integers Theorems)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp ./*.v "$folder"
# What the kernels compute: refused if nobody has accepted it.
cargo run --quiet --manifest-path ../Cargo.toml --package selvedge-traced -- coq "$folder"
cd "$folder"

if [ "$(ls ./*.v | wc -l)" -ne "${#files[@]}" ]; then
    echo "proofs: a file is not on the list of check.sh" >&2
    exit 1
fi
if grep -nwE 'Admitted|Axiom|Axioms|Parameter|Parameters|Conjecture|Abort|admit|give_up' ./*.v; then
    echo "proofs: something is taken for granted" >&2
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

# Coq's real numbers, and the logic that they are built with.
known='ClassicalDedekindReals.sig_forall_dec|ClassicalDedekindReals.sig_not_dec|FunctionalExtensionality.functional_extensionality_dep|Classical_Prop.classic'
if ! grep -q '^Axioms:' says; then
    echo "proofs: $last.v does not print what it assumes" >&2
    exit 1
fi
# Whatever does not stand in the list of what may stand there is refused; types go on in lines that are indented.
if grep -vE "^( |Axioms:\$|Closed under the global context\$|($known)( |\$))" says; then
    echo "proofs: something is assumed that is not of the real numbers" >&2
    exit 1
fi
echo "proofs: ${#files[@]} files accepted by Coq in $SECONDS s, $(grep -c '^Axioms:' says) theorems on the axioms of the real numbers alone"
