#include "meshes.h"

#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

struct mesh {
    struct kept_value value;
    struct zr_arena arena;
    const struct zr_kept_mesh *mesh; /* in the arena */
};

static void take(const struct kept_value *value, void *out)
{
    *(const struct zr_kept_mesh **)out = ((const struct mesh *)value)->mesh;
}

static void free_mesh(struct kept_value *value)
{
    zr_arena_free(&((struct mesh *)value)->arena);
    free(value);
}

struct kept *meshes_open(uint64_t max_bytes)
{
    static const struct kept_kind kind = {.take = take, .free = free_mesh};
    return kept_open(&kind, max_bytes);
}

/* ---- files of one request ---- */

static void hash(void *context, struct zr_file_hash *hash, const void *bytes, size_t size)
{
    struct sha256_ctx sha256;
    (void)context;
    sha256_init(&sha256);
    sha256_update(&sha256, sizeof hash->bytes, hash->bytes);
    sha256_update(&sha256, size, bytes);
    sha256_digest(&sha256, sizeof hash->bytes, hash->bytes);
}

static const struct zr_kept_mesh *find(void *context, const struct zr_file_hash *hash)
{
    struct meshes_use *use = context;
    const struct zr_kept_mesh *mesh = NULL;
    kept_find(use->meshes, hash, &use->held, &mesh);
    return mesh;
}

static void note(void *context, const struct zr_file_hash *hash)
{
    kept_note(((const struct meshes_use *)context)->meshes, hash);
}

static struct zr_arena *begin(void *context, const struct zr_file_hash *hashes, size_t count, size_t size)
{
    struct kept *meshes = ((struct meshes_use *)context)->meshes;
    bool is_known = false;
    for (size_t i = 0; i < count; i++)
        is_known |= kept_is_noted(meshes, &hashes[i]);
    kept_miss(meshes);
    struct mesh *mesh = is_known && size <= kept_max_bytes(meshes) ? calloc(1, sizeof *mesh) : NULL;
    if (!mesh) return NULL;
    zr_arena_init(&mesh->arena, SIZE_MAX / 2);
    return &mesh->arena;
}

static bool end(void *context, struct zr_arena *arena, const struct zr_file_hash *hash, const struct zr_kept_mesh *kept)
{
    struct meshes_use *use = context;
    struct mesh *mesh = (struct mesh *)(void *)((char *)arena - offsetof(struct mesh, arena));
    if (!kept) {
        free_mesh(&mesh->value);
        return false;
    }
    mesh->mesh = kept;
    mesh->value.hash = *hash;
    mesh->value.bytes = sizeof *mesh + zr_arena_bytes(arena);
    if (mesh->value.bytes > kept_max_bytes(use->meshes)) kept_note_large(use->meshes, hash);
    return kept_add(use->meshes, &mesh->value, &use->held);
}

struct zr_kept_meshes meshes_lend(struct meshes_use *use)
{
    if (!use->meshes || kept_max_bytes(use->meshes) == 0) return (struct zr_kept_meshes){.hash = NULL};
    return (struct zr_kept_meshes){hash, find, note, begin, end, use};
}

void meshes_release(struct meshes_use *use)
{
    if (use->meshes) kept_release(use->meshes, &use->held);
}
