#!/bin/sh
# run.sh: `make demo`, `make test` and `make test-clang` in bare roots of other Debian systems, one after the other. Needs root. Prints
#
#     13: 812 passed, 0 failed, 0 skipped
#
# for each, and the compiler's warnings, which count as failures. Tests what is committed. Variables:
#   SYSTEMS  of 12, 13, testing, or any suite's name (12 13 testing)
#   ROOTS    the folder of the roots and of what the makes print, some GB (/var/tmp/zraster-systems)
#   KEEP     1: roots stay, and those that are there are used again, no longer bare
#   MIRROR   where packages come from (http://deb.debian.org/debian)
#   TARGETS  that are made, or scripts that are run (demo test test-clang)
#   DEBS     a folder whose packages are copied to /src/debs (none)
#   DATA     what the tests use where it is there, read-only (../shared/data)
#
# All mounts are made in a mount namespace of their own, and all processes run in a PID namespace: they end with it, however
# this script ends.
set -u
systems=${SYSTEMS:-12 13 testing}
roots=${ROOTS:-/var/tmp/zraster-systems}
mirror=${MIRROR:-http://deb.debian.org/debian}
targets=${TARGETS:-demo test test-clang}
data=${DATA:-../shared/data}
debs=${DEBS:-}
keep=${KEEP:-}
child=
# Of the compiler and the linker; what our own programs warn of in the demo is none.
compiler_warning=':[0-9]+: warning: |/ld: .*warning: '

suite_of() {
    case $1 in
    12) echo bookworm ;;
    13) echo trixie ;;
    *) echo "$1" ;;
    esac
}

# What this machine's apt is told about proxies and clocks holds in the root, too.
tell_apt() { # root
    apt-config dump 2>/dev/null | grep -E '^Acquire::(https?|Check)[-:A-Za-z]* ' >"$1/etc/apt/apt.conf.d/90machine"
    return 0
}

# In namespaces of its own: mounts what programs want, and makes the targets.
inside() { # root
    root=$1
    # The root itself, too: tests that make mounts want / to be a mount point.
    mount --bind "$root" "$root" && mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" || exit 2
    if [ -d "$data" ]; then
        mkdir -p "$root/src/shared/data" && mount --bind "$data" "$root/src/shared/data" &&
            mount -o remount,bind,ro "$root/src/shared/data" || exit 2
    fi
    for target in $targets; do
        echo "== make $target"
        # shellcheck disable=SC2016
        env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} \
            chroot "$root" sh -c 'cd /src/zraster && case $1 in *.sh) exec "$1" ;; *) exec make "$1" ;; esac' sh "$target" 2>&1 || { echo "== make $target failed"; exit 1; }
    done
}

if [ "${1:-}" = inside ]; then
    inside "$2"
    exit
fi

# What runs in the background is waited for, so that signals reach this script at once.
await() { # its id
    child=$1
    wait "$child"
    status=$?
    child=
    return $status
}

# Made under another name first, so that half a root is never used again. Its make is the one thing that is added.
make_root() { # system, root
    [ -n "$keep" ] || rm -rf --one-file-system "$2"
    [ ! -d "$2" ] || return 0
    rm -rf --one-file-system "$2.new"
    # It mounts, too.
    unshare --mount --pid --fork --kill-child debootstrap --variant=minbase --include=make "$(suite_of "$1")" \
        "$2.new" "$mirror" &
    await $! && mv "$2.new" "$2"
}

clean_up() {
    [ -n "$child" ] && kill -KILL "$child" 2>/dev/null && wait "$child" 2>/dev/null
    for system in $systems; do
        rm -rf --one-file-system "$roots/$system.new"
        [ -n "$keep" ] || rm -rf --one-file-system "${roots:?}/$system"
    done
}

check() { # system
    root=$roots/$1 log=$roots/$1.log
    make_root "$1" "$root" >"$log" 2>&1 || { echo "$1: debootstrap failed, see $log"; return 1; }
    tell_apt "$root"
    rm -rf --one-file-system "$root/src/zraster"
    git clone -q . "$root/src/zraster" || { echo "$1: no clone of this checkout"; return 1; }
    [ -z "$debs" ] || { mkdir -p "$root/src/debs" && cp "$debs"/*.deb "$root/src/debs"; } || return 1
    unshare --mount --pid --fork --kill-child "$0" inside "$root" >>"$log" 2>&1 &
    await $!
    made=$?
    figures=$(grep -E '^[0-9]+ passed, [0-9]+ failed, [0-9]+ skipped$' "$log" | tail -n 1)
    warnings=$(grep -cE "$compiler_warning" "$log")
    echo "$1: ${figures:-no figures}"
    grep '^== make .* failed' "$log" | sed "s/^== /$1: /"
    [ "$warnings" = 0 ] || { echo "$1: $warnings warnings:" && grep -E "$compiler_warning" "$log" | sort | uniq -c | head -n 20; }
    [ $made = 0 ] && [ "$warnings" = 0 ] || { echo "$1: all of it: $log"; return 1; }
}

if [ "$(id -u)" != 0 ]; then
    echo "error: make systems needs root: it mounts and changes roots" >&2
    exit 2
fi
mkdir -p "$roots" || exit 2
[ -z "$(git status --porcelain)" ] || echo "only what is committed is tested: there are changes that are not"
trap clean_up EXIT
trap 'exit 130' INT TERM HUP
worst=0
for system in $systems; do
    check "$system" || worst=1
    [ -n "$keep" ] || rm -rf --one-file-system "${roots:?}/$system"
done
exit $worst
