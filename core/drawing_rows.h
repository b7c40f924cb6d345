/* drawing_rows.h - core: parameters of technical drawings, one row each. They are the query of zraster_drawing and of
 * POST /v1/drawing, the options of `zraster drawing`, and the keywords of zraster.drawing in Python. */
#ifndef ZR_DRAWING_ROWS_H
#define ZR_DRAWING_ROWS_H

/* ROW(name, placeholder, help) */
#define ZR_DRAWING_ROWS(ROW)                                                                                           \
    ROW(page, "a4|a3", "paper: a4 upright or a3 across (default: a3)")                                                 \
    ROW(scale, "N:M", "scale, such as 1:2 (default: the largest standard one that fits)")                              \
    ROW(projection, "third|first", "places of the views: third or first angle (default: third)")                       \
    ROW(section, "AXIS[:SHARE]",                                                                                       \
        "section A-A across x, y or z of the world, at a share of the bounds, such as x or x:0.5 (default: none)")        \
    ROW(hidden, "true|false", "hidden lines in dashes (default: true)")                                                \
    ROW(title, "TEXT", "title in the title block (default: the name of the file)")                                     \
    ROW(date, "TEXT", "date in the title block (default: none)")                                                       \
    ROW(format, "svg|png", "format of the answer (default: svg)")                                                      \
    ROW(dpi, "N", "pixels per inch of a PNG, 30 to 600 (default: 150)")

#endif
