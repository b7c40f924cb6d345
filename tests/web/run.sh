#!/bin/sh
# run.sh BUILD: tests of clients/web in Node, by both modules. Prints TAP.
set -u
build=$1 worst=0
export ZRASTER_DATA="${DATA:-../shared/data}"
node tests/web/test_module.mjs "$build/npm/zraster" || worst=1
node tests/web/test_worker.mjs "$build/npm/zraster" || worst=1
node tests/web/test_readme.mjs "$build"/npm/zraster-*.tgz || worst=1
for module in zraster zraster-scalar; do
    echo "# $module.wasm"
    node tests/web/test_pixels.mjs "$build" "$build/wasm/$module.wasm" >"$build/wasm/$module.tap" || worst=1
    grep -A 4 '^not ok' "$build/wasm/$module.tap"
    grep -c '^ok' "$build/wasm/$module.tap" | sed 's/$/ pictures are the same/'
done
exit $worst
