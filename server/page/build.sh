#!/bin/sh
# build.sh OUT: joins the page of server/page/ and the list of formats, hashes its script and style for the policy, makes the files of the
# examples, and writes all as a table of server/routes/site.h. Runs in the root of the repository.
set -eu
out=$1
work=$out.parts
page=server/page
examples=$page/examples
rm -rf "$work"
mkdir -p "$work"
. server/site.sh

# The hash as a policy names it: base64 of the 32 bytes.
policy_hash() { # FILE
    sha256sum <"$1" | awk '
        function digit(c) { return index("0123456789abcdef", c) - 1 }
        {
            letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
            hex = substr($1, 1, 64) "00"
            for (i = 1; i <= 66; i += 3) {
                bits = digit(substr(hex, i, 1)) * 256 + digit(substr(hex, i + 1, 1)) * 16 + digit(substr(hex, i + 2, 1))
                text = text substr(letters, int(bits / 64) + 1, 1) substr(letters, bits % 64 + 1, 1)
            }
            print substr(text, 1, 43) "="
        }'
}

# A policy has the hash of the text between the tags, line ends included. The rows' enums of C are left out.
{ echo "'use strict';" && ${CC:-cc} -E -P -x c -Icore $page/formats.h | sed '/^enum /,/^};/d' && sed '/^ *\/\//d; s/^ *//' $(sed "s|^|$page/|" $page/scripts.txt); } >"$work/script"
sed 's/^ *//' $page/colors.css $page/page.css >"$work/style"
awk -v script="$work/script" -v style="$work/style" '
    function put(tag, file, line) {
        printf "<%s>", tag
        while ((getline line <file) > 0) print line
        printf "</%s>\n", tag
    }
    /<!-- style -->/ { put("style", style); next }
    /<!-- script -->/ { put("script", script); next }
    { sub(/^ */, ""); print }' $page/index.html >"$work/page"

{
    echo "$work/page||NULL|NULL|text/html; charset=utf-8"
    while IFS='|' read -r name title files; do
        if [ -e "$examples/$name.awk" ]; then
            LC_ALL=C awk -f "$examples/$name.awk" >"$work/$name.json"
        elif [ -e "$examples/$name.json" ]; then
            cp "$examples/$name.json" "$work"
        else
            cp "clients/examples/$name.json" "$work"
        fi
        list=
        for file in $files; do list="$list${list:+, }\\\"$file\\\""; done
        echo "$work/$name.json|$name|\"$title\"|\"[$list]\"|application/json"
    done <$examples/list.txt
    for profile in "$examples"/*.profile; do
        name=$(basename "$profile" .profile).obj
        LC_ALL=C awk -f $examples/lathe.awk "$profile" >"$work/$name"
        echo "$work/$name|$name|NULL|NULL|model/obj"
    done
} >"$work/list"
write_table site <"$work/list"
cat >>"$out.new" <<END

const char site_policy[] = "default-src 'none'; script-src 'sha256-$(policy_hash "$work/script")'; "
                           "style-src 'sha256-$(policy_hash "$work/style")'; "
                           "img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
                           "frame-ancestors 'none'; require-trusted-types-for 'script'";
END
mv "$out.new" "$out"
