#include "input/model/kept_mesh.h"

#include <string.h>

#include "base/cancel.h"
#include "input/model/read_model.h"
#include "render_request.h"

/* A copy of bytes that a file was made of. */
struct copy {
    const void *bytes; /* NULL: not compared */
    size_t size;
};

struct zr_kept_mesh {
    struct zr_read_model model;
    struct zr_arena_share share; /* of reading */
    struct copy file;
    size_t asset_count;  /* 0: no other file was looked for */
    const uint8_t *uses; /* one per asset, or NULL: flags of the model of a scene */
    const struct copy *assets;
};

enum {
    SIZE_MIN = 64 << 10,
    SAMPLES = 64, /* of SAMPLE_BYTES each */
    SAMPLE_BYTES = 64,
    UNIT_MIN = 64 << 10, /* of blocks for reading a small file */
    UNITS_PER_FILE = 4,
    COMPARED_AT_ONCE = 1 << 20,
    HASHES_TRIED = 16
};

/* ---- hashes ---- */

static void add(const struct zr_mesh_file *file, struct zr_file_hash *hash, const void *bytes, size_t size)
{
    file->request->meshes.hash(file->request->meshes.context, hash, bytes, size);
}

static void add_text(const struct zr_mesh_file *file, struct zr_file_hash *hash, const char *text)
{
    add(file, hash, text ? text : "", text ? strlen(text) + 1 : 0);
}

/* Adds the size and some samples, from the beginning to the end. */
static void add_samples(const struct zr_mesh_file *file, struct zr_file_hash *hash)
{
    const size_t size = file->request->size, step = (size - SAMPLE_BYTES) / (SAMPLES - 1);
    char samples[SAMPLES * SAMPLE_BYTES];
    for (size_t i = 0; i < SAMPLES; i++)
        memcpy(samples + i * SAMPLE_BYTES, file->request->bytes + i * step, SAMPLE_BYTES);
    add(file, hash, samples, sizeof samples);
}

static void hash_assets(const struct zr_mesh_file *file)
{
    struct zr_assets_hash *made = file->assets;
    for (size_t i = 0; !made->is_made && i < file->request->asset_count; i++) {
        const struct zr_asset *asset = &file->request->assets[i];
        const uint64_t facts[] = {asset->size, (uint64_t)asset->array.type};
        add_text(file, &made->hash, asset->name);
        add(file, &made->hash, facts, sizeof facts);
    }
    made->is_made = true;
}

/* Makes the hashes of the file, once, from all that its reader may depend on. */
static void make_hashes(struct zr_mesh_file *file)
{
    const struct zr_request *request = file->request;
    const bool is_bare = !file->builder->asset_uses;
    const uint64_t facts[] = {request->size, file->limits->image_pixels_max, file->is_stored,
                              is_bare ? (uint64_t)request->format : ZR_FORMAT_COUNT};
    struct zr_file_hash *alone = &file->hashes[0], *with_others = &file->hashes[1];
    if (file->is_hashed) return;
    file->is_hashed = true;
    if (!file->is_stored) add_samples(file, alone);
    add(file, alone, facts, sizeof facts);
    add_text(file, alone, request->animation);
    add_text(file, alone, request->time);
    add_text(file, alone, request->frames ? "frames" : NULL);
    hash_assets(file);
    *with_others = *alone;
    add(file, with_others, file->assets->hash.bytes, sizeof file->assets->hash.bytes);
    add_text(file, with_others, file->builder->asset_folder);
    if (is_bare && request->asset_count > 0) *alone = *with_others; /* it warns of assets that are not used */
}

/* ---- which files are kept ---- */

/* True if the file is read into a part of the arena of its own, whether it is kept or not. */
static bool is_large(const struct zr_mesh_file *file)
{
    return file->request->size >= SIZE_MIN;
}

static bool may_keep(const struct zr_mesh_file *file)
{
    const struct zr_request *request = file->request;
    for (size_t i = 0; i < request->asset_count; i++)
        if (request->assets[i].packed) return false;
    return request->meshes.hash && is_large(file);
}

/* Returns a power of two. */
static size_t unit_for(size_t size)
{
    size_t unit = UNIT_MIN;
    while (unit < ZR_ARENA_BLOCK && unit < size / UNITS_PER_FILE)
        unit *= 2;
    return unit;
}

/* ---- finding ---- */

/* Where a file and a kept one differ first. */
struct difference {
    uint64_t place[2]; /* number of the asset plus 1, or 0: the file itself; offset */
    const char *bytes; /* from there on, of the file */
    size_t size;
};

/* Compares bytes with a copy. Sets *at to the beginning of a block that differs. */
static bool is_equal(const struct zr_mesh_file *file, const struct copy *copy, const void *bytes, size_t size,
                     size_t *at)
{
    *at = 0;
    if (!copy->bytes) return true;
    if (copy->size != size) return false;
    for (; *at < size; *at += COMPARED_AT_ONCE) {
        const size_t count = size - *at < COMPARED_AT_ONCE ? size - *at : COMPARED_AT_ONCE;
        if (zr_is_cancelled(file->request->cancel)) return false;
        if (memcmp((const char *)copy->bytes + *at, (const char *)bytes + *at, count) != 0) return false;
    }
    return true;
}

static struct difference difference_of(const struct copy *copy, uint64_t asset, const void *bytes, size_t size,
                                       size_t at)
{
    const char *there = copy->bytes, *given = bytes;
    while (at < size && at < copy->size && there[at] == given[at])
        at++;
    return (struct difference){{asset, at}, given + at, size - at < SAMPLE_BYTES ? size - at : SAMPLE_BYTES};
}

static bool is_of(const struct zr_kept_mesh *mesh, const struct zr_mesh_file *file, struct difference *difference)
{
    const struct zr_request *request = file->request;
    size_t at;
    *difference = (struct difference){.size = 0};
    if (mesh->asset_count > 0 && mesh->asset_count != request->asset_count) return false;
    for (size_t i = 0; i < mesh->asset_count; i++) {
        const struct zr_asset *asset = &request->assets[i];
        if (is_equal(file, &mesh->assets[i], asset->bytes, asset->size, &at)) continue;
        *difference = difference_of(&mesh->assets[i], i + 1, asset->bytes, asset->size, at);
        return false;
    }
    if (is_equal(file, &mesh->file, request->bytes, request->size, &at)) return true;
    *difference = difference_of(&mesh->file, 0, request->bytes, request->size, at);
    return false;
}

/* Adds the flags of the model of a scene; NULL: none. */
static void add_uses(const struct zr_mesh_file *file, const uint8_t *uses)
{
    for (size_t i = 0; uses && i < file->request->asset_count; i++)
        file->builder->asset_uses[i] |= uses[i];
}

/* Allocates the flags of the model of a scene. Their number depends on the request, so they are in no part. */
static uint8_t *make_uses(const struct zr_mesh_file *file, struct zr_arena *arena)
{
    return file->builder->asset_uses ? zr_arena_zero(arena, file->request->asset_count, 1) : NULL;
}

/* Gives the file to the builder, in a part of the arena that counts as much as reading. */
static bool load(const struct zr_mesh_file *file, const struct zr_kept_mesh *mesh)
{
    struct zr_scene_builder *builder = file->builder;
    struct zr_arena *arena = builder->arena;
    make_uses(file, arena); /* as reading does */
    const struct zr_arena_part part = zr_arena_open_part(arena, unit_for(file->request->size));
    zr_read_model_load(&mesh->model, builder);
    add_uses(file, mesh->uses);
    zr_arena_close_part(arena, &part, &mesh->share);
    return zr_arena_ok(arena);
}

/* Finds the file under the hash. A kept file of this hash that differs from it leads to the next hash, which is made of
 * this one and the first difference. Sets *hash to the last one, under which the file may be kept. */
static const struct zr_kept_mesh *find(struct zr_mesh_file *file, struct zr_file_hash *hash)
{
    const struct zr_kept_meshes *meshes = &file->request->meshes;
    struct difference difference;
    for (int i = 0; i < HASHES_TRIED; i++) {
        const struct zr_kept_mesh *mesh = meshes->find(meshes->context, hash);
        if (!mesh || is_of(mesh, file, &difference)) return mesh;
        if (zr_is_cancelled(file->request->cancel)) break;
        add(file, hash, difference.place, sizeof difference.place);
        add(file, hash, difference.bytes, difference.size);
    }
    file->is_taken = true;
    return NULL;
}

bool zr_mesh_file_find(struct zr_mesh_file *file)
{
    if (!may_keep(file) || !zr_arena_ok(file->builder->arena)) return false;
    make_hashes(file);
    const struct zr_kept_mesh *mesh = find(file, &file->hashes[0]);
    if (!mesh) mesh = find(file, &file->hashes[1]);
    if (!mesh) return false;
    file->is_taken = mesh->share.most > zr_arena_left(file->builder->arena);
    return !file->is_taken && load(file, mesh);
}

/* ---- reading ---- */

/* What reading a file tells beside its result. */
struct reading {
    struct zr_arena_share share;
    bool looked;         /* for other files */
    const uint8_t *uses; /* of the model of a scene: flags per asset */
};

/* Reads the file in a part of the builder's arena. */
static enum zr_status read_part(const struct zr_mesh_file *file, const struct zr_request *request,
                                struct zr_scene_builder *builder, zr_model_read_fn *read, struct reading *reading,
                                struct zr_error *error)
{
    const bool is_bare = !file->builder->asset_uses;
    uint8_t *uses = make_uses(file, builder->arena);
    if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    *reading = (struct reading){.looked = is_bare && request->asset_count > 0, .uses = uses};
    const struct zr_arena_part part = zr_arena_open_part(builder->arena, unit_for(request->size));
    builder->asset_uses = uses;
    builder->looked = &reading->looked;
    const enum zr_status status = read(builder, request, file->limits, error);
    if (status == ZR_OK) zr_scene_builder_complete(builder);
    reading->share = zr_arena_close_part(builder->arena, &part, NULL);
    builder->looked = NULL;
    return status == ZR_OK && !zr_arena_ok(builder->arena) ? ZR_NO_MEMORY : status;
}

static struct copy copy_of(struct zr_arena *arena, const void *bytes, size_t size)
{
    return (struct copy){zr_arena_copy(arena, bytes, size), size};
}

/* Copies the bytes that the file was made of. All assets of a bare mesh; those that the model of a scene has found. */
static void copy_bytes(const struct zr_mesh_file *file, struct zr_arena *arena, const struct reading *reading,
                       struct zr_kept_mesh *mesh)
{
    const struct zr_request *request = file->request;
    if (!file->is_stored) mesh->file = copy_of(arena, request->bytes, request->size);
    if (!reading->looked || request->asset_count == 0) return;
    struct copy *assets = zr_arena_zero(arena, request->asset_count, sizeof *assets);
    mesh->asset_count = request->asset_count;
    mesh->uses = reading->uses;
    mesh->assets = assets;
    for (size_t i = 0; assets && i < request->asset_count; i++)
        if (!mesh->uses || mesh->uses[i]) assets[i] = copy_of(arena, request->assets[i].bytes, request->assets[i].size);
}

/* Reads the file into an arena of the caller's. NULL if that fails. */
static const struct zr_kept_mesh *read_kept(const struct zr_mesh_file *file, struct zr_arena *arena,
                                            zr_model_read_fn *read, struct reading *reading)
{
    const struct zr_scene_builder *builder = file->builder;
    struct zr_scene scene = *builder->scene;
    struct zr_scene_builder own = zr_scene_builder_open(arena, builder->team, &scene);
    struct zr_request request = *file->request;
    struct zr_error error = {.count = 0};
    struct zr_kept_mesh *mesh = zr_arena_zero(arena, 1, sizeof *mesh);
    if (!mesh) return NULL;
    request.images = (struct zr_kept_images){.find = NULL}; /* kept images and texts stay for one request only */
    request.texts = (struct zr_kept_texts){.find = NULL};
    own.asset_folder = builder->asset_folder;
    arena->cancel = request.cancel;
    const size_t ceiling = arena->ceiling;
    arena->ceiling = arena->held + zr_arena_left(builder->arena);
    const enum zr_status status = read_part(file, &request, &own, read, reading, &error);
    arena->ceiling = ceiling; /* copies do not count for the request */
    arena->cancel = NULL;
    if (status != ZR_OK) return NULL;
    mesh->share = reading->share;
    zr_read_model_save(&mesh->model, &own);
    mesh->model.builder.scene = NULL;
    copy_bytes(file, arena, reading, mesh);
    return zr_arena_ok(arena) ? mesh : NULL;
}

/* Reads the file into an arena of the caller's, and gives it to the builder. False if it is not kept. */
static bool read_and_keep(struct zr_mesh_file *file, zr_model_read_fn *read)
{
    const struct zr_kept_meshes *meshes = &file->request->meshes;
    struct zr_arena *own = meshes->begin(meshes->context, file->hashes, 2, file->request->size);
    struct reading reading = {.looked = false};
    if (!own) return false;
    own->unit = unit_for(file->request->size);
    const struct zr_kept_mesh *mesh = read_kept(file, own, read, &reading);
    return meshes->end(meshes->context, own, &file->hashes[reading.looked], mesh) && load(file, mesh);
}

enum zr_status zr_mesh_file_read(struct zr_mesh_file *file, zr_model_read_fn *read, struct zr_error *error)
{
    const struct zr_kept_meshes *meshes = &file->request->meshes;
    struct zr_scene_builder *builder = file->builder;
    uint8_t *const all_uses = builder->asset_uses;
    const bool keeps = may_keep(file) && !file->is_taken;
    struct reading reading = {.uses = NULL};
    if (!is_large(file)) return read(builder, file->request, file->limits, error);
    if (keeps) make_hashes(file);
    if (keeps && read_and_keep(file, read)) return ZR_OK;
    const enum zr_status status = read_part(file, file->request, builder, read, &reading, error);
    builder->asset_uses = all_uses;
    add_uses(file, reading.uses);
    if (status == ZR_OK && keeps) meshes->note(meshes->context, &file->hashes[reading.looked]);
    return status;
}
