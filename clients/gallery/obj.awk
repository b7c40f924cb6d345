# obj.awk: lines NAME|MEMBERS, with the members of a mesh as models.awk prints them, become the objects of an OBJ.
function put_all(list, letter, add, count, items, i, k, numbers, n) {
    count = split(list, items, /\], *\[/)
    for (i = 1; i <= count; i++) {
        n = split(items[i], numbers, /, */)
        printf "%s", letter
        for (k = 1; k <= n; k++) printf " %s", letter == "f" ? numbers[k] + add : numbers[k]
        printf "\n"
    }
    return count
}
function list_of(key) { return match($0, "\"" key "\": \\[\\[[^\"]*\\]\\]") ? substr($0, RSTART + length(key) + 6, RLENGTH - length(key) - 8) : "" }
{
    print "o " substr($0, 1, index($0, "|") - 1)
    done = put_all(list_of("positions"), "v", 0)
    put_all(list_of("faces"), "f", base + 1)
    base += done
}
