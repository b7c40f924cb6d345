#!/bin/sh
# pictures.sh BUILD OUT [NAME...]: draws the pictures of the manual, OUT/NAME.png; without names all of them. A picture is one of
#   - a block ```json of a page, with or without a file's name, in the line below <!-- picture: NAME -->: a whole scene;
#   - pictures/NAME.json: a scene that no page shows;
#   - a line "NAME | COMMAND" of pictures.txt: the command writes NAME.png; "-o NAME.png" is added to its end. For pictures of some size, NAME may
#     be NAME.webp.
# Scenes may name these files as assets: part.stl, a solid part; assembly.obj, six named parts; pawn.obj, ball.obj and egg.obj,
# the models of /v1/examples; gear.obj, housing.obj and bracket.obj; bricks.png and its maps. In scenes of pictures/, "@MODEL" stands for the
# members of a mesh by gallery/models.awk. OUT/work keeps scenes and files.
set -eu
zraster=$(realpath "$1/zraster")
rm -rf "$2/work"
mkdir -p "$2/work"
out=$(realpath "$2")
shift 2
root=$(cd "$(dirname "$0")/../.." && pwd)
docs=$root/clients/docs gallery=$root/clients/gallery examples=$root/server/page/examples
unset ZRASTER_SERVER
cd "$out/work"
mkdir -p bin
ln -sf "$zraster" bin/zraster
PATH=$PWD/bin:$PATH

# ---- files that scenes name ----

model() { awk -v model="$1" -f "$gallery/models.awk"; }
object() { for name; do printf '%s|%s\n' "$name" "$(model "$name")"; done | awk -f "$gallery/obj.awk"; }
for name in pawn ball egg; do awk -f "$examples/lathe.awk" "$examples/$name.profile" >$name.obj; done
for name in gear housing; do object $name >$name.obj; done
object base axle bearing wheel washer cap >assembly.obj
# An OBJ whose y points up becomes an STL whose z does, of the triangles of its faces.
awk 'function corner(k) { return sprintf("vertex %s %s %s ", x[k], -z[k], y[k]) }
    BEGIN { print "solid housing" }
    /^v/ { x[++n] = $2; y[n] = $3; z[n] = $4 }
    /^f/ { for (i = 3; i < NF; i++) print "facet normal 0 0 0 outer loop", corner($2) corner($i) corner($(i + 1)) "endloop endfacet" }
    END { print "endsolid housing" }' housing.obj >housing.stl
awk -f "$root/tests/support/part.awk" >part.stl
cp "$gallery"/bricks*.png "$docs/pictures/"*.obj "$docs/pictures/"*.awk "$docs/pictures/"*.map .

# ---- scenes ----

with_models() { # "@MODEL" becomes the members of a mesh
    while IFS= read -r line; do
        case $line in
        *'"@'*)
            name=${line#*\"@}
            printf '%s%s%s\n' "${line%%\"@*}" "$(model "${name%%\"*}")" "${name#*\"}"
            ;;
        *) printf '%s\n' "$line" ;;
        esac
    done
}
for scene in "$docs"/pictures/*.json; do
    [ -f "$scene" ] && with_models <"$scene" >"${scene##*/}"
done
find "$docs" -name '*.md' -exec awk '
    /^<!-- picture: [a-z0-9-]* -->$/ { name = $3; if (taken[name]++) fail("a second picture " name); next }
    name && /^```json( [^ ]+)?$/ { file = name ".json"; printf "" >file; inside = 1; name = ""; next }
    /^```/ { if (inside) close(file); inside = 0 }
    inside { print >file }
    name && !/^$/ { fail("no block of JSON follows the picture " name) }
    function fail(text) { print FILENAME ": " text >"/dev/stderr"; exit 1 }' {} +

# ---- pictures ----

fail() { # NAME
    echo "error: picture $1:" >&2
    cat log >&2
    exit 1
}
draw() { # NAME COMMAND FILE
    printf '%s\n' "$2" >"$1.sh"
    sh -e "$1.sh" >log 2>&1 || fail "$1"
    [ ! -s log ] || fail "$1"
    mv "$3" "$out/$3"
}
wanted() { # NAME NAMES
    case " $2 " in '  ' | *" $1 "*) return 0 ;; esac
    return 1
}
names=$*
for name in $names; do
    [ -f "$name.json" ] || grep -Eq "^$name(\.webp)? \|" "$docs/pictures.txt" || { echo "error: there is no picture $name" >&2; exit 1; }
done
for scene in *.json; do
    [ -f "$scene" ] || continue
    name=${scene%.json}
    grep -q "^$name |" "$docs/pictures.txt" && continue
    wanted "$name" "$names" && draw "$name" "zraster $scene --compress small -o $name.png" "$name.png"
done
while IFS= read -r line; do
    name=${line%% |*}
    case $line in '#'* | '') continue ;; esac
    wanted "${name%.webp}" "$names" || continue
    case $name in
    *.webp) draw "${name%.webp}" "${line#*| } -o $name" "$name" ;;
    *) draw "$name" "${line#*| } --compress small -o $name.png" "$name.png" ;;
    esac
done <"$docs/pictures.txt"
exit 0
