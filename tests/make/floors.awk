# floors.awk - finds #include lines of core/, server/ and clients/ that lead to a higher floor or room, or close a circle.
#
#   awk -v known=FILE -f floors.awk core/vec.c server/main.c ...     in the folder above, with all of their *.c and *.h
#
# Prints a line per fault, and ends with 1 if there is one. FILE has the faults that are known, "INCLUDER INCLUDED why",
# named as below core/, or as server/main.c. They are passed over, and one that is no fault any more is a fault of the list.
#
# Circles are those of modules: a header and the .c of its name are one. Where a.c includes b.h and b.c includes a.h,
# neither can be linked or tested without the other. That holds circles of headers, too. A kernel (a_kernel.c) is a
# module of its own: no header declares what it includes. Of a circle it is enough to know one line, without which it
# is none.

BEGIN {
    # Floors, the lowest first, are separated by "|". A floor has folders that do not include each other, separated by
    # ";". The rooms of a folder, the lowest first, are separated by ","; those beside each other by a blank. The two
    # public headers need base only, and all above it may include them.
    floors = split("base/simd, base | core.h render_request.h version.h format_rows.h parameter_rows.h parameter_kinds.h drawing_rows.h | scene, scene/parts, scene/camera |" \
        "input/text, input/formats, input/zip, input/files, input/json, input/images input/codecs, input/model," \
        "input/gltf input/obj input/ply input/points input/stl input/threemf, input/scene, input/mesh, input/view, input/root, input/query;" \
        "geometry | mesh, mesh/facts, mesh/features | measure | sections | raster, raster/textbook | shade/lights, shade/models, shade/eye, shade, shade/channels |" \
        "lines; effects; overlay, overlay/annotate | drawing | render/layers, render | output/bytes, output/images output/json, output | cost | request | views; schema | api", storeys, "|")
    for (i = 1; i <= floors; i++) {
        n = split(storeys[i], folders, ";")
        for (k = 1; k <= n; k++) {
            m = split(folders[k], ranks, ",")
            for (r = 1; r <= m; r++) {
                p = split(ranks[r], names, " ")
                for (q = 1; q <= p; q++) {
                    floor_of[names[q]] = i
                    folder_of[names[q]] = k
                    rank_of[names[q]] = r
                }
            }
        }
    }
    for (i = 1; i < ARGC; i++) exists[below_core(ARGV[i])] = 1
    while ((getline line < known) > 0)
        if (line !~ /^[ \t]*(#|$)/) learn(line)
}

/^[ \t]*#[ \t]*include[ \t]*["<]/ {
    quoted = $0 ~ /^[^<]*"/
    split($0, parts, /["<>]/)
    from = below_core(FILENAME)
    to = parts[2]
    sibling = from
    sub(/[^\/]*$/, "", sibling)
    if (quoted && (sibling to) in exists) to = sibling to
    else if (quoted && ("server/" to) in exists) to = "server/" to # by -Iserver
    else if (quoted && ("clients/" to) in exists) to = "clients/" to # by -Iclients
    if (to in exists) add(from, to)
    else if (quoted) fault(from " includes " to ", which is in none of these folders")
}

END {
    if (count == 0) fault("no #include was read")
    for (i = 1; i <= count; i++) judge(from_of[i], to_of[i])
    for (line in reason) {
        split(line, ends, " ")
        if (reason[line] == "") fault(line " is known, without a reason")
        if (!(line in seen)) fault(line " is known, and is not there")
        else if (misplaced(ends[1], ends[2]) == "" && !is_on_circle("all", ends[1], ends[2]))
            fault(line " is known, and is no fault")
    }
    exit faults > 0
}

function fault(text)
{
    print text
    faults++
}

function below_core(path)
{
    sub(/^core\//, "", path)
    return path
}

function learn(line,    words)
{
    split(line, words, " ")
    sub(/^[ \t]*[^ \t]+[ \t]*[^ \t]*[ \t]*/, "", line)
    reason[words[1] " " words[2]] = line
}

# Returns the room of a file: its folder below core/, the file itself if it lies in core/, "server" or "clients".
function room(file,    name)
{
    name = file
    if (name ~ /^(server|clients)\//) sub(/\/.*/, "", name)
    else sub(/\/[^\/]*$/, "", name)
    return name
}

# Returns the floor of a file. From the top: clients/, server/, the rooms of core/. 0: a room that has no floor yet.
function floor(file,    name)
{
    name = room(file)
    if (name in floor_of) return floor_of[name]
    if (name == "server") return floors + 1
    if (name == "clients") return floors + 2
    return 0
}

function module(file)
{
    sub(/\.[ch]$/, "", file)
    return file
}

# Two graphs of modules: of all lines, and of those that nobody knows as faults.
function add(from, to)
{
    if ((from " " to) in seen) return
    seen[from " " to] = 1
    from_of[++count] = from
    to_of[count] = to
    if (module(from) == module(to)) return
    follow["all", module(from)] = follow["all", module(from)] " " module(to)
    if (!((from " " to) in reason)) follow["unknown", module(from)] = follow["unknown", module(from)] " " module(to)
}

# Returns what is wrong about the floors and rooms of a line, or "".
function misplaced(from, to,    a, b)
{
    a = room(from)
    b = room(to)
    if (floor(from) == 0 || floor(to) == 0 || a == b) return ""
    if (floor(to) != floor(from)) return floor(to) > floor(from) ? "of a higher floor" : ""
    if (a !~ /\//  && a ~ /\./) return "" # the public headers
    if (folder_of[a] != folder_of[b] || rank_of[a] == rank_of[b]) return "of a room beside it"
    return rank_of[b] > rank_of[a] ? "of a higher room" : ""
}

function is_on_circle(graph, from, to)
{
    if (from == to) return 1
    if (module(from) == module(to)) return 0
    if (!((graph, module(to)) in walked)) {
        walked[graph, module(to)] = 1
        walk(graph, module(to), module(to))
    }
    return (graph, module(to), module(from)) in reached
}

function walk(graph, start, at,    next_ones, n, i)
{
    n = split(follow[graph, at], next_ones, " ")
    for (i = 1; i <= n; i++)
        if (!((graph, start, next_ones[i]) in reached)) {
            reached[graph, start, next_ones[i]] = 1
            walk(graph, start, next_ones[i])
        }
}

function judge(from, to)
{
    if (floor(from) == 0) fault(from " is in a folder that has no floor")
    if ((from " " to) in reason) return
    if (misplaced(from, to) != "") fault(from " includes " to " " misplaced(from, to))
    if (is_on_circle("unknown", from, to)) fault(from " includes " to " in a circle")
}
