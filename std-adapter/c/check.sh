#!/usr/bin/env bash
# Installs the library into a folder, then builds and runs the C and C++ programs against it as a user would: with every available
# compiler, warnings as errors, with and without the address and undefined-behaviour sanitizers, through pkg-config and CMake.
# Missing tools are skipped with a message. Linux; a few minutes, mostly link-time optimisation of the library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

say() { printf '\n== %s\n' "$*"; }
give_up() {
    printf 'check.sh: %s\n' "$*" >&2
    exit 1
}
is_there() { command -v "$1" >/dev/null 2>&1; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/installed
export LD_LIBRARY_PATH=$prefix/lib PKG_CONFIG_PATH=$prefix/lib/pkgconfig
# The library must reject absurd counts under a sanitizer as well.
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=8192:detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1

say "library without cloth: make install"
make --no-print-directory install PREFIX="$prefix"
stat -c '%s bytes %n' "$prefix"/lib/libselvedge.so.*.*.* "$prefix"/lib/libselvedge.a
[ ! -e "$prefix/include/selvedge_cloth.h" ] || give_up "it installs the header of cloth"
if is_there nm && nm -D "$prefix/lib/libselvedge.so" | grep selvedge_simulation; then give_up "it has cloth"; fi

say "library: make install CLOTH=yes"
make --no-print-directory install CLOTH=yes PREFIX="$prefix"

say "exported symbols"
version=$(cargo pkgid | sed 's/.*[@#]//')
if is_there readelf; then
    readelf -d "$prefix/lib/libselvedge.so" | grep -q "SONAME.*\[libselvedge.so.${version%.*}\]" || give_up "its SONAME is another"
    foreign=$(nm -D --defined-only "$prefix/lib/libselvedge.so" | awk '{ print $3 }' | grep -v '^selvedge_' || true)
    [ -z "$foreign" ] || give_up "it exports foreign symbols: $foreign"
    stat -c '%s bytes %n' "$prefix"/lib/libselvedge.so."$version" "$prefix"/lib/libselvedge.a
else
    echo "skipped: readelf is missing"
fi

say "frames: a tetrahedron falls through a square"
frame() { # HEIGHT
    printf 'v %s 0\n' "-2 -2" "2 -2" "2 2" "-2 2"
    for vertex in "0 0 0" "1 0 1" "0 1 1" "-1 -1 1"; do
        echo "$vertex $1" | awk '{ print "v", $1, $2, $3 + $4 }'
    done
    printf 'f %s\n' "1 2 3" "1 3 4" "5 6 7" "5 6 8" "5 7 8" "6 7 8"
}
frames=()
for height in 0.55 0.35 0.15 -0.05 -0.25; do
    frame "$height" >"$folder/$height.obj"
    frames+=("$folder/$height.obj")
done

warnings=(-pedantic -Wall -Wextra -Wconversion -Wshadow -Werror)
sanitizers=(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
printed=
flown=

# Builds and runs a program, with frames if it takes them.
try() { # NAME OUTPUT COMMAND...
    local name=$1 output=$2
    shift 2
    "$@" -o "$folder/program"
    case $name in
    frames)
        "$folder/program" "${frames[@]}" >"$output"
        "$folder/program" --float "${frames[@]}" >>"$output"
        [ -z "$printed" ] || cmp "$printed" "$output" || give_up "$* builds a program with different output"
        [ -n "$printed" ] || cp "$output" "$folder/first" && printed=$folder/first
        ;;
    flag)
        "$folder/program" >"$output"
        [ -n "$flown" ] || { cp "$output" "$folder/flag" && flown=$folder/flag; }
        cmp "$flown" "$output" || give_up "$* builds a flag with different output"
        grep -q '^500 of 500 states are certified' "$output" || give_up "not every state of the flag is certified"
        ;;
    hammock)
        "$folder/program" >"$output"
        grep -q '^the sheet carries 1.000. of the ball.s weight; 600 of 600 states' "$output" || give_up "the load is not the weight"
        ;;
    guard)
        "$folder/program" >"$output"
        grep -q '^with the guard: 0 of 100 states' "$output" || give_up "the guard lets states intersect"
        ;;
    *) "$folder/program" ;;
    esac
}

for compiler in gcc clang g++ clang++; do
    if ! is_there "$compiler"; then
        say "$compiler: skipped, it is missing"
        continue
    fi
    say "$compiler: $($compiler --version | head -n 1)"
    case $compiler in
    *++) standards="c++17 c++20" suffix=cpp ;;
    *) standards="c11 c17" suffix=c ;;
    esac
    for standard in $standards; do
        for source in examples/{frames,flag,guard,hammock} tests/programs/{refusals,refusals_of_worlds,simulations,fork,fork_simulation}; do
            [ -e "$source.$suffix" ] || continue
            for mode in plain sanitized; do
                # The older standards are read by the compiler alone.
                [ "$mode" = plain ] || [ "$standard" = "${standards##* }" ] || continue
                # The allocator of the sanitizers may be locked by a thread that the child does not have, and then hangs.
                [ "$mode" = plain ] || [[ $source != tests/programs/fork* ]] || continue
                extra=(-O2)
                [ $mode = plain ] || extra=(-O1 "${sanitizers[@]}")
                try "$(basename $source)" "$folder/output" "$compiler" "-std=$standard" "${warnings[@]}" "${extra[@]}" \
                    -I "$prefix/include" "$source.$suffix" -L "$prefix/lib" -lselvedge -lm
                echo "$source.$suffix, $standard, $mode: passed"
            done
        done
    done
done
[ -n "$printed" ] || give_up "there is no compiler"
grep -c ' time ' "$printed" | sed 's/$/ contacts, the same from all programs/'

say "pkg-config"
if is_there pkg-config && is_there gcc; then
    [ "$(pkg-config --modversion selvedge)" = "$version" ] || give_up "pkg-config reports another version"
    # shellcheck disable=SC2046 # words on purpose
    try frames "$folder/output" gcc examples/frames.c $(pkg-config --cflags --libs selvedge)
    # The archive instead of -lselvedge, with the system libraries that the package names.
    # shellcheck disable=SC2046
    try frames "$folder/output" gcc examples/frames.c $(pkg-config --cflags selvedge) "$prefix/lib/libselvedge.a" \
        $(pkg-config --static --libs-only-l selvedge | sed 's/-lselvedge//') -lm
    # shellcheck disable=SC2046
    try flag "$folder/output" gcc examples/flag.c $(pkg-config --cflags selvedge) "$prefix/lib/libselvedge.a" \
        $(pkg-config --static --libs-only-l selvedge | sed 's/-lselvedge//') -lm
    echo "shared and static: passed"
else
    echo "skipped: pkg-config or gcc is missing"
fi

say "CMake"
if is_there cmake && is_there g++; then
    cmake -S tests/cmake -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build "$folder/cmake" >/dev/null
    for program in frames-c-shared frames-c-static frames-cpp-shared frames-cpp-static; do
        { "$folder/cmake/$program" "${frames[@]}" && "$folder/cmake/$program" --float "${frames[@]}"; } >"$folder/output"
        cmp "$printed" "$folder/output" || give_up "$program has different output"
        echo "$program: passed"
    done
    "$folder/cmake/flag-static" | cmp "$flown" - || give_up "flag-static has different output"
else
    echo "skipped: cmake or g++ is missing"
fi

say "a moved installation"
moved=$folder/moved/here
mkdir -p "$folder/moved" && mv "$prefix" "$moved"
if is_there cmake && is_there g++; then
    cmake -S tests/cmake -B "$folder/cmake-moved" -DCMAKE_PREFIX_PATH="$moved" >/dev/null
    cmake --build "$folder/cmake-moved" >/dev/null
    for program in frames-c-shared frames-cpp-static; do
        { "$folder/cmake-moved/$program" "${frames[@]}" && "$folder/cmake-moved/$program" --float "${frames[@]}"; } >"$folder/output"
        cmp "$printed" "$folder/output" || give_up "$program of a moved installation has different output"
    done
    echo "CMake, shared and static: passed"
else
    echo "skipped: cmake or g++ is missing"
fi
if is_there pkg-config && is_there gcc; then
    export PKG_CONFIG_PATH=$moved/lib/pkgconfig LD_LIBRARY_PATH=$moved/lib
    # shellcheck disable=SC2046 # words on purpose
    try frames "$folder/output" gcc examples/frames.c $(pkg-config --define-prefix --cflags --libs selvedge)
    # shellcheck disable=SC2046
    try frames "$folder/output" gcc examples/frames.c $(pkg-config --define-prefix --cflags selvedge) "$moved/lib/libselvedge.a" \
        $(pkg-config --define-prefix --static --libs-only-l selvedge | sed 's/-lselvedge//') -lm
    echo "pkg-config, shared and static: passed"
fi
mv "$moved" "$prefix"

make --no-print-directory uninstall PREFIX="$prefix"
# An installation by root must not replace the null device by a file.
[ -c /dev/null ] || give_up "/dev/null is no longer a device"
left=$(find "$prefix" -type f -o -type l)
[ -z "$left" ] || give_up "uninstall has left $left"
say "C and C++: everything passed"
