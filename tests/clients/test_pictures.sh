#!/bin/sh
# test_pictures.sh BUILD: the pictures of the manual are those that the program draws now. Prints TAP.
set -u
build=$1
work=$(mktemp -d)
pages=clients/docs shown=clients/docs/pictures
. tests/support/verdict.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT

check "every picture of the manual is drawn, without a warning" 0 $pages/pictures.sh "$build" "$work/drawn"
list() { (cd "$1" && ls ./*.png ./*.webp); }
list $shown >"$work/shown.txt"
list "$work/drawn" >"$work/drawn.txt"
check "those in $shown are the same ones" 0 cmp "$work/shown.txt" "$work/drawn.txt"

# Libraries that pack PNGs differ in bytes, never in pixels. Those of WebP differ in pixels, too.
is_todays() { # PICTURE OTHER
    cmp -s "$1" "$2" && return
    case $1 in *.webp)
        ${PYTHON:-/usr/bin/python3} tests/clients/alike.py "$1" "$2" >>"$said" 2>>"$complained"
        return
        ;;
    esac
    "$build/zraster" compare "$1" "$2" >>"$said" 2>>"$complained"
}
all_are_todays() {
    : >"$said"
    : >"$complained"
    while IFS= read -r name; do
        is_todays "$shown/$name" "$work/drawn/$name" || echo "$name differs: make doc-pictures draws it" >>"$complained"
    done <"$work/shown.txt"
    [ ! -s "$complained" ]
}
verdict "each has the pixels that are drawn now" all_are_todays
check "other pixels would be noticed" 4 "$build/zraster" compare "$work/drawn/camera-left.png" "$work/drawn/camera-right.png"

are_seen() {
    while IFS= read -r name; do
        grep -rqF "pictures/${name#./}" --include='*.md' README.md $pages || echo "no page shows $name" >>"$complained"
    done <"$work/shown.txt"
    [ ! -s "$complained" ]
}
: >"$complained"
verdict "a page shows each" are_seen
bytes=$(cat $shown/*.png $shown/*.webp | wc -c)
verdict "together they have at most 1.5 MB" [ "$bytes" -le 1500000 ]
verdicts
