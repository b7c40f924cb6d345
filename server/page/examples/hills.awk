# Writes the scene Hills: heights z = f(x, y), coloured by a map, with its bar.
BEGIN {
    side = 33
    print "{\n  \"look\": \"clay\",\n  \"up\": \"z\",\n  \"colorBar\": {\"title\": \"height\"},\n  \"view\": {\"azimuthDegrees\": 35, \"elevationDegrees\": 34, \"perspective\": {\"yfovDegrees\": 30}, \"fit\": {\"padding\": 0.13}},\n  \"meshes\": [\n    {"
    print "      \"name\": \"hills\",\n      \"colormap\": \"viridis\",\n      \"heights\": {"
    print "        \"x\": [-4, 4],\n        \"y\": [-4, 4],\n        \"values\": ["
    for (j = 0; j < side; j++) {
        line = "          ["
        for (i = 0; i < side; i++) {
            x = 8 * i / (side - 1) - 4
            y = 8 * j / (side - 1) - 4
            z = 1.7 * exp(-((x - .8) ^ 2 + (y + .6) ^ 2) / 1.6) + 1.1 * exp(-((x + 1.7) ^ 2 + (y - 1.5) ^ 2) / 1.2)
            z += -1.1 * exp(-((x - 1.9) ^ 2 + (y - 2) ^ 2) / 1.4) + .12 * sin(1.7 * x) * cos(1.3 * y)
            value = sprintf("%.2f", z)
            sub(/^-0.00$/, "0.00", value)
            line = line (i ? ", " : "") value
        }
        print line (j < side - 1 ? "]," : "]")
    }
    print "        ]\n      }\n    }\n  ]\n}"
}
