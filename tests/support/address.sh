# address.sh - support for tests that are shell scripts, after verdict.sh: the address of a daemon that was just started.

address_in() { # FILE
    within 10 grep -q '^listening on .' "$1" || { echo "Bail out! the daemon does not listen"; exit 1; }
    sed -n 's/^listening on //p' "$1"
}
