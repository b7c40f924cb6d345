# address.sh - support for tests that are shell scripts: the address of a daemon that was just started, from its output.

address_in() { # FILE
    tries=0
    until address=$(sed -n 's/^listening on //p' "$1") && [ -n "$address" ]; do
        tries=$((tries + 1))
        [ "$tries" -lt 200 ] || { echo "Bail out! the daemon does not listen"; exit 1; }
        sleep 0.05
    done
    echo "$address"
}
