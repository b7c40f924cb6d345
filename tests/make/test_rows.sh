#!/bin/sh
# test_rows.sh [-p]: how many compilations of `make all` one more row of a table causes, counted over the files that
# contributing.md names for it. -p: prints the numbers alone. Else prints TAP.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/support/verdict.sh
said=$work/said complained=$work/complained
script=$PWD/tests/make/rows.awk
encodings=$(grep -rl --include='*.h' '^enum zr_encoding {' core)
ROWS="channel 120 core/scene/channels.h core/shade/channels/channels_simd.h
encoding 60 $encodings core/scene/channels.h
format 60 core/format_rows.h
parameter 60 core/parameter_rows.h
key 60 core/scene/picture.h core/scene/picture_keys.h"

compilations() { # FILES: of a change of these
    find core server clients -name '*.[ch]' ! -path 'clients/reference/*' ! -path 'clients/examples/*' | sort | xargs awk -v changed="$1" -f "$script"
}
known() { # FILE...: contributing.md tells to edit them
    for file; do grep -qF "$file" clients/docs/contributing.md || return 1; done
}
if [ "${1:-}" = -p ]; then
    echo "$ROWS" | while read -r row bar files; do echo "$row $(compilations "$files")"; done
    exit
fi
while read -r row bar files; do
    compilations "$files" >"$said" 2>"$complained"
    verdict "one more $row compiles at most $bar objects" [ "$(cat "$said")" -le "$bar" ]
    verdict "and contributing.md names its files" known $files
done <<END
$ROWS
END

# Proof that it counts.
mkdir -p "$work/tree/core/base" "$work/tree/server"
cd "$work/tree" || exit 1
: >core/base/a.h
echo '#include "base/a.h"' >core/base/b.h
echo '#include "b.h"' >core/base/b.c
echo '#include "base/b.h"' >core/base/c_kernel.c
echo '#include "base/a.h"' >server/d.c
echo 'int e;' >server/e.c
mkdir clients
is() { [ "$(compilations "$1")" = "$2" ]; }
verdict "a header compiles what includes it, through others too, and kernels four times" is core/base/a.h 6
verdict "files that both headers reach are counted once" is "core/base/a.h core/base/b.h" 6
verdict "a source compiles itself" is server/e.c 1
verdict "a file that is not there is a fault" is core/base/z.h "core/base/z.h is not there"
verdicts
