#!/bin/sh
# test_command.sh BUILD: the command without a daemon: outputs and their names, channels, info, looks, compare, batch, watch,
# pictures in the terminal, no socket. Prints TAP.
set -u
build=$(realpath "$1")
zraster=$build/zraster
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
said=$work/said complained=$work/complained
watcher=
trap '[ -z "$watcher" ] || kill -9 "$watcher" 2>/dev/null; rm -rf "$work"' EXIT
unset ZRASTER_SERVER ZRASTER_TOKEN NO_COLOR KITTY_WINDOW_ID TERM_PROGRAM LC_TERMINAL
export TERM=xterm
mkdir "$work/in"
cd "$work/in" || exit 1

triangle >part.stl
printf '{"window": {"width": 8, "height": 8}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' >scene.json

# outputs
check "a model becomes a picture" 0 "$zraster" part.stl
verdict "with the name of the model and the default size" [ "$(size_of_png part.png)" = 640x480 ]
verdict "and nothing is printed" [ ! -s "$said" -a ! -s "$complained" ]
check "the second argument is the output" 0 "$zraster" part.stl second.png --size=40
verdict "a size of one number is a square" [ "$(size_of_png second.png)" = 40x40 ]
check "--output is -o" 0 "$zraster" part.stl --output third.png -W 80
verdict "a width alone keeps 4:3" [ "$(size_of_png third.png)" = 80x60 ]
"$zraster" scene.json -o third.png -W 8 >"$said" 2>"$complained"
verdict "but not the height of a scene" [ "$(size_of_png third.png)" = "8x$(sed -n 's/.*"height": \([0-9]*\).*/\1/p' scene.json | head -n 1)" ]
"$zraster" - -s64x48 <part.stl >piped.png 2>"$complained"
verdict "a pipe gets the picture" [ "$(size_of_png piped.png)" = 64x48 ]
check "-z is an axis" 0 "$zraster" part.stl up.png --up -z -s 8
check "so it is behind =" 0 "$zraster" part.stl up.png --up=-x -s 8
check "-v reports the output" 0 "$zraster" part.stl -s 64x48 -v
verdict "in one line" grep -qE '^part.png  64x48  studio  [0-9]+ ms' "$complained"
cmp -s part.png piped.png
verdict "with the bytes of the pipe" [ $? = 0 ]
printf 'newmtl m\nmap_Kd big.png\n' >big.mtl # its head alone: 8192 x 8200 texels
printf 'mtllib big.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n' >big.obj
printf '\211PNG\015\012\032\012\000\000\000\015IHDR\000\000\040\000\000\000\040\010\001\000\000\000\000\266\202\165\231' >big.png
"$zraster" big.obj -s 8 2>"$complained"
verdict "images may have more texels than the daemon's default" grep -q 'big.png.*it ends too early' "$complained"
rm big.*
ls >"$work/before"
check "an output goes to a folder" 0 "$zraster" part.stl -o new/ -s 8
verdict "which is made" is_png new/part.png
check "several channels become several files" 0 "$zraster" part.stl -c color,depth,instanceId,info -o new -s 8
verdict "named by their channels" [ "$(ls new | tr '\n' ' ')" = "part.depth.npy part.info.json part.instanceId.npy part.png " ]
check "masks as JSON by the ending" 0 "$zraster" scene.json -c masks -o masks.json
verdict "with their run lengths" grep -q counts masks.json
check "masks alone are one archive in the folder" 0 "$zraster" part.stl -c masks -s 8 -o new
verdict "named by their channel" [ "$(head -c 2 new/part.masks.zip)" = PK ]
check "also in the current folder" 0 "$zraster" scene.json --channel depth,normals
verdict "with the same names" [ -s scene.depth.npy -a -s scene.normals.npy ]
check "or become one archive" 0 "$zraster" part.stl -c color,depth -o both.zip -s 8
verdict "which is a ZIP" [ "$(head -c 2 both.zip)" = PK ]
check "an output named .svg has lines alone" 0 "$zraster" part.stl -o part.svg -s 8
verdict "as SVG" [ "$(head -c 5 part.svg)" = "<svg " ]
check "also as the second argument" 0 "$zraster" part.stl lines.svg -s 8
verdict "with the same bytes" cmp -s part.svg lines.svg
check "not of a look without lines" 1 "$zraster" part.stl -o none.svg --look clay
verdict "which is refused" grep -q '/edges: none: the encoding svg' "$complained"
check "nor of a channel without them" 2 "$zraster" part.stl -o part.svg -c depth
check "existing files are overwritten" 0 "$zraster" part.stl -o new -s 9
verdict "with the new picture" [ "$(size_of_png new/part.png)" = 9x9 ]
check "-n refuses to overwrite" 1 "$zraster" part.stl -o new -s 10 -n
verdict "and leaves the picture" [ "$(size_of_png new/part.png)" = 9x9 ]
printf '{"window": {"width": 8, "height": 8}, "polygons": [{"vertices": [[0,0,0],[0,1,0],[1,0,0]]}]}' >away.json
check "a scene with a warning is drawn" 0 "$zraster" away.json
verdict "and the warning is on standard error" grep -q '^warning: nothing is visible' "$complained"
check "the same with -q" 0 "$zraster" away.json -q
verdict "prints no warning" [ ! -s "$complained" ]
rm -f away.png
check "with --strict, a warning ends with 3" 3 "$zraster" away.json --strict
verdict "and nothing is saved" [ ! -e away.png ]

# files that a file refers to
z3='\000\000\000\000\000\000\000\000\000\000\000\000' one='\000\000\200\077'
gltf() { # URI
    printf '{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"%s"}]}' "$1"
}
mkdir -p models/one/maps models/two elsewhere
printf "$z3$one$z3$one\\000\\000\\000\\000" >"models/one/maps/Tri 1.bin"
cp "models/one/maps/Tri 1.bin" elsewhere/far.bin
ln -s ../../elsewhere/far.bin models/one/link.bin
for case in exact:maps/Tri%201.bin case:MAPS/tri%201.BIN windows:C:\\\\\\\\art\\\\\\\\maps\\\\\\\\gone.bin up:../one/maps/Tri%201.bin outside:../../elsewhere/far.bin link:link.bin missing:none.bin; do
    gltf "${case#*:}" >"models/one/${case%%:*}.gltf"
done
cp "models/one/maps/Tri 1.bin" models/one/gone.bin
for case in exact case windows up; do
    check "a buffer beside a model is read: $case" 0 "$zraster" models/one/$case.gltf -o $case.png -s 8 --strict
done
check "from another folder" 1 "$zraster" models/one/outside.gltf -o out.png -s 8
verdict "the renderer lacks it" grep -q "no part of the request has the name '../../elsewhere/far.bin'" "$complained"
check "a link out of the folder is not followed" 1 "$zraster" models/one/link.gltf -o out.png -s 8
check "--root allows it" 0 "$zraster" models/one/link.gltf -o out.png -s 8 --root . --strict
check "and a file above" 0 "$zraster" models/one/outside.gltf -o out.png -s 8 --root . --strict
check "a file that is missing is refused" 1 "$zraster" models/one/missing.gltf -o out.png -s 8
check "unless --part has it" 0 "$zraster" models/one/missing.gltf -o out.png -s 8 --part none.bin=elsewhere/far.bin --strict
check "--root names a folder" 1 "$zraster" models/one/exact.gltf -o out.png -s 8 --root nowhere
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nmtllib /etc/none.mtl\n' >models/two/far.obj
"$zraster" models/two/far.obj -o far.png -s 8 2>"$complained"
verdict "an absolute path is not read, with a warning" grep -q "^warning: a referenced file is not read (outside of the folder of the file or --root): /etc/none.mtl" "$complained"
check "which --strict refuses" 3 "$zraster" models/two/far.obj -o far.png -s 8 --strict

# files that a scene names
scene_of() { # ASSET
    printf '{"window": {"width": 8, "height": 8}, "materials": [{"name": "m", "baseColorTexture": {"asset": "wood.png"}}], "meshes": [{"material": "m", "positions": [[0,0,0],[1,0,0],[0,1,1]], "texcoords": [[0,0],[1,0],[0,1]], "faces": [[0,1,2]]}, {"asset": "%s"}]}' "$1"
}
mkdir -p named/deep
"$zraster" part.stl named/wood.png -s 8 && "$zraster" part.stl named/far.png -s 8 --color red
printf 'mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl n\nf 1 2 3\n' >named/deep/model.obj
printf 'newmtl n\nKd 1 0 0\n' >named/deep/m.mtl
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >elsewhere/part.obj
ln -s ../elsewhere/part.obj named/link.obj
for case in deep:deep/model.obj none:modle.obj outside:../elsewhere/part.obj absolute:$work/in/elsewhere/part.obj link:link.obj; do
    scene_of "${case#*:}" >"named/${case%%:*}.json"
done
check "a scene's model and texture are read from its folder" 0 "$zraster" named/deep.json -o deep.png --strict
check "also for info" 0 "$zraster" info named/deep.json --strict
check "and for a batch" 0 "$zraster" batch named/deep.json -o batched --strict
verdict "with the same bytes" cmp -s deep.png batched/deep.png
check "--part wins over the folder" 0 "$zraster" named/deep.json -o other.png --part deep/model.obj=elsewhere/part.obj --strict
cp elsewhere/part.obj named/deep/model.obj
check "a file takes the place of another" 0 "$zraster" named/deep.json -o same.png --strict
verdict "and --part gave its picture" eval 'cmp -s other.png same.png && ! cmp -s other.png deep.png'
check "a scene on standard input has no folder" 1 sh -c '"$0" - <named/deep.json -o piped-scene.png' "$zraster"
verdict "and the message names options" grep -q "/asset: no part of the request has the name 'deep/model.obj'; standard input has no folder, --root gives one; --part deep/model.obj=FILE" "$complained"
check "--root gives it one" 0 sh -c '"$0" - --root named <named/deep.json -o piped-scene.png --strict' "$zraster"
verdict "with the same picture" cmp -s piped-scene.png same.png
check "a name without a file is refused" 1 "$zraster" named/none.json -o out.png
verdict "at its place, with the folder" grep -q "/meshes/1/asset: no part of the request has the name 'modle.obj'; the folder of named/none.json has no such file; --part modle.obj=FILE gives it" "$complained"
scene_of "it's.obj" >named/quote.json
check "so is one with a quote" 1 "$zraster" named/quote.json -o out.png
verdict "which the advice keeps" grep -q "the folder of named/quote.json has no such file; --part it's.obj=FILE gives it" "$complained"
scene_of "$(printf %0400d 0)" >named/long.json
check "and a long one" 1 "$zraster" named/long.json -o out.png
verdict "which is cut off, without advice" eval '! grep -q -e --part "$complained"'
check "so it is in a list" 1 "$zraster" batch named/none.json -o batched
verdict "with the folder" grep -q "the folder of named/none.json has" "$complained"
for case in outside absolute link; do
    check "a model elsewhere is refused: $case" 1 "$zraster" named/$case.json -o out.png
    verdict "with the reason" grep -q "'; its file is outside of the folder of named/$case.json or --root; --part " "$complained"
done
check "--root allows one above" 0 "$zraster" named/outside.json -o out.png --root . --strict

# parts
printf '{"window": {"width": 8, "height": 8}, "view": {"preset": "front", "znear": 1, "zfar": 9}, "base": {"color": {"asset": "color"}, "windowDepth": {"asset": "z"}}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' >over.json
"$zraster" scene.json -c color,windowDepth -o base/
check "files are parts of a scene" 0 "$zraster" over.json --part color=base/scene.png --part z=base/scene.windowDepth.npy
verdict "with the names of --part" is_png over.png
check "a part is missing" 1 "$zraster" over.json --part color=base/scene.png
grep -q "'z'" "$complained"
verdict "and the message names it" [ $? = 0 ]
check "a file of a part is missing" 1 "$zraster" over.json --part color=nothing.png
verdict "and the message names the option" grep -q -e '--part color=nothing.png: No such file' "$complained"

# info, looks, help
check "info" 0 "$zraster" info part.stl
verdict "is a table" grep -qE '^counts.triangles +1$' "$said"
verdict "has a table of parts" grep -Eq '^part  .* 1  1 x 0 x 1 .* 0\.5  open +-$' "$said"
check "info without a picture" 0 "$zraster" info part.stl --render=false
verdict "has no pixels, but the parts" sh -c 'grep -q "^part .* open" "$1" && ! grep -q ixels "$1"' - "$said"
printf '{"meshes": [{"name": "a\\u001b[31m", "positions": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,2]]}]}' >colored.json
check "info of a name with control characters" 0 "$zraster" info colored.json
verdict "prints them as ?" sh -c 'grep -qF "a?[31m" "$1" && ! grep -q "$(printf "\033")" "$1"' - "$said"
check "info as JSON" 0 "$zraster" info part.stl --json
verdict "is the output of the channel info" grep -q '"triangles": *1' "$said"
check "looks" 0 "$zraster" looks
verdict "are listed" grep -qx technical "$said"
for command in render info batch drawing compare watch looks help; do
    check "help $command" 0 "$zraster" help $command
    verdict "names it" grep -q "zraster.*$command" "$said"
done
for option in -o -s -n --show --resume --json --server --token-file -j -q -v --plain; do
    verdict "$option is explained" eval '{ "$zraster" help; "$zraster" help batch; } | grep -qe "^ .*$option[ ,]"'
done

# compare
"$zraster" part.stl a.png -s 32 && "$zraster" part.stl b.png -s 32 --color red --background white
check "equal pictures" 0 "$zraster" compare a.png a.png
verdict "are equal" grep -q '^all 1024 pixels are equal' "$said"
check "different pictures end with 4" 4 "$zraster" compare a.png b.png -o diff.png
verdict "with counts" grep -qE '^[0-9]+ of 1024 pixels differ \(.*\); the largest difference is [0-9]+ of 255, at' "$said"
verdict "and a picture" [ "$(size_of_png diff.png)" = 32x32 ]
"$zraster" part.stl d.png -s 32 --channel depth --encoding png16
check "16 bits are compared as they are" 0 "$zraster" compare d.png d.png
check "and with 8 bits" 4 "$zraster" compare d.png a.png
verdict "and scales to 16" grep -q 'of 65535' "$said"

check "a tolerance passes over small differences" 0 "$zraster" compare a.png b.png --tolerance 255
verdict "and says so with the SSIM" grep -qE '^all 1024 pixels are equal to within [0-9]+ of 255; SSIM 0\.' "$said"
check "the numbers are JSON, too" 4 "$zraster" compare a.png b.png --json
verdict "with counts" grep -qE '^\{"same":false,"width":32,"height":32,"pixels":1024,"differing":[0-9]+,.*"ssim":0\.' "$said"
for ending in jpg webp; do
    "$zraster" part.stl lossy.$ending -s 32 --quality 95
    check "a $ending is compared, too" 4 "$zraster" compare a.png lossy.$ending
    verdict "and is nearly the same" grep -qE 'SSIM 0\.9' "$said"
done
for ending in npy pfm; do
    "$zraster" part.stl near.$ending -s 32 --channel depth && "$zraster" part.stl far.$ending -s 32 --channel depth --padding 0.2
    check "equal numbers, .$ending" 0 "$zraster" compare near.$ending near.$ending
    verdict "are equal" grep -q '^all 1024 pixels are equal$' "$said"
    check "different numbers end with 4" 4 "$zraster" compare near.$ending far.$ending
    verdict "with the RMS" grep -qE '^[0-9]+ of 1024 pixels differ \(.*; RMS ' "$said"
done
check "both formats have the same numbers" 0 "$zraster" compare near.npy near.pfm
check "a tolerance of infinity passes over all" 0 "$zraster" compare near.npy far.npy --tolerance inf --json
check "an array and a picture are refused" 2 "$zraster" compare near.npy a.png
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >corner.obj
sed 's/^v 0 0 1/v 0 0 2/' corner.obj >taller.obj
check "equal models" 0 "$zraster" compare corner.obj corner.obj
verdict "are the same" grep -q '^IoU 1; .*; same$' "$said"
check "different models end with 4" 4 "$zraster" compare corner.obj taller.obj -o models.png -s 64
verdict "with numbers" grep -q '^IoU 0.5' "$said"
verdict "and a picture" [ "$(size_of_png models.png)" = 64x64 ]
check "--json has all numbers" 4 "$zraster" compare corner.obj taller.obj --json
verdict "of the regions" grep -q '"regions":\[{"mark":1,"in":"b","kind":"added","volume":0.1' "$said"

# info --expect
check "expected facts pass" 0 "$zraster" info corner.obj --expect '{"box": [1, 1, 1], "closed": true, "triangles": 4, "tolerance": 0.01, "volume": 0.16, "holes": []}'
verdict "with a row for each" [ "$(grep -c '^pass  ' "$said")" = 5 ]
check "others end with 4" 4 "$zraster" info corner.obj --expect '{"box": [1, 1, 2], "area": 2.366}' --json
verdict "as JSON, too" grep -qxF '{"rows":[{"key":"box","pass":false,"expected":[1,1,2],"found":[1,1,1]},{"key":"area","pass":true,"expected":2.366,"found":2.3660254}],"pass":false}' "$said"
check "unknown keys are refused" 2 "$zraster" info corner.obj --expect '{"size": 3}'
check "and files that are missing" 2 "$zraster" info corner.obj --expect missing.json
printf '%s' '{"meshes": [{"name": "cube", "shape": {"type": "box", "size": 2}}, {"name": "cut", "shape": {"type": "box", "size": [2, 4, 4]}}], "nodes": [{"mesh": "cube"}, {"mesh": "cut", "translation": [1.5, 0, 0]}], "csg": {"difference": ["cube", "cut"]}}' >combined.json
sed 's/"csg": .*/"hide": ["cut"]}/' combined.json >hiding.json
check "a combined solid has its own volume" 0 "$zraster" info combined.json --expect '{"volume": 6, "closed": true}'
check "but neither area, box nor holes" 4 "$zraster" info combined.json --expect '{"volume": 6, "area": 24, "box": [2, 2, 2], "holes": [{"diameter": 1, "count": 0}]}'
verdict "and each row says why" [ "$(grep -c '^FAIL .* found none: .*combined solids' "$said")" = 3 ]
check "as JSON, too" 4 "$zraster" info combined.json --expect '{"holes": []}' --json
verdict "in its reason" grep -qxF '{"rows":[{"key":"holes","pass":false,"expected":0,"found":null,"reason":"combined solids have none"}],"pass":false}' "$said"
check "hidden parts do not count" 0 "$zraster" info hiding.json --expect '{"volume": 8, "area": 24, "box": [2, 2, 2], "triangles": 12, "holes": []}'
check "holes that are not searched fail" 4 "$zraster" info corner.obj --features false --expect '{"holes": []}'
verdict "with the reason" grep -q '^FAIL  holes .* found none: holes were not searched in 1 part$' "$said"
check "an open part has no volume" 4 "$zraster" info part.stl --expect '{"volume": 0}'
verdict "and it is said" grep -q '^FAIL  volume .* found none: 1 open part has no volume$' "$said"
printf '{"meshes": [{"name": "cube", "shape": {"type": "box", "size": 2}}], "turntable": {"frames": 2}}' >turning.json
check "several views have no facts" 4 "$zraster" info turning.json --expect '{"volume": 8, "box": [2, 2, 2], "closed": true}'
verdict "and each row says so" [ "$(grep -c '^FAIL .* found none: several views have several facts$' "$said")" = 3 ]
check "combined solids are not compared" 1 "$zraster" compare corner.obj combined.json
verdict "and the message says which" grep -q '/csg: combined solids have no mesh to compare: leave out csg of b' "$complained"
sed 's/^v 1 /v 25.4 /; s/^v 0 1 /v 0 25.4 /; s/^v 0 0 1/v 0 0 25.4/' corner.obj >inches.obj
check "another unit is a warning" 4 "$zraster" compare corner.obj inches.obj
verdict "that names the remedy" grep -q 'b is 25.4 times as large as a.*; align=principal and rescale=on' "$complained"
check "which makes both the same" 0 "$zraster" compare corner.obj inches.obj --align principal --rescale
verdict "and prints the scale" grep -q '^aligned by principal: .*; b is scaled by 0.0393701$' "$said"

# drawing
check "a technical drawing" 0 "$zraster" drawing corner.obj -o corner.svg --section y --date 2026-11-30
verdict "is an SVG in millimetres with its title and section" eval 'grep -q "width=\"420mm\" height=\"297mm\"" corner.svg && grep -q "aria-label=\"corner.obj\"" corner.svg && grep -q "aria-label=\"A-A\"" corner.svg && grep -q "aria-label=\"2026-11-30\"" corner.svg'
if command -v xmllint >/dev/null; then verdict "that xmllint accepts" xmllint --noout corner.svg; fi
check "or a PNG" 0 "$zraster" drawing corner.obj -o corner.png --page a4 --dpi 60 --projection first
verdict "of the paper's size" [ "$(size_of_png corner.png)" = 496x702 ]
check "its name follows from the file" 0 "$zraster" drawing taller.obj --scale 20:1 --hidden false
verdict "in this folder" grep -q 'data-scale="20:1"' taller.svg
check "a scale that is too large is refused" 1 "$zraster" drawing corner.obj -o no.svg --scale 500:1
verdict "with the largest one" grep -q "do not fit on A3 at 500:1; .* is [0-9]*:1" "$complained"
for line in "corner.obj --page a5" "corner.obj --section w" "corner.obj -o no.pdf" "corner.obj --width 80" "corner.obj taller.obj" ""; do
    check "drawing $line" 2 "$zraster" drawing $line
done
verdict "and nothing is written" [ ! -e no.svg ] # nor a PDF
check "a value out of its range is refused" 2 "$zraster" drawing corner.obj -o no.svg --dpi 5000
verdict "with the range" grep -q -e '--dpi: 5000 is not 30 to 600' "$complained"

# batch
mkdir -p many/deep
for i in 01 02 03 04 05 06 07 08 09 10 11 12; do awk -v seed=$i 'BEGIN { for (k = 0; k < 40; k++) { a = k * 2.4 + seed; print "v", cos(a) * k, sin(a) * k, (k * seed) % 7 } for (k = 1; k < 39; k++) print "f", k, k + 1, k + 2 }' >many/m$i.obj; done
cp many/m01.obj many/deep/m01.obj
check "a batch draws a folder" 0 "$zraster" batch many -o drawn -s 64
verdict "and the folders in it" [ "$(find drawn -name '*.png' | wc -l)" = 13 -a -s drawn/deep/m01.png ]
verdict "a line per file is printed" [ "$(grep -c 'png  64x64  studio' "$complained")" = 13 ]
check "a batch draws a pattern; one failure ends with 1" 1 "$zraster" batch 'many/*.obj' nothing.stl -o drawn2 -s 64 --json
verdict "after all other files" [ "$(ls drawn2 | wc -l)" = 12 ]
verdict "and is listed last" eval 'tail -n 2 "$complained" | grep -q "nothing.stl: No such file"'
verdict "--json prints an object per file" [ "$(grep -c '^{"file":"many/m.*"status":"done"' "$said")" = 12 ]
verdict "also for the failure" grep -q '^{"file":"nothing.stl","status":"failed".*"errors":\["No such file' "$said"
verdict "the bytes are those of a single file" eval '"$zraster" many/m07.obj -o m07.png -s 64 && cmp m07.png drawn/m07.png && cmp m07.png drawn2/m07.png'
printf '{"file": "part.stl", "output": "lines/red.png", "color": "red", "width": 20, "height": 10, "edges": true}\npart.stl\n' >lines.txt
mkdir lines
"$zraster" batch - -o lines <lines.txt >"$said" 2>"$complained"
verdict "lines of standard input are names or objects" [ $? = 0 -a "$(size_of_png lines/red.png)" = 20x10 -a -s lines/part.png ]
printf '{"file": "part.stl", "colour": "red"}\n' >lines.txt
"$zraster" batch - <lines.txt >"$said" 2>"$complained"
verdict "an unknown key is refused" [ $? = 2 ]
verdict "and the nearest key is suggested" grep -q 'line 1: unknown key "colour"; did you mean color?' "$complained"
script -qec "'$zraster' batch many -o bar -s 16" typescript </dev/null >"$said" 2>"$complained"
verdict "a terminal gets a bar" grep -qE '\[#{20}\] 13/13  [0-9.]+/s' "$said"

# progress of views: 40 of them take more than the tenth of a second from which on it is shown
turn="'$zraster' turntable part.stl --turntable 40 -s 640x480 -n"
lines_of() { tr '\r' '\n' <"$said" | sed 's/\x1b\[K//'; }
script -qec "$turn -o a.webp" typescript </dev/null >"$said" 2>"$complained"
verdict "a terminal gets the number of views" eval 'lines_of | grep -qx "[1-9][0-9]* of 40 views"'
verdict "which rises" eval 'lines_of | grep " of 40 views" | sort -nuC'
verdict "and is gone at the end" eval 'lines_of | grep -A1 " of 40 views" | tail -n 1 | grep -q "^a.webp  [0-9]* bytes"'
for silent in "-q -o b.webp" "--plain -o c.webp" "-o d.webp 2>errors" "-o e.webp 2>&1 | cat"; do
    script -qec "$turn $silent" typescript </dev/null >"$said" 2>"$complained"
    verdict "no number of views with $silent" eval '! grep -q "of 40" "$said" "$complained"'
done
verdict "errors in a file, neither" [ ! -s errors ]
verdict "and the same bytes" eval 'cmp a.webp b.webp && cmp a.webp c.webp && cmp a.webp d.webp && cmp a.webp e.webp'
check "another ending makes an animated PNG" 0 "$zraster" turntable part.stl turn.png --turntable 3 -s 16
verdict "with frames" grep -q acTL turn.png
check "an animated WebP has no number of bytes" 1 "$zraster" turntable part.stl turn.webp --max-bytes 9999
verdict "and it is said" grep -q 'an animated webp has none' "$complained"

broken_name=$(printf 'new\nline')
mkdir odd && cp part.stl "odd/$broken_name.stl"
check "a name with a line break" 0 "$zraster" batch odd -o odd/out -s 8 -c color,depth --json
verdict "is one text in JSON" grep -qF '"outputs":["odd/out/new\nline.depth.npy","odd/out/new\nline.png"]' "$said"
check "the same name in a report" 0 "$zraster" batch odd -o odd/out -s 8
verdict "is on one line" grep -q '^odd/out/new?line.png  8x8' "$complained"

check "a folder may be named like a version" 0 "$zraster" batch odd -o v1.2 -s 8
check "or, with a slash at its end, like a file" 0 "$zraster" batch odd -o one.png/ -s 8
verdict "which is made" eval 'is_png "v1.2/$broken_name.png" && is_png "one.png/$broken_name.png"'

mkdir inner && cp scene.json inner/
check "outputs within the folder" 0 "$zraster" batch inner -o inner/out -c info,color --json
check "are not drawn" 0 "$zraster" batch inner -o inner/out -c info,color --json
verdict "by the next batch" [ "$(wc -l <"$said")" = 1 ]

mkdir stems && triangle >stems/part.stl && printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >stems/part.obj && cp stems/part.obj stems/other.obj
check "a batch draws files with one stem" 0 "$zraster" batch stems -o stemmed -s 8
verdict "under names with their endings" [ "$(cd stemmed && echo *)" = "other.png part.obj.png part.stl.png" ]
check "and --resume finds them" 0 "$zraster" batch stems -o stemmed -s 8 --resume --json
verdict "all" [ "$(grep -c '"skipped"' "$said")" = 3 ]

mkdir -p robots/ur3/visual robots/ur5/visual robots/ur5/collision && triangle | tee robots/ur3/visual/base.stl robots/ur5/visual/base.stl robots/ur5/collision/base.stl robots/base.stl >base.stl
cp stems/part.obj robots/ur5/collision/base.obj
check "a batch draws files of one name in several folders" 0 "$zraster" batch robots/base.stl robots/ur*/*/base.* -o bases -s 8
verdict "under names with the folders that tell them apart" [ "$(cd bases && echo $(find . -name '*.png' | sort))" = "./base.obj.png ./collision/base.stl.png ./robots/base.stl.png ./ur3/visual/base.stl.png ./ur5/visual/base.stl.png" ]
check "unless one has no folder" 2 "$zraster" batch base.stl robots/base.stl -o bases -s 8
verdict "and it is said" grep -q 'would have the same output, bases/base; draw them in two calls with -o FOLDER' "$complained"
check "a file of a folder is not drawn twice" 2 "$zraster" batch stems stems/part.stl -o bases -s 8
verdict "under any name" grep -q 'stems/part.stl is given twice' "$complained"

# What has no end is refused, or read until a signal.
mkdir pipes && mkfifo pipes/pipe.obj && ln -s pipe.obj pipes/link.obj && triangle >pipes/part.stl
mkdir jsons && cp scene.json jsons/ && cp part.stl jsons/
"$zraster" part.stl -s 8 -c info -o jsons/part.info.json
printf '{"name": "meshes", "scripts": {"polygons": []}}' >jsons/package.json
check "a batch leaves out JSON files that are no scenes" 0 "$zraster" batch jsons -o jsons/out -s 8 --json
verdict "and says how many" grep -q 'left out: JSON files without meshes or polygons, which are no scenes: 2; the first is jsons/package.json' "$complained"
verdict "but no scene" [ "$(ls jsons/out | tr '\n' ' ')" = "part.png scene.png " ]
mkdir only && cp jsons/part.info.json only/
check "a folder of nothing else is refused" 2 "$zraster" batch only
verdict "with the file" grep -q 'only/part.info.json is no scene' "$complained"
sed 's/8, "height": 8/160, "height": 120/' scene.json >large.json
check "a scene makes a sheet, views and a turntable" 0 "$zraster" sheet large.json -o scene-sheet.png
"$zraster" views scene.json -o sides/ --views top,front && "$zraster" turntable scene.json -o scene.gif --turntable 2
verdict "with its files" [ "$(ls sides | tr '\n' ' ')" = "scene.front.png scene.top.png " -a "$(head -c 6 scene.gif)" = GIF89a ]
check "a folder's pipes are no files" 0 timeout 20 "$zraster" batch pipes -o piped -s 8 --json
verdict "its other files are drawn" [ "$(wc -l <"$said")" = 1 ]
check "a device is refused" 1 timeout 20 "$zraster" /dev/zero -o x.png
verdict "with the reason" grep -q "it is a device, which has no end" "$complained"
"$zraster" - -o x.png </dev/null >"$said" 2>"$complained"
verdict "/dev/null is empty" grep -q "standard input: it is empty" "$complained"
yes | timeout 20 "$zraster" - --max-file-bytes 100000 -o x.png >"$said" 2>"$complained"
verdict "standard input ends at --max-file-bytes" grep -q "more than 100000 bytes; --max-file-bytes allows more" "$complained"
"$zraster" pipes/pipe.obj -o x.png >"$said" 2>"$complained" &
waiting=$!
sleep 0.3
kill $waiting
wait $waiting
verdict "one signal ends the wait for a pipe" [ $? = 130 ]

# A killed and resumed batch draws each file once, and leaves no other file.
check "all files, for comparison" 0 "$zraster" batch many -o whole -c color,depth -s 400 -j 1
killed=0 try=1
while [ $try -le 20 ] && [ $killed = 0 ]; do
    rm -rf part
    "$zraster" batch many -o part -c color,depth -s 400 -j 1 --json >first.txt 2>/dev/null &
    pid=$!
    tries=0
    while [ "$(find part -name '*.png' 2>/dev/null | wc -l)" -lt 3 ] && [ $tries -lt 1000 ]; do tries=$((tries + 1)); done
    kill -9 $pid 2>/dev/null
    wait $pid 2>/dev/null
    [ "$(find part -name 'm*.png' | wc -l)" -lt 12 ] && killed=1
    try=$((try + 1))
done
verdict "a batch was killed in the middle" [ $killed = 1 ]
there=$(find part -name '*.png' | wc -l)
check "--resume goes on" 0 "$zraster" batch many -o part -c color,depth -s 400 -j 1 --resume --json
verdict "finished files are skipped" [ "$(grep -c '"status":"skipped"' "$said")" = "$there" ]
verdict "the others are drawn" [ "$(grep -c '"status":"done"' "$said")" = $((13 - there)) ]
verdict "and nothing is lost, broken or left over" diff -r whole part
check "with --resume once more" 0 "$zraster" batch many -o part -c color,depth -s 400 --resume --json
verdict "all files are skipped" [ "$(grep -c '"status":"skipped"' "$said")" = 13 ]
check "resumed with another size" 0 "$zraster" batch many -o part -c color,depth -s 20 --resume --json
verdict "all files are drawn again" [ "$(grep -c '"status":"done"' "$said")" = 13 ]
verdict "with the reason" grep -q 'part/.zraster-batch has other settings: all files are drawn again' "$complained"
check "and once more" 0 "$zraster" batch many -o part -c color,depth -s 20 --resume --json
verdict "they are skipped" [ "$(grep -c '"status":"skipped"' "$said")" = 13 ]
rm part/.zraster-batch
check "without a record of the settings" 0 "$zraster" batch many -o part -c color,depth -s 20 --resume --json
verdict "they are drawn again" [ "$(grep -c '"status":"done"' "$said")" = 13 ]
mkdir scenes && cp scene.json scenes/plain.json
printf '{"window": {"width": 8, "height": 8}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}], "outputs": [{"channel": "depth"}, {"channel": "color"}]}' >scenes/two.json
check "scenes with outputs of their own" 0 "$zraster" batch scenes -o own
verdict "have all of them" [ "$(ls own | tr '\n' ' ')" = "plain.png two.depth.npy two.png " ]
check "--resume of these scenes" 0 "$zraster" batch scenes -o own --resume --json
verdict "skips them if all outputs exist" [ "$(grep -c '"status":"skipped"' "$said")" = 2 ]
rm own/two.png
check "with a missing output" 0 "$zraster" batch scenes -o own --resume --json
verdict "draws all outputs of that scene again" eval '[ -s own/two.png ] && [ "$(grep -c "\"status\":\"skipped\"" "$said")" = 1 ]'
mkdir more && cp part.stl more/ && cp part.stl more/nameless
check "a batch of one channel" 0 "$zraster" batch more/part.stl more/nameless -o grown -s 8
check "resumed with another channel" 0 "$zraster" batch more/part.stl more/nameless -o grown -s 8 -c color,depth --resume
verdict "draws that, too" [ -s grown/part.depth.npy -a -s grown/nameless.depth.npy ]
check "with all outputs present" 0 "$zraster" batch more/part.stl more/nameless -o grown -s 8 -c depth,color --encoding png --resume --json
verdict "skips the files" [ "$(grep -c '"status":"skipped"' "$said")" = 2 ]
check "with another encoding" 0 "$zraster" batch more/part.stl more/nameless -o grown -s 8 -c depth,color --encoding png16 --resume --json
verdict "draws them" [ "$(grep -c '"status":"done"' "$said")" = 2 -a -s grown/part.depth.png ]
check "an encoding of no channel" 1 "$zraster" batch more/part.stl -o grown -c color --encoding npy --resume
check "a channel alone" 0 "$zraster" batch more/part.stl -o alone -s 8 -c depth
check "has the plain name" 0 "$zraster" batch more/part.stl -o alone -s 8 -c depth --resume --json
verdict "and is skipped" [ "$(grep -c '"status":"skipped"' "$said")" = 1 -a -s alone/part.npy ]
"$zraster" batch many -o stopped -s 2000 -j 1 >"$said" 2>"$complained" &
pid=$!
within 4 eval '[ -n "$(ls stopped 2>/dev/null)" ]'
kill -INT $pid
wait $pid
verdict "an interrupted batch ends with 130" [ $? = 130 ]
verdict "and the message names --resume" grep -q 'interrupted: --resume draws the rest' "$complained"

printf '' >alone/part.npy
check "an output that a power cut left empty" 0 "$zraster" batch more/part.stl -o alone -s 8 -c depth --resume --json
verdict "is drawn again" [ "$(grep -c '"status":"done"' "$said")" = 1 -a -s alone/part.npy ]

# Shards
for shard in 0 1 2 3; do
    check "shard $shard of a folder" 0 "$zraster" batch many -o sharded -s 64 --shard $shard/4 --json
    cat "$said" >>shards.txt
    verdict "has its part of the 13 files" [ "$(wc -l <"$said")" = $(((16 - shard) / 4)) ]
done
verdict "every file is in one shard" [ "$(cut -d '"' -f 4 shards.txt | sort -u | wc -l)" = 13 -a "$(wc -l <shards.txt)" = 13 ]
verdict "and has the bytes of a whole batch" diff -r drawn sharded
check "a shard, resumed" 0 "$zraster" batch many -o sharded -s 64 --shard 1/4 --json --resume
verdict "skips its files" [ "$(grep -c '"status":"skipped"' "$said")" = 3 ]
check "a shard beyond the last file" 0 "$zraster" batch many -o sharded -s 64 --shard 13/20 --json
verdict "is empty" [ ! -s "$said" ]
printf '{"file": "part.stl", "output": "lines/%s.png", "width": 8, "height": 6}\n' a b c >lines.txt
"$zraster" batch - --shard 1/3 --json <lines.txt >"$said" 2>"$complained"
verdict "lines are counted from 0" grep -q '"outputs":\["lines/b.png"\]' "$said"
verdict "and drawn alone" [ ! -e lines/a.png -a ! -e lines/c.png -a "$(size_of_png lines/b.png)" = 8x6 ]
check "a list is read from a file as from standard input" 0 "$zraster" batch --list lines.txt --shard 2/3 --json
verdict "with the same shards" grep -q '"outputs":\["lines/c.png"\]' "$said"
seq -f 'far/set-%07.0f.stl' 0 199999 >lines.txt
most=200000
! grep -q __asan "$zraster" || most=unlimited # sanitizers take addresses of their own
(ulimit -v $most && "$zraster" batch - --shard 3/200000 --json -j 1 <lines.txt >"$said" 2>"$complained")
verdict "200 000 names, of which a shard has one, need little memory" grep -q '^{"file":"far/set-0000003.stl","status":"failed"' "$said"
echo 'far/set-0000007.stl' >>lines.txt
"$zraster" batch - --shard 3/200000 -o drawn <lines.txt >"$said" 2>"$complained"
verdict "files of other shards are refused if they would have the same output" [ $? = 2 ]
verdict "with their lines" grep -q 'lines 8 and 200001, .* would have the same output, drawn/far/set-0000007;' "$complained"

# Ctrl-C
interrupt() { # TEXT COMMAND...
    text=$1
    shift
    "$@" >"$said" 2>"$complained" &
    pid=$!
    within 4 grep -q '^SigCgt:.*4..2$' "/proc/$pid/status"
    sleep 0.1
    kill -INT $pid
    wait $pid
    verdict "$text ends with 130" [ $? = 130 ]
    verdict "and reports no fault" eval '! grep "zraster:" "$complained"'
}
mkfifo pipe.stl
interrupt "an interrupted wait for a writer" "$zraster" pipe.stl
sleep 20 >pipe.stl &
writer=$!
interrupt "an interrupted wait for bytes" "$zraster" pipe.stl
interrupt "an interrupted info" "$zraster" info pipe.stl
interrupt "an interrupted batch of a pipe" "$zraster" batch pipe.stl
kill $writer
rm pipe.stl
check "a batch before its input is a pipe" 0 "$zraster" batch scenes/plain.json -o piped
mkfifo plain.json
cat scenes/plain.json >plain.json &
check "reads the pipe once" 0 timeout 20 "$zraster" batch plain.json -o piped --resume --json
verdict "to draw it" grep -q '"status":"done"' "$said"
rm plain.json

# watch
printf 'mtllib paint.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >painted.obj
printf 'newmtl red\nKd 1 0 0\n' >paint.mtl
"$zraster" watch painted.obj -o painted.png -s 16 2>"$complained" &
watcher=$!
verdict "a file with a library is drawn" within 5 [ -s painted.png ]
rm -f painted.png
sleep 0.3
verdict "but not without a change" [ ! -e painted.png ]
printf 'newmtl red\nKd 0 0 1\n' >paint.mtl
verdict "and again when the library changes" within 5 [ -s painted.png ]
rm -f painted.png paint.mtl
sleep 0.3
printf 'newmtl red\nKd 0 1 0\n' >paint.mtl
verdict "or is written anew" within 5 [ -s painted.png ]
kill -INT $watcher
wait $watcher
cp part.stl live.stl
"$zraster" watch live.stl -o live.png -s 16 2>"$complained" &
watcher=$!
verdict "watch draws at once" within 5 [ -s live.png ]
rm -f live.png
touch live.stl
verdict "and again when the file changes" within 5 [ -s live.png ]
rm -f live.png
echo solid >live.stl
verdict "a broken file is reported" within 5 grep -q 'zraster: live.stl: ' "$complained"
mv live.stl away.stl
verdict "a removed file is reported" within 5 grep -q 'zraster: live.stl: No such file or directory; watch waits for it' "$complained"
sleep 0.7
verdict "only once" [ "$(grep -c 'watch waits' "$complained")" = 1 ]
cp part.stl live.stl
verdict "and drawn once it is back" within 5 [ -s live.png ]
kill -INT $watcher
wait $watcher
verdict "and ends with 130" [ $? = 130 ]
watcher=

# names that would command the terminal
odd=$(printf 'odd\033[31m\302\233\177.stl')
is_visible() { ! LC_ALL=C grep -q "$(printf '[\033\177\233]')" "$said" "$complained" && grep -qF 'odd?[31m' "$said" "$complained"; }
mkdir odd-out
for line in "$odd" "batch $odd -o odd-out" "info $odd" "compare $odd $odd" "part.stl --part $odd=$odd" \
    "mcp --root $odd" "part.stl --token-file $odd --server http://127.0.0.1:1" "batch --list $odd -o odd-out" "part.stl --$odd" "watch part.stl --part a=$odd"; do
    # shellcheck disable=SC2086
    "$zraster" $line >"$said" 2>"$complained" </dev/null
    verdict "no control byte is printed: zraster $(printf %s "$line" | LC_ALL=C tr -d '\000-\037\177-\377')" is_visible
done

# terminals
TERM=xterm-kitty script -qec "'$zraster' part.stl -s 16 --show" typescript </dev/null >"$said" 2>"$complained"
verdict "kitty gets its protocol" grep -q '_Gf=100,a=T,m=0;iVBORw0KGgo' "$said"
TERM_PROGRAM=iTerm.app script -qec "'$zraster' part.stl -s 16 --show" typescript </dev/null >"$said" 2>"$complained"
verdict "iTerm2 gets its protocol" grep -q ']1337;File=inline=1;size=[0-9]*:iVBORw0KGgo' "$said"
(sleep 0.15; printf '\033[?62;4;22c') | script -qec "'$zraster' part.stl -s 16 --show" typescript >"$said" 2>"$complained"
verdict "a terminal that answers 4 gets sixels" grep -q 'Pq"1;1;16;16#0;2;0;0;0' "$said"
script -qec "'$zraster' part.stl -s 16 --show" typescript </dev/null >"$said" 2>"$complained"
verdict "another terminal ends with a message" grep -q 'and this one has none of them; -o FILE saves the picture' "$said"

# sandboxes
if command -v strace >/dev/null; then
    ASAN_OPTIONS=detect_leaks=0 strace -f -e trace=network -o trace "$zraster" part.stl -s 64 2>"$complained"
    verdict "no socket is opened" eval '[ -s trace ] && ! grep -qE "^[0-9]+ +[a-z]+\(" trace'
else
    skip "no socket is opened" "strace is missing"
fi
inside() {
    bwrap --unshare-all --proc /proc --ro-bind /usr /usr --symlink usr/lib /lib --symlink usr/lib64 /lib64 --ro-bind "$zraster" /zraster \
        --ro-bind part.stl /part.stl /zraster /part.stl -s 64 -o - >inside.png 2>"$complained"
}
if bwrap --unshare-all --proc /proc --ro-bind / / true 2>/dev/null; then
    "$zraster" part.stl -s 64
    verdict "the command runs in a sandbox of /usr and the file" inside
    verdict "with the same bytes" cmp inside.png part.png
else
    skip "the command in a sandbox" "bwrap is missing or cannot make a sandbox"
fi
verdicts
