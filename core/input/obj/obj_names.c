/* Parts and materials of faces, from the names that o, g and usemtl give. */
#include <string.h>

#include "base/cancel.h"
#include "base/hash.h"
#include "input/obj/mtl.h"
#include "input/obj/obj_file.h"
#include "input/text/text.h"
#include "render_request.h"

enum {
    PARTS_AT_FIRST = 16,
    PROBES_MAX = 256, /* names that collide more often become separate parts */
    NAME_BYTES = 128, /* limit for an object's or a group's name within a part's name */
    NAMES_PER_CANCEL_CHECK = 256
};

/* ---- material libraries ---- */

/* The rest of a statement: a name, without blanks at its ends. */
static struct zr_obj_statement name_of(struct zr_obj_statement statement)
{
    zr_obj_word(&statement);
    zr_obj_skip_blanks(&statement);
    while (statement.end > statement.at && zr_obj_is_blank(statement.end[-1]))
        statement.end--;
    return statement;
}

static bool add_library(struct zr_mtl *mtl, const struct zr_obj_statement *name)
{
    return zr_mtl_add(mtl, name->at, (size_t)(name->end - name->at));
}

static size_t count_names(struct zr_obj_statement name)
{
    size_t count = 0;
    while (name.at < name.end) {
        const struct zr_obj_statement word = zr_obj_word(&name);
        if (word.at == word.end) break;
        count += zr_mtl_is_file_name(word.at, word.end);
        zr_obj_skip_blanks(&name);
    }
    return count;
}

/* Adds the files of one mtllib. The rest of the line is one name, possibly with blanks, unless several of its words end
 * in .mtl. If there is no such file, each word is a name. */
static void add_libraries(struct zr_obj_file *file, const struct zr_obj_statement *statement)
{
    struct zr_obj_statement name = name_of(*statement);
    size_t found = 0, missing = 0;
    if (count_names(name) < 2 && add_library(file->mtl, &name)) return;
    for (; name.at < name.end && zr_mtl_status(file->mtl) == ZR_OK; zr_obj_skip_blanks(&name)) {
        const struct zr_obj_statement word = zr_obj_word(&name);
        if (word.at == word.end) break;
        if (add_library(file->mtl, &word))
            found++;
        else
            missing++;
    }
    if (found == 0) missing = 1;
    if (missing == 0) return;
    if (file->missing_libraries.count == 0) file->missing_libraries.first = *statement;
    file->missing_libraries.count += missing;
}

static void read_libraries(struct zr_obj_file *file, size_t index)
{
    struct zr_obj_text text = {file->texts[index].at, file->texts[index].end, file->parts[index].before.lines + 1};
    struct zr_obj_statement statement, word;
    while (zr_mtl_status(file->mtl) == ZR_OK && zr_obj_next(&text, &statement)) {
        struct zr_obj_statement rest = statement;
        if (zr_obj_at_end(&rest)) continue;
        if (zr_obj_next_keyword(&rest, &word) == ZR_OBJ_LIBRARY) add_libraries(file, &statement);
    }
}

enum zr_status zr_obj_open_materials(struct zr_obj_file *file, struct zr_scene_builder *builder,
                                     const struct zr_request *request, struct zr_error *error)
{
    if (file->total.libraries == 0) return ZR_OK;
    file->mtl = zr_mtl_open(builder, request, file->limits, error);
    if (!file->mtl) return ZR_NO_MEMORY;
    for (size_t i = 0; i < file->part_count && zr_mtl_status(file->mtl) == ZR_OK; i++) {
        if (zr_is_cancelled(request->cancel)) return ZR_CANCELLED;
        if (file->parts[i].holds.libraries > 0) read_libraries(file, i);
    }
    if (zr_mtl_status(file->mtl) == ZR_OK && zr_mtl_file_count(file->mtl) == 0)
        file->only_library = zr_mtl_add_only(file->mtl);
    const enum zr_status status = zr_mtl_status(file->mtl);
    if (status == ZR_OK && zr_mtl_file_count(file->mtl) == 0) file->mtl = NULL;
    return status;
}

/* ---- parts ---- */

/* A part: the names of an object and a group. */
struct part {
    struct zr_obj_statement object, group; /* empty: none */
    uint32_t hash;
};

struct naming {
    struct zr_obj_file *file;
    struct zr_arena *arena;
    struct part *parts;
    uint32_t *slots; /* hash table of 2 * part_room parts; UINT32_MAX: empty */
    uint32_t part_count, part_room;
    uint32_t *face_parts;     /* NULL: no o or g yet */
    uint32_t *face_materials; /* NULL: all faces so far have `material` */
    uint32_t material;
    bool has_material; /* a face has a material */
};

/* Hashes a name and its end. */
static uint32_t hash_name(uint32_t value, const struct zr_obj_statement *name)
{
    for (const char *at = name->at; at < name->end; at++)
        value = zr_hash_byte(value, (uint8_t)*at);
    return zr_hash_byte(value, 0xFF);
}

static bool is_same(const struct zr_obj_statement *a, const struct zr_obj_statement *b)
{
    const size_t length = (size_t)(a->end - a->at);
    return length == (size_t)(b->end - b->at) && (length == 0 || memcmp(a->at, b->at, length) == 0);
}

/* Returns the slot of the part, or an empty one; NULL after PROBES_MAX others. */
static uint32_t *find_slot(const struct naming *naming, const struct part *part)
{
    const uint32_t mask = 2 * naming->part_room - 1;
    uint32_t slot = (part->hash ^ part->hash >> 15) & mask;
    for (int i = 0; i < PROBES_MAX; i++, slot = (slot + 1) & mask) {
        if (naming->slots[slot] == UINT32_MAX) return &naming->slots[slot];
        const struct part *other = &naming->parts[naming->slots[slot]];
        if (other->hash == part->hash && is_same(&other->object, &part->object) && is_same(&other->group, &part->group))
            return &naming->slots[slot];
    }
    return NULL;
}

static bool grow(struct naming *naming)
{
    const uint32_t room = naming->part_room ? 2 * naming->part_room : PARTS_AT_FIRST;
    struct part *more = zr_arena_grow(naming->arena, naming->parts, naming->part_count, room, sizeof *more);
    uint32_t *slots = zr_arena_alloc(naming->arena, 2 * (size_t)room, sizeof *slots);
    if (!more || !slots) return false;
    memset(slots, 0xFF, 2 * (size_t)room * sizeof *slots);
    naming->parts = more;
    naming->slots = slots;
    naming->part_room = room;
    for (uint32_t i = 0; i < naming->part_count; i++) {
        uint32_t *slot = find_slot(naming, &more[i]);
        if (slot) *slot = i;
    }
    return true;
}

/* Returns the number of the part of these names, 0 without memory. */
static uint32_t find_part(struct naming *naming, const struct zr_obj_statement *object,
                          const struct zr_obj_statement *group)
{
    const struct part part = {*object, *group, hash_name(hash_name(ZR_HASH_BEGIN, object), group)};
    if (naming->part_count == naming->part_room && !grow(naming)) return 0;
    uint32_t *slot = find_slot(naming, &part);
    if (slot && *slot != UINT32_MAX) return *slot;
    naming->parts[naming->part_count] = part;
    if (slot) *slot = naming->part_count;
    return naming->part_count++;
}

/* Sets entries begin .. end - 1. */
static void fill(uint32_t *out, size_t begin, size_t end, uint32_t value)
{
    for (size_t i = begin; i < end; i++)
        out[i] = value;
}

static bool put_material(struct naming *naming, size_t begin, size_t end, uint32_t material)
{
    const size_t faces = naming->file->total.faces;
    if (!naming->has_material) naming->material = material;
    naming->has_material = true;
    if (naming->face_materials) fill(naming->face_materials, begin, end, material);
    if (naming->face_materials || material == naming->material) return true;
    naming->face_materials = zr_arena_alloc(naming->arena, faces, sizeof *naming->face_materials);
    if (!naming->face_materials) return false;
    fill(naming->face_materials, 0, begin, naming->material);
    fill(naming->face_materials, begin, end, material);
    return true;
}

/* ---- names ---- */

/* Names that apply to the next faces. */
struct state {
    struct zr_obj_statement object, group, use;
    bool has_part, has_use;
};

static void take(const struct zr_obj_name *name, struct state *state)
{
    static const char NONE[] = "default"; /* the format's name for no group */
    struct zr_obj_statement statement = {name->at, name->at + name->length, 0};
    const struct zr_obj_statement given = name_of(statement);
    switch (*name->at) {
    case 'o':
        state->object = given;
        state->group = (struct zr_obj_statement){given.end, given.end, 0};
        state->has_part = true;
        break;
    case 'g':
        state->group = given;
        if ((size_t)(given.end - given.at) == sizeof NONE - 1 && memcmp(given.at, NONE, sizeof NONE - 1) == 0)
            state->group.end = state->group.at;
        state->has_part = true;
        break;
    default:
        state->use = given;
        state->has_use = true;
        break;
    }
}

static void note_missing(struct zr_obj_file *file, const struct zr_obj_statement *use)
{
    struct zr_obj_noted *noted = &file->missing_materials;
    if (noted->count++ > 0) return;
    noted->first = *use;
    noted->first.line = 1;
    for (const char *at = file->at; at < use->at && (at = memchr(at, '\n', (size_t)(use->at - at))) != NULL; at++)
        noted->first.line++;
}

/* Gives the faces begin .. end - 1 their part and their material. */
static bool name_run(struct naming *naming, size_t begin, size_t end, const struct state *state)
{
    struct zr_obj_file *file = naming->file;
    if (begin == end) return true;
    if (naming->face_parts) fill(naming->face_parts, begin, end, find_part(naming, &state->object, &state->group));
    const uint32_t material = state->has_use && file->mtl
                                  ? zr_mtl_use(file->mtl, state->use.at, (size_t)(state->use.end - state->use.at))
                                  : ZR_MODEL_MATERIAL_NONE;
    const bool is_sought = file->mtl || file->total.libraries == 0;
    if (state->has_use && is_sought && material == ZR_MODEL_MATERIAL_NONE) note_missing(file, &state->use);
    return (!file->mtl || put_material(naming, begin, end, material)) && zr_arena_ok(naming->arena);
}

static bool has_parts(const struct zr_obj_file *file)
{
    for (size_t i = 0; i < file->total.names; i++)
        if (*file->names[i].at != 'u') return file->total.faces > 0;
    return false;
}

static enum zr_status name_all(struct naming *naming)
{
    const struct zr_obj_file *file = naming->file;
    struct state state = {.has_use = false};
    size_t begin = 0;
    if (has_parts(file)) {
        naming->face_parts = zr_arena_alloc(naming->arena, file->total.faces, sizeof *naming->face_parts);
        if (!naming->face_parts) return ZR_NO_MEMORY;
    }
    for (size_t i = 0; i < file->total.names; i++) {
        if (i % NAMES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
        if (!name_run(naming, begin, file->names[i].face, &state)) return ZR_NO_MEMORY;
        if (file->mtl && zr_mtl_status(file->mtl) != ZR_OK) return zr_mtl_status(file->mtl);
        begin = file->names[i].face;
        take(&file->names[i], &state);
    }
    if (!name_run(naming, begin, file->total.faces, &state)) return ZR_NO_MEMORY;
    if (file->mtl && zr_mtl_status(file->mtl) == ZR_OK) zr_mtl_make_used(file->mtl);
    return file->mtl ? zr_mtl_status(file->mtl) : ZR_OK;
}

/* ---- names of parts ---- */

/* Copies a name, cut at a whole character, with '?' for bytes that are not UTF-8. Returns its length. */
static size_t copy_name(const struct zr_obj_statement *name, char *out)
{
    size_t used = 0;
    for (const char *at = name->at; at < name->end;) {
        const size_t length = zr_utf8_length(at, name->end), taken = length ? length : 1;
        if (used + taken > NAME_BYTES) break;
        if (length && *at)
            memcpy(out + used, at, length);
        else
            out[used] = '?';
        used += taken;
        at += taken;
    }
    return used;
}

/* Writes "object/group", or the only name that is given. Returns its length, without the final zero. */
static size_t join_names(const struct part *part, char out[2 * NAME_BYTES + 2])
{
    size_t used = copy_name(&part->object, out);
    if (used > 0 && part->group.at < part->group.end) out[used++] = '/';
    used += copy_name(&part->group, out + used);
    out[used] = '\0';
    return used;
}

static bool put_parts(struct naming *naming, struct zr_mesh *mesh)
{
    const char **names = zr_arena_alloc(naming->arena, naming->part_count, sizeof *names);
    char name[2 * NAME_BYTES + 2], *text = NULL;
    size_t bytes = 0;
    for (uint32_t i = 0; i < naming->part_count; i++)
        bytes += join_names(&naming->parts[i], name) + 1;
    if (names) text = zr_arena_alloc(naming->arena, bytes, 1);
    for (uint32_t i = 0; text && i < naming->part_count; i++) {
        names[i] = text;
        text += join_names(&naming->parts[i], text) + 1;
    }
    if (!text) return false;
    mesh->face_parts = naming->face_parts;
    mesh->part_count = naming->part_count;
    mesh->part_names = names;
    return true;
}

/* ---- materials of the scene ---- */

static bool put_materials(struct naming *naming, struct zr_scene_builder *builder)
{
    struct zr_model_scene *made = zr_mtl_made(naming->file->mtl);
    uint32_t *material = zr_arena_alloc(naming->arena, 1, sizeof *material);
    const uint32_t **faces = zr_arena_alloc(naming->arena, 1, sizeof *faces);
    struct zr_instance *instance = zr_arena_zero(naming->arena, 1, sizeof *instance);
    if (!material || !faces || !instance) return false;
    *material = naming->face_materials || !naming->has_material ? ZR_MODEL_MATERIAL_NONE : naming->material;
    *faces = naming->face_materials;
    instance->object_to_world = zr_mat4_identity();
    made->instances = instance;
    made->instance_count = 1;
    made->mesh_materials = material;
    made->face_materials = faces;
    builder->file = made;
    return true;
}

enum zr_status zr_obj_name_faces(struct zr_obj_file *file, struct zr_scene_builder *builder, struct zr_mesh *mesh)
{
    struct naming naming = {.file = file, .arena = builder->arena, .material = ZR_MODEL_MATERIAL_NONE};
    const enum zr_status status = name_all(&naming);
    if (status != ZR_OK) return status;
    if (naming.face_parts && !put_parts(&naming, mesh)) return ZR_NO_MEMORY;
    if (!file->mtl) return ZR_OK;
    if (!put_materials(&naming, builder)) return ZR_NO_MEMORY;
    return zr_obj_put_texcoords(file, builder->arena, mesh, naming.face_materials, naming.material);
}
