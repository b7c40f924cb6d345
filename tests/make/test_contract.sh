#!/bin/sh
# The contract names what the tables of rows have: formats, parameters, channels. Prints TAP.
set -u
. tests/support/verdict.sh
contract=server/api/v1.md said=/dev/null complained=/dev/null

rows() { # FILE FIELD: that field of each ROW(...) of a header
    sed -n '/^#define .*ROWS(ROW)/,/^$/p' "$1" | tr -d '\\\n' | sed 's/ROW(/\n&/g' | sed -n 's/^ROW(//p' | awk -F', *' -v field="$2" '{ gsub(/"/, "", $field); print $field }'
}
lists() { # HEADER FIELD LEAST: at least so many, each of them as `name`, or as ?name=
    named=0
    for name in $(rows "$1" "$2"); do
        named=$((named + 1))
        grep -q -e "\`$name\`" -e "[?&]$name=" $contract || { echo "# $contract lacks $name" && return 1; }
    done
    [ $named -ge "$3" ]
}
keys() { # of all tables of fields, but for those that this version refuses, which have no reader
    cat core/input/json_*.[ch] | grep -oE '(\{|IMAGE\(|PIXELS\()"[A-Za-z]+", [A-Za-z_]+|\.key = "[A-Za-z]+",' |
        sed 's/[^"]*"\([A-Za-z]*\)".*/\1/' | sort -u
}
names_keys() { # LEAST OTHERS: at least so many, and others
    named=0
    for name in $(keys) $2; do
        named=$((named + 1))
        grep -q "\`[^\`]*\b$name\b[^\`]*\`" $contract || { echo "# $contract lacks $name" && return 1; }
    done
    [ $named -ge "$1" ]
}
names_looks() { # LEAST OTHERS: likewise; the README and the gallery have them, too
    named=0
    for name in $(sed -n 's/^ *{\.name = "\([a-z]*\)",$/\1/p' core/scene/looks.c) $2; do
        named=$((named + 1))
        for line in "$contract:^| \`$name\` | " "$contract:^| \`look\` .*\`$name\`" "README.md:\`$name\`" "clients/gallery/scenes.txt:\"look\": \"$name\""; do
            [ $name = textbook ] && [ "${line%%:*}" = clients/gallery/scenes.txt ] && continue
            grep -q "${line#*:}" "${line%%:*}" || { echo "# ${line%%:*} lacks the look $name" && return 1; }
        done
    done
    [ $named -ge "$1" ]
}
verdict "every parameter of a query is in the contract" lists core/parameter_rows.h 1 20
verdict "every media type is" lists core/format_rows.h 3 7
verdict "every channel is" lists core/scene/channels.h 2 11
verdict "every look is" names_looks 8 ""
verdict "and a look that is not there would be found" eval "! names_looks 8 notALook >/dev/null"
verdict "every key of a scene is" names_keys 112 ""
verdict "and a key that is not there would be found" eval "! names_keys 112 notAKey >/dev/null"
verdict "and what is not there would be found" eval "! lists core/parameter_rows.h 3 20 >/dev/null"
verdicts
