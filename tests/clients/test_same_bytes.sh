#!/bin/sh
# test_same_bytes.sh BUILD: the command gives the bytes of POST /v1/render, in its own process and by --server: scenes of
# tests/scenes, and every look of models. SAME=all: all scenes, and three models of DATA; else every tenth scene, and a
# small model. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
out=$work said=$work/said complained=$work/complained
. clients/start_daemon.sh
trap 'kill "$daemon" 2>/dev/null; wait "$daemon" 2>/dev/null; rm -rf "$work"' EXIT
unset ZRASTER_SERVER
: >"$said"
: >"$complained"

same() { # FILE QUERY OPTION...
    file=$1 query=$2
    shift 2
    curl -sf --data-binary @"$file" "$server/v1/render?$query" -o "$work/http" || return 1
    "$build/zraster" "$file" -o - "$@" >"$work/here" 2>>"$complained" && cmp "$work/http" "$work/here" >>"$said" || return 1
    "$build/zraster" "$file" -o - --server "$server" "$@" >"$work/there" 2>>"$complained" && cmp "$work/http" "$work/there" >>"$said"
}

count_scenes=0
for scene in tests/scenes/*.json; do
    count_scenes=$((count_scenes + 1))
    [ "${SAME:-}" = all ] || [ $((count_scenes % 10)) = 1 ] || continue
    verdict "$scene" same "$scene" ''
done

models="$work/part.obj"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nv 0.5 0.5 1\nf 1 2 3 4\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >"$work/part.obj"
if [ "${SAME:-}" = all ]; then
    data=${DATA:-../shared/data}/models
    models="$data/stanford-bunny.obj $data/suzanne.obj $data/teapot.obj"
fi
for model in $models; do
    for look in $("$build/zraster" looks); do
        verdict "${model##*/} in the look $look" same "$model" "look=$look&width=200&height=150" --look "$look" -s 200x150
    done
done
verdict "several channels of a model" same "$work/part.obj" 'channel=color,depth,instanceId,info&encoding=png16' -c color,depth,instanceId,info --encoding png16
verdict "and of a scene" same tests/scenes/nodes-hierarchy.json 'channel=normals,faceId' --channel normals,faceId
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n' >"$work/face.ply"
verdict "and of PLY" same "$work/face.ply" 'width=200&height=150' -s 200x150
parts() {
    "$build/zraster" "$work/plain.json" -c color,windowDepth -o "$work/" || return 1
    curl -sf "$server/v1/render" -F "scene=<$work/over.json;type=application/json" -F color=@"$work/plain.png" \
        -F z=@"$work/plain.windowDepth.npy" -o "$work/http" || return 1
    for where in '' "$server"; do
        ZRASTER_SERVER=$where "$build/zraster" "$work/over.json" -o - --part color="$work/plain.png" \
            --part z="$work/plain.windowDepth.npy" | cmp "$work/http" - || return 1
    done
}
beside() {
    cp "$work/plain.png" "$work/color" && cp "$work/plain.windowDepth.npy" "$work/z" || return 1
    for where in '' "$server"; do
        ZRASTER_SERVER=$where "$build/zraster" "$work/over.json" -o - | cmp "$work/http" - || return 1
    done
}
triangle='"window": {"width": 8, "height": 8}, "view": {"preset": "front", "znear": 1, "zfar": 9}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]'
echo "{$triangle}" >"$work/plain.json"
echo "{$triangle, \"base\": {\"color\": {\"asset\": \"color\"}, \"windowDepth\": {\"asset\": \"z\"}}}" >"$work/over.json"
verdict "files by --part are parts of a form" parts
verdict "and so are those beside the scene" beside
verdicts
