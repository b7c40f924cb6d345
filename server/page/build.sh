#!/bin/sh
# build.sh OUT: makes the page and the files of the examples, and writes all as a table of server/routes/site.h. Runs in the root of the
# repository.
set -eu
out=$1
work=$out.parts
rm -rf "$work"
mkdir -p "$work"
. server/site.sh

server/page/page.sh "$work" true
{
    echo "$work/page||NULL|NULL|text/html; charset=utf-8"
    server/page/examples.sh "$work" | awk -F '|' -v OFS='|' '
        $3 == "" { print $1, $2, "NULL", "NULL", $5; next }
        {
            list = $4
            gsub(/ +/, "\\\", \\\"", list)
            print $1, $2, "\"" $3 "\"", list == "" ? "\"[]\"" : "\"[\\\"" list "\\\"]\"", $5
        }'
} >"$work/list"
write_table site <"$work/list"
cat >>"$out.new" <<END

const char site_policy[] = "$(cat "$work/policy"); frame-ancestors 'none'";
END
mv "$out.new" "$out"
