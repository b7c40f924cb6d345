#!/bin/sh
# test_haproxy.sh BUILD: clients behind Debian's HAProxy, which names them by PROXY headers, X-Forwarded-For and, from 2.8 on,
# Forwarded. Clients differ in their addresses, 127.0.0.8 and 127.0.0.9. Prints TAP.
set -u
build=$(realpath "$1")
haproxy=$(PATH=$PATH:/usr/sbin command -v haproxy)
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/address.sh
daemons_begin

[ -n "$haproxy" ] || {
    skip "clients behind HAProxy" "haproxy is missing (the package haproxy)"
    verdicts
    exit
}
major=$("$haproxy" -v | sed -n 's/^HAProxy version \([0-9]*\)\.\([0-9]*\).*/\1 \2/p;q')
[ "${major% *}" -gt 2 ] || [ "${major#* }" -ge 8 ] && has_forwarded=yes || has_forwarded=

# ---- the daemons ----

start() { # NAME OPTION...: its address, host and port, becomes $address
    name=$1
    shift
    daemon_start "$name" --port 0 --trusted-proxies 127.0.0.1 "$@"
    address=${address#http://}
}
limits="--max-per-private-client 1 --cost-max-ms 86400000" # else a slow build refuses the slow request at once
start header $limits
header=$address
start proxy --proxy-protocol on $limits
proxy=$address
start forwarded --client-header forwarded
forwarded=$address

# ---- HAProxy ----

configure() { # PORT
    cat <<END
global
    log stderr format raw local0
defaults
    timeout connect 2s
    timeout client 20s
    timeout server 20s
    default-server check inter 100ms
listen header
    mode http
    bind 127.0.0.1:$1
    option forwardfor
    option httpchk GET /readyz
    server one $header
listen v1
    mode http
    bind 127.0.0.1:$(($1 + 1))
    server one $proxy send-proxy
listen v2
    mode http
    bind 127.0.0.1:$(($1 + 2))
    unique-id-format %{+X}o%ci:%cp
    option httpchk GET /readyz
    server one $proxy send-proxy-v2 proxy-v2-options crc32c,unique-id
listen tcp
    mode tcp
    bind 127.0.0.1:$(($1 + 3))
    server one $proxy send-proxy-v2
listen bare
    mode http
    bind 127.0.0.1:$(($1 + 4))
    server one $proxy
END
    [ -z "$has_forwarded" ] || cat <<END
listen forwarded
    mode http
    bind 127.0.0.1:$(($1 + 5))
    option forwarded
    server one $forwarded
END
}
is_up() { curl -sf -o /dev/null "http://127.0.0.1:$port/healthz"; }
tries=0 started=
until [ $((tries += 1)) -gt 9 ]; do
    port=$((20000 + ($$ * 13 + tries * 997) % 12000))
    is_up && continue # another program's
    configure $port >"$work/haproxy.cfg"
    "$haproxy" -db -f "$work/haproxy.cfg" >"$work/haproxy" 2>"$complained" &
    started=$!
    within 5 is_up && break
    kill $started 2>/dev/null
done
pids="$pids $started"
verdict "HAProxy passes requests on" is_up

ask() { # OFFSET MARK OPTION...: prints the status
    offset=$1 mark=$2
    shift 2
    curl -s -o "$work/answer" -w '%{http_code}' "$@" "http://127.0.0.1:$((port + offset))/healthz?$mark"
}
client_is() { # ADDRESS MARK
    within 3 grep -q "\"client\":\"$1\",\"remote\":\"127.0.0.1\".*\"query\":\"$2\"" "$work"/log-*
}
names() { # ADDRESS OFFSET MARK OPTION...
    wanted=$1
    shift
    [ "$(ask "$@")" = 200 ] && client_is "$wanted" "$2"
}

verdict "forwardfor names the client" names 127.0.0.9 0 xff --interface 127.0.0.9
verdict "not the address that the client claims" names 127.0.0.9 0 xff-spoof --interface 127.0.0.9 -H 'X-Forwarded-For: 1.1.1.1' -H 'Forwarded: for=1.1.1.1'
verdict "send-proxy names the client" names 127.0.0.9 1 v1 --interface 127.0.0.9
verdict "whatever it claims" names 127.0.0.9 1 v1-spoof --interface 127.0.0.9 -H 'X-Forwarded-For: 1.1.1.1'
verdict "a client that sends a PROXY header of its own is refused by HAProxy" [ "$(ask 1 v1-own --haproxy-protocol)" = 400 ]
verdict "send-proxy-v2 with a checksum and an id names the client" names 127.0.0.9 2 v2 --interface 127.0.0.9
verdict "so does one that passes bytes on" names 127.0.0.9 3 tcp --interface 127.0.0.9
verdict "where a PROXY header of the client's own is refused" [ "$(ask 3 tcp-own --haproxy-protocol)" = 400 ]
verdict "without send-proxy, requests are refused" [ "$(ask 4 bare)" = 400 ]
verdict "and the answer says why" grep -q 'begins without a PROXY header' "$work/answer"
if [ -n "$has_forwarded" ]; then
    verdict "option forwarded names the client" names 127.0.0.9 5 forwarded --interface 127.0.0.9
    verdict "not the address that the client claims" names 127.0.0.9 5 forwarded-spoof --interface 127.0.0.9 -H 'Forwarded: for="1.1.1.1'
else
    skip "option forwarded names the client" "HAProxy is older than 2.8"
fi

# ---- many requests ----

for k in 8 9; do # two clients at once, on kept connections of HAProxy
    seq 100 | sed "s|.*|url = \"http://127.0.0.1:$((port + 1))/healthz?many-$k\"\noutput = /dev/null|" >"$work/urls-$k"
    curl -sf --interface 127.0.0.$k -K "$work/urls-$k" &
    eval "curl_$k=$!"
done
verdict "clients at once are all answered" eval 'wait $curl_8 && wait $curl_9'
counts() { [ "$(grep -c "\"client\":\"127.0.0.$1\".*\"query\":\"many-$1\"" "$work/log-proxy")" = 100 ]; }
verdict "and each request has its own client" eval 'within 3 counts 8 && within 3 counts 9'

# ---- budgets ----

awk 'BEGIN { printf "{\"algorithm\":\"edgelist\",\"window\":{\"width\":1024,\"height\":1024},\"view\":{\"preset\":\"front\"},\"polygons\":["
    for (i = 0; i < 2000; i++) printf "%s{\"vertices\":[[-1,-1,%d],[1,-1,%d],[1,1,%d],[-1,1,%d]]}", i ? "," : "", i, i, i, i
    print "]}" }' >"$work/slow.json"
echo '{"polygons":[{"vertices":[[0,0,0],[1,0,0],[0,1,0]]}]}' >"$work/quick.json"
render() { # OFFSET ADDRESS FILE
    curl -s -o /dev/null -w '%{http_code}' --interface "$2" -H 'Content-Type: application/json' --data-binary "@$work/$3" "http://127.0.0.1:$((port + $1))/v1/render"
}
is_busy() { curl -sf "http://127.0.0.1:$((port + $1))/metrics" | grep -q '^zraster_workers_busy 1'; }
for offset in 0 2; do
    render $offset 127.0.0.9 slow.json >/dev/null &
    slow=$!
    within 5 is_busy $offset
    verdict "a client that has its share gets 429" [ "$(render $offset 127.0.0.9 quick.json)" = 429 ]
    verdict "another one is served" [ "$(render $offset 127.0.0.8 quick.json)" = 200 ]
    kill $slow
    wait $slow 2>/dev/null
done

verdict "HAProxy's checks find the daemons well" eval '! grep -q "is DOWN" "$complained"'
verdict "checks without a request leave no line" eval '! grep -q "within its PROXY header" "$work/log-proxy"'
verdicts
