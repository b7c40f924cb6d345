# verdict.sh - support for tests that are shell scripts: counts tests and prints them as TAP. A test writes its output to the
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

check() { # TEXT STATUS COMMAND...: the command ends with this status; its output is in $said and $complained
    text=$1 wanted=$2
    shift 2
    "$@" >"$said" 2>"$complained" </dev/null
    status=$?
    verdict "$text" [ "$status" = "$wanted" ]
}

skip() { # TEXT WHY: counts a test that cannot run here, and reports it on standard error
    count=$((count + 1))
    echo "ok $count - $1 # skip $2"
    echo "LEFT OUT: $1: $2" >&2
}

within() { # SECONDS COMMAND...: repeats the command until it succeeds; fails if it does not within this time
    tries=$(($1 * 50))
    shift
    until "$@"; do
        [ $((tries -= 1)) -gt 0 ] || return 1
        sleep 0.02
    done
}

verdicts() {
    echo "1..$count"
    [ "$failed" = 0 ]
}
