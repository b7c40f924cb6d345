#!/bin/sh
# Negative tests: breaks the renderer in the ways of ablations.txt, one at a time,
# and fails unless zraster-verify sees each. Prints TAP.
#
#   tests/reference/ablate.sh [name ...]      from the project's top folder
#
# BUILD (build) is where the broken copies go; CC and CFLAGS are make's. As many at a time as there are cores.
set -u
build=${BUILD:-build}/ablation
base=$build/base
table=tests/reference/ablations.txt
seed=7 # the corner that clip-nine-corners loses is a rare one: this seed has it
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
unset MAKEFLAGS MFLAGS MAKELEVEL

# Kernels of all instruction sets come from one source, and test_isas holds them against each other: one will do.
isa=scalar
case $(uname -m) in
x86_64) for name in sse2 avx2 avx512vl; do grep -qw $name /proc/cpuinfo && isa=${name%vl}; done ;;
aarch64) isa=neon ;;
esac

report() { # verdict, text
    printf '%s - ablation %s\n' "$1" "$2"
}

# With mutants, so that lines can be compared with older Mesa, too.
compile() { # folder, flags to add
    if [ -n "$2" ]; then
        make -s -j "$cores" -C "$1" BUILD=build MUTANTS=1 isas="$isa" CFLAGS="${CFLAGS:--O2}" EXACT="$2" build/zraster-verify
    else
        make -s -j "$cores" -C "$1" BUILD=build MUTANTS=1 isas="$isa" CFLAGS="${CFLAGS:--O2}" build/zraster-verify
    fi >"$1/make.log" 2>&1
}

# Objects of the last run are kept: the copies have the times of the originals.
make_base() {
    mkdir -p "$base/tests" || return 1
    setting="${CC:-cc} ${CFLAGS:--O2} $isa"
    [ "$(cat "$base/setting" 2>/dev/null)" = "$setting" ] || rm -rf "$base/build"
    printf '%s\n' "$setting" >"$base/setting"
    rm -rf "$base/core" "$base/tests/reference" "$base/tests/scenes" "$base/tests/support"
    mkdir "$base/tests/support" || return 1
    cp -a Makefile core "$base/" && cp -a tests/reference tests/scenes "$base/tests/" &&
        cp -a tests/support/files.[ch] tests/support/png.[ch] tests/support/random.h "$base/tests/support/" && compile "$base" ""
}

# The counts of the last line, as "coverage N depth N colour N".
counts_of() {
    sed -n 's/^total.* coverage \([0-9]*\) .* depth \([0-9]*\) .* colour \([0-9]*\) .*/coverage \1 depth \2 colour \3/p' "$1"
}

# What the table says is to be run: a scene of tests/scenes, or a kind and its number of triangles.
verify() { # folder, NAME.json or KIND TRIANGLES, options
    folder=$1
    case $2 in
    *.json) scene=tests/scenes/$2 && shift 2 && set -- "$scene" "$@" ;;
    *) kind=$2 triangles=$3 && shift 3 && set -- --kind "$kind" --triangles "$triangles" "$@" ;;
    esac
    # A change may make a loop that has no end.
    timeout 300 "$folder/build/zraster-verify" --seed $seed --failures '' "$@" >"$folder/verify.log" 2>&1
}

# Without a change all must be equal, or a difference would prove nothing.
check_base() {
    sed '/^#/d; /^$/d' $table | cut -d@ -f4 | sort -u >"$base/runs"
    while read -r run; do
        # shellcheck disable=SC2086
        verify "$base" $run || { report 'not ok' "none: $run differs without any change"; return; }
    done <"$base/runs"
    report ok 'none (all equal)'
}

# A camera that is off by a hundredth of a pixel on one side: every comparison must see it.
check_perturbed() {
    for options in '--driver llvmpipe' '--driver softpipe' '--transform independent'; do
        # shellcheck disable=SC2086
        verify "$base" several-meshes-and-materials.json $options --perturb 0.0003
        if [ $? -eq 1 ]; then
            report ok "none, but the reference's camera is moved ($options)"
        else
            report 'not ok' "the reference's camera is moved, and $options does not see it: $base/verify.log"
        fi
    done
}

change_files() { # folder, files, sed expression
    for file in $2; do
        cp "$1/core/$file" "$1/before" && sed -E -i "$3" "$1/core/$file" || return 1
        cmp -s "$1/before" "$1/core/$file" && return 1
    done
    return 0
}

machine_fuses() {
    case $(uname -m) in
    x86_64) grep -qw fma /proc/cpuinfo ;;
    aarch64) true ;;
    *) false ;;
    esac
}

check_row() { # name, files, change, what is run, what must show
    folder=$build/$1
    flags=
    rm -rf "$folder"
    cp -a "$base" "$folder" || { report 'not ok' "$1: no copy"; return; }
    if [ "$2" = flags ]; then
        machine_fuses || { report ok "$1 # SKIP this machine has no fused multiply-add"; return; }
        flags=$3
        [ "$(uname -m)" = x86_64 ] || flags=${flags%-mfma}
        rm -rf "$folder/build/core/geometry" "$folder/build/core/raster" "$folder/build/core/shade"
    else
        change_files "$folder" "$2" "$3" || { report 'not ok' "$1: the expression changes nothing in one of: $2"; return; }
    fi
    compile "$folder" "$flags" || { report 'not ok' "$1: does not compile, see $folder/make.log"; return; }
    if cmp -s "$base/build/zraster-verify" "$folder/build/zraster-verify"; then
        report 'not ok' "$1: the program is the same as without the change"
        return
    fi
    # shellcheck disable=SC2086
    verify "$folder" $4
    status=$?
    counts=$(counts_of "$folder/verify.log")
    shown=$(printf '%s\n' "$counts" | sed -n "s/.*$5 \([0-9]*\).*/\1/p")
    if [ $status -eq 1 ] && [ "${shown:-0}" -gt 0 ]; then
        report ok "$1 ($counts)"
        rm -rf "$folder"
    else
        report 'not ok' "$1: exit status $status, $5 was to show: $counts"
    fi
}

is_wanted() { # name, names that were asked for
    wanted=$1
    shift
    [ $# -eq 0 ] && return 0
    for name_asked in "$@"; do [ "$name_asked" = "$wanted" ] && return 0; done
    return 1
}

# Of the rows that are wanted, those that nobody has taken yet; what each gives goes to a file of its own.
check_rows() { # names
    row=0
    while IFS='@' read -r name files change run shows; do
        case $name in '#'* | '') continue ;; esac
        name=${name% } files=${files% } change=${change% } shows=${shows# }
        files=${files# } change=${change# }
        row=$((row + 1))
        is_wanted "$name" "$@" || continue
        mkdir "$verdicts/$row.taken" 2>/dev/null || continue
        check_row "$name" "$files" "$change" "$run" "$shows" </dev/null >"$verdicts/$(printf %04d $row)"
    done <$table
}

make_base || { echo "Bail out! the renderer does not compile, see $base/make.log"; exit 2; }
verdicts=$build/verdicts
rm -rf "$verdicts"
mkdir "$verdicts"
{
    check_base
    [ $# -ne 0 ] || check_perturbed
} >"$verdicts/0000"
workers=0
while [ $workers -lt "$cores" ]; do
    check_rows "$@" &
    workers=$((workers + 1))
done
wait
cat "$verdicts"/[0-9][0-9][0-9][0-9] | awk '{ sub(/ - /, " " NR " - "); print } /^not ok/ { failed = 1 } END { print "1.." NR; exit failed }'
