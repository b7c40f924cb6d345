#!/bin/sh
# test_nginx.sh BUILD: Debian's nginx, with server/deploy/nginx.conf, which clients/docs/how-to/nginx.md shows, before two daemons that
# share a folder of assets. Only addresses and folders differ from the file. Prints TAP.
set -u
build=$(realpath "$1")
page=clients/docs/how-to/nginx.md
file=server/deploy/nginx.conf
nginx=$(PATH=$PATH:/usr/sbin command -v nginx)
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
. tests/support/address.sh
daemons_begin

sed -n '/^```nginx$/,/^```$/p' $page | sed '/^```/d' >"$said"
verdict "the page shows the file" eval 'sed "/^# Two daemons/d" $file | cmp - "$said"'

[ -n "$nginx" ] || {
    skip "the service behind nginx" "nginx is missing (the package nginx)"
    verdicts
    exit
}

# ---- the service ----

export ZRASTER_TOKEN=secret
mkdir "$work/assets"
daemon_start 1 --port 0 --max-per-client 0 --assets-dir "$work/assets"
daemon_1=$started address_1=$address
daemon_start 2 --port 0 --max-per-client 0 --assets-dir "$work/assets"
daemon_2=$started address_2=$address

# Port $1 of this machine. A port that is taken ends nginx at once.
configure() { # PORT
    {
        [ "$(id -u)" != 0 ] || echo 'user root;'
        echo "daemon off; pid $work/pid; error_log $work/errors; events {}"
        echo "http { access_log off; client_body_temp_path $work/body; proxy_temp_path $work/proxy; fastcgi_temp_path $work/f; uwsgi_temp_path $work/u; scgi_temp_path $work/s;"
        sed -e "s|listen 80;|listen 127.0.0.1:$1;|" -e "s|/var/lib/nginx/|$work/|" \
            -e "s|127.0.0.1:8081|${address_1#http://}|" -e "s|127.0.0.1:8082|${address_2#http://}|" $file
        echo '}'
    } >"$work/nginx.conf"
}
configure 20000
check "nginx accepts the configuration" 0 "$nginx" -t -p "$work" -e "$work/errors" -c "$work/nginx.conf"
is_up() { curl -sf -o /dev/null "$front/healthz"; }
folder=$(sed -n 's/^proxy_cache_path \([^ ]*\) .*/\1/p' $file)
if [ -e /etc/debian_version ] && [ "$nginx" = /usr/sbin/nginx ]; then
    verdict "Debian has the folder in which nginx makes that of the cache" [ -d "${folder%/*}" ]
fi
tries=0 proxy=
until [ $((tries += 1)) -gt 9 ]; do
    port=$((20000 + ($$ * 13 + tries * 997) % 12000))
    front=http://127.0.0.1:$port
    is_up && continue # another program's
    configure $port
    "$nginx" -p "$work" -e "$work/errors" -c "$work/nginx.conf" 2>>"$complained" &
    proxy=$!
    within 5 is_up && break
    kill $proxy 2>/dev/null
done
pids="$pids $proxy"
verdict "nginx passes requests on" is_up

token=secret
ask() { # PATH OPTION...: the answer is in $work/answer, its head in $work/head; prints the status
    path=$1
    shift
    curl -s -o "$work/answer" -D "$work/head" -w '%{http_code}' -H "Authorization: Bearer $token" "$@" "$front$path"
}
answers() { # STATUS PATH OPTION...
    status=$1
    shift
    [ "$(ask "$@")" = "$status" ]
}
cache_was() { grep -qi "^X-Cache: $1" "$work/head"; }
renders() { cat "$work"/log-* | grep -c '"path":"/v1/render","status":200'; }

# ---- pictures ----

scene='{"polygons": [{"vertices": [[0,0,0], [1,0,0], [0,1,0]], "color": "#cc3333"}]}'
other='{"polygons": [{"vertices": [[0,0,0], [1,0,0], [0,1,0]], "color": "#33cc33"}]}'
json='Content-Type: application/json'
curl -s "$address_1/v1/render" -H 'Authorization: Bearer secret' -H "$json" -d "$scene" -o "$work/direct"
verdict "a scene is drawn" answers 200 /v1/render -H "$json" -d "$scene"
verdict "the bytes are the daemon's" cmp -s "$work/answer" "$work/direct"
verdict "they were not kept before" cache_was MISS
before=$(renders)
verdict "the same scene is drawn again" answers 200 /v1/render -H "$json" -d "$scene"
verdict "from the cache" cache_was HIT
verdict "with the same bytes" cmp -s "$work/answer" "$work/direct"
verdict "no daemon heard of it" [ "$(renders)" = "$before" ]
verdict "another scene is another picture" answers 200 /v1/render -H "$json" -d "$other"
verdict "which was not kept" cache_was MISS
verdict "and differs" eval '! cmp -s "$work/answer" "$work/direct"'
verdict "a parameter is part of the key" answers 200 '/v1/render?channel=info' -H "$json" -d "$scene"
verdict "so the answer is another one" grep -q '"bounds"' "$work/answer"
token=wrong
verdict "a wrong token gets no kept picture" answers 401 /v1/render -H "$json" -d "$scene"
token=secret

# Bodies that nginx writes to a file have no text in the key.
long() { # COLOUR
    printf '{"polygons": ['
    awk -v color="$1" 'BEGIN { for (i = 0; i < 400; i++) printf "%s{\"vertices\": [[0,0,0], [1,0,0], [0,1,0]], \"color\": \"%s\"}", i ? ", " : "", color }'
    printf ']}'
}
long red >"$work/red" && long blue >"$work/blue"
verdict "a body beyond the buffer is drawn" answers 200 /v1/render -H "$json" --data-binary "@$work/red"
verdict "past the cache" cache_was BYPASS
cp "$work/answer" "$work/first"
verdict "another one of the same size, too" answers 200 /v1/render -H "$json" --data-binary "@$work/blue"
verdict "and their pictures differ" eval '! cmp -s "$work/answer" "$work/first"'
head -c 70000000 /dev/zero >"$work/large"
verdict "a body beyond the limit is refused" answers 413 /v1/render --data-binary "@$work/large"
rm "$work/large"

# ---- assets, streams, several daemons ----

triangle >"$work/part.stl"
hash=$(sha256sum "$work/part.stl" | cut -d ' ' -f 1)
verdict "a model is stored" answers 201 "/v1/assets/$hash" -T "$work/part.stl"
drawn=0
for size in 100 101 102 103 104 105; do
    answers 200 /v1/render -H "$json" -d '{"window": {"width": '$size', "height": 80}, "meshes": [{"asset": "sha256:'"$hash"'"}]}' && drawn=$((drawn + 1))
done
verdict "and drawn by whichever daemon" [ $drawn = 6 ]
verdict "both daemons work" eval 'grep -q "\"status\":200" "$work/log-1" && grep -q "\"status\":200" "$work/log-2"'
verdict "views are streamed" answers 200 '/v1/stream?turntable=3' -H 'Accept: multipart/mixed' --data-binary "@$work/part.stl"
verdict "one by one" [ "$(grep -ac '^Content-Disposition' "$work/answer")" = 3 ]

kill "$daemon_1"
wait "$daemon_1" 2>/dev/null
drawn=0
for size in 110 111 112 113; do
    answers 200 /v1/render -H "$json" -d '{"window": {"width": '$size', "height": 80}, "meshes": [{"asset": "sha256:'"$hash"'"}]}' && drawn=$((drawn + 1))
done
verdict "requests are answered while a daemon is down" [ $drawn = 4 ]

# A daemon whose control group is full answers 503.
mkdir "$work/full"
echo 1000000000 >"$work/full/memory.max"
echo 990000000 >"$work/full/memory.current"
printf 'inactive_file 0\nfile 0\n' >"$work/full/memory.stat"
daemon_start 1 --port "${address_1##*:}" --cgroup "$work/full"
daemon_1=$started
drawn=0
for size in 120 121 122 123; do
    answers 200 /v1/render -H "$json" -d '{"window": {"width": '$size', "height": 80}, "meshes": [{"asset": "sha256:'"$hash"'"}]}' && drawn=$((drawn + 1))
done
verdict "requests that a daemon refuses are answered by the other one" [ $drawn = 4 ]
verdict "some were refused" grep -q '"status":503' "$work/log-1"

kill "$daemon_1" "$daemon_2"
wait "$daemon_1" "$daemon_2" 2>/dev/null
verdict "without daemons, the status is 502" answers 502 /healthz
verdict "kept pictures are sent all the same" answers 200 /v1/render -H "$json" -d "$scene"
verdict "byte by byte" cmp -s "$work/answer" "$work/direct"
verdicts
