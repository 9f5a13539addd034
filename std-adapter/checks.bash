# Shared by the check.sh scripts outside the workspace. With the option --present they skip the check if something is missing.
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
