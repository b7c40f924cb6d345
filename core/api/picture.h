/* picture.h - api: a drawn frame, and its files once they are encoded. */
#ifndef ZR_LIBRARY_PICTURE_H
#define ZR_LIBRARY_PICTURE_H

#include "api/encode_input.h"
#include "api/renderer.h"
#include "request/encode.h"

struct zraster_picture {
    zraster *renderer;
    zraster_cancel *cancel; /* of the request; or NULL */
    struct zr_arena *arena;
    struct zr_encode_input *encode_input; /* NULL: the picture has several views, which are encoded */
    const char *look;
    struct zr_warning_list warnings;
    struct zr_files files;       /* entries NULL: not encoded yet */
    struct zraster_bytes joined; /* data NULL: not joined yet */
};

struct zr_views;

/* Draws and encodes several views. The picture has their files and no channels. */
enum zr_status zr_picture_make_views(zraster *renderer, struct zr_views *views, zraster_cancel *cancel,
                                     zraster_picture **out, struct zr_error *error);

/* Draws a scene into a picture. The scene may be freed afterwards. On failure *out is NULL. */
enum zr_status zr_picture_make(zraster *renderer, const struct zr_scene *scene, size_t scene_bytes,
                               zraster_cancel *cancel, zraster_picture **out, struct zr_error *error);

#endif
