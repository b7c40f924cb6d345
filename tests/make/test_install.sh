#!/bin/sh
# test_install.sh BUILD: make install below a folder: its files, a C program that pkg-config builds with them, thumbnails in the
# sandbox of file managers, the unit; and make uninstall. Prints TAP.
set -u
build=$1
work=$(realpath "$(mktemp -d)")
. tests/support/verdict.sh
. tests/support/files.sh
said=$work/said complained=$work/complained; : >"$said"; : >"$complained"
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MAKELEVEL MFLAGS ZRASTER_SERVER
root=$work/root prefix=/usr/local
# Files of BUILD as they are: nothing is compiled.
placed() { make -s --no-print-directory -o all "$@" BUILD="$build" DESTDIR="$root" >"$said" 2>"$complained"; }
files() { find "$root" ! -type d | sed "s|^$root||" | sort; }

verdict "make install" placed install
files >"$work/installed"
make -s --no-print-directory list-installed | cut -d ' ' -f 2 | sort >"$work/listed"
verdict "installs the files of the list" cmp "$work/listed" "$work/installed"
verdict "which has 17 files" [ "$(wc -l <"$work/listed")" = 17 ]
verdict "no folder's name is left open" sh -c "! grep -rn '@[a-z]*@' '$root$prefix/share/thumbnailers' '$root$prefix/lib/pkgconfig' '$root$prefix/lib/systemd'"

export PKG_CONFIG_SYSROOT_DIR="$root" PKG_CONFIG_PATH="$root$prefix/lib/pkgconfig"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n' >"$work/part.obj"
{
    printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n'
} >"$work/part.ply"
triangle >"$work/part.stl"
cp clients/examples/solids.json "$work/solids.zraster.json"
verdict "pkg-config knows the header's version" [ "$(pkg-config --modversion zraster)" = \
    "$(sed -n 's/^#define ZRASTER_VERSION  *"\(.*\)"/\1/p' core/api/zraster.h)" ]
# shellcheck disable=SC2046
verdict "the example is built by its flags" ${CC:-cc} clients/examples/draw.c -o "$work/draw" $(pkg-config --cflags --libs zraster)
verdict "and draws" env LD_LIBRARY_PATH="$root$prefix/lib" "$work/draw" "$work/part.obj" "$work/drawn.png" "look=studio&width=64&height=64"
# The libraries below it are the system's.
requires=$(sed -n 's/^Requires.private: //p' "$root$prefix/lib/pkgconfig/zraster.pc")
# shellcheck disable=SC2046,SC2086
verdict "and with the static library" ${CC:-cc} -I"$root$prefix/include" clients/examples/draw.c -o "$work/static" \
    "$root$prefix/lib/libzraster.a" $(env -u PKG_CONFIG_SYSROOT_DIR pkg-config --libs $requires) -lm -pthread
verdict "with the same bytes" sh -c "'$work/static' '$work/part.obj' '$work/static.png' 'look=studio&width=64&height=64' && cmp '$work/drawn.png' '$work/static.png'"

# As GNOME's: no network, home, /proc or /etc; only the file and the folder of the picture, whose name may have any ending.
sandbox() { # FOLDER FILE COMMAND
    links=
    for name in lib lib64; do [ ! -e /usr/$name ] || links="$links --symlink usr/$name /$name"; done
    # shellcheck disable=SC2086
    bwrap --unshare-all --die-with-parent --clearenv --ro-bind /usr /usr $links --tmpfs /usr/local --ro-bind "$root$prefix" $prefix \
        --bind "$1" /tmp --ro-bind "$2" "/tmp/in.${2##*.}" sh -c "$3" </dev/null >"$said" 2>"$complained"
}
thumbnail() { # THUMBNAILER FILE OPTION...
    mkdir -p "$work/thumb"
    exec=$(sed -n 's/^Exec=//p' "$root$prefix/share/thumbnailers/$1" | sed "s|%i|/tmp/in.${2##*.}|; s|%o|/tmp/out.Xa3bTz|; s|%s|128|")
    rm -f "$work/thumb"/*
    sandbox "$work/thumb" "$2" "$exec" || return 1
    shift
    "$build/zraster" "$@" -q -o "$work/expected.png" && cmp "$work/expected.png" "$work/thumb/out.Xa3bTz"
}
if mkdir "$work/try" && sandbox "$work/try" "$work/part.stl" true; then
    verdict "in a sandbox, the thumbnail of an STL has the command's bytes" thumbnail zraster.thumbnailer "$work/part.stl" -s 128
    verdict "of an OBJ" thumbnail zraster.thumbnailer "$work/part.obj" -s 128
    verdict "of a PLY" thumbnail zraster.thumbnailer "$work/part.ply" -s 128
    verdict "of a scene" thumbnail zraster-scene.thumbnailer "$work/solids.zraster.json" -c color
    verdict "and a file that is no STL fails" eval '! thumbnail zraster.thumbnailer Makefile'
else
    skip "thumbnails in a sandbox" "bwrap cannot make one"
fi
if command -v update-mime-database >/dev/null; then
    verdict "the MIME types are read" update-mime-database "$root$prefix/share/mime"
    verdict "a scene has one" grep -q '^50:application/vnd.zraster+json:\*.zraster.json$' "$root$prefix/share/mime/globs2"
    verdict "an OBJ is no drawing of TGIF" grep -q '^60:model/obj:\*.obj$' "$root$prefix/share/mime/globs2"
    verdict "a PLY has one" grep -q '^50:model/ply:\*.ply$' "$root$prefix/share/mime/globs2"
    find "$root$prefix/share/mime" ! -type d ! -path '*/packages/*' -delete
else
    skip "MIME types" "update-mime-database is missing"
fi
unit=$root$prefix/lib/systemd/system/zrasterd.service
verdict "the unit starts the daemon that is installed" [ "$(sed -n 's/^ExecStart=//p' "$unit")" = $prefix/bin/zrasterd ]
if command -v systemd-analyze >/dev/null; then
    sed "s|=$prefix/bin|=$root$prefix/bin|" "$unit" >"$work/zrasterd.service"
    verdict "systemd accepts it" sh -c "systemd-analyze verify --man=no '$work/zrasterd.service' >'$said' 2>&1 && [ ! -s '$said' ]"
    verdict "and rates its exposure below 1.5" sh -c "systemd-analyze security --offline=true --threshold=15 '$work/zrasterd.service' >'$said'"
else
    skip "the unit, judged by systemd" "systemd-analyze is missing"
fi

verdict "make uninstall" placed uninstall
verdict "leaves no file" [ -z "$(files)" ]
verdict "other folders may be named" placed install prefix=/opt/zr libdir=/opt/zr/lib/arch PACKAGES="libzraster-dev python3-zraster"
verdict "the pkg-config file has them" grep -qx 'Libs: -L/opt/zr/lib/arch -lzraster' "$root/opt/zr/lib/arch/pkgconfig/zraster.pc"
verdict "the Python package is installed if it is named" [ -f "$root/opt/zr/lib/python3/dist-packages/zraster/pyrender/__init__.py" ]
verdict "an unknown package is refused" eval '! placed install PACKAGES=zrasterdd'
verdict "by its name" grep -q 'error: no package zrasterdd; there are: zraster zrasterd libzraster0' "$complained"
verdicts
