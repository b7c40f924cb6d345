/* drawing_rows.h - core: parameters of technical drawings, one row each. They are the query of zraster_drawing and of
 * POST /v1/drawing, the options of `zraster drawing`, and the keywords of zraster.drawing in Python. */
#ifndef ZR_DRAWING_ROWS_H
#define ZR_DRAWING_ROWS_H

/* ROW(name, placeholder, values: "5000 is not ..." of a refusal, help, default) */
#define ZR_DRAWING_ROWS(ROW)                                                                                           \
    ROW(page, "a4|a3", "a4 or a3", "paper: a4 upright or a3 across", "a3")                                             \
    ROW(scale, "N:M", "N:M, two whole numbers such as 1:2", "scale, such as 1:2",                                      \
        "the largest standard one that fits")                                                                          \
    ROW(projection, "third|first", "third or first", "places of the views: third or first angle", "third")             \
    ROW(section, "AXIS[:SHARE]", "x, y or z, nor one of them with a share between 0 and 1, such as x:0.5",             \
        "section A-A across x, y or z of the world, at a share of the bounds: x or x:0.5", "none")                     \
    ROW(hidden, "true|false", "true or false", "hidden lines in dashes", "true")                                       \
    ROW(title, "TEXT", "a text", "title in the title block", "the name of the file")                                   \
    ROW(date, "TEXT", "a text", "date in the title block", "none")                                                     \
    ROW(format, "svg|png", "svg or png", "format of the answer", "svg")                                                \
    ROW(dpi, "N", "30 to 600", "pixels per inch of a PNG, 30 to 600", "150")

#endif
