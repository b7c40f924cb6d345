#!/bin/sh
# gallery.sh BUILD: draws an assembly, every line of scenes.txt, grids of balls, and the pictures of the README. Writes the page
# BUILD/gallery/index.html: real parts first, below each picture the command that draws it in that folder. Printed parts are
# meshes of DATA, which is no part of the repository: without them, their three pictures are left out.
set -eu
build=$1
here=clients/gallery
out=$build/gallery
page=$out/index.html
rm -rf "$out"
mkdir -p "$out"
unset ZRASTER_SERVER

render() { # NAME OPTION...: NAME.json -> NAME.png
    name=$1
    shift
    "$build/zraster" "$out/$name.json" "$@" -o "$out/$name.png" >"$out/client.log" 2>&1 || {
        echo "error: $name:" >&2
        cat "$out/client.log" >&2
        exit 1
    }
    count=$((count + 1))
}
count=0
# Those of the README and the manual are WebPs, since the daemon has them in it.
small() { # NAME OPTION...: NAME.json -> NAME.webp
    name=$1
    shift
    "$build/zraster" "$out/$name.json" "$@" --encoding webp --quality 90 -o "$out/$name.webp" >"$out/client.log" 2>&1 || {
        cat "$out/client.log" >&2
        exit 1
    }
}

# ---- the page, in sections ----

# section ID TITLE SENTENCE: what follows belongs to it. The page has the sections in the order of `order`.
order='assembly views printed looks lights materials textures transparency numbers cuts sections-of-parts points animation samples lines effects backgrounds shading shading-bytes light tone normals data'
section() {
    part=$out/section-$1.part
    printf '<section id="%s"><h2>%s</h2>\n<p>%s</p>\n<div class="pictures">\n' "$1" "$2" "$3" >"$part"
    printf '%s' "$2" >"$out/section-$1.title"
}
escape() { sed 's/&/\&amp;/g; s/</\&lt;/g'; }
# NAME CLASS WHAT COMMAND FILE MEMBERS: the picture NAME.png, and the file that the command draws
put_figure() {
    printf '<figure class="%s"><a href="%s.png"><img src="%s.png" alt="%s" loading="lazy"></a><figcaption><b>%s</b> %s<br><code class="command">%s</code>' \
        "$2" "$1" "$1" "$1" "$1" "$3" "$(printf %s "$4" | escape)" >>"$part"
    printf ' <a href="%s">%s</a>' "$5" "$5" >>"$part"
    [ -z "$6" ] || printf '<details><summary>keys</summary><code>%s</code></details>' "$(printf %s "$6" | escape)" >>"$part"
    printf '</figcaption></figure>\n' >>"$part"
}
figure() { put_figure "$1" "$2" "$(printf %s "$3" | escape)" "zraster $1.json" "$1.json" "$4"; } # NAME CLASS WHAT MEMBERS
write_page() {
    cat <<'END'
<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>zraster: gallery</title>
<style>:root{color-scheme:light dark;--ink:#1d2530;--soft:#566272;--paper:#f7f8fa;--card:#fff;--line:#dde2e8}
@media(prefers-color-scheme:dark){:root{--ink:#e4e8ee;--soft:#9aa6b5;--paper:#14181d;--card:#1c2229;--line:#2d353f}}
body{font:15px/1.45 system-ui,sans-serif;margin:0 auto;padding:1.5em;max-width:1300px;color:var(--ink);background:var(--paper)}
h1{margin:0;font-size:1.9em}h2{margin:1.8em 0 .2em}p{margin:.3em 0 1em;color:var(--soft);max-width:60em}a{color:inherit}
nav{display:flex;flex-wrap:wrap;gap:.4em;margin:1em 0}nav a{border:1px solid var(--line);border-radius:1em;padding:.15em .8em;text-decoration:none;background:var(--card)}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(270px,1fr));gap:16px;align-items:start}
figure{margin:0;background:var(--card);border:1px solid var(--line);border-radius:8px;overflow:hidden}figure.wide{grid-column:span 2}
@media(max-width:620px){figure.wide{grid-column:auto}}
figcaption{padding:.6em .8em .8em;font-size:14px}code{font-size:12px;overflow-wrap:anywhere;color:var(--soft)}code.command{color:var(--ink)}
img{display:block;width:100%;background:repeating-conic-gradient(#ddd 0 25%,#fff 0 50%) 0 0/20px 20px}figure.samples img{image-rendering:pixelated}</style>
<h1>What zraster draws</h1>
<p>Find a picture like the one that you need, and copy its command. Each picture was drawn by the command below it, on a processor, in milliseconds. The commands run in the folder of this page.</p>
END
    printf '<nav>'
    for id in $order; do
        [ -f "$out/section-$id.part" ] && grep -q '<figure' "$out/section-$id.part" && printf '<a href="#%s">%s</a>' "$id" "$(cat "$out/section-$id.title")"
    done
    printf '</nav>\n'
    for id in $order; do
        [ -f "$out/section-$id.part" ] && grep -q '<figure' "$out/section-$id.part" || continue
        cat "$out/section-$id.part"
        printf '</div></section>\n'
    done
}

# ---- one scene per line ----

view='"view": {"azimuthDegrees": 35, "elevationDegrees": 28, "perspective": {"yfovDegrees": 30}, "fit": {"padding": 0.07}}'
# All pictures have the view of studio, so that they can be compared.
scene() { # MEMBERS MODEL
    window=', "window": {"width": 300, "height": 300}' material=
    case $1 in *'"window"'*) window= ;; esac
    case $1 in *'"materials"'*) material='"material": "m", ' ;; esac
    printf '{%s%s, %s, "meshes": [{%s%s}]}\n' "$1" "$window" "$view" "$material" "$2" | with_images
}
# "@NAME.png", a picture of this folder, becomes a data: URI.
for image in "$here"/bricks*.png; do
    printf 's|"@%s"|"data:image/png;base64,%s"|g\n' "${image##*/}" "$(base64 <"$image" | tr -d '\n')"
done >"$out/images.sed"
with_images() { sed -f "$out/images.sed"; }

while IFS= read -r line; do
    case $line in
    '#'* | '') continue ;;
    =*) # ID | TITLE | SENTENCE
        line=${line#= }
        rest=${line#*| }
        section "${line%% |*}" "${rest%% |*}" "${rest#*| }"
        ;;
    @*) model=$(awk -v model="${line#@ }" -f $here/models.awk) ;;
    *)
        rest=${line#*| }
        members=${rest#*| }
        name=${line%% |*}
        scene "$members" "$model" >"$out/$name.json"
        render "$name"
        class=
        case $name in samples-*) class=samples ;; esac
        figure "$name" "$class" "${rest%%|*}" "$members"
        ;;
    esac
done <$here/scenes.txt

# ---- balls ----

ball=$(awk -v model=ball -f $here/models.awk)
balls() { # ENVIRONMENT: metallic 0, 0.5 and 1 from the front to the back, roughness 0.05 to 1 from the left
    awk -v look="$1" -v ball="$ball" 'BEGIN {
        for (m = 0; m < 3; m++)
            for (r = 0; r < 5; r++) {
                name = "\"m" m r "\""
                materials = materials comma "{\"name\": " name ", \"baseColorFactor\": \"#d8a040\", \"metallicFactor\": " (m / 2) \
                    ", \"roughnessFactor\": " (0.05 + 0.2375 * r) "}"
                nodes = nodes comma "{\"mesh\": " name ", \"translation\": [" (2.5 * r) ", 0, " (-3.4 * m) "]}"
                meshes = meshes comma "{\"name\": " name ", \"material\": " name ", " ball "}"
                comma = ", "
            }
        printf "{\"look\": \"%s\", \"window\": {\"width\": 620, \"height\": 400}, ", look
        printf "\"view\": {\"azimuthDegrees\": 0, \"elevationDegrees\": 42, \"perspective\": {\"yfovDegrees\": 22}}, "
        printf "\"materials\": [%s], \"nodes\": [%s], \"meshes\": [%s]}\n", materials, nodes, meshes
    }'
}
section materials "Metals and plastics" "The factors of a material, as in glTF: from mirror to matt, from plastic to metal."
for environment in studio outdoor; do
    balls $environment >"$out/balls-$environment.json"
    render balls-$environment
    figure balls-$environment wide \
        "Roughness 0.05 to 1 from the left; plastic in front, metal behind, half of each between." "\"look\": \"$environment\""
done

# ---- point and spot lights ----

pawn=$(awk -v model=pawn -f $here/models.awk)
lights='"lights": [{"type": "spot", "position": [4.6, 6, 4.2], "direction": [-4.2, -5.4, -4.2], "color": "#ffd9a8", "intensity": 120, "innerConeAngleDegrees": 10, "outerConeAngleDegrees": 24, "shadows": true}, {"type": "spot", "position": [-5.6, 4.6, 2.6], "direction": [5.2, -4.2, -2.6], "color": "#86b4ff", "intensity": 75, "innerConeAngleDegrees": 8, "outerConeAngleDegrees": 26, "shadows": true}, {"type": "point", "position": [0.7, 0.45, 2.5], "color": "#ff8a5c", "intensity": 1.1, "range": 4}]'
materials='"materials": [{"name": "floor", "baseColorFactor": "#9a948c", "roughnessFactor": 0.6}, {"name": "white", "baseColorFactor": "#f2efe8", "roughnessFactor": 0.45}, {"name": "gold", "baseColorFactor": "#e0a83a", "metallicFactor": 1, "roughnessFactor": 0.3}, {"name": "bulb", "shading": "unlit", "baseColorFactor": "#ffc09a"}]'
nodes='"nodes": [{"mesh": "floor"}, {"mesh": "pawn"}, {"mesh": "pawn", "translation": [-2.5, 0, -2]}, {"mesh": "gold", "translation": [1.9, 0, 0.3], "scale": [0.7, 0.7, 0.7]}, {"mesh": "gold", "translation": [-1.25, 0, 1.4], "scale": [0.35, 0.35, 0.35]}, {"mesh": "bulb", "translation": [0.7, 0.39, 2.5], "scale": [0.06, 0.06, 0.06]}]'
meshes="{\"name\": \"floor\", \"material\": \"floor\", \"positions\": [[-12, 0, -12], [12, 0, -12], [12, 0, 12], [-12, 0, 12]], \"faces\": [[0, 3, 2, 1]]}, {\"name\": \"pawn\", \"material\": \"white\", $pawn}, {\"name\": \"gold\", \"material\": \"gold\", $ball}, {\"name\": \"bulb\", \"material\": \"bulb\", $ball}"
printf '{"look": "studio", "environment": false, "groundShadow": false, "background": "#0f1216", "ambient": [0.02, 0.022, 0.03], "window": {"width": 620, "height": 400}, "view": {"eye": [1.4, 4.2, 12.5], "target": [0.1, 0.85, 0], "perspective": {"yfovDegrees": 24}}, %s, %s, %s, "meshes": [%s]}\n' \
    "$lights" "$materials" "$nodes" "$meshes" >"$out/lamps.json"
section lights "Point and spot lights" "Lights with a place, a range and shadows, in place of the look&rsquo;s."
render lamps
figure lamps wide "Two spot lights with shadows, and a point light near the floor." "$lights"

# ---- an assembly, by the command ----

for part in base axle bearing wheel washer cap; do
    printf '%s|%s\n' "$part" "$(awk -v model=$part -f $here/models.awk)"
done >"$out/assembly.lines"
meshes=$(awk -F'|' '{ printf "%s{\"name\": \"%s\", %s}", comma, $1, $2; comma = ", " }' "$out/assembly.lines")
awk -f $here/obj.awk <"$out/assembly.lines" >"$out/assembly.obj"
rm "$out/assembly.lines"
zraster=$(realpath "$build/zraster")
command() { # NAME CLASS WHAT FILE COMMAND...: the picture NAME.png, and the command as NAME.sh
    name=$1 class=$2 what=$3 file=$4
    shift 4
    echo "zraster $*" >"$out/$name.sh"
    (cd "$out" && "$zraster" "$@" --compress small) >"$out/client.log" 2>&1 || { cat "$out/client.log" >&2; exit 1; }
    put_figure "$name" "$class" "$what" "$(cat "$out/$name.sh")" "$file" ""
    count=$((count + 1))
}
assembly() { # NAME CLASS WHAT OPTION...
    name=$1 class=$2 what=$3
    shift 3
    command "$name" "$class" "$what" assembly.obj assembly.obj -o "$name.png" "$@"
}
section assembly "An assembly" "A wheel on an axle, of six named parts. Cut it open, take it apart, or draw its lines."
corner="--section x:0.5:negative,z:0.5:negative --section-corner"
assembly cutaway wide "a corner cut away: each part has a hatch of its own" -s 640x480 --colors parts $corner --azimuth 38 --elevation 26
assembly exploded "" "an exploded view along the axle" -s 400x500 --colors parts --explode 1.5 --explode-axis y
assembly ghosts "" "translucent outer parts, and one part highlighted" -s 400x500 --ghost base,wheel --highlight axle
assembly cutaway-metal "" "a half section in metal" -s 400x500 --look metal --section z:0.5:negative
assembly lines "" "an illustration with ink lines" -s 400x500 --look technical --colors parts
assembly blueprint-exploded "" "white lines on blue paper" -s 400x500 --look blueprint --explode 1.5 --explode-axis y
assembly xray-assembly "" "the inside of all parts" -s 400x500 --look xray
parts() { # NAME LOOK WHAT MEMBERS
    printf '{"look": "%s", "window": {"width": 300, "height": 400}, "view": {"azimuthDegrees": 35, "elevationDegrees": 22, "perspective": {"yfovDegrees": 26}}, %s, "meshes": [%s]}\n' \
        "$2" "$4" "$meshes" >"$out/$1.json"
    render "$1"
    figure "$1" "" "$3" "\"look\": \"$2\", $4"
}
section sections-of-parts "Parts in scenes" "The same choices as keys of a scene in JSON."
parts parts-colors studio "one colour per part, chosen by its name" '"colors": "parts"'
parts parts-exploded studio "the same, moved apart along y" '"colors": "parts", "explode": {"factor": 1.5, "axis": "y"}'
parts parts-ghost studio "translucent outer parts and a highlighted axle" '"ghost": ["base", "wheel"], "highlight": "axle"'
parts parts-hidden technical "hidden parts; the view fits the other parts" '"hide": ["base", "ca?"], "colors": "parts"'
parts parts-section studio "a corner cut away; each part has a hatch of its own" '"colors": "parts", "sections": {"planes": [{"axis": "x", "fraction": 0.5, "keep": "negative"}, {"axis": "z", "fraction": 0.5, "keep": "negative"}], "corner": true}'
parts parts-uncut metal "a half section; the axle is not cut" '"sections": {"planes": [{"axis": "z", "fraction": 0.5, "keep": "negative"}], "uncut": ["axle"]}'
parts parts-drawing technical "lines of the mesh; hidden lines are dashed" '"edges": {"from": "mesh", "hiddenLines": true}'
parts parts-blueprint blueprint "an exploded view" '"explode": {"factor": 1.5, "axis": "y"}'

# ---- several views, by the command ----

section views "Several views" "Sides at one scale, for a page of a catalogue, and animations for the web."
command sheet "" "views at one scale" assembly.obj sheet assembly.obj -o sheet.png -s 480x360 --colors parts --look technical
command balanced "" "all sides in four views" assembly.obj sheet assembly.obj -o balanced.png -s 480x360 --colors parts --sheet balanced
command turntable "" "an animation: the camera turns around it" assembly.obj turntable assembly.obj -o turntable.png --turntable 20 -s 200x170 --colors parts --section z:0.5:negative --background white
section animation "Motion" "Nodes that turn, or move through keys."
sed -e 's/"width": 320, "height": 320/"width": 160, "height": 160/' -e 's/"frames": 36/"frames": 24/' \
    clients/examples/cube.json >"$out/cube.json"
command cube "" "nodes that move by \"animate\", in fog" cube.json cube.json -o cube.png

# ---- printed parts ----

# https://github.com/azdle/printables (CC0), commit 3c104a23: unsorted/fan_adaptor.stl, unsorted/pc-board-mount.stl and
# enclosed-spool-holder/enclosed-spool-holder.stl, in DATA/models/printed.
printed=${DATA:-../shared/data}/models/printed
printed() { # NAME LOOK FILE WHAT MEMBERS
    [ -f "$printed/$3.stl" ] || {
        echo "LEFT OUT: the picture $1: there is no $printed/$3.stl. $here/$1.webp stays as it is." >&2
        return
    }
    printf '{"look": "%s", "up": "z", "window": {"width": 330, "height": 250}, %s, %s"meshes": [{"asset": "part"}]}\n' \
        "$2" "$printed_view" "${5:+$5, }" >"$out/$1.json"
    render "$1" --part "part=$printed/$3.stl"
    small "$1" --part "part=$printed/$3.stl"
    put_figure "$1" "" "$4; by Patrick Barrett (azdle/printables, CC0)" "zraster $1.json --part part=$3.stl" "$1.json" "$5"
}
printed_view='"view": {"azimuthDegrees": 35, "elevationDegrees": 28, "perspective": {"yfovDegrees": 30}, "fit": {"padding": 0.04}}'
section printed "Printed parts" "STL files for printers, drawn as a print service shows them."
printed printed-fan studio fan_adaptor "An adaptor for a fan" ''
printed printed-mount technical pc-board-mount "A mount for a board, with dashed hidden lines" '"edges": {"from": "mesh", "hiddenLines": true}'
printed printed-spool metal enclosed-spool-holder "The base of a spool holder, a corner cut away" '"sections": {"planes": [{"axis": "x", "fraction": 0.5, "keep": "negative"}, {"axis": "z", "fraction": 0.5, "keep": "negative"}], "corner": true}'

# ---- a colour bar ----

waves=$(awk -v model="waves viridis" -f $here/models.awk)
bar='"colorBar": {"title": "height, mm"}'
printf '{"look": "studio", "up": "z", "window": {"width": 620, "height": 400}, "view": {"azimuthDegrees": 35, "elevationDegrees": 30, "perspective": {"yfovDegrees": 30}, "fit": {"padding": 0.12}}, %s, "meshes": [{%s}]}\n' \
    "$bar" "$waves" >"$out/color-bar.json"
part=$out/section-numbers.part
render color-bar
figure color-bar wide "The colormap with its numbers, over any look in its own colours." "$bar"

# ---- pictures of the README ----

materials='"materials": [{"name": "slate"}, {"name": "gold", "baseColorFactor": "#e0a83a", "metallicFactor": 1, "roughnessFactor": 0.25}, {"name": "red", "baseColorFactor": "#cc3333", "roughnessFactor": 0.3}, {"name": "white", "baseColorFactor": "#f2f2f2", "roughnessFactor": 0.8}]'
meshes="{\"name\": \"pawn\", \"material\": \"slate\", $pawn}, {\"name\": \"gold\", \"material\": \"gold\", $ball}, {\"name\": \"red\", \"material\": \"red\", $ball}, {\"name\": \"white\", \"material\": \"white\", $pawn}"
nodes='"nodes": [{"mesh": "pawn"}, {"mesh": "gold", "translation": [2.3, 0, -0.3]}, {"mesh": "red", "translation": [1.35, 0, 1.5], "scale": [0.6, 0.6, 0.6]}, {"mesh": "white", "translation": [-2.2, 0, -0.9], "scale": [0.9, 0.9, 0.9]}, {"mesh": "gold", "translation": [-1.25, 0, 0.95], "scale": [0.35, 0.35, 0.35]}]'
printf '{"look": "studio", "window": {"width": 800, "height": 400}, "view": {"azimuthDegrees": 12, "elevationDegrees": 20, "perspective": {"yfovDegrees": 26}}, %s, %s, "meshes": [%s]}\n' \
    "$materials" "$nodes" "$meshes" >"$out/still.json"
for name in still parts-section parts-drawing parts-blueprint parts-uncut cube; do
    small "$name"
done
(cd "$out" && for name in sheet turntable; do
    # shellcheck disable=SC2046
    "$zraster" $(sed "s/^zraster //; s/ -o .*png / -o $name.webp --quality 90 /; s/ --compress small//" $name.sh)
done) >"$out/client.log" 2>&1 || { cat "$out/client.log" >&2; exit 1; }
for look in studio technical clay dark metal outdoor blueprint xray; do
    scene "\"look\": \"$look\", \"window\": {\"width\": 128, \"height\": 160}" "$pawn" >"$out/look-$look.json"
    render look-$look --compress small
done
write_page >"$page"
rm "$out"/section-*.part "$out"/section-*.title
echo "$count pictures: $page"
