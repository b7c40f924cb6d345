# models.awk -v model=pawn|ball: a body of revolution as the members of a mesh in JSON, counter-clockwise seen from
# outside. Prints "positions": [...], "faces": [...].
function put(r, y) { radius[++rings] = r; height[rings] = y }
BEGIN {
    pi = 3.14159265358979
    if (model == "ball") {
        sides = 48
        for (i = 0; i <= 24; i++) put(sin(pi * i / 24), 1 - cos(pi * i / 24))
    } else {
        sides = 64
        split("0,0 1.1,0 1.1,0.25 0.95,0.4 0.95,0.55 0.62,0.85 0.42,1.4 0.36,1.9 0.62,2.0 0.62,2.1 0.34,2.2", p, " ")
        for (i = 1; i <= 11; i++) { split(p[i], q, ","); put(q[1], q[2]) }
        for (i = 6; i <= 24; i++) put(0.52 * sin(pi * i / 24), 2.62 - 0.52 * cos(pi * i / 24))
    }
    printf "\"positions\": ["
    for (i = 1; i <= rings; i++)
        for (k = 0; k < sides; k++)
            printf "%s[%.4f,%.4f,%.4f]", (i + k == 1 ? "" : ","), radius[i] * cos(2 * pi * k / sides), height[i],
                radius[i] * sin(2 * pi * k / sides)
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
}
