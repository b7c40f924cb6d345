#!/bin/sh
# cold.sh BUILD MODEL [ROUNDS]: the median time of the command, which starts anew, beside that of a warm request over HTTP, in
# turns. Ends with 1 if the command takes more than 10 ms longer, or if the bytes differ.
set -eu
build=$1 model=$2 rounds=${3:-21}
work=$(mktemp -d)
out=$work
. clients/start_daemon.sh
trap 'kill "$daemon" 2>/dev/null; wait "$daemon" 2>/dev/null; rm -rf "$work"' EXIT
unset ZRASTER_SERVER
ask() { curl -sf "$server/v1/render" --data-binary @"$model" -o "$work/http.png" -w '%{time_total}\n'; }
for i in 1 2 3 4 5; do ask >/dev/null; done
i=0
while [ $i -lt "$rounds" ]; do
    i=$((i + 1))
    ask | awk '{ print $1 * 1000 }' >>"$work/http"
    begin=$(date +%s%N)
    "$build/zraster" "$model" "$work/command.png" -q
    end=$(date +%s%N)
    echo "$begin $end" | awk '{ print ($2 - $1) / 1e6 }' >>"$work/command"
done
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
cmp "$work/http.png" "$work/command.png"
echo "$(median "$work/command") $(median "$work/http")" |
    awk '{ printf "command, cold: %.1f ms; HTTP, warm: %.1f ms; difference %.1f ms, 10 at most\n", $1, $2, $1 - $2; exit $1 - $2 > 10 }'
