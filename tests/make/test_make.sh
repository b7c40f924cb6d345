#!/bin/sh
# Messages of `make` without a compiler, and of `make test` about its parts. Prints TAP.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MAKELEVEL MFLAGS CC
. tests/support/verdict.sh
said=$work/said complained=$work/complained

# A machine without a compiler: only the programs that the Makefile calls before it compiles.
mkdir "$work/bin"
for program in make sh echo getconf grep mkdir tr uname; do
    ln -s "$(command -v "$program")" "$work/bin/$program"
done
PATH=$work/bin make -j2 BUILD="$work/build" >"$work/said" 2>"$work/complained"
status=$?
verdict "make without a compiler ends with 2" [ "$status" = 2 ]
verdict "and names make packages" grep -q "no C compiler (cc) here; 'make packages' installs what is missing" "$work/complained"
verdict "once, in two lines at most" [ "$(wc -l <"$work/complained")" -le 2 ]
PATH=$work/bin make CC=no-such-gcc BUILD="$work/build" >"$work/said" 2>"$work/complained"
verdict "a compiler that was asked for is named" grep -q "no C compiler (no-such-gcc) here" "$work/complained"

# What `make demo` compiles for one instruction set, a later `make` takes.
compilations() { make -n BUILD="$work/none" "$@" "$work/none/zraster" 2>"$complained" | grep -e ' -c -o ' | sort >"$said"; }
compilations isas=scalar
mv "$said" "$work/one"
compilations
comm -23 "$work/one" "$said" >"$work/twice"
verdict "an instruction set alone is compiled" [ -s "$work/one" ]
verdict "as it is among all" [ ! -s "$work/twice" ]

# A frame larger than a page must not pass the guard page of a thread's stack.
if cc -fstack-clash-protection -Werror -fsyntax-only -x c /dev/null 2>"$complained"; then
    verdict "each compilation probes its frames" [ "$(grep -vc -e ' -fstack-clash-protection ' "$work/one")" = 0 ]
else
    skip "each compilation probes its frames" "the compiler cannot"
fi

# Parts, of programs that speak TAP.
program() { # NAME LINE...: one that prints the lines
    path=$work/fake/tests/$1
    shift
    { echo '#!/bin/sh'; printf 'echo "%s"\n' "$@"; } >"$path"
    chmod +x "$path"
}
mkdir -p "$work/fake/tests/unit/room" "$work/fake/tests/property"
program property/test_a "ok 1 - one" "ok 2 - two"
program unit/room/test_b "ok 1 - three" "ok 2 - four # SKIP not here"
parts() { DATA=$work tests/run.sh "$work/fake" unit >"$work/said" 2>"$work/complained"; }
parts
status=$?
verdict "tests that pass end with 0" [ "$status" = 0 ]
verdict "a part is reported with its times" grep -Eq '^unit: 3 passed, 1 skipped in [0-9]+ s, [0-9]+ s of processors$' "$work/said"
verdict "and the last line has the sums" [ "$(tail -n 1 "$work/said")" = "3 passed, 0 failed, 1 skipped" ]
program unit/room/test_b "ok 1 - three"
parts
verdict "a part that just passes is one line" [ "$(grep -v ' s  ' "$work/said" | sed 's/ in .*//')" = "unit: 3 passed
slowest:
3 passed, 0 failed, 0 skipped" ]
program property/test_a "ok 1 - one" "ok 2 - two"
echo 'sleep 0.2' >>"$work/fake/tests/property/test_a"
parts
verdict "the slowest programs are listed, the slowest first" [ "$(sed -n 's/^ *[0-9.]* s  //p' "$work/said" | xargs)" = "property-test_a unit-room-test_b" ]
program unit/room/test_b "ok 1 - three" "not ok 2 - four"
parts
status=$?
verdict "a test that fails ends with 1" [ "$status" = 1 ]
verdict "is reported" grep -q '^FAILED in unit-room-test_b' "$work/said"
verdict "and counted in its part" grep -Eq '^unit: 3 passed, 1 failed in [0-9]+ s, [0-9]+ s of processors$' "$work/said"
verdict "and in the last line" [ "$(tail -n 1 "$work/said")" = "3 passed, 1 failed, 0 skipped" ]
program property/test_b "not ok 1 - five"
program unit/room/test_b "ok 1 - three"
parts
verdict "two rooms may have tests of one name" [ "$(tail -n 1 "$work/said")" = "3 passed, 1 failed, 0 skipped" ]
verdicts
