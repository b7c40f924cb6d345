# address.sh - support for tests that are shell scripts, after verdict.sh: daemons, and their addresses.

address_in() { # FILE
    within 10 grep -q '^listening on .' "$1" || { echo "Bail out! the daemon does not listen"; exit 1; }
    sed -n 's/^listening on //p' "$1"
}

# For tests that start several, in the folder $work: all processes of $pids end with the test.
daemons_begin() {
    said=$work/said complained=$work/complained
    : >"$said"
    : >"$complained"
    pids=
    trap 'kill $pids 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
    unset ZRASTER_SERVER
}

daemon_start() { # NAME OPTION...: its process becomes $started, its address $address, and its log $work/log-NAME
    name=$1
    shift
    : >"$work/out-$name"
    "$build/zrasterd" "$@" >"$work/out-$name" 2>"$work/log-$name" &
    started=$!
    pids="$pids $started"
    address=$(address_in "$work/out-$name") || { echo "$address"; exit 1; }
}
