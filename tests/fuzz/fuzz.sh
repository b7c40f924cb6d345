#!/bin/sh
# fuzz.sh BUILD SECONDS [TARGET...]: lets libFuzzer make inputs up for each target, for so long. It begins with the
# seeds, what crashed before (tests/fuzz/crashers), and what earlier runs kept in BUILD/corpus. What ends a target, or
# takes it longer than 120 s, by a clock that does not know what else the machine does, is kept in BUILD/found, and fails.
# Prints TAP, and a line "N passed, N failed, N skipped".
set -u
build=$1 seconds=$2
shift 2
mkdir -p "$build/found" "$build/logs"
"$build/tests/fuzz/seeds" "$build/seeds" || exit 1
# Words of the contract and of the scenes, quotes included, is what a dictionary of libFuzzer has.
grep -oh '"[A-Za-z0-9]*"' server/api/v1.md tests/scenes/*.json | sort -u >"$build/words"
[ $# -gt 0 ] || set -- $(cd tests/fuzz && ls fuzz_*.c | sed 's/^fuzz_\(.*\)\.c$/\1/')
passed=0 failed=0
for target in "$@"; do
    corpus=$build/corpus/$target log=$build/logs/$target crashers=tests/fuzz/crashers/$target words=
    mkdir -p "$corpus"
    [ -d "$crashers" ] || crashers=
    [ "$target" != json ] || words="-dict=$build/words"
    "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=120 -rss_limit_mb=2048 -max_len=16384 \
        -print_final_stats=1 -artifact_prefix="$build/found/$target-" $words \
        "$corpus" "$build/seeds/$target" $crashers >"$log" 2>&1 </dev/null
    status=$?
    inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    if [ "$status" = 0 ] && [ "${inputs:-0}" -gt 0 ]; then
        passed=$((passed + 1))
        echo "ok $((passed + failed)) - $target: $inputs inputs in $seconds s, $(ls "$corpus" | wc -l) kept"
    else
        failed=$((failed + 1))
        echo "not ok $((passed + failed)) - $target ended with status $status after ${inputs:-some} inputs; all of its output: $log"
        grep -E 'ERROR|SUMMARY|runtime error|fuzz: not so|Test unit written' "$log"
    fi
done
echo "1..$((passed + failed))"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" = 0 ]
