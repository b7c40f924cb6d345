# site.sh - the table of server/routes/site.h, for server/page/build.sh and server/manual/build.sh, which source it. $out is the C file to
# write, $work a folder that the compiler reads, too. Each program is called once for all files, not once for each.

# Writes the table PREFIX_files from lines "FILE|NAME|TITLE|FILES|TYPE" of standard input. Text is compressed, and lies in $work; pictures
# stay as they are.
write_table() { # PREFIX
    cat >"$work/table"
    cut -d '|' -f 1 "$work/table" | xargs wc -c >"$work/sizes"
    awk -F '|' '$5 !~ /^image\// { print $1 }' "$work/table" | xargs gzip -9nf
    awk -F '|' '{ print $1 ($5 ~ /^image\// ? "" : ".gz") }' "$work/table" >"$work/packed"
    xargs wc -c <"$work/packed" >>"$work/sizes"
    xargs sha256sum <"$work/packed" >"$work/sums"
    awk -F '|' -v prefix="$1" -v sizes="$work/sizes" -v sums="$work/sums" '
        BEGIN {
            while ((getline line <sizes) > 0) {
                split(line, fields, " ")
                size[fields[2]] = fields[1]
            }
            while ((getline line <sums) > 0) {
                split(line, fields, " ")
                tag[fields[2]] = substr(fields[1], 1, 24)
            }
            print "#include \"routes/site.h\"\n"
        }
        {
            is_text = $5 !~ /^image\//
            packed = $1 (is_text ? ".gz" : "")
            bytes = prefix "_bytes_" NR
            print "extern const unsigned char " bytes "[] __attribute__((visibility(\"hidden\")));"
            print "__asm__(\".pushsection .rodata\\n.globl " bytes "\\n" bytes ": .incbin \\\"" packed "\\\"\\n.popsection\\n\");"
            rows = rows sprintf("    {\"%s\", %s, %s, \"%s\", \"%s\", %s, %d, %d},\n", $2, $3, $4, $5, tag[packed], bytes, size[packed],
                is_text ? size[$1] : 0)
        }
        END {
            printf "\nconst struct site_file %s_files[] = {\n%s};\n\nconst size_t %s_file_count = %d;\n", prefix, rows, prefix, NR
        }' "$work/table" >"$out.new"
}
