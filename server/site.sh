# site.sh - the table of server/routes/site.h, for server/page/build.sh and server/manual/build.sh, which source it. $out is the C file to
# write, $work a folder, which ends with the table.

count=0
table=
exec 3>"$out.new"
printf '#include "routes/site.h"\n\n' >&3

# Adds a file. Text is compressed; pictures stay as they are.
add() { # NAME TITLE FILES TYPE PATH
    packed=$work/file.gz
    plain_size=$(($(wc -c <"$5")))
    case $4 in
    image/*) packed=$5 plain_size=0 ;;
    *) gzip -9nc "$5" >"$packed" ;;
    esac
    size=$(($(wc -c <"$packed")))
    echo "static const unsigned char bytes_$count[$size] = {" >&3
    od -An -v -tu1 "$packed" | sed 's/^ *//; s/  */,/g; s/$/,/' >&3
    echo "};" >&3
    tag=$(sha256sum <"$packed" | cut -c 1-24)
    table="$table    {\"$1\", $2, $3, \"$4\", \"$tag\", bytes_$count, $size, $plain_size},
"
    count=$((count + 1))
}

# Ends the table of the files PREFIX_files. The lines of standard input follow it.
end_table() { # PREFIX
    printf '\nconst struct site_file %s_files[] = {\n%s};\n\nconst size_t %s_file_count = %s;\n' "$1" "$table" "$1" "$count" >&3
    cat >&3
    exec 3>&-
    rm -rf "$work"
    mv "$out.new" "$out"
}
