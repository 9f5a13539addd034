#!/usr/bin/env bash
# Checks the npm package and the page: builds them, runs the package in Node, compares its bits and its speed with native ones,
# checks the declarations, packs, bundles with Vite, and drives the page in Chromium, and in Firefox where firefox-esr and
# xvfb-run are installed. SELVEDGE_TIMES=no leaves out bounds of time, for a busy machine. SELVEDGE_COMMAND names a built command,
# the native side of the comparison, whose report the page opens, too.
#
# Installs what is missing and says so: Debian's chromium, and its rustc-web, cargo-web and rust-web-src unless rustup has the
# target; Node's packages by `npm ci`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

say() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }

missing=()
rustup target add wasm32-unknown-unknown >/dev/null 2>&1 || [ -d /usr/lib/rustlib/src ] || missing+=(rustc-web cargo-web rust-web-src)
command -v npm >/dev/null || missing+=(nodejs npm)
CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v google-chrome || true)}
[ -n "$CHROMIUM" ] || missing+=(chromium)
if [ "${#missing[@]}" -gt 0 ]; then
    say "installing ${missing[*]}"
    sudo=$([ "$(id -u)" = 0 ] || echo sudo)
    # Another check may be installing something.
    for _ in {1..60}; do
        $sudo apt-get -q update && break || sleep 5
    done
    $sudo env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600 install -y --no-install-recommends "${missing[@]}"
fi
export CHROMIUM=${CHROMIUM:-/usr/bin/chromium}

say "tools of Node"
npm ci --no-audit --no-fund

# The linker has one thread, so lints and the command run beside it, in folders that it does not lock.
target=${CARGO_TARGET_DIR:-$PWD/../../target}
out=$target/web
mkdir -p "$out/lints"
out=$(cd "$out" && pwd)
(
    cargo fmt --check
    CARGO_TARGET_DIR=$out/lints cargo clippy --locked --all-features --workspace --lib --bins -- -D warnings
    [ -n "${SELVEDGE_COMMAND:-}" ] || cargo build --quiet --locked --release --manifest-path ../command/Cargo.toml
) >"$out/lints.log" 2>&1 &
lints=$!
./build.sh

say "formatting, lints, the command"
wait "$lints" || {
    cat "$out/lints.log"
    exit 1
}
export SELVEDGE_WEB=$out SELVEDGE_COMMAND=${SELVEDGE_COMMAND:-$target/release/selvedge}

say "the package: pack, types, bundle"
(cd "$out/package" && npm pack --pack-destination "$out")
work=$out/bundle
rm -rf "$work" && mkdir -p "$work/node_modules/selvedge"
cp -r tests/bundle/. tests/types.mts tests/tsconfig.json "$work"
tar -xzf "$out"/selvedge-0.1.0.tgz -C "$work/node_modules/selvedge" --strip-components 1
ln -s "$PWD"/node_modules/{three,@types} "$work/node_modules/"
node_modules/.bin/tsc --project "$work/tsconfig.json"
cp tests/alone.mts "$work"
for resolution in "nodenext --moduleResolution nodenext" "node16 --moduleResolution node16" "esnext --moduleResolution bundler"; do
    # shellcheck disable=SC2086 # words on purpose
    (cd "$work" && "$OLDPWD/node_modules/.bin/tsc" --ignoreConfig --noEmit --strict --target es2022 --lib es2022 --types "" --module $resolution alone.mts)
done
node_modules/.bin/vite build --logLevel warn "$work"

say "the package in Node"
node --test tests/node.test.mjs

say "a report for the page"
"$SELVEDGE_COMMAND" simulate ../cloth/scenes/flag.toml --output "$out" >/dev/null
export SELVEDGE_REPORT=$out/flag.html

say "the page"
node --test --test-timeout=240000 tests/page.test.mjs
if command -v firefox-esr >/dev/null && command -v xvfb-run >/dev/null; then
    say "the page in Firefox"
    SELVEDGE_BROWSER=firefox xvfb-run -a node --test --test-timeout=240000 tests/page.test.mjs
else
    say "skipped: the page in Firefox (Debian: apt install firefox-esr xvfb)"
fi
say "the web: everything passed"
