#!/bin/sh
# test_wrong_lines.sh BUILD: each wrong command line of wrong-lines.txt ends with its status and a message with advice, which
# has one prefix. Prints TAP.
set -u
zraster=$(realpath "$1")/zraster
lines=$(realpath tests/clients/wrong-lines.txt)
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
unset ZRASTER_SERVER ZRASTER_TOKEN
mkdir "$work/in"
cd "$work/in" || exit 1

mkdir parts none bo
triangle >part.stl
cp part.stl other.stl && cp part.stl parts && : >empty.stl
printf '<!DOCTYPE html><title>403</title>' >page.stl
printf 'ISO-10303-21;\n' >part.step && printf '<COLLADA/>\n' >part.dae
for name in cloud.las scene.splat part.stl.gz part.sldprt; do echo x >"$name"; done
printf '{"polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' >scene.json
printf '{"polygons": [{"vertices": [[0,0,0],[0,1,0],[1,0,0]]}]}' >away.json
printf '{"file": "part.stl"}\n{"file": "part.stl", "look": "clay"}\n' >twice.jsonl
printf '\n{"file": "part.stl", "look": "nosuch"}\n' >look.jsonl
echo '{"file": 5}' >number.jsonl && echo '{"look": "clay"}' >fileless.jsonl && echo '{"file": ' >broken.jsonl
printf '{"base": {"color": {"asset": "p"}, "windowDepth": {"asset": "sha256:%064d"}}, "polygons": [{"vertices": [[0,0,0],[1,0,0],[0,1,0]]}]}' 0 >assets.json
"$zraster" part.stl a.png -s 8 && "$zraster" part.stl small.png -s 4 && cp a.png a2.png || exit 1
ls >"$work/files" && cksum * >"$work/sums" 2>/dev/null

count_lines() { grep -c '^[0-9]' "$lines"; }
verdict "there are thirty wrong command lines at least" [ "$(count_lines)" -ge 30 ]
while IFS='|' read -r status arguments message; do
    case $status in '#'*) continue ;; esac
    message=${message# }
    eval "timeout 20 \"\$zraster\" $arguments" >"$said" 2>"$complained" </dev/null
    ended=$?
    cat "$said" >>"$complained"
    verdict "zraster$arguments" eval '[ $ended = $status ] && grep -qF -e "$message" "$complained"'
    # The prefix is printed once.
    verdict "  has one prefix" eval '[ "$(grep -c "zraster: " "$complained")" -le 1 ] && ! grep -q "zraster:.*zraster: " "$complained"'
done <"$lines"
verdict "a value behind an unknown option is not repeated" eval '! "$zraster" part.stl --passwort=geheim >"$complained" 2>&1 && ! grep -q geheim "$complained"'
ls >"$work/files-after" && cksum * >"$work/sums-after" 2>/dev/null
verdict "no file came, went or changed" eval 'cmp "$work/files" "$work/files-after" && cmp "$work/sums" "$work/sums-after"'
verdicts
