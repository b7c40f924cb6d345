#!/bin/bash
# cold.sh BUILD MODEL [ROUNDS]: prints the time of the command, started anew, beside that of a warm HTTP request, in turns.
# Ends with 1 if the command's median is more than 10 ms longer, or if the bytes differ. Needs a machine without other work.
set -eu
build=$1 model=$2 rounds=${3:-31}
work=$(mktemp -d)
out=$work
. clients/start_daemon.sh
trap 'kill "$daemon" 2>/dev/null; wait "$daemon" 2>/dev/null; rm -rf "$work"' EXIT
unset ZRASTER_SERVER
ask() { curl -sf "$server/v1/render" --data-binary @"$model" -o "$work/http.png" -w '%{time_total}\n'; }
for i in 1 2 3 4 5; do ask >/dev/null; done
for ((i = 0; i < rounds; i++)); do
    ask | awk '{ print $1 * 1000 }' >>"$work/http"
    begin=${EPOCHREALTIME/./}
    "$build/zraster" "$model" "$work/command.png" -q
    end=${EPOCHREALTIME/./}
    echo $((end - begin)) | awk '{ print $1 / 1000 }' >>"$work/command"
done
summary() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)], v[1] }'; }
cmp "$work/http.png" "$work/command.png"
echo "$(summary "$work/command") $(summary "$work/http")" | awk '{
    printf "command, cold: %.1f ms (least %.1f); HTTP, warm: %.1f ms (least %.1f); difference %.1f ms (%.1f), 10 at most\n",
        $1, $2, $3, $4, $1 - $3, $2 - $4
    exit $1 - $3 > 10
}'
