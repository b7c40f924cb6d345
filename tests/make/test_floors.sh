#!/bin/sh
# The floors of core/, with server/ and clients/ above them, and the rooms of its folders: a file includes only its own
# room and lower ones, so that no includes of rooms go in a circle; nor do those of files. So the pipeline can be read
# from top to bottom, and a step can be tested without later ones.
# Prints TAP.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/support/verdict.sh
said=$work/said complained=$work/complained

# Faults that are there today. This list only shrinks: a line that is no fault any more fails, too.
cat >"$work/known" <<'END'
END
: >"$work/none"

# The top level: four folders, and the files that a reader looks for there. `build` is made.
strange() { ls "$1" | grep -vxE 'build|clients|core|server|tests|CHANGELOG\.md|Dockerfile|LICENSE|Makefile|README\.md' >"$said"; }
verdict "the top level has nothing else" eval '! strange .'
mkdir -p "$work/top/core" "$work/top/make"
verdict "where another folder would be found" eval 'strange "$work/top" && grep -qx make "$said"'

floors() { # FOLDER KNOWN: of core/, server/ and clients/ in this folder
    (cd "$1" && find core server clients -name '*.[ch]' ! -path 'clients/reference/*' ! -path 'clients/examples/*' | sort | xargs awk -v known="$2" -f "$script") >"$said" 2>"$complained"
    status=$?
}
script=$PWD/tests/make/floors.awk
lacks() { [ ! -s "$complained" ] && ! grep -q "$1" "$said"; } # an awk that fails says nothing either
finds() { # LINE...: these, and no others
    printf '%s\n' "$@" | sort >"$work/want"
    sort "$said" | cmp -s - "$work/want" && [ "$status" != 0 ]
}

floors . "$work/known"
verdict "no higher floor is included" lacks "of a higher floor"
verdict "nor a higher room" lacks "of a higher room"
verdict "nor a room beside" lacks "of a room beside it"
verdict "there is no circle" lacks "in a circle"
verdict "each fault that is known is there" lacks "is known"
verdict "and nothing else is wrong" [ "$status" = 0 ]

# Made-up trees, each with one fault: proof that it is found.
file() { # NAME INCLUDED...
    case $1 in server/* | clients/*) path=$work/tree/$1 ;; *) path=$work/tree/core/$1 ;; esac
    shift
    mkdir -p "${path%/*}"
    for included in "$@"; do echo "#include \"$included\""; done >"$path"
}
tree() { # one without a fault
    rm -rf "$work/tree"
    file base/vec.h
    file base/vec.c base/vec.h
    file core.h base/vec.h
    file scene/scene.h base/vec.h core.h
    file scene/nodes.h scene/scene.h
    file scene/nodes.c scene/nodes.h
    file scene/camera/pose.h scene/scene.h
    file input/json/json.h scene/scene.h
    file input/ply/ply.c input/json/json.h
    file raster/bins.h scene/nodes.h scene/camera/pose.h
    file raster/bins_kernel.c raster/bins.h base/vec.h
    file shade/paint.h raster/bins.h
    file render/render.c shade/paint.h core.h
    file server/answer.h
    file server/problem.h answer.h base/vec.h
    file server/problem.c problem.h core.h
    file clients/post.h core.h
    file clients/post.c post.h
}
made_up() { floors "$work/tree" "${1:-$work/none}"; }
tree
made_up
verdict "a tree without a fault passes" [ "$status" = 0 ]

tree
file raster/bins.c raster/bins.h shade/paint.h
file shade/paint.h
made_up
verdict "a higher floor is found" finds "raster/bins.c includes shade/paint.h of a higher floor"
echo "raster/bins.c shade/paint.h painted early" >"$work/one"
made_up "$work/one"
verdict "and passed over where it is known" [ "$status" = 0 ]
echo "raster/bins.c shade/paint.h" >"$work/one"
made_up "$work/one"
verdict "but not without a reason" finds "raster/bins.c shade/paint.h is known, without a reason"

tree
file scene/nodes.h scene/scene.h scene/camera/pose.h
made_up
verdict "a higher room of a folder is found" finds "scene/nodes.h includes scene/camera/pose.h of a higher room"
echo "scene/nodes.h scene/camera/pose.h poses of nodes" >"$work/one"
made_up "$work/one"
verdict "and passed over where it is known" [ "$status" = 0 ]

tree
file input/ply/ply.h
file input/stl/stl.c input/ply/ply.h
made_up
verdict "a room beside is found" finds "input/stl/stl.c includes input/ply/ply.h of a room beside it"

tree
file overlay/bar.h
file effects/ground.c overlay/bar.h
made_up
verdict "and a folder beside" finds "effects/ground.c includes overlay/bar.h of a room beside it"

tree
file base/vec.h core.h
file core.h
made_up
verdict "base is below the public headers" finds "base/vec.h includes core.h of a higher floor"

tree
file scene/scene.h scene/pose.h
file scene/pose.h nodes.h
made_up
verdict "a circle of headers is found, by a name without its folder too" finds "scene/scene.h includes scene/pose.h in a circle" \
    "scene/pose.h includes scene/nodes.h in a circle" "scene/nodes.h includes scene/scene.h in a circle"
echo "scene/scene.h scene/pose.h one line is enough" >"$work/one"
made_up "$work/one"
verdict "and passed over where one of its lines is known" [ "$status" = 0 ]

tree
file scene/scene.c scene/scene.h scene/nodes.h
made_up
verdict "a circle through a .c is found" finds "scene/scene.c includes scene/nodes.h in a circle" \
    "scene/nodes.h includes scene/scene.h in a circle"

tree
file scene/nodes.h scene/nodes.h
made_up
verdict "a header that includes itself is found" finds "scene/nodes.h includes scene/nodes.h in a circle"

tree
echo "scene/nodes.c scene/pose.h gone" >"$work/one"
made_up "$work/one"
verdict "a known fault that is gone is found" finds "scene/nodes.c scene/pose.h is known, and is not there"
echo "scene/nodes.h scene/scene.h mended on the other side" >"$work/one"
made_up "$work/one"
verdict "and one that is no fault any more" finds "scene/nodes.h scene/scene.h is known, and is no fault"

tree
file server/answer.c answer.h problem.h
made_up
verdict "a circle in server/ is found" finds "server/answer.c includes server/problem.h in a circle" \
    "server/problem.h includes server/answer.h in a circle"

tree
file clients/engine.c engine.h post.h
file clients/engine.h
file clients/post.c post.h engine.h
made_up
verdict "a circle in clients/ is found" finds "clients/engine.c includes clients/post.h in a circle" \
    "clients/post.c includes clients/engine.h in a circle"

tree
file scene/nodes.c server/problem.h
made_up
verdict "server/ is above core/" finds "scene/nodes.c includes server/problem.h of a higher floor"

tree
file scene/nodes.c ../tools/cli.h
file sound/horn.h base/vec.h
made_up
verdict "files of no floor, and folders without one, are found" \
    finds "scene/nodes.c includes ../tools/cli.h, which is in none of these folders" "sound/horn.h is in a folder that has no floor"

rm -rf "$work/tree"
file base/vec.h
mkdir -p "$work/tree/server" "$work/tree/clients"
made_up
verdict "files without an #include are no proof" finds "no #include was read"
verdicts
