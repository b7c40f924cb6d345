#!/bin/sh
# run.sh BUILD PART...: runs the tests of these parts and adds them up. Quiet but for
# what fails or was left out; each test's output is kept in BUILD/test-logs/. All tests
# speak TAP. Ends with a line "N passed, N failed, N skipped", and with status 1 where
# one failed, or where a part ran no test at all.
set -u
build=$1
shift
data=${DATA:-../shared/data}
logs=$build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
passed=0 failed=0 skipped=0

# run NAME COMMAND...: one program, its TAP and its exit status.
run() {
    name=$1
    shift
    log=$logs/$name.tap
    CMOCKA_MESSAGE_OUTPUT=TAP "$@" >"$log" 2>"$log.err" </dev/null
    status=$?
    s=$(grep -ciE '^(not )?ok.*# *skip' "$log")
    p=$(grep -iE '^ok ' "$log" | grep -viE '# *skip' | wc -l)
    f=$(grep -iE '^not ok ' "$log" | grep -viE '# *skip' | wc -l)
    # A crash, a leak found at exit, or no test at all, is a failure that TAP cannot tell.
    if [ "$f" = 0 ] && { [ "$status" != 0 ] || [ $((p + s)) = 0 ]; }; then
        f=1
        echo "not ok - $name ended with status $status after $p passed tests" >>"$log"
    fi
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
    if [ "$f" != 0 ]; then
        echo "FAILED in $name (all of its output: $log, $log.err):"
        grep -iE -A4 '^not ok ' "$log" | grep -viE '# *skip' | head -n 40
        tail -n 25 "$log.err"
    elif [ "$s" != 0 ]; then
        echo "LEFT OUT in $name:"
        tail -n 5 "$log.err"
    fi
}

for part in "$@"; do
    case $part in
    unit)
        for test in "$build"/tests/unit/test_* "$build"/tests/property/test_*; do
            case $test in *.o | *.d) continue ;; esac
            ZRASTER_DATA=$data run "$(basename "$test")" "$test"
        done
        ;;
    server)
        for test in "$build"/tests/server/test_*; do
            case $test in *.o | *.d) continue ;; esac
            ZRASTERD=$build/zrasterd ZRASTER_DATA=$data run "server-$(basename "$test")" "$test"
        done
        ;;
    clients) ZRASTERD=$build/zrasterd ZRASTER=$build/zraster run client tests/clients/test_client.sh ;;
    reference)
        run reference "$build/zraster-verify" --tap --triangles "${REFERENCE_TRIANGLES:-210000}" --failures "$build/reference-failures"
        run reference-lines "$build/zraster-verify-lines" --primitives "${REFERENCE_LINES:-100000}"
        run reference-line-faults "$build/zraster-verify-lines" --fault all --primitives 5000
        ;;
    models)
        if [ -d "$data/models" ]; then
            run reference-models "$build/zraster-verify" --tap --kind none --models "$data/models" --failures "$build/reference-failures"
            ZRASTERD=$build/zrasterd run bunny-over-http "$build/zraster-bench" --check-only --models "$data/models"
        else
            skipped=$((skipped + 5))
            echo "LEFT OUT: stanford-bunny and teapot against OSMesa, flat and smooth, and the bunny over HTTP: there is no $data/models"
        fi
        ;;
    ablations) run ablations env BUILD="$build" tests/reference/ablate.sh ;;
    *)
        echo "run.sh: no such part: $part" >&2
        exit 2
        ;;
    esac
done

echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
