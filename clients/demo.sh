#!/bin/sh
# demo.sh BUILD: draws a third-party mesh and an example scene by the command, then sends them to a daemon on a free port. Saves
# the pictures in BUILD/demo/.
set -eu
build=$1
out=$build/demo
scene=clients/examples/solids.json
mesh=/usr/share/assimp/models/OBJ/spider.obj
mkdir -p "$out"
unset ZRASTER_SERVER

echo "a mesh from Debian's assimp-testmodels ($mesh), by the command:"
"$build/zraster" "$mesh" "$out/spider.png" --preset isometric -s 800x600 -v
echo "colour and depth of an example scene ($scene):"
"$build/zraster" "$scene" -c color,depth --encoding png16 -o "$out/" -v
echo "the same by the daemon:"
. clients/start_daemon.sh
# Sends the mesh, its materials and their textures as parts of one form.
folder=${mesh%/*}
set -- -F "scene=@$mesh;type=model/obj"
for part in spider.mtl $(tr -d '\r' <"$folder/spider.mtl" | sed -n 's|^ *map_Kd *\.*[/\\]*||p' | sort -u); do
    set -- "$@" -F "$part=@$folder/$part"
done
curl -sf "$server/v1/render?preset=isometric&width=800&height=600" "$@" -o "$out/spider-http.png"
"$build/zraster" "$scene" --server "$server" -o "$out/solids-http.png" -c color -v
cmp "$out/spider.png" "$out/spider-http.png" && cmp "$out/solids.png" "$out/solids-http.png" && echo "the same bytes: $out/"
