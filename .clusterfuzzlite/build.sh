#!/bin/bash -eu
# The base image of OSS-Fuzz and ClusterFuzzLite runs this. Programs, kept inputs, dictionaries and options go to $OUT.
cd "$SRC/selvedge/fuzz"
cargo fuzz build -O --debug-assertions
host=$(rustc -vV | sed -n 's/^host: //p')
for source in fuzz_targets/*.rs; do
    target=$(basename "$source" .rs)
    cp "../target/$host/release/$target" "$OUT/"
    folders=()
    for folder in "corpus/$target" "regressions/$target"; do
        [ ! -d "$folder" ] || folders+=("$folder")
    done
    [ ${#folders[@]} -eq 0 ] || zip -q -j -r "$OUT/${target}_seed_corpus.zip" "${folders[@]}"
    [ ! -f "dictionaries/$target.dict" ] || cp "dictionaries/$target.dict" "$OUT/"
    case $target in
    obj | ply | stl | off | gltf) longest=2048 ;;
    scene) longest=4096 ;;
    *) longest=700 ;;
    esac
    printf '[libfuzzer]\nmax_len = %s\n' "$longest" >"$OUT/$target.options"
done
