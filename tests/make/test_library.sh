#!/bin/sh
# test_library.sh BUILD: libzraster from outside: its symbols, its header in C99 and C++, and clients/examples/draw.c, linked
# with the shared and with the static library, beside the daemon. Prints TAP.
set -u
build=$1
work=$(mktemp -d)
. tests/support/verdict.sh
out=$work said=$work/said complained=$work/complained; : >"$said"; : >"$complained"
. clients/start_daemon.sh
trap 'kill "$daemon" 2>/dev/null; wait "$daemon" 2>/dev/null; rm -rf "$work"' EXIT
header=core/api/zraster.h example=clients/examples/draw.c
warnings='-Wall -Wextra -Werror -pedantic'
cc=${CC:-cc} cxx=${CXX:-c++}

sed -n 's/^ZRASTER_API .*\b\(zraster_[a-z_]*\)(.*/\1/p' $header | sort >"$work/declared"
tr '\n' ' ' <$header | grep -o '\bzraster_[a-z_]*(' | grep -v '_API\|^zraster_[a-z_]*status(' | tr -d '(' | sort -u >"$work/called"
nm -D --defined-only "$build/libzraster.so.0" | awk '$2 != "A" { sub(/@@ZRASTER_0.2$/, "", $3); print $3 }' | sort >"$work/shared"
nm -g --defined-only "$build/libzraster.a" 2>/dev/null | awk 'NF == 3 { print $3 }' | sort >"$work/static"
verdict "the header declares functions" [ "$(wc -l <"$work/declared")" -gt 20 ]
verdict "and the examples in it call no others" [ -z "$(comm -13 "$work/declared" "$work/called")" ]
verdict "the shared library exports them, versioned, and nothing else" cmp "$work/declared" "$work/shared"
verdict "so does the static one" cmp "$work/declared" "$work/static"
verdict "its name has the version of the ABI" sh -c "readelf -d '$build/libzraster.so.0' | grep -q 'SONAME.*\[libzraster.so.0\]'"
version=$(sed -n 's/^#define ZRASTER_VERSION  *"\(.*\)"/\1/p' $header)
verdict "the daemon and the command have its version" [ "$("$build/zrasterd" --version) $("$build/zraster" --version)" = \
    "zrasterd $version zraster $version" ]

libraries='-lpng -ljpeg -lwebp -lisal -lm -pthread'
verdict "the header is C99" $cc -std=c99 $warnings -fsyntax-only -x c $header
verdict "and C++" $cxx $warnings -fsyntax-only -x c++ $header
verdict "the example is C99" $cc -std=c99 $warnings -Icore/api $example -o "$work/shared.out" -L"$build" -lzraster -Wl,-rpath,"$(realpath "$build")"
verdict "and links with the static library" $cc -Icore/api $example -o "$work/static.out" "$build/libzraster.a" $libraries
verdict "and is C++" $cxx $warnings -Icore/api -x c++ $example -x none -o "$work/cxx.out" -L"$build" -lzraster -Wl,-rpath,"$(realpath "$build")"

printf 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n' >"$work/part.obj"
cp clients/examples/solids.json "$work/solids.json"
same() { # FILE QUERY
    curl -sf --data-binary @"$work/$1" "$server/v1/render?$2" -o "$work/wanted" || return 1
    for program in shared static cxx; do
        "$work/$program.out" "$work/$1" "$work/got" "$2" && cmp "$work/wanted" "$work/got" || return 1
    done
}
verdict "it draws a scene as the daemon does, byte for byte" same solids.json ""
verdict "and a mesh" same part.obj "look=studio&width=200&height=150"
"$work/shared.out" "$work/part.obj" "$work/got" "look=tecnical" 2>"$work/complained"
verdict "a wrong query is explained" grep -q "parameter look: 'tecnical' is unknown (did you mean technical?)" "$work/complained"
verdict "the library prints nothing itself" [ "$(wc -l <"$work/complained")" = 1 ]
strip -o "$work/stripped" "$build/libzraster.so.0"
verdict "stripped it has less than 5.5 MB" [ "$(wc -c <"$work/stripped")" -lt 5500000 ]
verdicts
