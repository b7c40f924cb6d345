#!/bin/sh
# sources.sh FOLDER: the codecs' sources of this Debian, with its patches: FOLDER/isal, jpeg, png, webp and zlib. apt fetches them
# from where it fetches packages, by lists of its own: those of the system stay as they are. If the newest version of one is not
# there, it takes the one before, and says so. FOLDER/versions names them.
set -eu
folder=$1
here=$(cd "$(dirname "$0")" && pwd)
packages='isal=libisal jpeg=libjpeg-turbo png=libpng1.6 webp=libwebp zlib=zlib'
[ "$folder/versions" -nt "$here/libisal.patch" ] && exit 0
rm -rf "$folder"
mkdir -p "$folder/apt/lists/partial" "$folder/apt/parts"
folder=$(cd "$folder" && pwd)

# The system's own places of Debian packages, as places of sources.
list=$folder/apt/list.sources
for file in /etc/apt/sources.list.d/*.sources; do
    [ -e "$file" ] || continue
    awk -v RS= '/debian/ { gsub(/(^|\n)Types:[^\n]*/, "\nTypes: deb-src"); gsub(/^\n/, ""); print $0 "\n" }' "$file"
done >"$list"
cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null | sed -n '/debian/s/^deb /deb-src /p' >"$folder/apt/parts/line.list"

with_lists() { # PROGRAM ARGUMENT...
    program=$1
    shift
    "$program" -o Dir::Etc::sourcelist="$list" -o Dir::Etc::sourceparts="$folder/apt/parts" -o Dir::State::lists="$folder/apt/lists" \
        -o APT::Sandbox::User=root "$@"
}
failed() { # MESSAGE
    tail -n 5 "$folder/apt/log" >&2
    echo "error: $1" >&2
    exit 1
}
with_lists apt-get update >"$folder/apt/log" 2>&1 || failed "apt has no lists of sources"

for pair in $packages; do
    name=${pair%=*} package=${pair#*=} taken=
    cd "$folder/apt"
    for version in $(with_lists apt-cache showsrc "$package" | sed -n 's/^Version: //p' | sort -rV | uniq); do
        if with_lists apt-get source --download-only "$package=$version" >>log 2>&1; then
            taken=$version
            break
        fi
        echo "LEFT OUT: $package $version, which cannot be fetched" >&2
    done
    [ -n "$taken" ] || failed "no source of $package"
    dpkg-source --no-check -x "$package"_*"${taken#*:}".dsc "$folder/$name" >>log 2>&1 || failed "$package $taken does not unpack"
    rm -f ./*.dsc ./*.tar.* ../*.tar.*
    echo "$package $taken" >>versions
done
cd "$folder"
version=$(sed -n 's/^libisal //p' apt/versions)
case $version in
2.3[01].*) patch -s -d isal -p1 <"$here/libisal.patch" ;;
*) failed "libisal $version: the patch and isal_level1.c are for 2.30 and 2.31" ;;
esac

# The headers that their own builds generate.
mkdir -p include/isa-l
cp isal/include/*.h include/isa-l/
cp png/scripts/pnglibconf.h.prebuilt include/pnglibconf.h
version=$(sed -n 's/^libjpeg-turbo [0-9]*:*\([0-9.]*\).*/\1/p' apt/versions)
cat >include/jconfig.h <<END
#define JPEG_LIB_VERSION 62
#define LIBJPEG_TURBO_VERSION $version
#define LIBJPEG_TURBO_VERSION_NUMBER $(echo "$version" | awk -F. '{ printf "%d%03d%03d", $1, $2, $3 }')
#define D_ARITH_CODING_SUPPORTED 1
#define MEM_SRCDST_SUPPORTED 1
#define BITS_IN_JSAMPLE 8
END
cat >include/jconfigint.h <<END
#define BUILD "wasm"
#define INLINE inline
#define THREAD_LOCAL
#define PACKAGE_NAME "libjpeg-turbo"
#define VERSION "$version"
#define SIZEOF_SIZE_T 4
#define FALLTHROUGH __attribute__((fallthrough));
END
# All kinds of JPEG are decoded, and one is encoded.
sed -i -E '/^#define (DCT_IFAST|DCT_FLOAT|C_PROGRESSIVE|INPUT_SMOOTHING|IDCT_SCALING|UPSAMPLE_MERGING|QUANT_1PASS|QUANT_2PASS)_SUPPORTED/d' jpeg/jmorecfg.h
sed 's/@COPYRIGHT_YEAR@/2023/' jpeg/jversion.h.in >include/jversion.h
mv apt/versions versions
rm -rf apt
