#!/bin/sh
# page.sh WORK KIND: joins the page of server/page/ and the list of formats as WORK/page, and writes its policy as WORK/policy, with the hashes of
# its script and style. KIND: `daemon`; `site` for a page that draws by itself, by the folder engine/ beside it; or `both` for a page of a daemon
# that does so while a model turns. Runs in the root of the repository.
set -eu
work=$1 kind=$2
page=server/page
mkdir -p "$work"

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

has_daemon=true has_engine=true left_out='^$'
case $kind in
daemon) has_engine=false left_out='/engine\.js$' ;;
site) has_daemon=false left_out='/daemon\.js$' ;;
esac

# A policy has the hash of the text between the tags, line ends included. The rows' enums of C are left out, and
# ZIP, which no scene can name. The script of a site is as small as esbuild makes it: it is loaded from afar.
{ echo "'use strict'; const HAS_DAEMON = $has_daemon, HAS_ENGINE = $has_engine;" && ${CC:-cc} -E -P -x c -Icore $page/formats.h | sed '/^enum /,/^};/d; s/{ending : "zip"[^}]*}, *//' && sed '/^ *\/\//d; /^$/d; s/^ *//; s| // [a-z`].*||' $(sed "s|^|$page/|" $page/scripts.txt | grep -v "$left_out"); } >"$work/script"
[ $kind != site ] || { esbuild --minify <"$work/script" >"$work/minified" && mv "$work/minified" "$work/script"; }
{ sed '/^$/d; s/^ *//; /^\/\*.*\*\/$/d; s/\([:,;{]\) /\1/g; s/ *\([{}]\)/\1/g' $page/colors.css $page/page.css | tr -d '\n' | sed 's/;}/}/g'; echo; } >"$work/style"
# Lines between <!-- daemon --> and <!-- all --> are for pages of daemons, those between <!-- site --> and <!-- all --> for others.
awk -v script="$work/script" -v style="$work/style" -v kind="$([ $has_daemon = true ] && echo daemon || echo site)" '
    function put(tag, file, line) {
        printf "<%s>", tag
        while ((getline line <file) > 0) print line
        printf "</%s>\n", tag
    }
    /<!-- style -->/ { put("style", style); next }
    /<!-- script -->/ { put("script", script); next }
    /<!-- (daemon|site|all) -->/ { is_out = !index($0, kind) && !/ all /; next }
    !is_out { sub(/^ */, ""); print }' $page/index.html >"$work/page"

# The engine's modules are imported, compiled and run in Workers.
of_engine= of_pictures=
[ $has_engine = false ] || of_engine=" 'self' 'wasm-unsafe-eval'"
[ $has_daemon = true ] || of_pictures=" 'self'"
printf '%s' "default-src 'none'; script-src 'sha256-$(policy_hash "$work/script")'$of_engine; style-src 'sha256-$(policy_hash "$work/style")'; \
img-src data: blob:$of_pictures; connect-src 'self'; ${of_engine:+worker-src 'self'; }base-uri 'none'; form-action 'none'; \
require-trusted-types-for 'script'" >"$work/policy"
