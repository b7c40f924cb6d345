# rows.awk - counts the compilations of `make all` that a change of headers causes, by the #include lines.
#
#   awk -v changed="core/scene/picture.h core/scene/picture_keys.h" -f rows.awk core/base/vec.c ...     with all *.c and *.h
#
# Prints the number. A kernel is compiled once per instruction set, of which there are `sets`, 4 if not given. A changed
# file that is not among the arguments is a fault, with status 1.

BEGIN {
    if (!sets) sets = 4
    for (i = 1; i < ARGC; i++) exists[ARGV[i]] = 1
    folders = split("core/ server/ clients/", folder, " ")
}

/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, parts, "\"")
    to = found(parts[2])
    if (to != "") includers[to] = includers[to] " " FILENAME
}

END {
    n = split(changed, files, " ")
    for (i = 1; i <= n; i++) {
        if (!(files[i] in exists)) {
            print files[i] " is not there"
            exit 1
        }
        reach(files[i])
    }
    print compiled + 0
}

# The file that an #include of FILENAME names; "": none of these.
function found(name,    path, i)
{
    path = FILENAME
    sub(/[^\/]*$/, "", path)
    if ((path name) in exists) return path name
    for (i = 1; i <= folders; i++)
        if ((folder[i] name) in exists) return folder[i] name
    return ""
}

function reach(file,    next_ones, n, i)
{
    if (file in reached) return
    reached[file] = 1
    if (file ~ /\.c$/) compiled += file ~ /_kernel\.c$/ ? sets : 1
    n = split(includers[file], next_ones, " ")
    for (i = 1; i <= n; i++) reach(next_ones[i])
}
