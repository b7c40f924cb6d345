#!/bin/sh
# test_large.sh BUILD: files so large that the command maps them, and --memory. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
zraster=$build/zraster

# 1.4 million triangles in 70 MB, whose last page is not full; with a byte behind each, a page is full.
/usr/bin/python3 - "$work" <<'END'
import sys
sys.path.insert(0, "tests/bench/rivals")
from large_files import write_stl
write_stl(sys.argv[1] + "/ball.stl", 1400000)
END
cd "$work" || exit 1
size=$(wc -c <ball.stl)
cp ball.stl full.stl
head -c $(((4096 - size % 4096) % 4096)) /dev/zero >>full.stl

verdict "the file has another size than whole pages" [ $((size % 4096)) != 0 ]
check "a mapped file is drawn" 0 "$zraster" ball.stl -o mapped.png --size 160x120
verdict "a piped one is, too" eval '"$zraster" - --type stl --size 160x120 <ball.stl >piped.png 2>"$complained"'
verdict "with the same bytes" cmp mapped.png piped.png
check "a file of whole pages is drawn" 0 "$zraster" full.stl -o full.png --size 160x120
verdict "with the same bytes" cmp mapped.png full.png

# Behind the bytes that were read before.
{ printf 0123456789 && cat ball.stl; } >behind.stl
verdict "a pipe that is a file begins where it stands" eval \
    '{ dd bs=10 count=1 of=/dev/null 2>/dev/null && "$zraster" - --type stl --size 160x120 >behind.png 2>"$complained"; } <behind.stl'
verdict "with the same bytes" cmp mapped.png behind.png

# Where several files are drawn, one that shrinks may not end the others: they are copied.
if strace -o probe true 2>/dev/null; then
    # Who traces a process keeps the leak sanitizer from stopping it.
    traced() { ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0 strace -f -e trace=mmap -o trace "$zraster" "$@" --size 160x120; }
    is_mapped() { grep -q ", $size, PROT_READ|PROT_WRITE, MAP_PRIVATE, [0-9]" trace; }
    check "one file is drawn under strace" 0 traced ball.stl -o mapped.png
    verdict "and mapped" is_mapped
    check "a batch is drawn under strace" 0 traced batch ball.stl -o batch
    verdict "and nothing is mapped" eval '! is_mapped'
else
    skip "a batch maps nothing" "strace cannot run here"
fi

check "a picture beyond --memory ends with 1" 1 "$zraster" ball.stl -o none.png --memory 100M
verdict "the message has the need and the limit" grep -q 'needs at least [0-9]* bytes, more than the 104857600 bytes that a request may use' complained
verdict "and the option" grep -q -e '--memory allows more: the system can spare [0-9.]* GB' complained
verdict "no picture is left" [ ! -e none.png ]
check "so do views beyond it" 1 "$zraster" ball.stl -o none --views front,top --memory 100M
verdict "with their share, and the limit" \
    grep -q 'more than the 524[0-9]* bytes that a view may use, of the 104857600 bytes of a request' complained
check "more memory draws it" 0 "$zraster" ball.stl -o more.png --memory 1.5GiB --size 160x120
verdict "with the same bytes" cmp mapped.png more.png
check "a share does, too" 0 "$zraster" ball.stl -o share.png --memory 80% --size 160x120
check "--memory beside --server is refused" 2 "$zraster" ball.stl -o none.png --memory 8G --server http://127.0.0.1:9
verdict "since the server draws" grep -q 'but http://127.0.0.1:9 draws' complained
if (ulimit -v 700000 && "$zraster" --version) >/dev/null 2>&1; then
    check "address space has a limit" 1 sh -c 'ulimit -v 700000; exec "$0" "$@"' "$zraster" ball.stl -o none.png --memory 60% --size 2000
    verdict "which the message has" grep -q -e 'the system can spare 0.[0-9] GB' complained
else
    skip "address space has a limit" "this build reserves more"
fi

if command -v script >/dev/null 2>&1; then
    check "a terminal shows seconds" 0 env TERM=xterm script -qec "$zraster ball.stl -o shown.png --size 1600x1200 -j 1" typescript
    verdict "of the drawing" grep -aqE '[0-9]\.[0-9] s.\[K' said
    check "and none with --plain" 0 env TERM=xterm script -qec "$zraster ball.stl -o shown.png --size 1600x1200 -j 1 --plain" typescript
    verdict "so that lines stay whole" eval '! grep -aqE "[0-9]\.[0-9] s.\[K" said'
else
    skip "a terminal shows seconds" "script is missing"
fi
verdicts
