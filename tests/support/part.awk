# part.awk: prints a solid part as STL, in millimetres: a plate of 90 x 60 x 8 with six round holes.
function facet(x0, y0, z0, x1, y1, z1, x2, y2, z2) {
    printf "facet normal 0 0 0\nouter loop\nvertex %.4f %.4f %.4f\nvertex %.4f %.4f %.4f\nvertex %.4f %.4f %.4f\nendloop\nendfacet\n",
        x0, y0, z0, x1, y1, z1, x2, y2, z2
}
function size(x) { return x < 0 ? -x : x }
# Counter-clockwise seen from outside; a is to the left of b for a viewer outside who has up above.
function wall(ax, ay, bx, by) {
    facet(ax, ay, 0, bx, by, 0, bx, by, high)
    facet(ax, ay, 0, bx, by, high, ax, ay, high)
}
# A square with a hole, whose sides are walls if they are sides of the plate.
function tile(i, k, n, x, y, ex, ey, fx, fy, hx, hy, gx, gy, a, b, m) {
    x = (i + 0.5) * side; y = (k + 0.5) * side
    for (n = 0; n < steps; n++) {
        a = 2 * pi * n / steps; b = 2 * pi * (n + 1) / steps
        m = size(cos(a)) > size(sin(a)) ? size(cos(a)) : size(sin(a))
        ex = x + cos(a) / m * side / 2; ey = y + sin(a) / m * side / 2
        m = size(cos(b)) > size(sin(b)) ? size(cos(b)) : size(sin(b))
        fx = x + cos(b) / m * side / 2; fy = y + sin(b) / m * side / 2
        hx = x + cos(a) * hole; hy = y + sin(a) * hole
        gx = x + cos(b) * hole; gy = y + sin(b) * hole
        facet(hx, hy, high, ex, ey, high, fx, fy, high)
        facet(hx, hy, high, fx, fy, high, gx, gy, high)
        facet(hx, hy, 0, fx, fy, 0, ex, ey, 0)
        facet(hx, hy, 0, gx, gy, 0, fx, fy, 0)
        wall(gx, gy, hx, hy)
        if (is_side(ex, fx, 0) || is_side(ex, fx, across * side) || is_side(ey, fy, 0) || is_side(ey, fy, along * side))
            wall(ex, ey, fx, fy)
    }
}
function is_side(p, q, at) { return size(p - at) < 0.001 && size(q - at) < 0.001 }
BEGIN {
    pi = atan2(0, -1); side = 30; high = 8; hole = 7; steps = 32; across = 3; along = 2
    print "solid part"
    for (i = 0; i < across; i++)
        for (k = 0; k < along; k++) tile(i, k)
    print "endsolid part"
}
