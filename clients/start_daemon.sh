# start_daemon.sh, to be sourced: starts the daemon of the folder $build on a free port and sets $server to its address. The
# daemon ends with the script. Its output goes to the folder $out.
: >"$out/daemon.out" # drops the address of an earlier daemon
"$build/zrasterd" --port 0 >"$out/daemon.out" 2>"$out/daemon.log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null || true; wait "$daemon" 2>/dev/null || true' EXIT
tries=0
until server=$(sed -n 's/^listening on //p' "$out/daemon.out") && [ -n "$server" ]; do
    tries=$((tries + 1))
    if [ "$tries" -gt 100 ] || ! kill -0 "$daemon" 2>/dev/null; then
        echo "error: the daemon did not start:" >&2
        cat "$out/daemon.log" >&2
        exit 1
    fi
    sleep 0.05
done
