#!/bin/sh
# examples.sh WORK: makes the files of the examples in WORK. Prints a line "FILE|NAME|TITLE|FILES|TYPE" for each scene, whose FILES are names with
# spaces between, and "FILE|NAME|||TYPE" for each of these. Runs in the root of the repository.
set -eu
work=$1
examples=server/page/examples
mkdir -p "$work"
while IFS='|' read -r name title files; do
    if [ -e "$examples/$name.awk" ]; then
        LC_ALL=C awk -f "$examples/$name.awk" >"$work/$name.json"
    elif [ -e "$examples/$name.json" ]; then
        cp "$examples/$name.json" "$work"
    else
        cp "clients/examples/$name.json" "$work"
    fi
    echo "$work/$name.json|$name|$title|$files|application/json"
done <$examples/list.txt
for profile in "$examples"/*.profile; do
    name=$(basename "$profile" .profile).obj
    LC_ALL=C awk -f $examples/lathe.awk "$profile" >"$work/$name"
    echo "$work/$name|$name|||model/obj"
done
