#!/bin/sh
# test_readme.sh BUILD: the README's blocks that begin with curl, sent to a daemon, as they are but for its address, with a
# part.stl to send. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
said=$work/said complained=$work/complained
readme=$(realpath README.md)

: >"$work/out"
"$build/zrasterd" --port 0 >"$work/out" 2>"$work/log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
server=$(address_in "$work/out") || { echo "$server"; exit 1; }
cd "$work" || exit 1
printf 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' >part.stl

# A block ends where a line is not indented.
awk '/^    curl / { ++n } !/^    / { inside = 0 } /^    curl / { inside = 1 } inside { print >("block" n) }' "$readme"
is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]; }
blocks=0
for block in block*; do
    blocks=$((blocks + 1))
    picture=$(sed -n 's/.* -o \([a-z]*\.png\).*/\1/p' "$block")
    sed "s|http://127.0.0.1:8080|$server|" "$block" >"$block.sh"
    sh "$block.sh" >said 2>complained
    status=$?
    verdict "curl, example $blocks of the README, ends with 0" [ "$status" = 0 ]
    verdict "and leaves $picture, a PNG" is_png "$picture"
done
verdict "there are two at least" [ "$blocks" -ge 2 ]
verdicts
