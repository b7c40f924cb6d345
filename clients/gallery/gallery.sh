#!/bin/sh
# gallery.sh BUILD: draws every line of scenes.txt, and a grid of balls, with a daemon of its own on a free port, and leaves
# a page of them in BUILD/gallery/index.html.
set -eu
build=$1
here=clients/gallery
out=$build/gallery
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
render() { "$build/zraster" render --server "$server" "$@" >"$out/client.log" 2>&1 || { cat "$out/client.log" >&2; exit 1; }; }

pawn=$(awk -v model=pawn -f $here/models.awk)
ball=$(awk -v model=ball -f $here/models.awk)
view='"view": {"azimuthDegrees": 35, "elevationDegrees": 28, "perspective": {"yfovDegrees": 30}, "fit": {"padding": 0.07}}'
window='"window": {"width": 300, "height": 300}'
escape() { sed 's/&/\&amp;/g; s/</\&lt;/g'; }

page=$out/index.html
cat >"$page" <<'END'
<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>zraster: a picture a feature</title>
<style>body{font:15px/1.4 sans-serif;margin:2em auto;max-width:1320px;color:#222}h2{clear:both;padding-top:1em}
figure{float:left;width:300px;margin:0 14px 18px 0}img{background:repeating-conic-gradient(#eee 0 25%,#fff 0 50%) 0 0/20px 20px}
figcaption{height:7em;overflow:auto}code{font-size:12px;color:#456;overflow-wrap:anywhere}</style>
<h1>zraster: a picture a feature</h1><p>Beside each picture: the members of its scene, but for its mesh, view and window.</p>
END
figure() { # NAME TITLE MEMBERS
    printf '<figure><img src="%s.png" alt="%s" width="300" height="300"><figcaption><b>%s</b> %s<br><code>%s</code></figcaption></figure>\n' \
        "$1" "$1" "$1" "$(printf %s "$2" | escape)" "$(printf %s "$3" | escape)" >>"$page"
}

count=0
while IFS= read -r line; do
    case $line in
    '#'* | '') continue ;;
    =*) printf '<h2>%s</h2>\n' "${line#= }" >>"$page"; continue ;;
    esac
    name=${line%% |*} rest=${line#*| }
    title=${rest%%|*} members=${rest#*| }
    case $members in
    *'"color"'*) # a mesh's own colour
        color=$(printf %s "$members" | sed 's/.*"color": \("#[0-9a-f]*"\).*/\1/')
        case $members in *edges*) scene=$members material= ;; *)
            scene=$(printf %s "$members" | sed 's/, "color": "#[0-9a-f]*"//')
            material="\"materials\": [{\"name\": \"m\", \"baseColorFactor\": $color}], " ;; esac ;;
    *) scene=$members material= ;;
    esac
    mesh=$pawn
    [ -z "$material" ] || mesh="\"material\": \"m\", $pawn"
    printf '{%s, %s, %s, %s"meshes": [{%s}]}\n' "$scene" "$window" "$view" "$material" "$mesh" >"$out/$name.json"
    render "$out/$name.json" -o "$out/$name.png"
    figure "$name" "$title" "$members"
    count=$((count + 1))
done <$here/scenes.txt

echo '<h2>Metals and plastics</h2>' >>"$page"
for environment in studio outdoor; do
    materials= nodes= comma=
    for metallic in 0 1; do
        for step in 0 1 2 3 4; do
            name="m$metallic$step"
            roughness=$(awk "BEGIN { print 0.05 + 0.2375 * $step }")
            materials="$materials$comma{\"name\": \"$name\", \"metallicFactor\": $metallic, \"roughnessFactor\": $roughness, \"baseColorFactor\": \"#d8a040\"}"
            nodes="$nodes$comma{\"mesh\": \"$name\", \"translation\": [$((step * 23)).0e-1, 0, $((metallic * -26)).0e-1]}"
            comma=', '
        done
    done
    meshes=$(for m in 00 01 02 03 04 10 11 12 13 14; do printf '%s{"name": "m%s", "material": "m%s", %s}' "${sep-}" "$m" "$m" "$ball"; sep=', '; done)
    members="\"look\": \"$environment\""
    printf '{%s, "window": {"width": 620, "height": 300}, "view": {"azimuthDegrees": 0, "elevationDegrees": 25, "perspective": {"yfovDegrees": 25}}, "materials": [%s], "nodes": [%s], "meshes": [%s]}\n' \
        "$members" "$materials" "$nodes" "$meshes" >"$out/balls-$environment.json"
    render "$out/balls-$environment.json" -o "$out/balls-$environment.png"
    printf '<figure style="width:620px"><img src="balls-%s.png" alt="balls"><figcaption><b>%s</b> roughness 0.05 to 1; plastic in front, metal behind</figcaption></figure>\n' \
        "$environment" "$environment" >>"$page"
    count=$((count + 1))
done
# What the README shows.
materials='"materials": [{"name": "slate"}, {"name": "gold", "baseColorFactor": "#e0a83a", "metallicFactor": 1, "roughnessFactor": 0.25}, {"name": "red", "baseColorFactor": "#cc3333", "roughnessFactor": 0.3}, {"name": "white", "baseColorFactor": "#f2f2f2", "roughnessFactor": 0.8}]'
meshes="{\"name\": \"pawn\", \"material\": \"slate\", $pawn}, {\"name\": \"gold\", \"material\": \"gold\", $ball}, {\"name\": \"red\", \"material\": \"red\", $ball}, {\"name\": \"white\", \"material\": \"white\", $pawn}"
nodes='"nodes": [{"mesh": "pawn"}, {"mesh": "gold", "translation": [2.3, 0, -0.3]}, {"mesh": "red", "translation": [1.35, 0, 1.5], "scale": [0.6, 0.6, 0.6]}, {"mesh": "white", "translation": [-2.2, 0, -0.9], "scale": [0.9, 0.9, 0.9]}, {"mesh": "gold", "translation": [-1.25, 0, 0.95], "scale": [0.35, 0.35, 0.35]}]'
printf '{"look": "studio", "window": {"width": 960, "height": 480}, "view": {"azimuthDegrees": 12, "elevationDegrees": 20, "perspective": {"yfovDegrees": 26}}, %s, %s, "meshes": [%s]}\n' \
    "$materials" "$nodes" "$meshes" >"$out/still.json"
render "$out/still.json" --compress small -o "$out/still.png"
for look in studio technical clay dark metal outdoor blueprint; do
    printf '{"look": "%s", "window": {"width": 128, "height": 160}, %s, "meshes": [{%s}]}\n' "$look" "$view" "$pawn" >"$out/look.json"
    render "$out/look.json" --compress small -o "$out/look-$look.png"
done
echo "$count pictures: $page"
