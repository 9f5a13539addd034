#!/usr/bin/env bash
# Builds the site into target/site: a book from docs/ (index.html), the page that runs Selvedge in the browser (demo/), and the
# documentation of the crates (api/). `docs/site.sh serve` also serves it at http://localhost:8090. `--without-demo` leaves out
# the page, which needs Node and Rust's target wasm32-unknown-unknown.
#
# Needs mdBook (https://rust-lang.github.io/mdBook); without it, cargo installs it into the target folder once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

target=${CARGO_TARGET_DIR:-$PWD/target}
version=0.5.4
mdbook=$(command -v mdbook || echo "$target/mdbook/bin/mdbook")
if [ ! -x "$mdbook" ]; then
    cargo install --quiet --locked --root "$target/mdbook" --no-default-features --features search "mdbook@$version"
fi
# Links to files that are not pages lead to the repository.
repository=$(sed -n 's/^repository = "\(.*\)"/\1/p' Cargo.toml)/blob/main

book=$target/book
rm -rf "$book" && mkdir -p "$book/src/tutorials"
cp docs/book.toml "$book"
cp docs/*.{md,svg,png} "$book/src"
# The readme is in the folder above the other pages.
sed "s|](docs/|](|g; t; s|](\([a-zA-Z.][^):#]*\))|]($repository/\1)|g" README.md >"$book/src/README.md"
for page in docs/tutorials/*.md; do
    sed "s|](\.\./\.\./|]($repository/|g" "$page" >"$book/src/tutorials/$(basename "$page")"
done
sed -i "s|](\.\./|]($repository/|g" "$book"/src/[a-z]*.md
site=$target/site
rm -rf "$site"
"$mdbook" build --dest-dir "$site" "$book"

cargo doc --quiet --no-deps -p selvedge -p selvedge-core -p selvedge-files -p selvedge-cloth
cp -r "$target/doc" "$site/api"
echo '<meta http-equiv="refresh" content="0; url=selvedge/index.html">' >"$site/api/index.html"

if [[ " $* " != *" --without-demo "* ]]; then
    std-adapter/web/build.sh
    cp -r "$target/web/site" "$site/demo"
fi
echo "$site/index.html"
[[ " $* " != *" serve "* ]] || python3 -m http.server --directory "$site" 8090
