#!/usr/bin/env bash
# Builds the npm package (package/) and the page (site/) into target/web. `build.sh serve` also serves the page at
# http://localhost:8090.
#
# Needs Rust's target wasm32-unknown-unknown (rustup target add wasm32-unknown-unknown). Where rustup does not have it, Debian's
# packages do instead: rustc-web, cargo-web and rust-web-src, which build the standard library with the program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

out=${CARGO_TARGET_DIR:-$PWD/../../target}/web
mkdir -p "$out"
out=$(cd "$out" && pwd)
export CARGO_TARGET_DIR=$out
target=wasm32-unknown-unknown

# Compiles the crate with FEATURES and writes NAME.js, NAME_bg.wasm and declarations into FOLDER.
module() { # NAME FOLDER FEATURES...
    local name=$1 folder=$2
    shift 2
    local flags=(--lib --release --locked --package selvedge-web --target "$target" "$@")
    if rustup target list --installed 2>/dev/null | grep -qx "$target"; then
        RUSTFLAGS="-C target-feature=+simd128" cargo build "${flags[@]}"
    elif [ -x /usr/bin/cargo ] && [ -d /usr/lib/rustlib/src ]; then
        # The linker is that of a rustup toolchain where there is one: Debian's lld may be older than this compiler's LLVM.
        local lld
        lld=$(ls "$HOME"/.rustup/toolchains/*/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld 2>/dev/null | head -n 1 || true)
        PATH=/usr/bin:$PATH RUSTC_BOOTSTRAP=1 RUSTC=/usr/bin/rustc \
            RUSTFLAGS="-C target-feature=+simd128 ${lld:+-C linker=$lld}" \
            /usr/bin/cargo build "${flags[@]}" -Z build-std=std,panic_abort
    else
        echo "build.sh: run 'rustup target add $target', or install Debian's rustc-web, cargo-web and rust-web-src" >&2
        exit 1
    fi
    mkdir -p "$folder"
    "$bindgen" "$out/$target/release/selvedge_web.wasm" "$folder" "$name"
    # The features are those of the compiler; no option changes a result. Debian's binaryen does not know all instructions, npm's
    # does.
    if [ -x node_modules/.bin/wasm-opt ]; then
        node_modules/.bin/wasm-opt -O2 --gufa -O2 --enable-simd --enable-bulk-memory --enable-nontrapping-float-to-int --enable-sign-ext \
            --enable-mutable-globals --enable-reference-types --enable-multivalue \
            "$folder/${name}_bg.wasm" -o "$folder/${name}_bg.wasm"
    fi
}

cargo build --quiet --locked --package selvedge-bindgen
bindgen=$out/debug/selvedge-bindgen

package=$out/package
rm -rf "$package" && cp -r package "$package"
cp ../../LICENSE-APACHE ../../LICENSE-MIT "$package"
module selvedge "$package/cloth" --features cloth
module selvedge "$package/detector" --no-default-features

site=$out/site
rm -rf "$site" && cp -r site "$site"
# The page and the reports of `selvedge simulate` draw with the same code.
for file in data.js algebra.js shaders.js viewer.js page.css; do
    cp "../laboratory/src/report/page/assets/$file" "$site/$file"
done
cp -r ../cloth/scenes "$site/scenes"
module selvedge "$site/selvedge" --features page

for wasm in "$package/cloth" "$package/detector" "$site/selvedge"; do
    echo "$wasm: $(gzip -9 -c "$wasm/selvedge_bg.wasm" | wc -c) bytes compressed"
done
if [ "${1:-}" = serve ]; then
    echo "open http://localhost:8090"
    exec python3 -m http.server --bind 127.0.0.1 --directory "$site" 8090
fi
