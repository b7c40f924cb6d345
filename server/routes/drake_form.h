/* drake_form.h - the fields of Drake's form (drake.c). */
#ifndef ZRASTERD_DRAKE_FORM_H
#define ZRASTERD_DRAKE_FORM_H

#include <stdint.h>

#include "base/status.h"
#include "multipart.h"

enum drake_image { DRAKE_COLOR, DRAKE_DEPTH, DRAKE_LABEL, DRAKE_IMAGES };

struct drake_form {
    const struct multipart_part *scene, *hash; /* hash: NULL, or not 64 hex digits, if the client gives none */
    enum drake_image image;
    double width, height;                        /* pixels, whole */
    double near, far;                            /* clipping planes, metres */
    double focal_x, focal_y, center_x, center_y; /* pixels; (0, 0) is the top left corner of the picture */
    double min_depth, max_depth;                 /* metres; DRAKE_DEPTH only */
};

/* Reads and checks the fields; side_max: the most pixels of a side. False: *error has each fault, with the name of the
 * field, its value and the values that are allowed. The hash is not compared. */
bool drake_form_read(const struct multipart *parts, uint32_t side_max, struct drake_form *form, struct zr_error *error);

/* Copies the faults of a scene, with the field at the place of each fault's JSON Pointer. */
void drake_form_report(const struct zr_error *faults, enum zr_status status, struct zr_error *error);

/* JSON Pointers of keys in the scene that drake.c makes of the fields. */
#define DRAKE_AT_WIDTH    "/window/width"
#define DRAKE_AT_HEIGHT   "/window/height"
#define DRAKE_AT_FOCAL_X  "/view/intrinsics/fx"
#define DRAKE_AT_FOCAL_Y  "/view/intrinsics/fy"
#define DRAKE_AT_CENTER_X "/view/intrinsics/cx"
#define DRAKE_AT_CENTER_Y "/view/intrinsics/cy"
#define DRAKE_AT_NEAR     "/view/znear"
#define DRAKE_AT_FAR      "/view/zfar"
#define DRAKE_AT_CAMERA   "/view/camera"
#define DRAKE_AT_RANGE    "/outputs/0/range"
#define DRAKE_AT_SCENE    "/meshes/0"

#endif
