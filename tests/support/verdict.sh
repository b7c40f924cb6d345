# verdict.sh - support, for tests that are shell scripts: counts and prints them as TAP. A test writes its output to the
# files $said and $complained, which a failure prints. Ends with `verdicts`.
count=0
failed=0

verdict() { # TEXT COMMAND...
    text=$1
    shift
    count=$((count + 1))
    if "$@"; then
        echo "ok $count - $text"
    else
        failed=$((failed + 1))
        echo "not ok $count - $text"
        tail -n 20 "$said" "$complained" >&2
    fi
}

verdicts() {
    echo "1..$count"
    [ "$failed" = 0 ]
}
