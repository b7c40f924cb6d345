#!/bin/sh
# The command-line client against a real daemon: what it saves, what it says, and how it
# ends. Prints TAP. ZRASTERD and ZRASTER name the two programs.
set -u
daemon=${ZRASTERD:-build/zrasterd}
client=$(realpath "${ZRASTER:-build/zraster}")
work=$(mktemp -d)
count=0
failed=0

"$daemon" --port 0 >"$work/out" 2>"$work/log" &
pid=$!
trap 'kill "$pid" 2>/dev/null; wait "$pid" 2>/dev/null; rm -rf "$work"' EXIT
tries=0
until server=$(sed -n 's/^listening on //p' "$work/out") && [ -n "$server" ]; do
    tries=$((tries + 1))
    [ "$tries" -lt 200 ] || { echo "Bail out! the daemon does not listen"; exit 1; }
    sleep 0.05
done
export ZRASTER_SERVER=$server

printf 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' >"$work/part one.stl"
printf '{"polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' >"$work/scene.json"
cd "$work" || exit 1

# check TEXT WANTED-STATUS COMMAND...: runs it; its output is in "said" and "complained".
check() {
    text=$1 wanted=$2
    shift 2
    "$@" >said 2>complained
    status=$?
    verdict "$text" [ "$status" = "$wanted" ]
}
verdict() { # TEXT COMMAND...
    text=$1
    shift
    count=$((count + 1))
    if "$@"; then
        echo "ok $count - $text"
    else
        failed=$((failed + 1))
        echo "not ok $count - $text"
        tail -n 5 said complained >&2
    fi
}
is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]; }
size_of_png() { od -An -j16 -N8 -tu1 "$1" | awk '{print $3 * 256 + $4 "x" $7 * 256 + $8}'; }

check "a mesh is saved under its own name with the picture's ending" 0 "$client" render "part one.stl"
verdict "and the name is told" [ "$(cat said)" = "part one.png" ]
verdict "and it is a PNG" is_png "part one.png"
verdict "of the usual size" [ "$(size_of_png 'part one.png')" = 640x480 ]
check "size, preset and shading are passed on" 0 "$client" render "part one.stl" --size 320x200 --preset top --shading gouraud -o small.png
verdict "and the picture has that size" [ "$(size_of_png small.png)" = 320x200 ]
check "how to compress is passed on" 0 "$client" render "part one.stl" --size 320x200 --preset top --shading gouraud --compress small -o smaller.png
verdict "and gives fewer bytes" [ "$(wc -c <smaller.png)" -lt "$(wc -c <small.png)" ]
check "depth comes as an array" 0 "$client" render scene.json --channel depth
verdict "and is saved as one" [ "$(cat said)" = scene.npy ]
check "info of a scene does not overwrite the scene" 0 "$client" render scene.json --channel info
verdict "but gets another name" [ "$(cat said)" = scene.out.json ]
verdict "and the scene is as it was" grep -q polygons scene.json
check "an output that is the input is refused" 1 "$client" render scene.json -o ./scene.json
verdict "and the scene is as it was" grep -q polygons scene.json
touch private.png && chmod 600 private.png && ln -s private.png link.png
check "an output through a link is written" 0 "$client" render scene.json -o link.png
verdict "where the link leads" is_png private.png
verdict "and the link stays" [ -L link.png ]
verdict "and so do the rights" [ "$(stat -c %a private.png)" = 600 ]
check "other protocols than HTTP are refused" 1 "$client" render scene.json --server file:///etc/passwd
check "- is standard output" 0 "$client" render scene.json -o -
verdict "and nothing but the picture is on it" is_png said
"$client" render - --type json -o piped.png <scene.json >said 2>complained
verdict "- is standard input" is_png piped.png
printf '{"polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,"x"]], "colour": 1}]}' >bad.json
check "a scene that is refused ends with 1" 1 "$client" render bad.json
verdict "and each fault is told with its place" grep -q '^  /polygons/0/vertices/2/2: expected a number' complained
verdict "and nothing is saved" [ ! -e bad.png ]
printf '{"polygons": [{"vertices": [[0,0,0],[0,1,0],[1,0,0]]}]}' >away.json
check "a scene that shows nothing is saved" 0 "$client" render away.json
verdict "with a warning" grep -q '^warning: nothing is seen' complained
check "a server that is not there ends with 1" 1 "$client" render scene.json --server http://127.0.0.1:1
verdict "and is named" grep -q 127.0.0.1:1 complained
check "a file that is not there ends with 1" 1 "$client" render nothing.obj
verdict "and is named" grep -q 'nothing.obj: No such file' complained
check "a folder that is not there ends with 1" 1 "$client" render scene.json -o no/such/folder/x.png
check "an unknown option ends with 2" 2 "$client" render scene.json --colour
check "a broken size ends with 2" 2 "$client" render scene.json --size 640
check "an unknown ending ends with 2" 2 "$client" render said
check "no file ends with 2" 2 "$client" render
check "help ends with 0" 0 "$client" --help
verdict "and shows every option" eval 'for o in -o --channel --encoding --scale --preset --shading --compress --size --type --server; do grep -q -e "^  $o " said || exit 1; done'
echo "1..$count"
[ "$failed" = 0 ]
