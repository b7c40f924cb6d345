#!/bin/sh
# Fast ways give the bytes of the general way: runs the cases of fast.txt with all fast ways, where the case's own must be
# taken, and without it, and holds both against the reference. Prints TAP.
#
#   tests/reference/fast.sh BUILD      from the project's top folder; BUILD has a folder `mutant`
set -u
verify=$1/mutant/zraster-verify
table=tests/reference/fast.txt
log=$1/fast.log
number=0 failed=0

report() { # verdict, text
    number=$((number + 1))
    [ "$1" = ok ] || failed=1
    echo "$1 $number - fast way $2"
}

verify() { # as fast.txt has it
    case $1 in
    */*.json) ;;
    *.json) scene=tests/scenes/$1 && shift && set -- "$scene" "$@" ;;
    *) kind=$1 triangles=$2 && shift 2 && set -- --kind "$kind" --triangles "$triangles" "$@" ;;
    esac
    timeout 300 "$verify" --failures '' "$@" >"$log" 2>&1
}

while IFS='@' read -r name run; do
    case $name in '#'* | '') continue ;; esac
    name=${name% } run=${run# }
    # shellcheck disable=SC2086
    verify $run --without list </dev/null
    status=$? taken=$(sed -n "s/^$name //p" "$log")
    # shellcheck disable=SC2086
    verify $run --without "$name" </dev/null
    if [ "$status:$?" = 0:0 ] && [ "${taken:-0}" -gt 0 ]; then
        report ok "$name, by $run (taken $taken times)"
    else
        report 'not ok' "$name, by $run: taken ${taken:-?} times, or not equal with or without it"
    fi
done <$table

verify tiny-window.json --without list
for name in $(sed -n 's/^\([a-z_]*\) [0-9]*$/\1/p' "$log"); do
    grep -q "^$name @" $table || report 'not ok' "$name has no row in $table"
done
echo "1..$number"
exit $failed
