#!/bin/sh
# Negative tests: lets the renderer be wrong in the ways of mutants.txt, one at a time, and fails unless zraster-verify
# sees each. Prints TAP.
#
#   tests/reference/mutants.sh BUILD [mutant ...]      from the project's top folder; BUILD has a folder `mutant`
#
# HALF=1 or HALF=2: half of the table, so that two of these run at once; the second one also moves the reference itself.
set -u
build=$1 half=${HALF:-}
shift
verify=$build/mutant/zraster-verify
table=tests/reference/mutants.txt
logs=$build/mutant-logs$half
seed=7 # the corner that nine_corners loses is a rare one: this seed has it
number=0 failed=0
rm -rf "$logs"
mkdir -p "$logs" && : >"$logs/equal"

report() { # verdict, text
    number=$((number + 1))
    [ "$1" = ok ] || failed=1
    echo "$1 $number - mutant $2"
}

# The counts of the last line, as "coverage N depth N colour N".
counts_of() {
    sed -n 's/^total.* coverage \([0-9]*\) .* depth \([0-9]*\) .* colour \([0-9]*\) .*/coverage \1 depth \2 colour \3/p' "$1"
}

# Of scenes: " channels N"
channels_of() { sed -n 's/^total.*\( channels [0-9]*\).*/\1/p' "$1"; }

# NAME.json or KIND TRIANGLES, options
verify() {
    log=$logs/$number
    case $1 in
    *.json) scene=tests/scenes/$1 && shift && set -- "$scene" "$@" ;;
    *) kind=$1 triangles=$2 && shift 2 && set -- --kind "$kind" --triangles "$triangles" "$@" ;;
    esac
    # A mutant may make a loop that has no end.
    timeout 300 "$verify" --seed $seed --failures '' "$@" >"$log" 2>&1
}

# A camera that is off by a hundredth of a pixel on one side: every comparison must see it.
check_perturbed() {
    for options in '--driver llvmpipe' '--driver softpipe' '--transform independent'; do
        # shellcheck disable=SC2086
        verify several-meshes-and-materials.json $options --perturb 0.0003
        if [ $? -eq 1 ]; then verdict=ok; else verdict='not ok'; fi
        report "$verdict" "none, but the reference's camera is moved ($options)"
    done
}

# Light that is wrong on the reference's side, by one step of 255 or by about half a degree.
check_perturbed_light() {
    for lit in flat-lit.json gouraud-computed-normals.json two-sided-wave-gouraud.json lights-in-plenty.json \
        lamps-spots-flat.json lamps-fixed-functions.json; do
        for options in '--perturb-ambient 0.00392157' '--perturb-lights 0.01'; do
            # shellcheck disable=SC2086
            verify $lit $options
            status=$? counts=$(counts_of "$log")
            case $status:$counts in
            '1:coverage 0 depth 0 colour 0' | 1:) verdict='not ok' ;;
            '1:coverage 0 depth 0 colour '*) verdict=ok ;;
            *) verdict='not ok' ;;
            esac
            report "$verdict" "none, but the reference's light is wrong ($lit $options; $counts)"
        done
    done
}

# As floats, what is off by much less than a step of 255.
check_perturbed_floats() {
    for options in '--perturb 0.0003' '--perturb-ambient 0.000001' '--perturb-lights 0.000001'; do
        log=$logs/$number
        # shellcheck disable=SC2086
        timeout 300 "$verify" --seed $seed --kind none --floats 100 $options >"$log" 2>&1
        if [ $? -eq 1 ]; then verdict=ok; else verdict='not ok'; fi
        report "$verdict" "none, but the reference's floats are of another scene ($options; $(counts_of "$log"))"
    done
}

# A camera that is off by a thousandth of a pixel: each channel whose bound is one of rounding must see it.
check_perturbed_channels() {
    verify several-meshes-and-materials.json tests/scenes/textures-linear.json --perturb 0.00003
    status=$? seen=$(grep -c 'beyond [1-9].* losses' "$log") blind=$(grep -c 'beyond 0 .* losses' "$log")
    if [ "$status:$blind" = 1:0 ] && [ "$seen" -gt 0 ]; then verdict=ok; else verdict='not ok'; fi
    report "$verdict" "none, but the reference's camera is moved by very little ($seen channels see it, $blind do not)"
}

check() { # mutant, what is run, what must differ
    # Without a mutant all is equal, or a difference would prove nothing.
    if ! grep -qxF "$2" "$logs/equal"; then
        # shellcheck disable=SC2086
        verify $2 || { report 'not ok' "$1: $2 differs without it: $log"; return; }
        echo "$2" >>"$logs/equal"
    fi
    # shellcheck disable=SC2086
    verify $2 --mutant "$1"
    status=$?
    counts=$(counts_of "$log")$(channels_of "$log")
    shown=$(printf '%s\n' "$counts" | sed -n "s/.*$3 \([0-9]*\).*/\1/p")
    if [ $status -eq 1 ] && [ "${shown:-0}" -gt 0 ]; then
        report ok "$1, by $2 ($counts)"
    else
        report 'not ok' "$1, by $2: exit status $status, $3 was to differ: $counts"
    fi
}

is_wanted() { # mutant, those that were asked for
    wanted=$1
    shift
    [ $# -eq 0 ] && return 0
    for asked in "$@"; do [ "$asked" = "$wanted" ] && return 0; done
    return 1
}

# The rows of this half. Rows that run the same are in one half, which runs it once without a mutant.
rows() {
    awk -F' *@ *' -v half="$half" '
        /^#/ || NF < 3 { next }
        !($2 in number) { number[$2] = ++count }
        half == "" || number[$2] % 2 == half % 2' $table
}

if [ $# -eq 0 ] && [ "$half" != 1 ]; then
    check_perturbed
    check_perturbed_light
    check_perturbed_floats
    check_perturbed_channels
fi
rows >"$logs/rows"
while IFS='@' read -r name run shows; do
    name=${name% } run=${run# } run=${run% } shows=${shows# }
    is_wanted "$name" "$@" && check "$name" "$run" "$shows" </dev/null
done <"$logs/rows"

# older_mesa has a test of its own: zraster-verify-lines --fault all.
if [ $# -eq 0 ] && [ "$half" != 1 ]; then
    for name in $("$verify" --mutant list); do
        [ "$name" = older_mesa ] || grep -q "^$name @" $table || report 'not ok' "$name has no row in $table"
    done
fi
echo "1..$number"
exit $failed
