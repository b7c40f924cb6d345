#!/bin/sh
# test_docs.sh BUILD: runs the examples of the README and of the pages, each page in a folder with a part.stl, and checks that links lead to
# files and headings. Examples are blocks that begin with the command, curl or a compiler; only the daemon's address is replaced. Prints TAP.
set -u
build=$(realpath "$1")
root=$PWD
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
. tests/support/address.sh
said=$work/said complained=$work/complained
unset ZRASTER_SERVER

: >"$work/out"
"$build/zrasterd" --port 0 >"$work/out" 2>"$work/log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
server=$(address_in "$work/out") || { echo "$server"; exit 1; }

run_blocks() { # PAGE
    # A block ends where a line is not indented.
    awk '/^    (curl|cc|build\/zraster) / && !inside { name = sprintf("block%03d", ++n); inside = 1 } !/^    / { inside = 0 }
         inside { print > name }' "$root/$1"
    for block in block*; do
        [ -f "$block" ] || continue
        blocks=$((blocks + 1))
        if grep -q '^ *cc ' "$block" && grep -q __asan "$build/libzraster.so.0"; then
            skip "$1 compiles a program" "the library has the sanitizers of another compiler"
            continue
        fi
        sed "s|http://127.0.0.1:8080|$server|" "$block" >"$block.sh"
        sh -e "$block.sh" >"$said" 2>"$complained"
        status=$?
        verdict "$1 runs: $(head -n 1 "$block" | sed 's/^ *//; s/  *#.*//')" [ "$status" = 0 ]
    done
}

# The names that browsers give to headings: lower case, no punctuation, - for spaces.
headings() { # PAGE
    sed -n 's/^##* //p' "$1" | tr '[:upper:] ' '[:lower:]-' | sed 's/[^[:alnum:]_-]//g'
}
broken_links() { # PAGE: prints those that lead nowhere
    folder=$(dirname "$1")
    grep -oE '(\]\(|src="|href=")[^")# ]*(#[^") ]*)?[")]' "$1" | sed 's/^](//; s/^[a-z]*="//; s/[")]$//' | grep -v '^[a-z]*:' | sort -u |
        while IFS= read -r link; do
            file=${link%%#*}
            target=$folder/$file
            [ -n "$file" ] || target=$1
            [ -e "$target" ] || echo "$1: $link"
            case $link in
            *'#'*) headings "$target" | grep -qxF -e "${link#*#}" || echo "$1: $link" ;;
            esac
        done
}
all_links_lead() { # PAGE
    broken_links "$1" >"$complained"
    [ ! -s "$complained" ]
}

blocks=0
for page in README.md clients/docs/*.md clients/python/README.md server/api/v1.md; do
    verdict "links of $page lead somewhere" all_links_lead "$page"
    case $page in server/* | clients/python/*) continue ;; esac
    mkdir -p "$work/${page%.md}"
    cd "$work/${page%.md}" || exit 1
    ln -s "$build" build
    ln -s "$root/core" "$root/clients" .
    triangle >part.stl
    run_blocks "$page"
    cd "$root" || exit 1
done
for picture in README/part README/iso README/triangle clients/docs/quickstart/pictures/part clients/docs/views/sheet; do
    verdict "$picture.png is there" is_png "$work/$picture.png"
done
verdict "there are at least 20 examples" [ "$blocks" -ge 20 ]
printf '# A heading\n[a](#a-heading) [b](#no-heading) [c](nothing.md)\n' >"$work/wrong.md"
verdict "and a link that leads nowhere would be found" [ "$(broken_links "$work/wrong.md" | wc -l)" = 2 ]
verdicts
