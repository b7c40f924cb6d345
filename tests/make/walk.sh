#!/bin/sh
# walk.sh BUILD [SCENE]: prints FUNCTIONS FILES LINES: how many of core/ and server/ the request of a flat triangle, or of
# SCENE, runs. BUILD is built for gcov (make walk). A daemon that gets no request is subtracted: what counts is what runs
# more often with the request. BUILD/walk/functions and BUILD/walk/files list it: "file: function", and "file lines".
set -eu
build=$1 out=$1/walk
mkdir -p "$out"
scene=${2:-$out/triangle.json}
echo '{"meshes":[{"shading":"flat","positions":[[0,0,0],[1,0,0],[0,1,0]],"faces":[[0,1,2]]}]}' >"$out/triangle.json"

# counts NAME: stops the daemon, which then writes its counts, and lists them, "count file name" or "count file line", the
# inline functions of headers once for each object that has them.
counts() {
    kill "$daemon" && wait "$daemon"
    trap - EXIT
    find "$build" -name '*.gcda' -exec gcov -b -t -r {} + | awk '
        /^ *-: *0:Source:/ { file = $0; sub(/.*:/, "", file) }
        file !~ /^(core|server)\// { next }
        /^function / { print $4, file, $2 }
        /^ *[0-9]+\*?: *[0-9]+:/ { split($0, part, ":"); print part[1] + 0, file, part[2] + 0 }' >"$out/$1"
    find "$build" -name '*.gcda' -delete
}

find "$build" -name '*.gcda' -delete
. clients/start_daemon.sh
counts idle
. clients/start_daemon.sh
curl -sS --fail-with-body -o "$out/answer" -H 'Content-Type: application/json' --data-binary @"$scene" "$server/v1/render"
counts busy
awk -v out="$out" '
    FNR == NR { idle[$2, $3] += $1; next }
    { busy[$2, $3] += $1 }
    END {
        for (key in busy) {
            if (busy[key] <= idle[key]) continue
            split(key, part, SUBSEP)
            if (part[2] ~ /^[0-9]/) lines[part[1]]++
            else print part[1] ": " part[2] | ("sort >" out "/functions")
        }
        for (file in lines) print file, lines[file] | ("sort >" out "/files")
    }' "$out/idle" "$out/busy"
echo "$(wc -l <"$out/functions") $(wc -l <"$out/files") $(awk '{ n += $2 } END { print n }' "$out/files")"
