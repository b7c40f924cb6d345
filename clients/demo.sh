#!/bin/sh
# demo.sh BUILD: starts a daemon on a free port, sends it an example scene and a mesh that
# others made, and leaves the pictures in BUILD/demo/.
set -eu
build=$1
out=$build/demo
scene=clients/examples/solids.json
mesh=/usr/share/assimp/models/OBJ/spider.obj
mkdir -p "$out"

"$build/zrasterd" --port 0 >"$out/daemon.out" 2>"$out/daemon.log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null || true; wait "$daemon" 2>/dev/null || true' EXIT
tries=0
until server=$(sed -n 's/^listening on //p' "$out/daemon.out") && [ -n "$server" ]; do
    tries=$((tries + 1))
    if [ "$tries" -gt 100 ] || ! kill -0 "$daemon" 2>/dev/null; then
        echo "error: the daemon did not start:" >&2
        cat "$out/daemon.log" >&2
        exit 1
    fi
    sleep 0.05
done

render() { "$build/zraster" render --server "$server" "$@"; }
echo "an example scene ($scene):"
render "$scene" --channel color -o "$out/solids-color.png"
render "$scene" --channel depth --encoding png16 -o "$out/solids-depth.png"
echo "a mesh from Debian's assimp-testmodels ($mesh):"
render "$mesh" --preset isometric --size 800x600 -o "$out/spider-color.png"
render "$mesh" --preset isometric --size 800x600 --channel depth --encoding png16 -o "$out/spider-depth.png"
