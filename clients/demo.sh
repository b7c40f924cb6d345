#!/bin/sh
# demo.sh BUILD: starts a daemon on a free port, sends it an example scene and a third-party mesh, and saves the pictures in
# BUILD/demo/.
set -eu
build=$1
out=$build/demo
scene=clients/examples/solids.json
mesh=/usr/share/assimp/models/OBJ/spider.obj
mkdir -p "$out"

. clients/start_daemon.sh

render() { "$build/zraster" render --server "$server" "$@"; }
echo "an example scene ($scene):"
render "$scene" --channel color -o "$out/solids-color.png"
render "$scene" --channel depth --encoding png16 -o "$out/solids-depth.png"
echo "a mesh from Debian's assimp-testmodels ($mesh):"
render "$mesh" --preset isometric --size 800x600 -o "$out/spider-color.png"
render "$mesh" --preset isometric --size 800x600 --channel depth --encoding png16 -o "$out/spider-depth.png"
