/* read_model.h - input: a bare mesh or a model file, as the reader of its format leaves it. */
#ifndef ZR_READ_MODEL_H
#define ZR_READ_MODEL_H

#include "scene/scene_builder.h"

struct zr_read_model {
    struct zr_scene_builder builder; /* meshes and warnings */
    uint32_t mesh_count, image_count, texture_count;
    struct zr_read_counts counts;
    const double *origin; /* or NULL */
    struct zr_file_facts file;
};

/* Saves what the reader of a format has left in a builder, or gives it to another builder. Arrays are shared, except
 * the list of meshes. False without memory. */
void zr_read_model_save(struct zr_read_model *model, const struct zr_scene_builder *builder);
bool zr_read_model_load(const struct zr_read_model *model, struct zr_scene_builder *builder);

#endif
