#!/bin/sh
# test_contract.sh BUILD: the contract names what the tables of rows have, as BUILD/zraster-tables prints them: channels,
# looks, parameters, media types, keys of scenes. Prints TAP.
set -u
. tests/support/verdict.sh
contract=server/api/v1.md said=/dev/null complained=/dev/null
tables=$("$1/zraster-tables")

# PATTERN KIND [NAME]: every name of that kind, and NAME, is in the contract; in the pattern, NAME stands for it.
names() {
    list=$(printf '%s\n' "$tables" | sed -n "s/^$2 //p")
    [ -n "$list" ] || { echo "# no $2" && return 1; }
    for name in $list ${3:-}; do
        grep -q -e "$(printf '%s\n' "$1" | sed "s|NAME|$name|g")" $contract || { echo "# $contract lacks the $2 $name" && return 1; }
    done
}
check() { # WHAT PATTERN KIND
    verdict "every $1 is in the contract" names "$2" "$3"
    verdict "and one that is not there would be found" eval "! names '$2' $3 notAName >/dev/null"
}
check "channel" '`NAME`' channel
check "look" '^| `NAME` | ' look
check "parameter" '`NAME`\|[?&]NAME=' parameter
check "media type" '`NAME`' types
check "key of a scene" '`[^`]*\bNAME\b[^`]*`' key
# The README and the gallery show every look; textbook is no picture of the gallery.
shown() { # [NAME]
    for name in $(printf '%s\n' "$tables" | sed -n 's/^look //p') ${1:-}; do
        grep -q "\`$name\`" README.md || { echo "# README.md lacks the look $name" && return 1; }
        [ "$name" = textbook ] || grep -q "\"look\": \"$name\"" clients/gallery/scenes.txt || { echo "# the gallery lacks the look $name" && return 1; }
    done
}
verdict "every look is in the README and in the gallery" shown
verdict "and one that is not there would be found" eval "! shown notALook >/dev/null"
verdicts
