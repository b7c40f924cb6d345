#include "bench/versus/stock_path.h"

#include <GL/gl.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

bool stock_path_open(struct stock_path *path, bool exact, int threads, const struct drawing *camera)
{
    struct reference_error error = {"out of memory"};
    struct reference_options options = {.driver = "llvmpipe", .native = !exact, .threads = threads};
    *path = (struct stock_path){.camera = camera, .pixels = malloc((size_t)camera->width * camera->height * 4)};
    if (path->pixels) path->reference = reference_open(&options, &error);
    if (path->reference && reference_resize(path->reference, camera->width, camera->height, false, &error)) return true;
    fprintf(stderr, "reference: %s\n", error.text);
    return false;
}

void stock_path_close(struct stock_path *path)
{
    reference_close(path->reference);
    free(path->file.bytes);
    free(path->pixels);
}

/* ---- from JSON to arrays ---- */

struct arrays {
    uint32_t position_count, color_count, index_count;
    zr_vec4 *positions, *colors;
    uint32_t *indices;
};

static zr_vec4 *read_vectors(const cJSON *list, uint32_t *count)
{
    *count = (uint32_t)cJSON_GetArraySize(list);
    zr_vec4 *vectors = malloc((*count + (size_t)1) * sizeof *vectors), *at = vectors;
    for (const cJSON *item = list ? list->child : NULL; vectors && item; item = item->next) {
        const cJSON *x = item->child, *y = x ? x->next : NULL, *z = y ? y->next : NULL;
        if (z) *at++ = (zr_vec4){(float)x->valuedouble, (float)y->valuedouble, (float)z->valuedouble, 1.0f};
    }
    return vectors;
}

static uint32_t *read_triangles(const cJSON *list, uint32_t *count)
{
    uint32_t *indices = malloc(((size_t)cJSON_GetArraySize(list) + 1) * 3 * sizeof *indices), *at = indices;
    for (const cJSON *item = list ? list->child : NULL; indices && item; item = item->next) {
        const cJSON *a = item->child, *b = a ? a->next : NULL, *c = b ? b->next : NULL;
        if (!c) continue;
        *at++ = (uint32_t)a->valueint;
        *at++ = (uint32_t)b->valueint;
        *at++ = (uint32_t)c->valueint;
    }
    *count = indices ? (uint32_t)(at - indices) : 0;
    return indices;
}

static bool read_arrays(const struct document *document, struct arrays *arrays)
{
    cJSON *root = cJSON_ParseWithLength(document->bytes, document->size);
    const cJSON *mesh = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "meshes"), 0);
    arrays->positions = read_vectors(cJSON_GetObjectItemCaseSensitive(mesh, "positions"), &arrays->position_count);
    arrays->colors = read_vectors(cJSON_GetObjectItemCaseSensitive(mesh, "colors"), &arrays->color_count);
    arrays->indices = read_triangles(cJSON_GetObjectItemCaseSensitive(mesh, "faces"), &arrays->index_count);
    cJSON_Delete(root);
    return arrays->positions && arrays->colors && arrays->indices && arrays->position_count == arrays->color_count;
}

/* ---- from arrays to a picture ---- */

static bool draw(struct stock_path *path, const struct arrays *arrays)
{
    struct reference_error error = {""};
    const struct reference_batch batch = {.mode = REFERENCE_TRIANGLES,
                                          .count = arrays->index_count,
                                          .modelview = &path->camera->modelview,
                                          .smooth = true};
    const struct reference_arrays drawn = {.positions = arrays->positions,
                                           .front = arrays->colors,
                                           .indices = arrays->indices,
                                           .batch_count = 1,
                                           .batches = &batch,
                                           .projection = path->camera->projection,
                                           .background = {0, 0, 0, 1}};
    if (!reference_draw(path->reference, &drawn, &error)) {
        fprintf(stderr, "reference: %s\n", error.text);
        return false;
    }
    glReadPixels(0, 0, (GLsizei)path->camera->width, (GLsizei)path->camera->height, GL_RGBA, GL_UNSIGNED_BYTE,
                 path->pixels);
    return glGetError() == GL_NO_ERROR;
}

bool stock_path_answer(struct stock_path *path, const struct document *document)
{
    struct arrays arrays = {0};
    const struct stock_image image = {.pixels = STOCK_RGBX,
                                      .width = path->camera->width,
                                      .height = path->camera->height,
                                      .bottom_up = true,
                                      .bytes = path->pixels};
    bool ok = read_arrays(document, &arrays) && draw(path, &arrays) && stock_png_write(&image, &path->file);
    free(arrays.positions);
    free(arrays.colors);
    free(arrays.indices);
    return ok;
}
