#!/bin/sh
# test_reference.sh BUILD: the reference pages are those of the rows, and a new row shows in all that is made of them. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
said=$work/said complained=$work/complained
trap 'kill $(cat "$work"/*.pid 2>/dev/null) 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
: >"$said"
: >"$complained"

mkdir "$work/pages"
check "the pages are written" 0 "$build/zraster-reference" clients/reference/pages "$work/pages"
verdict "clients/docs/reference has them; make reference-pages writes them" eval 'diff -r "$work/pages" clients/docs/reference >"$said"'
anchors() { grep -ho '<a id="[^"]*"' "$work"/pages/"$1" | sort | uniq -d; }
for page in "$work"/pages/*.md; do
    verdict "each key of ${page##*/} has an address of its own" [ -z "$(anchors "${page##*/}")" ]
done

# ---- a row more ----

if grep -q __asan "$build/libzraster.so.0"; then
    skip "a new row" "the objects have the sanitizers of another compiler"
    verdicts
    exit
fi
# Patched copies of a table of keys and of the table of parameters, and the objects that expand them.
mkdir "$work/objects" "$work/after"
awk '/\{\.key = "mode"\}/ { print "{\"newKey\", zr_json_float, AT(near), 1, 7, .unit = \"pixels\", .otherwise = \"5\", .text = \"meaning of newKey\"}," } { print }' \
    core/input/scene/json_fog.c >"$work/json_fog.c"
awk '{ print } /define ZR_PARAMETER_ROWS\(ROW\)/ { print "ROW(newParameter, \"/fog/near\", ANY, NUMBER, \"meaning of newParameter (default: 5)\") \\" }' \
    core/parameter_rows.h >"$work/parameter_rows.h"
compile() { # FILE...: objects of patched sources
    printf '%s\n' "$@" | xargs -P 2 -I FILE sh -c '
        ${CC:-cc} -std=c11 -w -O0 -D_GNU_SOURCE -pthread -ffp-contract=off -include "$1/parameter_rows.h" -Icore -Iserver -Iclients \
            -c "$2" -o "$1/objects/$(echo "$2" | sed "s|/|_|g").o"' sh "$work" FILE
}
libraries() { sed -n "s/^$1_LIBS := //p" Makefile; }
link() { # NAME LIBRARIES OBJECT...
    name=$1 libraries=$2
    shift 2
    # shellcheck disable=SC2086
    ${CC:-cc} -pthread -o "$work/after/$name" "$@" "$build/libcore.a" $libraries $(libraries CORE)
}
objects_of() { # FILE.c...: those of the build
    for source in "$@"; do echo "$build/${source%.c}.o"; done
}
build_all() {
    compile "$work/json_fog.c" core/schema/parameters.c clients/reference/*.c clients/commands/*.c clients/options/*.c clients/files/*.c clients/engine/*.c || return 1
    keys="$work/objects/$(echo "$work/json_fog.c" | sed 's|/|_|g').o $work/objects/core_schema_parameters.c.o"
    # shellcheck disable=SC2086
    link zrasterd "$(libraries SERVER)" $keys $(objects_of server/*.c server/*/*.c server/site_files.c server/manual_files.c) &&
        link zraster-reference -lcjson $keys "$work"/objects/clients_reference_*.o "$work/objects/clients_options_values.c.o" &&
        link zraster "$(libraries CLIENT)" $keys $(ls "$work"/objects/clients_*.o | grep -v clients_reference_) $(objects_of server/mcp/*.c)
}
build_all >"$said" 2>"$complained"
verdict "programs with a new key and a new parameter are built" [ $? = 0 ]
[ "$failed" = 0 ] || {
    verdicts
    exit 1
}

added() { # OLD NEW: the lines of NEW that OLD lacks; fails if OLD has lines that NEW lacks
    diff "$1" "$2" >"$work/difference"
    ! grep -q '^<' "$work/difference" && sed -n 's/^> //p' "$work/difference"
}
only() { # PATTERN OLD NEW: one line is new, and has the pattern
    added "$2" "$3" >"$said" && [ "$(wc -l <"$said")" = 1 ] && grep -q "$1" "$said"
}
documents() { # FOLDER PROGRAMS
    mkdir -p "$1/pages" && "$2/zraster-reference" clients/reference/pages "$1/pages"
    : >"$1/out"
    "$2/zrasterd" --port 0 >"$1/out" 2>/dev/null &
    echo $! >"$1.pid"
    server=$(address_in "$1/out")
    for file in scene.schema.json openapi.json schema/fog.json; do
        curl -s "$server/v1/$file" | "${PYTHON:-/usr/bin/python3}" -m json.tool | sed 's/,$//' >"$1/${file#*/}"
    done
    kill "$(cat "$1.pid")"
    "$2/zraster" help fog >"$1/help-fog"
    "$2/zraster" help >"$1/help"
}
documents "$work/old" "$build"
documents "$work/new" "$work/after"
new_members() { # FILE NAME LINES: the new lines are those of one member
    added "$work/old/$1" "$work/new/$1" >"$said" && [ "$(wc -l <"$said")" = "$3" ] && grep -q "$2" "$said"
}
verdict "the key is in the schema of scenes, and nothing else is new" new_members scene.schema.json '"newKey": {' 7
verdict "in that of its object" new_members fog.json '"newKey": {' 7
verdict "in its help" only '^  newKey  *Meaning of newKey. Unit: pixels.$' "$work/old/help-fog" "$work/new/help-fog"
verdict "which explains it" eval '"$work/after/zraster" help newKey | grep -q "Value: number from 1 to 7. Default: 5."'
verdict "and on its reference page" only '`newKey` | number from 1 to 7; pixels | 5 | Meaning of newKey. |$' "$work/old/pages/environment.md" "$work/new/pages/environment.md"
# The key has 7 lines, and the parameter 11 for each of 5: POST of a scene, GET and HEAD of both addresses.
occurs() { # TEXT NUMBER FILE
    [ "$(grep -cF "$1" "$3")" = "$2" ]
}
verdict "key and parameter are in OpenAPI, and nothing else is new" new_members openapi.json '"name": "newParameter"' $((7 + 5 * 11))
verdict "the parameter is there for each path that takes it" occurs '"name": "newParameter"' 5 "$said"
verdict "the parameter is on its reference page" only '`newParameter` | number from 0 to 1e+15 | 5 | \[`/fog/near`\](environment.md#fog-near) | Meaning of newParameter. |$' \
    "$work/old/pages/parameters.md" "$work/new/pages/parameters.md"
verdict "and in the help of the command" only ' --new-parameter NUMBER  *meaning of newParameter (default: 5)$' "$work/old/help" "$work/new/help"
same_pages() {
    rm -f "$work"/???/pages/environment.md "$work"/???/pages/parameters.md
    diff -r "$work/old/pages" "$work/new/pages" >"$said"
}
verdict "no other page changes" same_pages
verdicts
