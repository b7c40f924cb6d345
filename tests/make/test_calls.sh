#!/bin/sh
# Functions of core do not call in circles, neither those of files nor those of rooms: a file is read with those that it
# calls, and never with those that call it. With headers, too: a file that includes or calls another one is neither
# included nor called by it. Addresses of functions, as in tables, are no calls. BUILD: where the objects are.
# Prints TAP.
set -u
build=${1:-build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/support/verdict.sh
said=$work/said complained=$work/complained

# A file is named without its ending and the instruction set of a kernel. A header and the .c of its name are one.
calls() { # OBJECT...: "CALLER CALLED" for each
    { nm -A "$@" | sed -E 's/(\.[a-z0-9]+)?\.o:[0-9a-f ]*([A-Za-z]) / \2 /' && readelf -rW "$@"; } | awk '
        NF == 3 && $2 ~ /[TDRB]/ { home[$3] = $1 }
        $1 == "File:" { caller = $2; sub(/(\.[a-z0-9]+)?\.o$/, "", caller) }
        $3 ~ /_(PLT32|CALL26|JUMP26)$/ { calls[caller " " $5] = 1 }
        END { for (call in calls) { split(call, c, " "); if (c[2] in home && home[c[2]] != c[1]) print c[1], home[c[2]] } }' |
        sed "s|$build/core/||g"
}
includes() { # FILE...: "INCLUDER INCLUDED" for each. A kernel that includes another one is a second build of it
    awk 'function is_file(path) { found = (getline line <path) >= 0; close(path); return found }
        /^[ \t]*#[ \t]*include[ \t]*"[^"]*\.h"/ {
            split($0, parts, "\"")
            file = beside = FILENAME
            sub(/[^\/]*$/, parts[2], beside)
            included = is_file(beside) ? beside : "core/" parts[2]
            gsub(/^core\/|\.[ch]$/, "", file)
            gsub(/^core\/|\.h$/, "", included)
            if (file != included) print file, included
        }' "$@"
}
objects() { # of sources that exist
    for source in $(find core -name '*.c' | sort); do
        for object in "$build/${source%.c}".o "$build/${source%.c}".*.o; do
            [ -f "$object" ] && echo "$object"
        done
    done
}
rooms() { sed 's|/[^/ ]* | |;s|/[^/ ]*$||' | awk '$1 != $2' | sort -u; }
circles() { tsort >/dev/null; } # tells them as complaints
check() { # NAME LEAST: the pairs of "$said" have no circle, and one would be found
    verdict "many pairs are looked at: $1" [ "$(wc -l <"$said")" -ge "$2" ]
    circles <"$said" 2>"$complained"
    verdict "no $1 go in a circle" [ ! -s "$complained" ]
    { cat "$said" && sed -n '1s/\(.*\) \(.*\)/\2 \1/p' "$said"; } | circles 2>"$work/made"
    verdict "and a circle would be found" [ -s "$work/made" ]
}

calls $(objects) >"$work/calls"
cp "$work/calls" "$said"
check "calls between files" 1000
rooms <"$work/calls" >"$said"
check "calls between rooms" 100
{ cat "$work/calls" && includes $(find core -name '*.[ch]'); } | awk '!/_kernel [^ ]*_kernel$/' >"$said"
check "calls and includes" 3000
verdicts
