/* triangle_query.h - tests: a bare triangle with parameters of the query. */
#ifndef ZR_TESTS_TRIANGLE_QUERY_H
#define ZR_TESTS_TRIANGLE_QUERY_H

#include "looks_check.h"

static const char MESH[] = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n";

static inline struct reading *read_triangle(struct zr_request request)
{
    request.format = ZR_FORMAT_OBJ;
    struct reading *reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), 1 << 20);
    assert_read(reading);
    return reading;
}

#endif
