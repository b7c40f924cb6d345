#!/bin/sh
# run.sh BUILD PART...: runs the tests of these parts and adds them up. A line for each
# part, "unit: 512 passed in 41 s, 70 s of processors", begun when it begins; else quiet but
# for what fails or was left out. Each test's output is kept in BUILD/test-logs/. All tests
# speak TAP. Ends with the twenty slowest programs and a line "N passed, N failed, N skipped", and with
# status 1 where one failed, or where a part ran no test at all. As many programs run at
# once as there are processors, and more of the parts whose programs mostly wait. Those of
# the part times, which ask how soon the daemon answers, run one by one.
set -u
build=$1
shift
data=${DATA:-../shared/data}
assimp=/usr/share/assimp/models
logs=$build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
: >"$logs/times"
passed=0 failed=0 skipped=0 names=' '

# A part's line stays open while it runs. say closes it: something comes in between.
part_begin() {
    printf '%s: ' "$part"
    : >"$logs/$part.list" >"$logs/$part.names"
    at_once=$(getconf _NPROCESSORS_ONLN)
    case $part in times) at_once=1 ;; server) at_once=4 ;; esac # three of them do nothing for 20 s
    open=yes since=$(date +%s) passed_before=$passed failed_before=$failed skipped_before=$skipped
}
say() {
    [ "$open" = no ] || echo
    open=no
    echo "$*"
}
part_end() {
    xargs -d '\n' -P "$at_once" -I LINE sh -c LINE <"$logs/$part.list"
    for name in $(cat "$logs/$part.names"); do collect; done
    [ "$open" = yes ] || printf '%s: ' "$part"
    f=$((failed - failed_before)) s=$((skipped - skipped_before))
    printf '%s passed' $((passed - passed_before))
    [ "$f" = 0 ] || printf ', %s failed' "$f"
    [ "$s" = 0 ] || printf ', %s skipped' "$s"
    cpu=$(sed "s|.*|$logs/&.tap.status|" "$logs/$part.names" | xargs tail -qn 1 | tr 'ms' '  ' | awk '{ s += 60 * ($1 + $3) + $2 + $4 } END { printf "%.0f", s }')
    echo " in $(($(date +%s) - since)) s, $cpu s of processors"
}

# run NAME COMMAND...: one program, to be run at the end of the part. No two have one NAME. No argument has a space.
run() {
    log=$logs/$1.tap
    case $names in *" $1 "*)
        say "run.sh: two programs are named $1"
        exit 2
        ;;
    esac
    names="$names$1 "
    echo "$1" >>"$logs/$part.names"
    shift
    echo "begin=\$(date +%s%N); env CMOCKA_MESSAGE_OUTPUT=TAP $* >'$log' 2>'$log.err' </dev/null; { echo \$? \$(((\$(date +%s%N) - begin) / 1000000)); times; } >'$log.status'" >>"$logs/$part.list"
}

# Adds up the program `name`: its TAP and its exit status.
collect() {
    log=$logs/$name.tap
    status='' ms=0
    read -r status ms <"$log.status"
    echo "$ms $name" >>"$logs/times"
    set -- $(awk '{ $0 = tolower($0) }
        /^(not )?ok.*# *skip/ { skipped++; next }
        /^ok / { passed++ }
        /^not ok / { failed++ }
        END { print passed + 0, failed + 0, skipped + 0 }' "$log")
    p=$1 f=$2 s=$3
    # A crash, a leak found at exit, or no test at all, is a failure that TAP cannot tell.
    if [ "$f" = 0 ] && { [ "$status" != 0 ] || [ $((p + s)) = 0 ]; }; then
        f=1
        echo "not ok - $name ended with status $status after $p passed tests" >>"$log"
    fi
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
    if [ "$f" != 0 ]; then
        say "FAILED in $name (all of its output: $log, $log.err):"
        grep -iE -A4 '^not ok ' "$log" | grep -viE '# *skip' | head -n 40
        tail -n 25 "$log.err"
    elif [ "$s" != 0 ]; then
        say "LEFT OUT in $name:"
        tail -n 5 "$log.err"
    fi
}

# Where zraster-verify draws lines as the Mesa at hand does.
programs=$(tests/reference/programs.sh "$build" 2>/dev/null) || programs=$build

# verify NAME PROGRAM ARGUMENT...: a comparison with the reference.
verify() {
    name=$1 program=$2
    shift 2
    run "$name" "$program" --tap --failures "$build/reference-failures" "$@"
}

for part in "$@"; do
    part_begin
    case $part in
    unit)
        for test in "$build"/tests/property/test_* "$build"/tests/unit/*/test_*; do # the longest first
            case $test in *.o | *.d) continue ;; esac
            name=${test#"$build"/tests/}
            run "$(echo "$name" | tr / -)" "ZRASTER_DATA=$data" "$test"
        done
        ;;
    fuzz)
        # No fuzzing: inputs that are known, so that targets go on to work and what was found once stays mended.
        rm -rf "$build/fuzz-seeds"
        if ! "$build/tests/fuzz/seeds" "$build/fuzz-seeds"; then
            failed=$((failed + 1))
            say "FAILED: the seeds were not written"
        fi
        for test in "$build"/tests/fuzz/fuzz_*; do
            case $test in *.o | *.d) continue ;; esac
            target=${test##*/fuzz_}
            run "fuzz-$target" "$test" "tests/fuzz/crashers/$target" --accepted "$build/fuzz-seeds/$target"
        done
        ;;
    make)
        run make tests/make/test_make.sh
        run floors tests/make/test_floors.sh
        run contract tests/make/test_contract.sh "$build"
        run calls tests/make/test_calls.sh "$build"
        run rows tests/make/test_rows.sh
        run library tests/make/test_library.sh "$build"
        run install tests/make/test_install.sh "$build"
        run service tests/make/test_service.sh "$build"
        ;;
    times | server)
        for test in "$build"/tests/server/test_*; do
            case $test in
            *.o | *.d) continue ;;
            */test_admission | */test_fair | */test_load | */test_streams) test_part=times ;;
            *) test_part=server ;;
            esac
            [ "$test_part" = "$part" ] || continue
            run "server-$(basename "$test")" "ZRASTERD=$build/zrasterd" "ZRASTER_DATA=$data" "$test"
        done
        if [ "$part" = server ]; then # the longest first
            for test in tests/server/test_fleet.py $(ls tests/server/test_*.py | grep -v fleet); do
                run "server-$(basename "$test" .py)" "${PYTHON:-/usr/bin/python3}" tests/python/run.py "$build" "$test"
            done
            for test in tests/server/test_*.sh; do
                run "server-$(basename "$test" .sh)" "$test" "$build"
            done
        fi
        ;;
    clients)
        run client "ZRASTERD=$build/zrasterd" "ZRASTER=$build/zraster" tests/clients/test_client.sh
        run command tests/clients/test_command.sh "$build"
        run same-bytes tests/clients/test_same_bytes.sh "$build"
        run documents tests/clients/test_documents.sh "$build"
        run facts tests/clients/test_facts.sh "$build"
        run encodings tests/clients/test_encodings.sh "$build"
        run large tests/clients/test_large.sh "$build"
        run wrong-lines tests/clients/test_wrong_lines.sh "$build"
        run array tests/batches/test_array.sh "$build"
        run manifests "${PYTHON:-/usr/bin/python3}" tests/python/run.py "$build" tests/batches/test_manifests.py
        run reference-pages tests/clients/test_reference.sh "$build"
        run guide "${PYTHON:-/usr/bin/python3}" tests/python/run.py "$build" tests/clients/test_guide.py
        ;;
    python)
        python=${PYTHON:-/usr/bin/python3}
        for test in tests/python/test_*.py; do
            run "python-$(basename "$test" .py)" "ZRASTER_DATA=$data" "$python" tests/python/run.py "$build" "$test"
        done
        ;;
    browser)
        run browser "${PYTHON:-/usr/bin/python3}" tests/python/run.py "$build" tests/browser/test_browser.py
        ;;
    reference)
        triangles=${REFERENCE_TRIANGLES:-120000}
        verify reference "$programs/zraster-verify" --triangles "$triangles" --floats 300
        verify reference-scenes "$programs/zraster-verify" tests/scenes clients/examples
        verify reference-parity "$programs/zraster-verify" --parity --kind polygons-clipped --triangles $((triangles / 20)) tests/scenes/many-corners.json
        verify reference-egl "$programs/zraster-verify-egl" --triangles $((triangles / 10)) tests/scenes clients/examples
        verify reference-softpipe "$programs/zraster-verify" --driver softpipe --triangles $((triangles / 20)) tests/scenes
        verify reference-transform "$programs/zraster-verify" --transform independent --triangles $((triangles / 10)) tests/scenes
        run reference-lines "$programs/zraster-verify-lines" --primitives "${REFERENCE_LINES:-100000}"
        ;;
    models)
        if [ -d "$data/models" ]; then
            verify reference-models "$programs/zraster-verify" --kind none --models "$data/models"
            verify reference-meshes "$programs/zraster-verify" --preset all "$data/models/suzanne.obj" "$data/models/fandisk.obj"
        else
            skipped=$((skipped + 6))
            say "LEFT OUT: stanford-bunny and teapot against Mesa, flat and smooth, suzanne and fandisk from all sides: there is no $data/models"
        fi
        if [ -d "$data/gltf/asset-generator" ]; then
            run gltf-models "${PYTHON:-/usr/bin/python3}" tests/reference/tables/gltf_models.py "$build" "$data/gltf/asset-generator"
        else
            skipped=$((skipped + 171))
            say "LEFT OUT: the models of the glTF Asset Generator: there is no $data/gltf/asset-generator"
        fi
        if [ -d "$assimp" ]; then
            verify reference-assimp "$programs/zraster-verify" --preset all "$assimp/OBJ/spider.obj" "$assimp/OBJ/concave_polygon.obj" \
                "$assimp/STL/Wuson.stl" "$assimp/STL/sphereWithHole.stl"
        else
            skipped=$((skipped + 4))
            say "LEFT OUT: four meshes of assimp-testmodels: there is no $assimp"
        fi
        ;;
    pictures)
        run gallery tests/clients/test_gallery.sh "$build"
        run pictures tests/clients/test_pictures.sh "$build"
        run labels tests/peers/labels.sh "$build"
        # Without the models it compares pictures of meshes of its own.
        run bench-pictures "ZRASTERD=$build/zrasterd" "$build/zraster-bench" --check-only --models "$data/models"
        ;;
    docs)
        run docs-1 HALF=1 tests/clients/test_docs.sh "$build"
        run docs-2 HALF=2 tests/clients/test_docs.sh "$build"
        ;;
    mutants)
        run mutants-1 HALF=1 tests/reference/mutants.sh "$build"
        run mutants-2 HALF=2 tests/reference/mutants.sh "$build"
        run line-faults "$build/mutant/zraster-verify-lines" --fault all --primitives 5000
        run fast tests/reference/fast.sh "$build"
        ;;
    *)
        echo "run.sh: no such part: $part" >&2
        exit 2
        ;;
    esac
    part_end
done

echo "slowest:"
sort -rn "$logs/times" | head -n 20 | awk '{ printf "%7.1f s  %s\n", $1 / 1000, $2 }'
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
