#!/bin/sh
# same.sh TOOL NEW OLD [quick|OPTIONS...]: all answers of two daemons, hashed by zraster-same (TOOL) and compared line by
# line. The scenes are those of the folder that it runs in. EXPECTED=FILE: a list of answers that may differ, a line
# each: a name as it is printed here, without the instruction set and with * for any text, a tab, and a reason; a line
# that no difference fits fails, too. OUT=DIR (build/same): what both answered lands there; what the old one answered is
# kept in CACHE=DIR (that of OUT) for the next run, under the hash of all that it was made by.
set -u
tool=$1 new=$2 old=$3
shift 3
[ "${1:-}" = quick ] && shift && set -- --quick "$@"
out=${OUT:-build/same}
mkdir -p "$out"
: >"$out/none"
was=${CACHE:-$out}/$({ echo "$@"; cat "$tool" "$old" tests/scenes/*.json clients/examples/*; } | sha256sum | cut -c 1-16)
if [ ! -s "$was" ]; then
    ZRASTERD=$old "$tool" "$@" >"$was.$$" 2>"$out/old.log" && mv "$was.$$" "$was" &
fi
ZRASTERD=$new "$tool" "$@" >"$out/new.$$" 2>"$out/new.log" || new=
wait
[ "$new" ] && [ -s "$was" ] || {
    cat "$out/old.log" "$out/new.log" >&2
    echo "not ok: a daemon did not answer all" >&2
    exit 1
}
mv "$out/new.$$" "$out/new"
awk -F '\t' -v expected="${EXPECTED:-$out/none}" '
    BEGIN {
        while ((getline <expected) > 0) {
            if ($0 ~ /^#/ || $0 == "") continue
            if ($2 == "") { print "not ok: " expected ": no reason: " $0; bad = 1 }
            pattern = $1
            gsub(/[][().+?^$|{}\\]/, "\\\\&", pattern)
            gsub(/\*/, ".*", pattern)
            patterns[$1] = "^" pattern "$"
        }
    }
    NF < 3 { next }
    FILENAME == ARGV[1] { was[$1 FS $2] = $3; next }
    { new++; key = $1 FS $2 }
    !(key in was) { differ(key, "(none)", $3); next }
    { split($3, status, " "); count[status[1]]++ }
    was[key] != $3 { differ(key, was[key], $3) }
    { delete was[key] }
    function differ(key, a, b,    parts, p) {
        split(key, parts, FS)
        for (p in patterns)
            if (parts[2] ~ patterns[p]) { used[p] = 1; allowed++; return }
        if (++different <= 20) print "differs: " parts[1] ": " parts[2] ": " a " -> " b
    }
    END {
        for (key in was) differ(key, was[key], "(none)")
        for (s in count) printf "# %d of status %s\n", count[s], s
        for (p in patterns) if (!(p in used)) { print "not ok: expected to differ, and does not: " p; bad = 1 }
        printf "%s: %d answers, %d differ, %d more as expected\n", different || bad || !new ? "not ok" : "ok", new, \
            different, allowed
        exit different || bad || !new ? 1 : 0
    }' "$was" "$out/new"
