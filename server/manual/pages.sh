#!/bin/sh
# pages.sh OUT: makes the manual of the daemon in the folder OUT: its pages, their style and their pictures. Prints a line "FILE|ADDRESS|TYPE"
# for each. Runs in the root of the repository.
set -eu
out=$1
here=server/manual
rm -rf "$out"
mkdir -p "$out"

# FILE|ADDRESS, in the order of pages.txt. A pattern stands for the pages of a folder that are listed nowhere.
address() { echo "$1" | sed 's|^clients/docs/||; s|\.md$||'; }
grep -v '^#' $here/pages.txt | while IFS= read -r line; do
    case $line in
    =*) echo "$line" ;;
    *'*')
        for file in $line.md; do
            [ -e "$file" ] && ! grep -q "^$file\(|.*\)*\$" $here/pages.txt && echo "$file|$(address "$file")"
        done
        ;;
    *'|'*) [ ! -e "${line%%|*}" ] || echo "$line" ;;
    *) [ ! -e "$line" ] || echo "$line|$(address "$line")" ;;
    esac
done >"$out/list"
sed -n 's/^[^=|]*|\([^|]*\).*/\1/p' "$out/list" | grep / | sed 's|/[^/]*$||' | sort -u | while read -r folder; do mkdir -p "$out/$folder"; done
LC_ALL=C awk -v list="$out/list" -v out="$out" -v pictures="$out/pictures" -f $here/markdown.awk

sed -n 's/^[^=|]*|\([^|]*\).*/\1/p' "$out/list" | while read -r address; do
    echo "$out/${address:-index}.html|$address|text/html; charset=utf-8"
done
cat server/page/colors.css $here/manual.css >"$out/manual.css"
echo "$out/manual.css|manual.css|text/css; charset=utf-8"
while IFS='|' read -r file address; do echo "$file|$address|image/${file##*.}"; done <"$out/pictures"
