#!/bin/sh
# test_documents.sh BUILD: man pages, completion and pages of the manual have every option, command and status; readers of the former accept them. Prints TAP.
set -u
build=$1
work=$(mktemp -d)
. tests/support/verdict.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
: >"$said"
: >"$complained"
options=$({ "$build/zraster" help; "$build/zraster" help batch; } | grep -oE '^ +(-[a-zA-Z], |    )--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u)
flags=$("$build/zrasterd" --help | grep -oE '^  --[a-z-]+' | tr -d ' ')
has_all() { # FILE WORD...: with roff's dashes as plain ones
    sed 's/\\-/-/g' "$1" >"$work/plain"
    shift
    for word in "$@"; do
        grep -qe "$word" "$work/plain" || { echo "# no $word" >>"$complained"; return 1; }
    done
}
verdict "there are at least 50 options" [ "$(echo "$options" | wc -l)" -ge 50 ]
verdict "zraster.1 has all" has_all "$build/zraster.1" $options
verdict "zrasterd.8 has all flags of the daemon" has_all "$build/zrasterd.8" $flags
verdict "libzraster.3 has all functions" has_all "$build/libzraster.3" $(sed -n 's/^ZRASTER_API .*\b\(zraster_[a-z_]*\)(.*/\1/p' core/api/zraster.h)
commands=$("$build/zraster" help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/**\1**/p')
verdict "cli.md has all commands" has_all clients/docs/cli.md $commands
# "| `--port` | 8080" of "--port=N", two lines and "(default: 8080)".
defaults() { "$build/zrasterd" --help | awk '/^  --[a-z-]+=/ { sub(/=.*/, "", $1); flag = $1 } /\(default: / { sub(/.*\(default: /, ""); sub(/\)$/, ""); print "| `" flag "` | " $0 " " }'; }
defaults >"$work/defaults"
limits_are_those() {
    [ -s "$work/defaults" ] || return 1
    while IFS= read -r row; do grep -qF -e "$row" clients/docs/limits.md || { echo "# no $row" >>"$complained"; return 1; }; done <"$work/defaults"
}
verdict "limits.md has all flags of the daemon, with their defaults" limits_are_those
verdict "errors.md has all statuses" has_all clients/docs/errors.md $(sed -n 's/^| \([1-5][0-9][0-9]\)\(, .*\)* | .*/\1/p' server/api/v1.md)
verdict "and a missing one is found" eval '! has_all "$build/zraster.1" --not-an-option'
for shell in bash zsh fish; do
    dashes=--
    [ $shell = fish ] && dashes='-l '
    verdict "$shell completes all options" has_all "$build/completion.$shell" $(echo "$options" | sed "s/^--/$dashes/" | tr -d ' ' | sed 's/^-l/-l./')
    verdict "and looks, channels and presets" has_all "$build/completion.$shell" technical instanceId isometric
    if command -v $shell >/dev/null; then
        verdict "$shell reads it" $shell -n "$build/completion.$shell"
    else
        skip "$shell reads its completion" "$shell is missing"
    fi
done
complete() { # WORD...: the answers of bash's completion
    bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _zraster; printf "%s\n" "${COMPREPLY[@]}"' bash "$build/completion.bash" "$@"
}
verdict "bash completes a look" [ "$(complete zraster --look te | tr '\n' ' ')" = "technical textbook " ]
verdict "and an environment" [ "$(complete zraster --environment met | tr '\n' ' ')" = "metal " ]
verdict "an option" [ "$(complete zraster part.stl --az)" = --azimuth ]
verdict "and a command" [ "$(complete zraster comp)" = compare ]
if command -v groff >/dev/null; then
    for page in zraster.1 zrasterd.8 libzraster.3; do
        verdict "groff reads $page without a warning" eval "groff -man -Tutf8 -ww '$build/$page' >'$said' 2>'$complained' && [ ! -s '$complained' ]"
    done
else
    skip "groff reads the pages" "groff is missing"
fi
verdicts
