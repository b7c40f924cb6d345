#!/bin/sh
# packages.sh ROOT: prints the Debian package of each library below ROOT, a line each: PACKAGE VERSION SOURCE FILE. The files are
# copies of those of this system, at the same paths. Ends with 1 where a file is of no package.
set -eu
cd "$1"
find . -name '*.so*' | sed 's|^\.||' | LC_ALL=C sort | while IFS= read -r file; do
    # dpkg knows some libraries below /lib and some below /usr/lib, which are one folder, and names diversions, too.
    package=$(dpkg -S "$file" "/usr$file" "${file#/usr}" 2>/dev/null | sed -n '/^diversion /d; s/[,:] .*//p' | head -n 1)
    [ "$package" ] || { echo "error: $file is of no package" >&2; exit 1; }
    printf '%s %s\n' "$(dpkg-query -W -f '${binary:Package} ${Version} ${source:Package}' "$package")" "$file"
done
