#!/bin/sh
# build.sh OUT: makes the manual of the daemon (pages.sh) and writes it as a table of server/site.h. Text is compressed, pictures are as they
# are. Runs in the root of the repository.
set -eu
out=$1
work=$out.parts

count=0
table=
server/manual/pages.sh "$work" >"$out.list"
exec 3>"$out.new"
echo '#include "site.h"' >&3
echo >&3
while IFS='|' read -r file address type; do
    plain_size=0
    packed=$file
    case $type in
    text/*)
        plain_size=$(($(wc -c <"$file")))
        packed=$work/file.gz
        gzip -9nc "$file" >"$packed"
        ;;
    esac
    size=$(($(wc -c <"$packed")))
    echo "static const unsigned char bytes_$count[$size] = {" >&3
    od -An -v -tu1 "$packed" | sed 's/^ *//; s/  */,/g; s/$/,/' >&3
    echo "};" >&3
    tag=$(sha256sum <"$packed" | cut -c 1-24)
    table="$table    {\"$address\", NULL, NULL, \"$type\", \"$tag\", bytes_$count, $size, $plain_size},
"
    count=$((count + 1))
done <"$out.list"
printf '\nconst struct site_file manual_files[] = {\n%s};\n\nconst size_t manual_file_count = %s;\n' "$table" "$count" >&3
exec 3>&-
rm -rf "$work" "$out.list"
mv "$out.new" "$out"
