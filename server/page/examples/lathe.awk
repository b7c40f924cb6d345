# lathe.awk PROFILE: turns a profile about the y axis into a closed OBJ mesh. A line is "radius height", from the bottom to
# the top, with "c" behind it for a corner. Between corners the profile is a smooth curve (Catmull-Rom).
/^#/ || !NF { next }
{ r[n] = $1 + 0; y[n] = $2 + 0; corner[n++] = $3 == "c" }
function curve(a, b, c, d, t) { return b + t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))) / 2 }
END {
    sides = 48
    rows = 0
    for (i = 0; i < n - 1; i++) {
        before = corner[i] || i == 0 ? i : i - 1
        after = corner[i + 1] || i + 2 == n ? i + 1 : i + 2
        steps = corner[i] && corner[i + 1] ? 1 : 3
        for (s = 0; s < steps; s++) {
            radius[rows] = curve(r[before], r[i], r[i + 1], r[after], s / steps)
            height[rows++] = curve(y[before], y[i], y[i + 1], y[after], s / steps)
        }
    }
    radius[rows] = r[n - 1]
    height[rows++] = y[n - 1]
    print "# made by lathe.awk"
    for (i = 0; i < rows; i++) {
        ends = radius[i] < 1e-6
        first[i] = count + 1
        for (k = 0; k < (ends ? 1 : sides); k++) {
            angle = 6.283185307179586 * k / sides
            printf "v %.4f %.4f %.4f\n", radius[i] * sin(angle), height[i], radius[i] * cos(angle)
            count++
        }
        single[i] = ends
    }
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
