#!/bin/sh
# install.sh install|uninstall|list [PACKAGE...]: the list of installed files, one row each, for `make install`, the Debian
# packages and the tests. Without PACKAGE: all packages but the Python package. The Makefile sets BUILD, DESTDIR, the folders
# and the version, which replace @prefix@ and so on in files that end with .in. `list` prints package and path of each file.
set -eu

rows() { # package, mode or `link`, file or the link's target, path
    cat <<END
zraster         755  $BUILD/zraster                         $bindir/zraster
zraster         644  $BUILD/zraster.1                       $mandir/man1/zraster.1
zraster         644  $BUILD/completion.bash                 $datadir/bash-completion/completions/zraster
zraster         644  $BUILD/completion.zsh                  $zshdir/_zraster
zraster         644  $BUILD/completion.fish                 $datadir/fish/vendor_completions.d/zraster.fish
zraster         644  .packages/zraster.thumbnailer.in       $datadir/thumbnailers/zraster.thumbnailer
zraster         644  .packages/zraster-scene.thumbnailer.in $datadir/thumbnailers/zraster-scene.thumbnailer
zraster         644  .packages/zraster.xml                  $datadir/mime/packages/zraster.xml
zrasterd        755  $BUILD/zrasterd                        $bindir/zrasterd
zrasterd        644  $BUILD/zrasterd.8                      $mandir/man8/zrasterd.8
zrasterd        644  .packages/zrasterd.service.in          $unitdir/zrasterd.service
libzraster0     644  $BUILD/libzraster.so.0                 $libdir/libzraster.so.0
libzraster-dev  link libzraster.so.0                        $libdir/libzraster.so
libzraster-dev  644  $BUILD/libzraster.a                    $libdir/libzraster.a
libzraster-dev  644  .packages/zraster.pc.in                $libdir/pkgconfig/zraster.pc
libzraster-dev  644  core/api/zraster.h                      $includedir/zraster.h
libzraster-dev  644  $BUILD/libzraster.3                    $mandir/man3/libzraster.3
END
    find clients/python/zraster -name '*.py' -o -name py.typed | sort | while read -r file; do
        echo "python3-zraster 644 $file $pythondir/${file#clients/python/}"
    done
}

place() { # mode, file, path
    if [ "$1" = link ]; then
        mkdir -p "${3%/*}"
        ln -sf "$2" "$3"
    else
        install -D -m "$1" "$2" "$3"
    fi
    case $2 in
    *.in) sed -i -e "s|@prefix@|$prefix|" -e "s|@bindir@|$bindir|" -e "s|@libdir@|$libdir|" -e "s|@includedir@|$includedir|" \
        -e "s|@version@|$version|" "$3" ;;
    esac
}

# Updates caches of the system. Debian packages do so by triggers.
refresh() {
    [ -z "$DESTDIR" ] || return 0
    [ "$(id -u)" != 0 ] || PATH=$PATH:/sbin:/usr/sbin ldconfig || true
    [ ! -d "$datadir/mime/packages" ] || ! command -v update-mime-database >/dev/null || update-mime-database "$datadir/mime"
}

action=$1
shift
packages=${*:-zraster zrasterd libzraster0 libzraster-dev}
for package in $packages; do
    rows | grep -q "^$package " || { echo "error: no package $package; there are: $(rows | cut -d ' ' -f 1 | uniq | xargs)" >&2; exit 1; }
done
rows | while read -r package mode file path; do
    case " $packages " in *" $package "*) ;; *) continue ;; esac
    case $action in
    install) place "$mode" "$file" "$DESTDIR$path" ;;
    uninstall) rm -f "$DESTDIR$path" ;;
    list) echo "$package $path" ;;
    esac
done
[ "$action" = list ] || refresh
