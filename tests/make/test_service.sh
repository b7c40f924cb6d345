#!/bin/sh
# test_service.sh BUILD: the system calls of the daemon, from its start over requests and assets to its end, are those that the
# systemd unit allows. Prints TAP.
set -u
build=$1
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
said=$work/said complained=$work/complained; : >"$said"; : >"$complained"
unit=.packages/zrasterd.service.in
daemon=
trap '[ -z "$daemon" ] || kill "$daemon" 2>/dev/null; rm -rf "$work"' EXIT

for program in systemd-analyze strace; do
    command -v $program >/dev/null && continue
    skip "the daemon's system calls are those of its unit" "$program is missing"
    verdicts
    exit 0
done
# Lists name other lists.
calls() { # NAME...
    for name in "$@"; do
        case $name in
        @*) calls $(systemd-analyze syscall-filter "$name" | sed -e 1d -e '/#/d') ;;
        *) echo "$name" ;;
        esac
    done
}
calls $(sed -n 's/^SystemCallFilter=\([^~]\)/\1/p' $unit) | sort -u >"$work/listed"
calls $(sed -n 's/^SystemCallFilter=~//p' $unit) | sort -u >"$work/denied"
comm -23 "$work/listed" "$work/denied" >"$work/allowed"
verdict "the unit allows more than 200 system calls" [ "$(wc -l <"$work/allowed")" -gt 200 ]
verdict "but not mount" eval '! grep -qx mount "$work/allowed"'

mkdir "$work/assets"
: >"$work/out"
strace -D -f -q -o "$work/trace" "$build/zrasterd" --port 0 --assets-dir "$work/assets" >"$work/out" 2>"$complained" &
daemon=$!
server=$(address_in "$work/out") || { echo "$server"; exit 1; }
scene=tests/scenes/many-corners.json
asset=$server/v1/assets/$(sha256sum $scene | cut -d ' ' -f 1)
answers() { [ "$(curl -s -o "$said" -w '%{http_code}' "$@")" -lt 300 ]; }
verdict "it draws" answers "$server/v1/render" --data-binary @$scene
verdict "keeps an asset" answers -X PUT "$asset" --data-binary @$scene
verdict "returns it" answers "$asset"
verdict "and is healthy" "$build/zrasterd" --health --port "${server##*:}"
kill "$daemon"
wait "$daemon"
verdict "it ends with 0" [ $? = 0 ]
# The tracer ends later.
within 5 grep -q "^$daemon .*+++ exited" "$work/trace"
daemon=
sed -n 's/^[0-9]* *\([a-z_0-9]*\)(.*/\1/p' "$work/trace" | sort -u >"$work/used"
verdict "it makes more than 20 system calls" [ "$(wc -l <"$work/used")" -gt 20 ]
verdict "its end among them" grep -qx exit_group "$work/used"
comm -23 "$work/used" "$work/allowed" >"$said"
verdict "all of them are allowed" [ ! -s "$said" ]
families=$(sed -n 's/.* socket(\(AF_[A-Z0-9]*\),.*/\1/p' "$work/trace" | sort -u)
verdict "its sockets are of the families of the unit" [ -z "$(for family in $families; do grep '^RestrictAddressFamilies=' $unit | grep -qw "$family" || echo "$family"; done)" ]
# A killed daemon then leaves no half of such an answer to a proxy, which could not ask another daemon any more.
verdict "a small asset is sent in one call with its header" eval '! grep -q sendfile "$work/trace"'
verdict "and no memory is writable and executable" eval '! grep -q "PROT_WRITE|PROT_EXEC" "$work/trace"'
verdicts
