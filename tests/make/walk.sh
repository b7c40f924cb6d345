#!/bin/sh
# walk.sh BUILD [SCENE]: prints FUNCTIONS FILES LINES NAME: how many of core/ and server/ a request runs, for a flat triangle,
# a textured GLB in studio and the section of a cube with its caps, or for SCENE alone. BUILD is built for gcov (make walk).
# Each request gets a daemon of its own, which has measured the machine before. BUILD/walk/NAME.functions and NAME.files list
# what ran: "file: function", and "file lines". NAMES=1 prints the functions, too.
set -eu
build=$1 out=$1/walk
mkdir -p "$out"
log=$out/daemon.log
export ZRASTER_COST_MAX_MS=86400000 ZRASTER_RENDER_TIMEOUT_MS=86400000 # the build is slow

# await TEXT: until the daemon's log has it.
await() {
    until grep -q "$1" "$log"; do sleep 0.05; done
}

# The prediction of a large picture waits for the daemon's measurement. The picture is then refused: it needs too much memory.
measured() {
    curl -sS -o "$out/refusal" "$server/v1/render" -H 'Content-Type: application/json' -d '{"window":{"width":4096,"height":4096},
        "samples":16,"look":"studio","meshes":[{"positions":[[0,0,0],[1,0,0],[0,1,0]],"faces":[[0,1,2]]}]}'
    grep -q requestMemoryBytes "$out/refusal"
    await '"bytesIn"'
    sleep 0.2 # the connection ends
}

# list NAME: of the counts that the daemon wrote, functions and files with lines; inline functions of headers once.
list() {
    find "$build" -name '*.gcda' -exec gcov -b -t -r {} + | awk -v out="$out/$1" '
        /^ *-: *0:Source:/ { file = $0; sub(/.*:/, "", file) }
        file !~ /^(core|server)\// { next }
        /^function / && $4 > 0 { functions[file ": " $2] }
        /^ *[0-9]+\*?: *[0-9]+:/ { split($0, part, ":"); if (part[1] + 0 > 0 && !((file, part[2]) in ran)) { ran[file, part[2]]; lines[file]++ } }
        END {
            for (name in functions) print name | ("sort >" out ".functions")
            for (file in lines) print file, lines[file] | ("sort >" out ".files")
        }'
}

# walk NAME TYPE FILE [QUERY]: one request.
walk() {
    find "$build" -name '*.gcda' -delete
    . clients/start_daemon.sh
    measured
    kill -USR1 "$daemon" # counts from here
    sleep 0.1
    curl -sS --fail-with-body -o "$out/$1.answer" -H "Content-Type: $2" --data-binary @"$3" "$server/v1/render${4-}"
    await '"status":200'
    sleep 0.2
    kill -USR2 "$daemon" # writes the counts
    sleep 0.1
    kill "$daemon" && wait "$daemon"
    trap - EXIT
    list "$1"
    echo "$(wc -l <"$out/$1.functions") $(wc -l <"$out/$1.files") $(awk '{ n += $2 } END { print n }' "$out/$1.files") $1"
    [ -z "${NAMES-}" ] || sed 's/^/    /' "$out/$1.functions"
}

if [ "${2-}" ]; then
    walk "$(basename "$2" .json)" application/json "$2"
    exit
fi
echo '{"meshes":[{"shading":"flat","positions":[[0,0,0],[1,0,0],[0,1,0]],"faces":[[0,1,2]]}]}' >"$out/triangle.json"
echo '{"meshes":[{"shading":"flat","positions":[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]],
    "faces":[[0,3,2,1],[4,5,6,7],[0,1,5,4],[2,3,7,6],[0,4,7,3],[1,2,6,5]]}],
    "sections":{"planes":[{"axis":"x"}]}}' >"$out/section.json"
"${PYTHON:-/usr/bin/python3}" tests/make/textured_glb.py clients/gallery/bricks.png "$out/glb.glb"
walk triangle application/json "$out/triangle.json"
walk glb model/gltf-binary "$out/glb.glb" '?look=studio&width=160&height=120'
walk section application/json "$out/section.json"
