#include "shade/sample_list.h"

#include "shade/varyings_simd.h"

enum { SLOT_BITS = 11, SLOTS = 1 << SLOT_BITS };
_Static_assert(SLOTS >= 2 * ZR_SAMPLES_LISTED, "half of the slots stay free");
_Static_assert((int)ZR_SAMPLES_LISTED <= (int)ZR_PARTS_MOST, "each sample may have a primitive of its own");

/* Parts of a list: one for each primitive, with its planes and its material. */
struct listed {
    struct zr_shader s;
    uint32_t part[ZR_SAMPLES_ROOM]; /* of each sample */
    uint32_t material[ZR_PARTS_ROOM];
    uint16_t slots[SLOTS]; /* parts by the hash of their owners; 0: free */
};
_Static_assert(sizeof(struct listed) <= sizeof(struct zr_sample_room), "the room fits");

/* ---- parts ---- */

static inline void find_parts(const struct zr_sample_list *list, struct listed *out)
{
    uint16_t *slots = out->slots;
    uint32_t *owners = out->s.parts.owners, count = 1;
    owners[0] = 0;
    memset(slots, 0, sizeof out->slots);
    for (uint32_t i = 0; i < list->count; i++) {
        const uint32_t owner = list->owner[i];
        uint32_t slot = owner * UINT32_C(2654435761) >> (32 - SLOT_BITS);
        while (slots[slot] && owners[slots[slot]] != owner)
            slot = (slot + 1) % SLOTS;
        if (!slots[slot]) {
            slots[slot] = (uint16_t)count;
            owners[count++] = owner;
        }
        out->part[i] = slots[slot];
    }
    out->s.parts.count = count;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        out->part[list->count + i] = 1;
    for (uint32_t i = 0; i < ZR_PARTS_AT_ONCE; i++)
        owners[count + i] = UINT32_MAX;
    zr_find_runs(&out->s);
}

ZR_INLINED void set_up(struct listed *l, unsigned mask)
{
    l->s.any_per_pixel = false;
    for (uint32_t i = 0; i < l->s.run_count; i++) {
        const struct zr_draw_run *run = &l->s.runs[i];
        zr_look_ahead(&l->s, i);
        zr_put_run(&l->s, run, mask);
        for (uint32_t part = run->first; part < run->first + run->count; part++)
            l->material[part] = run->of_draw->material;
    }
}

/* ---- values ---- */

/* ZR_LANES samples. */
struct samples_v {
    zr_vi part;
    uint32_t alike; /* their part if all have one, else 0 */
    zr_vf x, y;
};

static inline struct samples_v samples_v_of(const struct listed *l, const struct zr_sample_list *list, uint32_t i)
{
    const zr_vi part = zr_vi_load(l->part + i);
    const uint32_t same = zr_vm_bits(zr_vi_eq(part, zr_vi_set((int32_t)l->part[i])));
    return (struct samples_v){part, same == ZR_ALL_BITS ? l->part[i] : 0, zr_vf_load(list->x + i),
                              zr_vf_load(list->y + i)};
}

/* Evaluates plane k of parts with `count` planes. */
ZR_INLINED zr_vf value_at(const struct listed *l, const struct samples_v *in, int k, int count)
{
    struct zr_plane_v plane;
    if (in->alike) {
        const float *from = l->s.planes[in->alike * (uint32_t)count + (uint32_t)k];
        plane = (struct zr_plane_v){zr_vf_set(from[0]), zr_vf_set(from[1]), zr_vf_set(from[2])};
    } else {
        const zr_vi at = in->part * zr_vi_set(count) + zr_vi_set(k);
        zr_vf_gather_fours(&l->s.planes[0][0], at, &plane.a0, &plane.dadx, &plane.dady);
    }
    return zr_plane_at_v(&plane, in->x, in->y);
}

/* Returns values k, k + 1 and k + 2. */
ZR_INLINED struct zr_vec3_v values_at(const struct listed *l, const struct samples_v *in, int k, int count, zr_vf w)
{
    return (struct zr_vec3_v){value_at(l, in, k, count) * w, value_at(l, in, k + 1, count) * w,
                              value_at(l, in, k + 2, count) * w};
}

ZR_INLINED void put3(float *const to[3], uint32_t i, struct zr_vec3_v v)
{
    zr_vf_store(to[0] + i, v.x);
    zr_vf_store(to[1] + i, v.y);
    zr_vf_store(to[2] + i, v.z);
}

ZR_INLINED void evaluate(const struct listed *l, const struct zr_sample_list *list, unsigned mask,
                         const struct zr_gbuffer *to)
{
    const int count = zr_plane_count(mask);
    for (uint32_t i = 0; i < list->count; i += ZR_LANES) {
        const struct samples_v in = samples_v_of(l, list, i);
        const zr_vf w = zr_vf_set(1.0f) / value_at(l, &in, 0, count);
        if (mask & ZR_VARY_COLOR) put3(to->base, i, values_at(l, &in, zr_first_plane(mask, ZR_VARY_COLOR), count, w));
        put3(to->normal, i, zr_normalize_v(values_at(l, &in, zr_first_plane(mask, ZR_VARY_NORMAL), count, w)));
        put3(to->point, i, values_at(l, &in, zr_first_plane(mask, ZR_VARY_POINT), count, w));
        if (mask & ZR_VARY_OPACITY) {
            const zr_vf opacity = value_at(l, &in, zr_first_plane(mask, ZR_VARY_OPACITY), count) * w;
            zr_vf_store(to->opacity + i, zr_vf_min(zr_vf_max(opacity, zr_vf_set(0.0f)), zr_vf_set(1.0f)));
        }
        if (to->material) zr_vi_store(to->material + i, zr_vi_gather(ZR_ALL_LANES, l->material, in.part));
    }
}

__attribute__((flatten)) void ZR_KERNEL(zr_samples_at)(const struct zr_geometry *geometry,
                                                       const struct zr_scene_attributes *attributes,
                                                       const struct zr_sample_list *list, struct zr_sample_room *room,
                                                       const struct zr_gbuffer *to)
{
    enum {
        PLAIN = ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_OVER_W,
        COLORED = PLAIN | ZR_VARY_COLOR,
        BLENDED = COLORED | ZR_VARY_OPACITY
    };
    struct listed *l = (struct listed *)(void *)room->bytes;
    if (list->count == 0) return;
    l->s.geometry = geometry;
    l->s.attributes = attributes;
    l->s.draw = &geometry->draws[0];
    find_parts(list, l);
    if (to->opacity) {
        set_up(l, BLENDED);
        evaluate(l, list, BLENDED, to);
    } else if (to->base[0]) {
        set_up(l, COLORED);
        evaluate(l, list, COLORED, to);
    } else {
        set_up(l, PLAIN);
        evaluate(l, list, PLAIN, to);
    }
}
