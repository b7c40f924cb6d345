#!/bin/sh
# labels.sh BUILD: tesseract reads 200 dimension labels in letters of strokes, 8 to 22 pixels high. Prints TAP.
#
# Its model of Latin letters knows neither × nor ±, and has no small letters beside an ø to tell it from Ø, so that it reads
# both or either: x, + and any of them count. Blanks do not.
set -u
build=$1
labels=$(dirname "$0")/labels.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/support/verdict.sh
said=$work/said complained=$work/complained
: >"$said"
: >"$complained"
export LC_ALL=C OMP_THREAD_LIMIT=1

if ! tesseract --list-langs 2>/dev/null | grep -q -E '^(script/)?Latin$'; then
    skip "tesseract reads the labels" "there is no tesseract with its model Latin (apt-get install tesseract-ocr tesseract-ocr-script-latn)"
    verdicts
    exit
fi
model=$(tesseract --list-langs 2>/dev/null | grep -E '^(script/)?Latin$' | head -n 1)

plain() { sed -e 's/ //g' -e 's/×/x/g' -e 's/X/x/g' -e 's/±/+/g' -e 's/\(ø\|Ø\)\{1,\}/ø/g'; }
plain <"$labels" >"$work/wanted"
all=$(wc -l <"$labels")

read_labels() { # HEIGHT SCALE: prints how many are wrong
    mkdir -p "$work/$1"
    "$build/zraster-labels" "$1" "$2" "$work/$1" <"$labels" || return
    ls "$work/$1"/*.pgm >"$work/$1/list.txt"
    tesseract "$work/$1/list.txt" "$work/$1/out" -l "$model" --psm 7 2>/dev/null || return
    awk 'BEGIN { RS = "\f" } { gsub(/\n/, ""); print }' "$work/$1/out.txt" | plain >"$work/$1/read"
    [ "$(wc -l <"$work/$1/read")" = "$all" ] || return
    paste "$work/wanted" "$work/$1/read" | awk -F '\t' '$1 != $2 { print "height '"$1"': " $1 " is read as " $2 }' >"$work/$1/wrong"
    cat "$work/$1/wrong" >>"$said"
    wc -l <"$work/$1/wrong"
}

wrong=0
for pair in 8:4 9:4 11:3 16:2 22:2; do
    height=${pair%:*}
    missed=$(read_labels "$height" "${pair#*:}") || missed=
    echo "# $height pixels: $((all - ${missed:-all})) of $all"
    wrong=$((wrong + ${missed:-all}))
    verdict "of $all labels with letters of $height pixels, at least 95 % are read" [ "${missed:-$all}" -le $((all / 20)) ]
done
verdict "of all of them at least 98 %" [ "$wrong" -le $((5 * all / 50)) ]
cat "$said" >&2
verdicts
