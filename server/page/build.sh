#!/bin/sh
# build.sh OUT: makes the page and the files of the examples, and writes all as a table of server/routes/site.h. Runs in the root of the
# repository.
set -eu
out=$1
work=$out.parts
rm -rf "$work"
mkdir -p "$work"
. server/site.sh

for kind in daemon both; do server/page/page.sh "$work/$kind" $kind; done
{
    for kind in daemon both; do echo "$work/$kind/page||NULL|NULL|text/html; charset=utf-8"; done
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

const char *const site_policies[] = {
$(for kind in daemon both; do echo "    \"$(cat "$work/$kind/policy"); frame-ancestors 'none'\","; done)
};
END
mv "$out.new" "$out"
