/* encode.h - request: the files of a frame's outputs, before several of them become one archive. */
#ifndef ZR_ENCODE_H
#define ZR_ENCODE_H

#include "base/run.h"
#include "core.h"
#include "output/json/warnings.h"
#include "output/zip.h"
#include "scene/channels.h"
#include "scene/scene.h"

/* One entry per output of the frame's view, in their order; or the files of several views (views.h). */
struct zr_files {
    uint32_t count;
    struct zr_zip_entry *entries;    /* names are channel.extension */
    const char **types;              /* media type of each */
    struct zr_warning_list warnings; /* of scene, frame and encoding */
    const char *encoders;            /* of JPEG and WebP, as in struct zr_answer */
};

/* Encodes each output. `drawing` may be NULL; with it, the scene needs no geometry (api/encode_input.h). Other arguments
 * and errors are those of zr_encode, which makes its answer from these files. */
enum zr_status zr_encode_files(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                               const struct zr_drawing_warnings *drawing, struct zr_files *files);

/* Joins files as the answer of a render: a single one as it is, several as a ZIP. Sets type, bytes and size. Fails with
 * ZR_BAD_SCENE for 4 GiB or more, or with ZR_NO_MEMORY. */
enum zr_status zr_files_join(struct zr_arena *arena, const struct zr_files *files, struct zr_answer *answer,
                             struct zr_error *error);

/* Sets the warnings, the look and the encoders of an answer. Fails with ZR_NO_MEMORY. */
enum zr_status zr_files_describe(struct zr_arena *arena, const struct zr_files *files, const struct zr_scene *scene,
                                 struct zr_answer *answer, struct zr_error *error);

/* Makes the whole answer of files, with the warnings and the look of the scene. */
enum zr_status zr_files_answer(struct zr_arena *arena, const struct zr_files *files, const struct zr_scene *scene,
                               struct zr_answer *answer, struct zr_error *error);

#endif
