# What checks beside the workspace share, to be sourced by a check.sh whose options may have --present: it says what is missing, and ends well.
say() { printf '\n== %s\n' "$*"; }
missing() {
    if [ "${present:-}" ]; then
        say "skipped: $*"
        exit 0
    fi
    printf 'check.sh: %s\n' "$*" >&2
    exit 1
}
[ "${1:-}" != --present ] || present=yes
