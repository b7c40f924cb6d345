#!/bin/sh
# check.sh PROGRAM JOBS SCENE...: draws each scene under valgrind's memcheck, and names those in which a value is used
# that was never written. First it leaves something unwritten itself, which must be found: in what is drawn, and in
# what is written away, colours among it. Ends with status 1 where anything was found, or was not found.
set -u
program=$1 jobs=$2
shift 2
logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT
here=$(dirname "$0")
export logs program here

# Status 9 means that valgrind found an error. A second run, twice as slow, then reports the origin of the memory. New
# memory is filled with floats between 0 and 1: see harmless.supp.
cat >"$logs/one" <<'END'
log=$logs/$(basename "$1").log
watch() { valgrind -q --error-exitcode=9 "$1" --malloc-fill=3e --suppressions="$here/harmless.supp" "$program" "$scene" $left >"$log" 2>&1; }
scene=$1 left=${2:-}
watch --track-origins=no
status=$?
[ "$status" != 9 ] || [ "$left" ] || watch --track-origins=yes
exit "$status"
END
check() { sh "$logs/one" "$@"; }

# The scene has a look that draws colours: the technical one, for example, reads none.
seeded=$here/../scenes/blend-transparent-background.json
for left in position color pixel; do
    check "$seeded" "$left"
    status=$?
    if [ "$status" != 9 ]; then
        cat "$logs"/*.log
        echo "not ok: an unwritten $left in $seeded was not found (status $status)"
        exit 1
    fi
    echo "ok: an unwritten $left is found"
done

printf '%s\n' "$@" | xargs -P "$jobs" -I '{}' sh -c 'sh "$logs/one" "$1"; echo "$? $1" >"$logs/$(basename "$1").status"' sh '{}'
bad=0 drawn=0
for scene in "$@"; do
    read -r status name <"$logs/$(basename "$scene").status"
    drawn=$((drawn + 1))
    [ "$status" = 0 ] && continue
    bad=$((bad + 1))
    echo "not ok: $name ($([ "$status" = 9 ] && echo 'a value that was never written is used' || echo "status $status")):"
    head -n 40 "$logs/$(basename "$scene").log"
done
echo "$drawn scenes drawn, $bad with values that were never written"
[ "$bad" = 0 ]
