#include "meshes.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

enum { NOTES = 1 << 14 };

struct meshes {
    struct kept *kept;
    _Atomic uint64_t notes[NOTES]; /* beginnings of hashes, in places that follow from them */
};

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

struct meshes *meshes_open(uint64_t max_bytes)
{
    static const struct kept_kind kind = {.take = take, .free = free_mesh};
    struct meshes *meshes = calloc(1, sizeof *meshes);
    if (meshes) meshes->kept = kept_open(&kind, max_bytes);
    if (meshes && meshes->kept) return meshes;
    free(meshes);
    return NULL;
}

void meshes_close(struct meshes *meshes)
{
    if (!meshes) return;
    kept_close(meshes->kept);
    free(meshes);
}

struct kept *meshes_kept(struct meshes *meshes)
{
    return meshes ? meshes->kept : NULL;
}

/* ---- files that were read ---- */

/* Returns the place of a hash, and its beginning. */
static _Atomic uint64_t *note_of(struct meshes *meshes, const struct zr_file_hash *hash, uint64_t *beginning)
{
    memcpy(beginning, hash->bytes, sizeof *beginning);
    return &meshes->notes[*beginning % NOTES];
}

static bool is_noted(struct meshes *meshes, const struct zr_file_hash *hash)
{
    uint64_t beginning;
    const _Atomic uint64_t *note = note_of(meshes, hash, &beginning);
    return atomic_load_explicit(note, memory_order_relaxed) == beginning;
}

static void note(void *context, const struct zr_file_hash *hash)
{
    const struct meshes_use *use = context;
    uint64_t beginning;
    _Atomic uint64_t *note = note_of(use->meshes, hash, &beginning);
    if (atomic_load_explicit(note, memory_order_relaxed) != ~beginning)
        atomic_store_explicit(note, beginning, memory_order_relaxed);
}

/* Notes that the file is too large to be kept. */
static void note_large(struct meshes *meshes, const struct zr_file_hash *hash)
{
    uint64_t beginning;
    _Atomic uint64_t *note = note_of(meshes, hash, &beginning);
    atomic_store_explicit(note, ~beginning, memory_order_relaxed);
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
    kept_find(use->meshes->kept, hash, &use->held, &mesh);
    return mesh;
}

static struct zr_arena *begin(void *context, const struct zr_file_hash *hashes, size_t count, size_t size)
{
    struct meshes *meshes = ((struct meshes_use *)context)->meshes;
    bool is_known = false;
    for (size_t i = 0; i < count; i++)
        is_known |= is_noted(meshes, &hashes[i]);
    kept_miss(meshes->kept);
    struct mesh *mesh = is_known && size <= kept_max_bytes(meshes->kept) ? calloc(1, sizeof *mesh) : NULL;
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
    if (mesh->value.bytes > kept_max_bytes(use->meshes->kept)) note_large(use->meshes, hash);
    return kept_add(use->meshes->kept, &mesh->value, &use->held);
}

struct zr_kept_meshes meshes_lend(struct meshes_use *use)
{
    if (!use->meshes || kept_max_bytes(use->meshes->kept) == 0) return (struct zr_kept_meshes){.hash = NULL};
    return (struct zr_kept_meshes){hash, find, note, begin, end, use};
}

void meshes_release(struct meshes_use *use)
{
    if (use->meshes) kept_release(use->meshes->kept, &use->held);
}
