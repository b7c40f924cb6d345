#!/bin/sh
# Functions of core/input and core/scene do not call in circles: a file is read with those that it calls, and never
# with those that call it. BUILD: where the objects are. Prints TAP.
set -u
build=${1:-build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/support/verdict.sh
said=$work/said complained=$work/complained

calls() { # OBJECT...: "CALLER CALLED" for each
    nm -A "$@" | sed -E 's/(\.[a-z0-9]+)?\.o:[0-9a-f ]*([A-Za-z]) / \2 /' | awk '
        $2 == "U" { calls[$1 " " $3] = 1 }
        $2 ~ /[TDRB]/ { home[$3] = $1 }
        END { for (call in calls) { split(call, c, " "); if (c[2] in home && home[c[2]] != c[1]) print c[1], home[c[2]] } }'
}
circles() { tsort >/dev/null; } # tells them as complaints

calls "$build"/core/input/*/*.o "$build"/core/scene/*.o "$build"/core/scene/*/*.o >"$said"
verdict "many calls are looked at" [ "$(wc -l <"$said")" -ge 100 ]
circles <"$said" 2>"$complained"
verdict "no calls go in a circle" [ ! -s "$complained" ]
{ cat "$said" && sed -n '1s/\(.*\) \(.*\)/\2 \1/p' "$said"; } | circles 2>"$work/made"
verdict "and a circle would be found" [ -s "$work/made" ]
verdicts
