# lathe.awk PROFILE: turns a profile about the y axis into a closed OBJ mesh. A line is "radius height", from the bottom to
# the top, with "c" behind it for a corner. Between corners the profile is a smooth curve (Catmull-Rom). A profile that ends
# at its first point makes a ring. "sides 6" makes a prism of it. "teeth 24 2.5" cuts 24 teeth, 2.5 deep, into the corners that
# have "t" instead of "c".
BEGIN { n = 0; sides = 48 }
/^#/ || !NF { next }
$1 == "sides" { sides = $2; next }
$1 == "teeth" { sides = 4 * $2; deep = $3; next }
{ tooth[n] = $3 == "t"; $3 = tooth[n] ? "c" : $3 }
{ r[n] = $1 + 0; y[n] = $2 + 0; corner[n++] = $3 == "c" }
function curve(a, b, c, d, t) { return b + t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))) / 2 }
END {
    rows = 0
    for (i = 0; i < n - 1; i++) {
        before = corner[i] || i == 0 ? i : i - 1
        after = corner[i + 1] || i + 2 == n ? i + 1 : i + 2
        steps = corner[i] && corner[i + 1] ? 1 : 3
        for (s = 0; s < steps; s++) {
            cut[rows] = tooth[i] && !s ? deep : 0
            radius[rows] = curve(r[before], r[i], r[i + 1], r[after], s / steps)
            height[rows++] = curve(y[before], y[i], y[i + 1], y[after], s / steps)
        }
    }
    cut[rows] = tooth[n - 1] ? deep : 0
    radius[rows] = r[n - 1]
    height[rows++] = y[n - 1]
    print "# made by lathe.awk"
    ring = r[0] == r[n - 1] && y[0] == y[n - 1]
    for (i = 0; i < rows - ring; i++) {
        ends = radius[i] < 1e-6
        first[i] = count + 1
        for (k = 0; k < (ends ? 1 : sides); k++) {
            angle = 6.283185307179586 * k / sides
            far = radius[i] - (k % 4 > 1 ? cut[i] : 0)
            printf "v %.4f %.4f %.4f\n", far * sin(angle), height[i], far * cos(angle)
            count++
        }
        single[i] = ends
    }
    first[rows - 1] = ring ? first[0] : first[rows - 1]
    for (i = 0; i < rows - 1; i++)
        for (k = 0; k < sides; k++) {
            a = first[i] + (single[i] ? 0 : k)
            b = first[i] + (single[i] ? 0 : (k + 1) % sides)
            c = first[i + 1] + (single[i + 1] ? 0 : (k + 1) % sides)
            d = first[i + 1] + (single[i + 1] ? 0 : k)
            if (single[i] && single[i + 1]) continue # from the outside to the inside of a shell
            if (single[i]) print "f", a, c, d
            else if (single[i + 1]) print "f", a, b, c
            else print "f", a, b, c, d
        }
}
