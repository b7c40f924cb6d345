#include "render/picks.h"

#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "base/dvec3.h"
#include "render/pixel_fragments.h"
#include "scene/camera/camera.h"
#include "scene/csg.h"

/* A point is moved onto its face's plane by at most this share of the bounds' diagonal: more is no rounding. */
static const double plane_share = 1e-5;

/* Depths that agree to this share lie at one place: they are floats. */
static const double depth_share = 5e-7;

struct picking {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct zr_fragment_source source;
    double eye[4]; /* in world space; with 0 as the last number the direction towards it */
    double near;   /* length */
};

static zr_dvec3 dvec3_of(const double v[3])
{
    return (zr_dvec3){v[0], v[1], v[2]};
}

static zr_dvec3 towards_eye(const struct picking *p, zr_dvec3 from)
{
    const zr_dvec3 eye = dvec3_of(p->eye);
    return p->eye[3] != 0.0 ? zr_dvec3_sub(eye, from) : eye;
}

/* The visible side of the picked surface is that towards the eye. */
static struct zr_picked picked_of(const struct picking *p, const struct zr_pixel_fragment *fragment, bool is_seen)
{
    struct zr_picked out = {.depth = fragment->depth, .face_id = fragment->face_id, .instance = fragment->instance};
    zr_dvec3 at = {(double)fragment->position[0], (double)fragment->position[1], (double)fragment->position[2]};
    const zr_dvec3 normal = dvec3_of(fragment->normal);
    const double off = zr_dvec3_dot(normal, zr_dvec3_sub(dvec3_of(fragment->corner), at));
    const bool is_away = zr_dvec3_dot(normal, towards_eye(p, at)) < 0.0,
               is_turned = !is_seen && fragment->front_facing == 2;
    const double side = is_away != is_turned ? -1.0 : 1.0;
    if (fabs(off) <= p->near) at = zr_dvec3_add_scaled(at, normal, off);
    const double point[3] = {at.x, at.y, at.z};
    memcpy(out.point, point, sizeof point);
    for (int k = 0; k < 3; k++)
        out.normal[k] = side * fragment->normal[k] + 0.0; /* no -0 */
    return out;
}

/* ---- combined solids ---- */

struct walk {
    const struct zr_csg *csg;
    int32_t windings[ZR_CSG_PARTS_MAX];
    uint64_t inside;
};

static int turn_of(const struct zr_pixel_fragment *fragment)
{
    return fragment->front_facing == 1 ? 1 : -1;
}

/* Windings end with 0, so those at the eye are the fragments' sum with the other sign (render/layers/solid_walk.h). */
static void begin_walk(const struct zr_csg *csg, const struct zr_pixel_fragments *list, struct walk *walk)
{
    *walk = (struct walk){.csg = csg};
    for (uint32_t i = 0; i < list->count; i++)
        if (list->at[i].solid) walk->windings[list->at[i].solid - 1] -= turn_of(&list->at[i]);
    for (uint32_t part = 0; part < csg->part_count; part++) {
        if (walk->windings[part] < 0) walk->windings[part] = 0;
        if (walk->windings[part] > 0) walk->inside |= UINT64_C(1) << part;
    }
}

/* Passes a fragment of an operand. */
static void pass(struct walk *walk, const struct zr_pixel_fragment *fragment)
{
    const uint32_t part = fragment->solid - 1u;
    const uint64_t bit = UINT64_C(1) << part;
    walk->windings[part] += turn_of(fragment);
    walk->inside = walk->windings[part] != 0 ? walk->inside | bit : walk->inside & ~bit;
}

static bool is_at_one_place(const struct zr_csg *csg, const struct zr_pixel_fragment *a,
                            const struct zr_pixel_fragment *b)
{
    const double apart = (double)b->depth - (double)a->depth;
    return apart <= csg->tolerance + depth_share * fabs((double)a->depth);
}

/* Keeps the fragments that are surfaces: of operands, one of each place at which the value of the tree changes. If the
 * channel faceId shows one of that place, it is kept. */
static void keep_surfaces(const struct zr_csg *csg, uint32_t seen_id, struct zr_pixel_fragments *list)
{
    struct walk walk;
    uint32_t kept = 0;
    begin_walk(csg, list, &walk);
    for (uint32_t first = 0, end; first < list->count; first = end) {
        const bool before = zr_csg_value(csg, walk.inside);
        const uint64_t inside = walk.inside;
        uint32_t surface = list->count;
        for (end = first; end < list->count && is_at_one_place(csg, &list->at[first], &list->at[end]); end++)
            if (list->at[end].solid) pass(&walk, &list->at[end]);
        const bool has_changed = zr_csg_value(csg, walk.inside) != before;
        for (uint32_t i = first; i < end && has_changed; i++) {
            const struct zr_pixel_fragment *f = &list->at[i];
            if (!f->solid || !((inside ^ walk.inside) >> (f->solid - 1) & 1)) continue;
            if (surface == list->count || f->face_id == seen_id) surface = i;
        }
        for (uint32_t i = first; i < end; i++)
            if (!list->at[i].solid || i == surface) list->at[kept++] = list->at[i];
    }
    list->count = kept;
}

/* ---- picks ---- */

/* Returns the number of the picked fragment; `count`: none. */
static uint32_t find_seen(const struct zr_pixel_fragments *list, uint32_t seen_id)
{
    uint32_t i = 0;
    for (; i < list->count; i++) {
        const struct zr_pixel_fragment *f = &list->at[i];
        if (seen_id != 0 ? f->face_id == seen_id : f->is_shown && !f->is_culled) break;
    }
    return i;
}

static bool list_behind(const struct picking *p, const struct zr_pixel_fragments *list, uint32_t first,
                        struct zr_pick *out)
{
    const uint32_t count = list->count - first, listed = count < ZR_PICK_BEHIND_MAX ? count : ZR_PICK_BEHIND_MAX;
    out->behind = zr_arena_alloc(p->run->arena, listed ? listed : 1, sizeof *out->behind);
    if (!out->behind) return false;
    for (uint32_t i = 0; i < listed; i++)
        out->behind[i] = picked_of(p, &list->at[first + i], false);
    out->behind_count = listed;
    out->behind_omitted = count - listed;
    return true;
}

/* Picks at pixel x, y of the frame. */
static enum zr_status pick(const struct picking *p, uint32_t x, uint32_t y, struct zr_pick *out)
{
    const struct zr_run inner = zr_run_in(p->run, p->run->scratch);
    const uint32_t seen_id = p->frame->face_id[(size_t)y * p->frame->width + x];
    struct zr_pixel_fragments list;
    enum zr_status status = zr_fragments_list(&inner, &p->source, x, y, p->frame, &list);
    const uint32_t room = list.count;
    if (status == ZR_OK && p->scene->csg) keep_surfaces(p->scene->csg, seen_id, &list);
    const uint32_t seen = status == ZR_OK ? find_seen(&list, seen_id) : 0;
    if (status == ZR_OK && seen < list.count) {
        out->is_hit = true;
        out->at = picked_of(p, &list.at[seen], true);
        if (!list_behind(p, &list, seen + 1, out)) status = ZR_NO_MEMORY;
    }
    if (p->run->scratch != p->run->arena) zr_arena_trim(p->run->scratch, list.at, room, 0, sizeof *list.at);
    return status;
}

/* Finds the eye in world space. */
static void find_eye(struct picking *p)
{
    const zr_vec4 eye = zr_camera_eye(&p->frame->camera);
    const struct zr_matrix to_eye = zr_matrix_of(&p->frame->camera.world_to_eye);
    const double in_eye[4] = {(double)eye.x, (double)eye.y, (double)eye.z, (double)eye.w};
    struct zr_matrix back;
    if (!zr_matrix_invert(&to_eye, &back)) return;
    zr_matrix_apply(&back, in_eye, p->eye);
    for (int k = 0; k < 3 && p->eye[3] != 0.0; k++)
        p->eye[k] /= p->eye[3];
}

enum zr_status zr_picks_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_remap *remap,
                             const struct zr_pick_pixels *pixels, const struct zr_frame *frame, struct zr_picks *out)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct picking p = {.run = run, .scene = scene, .frame = frame};
    struct zr_pick *at = zr_arena_zero(run->arena, pixels->count, sizeof *at);
    if (!at) return ZR_NO_MEMORY;
    enum zr_status status = zr_fragment_source_make(&inner, scene, ZR_LAYERS_BOTH_SIDES, frame, &p.source);
    find_eye(&p);
    p.near = plane_share * (double)zr_diagonal_of(&frame->bounds);
    for (uint32_t i = 0; i < pixels->count && status == ZR_OK; i++) {
        struct zr_remap_pixel pixel = {pixels->at[i][0], pixels->at[i][1]};
        at[i].x = pixel.x;
        at[i].y = pixel.y;
        const bool has_ray = !remap || zr_remap_nearest_pixel(remap, pixel.x, pixel.y, &pixel);
        if (has_ray && pixel.x < frame->width && pixel.y < frame->height) status = pick(&p, pixel.x, pixel.y, &at[i]);
        if (zr_is_cancelled(run->cancel)) status = ZR_CANCELLED;
    }
    *out = (struct zr_picks){pixels->count, at};
    return status;
}

enum zr_status zr_pick_ends_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_annotate *annotate = &frame->view->annotate;
    uint32_t(*pixels)[2] = zr_arena_alloc(run->scratch, 3 * (size_t)annotate->dimension_count + 1, sizeof *pixels);
    uint32_t count = 0;
    if (!pixels) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < annotate->dimension_count; i++) {
        const struct zr_dimension *d = &annotate->dimensions[i];
        const struct zr_dimension_end *const ends[] = {&d->from, &d->to, &d->at};
        for (int k = 0; k < 3; k++)
            if (ends[k]->is_pick) memcpy(pixels[count++], ends[k]->pixel, sizeof *pixels);
    }
    const struct zr_pick_pixels list = {count, (const uint32_t(*)[2])pixels};
    return count > 0 ? zr_picks_find(run, scene, NULL, &list, frame, &frame->ends) : ZR_OK;
}
