#!/bin/sh
# demo.sh BUILD: draws a mesh and an example scene by the command, and again by the daemon if it is built. Saves the pictures in
# BUILD/demo/.
set -eu
build=$1
out=$build/demo
scene=clients/examples/solids.json
mesh=$out/gear.obj
mkdir -p "$out"
unset ZRASTER_SERVER
LC_ALL=C awk -f server/page/examples/lathe.awk server/page/examples/wheel.profile >"$mesh"

echo "a mesh ($mesh), by the command:"
"$build/zraster" "$mesh" "$out/gear.png" --preset isometric -s 800x600 -v
echo "colour and depth of an example scene ($scene):"
"$build/zraster" "$scene" -c color,depth --encoding png16 -o "$out/" -v
if ! [ -x "$build/zrasterd" ]; then
    echo "the pictures: $out/ ('make packages' and 'make' build the daemon, the library and the manual, too)"
    exit 0
fi
echo "the same by the daemon:"
. clients/start_daemon.sh
"$build/zraster" "$mesh" "$out/gear-http.png" --server "$server" --preset isometric -s 800x600 -v
"$build/zraster" "$scene" --server "$server" -o "$out/solids-http.png" -c color -v
cmp "$out/gear.png" "$out/gear-http.png" && cmp "$out/solids.png" "$out/solids-http.png" && echo "the same bytes: $out/"
