#!/bin/sh
# package.sh MODULES FOLDER: the package of clients/web, with the modules, in FOLDER. Types of options need node; without it they are
# left out, and any option is allowed.
set -eu
modules=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"
cp clients/web/*.mjs clients/web/*.d.ts clients/web/package.json clients/web/README.md "$folder"
rm "$folder/types.mjs"
cp "$modules/zraster.wasm" "$modules/zraster-scalar.wasm" "$modules/LICENCES.txt" "$folder"
if command -v node >/dev/null; then
    node clients/web/types.mjs "$modules/zraster.wasm" >"$folder/options.d.ts"
else
    echo "LEFT OUT: types of options: there is no node" >&2
    echo 'export type Options = { [name: string]: unknown }; export type Look = string; export type ChannelName = string;' >"$folder/options.d.ts"
fi
