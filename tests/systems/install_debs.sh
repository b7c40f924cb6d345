#!/bin/sh
# install_debs.sh: installs /src/debs/*.deb in a bare root, draws a picture by the command, Python, the daemon and a C program,
# and removes the packages. Prints TAP and the figures of tests/run.sh.
set -u
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
said=$work/said complained=$work/complained; : >"$said"; : >"$complained"
example=$(realpath clients/examples/draw.c)
export DEBIAN_FRONTEND=noninteractive
printf 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' >"$work/part.stl"
installed() { apt-get install -y --no-install-recommends "$@" >"$said" 2>"$complained"; }

apt-get update >/dev/null
cd /src/debs || exit 1
verdict "apt-get installs the packages" installed ./*.deb
cd "$work" || exit 1
verdict "zraster part.stl draws a picture" zraster part.stl
verdict "which is a PNG" [ "$(head -c 8 part.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]
verdict "Python draws it" python3 -c "import zraster; zraster.render('part.stl').save('python.png')"
verdict "with the same bytes" cmp part.png python.png
zrasterd --port 0 >out 2>log &
daemon=$!
server=$(address_in out) || exit 1
verdict "the daemon draws it" python3 -c "import sys, zraster; zraster.render('part.stl', server=sys.argv[1]).save('daemon.png')" "$server"
verdict "with the same bytes" cmp part.png daemon.png
kill $daemon
wait $daemon
verdict "a compiler is installed" installed gcc libc6-dev pkg-config
# shellcheck disable=SC2046
verdict "it builds a program with the library" cc "$example" -o draw $(pkg-config --cflags --libs zraster)
verdict "which draws the picture" ./draw part.stl draw.png
verdict "with the same bytes" cmp part.png draw.png
# shellcheck disable=SC2046
verdict "so it does with the static library" cc "$example" -o static -Wl,-Bstatic -lzraster -Wl,-Bdynamic $(pkg-config --static --libs libpng libjpeg libwebp libisal) -pthread
verdict "all packages are removed" sh -c "dpkg -P $(cd /src/debs && ls | sed 's/_.*//' | paste -sd ' ') >'$said' 2>&1"
verdict "with all their files" [ -z "$(find / -xdev -path /src -prune -o -path "$work" -prune -o -name '*zraster*' -print)" ]
verdicts
passed=$((count - failed))
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" = 0 ]
