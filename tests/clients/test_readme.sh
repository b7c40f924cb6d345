#!/bin/sh
# test_readme.sh BUILD: the README's blocks that begin with the command or with curl, as they are but for the daemon's address,
# in a folder with a part.stl. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
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
triangle >part.stl

# A block ends where a line is not indented.
awk '/^    (curl|build\/zraster) / && !inside { ++n; inside = 1 } !/^    / { inside = 0 } inside { print >("block" n) }' "$readme"
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
verdict "there are at least 4 examples" [ "$blocks" -ge 4 ]
verdicts
