# markdown.awk: turns pages of Markdown into HTML, of the subset that the manual uses: headings, paragraphs, lists, tables, code,
# quotes, links, pictures, emphasis, and the tags a, img, picture, br, sup, sub, kbd and details. Between <!-- cards --> and <!-- end of cards -->,
# each paragraph that begins with a picture begins a card of a grid.
#
#   awk -v list=LIST -v out=FOLDER -v pictures=FILE -f markdown.awk
#
# LIST has a line "= TITLE" for each section and "FILE|ADDRESS" or "FILE|ADDRESS|LABEL" for each page, in the order of the sidebar. The page goes to
# OUT/ADDRESS.html, the first to OUT/index.html. PICTURES gets a line "FILE|ADDRESS" for each picture. Addresses are relative, so that
# the manual may lie below any path. A link to a file that is no page becomes text.

# ---- text ----

function escape(s) {
    gsub(/&/, "\\&amp;", s)
    gsub(/</, "\\&lt;", s)
    gsub(/>/, "\\&gt;", s)
    return s
}
function trim(s) {
    sub(/^[ \t]+/, "", s)
    sub(/[ \t]+$/, "", s)
    return s
}
# The name of a heading as GitHub makes it, from its HTML. The second of a name gets -1.
function name_of(html, name) {
    gsub(/<[^>]*>/, "", html)
    gsub(/&[a-z]+;/, "", html)
    name = tolower(html)
    gsub(/[^a-z0-9_ -]/, "", name)
    gsub(/ /, "-", name)
    if (name in names) return name "-" names[name]++
    names[name] = 1
    return name
}

# ---- addresses ----

function folder_of(path) { return path ~ /\// ? substr(path, 1, match(path, /\/[^\/]*$/) - 1) : "." }
# a/b/../c -> a/c
function normal(path, parts, n, i, kept, result) {
    n = split(path, parts, "/")
    kept = 0
    for (i = 1; i <= n; i++) {
        if (parts[i] == "." || parts[i] == "") continue
        if (parts[i] == ".." && kept > 0) kept--
        else stack[++kept] = parts[i]
    }
    result = ""
    for (i = 1; i <= kept; i++) result = result (i > 1 ? "/" : "") stack[i]
    return result
}
function relative(address) {
    if (address == "") return up == "" ? "./" : up
    return up address
}
# The address of a link in this page; "" if it leads to a file that is not served.
function address_of(link, file, mark) {
    if (link ~ /^[a-z]+:/) return link
    mark = ""
    if (match(link, /#/)) {
        mark = substr(link, RSTART)
        link = substr(link, 1, RSTART - 1)
    }
    if (link == "") return mark
    file = normal(folder_of(source) "/" link)
    if (file in address) return relative(address[file]) mark
    return ""
}
function picture_of(link, file) {
    if (link ~ /^data:/) return link
    file = normal(folder_of(source) "/" link)
    if (!(file in picture)) {
        picture[file] = file
        sub(/^clients\/docs\//, "", picture[file])
        sub(/^clients\//, "", picture[file])
        print file "|" picture[file] >pictures
    }
    return relative(picture[file])
}

# ---- inline marks ----

function link_to(text, link, to) {
    to = address_of(link)
    if (to == "") return "<span class=\"file\" title=\"" escape(normal(folder_of(source) "/" link)) "\">" text "</span>"
    return "<a href=\"" escape(to) "\">" text "</a>"
}
# The value of an attribute of a tag.
function attribute(tag, key) {
    return match(tag, " " key "=\"[^\"]*\"") ? substr(tag, RSTART + length(key) + 3, RLENGTH - length(key) - 4) : ""
}
function tag_of(tag, width, link) {
    if (tag ~ /^<img /) {
        width = attribute(tag, "width")
        return "<img src=\"" picture_of(attribute(tag, "src")) "\"" (width == "" ? "" : " width=\"" width "\"") " alt=\"" attribute(tag, "alt") "\" loading=\"lazy\">"
    }
    if (tag ~ /^<source /)
        return "<source media=\"" attribute(tag, "media") "\" srcset=\"" picture_of(attribute(tag, "srcset")) "\">"
    if (tag ~ /^<a href=/) {
        link = address_of(attribute(tag, "href"))
        return "<a href=\"" link "\">"
    }
    return tag
}
# The end of a link's text that begins behind "[": brackets may be nested, and those in code do not count. 0: none.
function end_of_text(s, i, c, depth, is_code) {
    depth = 1
    for (i = 1; i <= length(s); i++) {
        c = substr(s, i, 1)
        if (c == "\\") i++
        else if (c == "`") is_code = !is_code
        else if (is_code) continue
        else if (c == "[") depth++
        else if (c == "]" && --depth == 0) return i
    }
    return 0
}
function inline(s, html, c, n, end, ticks, body, text, rest) {
    html = ""
    while (match(s, /[\\`!\[<>&*]/)) {
        html = html substr(s, 1, RSTART - 1)
        s = substr(s, RSTART)
        c = substr(s, 1, 1)
        if (c == "\\" && substr(s, 2, 1) ~ /[!-\/:-@\[-`{-~]/) {
            html = html escape(substr(s, 2, 1))
            s = substr(s, 3)
        } else if (c == "`") {
            match(s, /^`+/)
            ticks = substr(s, 1, RLENGTH)
            n = RLENGTH
            end = index(substr(s, n + 1), ticks)
            if (!end) {
                html = html ticks
                s = substr(s, n + 1)
                continue
            }
            body = substr(s, n + 1, end - 1)
            if (body ~ /^ .*[^ ].* $/) body = substr(body, 2, length(body) - 2)
            html = html "<code>" escape(body) "</code>"
            s = substr(s, end + 2 * n)
        } else if (c == "[" || substr(s, 1, 2) == "![") {
            n = c == "[" ? 1 : 2
            rest = substr(s, n + 1)
            end = end_of_text(rest)
            text = substr(rest, 1, end - 1)
            rest = substr(rest, end + 1)
            if (end && match(rest, /^\([^()]*(\([^()]*\)[^()]*)*\)/)) {
                body = trim(substr(rest, 2, RLENGTH - 2))
                s = substr(rest, RLENGTH + 1)
                if (n == 2) html = html "<img src=\"" picture_of(body) "\" alt=\"" escape(text) "\" loading=\"lazy\">"
                else html = html link_to(inline(text), body)
            } else {
                html = html c
                s = substr(s, 2)
            }
        } else if (c == "<" && match(s, /^<!--([^-]|-[^-])*-->/)) {
            s = substr(s, RLENGTH + 1)
        } else if (c == "<" && match(s, /^<https?:[^> ]*>/)) {
            body = escape(substr(s, 2, RLENGTH - 2))
            html = html "<a href=\"" body "\">" body "</a>"
            s = substr(s, RLENGTH + 1)
        } else if (c == "<" && match(s, /^<\/?(a|img|picture|source|br|sup|sub|kbd|details|summary|b|i)( [^>]*)?\/?>/)) {
            n = RLENGTH
            html = html tag_of(substr(s, 1, n))
            s = substr(s, n + 1)
        } else if (substr(s, 1, 2) == "**" && (end = index(substr(s, 3), "**")) > 1) {
            html = html "<strong>" inline(substr(s, 3, end - 1)) "</strong>"
            s = substr(s, end + 4)
        } else if (c == "*" && match(s, /^\*[^* ]([^*]*[^* ])?\*/)) {
            n = RLENGTH
            html = html "<em>" inline(substr(s, 2, n - 2)) "</em>"
            s = substr(s, n + 1)
        } else if (c == "&" && match(s, /^&(#[0-9]+|[a-z]+);/)) {
            n = RLENGTH
            html = html substr(s, 1, n)
            s = substr(s, n + 1)
        } else {
            html = html escape(c)
            s = substr(s, 2)
        }
    }
    return html s
}

# ---- blocks ----

function put(html) { print html >file }
function end_paragraph() {
    if (paragraph != "") put(is_tight ? inline(paragraph) : "<p>" inline(paragraph) "</p>")
    paragraph = ""
    is_tight = 0
}
# Ends lists until only those remain whose items begin before this column.
function end_lists(column) {
    end_paragraph()
    while (lists > 0 && list_column[lists] >= column) put("</li></" list_tag[lists--] ">")
}
function end_table() {
    if (in_table) put("</tbody></table></div>")
    in_table = 0
}
function end_blocks() {
    end_table()
    end_lists(0)
}
# Splits a row of a table into cells[]; a bar behind a backslash, or in code, is no border.
function split_row(row, n, i, c, is_code) {
    row = trim(row)
    sub(/^\|/, "", row)
    sub(/\|$/, "", row)
    n = 1
    cells[1] = ""
    for (i = 1; i <= length(row); i++) {
        c = substr(row, i, 1)
        if (c == "\\" && substr(row, i + 1, 1) == "|") {
            cells[n] = cells[n] (is_code ? "|" : "\\|")
            i++
            continue
        }
        if (c == "`") is_code = !is_code
        if (c == "|" && !is_code) cells[++n] = ""
        else cells[n] = cells[n] c
    }
    return n
}
function put_row(row, tag, n, i, html, cell) {
    n = split_row(row)
    html = "<tr>"
    for (i = 1; i <= n; i++) {
        cell = trim(cells[i]) == "" ? "td" : tag # an empty head would be read out
        html = html "<" cell (align[i] == "" || tag == "th" ? "" : " class=\"" align[i] "\"") ">" inline(trim(cells[i])) "</" cell ">"
    }
    put(html "</tr>")
}
function begin_table(head, border, n, i, parts) {
    end_paragraph()
    n = split_row(border)
    for (i = 1; i <= n; i++) align[i] = trim(cells[i]) ~ /:$/ ? "right" : ""
    put("<div class=\"table\" tabindex=\"0\"><table><thead>")
    put_row(head, "th")
    put("</thead><tbody>")
    in_table = 1
}
function begin_code(language) {
    end_table()
    end_paragraph()
    in_code = 1
    code = raw = ""
    code_class = language == "" ? "" : " class=\"language-" language "\""
}
# Percent-encodes a text for the part of an address behind "#" (RFC 3986).
function encoded(s, i, c, out) {
    out = ""
    for (i = 1; i <= length(s); i++) {
        c = substr(s, i, 1)
        out = out (c ~ /[A-Za-z0-9_.~:,-]/ ? c : sprintf("%%%02X", byte_of[c]))
    }
    return out
}
# True for a whole scene that refers to no files.
function is_scene(s) {
    return code_class ~ /json/ && s ~ /^[{]/ && s ~ /"(meshes|polygons)"/ && s !~ /"(asset|uri)"|"render": *false|\.\.\.|…/
}
function end_code() {
    put("<pre tabindex=\"0\"><code" code_class ">" code "</code></pre>")
    if (is_scene(raw)) put("<p class=\"open\"><a href=\"" relative("../") "#" encoded(raw) "\">Draw and change it in the browser</a></p>")
    in_code = 0
}
function heading(line, level, text) {
    end_blocks()
    match(line, /^#+/)
    level = RLENGTH
    text = inline(trim(substr(line, level + 1)))
    put("<h" level " id=\"" name_of(text) "\">" text "</h" level ">")
}
function item(line, column, tag, start) {
    end_table()
    match(line, /^ */)
    column = RLENGTH
    line = substr(line, column + 1)
    tag = line ~ /^[0-9]/ ? "ol" : "ul"
    end_lists(column + 1)
    if (lists > 0 && list_column[lists] == column && list_tag[lists] == tag) put("</li><li>")
    else {
        end_lists(column)
        start = tag == "ol" && line + 0 != 1 ? " start=\"" (line + 0) "\"" : ""
        put("<" tag start "><li>")
        list_column[++lists] = column
        list_tag[lists] = tag
    }
    match(line, /^([-*]|[0-9]+\.) */)
    list_text[lists] = column + RLENGTH
    paragraph = substr(line, RLENGTH + 1)
    is_tight = 1
}
# Ends a card, and begins a grid of cards, a card or what follows the grid.
function card(html) {
    end_blocks()
    put((in_card ? "</div>" : "") html)
    in_card = html ~ /"card"/
}
function take(line, column) {
    if (in_code == 1) { # fenced
        for (column = 0; column < fence && line ~ /^ /; column++) line = substr(line, 2)
        if (line ~ /^ *```+ *$/) end_code()
        else {
            code = code (code == "" ? "" : "\n") escape(line)
            raw = raw line "\n"
        }
        return
    }
    if (in_code == 2) { # indented
        if (line ~ /^    / || line ~ /^ *$/) {
            blank = line ~ /^ *$/ ? blank "\n" : ""
            if (blank == "") code = code (code == "" ? "" : "\n" waiting) escape(substr(line, 5))
            waiting = blank
            return
        }
        end_code()
    }
    if (line ~ /^ *```/) {
        match(line, /^ */)
        fence = RLENGTH
        if (fence == 0) end_blocks()
        sub(/^ *```+ */, "", line)
        sub(/ .*/, "", line)
        begin_code(line)
        return
    }
    if (line ~ /^ *$/) {
        end_table()
        end_paragraph()
        was_empty = 1
        return
    }
    if (line ~ /^<!-- (end of )?cards -->$/) {
        in_cards = line !~ /end/
        card(in_cards ? "<div class=\"cards\">" : "</div>")
        return
    }
    if (in_cards && paragraph == "" && line ~ /^<(img|picture)/) card("<div class=\"card\">")
    match(line, /^ */)
    column = RLENGTH
    if (line ~ /^#+ /) heading(line)
    else if (line ~ /^ *\|/) {
        if (in_table) put_row(line, "td")
        else if (held != "") {
            begin_table(held, line)
            held = ""
        } else {
            if (column == 0) end_blocks()
            end_paragraph()
            held = line
        }
    } else if (line ~ /^ *([-*]|[0-9]+\.) +[^ ]/ && (paragraph == "" || lists > 0 || line ~ /^ *[-*]/)) item(line)
    else if (line ~ /^(---+|\*\*\*+) *$/) {
        end_blocks()
        put("<hr>")
    } else if (was_empty && column >= 4 && lists == 0) {
        begin_code("")
        in_code = 2
        code = escape(substr(line, 5))
        waiting = blank = ""
    } else {
        end_table()
        if (was_empty && lists > 0) end_lists(column)
        if (line ~ /^> ?/) {
            if (!in_quote) {
                end_blocks()
                put("<blockquote>")
                in_quote = 1
            }
            sub(/^> ?/, "", line)
        }
        paragraph = paragraph (paragraph == "" ? "" : " ") trim(line)
    }
    if (in_quote && line == "") in_quote = 0
    was_empty = 0
}

# ---- pages ----

function title_of(path, line, found) {
    while ((getline line <path) > 0)
        if (line ~ /^# /) {
            found = substr(line, 3)
            break
        }
    close(path)
    gsub(/`/, "", found)
    return found
}
function put_contents(current, i) {
    put("<nav id=\"contents\" aria-label=\"Pages of the manual\">")
    put("<p><a href=\"" relative("../") "\">Draw in the browser</a></p>")
    for (i = 1; i <= count; i++) {
        if (kind[i] == "=") put((i > 1 ? "</ul>" : "") "<h2>" escape(line_of[i]) "</h2><ul>")
        else put("<li><a href=\"" relative(address[line_of[i]]) "\"" (line_of[i] == current ? " aria-current=\"page\"" : "") ">" escape(label[line_of[i]]) "</a></li>")
    }
    put("</ul></nav>")
}
function put_neighbours(i, before, after) {
    for (before = i - 1; before > 0 && kind[before] == "="; before--);
    for (after = i + 1; after <= count && kind[after] == "="; after++);
    put("<p class=\"neighbours\">")
    if (before > 0) put("<a rel=\"prev\" href=\"" relative(address[line_of[before]]) "\">← " escape(label[line_of[before]]) "</a>")
    if (after <= count) put("<a rel=\"next\" href=\"" relative(address[line_of[after]]) "\">" escape(label[line_of[after]]) " →</a>")
    put("</p>")
}
function make_page(i, line) {
    source = line_of[i]
    up = address[source]
    gsub(/[^\/]+\//, "../", up)
    sub(/[^\/]*$/, "", up)
    file = out "/" (address[source] == "" ? "index" : address[source]) ".html"
    delete names
    put("<!doctype html>")
    put("<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">")
    put("<title>" escape(title[source]) (title[source] == "zraster" ? "" : " – zraster") "</title><link rel=\"stylesheet\" href=\"" relative("manual.css") "\">" icon "</head>")
    put("<body><header><a class=\"home\" href=\"" relative("") "\">zraster manual</a><a class=\"to-contents\" href=\"#contents\">Contents</a></header><div class=\"page\"><main>")
    paragraph = held = ""
    lists = in_table = in_code = in_quote = is_tight = 0
    was_empty = 1
    while ((getline line <source) > 0) take(line)
    close(source)
    if (in_code) end_code()
    end_blocks()
    put_neighbours(i)
    put("</main>")
    put_contents(source)
    put("</div></body></html>")
    close(file)
}
BEGIN {
    for (number = 1; number < 256; number++) byte_of[sprintf("%c", number)] = number
    printf "" >pictures
    while ((getline line <"server/page/index.html") > 0)
        if (line ~ /<link rel="icon"/) icon = trim(line)
    while ((getline line <list) > 0) {
        if (line ~ /^= /) {
            kind[++count] = "="
            line_of[count] = substr(line, 3)
            continue
        }
        split(line, fields, "|")
        kind[++count] = "page"
        line_of[count] = fields[1]
        address[fields[1]] = fields[2]
        title[fields[1]] = title_of(fields[1])
        label[fields[1]] = fields[3] == "" ? title[fields[1]] : fields[3]
    }
    for (number = 1; number <= count; number++)
        if (kind[number] == "page") make_page(number)
}
