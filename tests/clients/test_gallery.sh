#!/bin/sh
# test_gallery.sh BUILD: the gallery has a picture of every scene, no feature leaves its picture as it was, and the README
# shows what this version draws. Prints TAP.
set -u
build=$1
out=$build/gallery
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
said=$work/said complained=$work/complained
unset ZRASTER_SERVER
trap 'rm -rf "$work"' EXIT

clients/gallery/gallery.sh "$build" >"$said" 2>"$complained"
status=$?
verdict "every scene of the gallery is drawn" [ "$status" = 0 ]

# Pictures of printed parts need meshes that are not in the repository. Where they are missing, a line for each says so.
parts_left_out() { grep -c '^LEFT OUT: the picture printed-[a-z]*: there is no .*\.stl' "$1"; }
left_out=$(parts_left_out "$complained")
without_parts() {
    [ "$left_out" = 3 ] && return
    mkdir "$work/build" && ln -s "$(cd "$build" && pwd)/zraster" "$work/build/zraster"
    DATA=$work/nothing clients/gallery/gallery.sh "$work/build" >>"$said" 2>"$work/without" &&
        [ "$(parts_left_out "$work/without")" = 3 ] && [ ! -e "$work/build/gallery/printed-fan.png" ]
}
verdict "without the meshes of printed parts, their pictures are left out, and it is said" without_parts

scenes=$(grep -c '^[a-z][a-z0-9.-]* |' clients/gallery/scenes.txt)
names=$(sed -n 's/^<figure[^>]*><a href="\([^"]*\)\.png".*/\1/p' "$out/index.html")
shown=$(echo "$names" | wc -l)
verdict "the page shows an assembly, $scenes scenes, 2 grids of balls, lamps, parts, several views, printed parts, and a colour bar" [ "$shown" = $((7 + scenes + 19 - left_out)) ]
verdict "the assembly is first" [ "$(echo "$names" | head -n 1)" = cutaway ]
anchors_lead() { for id in $(sed -n 's/<a href="#/\n#/gp' "$out/index.html" | sed -n 's/^#\([a-z-]*\)".*/\1/p'); do grep -q "<section id=\"$id\"" "$out/index.html" || return 1; done; }
verdict "its contents lead to the sections" anchors_lead
# The command below a picture, run beside the files.
draws_again() { # NAME
    rm -rf "$work/again" && mkdir "$work/again" && cp "$out"/*.json "$out"/*.obj "$work/again"
    line=$(sed -n "s|^<figure[^>]*><a href=\"$1\.png\".*<code class=\"command\">zraster \([^<]*\)</code>.*|\1|p" "$out/index.html")
    zraster=$(realpath "$build/zraster")
    # shellcheck disable=SC2086
    (cd "$work/again" && "$zraster" $line) >>"$said" 2>>"$complained" && "$zraster" compare "$work/again/$1.png" "$out/$1.png" >>"$said" 2>>"$complained"
}
for name in cutaway sheet studio parts-ghost; do
    verdict "the command below $name draws it" draws_again $name
done
verdict "each under a name of its own" [ "$(echo "$names" | sort -u | wc -l)" = "$shown" ]
all_there() {
    for name in $names; do
        is_png "$out/$name.png" && [ -s "$out/$name.json" -o -s "$out/$name.sh" ] || { echo "$name" >>"$said"; return 1; }
    done
}
verdict "with its picture, and its scene or command beside it" all_there

# Commands of the manual's page are those that draw its pictures, by pictures.txt. Dark pages show some in the look dark.
page_commands() { # PAGE: lines NAME | COMMAND
    awk '/<img src="pictures\// { has_dark = /<source/; sub(/.*pictures\//, ""); sub(/(\.png)?".*/, ""); name = $0; next }
         name && /^zraster / {
             sub(/ -o [a-z.-]*$/, "")
             print name " | " $0
             if (has_dark && sub(/\.webp/, "-dark.webp", name)) print name " | " $0 " --look dark"
             name = ""
         }' "$1"
}
page_commands clients/docs/gallery.md >"$work/shown"
grep '^gallery-' clients/docs/pictures.txt >"$work/drawn"
verdict "the commands of gallery.md are those of its pictures" cmp "$work/shown" "$work/drawn"

# A feature that a look has by default shows the same picture twice.
twins() {
    for name in $names; do
        echo "$(cksum <"$out/$name.png") $name"
    done | sort | awk '{ key = $1 " " $2; if (key == last) print name, $3; last = key; name = $3 }' | sort
}
twins >"$said"
verdict "no two pictures are the same, but those of a default" [ "$(cat "$said")" = "crease-35 studio
gear-studio occlusion" ]

# Libraries that pack PNGs differ in bytes: pixels are compared once each picture has been packed here, as a base that
# shows through unchanged.
side() { od -An -j"$2" -N4 -tu1 "$1" | awk '{ print $3 * 256 + $4 }'; }
depths() { # WIDTH HEIGHT: an array of zeros, the depth of what is nearest
    printf '\223NUMPY\001\000\166\000%-117s\n' "{'descr': '<f4', 'fortran_order': False, 'shape': ($2, $1)}"
    head -c $(($1 * $2 * 4)) /dev/zero
}
repack() { # PNG OUT
    width=$(side "$1" 16) height=$(side "$1" 20)
    {
        printf '{"window": {"width": %s, "height": %s}, "view": {"preset": "front", "znear": 1, "zfar": 2}, ' "$width" "$height"
        printf '"polygons": [{"vertices": [[0,0,0], [1,0,0], [0,1,0]]}], "base": {"color": "data:image/png;base64,%s", ' "$(base64 -w 0 "$1")"
        printf '"windowDepth": "data:;base64,%s"}}' "$(depths "$width" "$height" | base64 -w 0)"
    } >"$work/base.json"
    "$build/zraster" "$work/base.json" -o "$2" >>"$said" 2>>"$complained"
}
is_todays() { # PNG or WebP
    cmp -s "$1" "$out/${1##*/}" && return 0
    case $1 in *.webp)
        ${PYTHON:-/usr/bin/python3} tests/clients/alike.py "$1" "$out/${1##*/}" >>"$said" 2>>"$complained"
        return
        ;;
    esac
    repack "$1" "$work/a.png" && repack "$out/${1##*/}" "$work/b.png" && cmp "$work/a.png" "$work/b.png" >>"$said" 2>&1
}
pictures=$(grep -oE '(\]\(|src=")clients/[^")]*\.(png|webp)' README.md | sed 's/.*[("]//')
verdict "the README has a picture, one of each look but textbook, four of an assembly, a turntable, a sheet, a spinning cube, and three of printed parts" [ "$(echo "$pictures" | wc -l)" = 19 ]
for picture in $pictures; do
    if grep -q "^LEFT OUT: .* $picture stays" "$complained"; then
        skip "$picture is as it is drawn now" "its mesh is missing"
        continue
    fi
    verdict "$picture is as it is drawn now" is_todays "$picture"
done
"$build/zraster" "$out/look-clay.json" -o "$work/clay.png" >>"$said" 2>>"$complained"
verdict "other bytes of a picture" is_png "$work/clay.png"
verdict "are not those that are shown" eval '! cmp -s "$work/clay.png" "$out/look-clay.png"'
cp "$work/clay.png" "$work/look-clay.png"
verdict "but the same pixels" is_todays "$work/look-clay.png"
cp "$work/clay.png" "$work/look-dark.png"
verdict "and other pixels are noticed" eval '! is_todays "$work/look-dark.png" && is_png "$work/a.png" && is_png "$work/b.png"'
cp "$out/parts-uncut.webp" "$work/parts-section.webp"
verdict "of WebPs, too" eval '! is_todays "$work/parts-section.webp"'
verdicts
