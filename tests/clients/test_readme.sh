#!/bin/sh
# test_readme.sh BUILD: the README's blocks that begin with the command or with curl, as they are but for the daemon's address,
# in a folder with a part.stl. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
said=$work/said complained=$work/complained
readme=$(realpath README.md)
unset ZRASTER_SERVER

: >"$work/out"
"$build/zrasterd" --port 0 >"$work/out" 2>"$work/log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
server=$(address_in "$work/out") || { echo "$server"; exit 1; }
mkdir "$work/in"
cd "$work/in" || exit 1
ln -s "$build" build
printf 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' >part.stl

# A block ends where a line is not indented.
awk '/^    (curl|build\/zraster) / && !inside { ++n; inside = 1 } !/^    / { inside = 0 } inside { print >("block" n) }' "$readme"
is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]; }
blocks=0
for block in block*; do
    blocks=$((blocks + 1))
    sed "s|http://127.0.0.1:8080|$server|" "$block" >"$block.sh"
    sh -e "$block.sh" >"$said" 2>"$complained"
    status=$?
    verdict "example $blocks of the README ends with 0: $(head -n 1 "$block")" [ "$status" = 0 ]
done
for picture in part iso pipe out/part pictures/part triangle; do
    verdict "$picture.png is there" is_png "$picture.png"
done
verdict "the examples are four at least" [ "$blocks" -ge 4 ]
verdicts
