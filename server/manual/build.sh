#!/bin/sh
# build.sh OUT: makes the manual of the daemon (pages.sh), and writes it as a table of server/routes/site.h. Runs in the root of the repository.
set -eu
out=$1
work=$out.parts

server/manual/pages.sh "$work" >"$out.list"
. server/site.sh
awk -F '|' '{ print $1 "|" $2 "|NULL|NULL|" $3 }' "$out.list" | write_table manual
rm "$out.list"
mv "$out.new" "$out"
