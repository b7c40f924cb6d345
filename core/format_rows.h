/* format_rows.h - core: what a body may be, one row each: names for whoever sends and takes bodies. Who reads them is
 * in input/formats.c. */
#ifndef ZR_FORMAT_ROWS_H
#define ZR_FORMAT_ROWS_H

/* ROW(ID, ending of file names, media types of which the first is the usual one, a scene with a view of its own,
 *     binary, triangles share no corners, z is up unless the query has `up`) */
#define ZR_FORMAT_ROWS(ROW)                                                                                            \
    ROW(JSON, "json", "application/json", true, false, false, false)                                                   \
    ROW(OBJ, "obj", "model/obj", false, false, false, false)                                                           \
    ROW(STL, "stl", "model/stl application/sla application/vnd.ms-pki.stl model/x.stl-binary model/x.stl-ascii",       \
        false, true, true, true)

#endif
