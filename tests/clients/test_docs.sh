#!/bin/sh
# test_docs.sh BUILD [PAGE...]: runs the fenced blocks of the README and of the pages, and checks that links lead to files and
# headings. The blocks of one page run in one folder, in their order. It has part.stl, assembly.obj, core/, clients/ and build/,
# whose zrasterd replaces the page's daemon. Prints TAP.
#
# HALF=1 or HALF=2: half of the work, so that two of these run at once.
#
# The first word behind the fence is the language; a block without one fails:
#   sh       sh -e; "sh skip=WHAT" is left out, and says so; "sh by=TEST" is run in another way by this test
#   python   with the package zraster
#   json     a whole scene: the daemon draws it, without a warning; assets that it names are files of the folder or of /v1/examples;
#            "json FILE" is saved as FILE, too
#   jsonc    a part of a scene, or another document: it parses
#   c, cpp   compiled, not run
#   text     output, or a sketch: not run; "text same" is the output of the block before, whatever its line breaks, with ... for any text
#   nginx    checked by tests/server/test_nginx.sh
#   others   checked if a program for them is there (toml, yaml, js), else left out
set -u
build=$(realpath "$1")
shift
root=$PWD
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
. tests/support/address.sh
said=$work/said complained=$work/complained
python=${PYTHON:-/usr/bin/python3}
unset ZRASTER_SERVER ZRASTER_TOKEN
export ZRASTER_LIBRARY="$build/libzraster.so.0" PYTHONPATH="$root/clients/python"

# Python, whose blocks later ones build on, cannot load a library with sanitizers.
if grep -q __asan "$build/libzraster.so.0"; then
    skip "the examples of the pages run" "the library has sanitizers"
    verdicts
    exit
fi

# ---- the folder of a page ----

end_daemon() {
    [ -s "$work/daemon.pid" ] || return 0
    kill "$(cat "$work/daemon.pid")" 2>/dev/null
    within 10 sh -c "! kill -0 $(cat "$work/daemon.pid") 2>/dev/null"
    : >"$work/daemon.pid"
}
trap 'end_daemon; wait 2>/dev/null; rm -rf "$work"' EXIT

# Starts a daemon on a free port, which becomes the port of all that a page starts.
start_daemon() {
    end_daemon
    : >"$work/out"
    "$build/zrasterd" --port 0 >"$work/out" 2>"$work/log" &
    echo $! >"$work/daemon.pid"
    ready=$!
    server=$(address_in "$work/out") || { echo "$server"; exit 1; }
}

make_fixtures() {
    awk -f tests/support/part.awk >"$work/part.stl"
    for part in base axle bearing wheel washer cap; do
        printf '%s|%s\n' "$part" "$(awk -v model=$part -f clients/gallery/models.awk)"
    done | awk -f clients/gallery/obj.awk >"$work/assembly.obj"
    # A daemon without a port takes the place of the page's.
    cat >"$work/zrasterd" <<END
#!/bin/sh
case " \$* " in *' --check-config '* | *' --print-config '*) exec "$build/zrasterd" "\$@" ;; esac
export ZRASTER_PORT=\$TEST_PORT
case " \$* " in *' --help '* | *' --version '* | *' --health '* | *' --port'*) exec "$build/zrasterd" "\$@" ;; esac
kill "\$(cat "$work/daemon.pid")" 2>/dev/null
tries=0
# An ended process that nobody waits for is still there, as a zombie.
while kill -0 "\$(cat "$work/daemon.pid")" 2>/dev/null && ! grep -qs '^State:.*zombie' "/proc/\$(cat "$work/daemon.pid")/status" && [ \$((tries += 1)) -lt 500 ]; do sleep 0.02; done
echo \$\$ >"$work/daemon.pid"
exec "$build/zrasterd" "\$@"
END
    # Where a page sleeps for a second, the daemon that it has begun takes less.
    cat >"$work/sleep" <<END
#!/bin/sh
[ "\$1" = 1 ] || exec command -p sleep "\$1"
for tries in \$(seq 50); do
    ! cmp -s "$work/daemon.pid" "$work/daemon.before" && curl -s -o /dev/null "http://127.0.0.1:\$TEST_PORT/healthz" && exit
    command -p sleep 0.02
done
END
    chmod +x "$work/zrasterd" "$work/sleep"
}

enter_folder() { # PAGE
    mkdir -p "$work/${1%.md}/build"
    cd "$work/${1%.md}" || exit 1
    ln -s "$build"/* build/
    ln -sf "$work/zrasterd" "$work/sleep" build/
    ln -s "$root/core" "$root/clients" .
    cp "$work/part.stl" "$work/assembly.obj" .
}

# ---- blocks ----

# Writes the blocks of a page to files block-N, and prints a line for each: N LINE LANGUAGE INFO. An indented block has no language.
list_blocks() { # PAGE
    awk '
        function begin(language) { ++n; print n, NR, (language == "" ? "none" : language); file = sprintf("block-%d", n); printf "" >file }
        inside {
            line = $0
            for (i = 0; i < indent && line ~ /^ /; i++) line = substr(line, 2)
            if (line ~ /^ *```+ *$/) { inside = 0; close(file) } else print line >file
            next
        }
        /^ *```/ { match($0, /^ */); indent = RLENGTH; line = $0; sub(/^ *```+ */, "", line); begin(line); inside = 1; next }
        /^ *$/ { was_empty = 1; next }
        /^ *([-*]|[0-9]+\.) / { in_list = 1; was_empty = 0; next }
        /^[^ ]/ && was_empty { in_list = 0 }
        /^    / && was_empty && !in_list { begin(""); close(file) }
        { was_empty = 0 }
        END { if (inside) print n + 1, NR, "open" }' "$1"
}

parses_as_json() { # FILE: with comments, whole or the members of an object
    "$python" - "$1" <<'END'
import json, re, sys
text = open(sys.argv[1], encoding="utf-8").read()
text = re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda m: m[1] or "", text, flags=re.S)
try:
    json.loads(text)
except ValueError:
    json.loads("{" + text.strip().rstrip(",") + "}")
END
}

# The body of a scene for curl: files that it names as assets are sent with it, from the folder or from the daemon's examples.
body_of() { # FILE
    names=$(grep -o '"asset": "[a-z][^"]*"' "$1" | sed 's/.*: "\(.*\)"/\1/' | sort -u)
    [ -n "$names" ] || { echo "-H Content-Type:application/json --data-binary @$1"; return; }
    echo "-F scene=@$1;type=application/json"
    for name in $names; do
        [ -e "$name" ] || curl -s -f -o "$name" "$server/v1/examples/$name"
        echo "-F $name=@$name"
    done
}

draws_without_warning() { # FILE
    # shellcheck disable=SC2046
    status=$(curl -s -D "$work/head" -o "$work/answer" -w '%{http_code}' "$server/v1/render" $(body_of "$1"))
    grep -i '^Zraster-Warnings' "$work/head"
    if [ "$status" != 200 ]; then
        cat "$work/answer"
        return 1
    fi
    ! grep -qi '^Zraster-Warnings' "$work/head"
}

run_block() { # LANGUAGE FILE
    export TEST_PORT="${server##*:}"
    # Only the daemon's address differs from the page.
    sed "s|127\.0\.0\.1:8080|${server#http://}|g; s|localhost:8080|${server#http://}|g" "$2" >"$2.run"
    read -r pid <"$work/daemon.pid"
    echo "$pid" >"$work/daemon.before"
    [ "$pid" = "$ready" ] || within 10 curl -s -o /dev/null "$server/health"
    ready=$pid
    case $1 in
    sh) PATH="$PWD/build:$PATH" timeout 120 sh -e "$2.run" ;;
    python) PATH="$PWD/build:$PATH" timeout 120 "$python" "$2.run" ;;
    json) draws_without_warning "$2.run" ;;
    jsonc) parses_as_json "$2.run" ;;
    c) ${CC:-cc} -x c -std=c11 -Wall -Werror -fsyntax-only -Icore/api "$2.run" ;;
    cpp) ${CXX:-c++} -x c++ -std=c++17 -Wall -Werror -fsyntax-only -Icore/api "$2.run" ;;
    toml) "$python" -c 'import sys, tomllib; tomllib.load(open(sys.argv[1], "rb"))' "$2.run" ;;
    yaml) "$python" -c 'import sys, yaml; list(yaml.safe_load_all(open(sys.argv[1])))' "$2.run" ;;
    js) cp "$2.run" "$2.mjs" && node --check "$2.mjs" ;;
    esac
}

# True if a program or a package for a language is missing.
lacks() { # LANGUAGE FILE
    case $1 in
    sh) grep -q '^ *cc \|^python3 ' "$2" && grep -q __asan "$build/libzraster.so.0" ;; # its sanitizers are those of another compiler
    python) grep -q __asan "$build/libzraster.so.0" ;;
    js) ! command -v node >/dev/null ;;
    toml) ! "$python" -c 'import tomllib' 2>/dev/null ;;
    yaml) ! "$python" -c 'import yaml' 2>/dev/null ;;
    *) return 1 ;;
    esac
}

# True if the test of a block is there, the block is one of sh, and its files of server/deploy and flags of zrasterd exist.
is_run_by() { # TEST FILE
    [ -s "$root/$1" ] && sh -n "$2" || return 1
    for file in $(grep -o 'server/deploy/[a-z./]*' "$2"); do [ -s "$root/$file" ] || return 1; done
    for flag in $(sed -n 's/.*zrasterd \(--[^&]*\).*/\1/p' "$2" | grep -o -- '--[a-z-]*'); do
        "$build/zrasterd" --help | grep -q -- "^  $flag=" || return 1
    done
}

# True if the file is the output of the block that ran last.
is_last_output() { # FILE
    "$python" - "$1" "$work/last" "$server" >"$said" 2>"$complained" <<'END'
import re, sys
wanted, got = (open(name, encoding="utf-8", errors="replace").read().strip() for name in sys.argv[1:3])
got = "".join(line.strip() for line in got.replace(sys.argv[3].partition("//")[2], "127.0.0.1:8080").splitlines())
wanted = "".join(line.strip() for line in wanted.splitlines())
if not re.fullmatch(".*".join(map(re.escape, wanted.split("..."))), got, re.S):
    sys.exit("the block printed:\n" + got)
END
}

run_blocks() { # PAGE: its list is in the file blocks
    while read -r number line language info; do
        at="$1:$line"
        block=block-$number
        case $language,$info in
        none,* | open,*)
            : >"$said"
            echo "$at: a block without a language, or without an end" >"$complained"
            verdict "$at has a language" false
            continue
            ;;
        text,same)
            verdict "$at is the output of the block before" is_last_output "$block"
            continue
            ;;
        text, | nginx,) continue ;; # nginx: tests/server/test_nginx.sh
        sh,skip=* | python,skip=*)
            skip "$at: $language" "needs ${info#skip=}"
            continue
            ;;
        sh,by=*)
            verdict "$at: $language: ${info#by=} runs it" is_run_by "${info#by=}" "$block"
            continue
            ;;
        json,*.json) cp "$block" "$info" ;; # for the blocks behind it
        sh, | python, | json, | jsonc, | c, | cpp, | toml, | yaml, | js,) ;;
        ini, | xml, | html, | dockerfile,)
            skip "$at: $language" "no program here checks it"
            continue
            ;;
        *)
            : >"$said"
            echo "$at: unknown language '$language $info'" >"$complained"
            verdict "$at has a known language" false
            continue
            ;;
        esac
        if lacks "$language" "$block"; then
            skip "$at: $language" "a program or a package for it is missing"
            continue
        fi
        run_block "$language" "$block" >"$work/last" 2>"$complained" </dev/null
        status=$?
        [ "$status" = 0 ] || cp "$work/last" "$said"
        verdict "$at: $language: $(awk 'NF { sub(/^ */, ""); gsub(/#/, "-"); print substr($0, 1, 70); exit }' "$block")" [ "$status" = 0 ]
    done <blocks
}

# ---- links ----

broken_links() { "$python" "$root/tests/clients/links.py" "$@"; }
all_links_lead() { # PAGE
    grep "^$1: " "$work/broken" >"$complained"
    [ ! -s "$complained" ]
}

# ---- commands of make ----

makefiles=$(cd "$root" && realpath Makefile $(sed -n 's/^include //p' Makefile))
missing_targets() { # PAGE: the words behind make, in code, that are no targets
    sed -n '/^ *```/,/^ *```/p; s/.*`\(make[^`]*\)`.*/\1/p' "$1" | grep -oE '(^| |&& )make +([A-Z]+=[^ ]+ +)*[a-z][a-z-]*/?' | grep -v '/$' | sed 's/.* //' | sort -u |
        while read -r target; do cat $makefiles | grep -q "^$target:" || echo "$1: make $target"; done
}
all_targets_are_there() { # PAGE
    missing_targets "$1" >"$complained"
    [ ! -s "$complained" ]
}

# ---- the pages ----

all_pages=$*
[ -n "$all_pages" ] || all_pages="README.md $(find clients/docs -name '*.md' | LC_ALL=C sort) clients/python/README.md server/api/v1.md"
first=$(($(echo "$all_pages" | wc -w) * 2 / 5)) # these take half of the time
case ${HALF:-} in
1) pages=$(printf "%s\n" $all_pages | head -n $first) ;;
2) pages=$(printf "%s\n" $all_pages | tail -n +$((first + 1))) ;;
*) pages=$all_pages ;;
esac
make_fixtures
# shellcheck disable=SC2086
broken_links $pages >"$work/broken" || exit 1
for page in $pages; do
    verdict "links of $page lead somewhere" all_links_lead "$page"
    verdict "targets of make in $page are in the Makefile" all_targets_are_there "$page"
    case $page in server/* | clients/python/*) continue ;; esac
    enter_folder "$page"
    list_blocks "$root/$page" >blocks
    if [ -s blocks ]; then
        start_daemon
        run_blocks "$page"
    fi
    cd "$root" || exit 1
done
if [ $# = 0 ]; then
    for picture in README:part README:iso README:triangle clients/docs/quickstart:pictures/part clients/docs/views:sheet; do
        case " $(echo $pages) " in *" ${picture%:*}.md "*) ;; *) continue ;; esac # of the other half
        verdict "$picture.png is there" is_png "$work/${picture%:*}/${picture#*:}.png"
    done
fi
if [ "${HALF:-1}" = 2 ]; then
    verdicts
    exit
fi
if [ $# = 0 ]; then
    cd "$work" || exit 1
    for page in $all_pages; do list_blocks "$root/$page"; done >blocks
    cd "$root" || exit 1
    left_out=$(awk '$4 ~ /^skip=/ || $3 ~ /^(ini|xml|html|dockerfile)$/' "$work/blocks" | wc -l)
    blocks=$(awk '$4 !~ /^(skip|by)=/ && $3 ~ /^(sh|python|jsonc?|c|cpp|toml|yaml|js)$/' "$work/blocks" | wc -l)
    verdict "there are at least 150 examples: $blocks" [ "$blocks" -ge 150 ]
    verdict "few are left out: $left_out" [ "$left_out" -le 20 ]
fi

# ---- each kind of fault would be found ----

printf '# A heading\n[a](#a-heading) [b](#no-heading) [c](nothing.md)\n' >"$work/wrong.md"
verdict "a link that leads nowhere would be found" [ "$(broken_links "$work/wrong.md" | wc -l)" = 2 ]
printf '`make all` `make no-such-target`\n```sh\nmake nothing\n```\n' >"$work/wrong.md"
verdict "as would targets that are not there" [ "$(missing_targets "$work/wrong.md" | wc -l)" = 2 ]
cd "$work" || exit 1
printf '```\na\n```\n\n    b\n\n- c\n\n      d\n\n```sh\ne\n' >wrong.md
verdict "as would blocks without a language or an end" [ "$(list_blocks wrong.md | cut -d ' ' -f 3 | tr '\n' ' ')" = "none none sh open " ]
start_daemon
cat >wrong <<'END'
sh true; false; true
python assert 1 == 2
json {"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0]]}]}
json {"polygons": [{"vertices": [[0, 0, 0], [0, 0, 0], [0, 0, 0]]}]}
jsonc {"a": }
c int f(void) { return g(); }
END
while read -r language text; do
    echo "$text" >wrong.block
    lacks "$language" wrong.block && continue
    run_block "$language" wrong.block >"$said" 2>"$complained"
    verdict "as would a wrong block of $language" [ $? != 0 ]
done <wrong
for text in 'zrasterd --port 1 --no-flag 2 &' 'haproxy -f server/deploy/none.cfg' 'for port in 1 2; do'; do
    echo "$text" >wrong.block
    verdict "as would, in a block of another test: $text" eval '! is_run_by tests/run.sh wrong.block'
done
verdicts
