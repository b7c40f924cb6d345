#!/bin/sh
# map.sh BUILD OUT.md PROGRAM...: runs the test programs, of a BUILD for gcov (make test-map), and writes for each source
# of core/ and server/ the three that run most of it: the share of its branches and calls (gcov's arcs). A program is stopped
# after 8 s of processor time (gcov_signals.c); all that it ran until then counts.
set -eu
build=$1 out=$2
shift 2
work=$build/test-map
rm -rf "$work"
mkdir -p "$work"
strip=$(realpath "$build" | tr -cd / | wc -c)

# One program: "SOURCE RUN ALL PROGRAM" for each source of which it runs something.
cat >"$work/one.sh" <<'END'
program=$1 folder=$work/$(echo "$1" | tr / _)
(ulimit -S -t 8; ulimit -H -t 20; GCOV_PREFIX=$folder GCOV_PREFIX_STRIP=$strip "$build/$program" >/dev/null 2>&1 </dev/null) || echo "$program" >>"$work/stopped"
[ ! -d "$folder" ] || find "$folder" -name '*.gcda' ! -path "$folder/tests/*" -exec gcov-dump -l {} + | awk -v start="$folder/" -v program="$program" '
    { file = substr($1, length(start) + 1); sub(/\.gcda:.*/, "", file); sub(/\.scalar$/, "", file) }
    $2 ~ /^[0-9]+:$/ && $3 !~ /:/ { for (i = 3; i <= NF; i++) { all[file]++; if ($i > 0) run[file]++ } }
    END { for (file in run) print file ".c", run[file], all[file], program }' >"$folder.arcs"
rm -rf "$folder"
END
export build work strip
: >"$work/stopped"
printf '%s\n' "$@" | xargs -P "$(getconf _NPROCESSORS_ONLN)" -I PROGRAM sh "$work/one.sh" PROGRAM

# Of two programs with one share, the first is the one that runs less of everything.
find core server -name '*.c' | sort | cat - "$work"/*.arcs | awk '
    NF == 1 { files[++count] = $1; next }
    { share[$1, $4] = int(100 * $2 / $3 + 0.5); total[$4] += $2; programs[$4] }
    function is_better(file, a, b) { # program a is shown before b
        if (b == "" || share[file, a] != share[file, b]) return b == "" || share[file, a] > share[file, b]
        return total[a] < total[b]
    }
    END {
        print "# Tests of each source\n\nMade by `make test-map`. A share is that of the branches and calls of the file that the program runs."
        for (i = 1; i <= count; i++) {
            file = files[i]
            folder = file
            sub(/\/[^\/]*$/, "", folder)
            if (folder != last) print "\n## " folder "\n\n| file | programs |\n|---|---|"
            last = folder
            split("", best)
            for (program in programs) {
                if (!((file, program) in share)) continue
                for (k = 3; k > 0 && is_better(file, program, best[k]); k--) best[k + 1] = best[k]
                best[k + 1] = program
            }
            text = ""
            for (k = 1; k <= 3 && best[k] != ""; k++) text = text (k > 1 ? ", " : "") "`" best[k] "` " share[file, best[k]] " %"
            if (text == "") none[++nones] = file
            print "| `" substr(file, length(folder) + 2) "` | " (text == "" ? "none" : text) " |"
        }
        print "\n## Sources that none of these programs runs, or that have no code\n"
        for (i = 1; i <= nones; i++) print "- `" none[i] "`"
    }' | sed "s|\`tests/|\`|g" >"$out"
sed 's/^/stopped, or failed: /' "$work/stopped" >&2
echo "$out"
