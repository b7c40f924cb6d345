#!/bin/sh
# build.sh PACKAGE OUT: makes a folder for any server of files: the page of server/page/ with the renderer of the package in PACKAGE, examples,
# manual, and a service worker for use without a network. Runs in the root of the repository.
set -eu
package=$1 out=$2
work=$out.parts
rm -rf "$out" "$work"
mkdir -p "$out/engine" "$out/v1/examples" "$work"
export LC_ALL=C

# The page, whose policy is in it: a server of files sends none.
server/page/page.sh "$work" site
sed "s|<meta charset=\"utf-8\">|&<meta http-equiv=\"Content-Security-Policy\" content=\"$(cat "$work/policy")\">|" "$work/page" >"$out/index.html"

# The scripts of the renderer, without those for Node.
esbuild --log-level=warning --bundle --splitting --format=esm --minify --keep-names --out-extension:.js=.mjs --outdir="$out/engine" \
    "$package/browser.mjs" "$package/worker.mjs" "$package/worker_thread.mjs"
cp "$package/zraster.wasm" "$package/zraster-scalar.wasm" "$package/LICENCES.txt" "$out/engine"

# Lists and files by the addresses of the daemon.
server/page/examples.sh "$work" >"$work/examples"
mkdir "$out/looks"
node clients/web/site/looks.mjs "$package" "$work" "$out/looks" >"$out/v1/looks"
awk -F '|' '
    $3 != "" {
        list = $4
        gsub(/ +/, "\", \"", list)
        printf "%s{\"name\": \"%s\", \"title\": \"%s\", \"files\": [%s]}", n++ ? ", " : "{\"examples\": [", $2, $3, list == "" ? "" : "\"" list "\""
    }
    END { print "]}" }' "$work/examples" >"$out/v1/examples/index.json"
while IFS='|' read -r file name rest; do cp "$file" "$out/v1/examples/$name"; done <"$work/examples"

# The manual. Servers of files need endings, so links get them.
server/manual/pages.sh "$work/manual" >"$work/pages"
while IFS='|' read -r file address type; do
    case $type in
    text/html*)
        address=${address:-index}.html
        mkdir -p "$out/docs/$(dirname "$address")"
        sed -E 's|href="(([^":#]*/)?[^":#/.]+)(#[^"]*)?"|href="\1.html\3"|g' "$file" >"$out/docs/$address"
        ;;
    *)
        mkdir -p "$out/docs/$(dirname "$address")"
        cp "$file" "$out/docs/$address"
        ;;
    esac
done <"$work/pages"

# The service worker, with the list of its files, and a version that changes with them.
files=$(cd "$out" && find . -type f ! -path './docs/*' ! -name LICENCES.txt ! -name zraster-scalar.wasm | sort)
version=$(cd "$out" && cat $files | sha256sum | cut -c 1-16)
{
    echo "const VERSION = '$version';"
    echo "const FILES = ['./', $(echo "$files" | sed "s|^\./\(.*\)|'\1'|" | paste -s -d , | sed 's/,/, /g')];"
    esbuild --minify clients/web/site/offline.js
} >"$out/offline.js"
rm -r "$work"
