#include "input/query/part_select.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "input/text/nearest.h"
#include "input/text/text.h"
#include "scene/parts/part_colors.h"
#include "scene/parts/part_edit.h"

/* STEPS_MAX: limit of compared characters. STEPS_PER_CANCEL_CHECK: compared characters between checks for cancellation.
 */
#define STEPS_MAX (UINT64_C(1) << 28)
enum { STEPS_PER_CANCEL_CHECK = 1 << 16 };

/* Number of names among which a hint is searched. */
enum { NAMES_OFFERED = 1000 };

/* Whether a set has a part: not, by a pattern, or by its name or id. */
enum mark { UNMARKED, MATCHED, NAMED };

struct selecting {
    struct zr_scene_builder *builder;
    const struct zr_part_list *list;
    struct zr_error *error;
    uint8_t *marks; /* per part: enum mark, of the set that is matched now */
    uint64_t steps;
    bool is_over;      /* too many steps */
    bool is_cancelled; /* some names were not compared */
};

/* ---- patterns ---- */

static bool goes_on(struct selecting *s)
{
    if (++s->steps % STEPS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(s->builder->arena->cancel)) s->is_cancelled = true;
    return !s->is_cancelled && s->steps < STEPS_MAX;
}

static const char *behind_character(const char *at)
{
    do
        at++;
    while (((unsigned char)*at & 0xC0) == 0x80);
    return at;
}

/* True if the pattern matches the whole name. After a mismatch, the last * matches one more byte. */
static bool matches(struct selecting *s, const char *pattern, const char *name)
{
    const char *star = NULL, *from = name;
    while (*name) {
        if (!goes_on(s)) return false;
        if (*pattern == '*') {
            star = ++pattern;
            from = name;
        } else if (*pattern == '?') {
            pattern++;
            name = behind_character(name);
        } else if (*pattern == *name) {
            pattern++;
            name++;
        } else if (star) {
            pattern = star;
            name = ++from;
        } else {
            return false;
        }
    }
    while (*pattern == '*')
        pattern++;
    return !*pattern;
}

/* Returns the id that a text of digits gives, or 0 for another text. */
static double id_of_text(const char *text)
{
    double id = 0.0;
    for (; *text >= '0' && *text <= '9'; text++)
        id = id < 1e9 ? 10.0 * id + (double)(*text - '0') : id;
    return *text ? 0.0 : id;
}

/* ---- faults ---- */

struct pointer {
    char text[ZR_POINTER_SIZE];
};

static struct pointer pointer_of(const struct zr_part_set *set, uint32_t number)
{
    struct pointer pointer;
    if (set->is_list)
        snprintf(pointer.text, sizeof pointer.text, "%.140s/%" PRIu32, set->pointer, number);
    else
        snprintf(pointer.text, sizeof pointer.text, "%s", set->pointer);
    return pointer;
}

/* The first names of the list, for a message. */
struct names {
    char text[240];
};

static struct names list_first(const struct zr_part_list *list)
{
    enum { NAMES_SHOWN = 6, ROOM_OF_NAME = 34, ROOM_OF_REST = 24 };
    struct names names = {""};
    size_t used = 0;
    uint32_t shown = 0;
    for (; shown < list->count && shown < NAMES_SHOWN; shown++) {
        const char *name = list->at[shown].name;
        if (strlen(name) > ROOM_OF_NAME || used + ROOM_OF_NAME + ROOM_OF_REST > sizeof names.text) break;
        used += (size_t)snprintf(names.text + used, sizeof names.text - used, "%s%s", shown > 0 ? ", " : "",
                                 zr_quote(name, strlen(name)).text);
    }
    if (shown < list->count)
        snprintf(names.text + used, sizeof names.text - used, "%s%" PRIu32 " %s", shown > 0 ? " and " : "",
                 list->count - shown, shown > 0 ? "more" : "with long names");
    return names;
}

static void refuse_text(struct selecting *s, const struct zr_part_set *set, uint32_t number)
{
    const char *text = set->patterns[number].text;
    const bool is_pattern = strpbrk(text, "*?") != NULL;
    struct zr_nearest nearest = {.word = text};
    for (uint32_t p = 0; !is_pattern && p < s->list->count && p < NAMES_OFFERED; p++)
        zr_nearest_offer(&nearest, s->list->at[p].name);
    zr_error_add(s->error, ZR_BAD_SCENE, pointer_of(set, number).text, "no part has %s %s%s; parts: %s",
                 is_pattern               ? "a name like"
                 : id_of_text(text) > 0.0 ? "the name or the id"
                                          : "the name",
                 zr_quote(text, strlen(text)).text, zr_nearest_text(&nearest).text, list_first(s->list).text);
}

static void refuse_id(struct selecting *s, const struct zr_part_set *set, uint32_t number)
{
    zr_error_add(s->error, ZR_BAD_SCENE, pointer_of(set, number).text,
                 "no part has the id %.0f: the ids are 1 to %" PRIu32, set->patterns[number].id, s->list->count);
}

/* ---- sets ---- */

static bool mark_id(struct selecting *s, double id)
{
    if (!(id >= 1.0 && id <= (double)s->list->count)) return false;
    s->marks[(uint32_t)id - 1] = NAMED;
    return true;
}

/* Marks the part with this name or id, or the parts whose names match the pattern. False if there is none. */
static bool mark_text(struct selecting *s, const char *text)
{
    bool is_found = false;
    const struct zr_part *exact = zr_part_list_find(s->list, text);
    if (exact) {
        s->marks[exact - s->list->at] = NAMED;
        return true;
    }
    if (!strpbrk(text, "*?")) return mark_id(s, id_of_text(text));
    for (uint32_t p = 0; p < s->list->count && goes_on(s); p++)
        if (matches(s, text, s->list->at[p].name)) {
            is_found = true;
            if (s->marks[p] == UNMARKED) s->marks[p] = MATCHED;
        }
    return is_found;
}

/* Marks the parts of a set, and no others. Reports names, patterns and ids that match no part. */
static void mark(struct selecting *s, const struct zr_part_set *set)
{
    memset(s->marks, 0, s->list->count);
    for (uint32_t i = 0; i < set->count && !s->is_over && !s->is_cancelled; i++) {
        const struct zr_part_pattern *pattern = &set->patterns[i];
        const bool is_found = pattern->text ? mark_text(s, pattern->text) : mark_id(s, pattern->id);
        if (s->steps >= STEPS_MAX) {
            s->is_over = true;
            zr_error_add(s->error, ZR_BAD_SCENE, pointer_of(set, i).text,
                         "comparing the patterns with %" PRIu32 " names takes too long; names without * are fast",
                         s->list->count);
        } else if (!is_found && pattern->text) {
            refuse_text(s, set, i);
        } else if (!is_found) {
            refuse_id(s, set, i);
        }
    }
}

/* Lists the colours of styles: zr_part_colors, then the colours of highlights. */
static zr_vec4 *list_colors(struct zr_arena *arena, const struct zr_part_keys *keys)
{
    zr_vec4 *colors = zr_arena_alloc(arena, ZR_PART_COLORS + keys->highlight_count, sizeof *colors);
    if (!colors) return NULL;
    memcpy(colors, zr_part_colors, sizeof zr_part_colors);
    for (uint32_t i = 0; i < keys->highlight_count; i++)
        colors[ZR_PART_COLORS + i] = keys->highlights[i].color;
    return colors;
}

static uint32_t style_of_color(uint32_t number)
{
    return (number + 1) << ZR_PART_COLOR_SHIFT;
}

static bool is_highlighted(uint32_t style)
{
    return style >> ZR_PART_COLOR_SHIFT > ZR_PART_COLORS;
}

static void set_styles(struct selecting *s, const struct zr_part_keys *keys, uint32_t *styles)
{
    const uint32_t count = s->list->count;
    for (uint32_t p = 0; keys->colors == ZR_COLORS_PARTS && p < count; p++)
        styles[p] = style_of_color(zr_part_color_of(s->list->at[p].name));
    for (uint32_t i = 0; i < keys->highlight_count; i++) {
        mark(s, &keys->highlights[i].parts);
        for (uint32_t p = 0; p < count; p++)
            if (s->marks[p]) styles[p] = style_of_color(ZR_PART_COLORS + i);
    }
    mark(s, &keys->ghost);
    for (uint32_t p = 0; p < count; p++)
        if (s->marks[p] == NAMED || (s->marks[p] == MATCHED && !is_highlighted(styles[p]))) styles[p] |= ZR_PART_GHOST;
    mark(s, &keys->isolate);
    for (uint32_t p = 0; keys->isolate.count > 0 && p < count; p++)
        if (!s->marks[p]) styles[p] |= ZR_PART_HIDDEN;
    mark(s, &keys->hide);
    for (uint32_t p = 0; p < count; p++)
        if (s->marks[p]) styles[p] |= ZR_PART_HIDDEN;
}

/* ---- combined solids ---- */

/* Numbers the parts of operands, and adds the styles of operands and tools. */
static void set_operands(struct selecting *s, const struct zr_csg_keys *keys, struct zr_csg_step *steps, uint8_t *parts,
                         struct zr_csg *csg, uint32_t *styles)
{
    const uint32_t count = s->list->count;
    for (uint32_t i = 0; i < keys->count && !s->is_over && !s->is_cancelled; i++) {
        const struct zr_csg_key *key = &keys->steps[i];
        steps[i] = (struct zr_csg_step){.op = key->op};
        if (key->op != ZR_CSG_PARTS) continue;
        mark(s, &key->parts);
        for (uint32_t p = 0; p < count; p++) {
            if (!s->marks[p]) continue;
            if (parts[p] == 0 && csg->part_count < ZR_CSG_PARTS_MAX) parts[p] = (uint8_t)(1 + csg->part_count);
            if (parts[p] == csg->part_count + 1) styles[p] |= ZR_PART_OPERAND | ZR_PART_TOOL, csg->part_count++;
            if (!key->is_tool) styles[p] &= ~(uint32_t)ZR_PART_TOOL;
            if (parts[p] > 0) {
                steps[i].parts |= UINT64_C(1) << (parts[p] - 1);
                continue;
            }
            zr_error_add(s->error, ZR_BAD_SCENE, key->parts.pointer, "the operands have more than %d parts",
                         ZR_CSG_PARTS_MAX);
            return;
        }
    }
    csg->step_count = keys->count;
}

static void check_operands(const struct selecting *s, const struct zr_part_keys *keys, const uint32_t *styles)
{
    if (keys->explode != 0.0)
        zr_error_add(s->error, ZR_BAD_SCENE, "/explode", "cannot be combined with csg, whose operands overlap");
    for (uint32_t p = 0; p < s->list->count; p++) {
        if (!(styles[p] & ZR_PART_OPERAND) || !(styles[p] & ZR_PART_GHOST)) continue;
        zr_error_add(s->error, ZR_BAD_SCENE, keys->ghost.pointer,
                     "the part %s is an operand of csg; a second node with its mesh can be a ghost",
                     zr_quote(s->list->at[p].name, strlen(s->list->at[p].name)).text);
        return;
    }
}

/* Reads the key csg into the scene, and adds the styles of its parts. */
static bool select_operands(struct selecting *s, const struct zr_part_keys *keys, uint32_t *styles)
{
    struct zr_scene *scene = s->builder->scene;
    struct zr_arena *arena = s->builder->arena;
    struct zr_csg *csg = zr_arena_zero(arena, 1, sizeof *csg);
    struct zr_csg_step *steps = zr_arena_alloc(arena, keys->csg.count, sizeof *steps);
    uint8_t *parts = zr_arena_zero(arena, s->list->count, sizeof *parts);
    uint32_t *first_parts = zr_arena_alloc(arena, scene->instance_count, sizeof *first_parts), first = 0;
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        first_parts[i] = first;
        first += zr_mesh_part_count(&scene->meshes[scene->instances[i].mesh]);
    }
    set_operands(s, &keys->csg, steps, parts, csg, styles);
    check_operands(s, keys, styles);
    for (uint32_t p = 0; p < s->list->count; p++)
        if (parts[p] > 0 && styles[p] & ZR_PART_TOOL) csg->tools |= UINT64_C(1) << (parts[p] - 1);
    csg->steps = steps;
    csg->parts = parts;
    csg->first_parts = first_parts;
    scene->csg = csg;
    return true;
}

/* ---- checks ---- */

/* True if the scene has lines or points that belong to no part. */
static bool has_rest(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->instance_count; i++)
        if (zr_mesh_has_rest(&scene->meshes[scene->instances[i].mesh])) return true;
    return false;
}

static void check_shown(const struct selecting *s, const struct zr_part_keys *keys, const uint32_t *styles)
{
    if (s->error->count > 0 || (keys->isolate.count == 0 && has_rest(s->builder->scene))) return;
    for (uint32_t p = 0; p < s->list->count; p++)
        if (!(styles[p] & ZR_PART_HIDDEN)) return;
    zr_error_add(s->error, ZR_BAD_SCENE, keys->hide.count > 0 ? keys->hide.pointer : keys->isolate.pointer,
                 "no part is left to draw");
}

static void check_colors(const struct selecting *s, const struct zr_part_keys *keys)
{
    if (keys->colors == ZR_COLORS_PARTS && s->builder->scene->color_bar.is_on)
        zr_error_add(
            s->error, ZR_BAD_SCENE, "/colors",
            "parts cannot be combined with colorBar: colours of parts replace the colours that the bar explains");
}

static bool check_count(const struct zr_part_list *list, struct zr_error *error)
{
    if (list->total <= ZR_PARTS_SELECTED_MAX) return true;
    zr_error_add(error, ZR_BAD_SCENE, NULL,
                 "%" PRIu64 " parts; hide, isolate, ghost, highlight, explode and colors allow up to %d", list->total,
                 ZR_PARTS_SELECTED_MAX);
    return false;
}

/* ---- the edit ---- */

static void warn_of_rest(struct zr_scene_builder *builder, bool moves)
{
    const struct zr_part_keys *keys = &builder->scene->parts;
    static const char *const along[] = {"", " along x", " along y", " along z"};
    if (keys->explode != 0.0 && !moves)
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "explode moves nothing: the middles of all parts are the same%s",
                            along[keys->explode_axis]);
    builder->scene->warnings = builder->warnings.texts;
    builder->scene->warning_count = (uint32_t)builder->warnings.count;
}

static enum zr_status edit(struct selecting *s, struct zr_part_edit *edit)
{
    struct zr_scene_builder *builder = s->builder;
    bool moves = false;
    uint32_t instance;
    if (builder->scene->parts.explode != 0.0) {
        edit->offsets = zr_part_offsets_find(builder->arena, builder->scene, s->list, &moves);
        if (!edit->offsets) return ZR_NO_MEMORY;
        if (!moves) edit->offsets = NULL;
    }
    warn_of_rest(builder, moves);
    switch (zr_part_edit(builder, edit, &instance)) {
    case ZR_PART_EDIT_DONE:
        return zr_arena_ok(builder->arena) ? ZR_OK : ZR_NO_MEMORY;
    case ZR_PART_EDIT_FLAT:
        return zr_error_add(s->error, ZR_BAD_SCENE, "/explode",
                            "the matrix of instance %" PRIu32 " flattens its mesh, so the parts cannot move",
                            instance + 1);
    default:
        return ZR_NO_MEMORY;
    }
}

enum zr_status zr_parts_apply(struct zr_scene_builder *builder, struct zr_error *error)
{
    const struct zr_part_keys *keys = &builder->scene->parts;
    if (!zr_part_keys_are_given(keys)) return ZR_OK;
    struct zr_arena *arena = builder->arena;
    const struct zr_part_list list = zr_part_list_make(arena, builder->scene, ZR_PARTS_SELECTED_MAX);
    struct selecting s = {.builder = builder, .list = &list, .error = error};
    if (!zr_arena_ok(arena) || zr_is_cancelled(arena->cancel)) return ZR_NO_MEMORY;
    if (!check_count(&list, error)) return ZR_BAD_SCENE;
    if (list.count == 0) return ZR_OK; /* zr_scene_validate refuses it */
    uint32_t *styles = zr_arena_zero(arena, list.count, sizeof *styles);
    struct zr_part_edit made = {
        .list = &list, .styles = styles, .colors = list_colors(arena, keys), .hides_rest = keys->isolate.count > 0};
    s.marks = zr_arena_alloc(arena, list.count, sizeof *s.marks);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    set_styles(&s, keys, styles);
    if (keys->csg.count > 0 && !select_operands(&s, keys, styles)) return ZR_NO_MEMORY;
    if (s.is_cancelled) return ZR_NO_MEMORY;
    check_shown(&s, keys, styles);
    check_colors(&s, keys);
    if (error->count > 0) return ZR_BAD_SCENE;
    return edit(&s, &made);
}

/* ---- sections ---- */

enum zr_status zr_parts_check_uncut(struct zr_scene_builder *builder, struct zr_error *error)
{
    const struct zr_sections *sections = &builder->scene->sections;
    if (sections->uncut_count == 0) return ZR_OK;
    const struct zr_part_list list = zr_part_list_make(builder->arena, builder->scene, ZR_PARTS_SELECTED_MAX);
    struct selecting s = {.builder = builder, .list = &list, .error = error};
    if (!zr_arena_ok(builder->arena) || zr_is_cancelled(builder->arena->cancel)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < sections->uncut_count && list.count < ZR_PARTS_SELECTED_MAX; i++) {
        const struct zr_part_pattern pattern = {.text = sections->uncut[i]};
        char pointer[ZR_POINTER_SIZE];
        snprintf(pointer, sizeof pointer, "/sections/uncut/%" PRIu32, i);
        const struct zr_part_set set = {.count = 1, .patterns = &pattern, .pointer = pointer};
        if (!zr_part_list_find(&list, pattern.text)) refuse_text(&s, &set, 0);
    }
    return error->count > 0 ? ZR_BAD_SCENE : ZR_OK;
}
