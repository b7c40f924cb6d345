#!/bin/sh
# test_deb.sh BUILD: the packages of `make deb`: lintian finds no error, and each has the files that .packages/install.sh
# lists.
# Prints TAP.
set -u
build=$1
work=$(mktemp -d)
. tests/support/verdict.sh
said=$work/said complained=$work/complained; : >"$said"; : >"$complained"
trap 'rm -rf "$work"' EXIT
names=$(sed -n 's/^Package: //p' .packages/debian/control)

# Paths differ from those of `make install`: Debian's folders, and man pages are compressed.
has_its_files() { # PACKAGE
    make -s --no-print-directory list-installed PACKAGES="$1" | sed 's|.*/||' | sort >"$work/listed"
    dpkg-deb -c "$build/deb/$1"_*.deb | grep -v '/$' | sed 's/ -> .*//; s/.* //' | grep -v '^./usr/share/doc/' | sed 's|.*/||; s|\.gz$||' | sort >"$work/packed"
    cmp "$work/listed" "$work/packed"
}
# shellcheck disable=SC2086
verdict "there are five packages" [ "$(echo $names)" = "zraster zrasterd libzraster0 libzraster-dev python3-zraster" ]
for name in $names; do
    verdict "$name has its files" has_its_files "$name"
done
verdict "lintian finds no error and warns of nothing" sh -c "lintian --allow-root --fail-on error,warning '$build'/deb/*.changes >'$said' 2>&1"
verdicts
