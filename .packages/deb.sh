#!/bin/sh
# deb.sh BUILD VERSION PACKAGE...: makes BUILD/deb/*.deb and the source package, from .packages/debian and the checkout.
# PACKAGE: packages that the build needs; they become Build-Depends.
set -eu
out=$(realpath "$1")/deb version=$2
shift 2
source=$out/zraster-$version debian=$out/zraster-$version/debian
unset MAKEFLAGS MAKELEVEL MFLAGS
rm -rf "$out"
mkdir -p "$source"
{ git ls-files -z 2>/dev/null || find . \( -path ./build -o -path ./.git \) -prune -o -type f -print0; } | tar -c --null -T - | tar -x -C "$source"
cp -R .packages/debian "$debian"
# Every build has gcc and libc6-dev.
needs=$(printf '%s\n' "$@" | grep -vxE 'gcc|libc6-dev' | sort -u | paste -sd , | sed 's/,/, /g')
sed -i "s/@build@/$needs/" "$debian/control"
date=$(git log -1 --format=%aD 2>/dev/null || date -R)
maintainer=$(sed -n 's/^Maintainer: //p' "$debian/control")
printf 'zraster (%s) unstable; urgency=medium\n\n  * Changes: CHANGELOG.md.\n\n -- %s  %s\n' "$version" "$maintainer" "$date" >"$debian/changelog"
if ! (cd "$source" && DEB_BUILD_OPTIONS="noautodbgsym${DEB_BUILD_OPTIONS:+ $DEB_BUILD_OPTIONS}" dpkg-buildpackage -us -uc) >"$out/log" 2>&1; then
    tail -n 30 "$out/log" >&2
    echo "error: dpkg-buildpackage failed; all of its output: $out/log" >&2
    exit 1
fi
rm -r "$source"
ls "$out"/*.deb
