#!/bin/sh
# batch.sh BUILD [FILES]: draws many small files with `zraster batch`. Prints files per second, and the share of time in which
# its threads, one per processor, run or wait for a processor. Other programs do not change that share. Ends with 1 below 90 %.
set -eu
build=$1 files=${2:-1000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset ZRASTER_SERVER
mkdir "$work/in"
awk -v files="$files" -v folder="$work/in" 'BEGIN {
    for (i = 0; i < files; i++) {
        name = sprintf("%s/m%05d.obj", folder, i)
        for (a = 0; a <= 12; a++) for (b = 0; b < 12; b++) {
            t = 3.14159 * a / 12; p = 6.28318 * b / 12; r = 1 + rand() / 5
            printf "v %.5f %.5f %.5f\n", r * sin(t) * cos(p), r * sin(t) * sin(p), r * cos(t) >name
        }
        for (a = 0; a < 12; a++) for (b = 0; b < 12; b++)
            print "f", a * 12 + b + 1, a * 12 + (b + 1) % 12 + 1, (a + 1) * 12 + (b + 1) % 12 + 1, (a + 1) * 12 + b + 1 >name
        close(name)
    }
}'
begin=$(date +%s%N)
"$build/zraster" batch "$work/in" -o "$work/out" -s 320x240 -q &
pid=$!
while cat /proc/$pid/task/*/schedstat >"$work/now" 2>/dev/null && [ -s "$work/now" ]; do
    [ "$(wc -l <"$work/now")" -lt "$(nproc)" ] || { mv "$work/now" "$work/last" && at=$(date +%s%N); }
    sleep 0.05
done
wait $pid
end=$(date +%s%N)
[ "$(ls "$work/out" | wc -l)" = "$files" ]
awk -v wall=$((at - begin)) -v all=$((end - begin)) -v cores="$(nproc)" -v files="$files" '
    { busy += $1 + $2 }
    END {
        share = busy / wall / cores
        printf "%d files in %.1f s, %.0f/s; %d threads run or wait for a processor %.1f %% of the time, 90 at least\n", files, all / 1e9,
            files / all * 1e9, cores, share * 100
        exit share < 0.9
    }' "$work/last"
