#!/bin/sh
# test.sh BUILD: builds the image as the Dockerfile says, runs it as a hardened container,
# asks it for a picture, and stops it. Needs no engine on the machine: it unpacks Debian's
# own into BUILD/container, starts it as a private daemon, and ends it by its own pid file.
# Needs root and apt. Prints TAP; exits 1 on failure, and where it cannot run.
set -u
work=$(mkdir -p "$1/container" && cd "$1/container" && pwd)
client=$(cd "$1" && pwd)/zraster
engine=$work/engine
state=$work/state
socket=unix://$work/docker.sock
count=0
failed=0

if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
    echo "error: the container test needs root and apt-get; nothing was tested" >&2
    exit 1
fi

check() { # text, command...
    text=$1
    shift
    count=$((count + 1))
    if "$@" >"$work/check.log" 2>&1; then
        echo "ok $count - $text"
    else
        failed=$((failed + 1))
        echo "not ok $count - $text"
        tail -n 20 "$work/check.log" >&2
    fi
}

docker() { "$engine/usr/bin/docker" -H "$socket" "$@"; }

unpack_engine() {
    [ -x "$engine/usr/sbin/dockerd" ] && return
    mkdir -p "$work/debs" "$engine" && cd "$work/debs" || return 1
    apt-get update >/dev/null && apt-get download docker.io containerd runc debootstrap libintl-perl >/dev/null 2>&1 ||
        apt-get download docker.io containerd runc debootstrap >/dev/null || return 1
    for deb in *.deb; do dpkg-deb -x "$deb" "$engine" || return 1; done
    cd - >/dev/null || return 1
}

start_engine() {
    mkdir -p "$state"
    PATH=$engine/usr/sbin:$engine/usr/bin:$engine/sbin:$PATH "$engine/usr/sbin/dockerd" -H "$socket" \
        --data-root "$state/data" --exec-root "$state/exec" --pidfile "$work/dockerd.pid" \
        --bridge none --iptables=false --ip6tables=false >"$work/dockerd.log" 2>&1 &
    tries=0
    until docker version >/dev/null 2>&1; do
        tries=$((tries + 1))
        [ "$tries" -gt 60 ] && { tail -n 20 "$work/dockerd.log" >&2; return 1; }
        sleep 0.5
    done
}

stop_engine() {
    docker rm -f zraster-test >/dev/null 2>&1
    [ -f "$work/dockerd.pid" ] && kill "$(cat "$work/dockerd.pid")" 2>/dev/null && wait
    umount "$state/exec/netns/default" 2>/dev/null
    return 0
}

# What the Dockerfile builds on, made here: a registry may be out of reach. It has this machine's ways to the network,
# and the sources of its own release, which may be another than this machine's.
make_base() {
    base=$(sed -n 's/^FROM \(debian:[^ ]*\) .*/\1/p' Dockerfile) release=${base#debian:}
    docker image inspect "$base" >/dev/null 2>&1 && return
    rm -rf "$work/base"
    DEBOOTSTRAP_DIR=$engine/usr/share/debootstrap "$engine/usr/sbin/debootstrap" --variant=minbase "${release%-slim}" "$work/base" \
        "$(sed -n 's/^deb [^h]*\(http[^ ]*\).*/\1/p; s/^URIs: *\(http[^ ]*\).*/\1/p' /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -n 1)" \
        >"$work/debootstrap.log" 2>&1 || { tail -n 5 "$work/debootstrap.log"; return 1; }
    cp -a /etc/apt/apt.conf.d/. "$work/base/etc/apt/apt.conf.d/"
    tar -C "$work/base" -c . | docker import - "$base" >/dev/null && rm -rf "$work/base"
}

build_image() { DOCKER_BUILDKIT=1 docker build --network host -t zraster:test .; }

run_hardened() {
    docker run -d --name zraster-test --network host --read-only --cap-drop ALL --security-opt no-new-privileges \
        --memory 256m --pids-limit 64 zraster:test --port 0 --address 127.0.0.1 \
        --render-timeout-ms 60000 --drain-timeout-ms 60000 >/dev/null || return 1
    tries=0
    until docker logs zraster-test 2>/dev/null | grep -q '^listening on '; do
        tries=$((tries + 1))
        [ "$tries" -gt 50 ] && { docker logs zraster-test; return 1; }
        sleep 0.1
    done
}

render_a_picture() {
    server=$(docker logs zraster-test 2>/dev/null | sed -n 's/^listening on //p')
    "$client" render clients/examples/solids.json --server "$server" --channel color -o "$work/solids.png" &&
        head -c 8 "$work/solids.png" | od -An -tx1 | grep -q '89 50 4e 47'
}

# Uid, capabilities and the like of the daemon, as the kernel has them.
status_of() { awk -v name="$1:" '$1 == name { print $2 }' "/proc/$(docker inspect -f '{{.State.Pid}}' zraster-test)/status"; }
is_bare() {
    [ "$(status_of Uid)" = 65532 ] && [ "$(status_of Gid)" = 65532 ] && [ "$(status_of NoNewPrivs)" = 1 ] &&
        for name in CapInh CapPrm CapEff CapBnd CapAmb; do
            [ "$(status_of $name)" = 0000000000000000 ] || { echo "$name $(status_of $name)"; return 1; }
        done
}
is_healthy() { docker exec -e "ZRASTER_PORT=${server##*:}" -e ZRASTER_ADDRESS=127.0.0.1 zraster-test /zrasterd --health; }
settings_are_right() {
    docker run --rm --network none -e ZRASTER_SERVICE_HOST=10.0.0.1 -e ZRASTER_PORT_8080_TCP=tcp://10.0.0.1:8080 zraster:test --check-config
}

# The list of packages that the image has: each library of it is of a Debian package, of this version.
lists_packages() {
    docker create --name zraster-files zraster:test >/dev/null && docker export zraster-files >"$work/image.tar"
    docker rm zraster-files >/dev/null
    tar -xOf "$work/image.tar" usr/share/doc/zraster/packages.txt >"$work/packages.txt" || return 1
    tar -tf "$work/image.tar" | sed -n 's|^\(.*\.so.*\)$|/\1|p' | LC_ALL=C sort >"$work/libraries.txt"
    cut -d ' ' -f 4 "$work/packages.txt" | diff "$work/libraries.txt" - && [ "$(grep -cvE '^[a-z0-9.+:-]+ [0-9][^ ]* [a-z0-9.+-]+ /[^ ]+$' "$work/packages.txt")" = 0 ]
}

build_command() { DOCKER_BUILDKIT=1 docker build --network host --target batch -t zraster-batch:test .; }
# As a pod of server/deploy/kubernetes/indexed-job.yaml.
draws_shards() {
    rm -rf "$work/models" "$work/pictures"
    mkdir -p "$work/models" "$work/pictures" && chmod 777 "$work/pictures" && cp clients/examples/solids.json "$work/models/a.json" &&
        cp clients/examples/solids.json "$work/models/b.json" && chmod -R a+rX "$work/models" || return 1
    for shard in 0 1; do
        docker run --rm --network none --read-only --cap-drop ALL --security-opt no-new-privileges --memory 256m -v "$work/models:/models:ro" \
            -v "$work/pictures:/pictures" zraster-batch:test batch /models -o /pictures --shard $shard/2 --resume --json -c color || return 1
    done
    [ "$(ls "$work/pictures" | tr '\n' ' ')" = "a.png b.png " ] && cmp "$work/pictures/a.png" "$work/solids.png"
}
is_not_root() { [ "$(docker inspect -f '{{.Config.User}}' zraster:test)" = 65532:65532 ]; }
has_no_shell() { ! docker run --rm --network none --entrypoint /bin/sh zraster:test -c true; }
# A request of some seconds is in flight when SIGTERM comes.
drains() {
    printf 'wheel|%s\n' "$(awk -v model=wheel -f clients/gallery/models.awk)" | awk -f clients/gallery/obj.awk >"$work/wheel.obj"
    "$client" render "$work/wheel.obj" --server "$server" --turntable 24 -s 640x480 --samples 16 -o "$work/turn.zip" &
    sleep 0.7
    kill -0 $! || return 1
    docker stop -t 60 zraster-test >/dev/null
    wait $! && [ -s "$work/turn.zip" ] && [ "$(docker inspect -f '{{.State.ExitCode}}' zraster-test)" = 0 ]
}

trap stop_engine EXIT
check "an engine starts" eval 'unpack_engine && start_engine'
check "a base image is there" make_base
check "the image builds" build_image
# Most of it is Debian's libraries. Ours is the daemon.
size=$(docker image inspect -f '{{.Size}}' zraster:test)
check "the image is under 20 MB: $size bytes" [ "${size:-20000000}" -lt 20000000 ]
check "it lists its libraries with their packages" lists_packages
sed 's/^/# /' "$work/packages.txt"
check "it does not run as root" is_not_root
check "it has no shell" has_no_shell
check "it starts read-only, without capabilities, in 256 MB" run_hardened
check "it renders the example scene" render_a_picture
check "its process is 65532, without capabilities, and gets none" is_bare
check "its health check answers" is_healthy
check "its settings are right beside the service links of Kubernetes" settings_are_right
check "the image of the command builds" build_command
check "it draws shards as in a job of Kubernetes, read-only, without capabilities" draws_shards
check "docker stop drains it: a request in flight is answered, exit status 0" drains
[ "$failed" = 0 ]
