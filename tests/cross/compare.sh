#!/bin/sh
# compare.sh COMMAND ISAS...: runs builds of zraster-cross, each with the instruction sets that it was built for, and
# compares all that they drew, line by line, with what the first drew in plain C on one thread. What differs is named,
# the first of it; so is an instruction set that a machine lacks, which proves nothing.
set -u
lines=$(mktemp)
trap 'rm -f "$lines" "$lines.own"' EXIT
while [ $# -gt 1 ]; do
    command=$1 isas=$2
    shift 2
    $command >"$lines.own" && [ -s "$lines.own" ] || {
        echo "not ok: '$command' failed, or drew nothing" >&2
        exit 1
    }
    for isa in $isas; do
        grep -q "^$isa, " "$lines.own" || echo "LEFT OUT: $isa: the machine of '$command' lacks it" >&2
    done
    sed "s|^|$command: |" "$lines.own" >>"$lines"
done
awk -F '\t' '
    !($1 in count) { builds[++build_count] = $1 }
    { count[$1]++ }
    build_count == 1 { want[$2] = $3; wanted++ }
    !first && want[$2] != $3 { first = $1 ": " $2 ": " $3 ", not " want[$2] " as in " builds[1] }
    END {
        for (b = 1; b <= build_count; b++) {
            print "# " builds[b] ": " count[builds[b]] " channels"
            if (count[builds[b]] != wanted && !first) first = builds[b] ": not all was drawn"
        }
        if (first) { print "not ok: " first; exit 1 }
        if (build_count < 2) { print "not ok: nothing to compare"; exit 1 }
        print "ok: " build_count " ways to draw " wanted " channels, all the same"
    }' "$lines"
