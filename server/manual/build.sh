#!/bin/sh
# build.sh OUT: makes the manual of the daemon (pages.sh), and writes it as a table of server/routes/site.h. Runs in the root of the repository.
set -eu
out=$1
work=$out.parts

server/manual/pages.sh "$work" >"$out.list"
. server/site.sh
while IFS='|' read -r file address type; do add "$address" NULL NULL "$type" "$file"; done <"$out.list"
rm "$out.list"
end_table manual </dev/null
