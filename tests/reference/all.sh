#!/bin/sh
# all.sh BUILD REFERENCE: the long comparison with Mesa, part by part, and a page about it: BUILD/reference/report.html.
# REFERENCE is how zraster-verify gets hold of Mesa, osmesa or egl. Ends with the worst status of the parts.
set -u
build=$1 reference=$2
programs=$(tests/reference/programs.sh "$build") || exit 2
verify=$programs/zraster-verify
data=${DATA:-../shared/data}
assimp=/usr/share/assimp/models
out=$build/reference
worst=0 number=10
rm -rf "$out"
mkdir -p "$out" || exit 2

# part TITLE PROGRAM ARGUMENT...
part() {
    title=$1 program=$2
    shift 2
    printf '\n== %s\n' "$title"
    "$program" --title "$title" --page "$out/$number.part" --failures "$out/failures" "$@"
    status=$?
    [ $status -le $worst ] || worst=$status
    [ -e "$out/$number.part" ] || printf '<section><h2>%s <span class="bad">did not run</span></h2></section>\n' "$title" >"$out/$number.part"
    number=$((number + 1))
}

# Those of these paths that are there; the others are named.
present() {
    for path in "$@"; do
        if [ -e "$path" ]; then printf '%s ' "$path"; else echo "LEFT OUT: there is no $path" >&2; fi
    done
}

"$programs/zraster-verify-lines" --primitives 300000
worst=$?
meshes=$(present "$data/models" $assimp/OBJ $assimp/STL $assimp/invalid)
scenes='tests/scenes clients/examples'
part 'Scenes, one case each' "$verify" $scenes
part 'Random polygons' "$verify" --triangles 2100000 --floats 3000
[ -n "$meshes" ] && part 'Models from seven sides' "$verify" --preset all $meshes
[ -d "$data/models" ] && part 'Models cut by the window' "$verify" --kind none --models "$data/models"
[ "$reference" = osmesa ] && part 'The same through EGL' "$programs/zraster-verify-egl" --plain --triangles 200000 $scenes
part 'A second opinion: softpipe' "$verify" --driver softpipe --plain --triangles 200000 $scenes $(present "$data/models/suzanne.obj")
part 'A transform of its own' "$verify" --transform independent --plain --triangles 1000000 $scenes $meshes

if [ $worst -eq 0 ]; then verdict='<span class="good">all is well</span>'; else verdict='<span class="bad">not all is well</span>'; fi
{
    cat tests/reference/page/page-head.html
    printf '<p class="verdict">%s</p>\n' "$verdict"
    cat tests/reference/page/page-summary.html "$out"/*.row
    echo '</table></div></section>'
    cat "$out"/*.part tests/reference/page/page-foot.html
} >"$out/report.html"
rm -f "$out"/*.part "$out"/*.row
printf '\nreport: %s\n' "$out/report.html"
exit $worst
