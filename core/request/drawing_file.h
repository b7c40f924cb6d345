/* drawing_file.h - request: a technical drawing of a scene that was read, as a file. */
#ifndef ZR_DRAWING_FILE_H
#define ZR_DRAWING_FILE_H

#include "base/run.h"
#include "base/status.h"
#include "base/warning_list.h"
#include "scene/scene.h"

struct zr_drawing_file {
    const void *bytes;
    size_t size;
    const char *content_type;
    const char
        *json; /* one object: summary, page, scale, projection, units, millimetres, holes, holesNoted, warnings */
    struct zr_warning_list warnings; /* those of the scene, then those of the drawing */
};

/* Returns true if a parameter, "name=value" or more behind it, is one of zr_drawing_file_make. */
bool zr_drawing_has_parameter(const char *text);

/* Predicts the processor time, on the reference machine, ms: within a factor of three for usual models. */
double zr_drawing_cost_ms(const struct zr_scene *scene, const char *query);

/* Makes the file in run->arena; run->scratch holds the rest. `query` may be NULL; its parameters are those of
 * core/drawing_rows.h, separated by "&", with values percent-encoded. Fails with ZR_BAD_REQUEST for other parameters,
 * or as zr_technical_drawing_make. */
enum zr_status zr_drawing_file_make(const struct zr_run *run, const struct zr_scene *scene, const char *query,
                                    struct zr_drawing_file *out);

#endif
