#!/bin/sh
# The command with ZRASTER_SERVER and a real daemon: its outputs, messages and exit statuses. Prints TAP.
# ZRASTERD and ZRASTER name the two programs.
set -u
daemon=${ZRASTERD:-build/zrasterd}
client=$(realpath "${ZRASTER:-build/zraster}")
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
. tests/support/address.sh
said=said complained=complained

secret='a long/random text+of=characters'

"$daemon" --port 0 >"$work/out" 2>"$work/log" &
pid=$!
ZRASTER_TOKEN=$secret "$daemon" --port 0 >"$work/guarded-out" 2>"$work/guarded-log" &
guarded_pid=$!
trap 'kill "$pid" "$guarded_pid" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
server=$(address_in "$work/out")
guarded=$(address_in "$work/guarded-out")
case $server$guarded in *Bail*) echo "$server $guarded"; exit 1 ;; esac
unset ZRASTER_TOKEN
export ZRASTER_SERVER=$server

triangle >"$work/part one.stl"
printf '{"polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' >"$work/scene.json"
cd "$work" || exit 1

check "a mesh is saved under its own name with the picture's ending" 0 "$client" render "part one.stl"
verdict "and nothing is printed" [ ! -s said ]
verdict "and it is a PNG" is_png "part one.png"
verdict "of the usual size" [ "$(size_of_png 'part one.png')" = 640x480 ]
check "size, preset and shading are passed on" 0 "$client" render "part one.stl" --size 320x200 --preset top --shading gouraud -o small.png
verdict "and the picture has that size" [ "$(size_of_png small.png)" = 320x200 ]
check "size is that of a scene, too" 0 "$client" render scene.json --size 32x20 -o sized.png
verdict "and replaces its window" [ "$(size_of_png sized.png)" = 32x20 ]
check "--compress is passed on" 0 "$client" render "part one.stl" --size 320x200 --preset top --shading gouraud --compress small -o smaller.png
verdict "and gives fewer bytes" [ "$(wc -c <smaller.png)" -lt "$(wc -c <small.png)" ]
check "depth comes as an array" 0 "$client" render scene.json --channel depth
verdict "and is saved as one" [ "$(head -c 6 scene.npy | tail -c 5)" = NUMPY ]
check "info of a scene does not overwrite the scene" 0 "$client" render scene.json --channel info -v
verdict "but gets another name" grep -q '^scene.out.json  ' complained
verdict "and the scene is as it was" grep -q polygons scene.json
check "an output that is the input is refused" 2 "$client" render scene.json -o ./scene.json
verdict "and the scene is as it was" grep -q polygons scene.json
touch private.png && chmod 600 private.png && ln -s private.png link.png
check "an output through a link is written" 0 "$client" render scene.json -o link.png
verdict "where the link leads" is_png private.png
verdict "and the link stays" [ -L link.png ]
ln -s nothing.png dangling.png
check "an output through a link to nothing is written" 0 "$client" render scene.json -o dangling.png
verdict "to where the link leads" is_png nothing.png
verdict "and so do the rights" [ "$(stat -c %a private.png)" = 600 ]
check "other protocols than HTTP are refused" 1 "$client" render scene.json --server file:///etc/passwd
check "- is standard output" 0 "$client" render scene.json -o -
verdict "and nothing but the picture is on it" is_png said
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >mesh.obj
"$client" render - --type json -o piped.png <scene.json >said 2>complained
verdict "- is standard input" is_png piped.png
printf '{"polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,"x"]], "colour": 1}]}' >bad.json
check "a scene that is refused ends with 1" 1 "$client" render bad.json
verdict "and each fault has its place" grep -q '^  /polygons/0/vertices/2/2: expected a number' complained
verdict "and nothing is saved" [ ! -e bad.png ]
printf '{"polygons": [{"vertices": [[0,0,0],[0,1,0],[1,0,0]]}]}' >away.json
check "a scene that shows nothing is saved" 0 "$client" render away.json
verdict "with a warning" grep -q '^warning: nothing is visible' complained
check "with --strict, it fails instead" 3 "$client" render away.json --strict true -o strict.png
verdict "for the same reason" grep -q 'nothing is visible' complained
verdict "and nothing is saved" [ ! -e strict.png ]
check "strict alone means true" 3 "$client" render --strict -o strict.png away.json
verdict "and takes no option for its value" grep -q 'nothing is visible' complained
check "nor the file" 3 "$client" render --strict away.json -o strict.png
check "and is the last, too" 3 "$client" render away.json -o strict.png --strict
check "--strict=yes is refused" 2 "$client" render away.json --strict=yes -o strict.png
check "and false is not strict" 0 "$client" render --strict false -o lax.png away.json
check "the same of other truths" 0 "$client" render "part one.stl" --double-sided --fill -o both.png
check "-o is no value of an option" 2 "$client" render away.json --channel -o strict.png
check "a server that is not there ends with 1" 1 "$client" render scene.json --server http://127.0.0.1:1
verdict "and is named" grep -q 127.0.0.1:1 complained
verdict "and the message has advice" grep -q 'start zrasterd there, or leave out --server to render here' complained
check "a file that is not there ends with 1" 1 "$client" render nothing.obj
verdict "and is named" grep -q 'nothing.obj: No such file' complained
check "a folder that is not there ends with 2" 2 "$client" render scene.json -o no/such/folder/x.png

# addresses
check "HOST:PORT is http" 0 "$client" render scene.json --server "${server#http://}" -o plain.png
verdict "and gives the picture" is_png plain.png
check "localhost:PORT, too" 0 "$client" render scene.json --server "localhost:${server##*:}" -o local.png
check "a URL may have a path, behind which /v1/render is" 1 "$client" render scene.json --server "$server/zraster/"
verdict "and not in its place" grep -q '404' complained
check "a wrong address ends with 1" 1 "$client" render scene.json --server 'http://:::'
verdict "and the message has a right one" grep -q 'not an address; give HOST:PORT' complained
check "a password in an address" 1 "$client" render scene.json --server 'http://me:hunter2@127.0.0.1:1'
verdict "is not shown" eval '! grep -q hunter2 complained said'

# the token
printf '%s\r\nanother line\n' "$secret" >token
check "without its token a server refuses" 1 "$client" render scene.json --server "$guarded" -o token.png
verdict "and the message names the options" grep -q -e '--token-file FILE, or the variable ZRASTER_TOKEN' complained
check "the token is a file's first line" 0 "$client" render scene.json --server "$guarded" --token-file token -o token.png
verdict "and gives the picture" is_png token.png
check "the token may be in ZRASTER_TOKEN" 0 env ZRASTER_TOKEN="$secret" "$client" render scene.json --server "$guarded" -o token.png
check "the file is preferred" 0 env ZRASTER_TOKEN=wrong "$client" render scene.json --server "$guarded" --token-file=token -o token.png
check "a wrong token is refused" 1 env ZRASTER_TOKEN=wrong-one "$client" render scene.json --server "$guarded" -o token.png
verdict "and the message names its origin" grep -q 'The server rejected the token of ZRASTER_TOKEN' complained
verdict "but not the token" eval '! grep -q wrong-one complained said'
check "a token on the command line ends with 2" 2 "$client" render scene.json --server "$guarded" --token=another-one
verdict "and the message has advice" grep -q -e '--token-file FILE' complained
verdict "without being shown" eval '! grep -q another-one complained said'
check "nor behind a blank" 2 "$client" render scene.json --token another-one
verdict "is it shown" eval '! grep -q another-one complained said'
check "a token file that is not there ends with 1" 1 "$client" render scene.json --token-file missing
verdict "and is named" grep -q 'token file missing: No such file' complained
: >empty && printf 'two\twords\n' >words
check "an empty token file ends with 1" 1 "$client" render scene.json --token-file empty
check "a token with a tab ends with 1" 1 "$client" render scene.json --token-file words
verdict "and is not shown" eval '! grep -q "two" complained said'
check "a token with a line break in it ends with 1" 1 env ZRASTER_TOKEN="a
X-Header: b" "$client" render scene.json
verdict "no log has a token" eval '! grep -q -e "$secret" -e wrong-one log guarded-log'

# endings
printf '{"window": {"width": 8, "height": 8}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}],
 "outputs": [{"channel": "color"}, {"channel": "depth"}]}' >two.json
check "a ZIP is not saved as a picture" 2 "$client" render two.json -o two.png
verdict "and the message names the format and its ending" grep -q 'a ZIP archive of several outputs; -o two.zip saves it; or save its files: -o FOLDER/' complained
verdict "and nothing is saved" [ ! -e two.png ]
check "but as a ZIP" 0 "$client" render two.json -o two.ZIP
check "an array is not saved as a picture" 2 "$client" render scene.json --channel depth -o depth.png
verdict "and the message names the ending and the encoding of a picture" grep -q -e '-o depth.npy saves it; depth has a PNG, too: --encoding png16' complained
check "a PNG is not saved as a TGA" 2 "$client" render scene.json -o v1.2/a.tga
verdict "and a folder's dot is no ending" grep -q -e '-o v1.2/a.png saves a picture' complained
check "an unknown ending is refused" 2 "$client" render two.json -o two.part
check "a name without an ending accepts any format" 0 "$client" render scene.json -o ./none

# standard input and output
"$client" render - --type=obj --size=20x10 <"$work/mesh.obj" >said 2>complained
verdict "a picture of standard input goes to standard output" [ "$(size_of_png said)" = 20x10 ]
"$client" render - --size=20x10 <"$work/mesh.obj" >said 2>complained
verdict "and its format is detected" [ "$(size_of_png said)" = 20x10 ]
cp scene.json kept.json
"$client" render - --type json --channel info -o kept.json <kept.json >said 2>complained
verdict "standard input is not overwritten" cmp -s scene.json kept.json
verdict "and the message says so" grep -q 'standard input: the output would overwrite its own input' complained
ln -s kept.json by-link.json && ln kept.json by-name.json
for name in by-link.json by-name.json; do
    check "an input is not overwritten through $name" 2 "$client" render kept.json --channel info -o "$name"
    verdict "and it is as it was" cmp -s scene.json kept.json
done
ln -s kept.json kept.out.json
check "nor if a link has the default name of the output" 2 "$client" render kept.json --channel info
verdict "and it is as it was" cmp -s scene.json kept.json
script -qec "'$client' render scene.json -o -" typescript </dev/null >said 2>complained
verdict "a terminal gets no picture" grep -q 'standard output is a terminal, and the output is a PNG; -o FILE saves it' said

# the command line
check "an unknown option ends with 2" 2 "$client" render scene.json --colour
check "and its value is not repeated" 2 "$client" render scene.json --passwort=geheim
verdict "but the name is" eval 'grep -q "unknown option --passwort;" complained && ! grep -q geheim complained'
check "--name=value is --name value" 0 "$client" render "part one.stl" --size=32x20 --preset=top -o=equals.png
check "a value that is missing ends with 2" 2 "$client" render scene.json --channel
check "so does an empty one" 2 "$client" render scene.json --channel=
check "and another option in its place" 2 "$client" render scene.json --channel --encoding png
verdict "and the option is named" grep -q 'a value is missing after --channel: --channel NAME' complained
cp scene.json ./--scene.json
check "behind -- there are files" 0 "$client" render -o dashes.png -- --scene.json
for size in 640x 640x480x1 -1x5 +5x5 ' 5x5' 5x99999999; do
    check "a size of $size ends with 2" 2 "$client" render "part one.stl" --size "$size"
done
for option in --preset=top --shading=flat --up=z; do
    check "a scene with ${option%=*} ends with 2" 2 "$client" render scene.json "$option"
    verdict "and the message names it" grep -q -e "${option%=*} is for meshes, ending with .obj .3mf .zip .stl .ply .glb .gltf .off .pcd .xyz; " complained
done
check "a server's word on a parameter" 2 "$client" render "part one.stl" --preset iso
verdict "is about the option" grep -q "^zraster: --preset: 'iso' is unknown (did you mean isometric?); allowed: front," complained
check "its word on a width" 2 "$client" render "part one.stl" --size 99999x5
verdict "is about that option" grep -q "^zraster: --size: '99999'" complained
cp "$work/mesh.obj" mesh.wavefront
check "an unknown ending is no fault" 0 "$client" render mesh.wavefront
printf '%%PDF-1.4 and so on' >document
check "unknown bytes are" 1 "$client" render document
verdict "and the message names their format" grep -q 'looks like a PDF document, which is none of: json, obj' complained
check "an unknown type ends with 2" 2 "$client" render said --type dae
verdict "and the message lists the types" grep -q -e '--type accepts one of json obj 3mf zip stl ply glb gltf off pcd xyz, not dae' complained
check "no file ends with 2" 2 "$client" render
check "two files end with 2" 2 "$client" render scene.json two.json
check "another command ends with 2" 2 "$client" draw scene.json
check "help ends with 0" 0 "$client" --help
verdict "and shows every option" eval 'for o in -o --channel --encoding --scale --preset --shading --compress --size --azimuth --elevation --up --projection --color --background --outline --fill --double-sided --type --server --token-file; do grep -q -e " $o " said || exit 1; done'
mkdir -p model/maps
printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000' >"model/maps/a b.bin"
echo unused >model/maps/t.png
printf '{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"images":[{"uri":"maps/t.png"}],"buffers":[{"byteLength":36,"uri":"maps/a%%20b.bin"}]}' >model/x.gltf
check "files that a model refers to are sent, without a warning of unused ones" 0 "$client" render model/x.gltf -o sent.png --strict
ZRASTER_SERVER= "$client" render model/x.gltf -o here.png -q
verdict "and the picture is that of this process" cmp sent.png here.png
"$client" render scene.json -c color,depth -o pictures.zip
check "an archive without a model is refused" 1 "$client" render pictures.zip
verdict "and the endings of models are named" grep -q 'the ZIP archive has no model: no member ends with one of json, obj' complained
verdicts
