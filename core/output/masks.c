#include "output/masks.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/cancel.h"
#include "output/json/camera_json.h"
#include "output/images/mask_png.h"
#include "output/mask_rle.h"
#include "output/zip.h"

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
    if (!zr_mask_rle_write(mask, p->edges, &p->text) || !zr_buffer_add(&p->text, "", 1)) return;
    zr_print_begin(p->print, key, '{');
    zr_print_begin(p->print, "size", '[');
    zr_print_count(p->print, NULL, mask->height);
    zr_print_count(p->print, NULL, mask->width);
    zr_print_end(p->print, ']');
    zr_print_string(p->print, "counts", (const char *)p->text.bytes);
    zr_print_end(p->print, '}');
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
    zr_print_floats(p->print, "objectToWorld", instance->object_to_world.m, 16);
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
    p.edges = zr_arena_alloc(arena, zr_mask_rle_edges(most_rows(masks)), sizeof *p.edges);
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
    zr_camera_print(&print, frame, scene->picture.z_is_up);
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
