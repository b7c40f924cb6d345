#include "scene/parts/part_list.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "base/hash.h"

struct listing {
    struct zr_arena *arena;
    struct zr_part *parts;
    uint32_t slot_count;
    uint32_t *slots; /* of the list */
    uint32_t *last;  /* per part: the number that the last part with the same name got, or 0 */
};

/* Returns the slot of the name, or the empty slot where it belongs. */
static uint32_t slot_of(const struct zr_part *parts, const uint32_t *slots, uint32_t slot_count, const char *name)
{
    uint32_t hash = ZR_HASH_BEGIN;
    for (const char *at = name; *at; at++)
        hash = zr_hash_byte(hash, (uint8_t)*at);
    uint32_t slot = hash % slot_count;
    while (slots[slot] != 0 && strcmp(parts[slots[slot] - 1].name, name) != 0)
        slot = slot + 1 == slot_count ? 0 : slot + 1;
    return slot;
}

static const char *given_name(const struct zr_scene *scene, const struct zr_part *part)
{
    const struct zr_mesh *mesh = &scene->meshes[part->mesh];
    const char *node = scene->instances[part->instance].node;
    if (mesh->face_parts && *mesh->part_names[part->number]) return mesh->part_names[part->number];
    if (node && *node) return node;
    return *mesh->name ? mesh->name : "part";
}

/* Returns the name with the first free number, and sets *slot to its empty slot. NULL without memory. */
static const char *make_unique(struct listing *l, uint32_t *slot)
{
    enum { NUMBER_SIZE = 12 };
    const uint32_t first = l->slots[*slot] - 1;
    const char *name = l->parts[first].name;
    const size_t length = strlen(name);
    char *made = zr_arena_alloc(l->arena, length + NUMBER_SIZE, 1);
    if (!made) return NULL;
    memcpy(made, name, length);
    uint32_t number = l->last[first] ? l->last[first] : 1;
    do {
        snprintf(made + length, NUMBER_SIZE, ".%" PRIu32, ++number);
        *slot = slot_of(l->parts, l->slots, l->slot_count, made);
    } while (l->slots[*slot] != 0);
    l->last[first] = number;
    return made;
}

/* Adds a part to the list. False without memory, or if cancelled. */
static bool add(struct listing *l, const struct zr_scene *scene, uint32_t count, struct zr_part part)
{
    if (zr_is_cancelled(l->arena->cancel)) return false;
    part.name = given_name(scene, &part);
    uint32_t slot = slot_of(l->parts, l->slots, l->slot_count, part.name);
    if (l->slots[slot] != 0) part.name = make_unique(l, &slot);
    l->parts[count] = part;
    l->slots[slot] = count + 1;
    return part.name != NULL;
}

static uint64_t count_all(const struct zr_scene *scene)
{
    uint64_t total = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        total += zr_mesh_part_count(&scene->meshes[scene->instances[i].mesh]);
    return total;
}

struct zr_part_list zr_part_list_make(struct zr_arena *arena, const struct zr_scene *scene, uint32_t most)
{
    const uint64_t total = count_all(scene);
    const uint32_t wanted = total < most ? (uint32_t)total : most;
    struct listing l = {.arena = arena, .slot_count = 2 * wanted + 1};
    uint32_t count = 0;
    l.parts = zr_arena_alloc(arena, wanted, sizeof *l.parts);
    l.slots = zr_arena_zero(arena, l.slot_count, sizeof *l.slots);
    l.last = zr_arena_zero(arena, wanted, sizeof *l.last);
    if (!zr_arena_ok(arena)) return (struct zr_part_list){.total = total};
    for (uint32_t i = 0; i < scene->instance_count && count < wanted; i++) {
        const uint32_t mesh = scene->instances[i].mesh, parts = zr_mesh_part_count(&scene->meshes[mesh]);
        for (uint32_t number = 0; number < parts && count < wanted; number++)
            if (!add(&l, scene, count++, (struct zr_part){NULL, i, mesh, number}))
                return (struct zr_part_list){.total = total};
    }
    return (struct zr_part_list){count, total, l.parts, l.slot_count, l.slots};
}

const struct zr_part *zr_part_list_find(const struct zr_part_list *list, const char *name)
{
    if (list->count == 0) return NULL;
    const uint32_t found = list->slots[slot_of(list->at, list->slots, list->slot_count, name)];
    return found ? &list->at[found - 1] : NULL;
}
