# walk.awk -v figure=NAME: the drawings of how-it-works.md, as scenes. Unit: a pixel of the window that a drawing shows, y up.
# The triangles A and B are those of the page's scene, placed by its camera.
function poly(color, z, corners, n, i, p, q, text) {
    n = split(corners, p, " ")
    for (i = 1; i <= n; i++) { split(p[i], q, ","); text = text (i > 1 ? ", " : "") "[" q[1] ", " q[2] ", " z "]" }
    polygons = polygons (polygons ? ",\n    " : "") "{\"vertices\": [" text "], \"color\": \"" color "\"" more "}"
}
function box(color, z, x0, y0, x1, y1) { poly(color, z, x0 "," y0 " " x1 "," y0 " " x1 "," y1 " " x0 "," y1) }
function line(color, z, x0, y0, x1, y1) {
    places = places (places ? ", " : "") "[" x0 ", " y0 ", " z "], [" x1 ", " y1 ", " z "]"
    inks = inks (inks ? ", " : "") "\"" color "\", \"" color "\""
    pairs = pairs (pairs ? ", " : "") "[" (line_ends + 0) ", " (line_ends + 1) "]"
    line_ends += 2
}
function ring(color, z, corners, n, i, p, a, b) {
    n = split(corners, p, " ")
    for (i = 1; i <= n; i++) { split(p[i], a, ","); split(p[i % n + 1], b, ","); line(color, z, a[1], a[2], b[1], b[2]) }
}
function dot(color, z, x, y) {
    dots = dots (dots ? ", " : "") "[" x ", " y ", " z "]"
    dot_inks = dot_inks (dot_inks ? ", " : "") "\"" color "\""
    dot_list = dot_list (dot_count ? ", " : "") dot_count++
}
function grid(color, z, x0, y0, x1, y1, step, i) {
    for (i = x0; i <= x1; i += step) line(color, z, i, y0, i, y1)
    for (i = y0; i <= y1; i += step) line(color, z, x0, i, x1, i)
}
# A picture of x0 .. x1, y0 .. y1, on a sheet of that size, with `image` on it, pixel by pixel.
function print_scene(x0, y0, x1, y1, scale, image, dot_size) {
    printf "{\"window\": {\"width\": %d, \"height\": %d}, \"shading\": \"unlit\", \"samples\": 16, \"alphaMode\": \"BLEND\", \"lineWidth\": %s,\n", \
        (x1 - x0) * scale, (y1 - y0) * scale, (thick ? thick : 1)
    printf " \"view\": {\"eye\": [%s, %s, 50], \"target\": [%s, %s, 0], \"orthographic\": {\"xmag\": %s, \"ymag\": %s}, \"znear\": 1, \"zfar\": 100},\n", \
        (x0 + x1) / 2, (y0 + y1) / 2, (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2, (y1 - y0) / 2
    if (image)
        printf " \"materials\": [{\"name\": \"image\", \"baseColorTexture\": {\"asset\": \"%s\", \"sampler\": {\"magFilter\": \"nearest\", \"minFilter\": \"nearest\"}}}],\n", image
    printf " \"meshes\": [{\"name\": \"sheet\", %s\"positions\": [[%s, %s, -9], [%s, %s, -9], [%s, %s, -9], [%s, %s, -9]], \"texcoords\": [[0, 1], [1, 1], [1, 0], [0, 0]], \"faces\": [[0, 1, 2, 3]], \"colors\": [\"white\", \"white\", \"white\", \"white\"]}", \
        (image ? "\"material\": \"image\", " : ""), x0, y0, x1, y0, x1, y1, x0, y1
    if (line_ends) printf ",\n  {\"name\": \"lines\", \"positions\": [%s], \"colors\": [%s], \"lines\": [%s]}", places, inks, pairs
    if (dot_count)
        printf ",\n  {\"name\": \"dots\", \"pointSize\": %s, \"pointShape\": \"round\", \"positions\": [%s], \"colors\": [%s], \"points\": [%s]}", dot_size, dots, dot_inks, dot_list
    printf "]%s}\n", (polygons ? ",\n \"polygons\": [" polygons "]" : "")
}
# The window position of a point: the camera at the origin looks along -z; half of the window's height is 0.5 at a distance of 1.
function project(i, x, y, z) { px[i] = 12 + 16 * x / -z; py[i] = 8 + 16 * y / -z }
function corner(i) { return px[i] "," py[i] }
function edge(i, k, x, y) { return (px[k] - px[i]) * (y - py[i]) - (py[k] - py[i]) * (x - px[i]) }
function in_a(x, y) { return edge(1, 2, x, y) > 0 && edge(2, 3, x, y) > 0 && edge(3, 1, x, y) > 0 }
# The part of a large square where the edge function i -> k is positive.
function half(color, z, i, k, dx, dy) {
    dx = (px[k] - px[i]) * 9; dy = (py[k] - py[i]) * 9
    poly(color, z, (px[i] - dx) "," (py[i] - dy) " " (px[i] + dx) "," (py[i] + dy) " " (px[i] + dx - dy) "," (py[i] + dy + dx) " " (px[i] - dx - dy) "," (py[i] - dy + dx))
}
function crossing(i, k, y) { return px[i] + (px[k] - px[i]) * (y - py[i]) / (py[k] - py[i]) }
function low(a, b) { return a < b ? a : b }
function high(a, b) { return a > b ? a : b }
# Both ends of triangle t (corners t .. t + 2) on the row y; 0 if there are none.
function span(t, y, i, k, x) {
    from = 1e9; to = -1e9
    for (i = 0; i < 3; i++) {
        k = (i + 1) % 3
        if ((py[t + i] <= y) == (py[t + k] <= y)) continue
        x = crossing(t + i, t + k, y)
        from = low(from, x); to = high(to, x)
    }
    return from < to
}
BEGIN {
    line_ends = 0
    project(1, -2.2, -1.5, -4); project(2, 4.7, -1.5, -8); project(3, -0.4, 1.2, -3)
    project(4, -2, 0.5, -3.2); project(5, 1, -1.7, -4.2); project(6, 4.5, 2.2, -7)
    a = corner(1) " " corner(2) " " corner(3); b = corner(4) " " corner(5) " " corner(6)
    ink = "#1f2a36"; pale = "#d5dbe2"; red = "#cc3333"; blue = "#3366cc"; green = "#33aa55"; amber = "#e0a030"
    thick = 1.5
    if (figure == "large") print_scene(0, 0, 24, 16, 16, "walk.png")
    if (figure == "owner") { ring(ink, 1, a); ring(ink, 1, b); print_scene(0, 0, 24, 16, 16, "walk-ids.png") }
    if (figure == "depth") { ring("white", 1, a); ring("white", 1, b); print_scene(0, 0, 24, 16, 16, "walk-depths.png") }
    if (figure == "diff") print_scene(0, 0, 96, 96, 2, "diff.png")
    if (figure == "samples") print_scene(0, 0, 24, 16, 16, "walk-fine.png")
    if (figure == "average") print_scene(0, 0, 24, 16, 16, "walk-mean.png")
    if (figure == "clip") {
        # Clip space over w: the view volume is -1 .. 1. The corner at 1.7 is cut off by the plane x = w; the rest is a fan.
        box("#eef2f6", 0, -1, -1, 1, 1); ring(ink, 3, "-1,-1 1,-1 1,1 -1,1")
        poly("#cc333340", 1, "1,-0.412 1.7,-0.3 1,0.225")
        poly(red, 1, "-0.8,-0.7 1,-0.412 1,0.225 0.1,0.9"); line("white", 2, -0.8, -0.7, 1, 0.225)
        print_scene(-1.5, -1.25, 1.9, 1.25, 110)
    }
    if (figure == "snap") {
        grid(pale, 1, 0, 0, 16, 16, 1); line(ink, 2, 8, 0, 8, 16); line(ink, 2, 0, 8, 16, 8)
        poly("#3366cc30", 0, "11.38,5.71 30,14 4,30"); dot(blue, 4, 11.38, 5.71); dot(red, 5, 11, 6)
        poly("#cc333330", 0, "11,6 30,14 4,30")
        print_scene(0, 0, 16, 16, 16, "", 9)
    }
    if (figure == "tiles") {
        box("#e0a03060", 1, 2, 1, 3, 2); thick = 1
        grid(ink, 2, 0, 0, 5, 4, 1); print_scene(0, 0, 5, 4, 64, "walk-tiled.png")
    }
    if (figure == "edges") {
        half("#cc333338", 1, 1, 2); half("#33aa5538", 2, 2, 3); half("#3366cc38", 3, 3, 1)
        for (i = 0; i < 24; i++) for (k = 0; k < 16; k++) dot(in_a(i + 0.5, k + 0.5) ? ink : "#b8c2cc", 8, i + 0.5, k + 0.5)
        print_scene(0, 0, 24, 16, 16, "", 6)
    }
    if (figure == "halfspace") {
        # A tile of 64 x 64 with its blocks of 16 x 8.
        project(1, 0, 0, -1); px[1] = 4.2; py[1] = 5.7; px[2] = 61.4; py[2] = 20.3; px[3] = 20.1; py[3] = 59.6
        for (i = 0; i < 64; i += 16) for (k = 0; k < 64; k += 8) {
            inside = outside = 0
            for (x = 0; x < 16; x++) for (y = 0; y < 8; y++) if (in_a(i + x + 0.5, k + y + 0.5)) inside++; else outside++
            if (!outside) box("#33aa5580", 1, i, k, i + 16, k + 8)
            else if (inside) box("#e0a03080", 1, i, k, i + 16, k + 8)
        }
        ring(ink, 3, corner(1) " " corner(2) " " corner(3))
        for (i = 0; i <= 64; i += 16) line("#8894a0", 2, i, 0, i, 64)
        for (k = 0; k <= 64; k += 8) line("#8894a0", 2, 0, k, 64, k)
        print_scene(0, 0, 64, 64, 4)
    }
    if (figure == "edgelist") {
        for (k = 0; k < 16; k++) if (span(1, k + 0.5)) {
            for (i = 0; i < 24; i++) if (i + 0.5 >= from && i + 0.5 < to) box("#cc333370", 1, i, k, i + 1, k + 1)
            dot(ink, 8, from, k + 0.5); dot(ink, 8, to, k + 0.5); line("#8894a0", 2, 0, k + 0.5, 24, k + 0.5)
        }
        ring(ink, 3, a); print_scene(0, 0, 24, 16, 16, "", 7)
    }
    if (figure == "trapezoid") {
        span(1, py[2])
        poly("#cc333390", 1, corner(1) " " corner(2) " " (crossing(3, 1, py[2])) "," py[2])
        poly("#3366cc90", 1, corner(3) " " (crossing(3, 1, py[2])) "," py[2] " " corner(2))
        line(ink, 2, 0, py[2], 24, py[2]); ring(ink, 3, a); print_scene(0, 0, 24, 16, 16)
    }
    if (figure == "scanline") {
        k = 10; poly("#cc333328", 0, a); poly("#e0a03028", 0.5, b); ring(ink, 3, a); ring(ink, 3, b)
        line(ink, 3, 0, k, 24, k); line(ink, 3, 0, k + 1, 24, k + 1)
        span(1, k + 0.5); a0 = from; a1 = to; span(4, k + 0.5); b0 = from; b1 = to
        for (i = 0; i < 24; i++) {
            x = i + 0.5; in1 = x >= a0 && x < a1; in2 = x >= b0 && x < b1
            if (in1 && in2) box("#805080", 2, i, k, i + 1, k + 1)
            else if (in1) box(red, 2, i, k, i + 1, k + 1)
            else if (in2) box(amber, 2, i, k, i + 1, k + 1)
        }
        dot(ink, 8, a0, k + 0.5); dot(ink, 8, a1, k + 0.5); dot(ink, 8, b0, k + 0.5); dot(ink, 8, b1, k + 0.5)
        print_scene(0, 0, 24, 16, 16, "", 8)
    }
}
