#include "output/masks.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/cancel.h"
#include "base/matrix.h"
#include "output/bytes/bit_mask.h"
#include "output/bytes/buffer.h"
#include "output/images/mask_png.h"
#include "output/json/camera_json.h"
#include "output/zip.h"
#include "scene/picture.h"

static struct zr_bit_mask bits_of(const struct zr_frame *frame, const struct zr_instance_mask *mask,
                                  const uint64_t *bits)
{
    return (struct zr_bit_mask){.width = frame->width,
                                .height = frame->height,
                                .top = mask->amodal.box[1],
                                .bottom = mask->amodal.box[3],
                                .left = mask->left,
                                .words = mask->words,
                                .bits = bits};
}

/* ---- run lengths ----
 *
 * As COCO writes them: pixels are counted column by column, each from the top. Runs of 0 and 1 alternate, and the first
 * is of 0. From the fourth run on, the difference to the run before the last is written. A number has groups of five
 * bits, the lowest first; bit 5 is set if another follows, and bit 4 of the last is its sign. A group is the character
 * 48 + its value. */

enum { COLUMNS = 64 };

/* Runs written so far. An edge is a pixel that differs from the one before it, in the order of columns. */
struct runs {
    struct zr_buffer *out;
    uint64_t edge;   /* the last one, not yet written */
    bool has_edge;   /* else there is none */
    uint64_t begin;  /* of the run that ends at the edge */
    int64_t last[2]; /* the last two runs, the later one first */
    uint32_t count;
};

static void put_number(struct zr_buffer *out, int64_t value)
{
    bool has_more = true;
    while (has_more) {
        uint8_t group = value & 31;
        value = (value - group) / 32;
        has_more = group & 16 ? value != -1 : value != 0;
        group = (uint8_t)(48 + (has_more ? group | 32 : group));
        zr_buffer_add(out, &group, 1);
    }
}

static void put_run(struct runs *runs, uint64_t length)
{
    put_number(runs->out, (int64_t)length - (runs->count > 2 ? runs->last[1] : 0));
    runs->last[1] = runs->last[0];
    runs->last[0] = (int64_t)length;
    runs->count++;
}

static void flush_edge(struct runs *runs)
{
    if (!runs->has_edge) return;
    put_run(runs, runs->edge - runs->begin);
    runs->begin = runs->edge;
    runs->has_edge = false;
}

/* Two edges at one place are none: the end of a column meets the beginning of the next. */
static void add_edge(struct runs *runs, uint64_t at)
{
    if (runs->has_edge && runs->edge == at) {
        runs->has_edge = false;
        return;
    }
    flush_edge(runs);
    runs->edge = at;
    runs->has_edge = true;
}

/* Returns the size of an array of edges for masks of up to `rows` rows. */
static size_t edges_room(uint32_t rows)
{
    return COLUMNS * ((size_t)rows + 1);
}

/* Lists the rows of the edges of each column of a word. */
static void find_edges(const struct zr_bit_mask *mask, uint32_t word, size_t room, uint32_t *edges,
                       uint32_t counts[COLUMNS])
{
    uint64_t above = 0;
    for (uint32_t y = mask->top; y <= mask->bottom; y++) {
        const uint64_t bits = y < mask->bottom ? zr_bit_mask_row(mask, y)[word] : 0;
        for (uint64_t changed = bits ^ above; changed != 0; changed &= changed - 1) {
            const uint32_t column = (uint32_t)__builtin_ctzll(changed);
            edges[column * room + counts[column]++] = y;
        }
        above = bits;
    }
}

/* Appends the text, without a final zero. Returns false once the arena has failed. `edges` is overwritten. */
static bool write_runs(const struct zr_bit_mask *mask, uint32_t *edges, struct zr_buffer *out)
{
    const size_t room = (size_t)(mask->bottom - mask->top) + 1;
    const uint64_t pixels = (uint64_t)mask->width * mask->height;
    struct runs runs = {.out = out};
    for (uint32_t word = 0; word < mask->words; word++) {
        uint32_t counts[COLUMNS] = {0};
        find_edges(mask, word, room, edges, counts);
        for (uint32_t column = 0; column < COLUMNS; column++)
            for (uint32_t i = 0; i < counts[column]; i++)
                add_edge(&runs, (uint64_t)(mask->left + 64 * word + column) * mask->height + edges[column * room + i]);
    }
    if (runs.has_edge && runs.edge == pixels) runs.has_edge = false;
    flush_edge(&runs);
    put_run(&runs, pixels - runs.begin);
    return zr_arena_ok(out->arena);
}

/* ---- JSON ---- */

struct printing {
    struct zr_print *print;
    const struct zr_frame *frame;
    struct zr_buffer text; /* of one mask at a time */
    uint32_t *edges;
};

static void print_box(struct zr_print *print, const char *key, const struct zr_mask_extent *extent)
{
    if (extent->pixels == 0) return;
    zr_print_begin(print, key, '[');
    for (int i = 0; i < 4; i++)
        zr_print_count(print, NULL, extent->box[i]);
    zr_print_end(print, ']');
}

static void print_runs(struct printing *p, const char *key, const struct zr_bit_mask *mask)
{
    p->text.size = 0;
    if (!write_runs(mask, p->edges, &p->text) || !zr_buffer_add(&p->text, "", 1)) return;
    zr_print_begin(p->print, key, '{');
    zr_print_begin(p->print, "size", '[');
    zr_print_count(p->print, NULL, mask->height);
    zr_print_count(p->print, NULL, mask->width);
    zr_print_end(p->print, ']');
    zr_print_string(p->print, "counts", (const char *)p->text.bytes);
    zr_print_end(p->print, '}');
}

/* Prints the matrix between the places that the client gives: readers subtract numbers from both, if they are far. */
static void print_place(const struct printing *p, const struct zr_scene *scene, const struct zr_instance *instance)
{
    const double *move = scene->meshes[instance->mesh].move, *origin = p->frame->origin;
    struct zr_matrix exact = zr_matrix_of(&instance->object_to_world);
    double *m = exact.m;
    for (int row = 0; row < 3; row++)
        m[12 + row] += (origin ? origin[row] : 0.0) -
                       (move ? m[row] * move[0] + m[4 + row] * move[1] + m[8 + row] * move[2] : 0.0);
    if (move || origin)
        zr_print_doubles(p->print, "objectToWorld", m, 16);
    else
        zr_print_floats(p->print, "objectToWorld", instance->object_to_world.m, 16);
}

static void print_mask(struct printing *p, const struct zr_scene *scene, const struct zr_instance_mask *mask)
{
    const struct zr_instance *instance = &scene->instances[mask->instance];
    const struct zr_bit_mask amodal = bits_of(p->frame, mask, mask->amodal_bits),
                             visible = bits_of(p->frame, mask, mask->visible_bits);
    zr_print_begin(p->print, NULL, '{');
    zr_print_count(p->print, "instanceId", UINT64_C(1) + mask->instance);
    zr_print_string(p->print, "name", scene->meshes[instance->mesh].name);
    if (instance->node) zr_print_string(p->print, "node", instance->node);
    print_place(p, scene, instance);
    zr_print_count(p->print, "pixels", mask->amodal.pixels);
    zr_print_count(p->print, "visiblePixels", mask->visible.pixels);
    zr_print_double(p->print, "visibleFraction", (double)mask->visible.pixels / (double)mask->amodal.pixels);
    print_box(p->print, "box", &mask->amodal);
    print_box(p->print, "visibleBox", &mask->visible);
    print_runs(p, "amodal", &amodal);
    print_runs(p, "visible", &visible);
    zr_print_end(p->print, '}');
}

/* Returns the rows of the largest mask. */
static uint32_t most_rows(const struct zr_instance_masks *masks)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < masks->count; i++) {
        const uint32_t *box = masks->at[i].amodal.box;
        if (box[3] - box[1] > most) most = box[3] - box[1];
    }
    return most;
}

enum zr_status zr_masks_print(struct zr_print *print, const struct zr_scene *scene, const struct zr_frame *frame,
                              const struct zr_cancel *cancel)
{
    const struct zr_instance_masks *masks = frame->masks;
    struct zr_arena *arena = print->out->arena;
    struct printing p = {print, frame, {.arena = arena}, NULL};
    p.edges = zr_arena_alloc(arena, edges_room(most_rows(masks)), sizeof *p.edges);
    if (!p.edges) return ZR_NO_MEMORY;
    zr_print_begin(print, "visibility", '[');
    for (uint32_t i = 0; i < masks->count; i++) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        print_mask(&p, scene, &masks->at[i]);
    }
    zr_print_end(print, ']');
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_masks_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                   const struct zr_cancel *cancel, struct zr_buffer *out)
{
    struct zr_print print = {.out = out};
    zr_print_begin(&print, NULL, '{');
    zr_camera_print(&print, frame, scene->picture->z_is_up);
    const enum zr_status status = zr_masks_print(&print, scene, frame, cancel);
    if (status != ZR_OK) return status;
    zr_print_end(&print, '}');
    return zr_buffer_add(out, "\n", 1) && zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- ZIP ---- */

enum { NAME_SIZE = 32, KINDS = 2 };

/* Appends the picture of one mask to `pictures`. */
static bool add_picture(const struct zr_frame *frame, uint32_t number, int kind, struct zr_buffer *pictures,
                        struct zr_zip_entry *entry)
{
    static const char *const kinds[KINDS] = {"amodal", "visible"};
    const struct zr_instance_mask *mask = &frame->masks->at[number];
    const struct zr_bit_mask bits = bits_of(frame, mask, kind == 0 ? mask->amodal_bits : mask->visible_bits);
    const size_t before = pictures->size;
    char *name = zr_arena_alloc(pictures->arena, NAME_SIZE, 1);
    if (!name || !zr_mask_png_write(&bits, pictures)) return false;
    snprintf(name, NAME_SIZE, "masks/%06" PRIu64 ".%s.png", UINT64_C(1) + mask->instance, kinds[kind]);
    *entry = (struct zr_zip_entry){name, NULL, pictures->size - before};
    return true;
}

enum zr_status zr_masks_zip_write(const struct zr_frame *frame, const struct zr_cancel *cancel, struct zr_error *error,
                                  struct zr_buffer *out)
{
    const size_t count = (size_t)KINDS * frame->masks->count;
    struct zr_zip_entry *entries = zr_arena_alloc(out->arena, count, sizeof *entries);
    struct zr_buffer pictures = {.arena = out->arena};
    size_t size;
    if (!entries) return ZR_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        if (!add_picture(frame, (uint32_t)(i / KINDS), (int)(i % KINDS), &pictures, &entries[i])) return ZR_NO_MEMORY;
    }
    const unsigned char *bytes = pictures.bytes;
    for (size_t i = 0; i < count; i++) {
        entries[i].bytes = bytes;
        bytes += entries[i].size;
    }
    if (!zr_zip_size(entries, count, &size))
        return zr_error_add(error, ZR_BAD_SCENE, "/outputs",
                            "the masks have 4 GiB or more, which is too much for one ZIP: json takes less");
    return zr_zip_write(entries, count, out);
}
