#!/bin/sh
# times.sh LOG SECONDS: what `make` spent its processor time on, from the files of timed.sh; SECONDS: the time that went by.
set -eu
cat "$1"/* | awk -v elapsed="$2" '
    function seconds(text, parts) { # 1m2.5s
        split(text, parts, "m")
        return 60 * parts[1] + parts[2]
    }
    function kind_of(target, parts, n) {
        if (target ~ /_kernel\.[a-z0-9]+\.o$/) {
            n = split(target, parts, ".")
            return "kernels " parts[n - 1]
        }
        if (target ~ /_files\.c$/) return "manual and page"
        if (target !~ /\.o$/ || target ~ /libzraster\.o$/) return "libraries, programs, man pages"
        n = split(target, parts, "/")
        return parts[1] (n > 2 ? "/" parts[2] : "") (n > 3 && parts[2] == "input" ? "/" parts[3] : "")
    }
    NR % 3 == 1 {
        target = $0
        sub(/^.*times\//, "", target)
    }
    NR % 3 == 0 {
        time = seconds($1) + seconds($2)
        kind = kind_of(target)
        sum[kind] += time
        total += time
        if (!(target in of)) {
            count[kind]++
            if (target ~ /\.o$/ && target !~ /libzraster\.o$/) units++
        }
        of[target] += time
    }
    END {
        printf "%d units compiled, %.1f processor seconds in %d s\n\n", units, total, elapsed
        for (kind in sum) printf "%8.1f s %4d  %s\n", sum[kind], count[kind], kind | "sort -rn"
        close("sort -rn")
        print "\nthe slowest:"
        for (target in of) printf "%8.1f s  %s\n", of[target], target | "sort -rn | head -n 20"
    }'
