#!/bin/sh
# man.sh BUILD: writes the man pages zraster.1, zrasterd.8 and libzraster.3 to BUILD, from the texts of --help and the public header.
set -eu
build=$1
header=core/api/zraster.h
version=$(sed -n 's/^#define ZRASTER_VERSION  *"\(.*\)"/\1/p' $header)

page() { # NAME SECTION SUMMARY
    printf '.TH %s %s "" "zraster %s"\n.SH NAME\n%s \\- %s\n' "$(echo "$1" | tr a-z A-Z)" "$2" "$version" "$1" "$3"
}
# Converts a text of --help to roff. Headings end with a colon, options begin with a dash, other indented lines are literal.
to_roff() {
    awk '
        function escaped(text) { gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text); sub(/^[.\047]/, "\\\\\\&&", text); return text }
        function literal(wanted) { if (wanted != is_literal) print wanted ? ".PP\n.nf" : ".fi"; is_literal = wanted }
        /^$/ { literal(0); print ".PP"; next }
        /^[A-Z][^.]*:$/ { literal(0); sub(/:$/, ""); print ".SH " toupper(escaped($0)); next }
        /^Usage: / { literal(0); print ".SH SYNOPSIS\n.B " escaped(substr($0, 8)) "\n.PP"; next }
        /^usage: / { literal(0); print ".SH SYNOPSIS\n.B " escaped(substr($0, 8)) "\n.SH OPTIONS"; next }
        /^ +-/ {
            literal(0)
            sub(/^ +/, "")
            split("", parts)
            split($0, parts, /  +/)
            print ".TP\n.B " escaped(parts[1])
            if (2 in parts) print escaped(substr($0, index($0, parts[2])))
            is_option = 1
            next
        }
        /^      / && is_option { sub(/^ +/, ""); print (is_option++ > 1 ? ".br\n" : "") escaped($0); next }
        /^ / { literal(1); print escaped(substr($0, 3)); next }
        { literal(0); is_option = 0; print escaped($0) }
        END { literal(0) }'
}

{
    page zraster 1 "renders 3D scenes and models to pictures, depth maps and ids"
    "$build/zraster" help | to_roff
    for command in info batch views sheet turntable compare watch mcp looks; do
        printf '.SH ZRASTER %s\n' "$(echo $command | tr a-z A-Z)"
        "$build/zraster" help $command | sed -e '/^Picture:/,$d' -e '/^General:/,$d' -e '/^Output:/d' | to_roff | sed '/^\.SH SYNOPSIS/d'
    done
    printf '.SH ENVIRONMENT\n.TP\n.B ZRASTER_SERVER\ndefault of \\-\\-server\n.TP\n.B ZRASTER_TOKEN\ntoken of the server, without \\-\\-token\\-file\n.TP\n.B NO_COLOR\nno progress bar, as with \\-\\-plain\n'
    printf '.SH SEE ALSO\n.BR zrasterd (8),\n.BR libzraster (3)\n'
} >"$build/zraster.1"
{
    page zrasterd 8 "renders the scenes and meshes that clients send over HTTP"
    "$build/zrasterd" --help | sed 1d | to_roff
    printf '.SH SEE ALSO\n.BR zraster (1)\n'
} >"$build/zrasterd.8"
{
    page libzraster 3 "renders 3D scenes within the calling process"
    printf '.SH SYNOPSIS\n.nf\n.B #include <zraster.h>\n.sp\n'
    tr '\n' ' ' <$header | grep -o 'ZRASTER_API [^;]*;' | grep -v __attribute__ | sed 's/ZRASTER_API //; s/  */ /g; s/\\/\\e/g; s/-/\\-/g'
    printf '.fi\n.SH DESCRIPTION\n.nf\n'
    sed -e '1,2d' -e '/^#ifndef ZRASTER_H/,/^#define ZRASTER_VERSION_NUMBER/d' -e '/^#ifdef __cplusplus/,$d' -e 's/ZRASTER_API //' \
        -e 's/\\/\\e/g; s/-/\\-/g' -e "s/^\\([.']\\)/\\\\\\&\\1/" -e 's/^ \* \{0,1\}//; s/^ \*\/$//' $header
    printf '.fi\n.SH SEE ALSO\n.BR zraster (1)\n'
} >"$build/libzraster.3"
