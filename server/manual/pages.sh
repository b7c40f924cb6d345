#!/bin/sh
# pages.sh OUT: makes the manual of the daemon in the folder OUT: its pages, their style and their pictures. Prints a line "FILE|ADDRESS|TYPE"
# for each. Runs in the root of the repository.
set -eu
out=$1
here=server/manual
export LC_ALL=C
rm -rf "$out"
mkdir -p "$out"

# FILE|ADDRESS, in the order of pages.txt. A pattern stands for the pages of a folder that are listed nowhere.
ls clients/docs/*.md clients/docs/*/*.md >"$out/files"
awk -F '|' '
    function page(file, address) {
        address = file
        sub(/^clients\/docs\//, "", address)
        sub(/\.md$/, "", address)
        return file "|" address
    }
    function is_there(file, line, found) {
        found = (getline line <file) >= 0
        close(file)
        return found
    }
    NR == FNR { file[++files] = $1; next }
    /^#/ { next }
    { lines[++count] = $0; listed[$1] = 1 }
    END {
        for (i = 1; i <= count; i++) {
            split(lines[i], fields, "|")
            if (lines[i] ~ /^=/) print lines[i]
            else if (lines[i] ~ /\*$/) {
                folder = substr(lines[i], 1, length(lines[i]) - 1)
                for (k = 1; k <= files; k++)
                    if (index(file[k], folder) == 1 && substr(file[k], length(folder) + 1) !~ /\// && !(file[k] in listed)) print page(file[k])
            } else if (is_there(fields[1])) print lines[i] ~ /\|/ ? lines[i] : page(lines[i])
        }
    }' "$out/files" $here/pages.txt >"$out/list"
sed -n 's/^[^=|]*|\([^|]*\)\/[^|/]*\(|.*\)*$/\1/p' "$out/list" | sort -u | sed "s|^|$out/|" | xargs mkdir -p
awk -v list="$out/list" -v out="$out" -v pictures="$out/pictures" -f $here/markdown.awk

awk -F '|' -v out="$out" '!/^=/ { print out "/" ($2 == "" ? "index" : $2) ".html|" $2 "|text/html; charset=utf-8" }' "$out/list"
cat server/page/colors.css $here/manual.css >"$out/manual.css"
echo "$out/manual.css|manual.css|text/css; charset=utf-8"
awk -F '|' '{ type = $1; sub(/.*\./, "", type); print $1 "|" $2 "|image/" type }' "$out/pictures"
