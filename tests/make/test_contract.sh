#!/bin/sh
# test_contract.sh BUILD: the contract names what the tables of rows have, as BUILD/zraster-tables prints them, and the
# tools for agents of BUILD/zraster. Settings, commands and options: tests/clients/test_documents.sh; metrics:
# tests/server/test_metrics.py. Prints TAP.
set -u
. tests/support/verdict.sh
contract=server/api/v1.md said=$(mktemp) complained=/dev/null
trap 'rm -f "$said"' EXIT
list='{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"protocolVersion":"2025-06-18","capabilities":{},"clientInfo":{"name":"test","version":"1"}}}
{"jsonrpc":"2.0","id":2,"method":"tools/list"}'
tables=$("$1/zraster-tables"; printf '%s\n' "$list" | "$1/zraster" mcp --root tests | sed -n 2p | grep -o '"name":"[a-z_]*","title"' | sed 's/"name":"\(.*\)","title"/tool \1/')

# lacking PATTERN KIND [NAME]: prints the names of that kind, and NAME, that no line of the contract has. In the pattern, an
# extended regular expression, NAME stands for the name.
lacking() {
    { printf '%s\n' "$tables" | sed -n "s/^$2 //p" && echo "${3-}"; } | tr ' ' '\n' | awk -v pattern="$1" '
        NR == FNR && $0 != "" { name = $0; gsub(/[+.]/, "[&]", name); wanted[$0] = pattern; gsub(/NAME/, name, wanted[$0]) }
        NR != FNR { for (name in wanted) if ($0 ~ wanted[name]) delete wanted[name] }
        END { for (name in wanted) print name }' - $contract
}
check() { # WHAT PATTERN KIND
    { lacking "$2" "$3"; printf '%s\n' "$tables" | grep -q "^$3 " || echo "no $3"; } >"$said"
    verdict "every $1 is in the contract" [ ! -s "$said" ]
    verdict "and one that is not there would be found" [ "$(lacking "$2" "$3" notAName)" = notAName ]
}
check "channel" '^[|] `NAME` ' channel
check "look" '^[|] `NAME` [|] ' look
check "parameter" '`NAME`|[?&]NAME=' parameter
check "media type of a format" '`NAME`' types
check "encoding" '`NAME`|^- [*][*]NAME[*][*]' encoding
check "shading" '^[|] `NAME` [|] ' shading
check "algorithm" '^[|] `algorithm` [|].*`NAME`' algorithm
check "light" '^[|] `NAME` [|] ' light
check "tool for agents" '^[|] `NAME` [|] ' tool
check "key of a scene" '`([^`]*[^`A-Za-z0-9_])?NAME([^`A-Za-z0-9_][^`]*)?`' key
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
