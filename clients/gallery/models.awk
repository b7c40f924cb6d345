# models.awk -v model=pawn|ball|coarse|gear|housing|waves: a body of revolution as the members of a mesh in JSON, counter-clockwise
# seen from outside. Rings of points follow its outline from the bottom upwards; those of a gear have teeth. Waves are a grid
# of heights. Prints "positions": [...], "faces": [...], or "heights": [...]. A second word, such as "ball turbo", is a
# colormap: of heights, or of numbers that go round the body; "gear faces turbo": of faces.
# model=base|axle|bearing|wheel|washer|cap: bodies of revolution that fit together, each in its place.
# model=cloud: points on a knotted tube, those that a lamp shines on brighter, with "colors", "points" and "pointSize".
# model=ring: a torus with "normals" and "texcoords", on which an image lies several times.
function put(r, y, deep) { radius[++rings] = r; height[rings] = y; depth[rings] = deep }
function put_all(outline, count, i, p, q) {
    count = split(outline, p, " ")
    for (i = 1; i <= count; i++) { split(p[i], q, ","); put(q[1], q[2], q[3]) }
}
function put_ball(r, y, first, last, i) { for (i = first; i <= last; i++) put(r * sin(pi * i / last), y - r * cos(pi * i / last)) }
function channel(t, phase, light) { return light * (0.55 + 0.45 * cos(2 * pi * (t + phase))) }
function knot(t, axis) {
    if (axis == 0) return (2 + cos(3 * t)) * cos(2 * t)
    return axis == 1 ? 1.1 * sin(3 * t) : (2 + cos(3 * t)) * sin(2 * t)
}
# A point around the knot's way at t, off it by an angle: across the way, as far to the side as up.
function put_points(count, i, k, t, angle, c, d, n, side, up, length_of, light) {
    for (i = 0; i < count; i++) {
        t = 2 * pi * i / count; angle = 2.399963 * i
        for (k = 0; k < 3; k++) { c[k] = knot(t, k); d[k] = (knot(t + 0.001, k) - c[k]) / 0.001 }
        length_of = sqrt(d[0] * d[0] + d[2] * d[2])
        side[0] = -d[2] / length_of; side[1] = 0; side[2] = d[0] / length_of
        up[0] = d[1] * side[2]; up[1] = d[2] * side[0] - d[0] * side[2]; up[2] = -d[1] * side[0]
        length_of = sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2])
        for (k = 0; k < 3; k++) n[k] = cos(angle) * side[k] + sin(angle) * up[k] / length_of
        light = 0.5 * n[0] - 0.1 * n[1] + 0.6 * n[2]
        light = 0.25 + (n[1] + light > 0 ? 0.6 * (n[1] + light) : 0)
        if (light > 1) light = 1
        places = places sprintf("%s[%.4f,%.4f,%.4f]", (i ? "," : ""), c[0] + 0.62 * n[0], c[1] + 0.62 * n[1], c[2] + 0.62 * n[2])
        colors = colors sprintf("%s[%.3f,%.3f,%.3f]", (i ? "," : ""), channel(t / (2 * pi), 0, light),
            channel(t / (2 * pi), 0.33, light), channel(t / (2 * pi), 0.67, light))
        numbers = numbers (i ? "," : "") i
    }
    printf "\"positions\": [%s], \"colors\": [%s], \"points\": [%s], \"pointSize\": 2", places, colors, numbers
}
function wave(x, y, r) { r = sqrt(x * x + y * y) + 0.001; return 3 * sin(2.2 * r) / (1 + r) + 0.3 * x }
function print_waves(cells, x, y) {
    printf "\"heights\": {\"x\": [-4, 4], \"y\": [-4, 4], \"values\": ["
    for (y = 0; y <= cells; y++)
        for (x = 0; x <= cells; x++)
            printf "%s%.4f%s", (x ? "," : y ? ",[" : "["), wave(8 * x / cells - 4, 8 * y / cells - 4), (x == cells ? "]" : "")
    printf "]}"
}
function print_scalars(of_faces, i, k) {
    printf ", \"scalars\": ["
    for (i = 1; i <= rings - of_faces; i++)
        for (k = 0; k < sides; k++)
            printf "%s%.4f", (i + k == 1 ? "" : ","), sin(2 * pi * (k + of_faces / 2) / sides * 3) + height[i]
    printf "]"
}
function at(ring, k) { return radius[ring] - (k % 4 == 0 || k % 4 == 3 ? depth[ring] : 0) }
# The corners of a seam are there twice, for u and v go on across it.
function put_ring(around, across, i, k, t, p, r, places, normals, texcoords, faces, n, a) {
    for (i = 0; i <= around; i++)
        for (k = 0; k <= across; k++) {
            t = 2 * pi * i / around; p = 2 * pi * k / across; r = 1 + 0.45 * cos(p)
            places = places sprintf("%s[%.4f,%.4f,%.4f]", (i + k ? "," : ""), r * cos(t), 0.45 + 0.45 * sin(p), -r * sin(t))
            normals = normals sprintf("%s[%.4f,%.4f,%.4f]", (i + k ? "," : ""), cos(p) * cos(t), sin(p), -cos(p) * sin(t))
            texcoords = texcoords sprintf("%s[%.4f,%.4f]", (i + k ? "," : ""), 6 * i / around, 3 - 3 * k / across)
            if (i == around || k == across) continue
            a = i * (across + 1) + k
            faces = faces sprintf("%s[%d,%d,%d,%d]", (n++ ? "," : ""), a, a + across + 1, a + across + 2, a + 1)
        }
    printf "\"positions\": [%s], \"normals\": [%s], \"texcoords\": [%s], \"faces\": [%s]", places, normals, texcoords, faces
}
BEGIN {
    pi = 3.14159265358979
    words = split(model, word, " ")
    model = word[1]
    if (words > 1) map = ", \"colormap\": \"" word[words] "\""
    if (model == "waves") {
        print_waves(56)
        printf "%s", map
        exit
    }
    if (model == "cloud") { put_points(9000); exit }
    if (model == "ring") { put_ring(96, 32); exit }
    sides = model == "coarse" ? 12 : model == "pawn" ? 64 : 48
    if (model == "ball") put_ball(1, 1, 0, 24)
    if (model == "coarse") put_all("0,0 0.8,0 1,0.25 1,0.75 0.6,1.1 0.6,1.5 0,1.5")
    if (model == "gear") put_all("0.36,0 1.2,0,0.24 1.2,0.45,0.24 0.72,0.45 0.72,0.85 0.64,0.93 0.36,0.93 0.36,0")
    if (model == "base") put_all("0.5,0 1.6,0 1.6,0.25 0.85,0.35 0.85,0.9 0.5,0.9 0.5,0")
    if (model == "axle") put_all("0,-0.3 0.48,-0.3 0.48,0.85 0.34,0.9 0.34,2.85 0.28,2.95 0,2.95")
    if (model == "bearing") put_all("0.36,0.92 0.78,0.92 0.78,1.17 0.36,1.17 0.36,0.92")
    if (model == "wheel") put_all("0.36,1.2 1.2,1.2,0.24 1.2,1.65,0.24 0.72,1.65 0.72,2.05 0.64,2.13 0.36,2.13 0.36,1.2")
    if (model == "washer") put_all("0.36,2.15 0.72,2.15 0.72,2.25 0.36,2.25 0.36,2.15")
    if (model == "cap") put_all("0.36,2.27 0.62,2.27 0.62,2.6 0.5,2.75 0.36,2.75 0.36,2.27")
    if (model == "housing") put_all("0.45,0 1.45,0 1.45,0.28 0.95,0.28 0.95,1.15 1.1,1.25 1.1,1.5 0.8,1.5 0.8,1 0.62,1 0.62,0.78 0.7,0.78 0.7,0.55 0.62,0.55 0.62,0.3 0.45,0.3 0.45,0")
    if (model == "pawn") {
        put_all("0,0 1.1,0 1.1,0.25 0.95,0.4 0.95,0.55 0.62,0.85 0.42,1.4 0.36,1.9 0.62,2.0 0.62,2.1 0.34,2.2")
        put_ball(0.52, 2.62, 6, 24)
    }
    printf "\"positions\": ["
    for (i = 1; i <= rings; i++)
        for (k = 0; k < sides; k++)
            printf "%s[%.4f,%.4f,%.4f]", (i + k == 1 ? "" : ","), at(i, k) * cos(2 * pi * k / sides), height[i],
                at(i, k) * sin(2 * pi * k / sides)
    printf "], \"faces\": ["
    for (i = 1; i < rings; i++)
        for (k = 0; k < sides; k++) {
            a = (i - 1) * sides + k; b = (i - 1) * sides + (k + 1) % sides
            printf "%s[", (n++ ? "," : "")
            if (radius[i] < 1e-6) printf "%d,%d,%d]", a, a + sides, b + sides
            else if (radius[i + 1] < 1e-6) printf "%d,%d,%d]", a, a + sides, b
            else printf "%d,%d,%d,%d]", a, a + sides, b + sides, b
        }
    printf "]"
    if (words > 1) print_scalars(word[2] == "faces")
    printf "%s", map
}
