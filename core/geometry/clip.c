#include "geometry/clip.h"

#include <string.h>

#include "base/mutant.h"

enum { PLANES = 6 };

/* Each test is written so that NaN sets its bit. */
unsigned zr_clip_outcode(zr_vec4 p)
{
    unsigned code = 0;
    if (!(p.x <= p.w)) code |= 1u << 0;
    if (!(p.x + p.w >= 0.0f)) code |= 1u << 1;
    if (!(p.y <= p.w)) code |= 1u << 2;
    if (!(p.y + p.w >= 0.0f)) code |= 1u << 3;
    if (!(p.z + p.w >= 0.0f)) code |= 1u << 4;
    if (!(p.z <= p.w)) code |= 1u << 5;
    return code;
}

/* Adds four terms from left to right, zeros included, in the reference's order. */
static float plane_distance(int plane, zr_vec4 p)
{
    static const zr_vec4 planes[PLANES] = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1},
                                           {0, 1, 0, 1},  {0, 0, 1, 1}, {0, 0, -1, 1}};
    zr_vec4 n = planes[plane];
    return ((p.x * n.x + p.y * n.y) + p.z * n.z) + p.w * n.w;
}

static float mix(float o, float i, float t)
{
    return ZR_MUTANT(fused, o + t * (i - o), fmaf(t, i - o, o));
}

static zr_vec4 mix4(zr_vec4 o, zr_vec4 i, float t)
{
    return (zr_vec4){mix(o.x, i.x, t), mix(o.y, i.y, t), mix(o.z, i.z, t), mix(o.w, i.w, t)};
}

/* Appends a created vertex between two existing ones. */
static struct zr_clip_vertex made_between(struct zr_clipped *clipped, const struct zr_clip_vertex *from,
                                          const struct zr_clip_vertex *to, float t)
{
    const int id = clipped->corners + clipped->made_count;
    clipped->made[clipped->made_count++] = (struct zr_clip_made){from->id, to->id, t};
    return (struct zr_clip_vertex){mix4(from->position, to->position, t), (uint8_t)id};
}

/* Returns the point at which an edge with ends on different sides crosses the plane: measured from the nearer end, on a
 * tie from the inner one. */
static struct zr_clip_vertex cross_plane(struct zr_clipped *clipped, const struct zr_clip_vertex *inside,
                                         float d_inside, const struct zr_clip_vertex *outside, float d_outside)
{
    bool from_outside = ZR_MUTANT(clipped_from_inside, -d_outside < d_inside, false);
    const struct zr_clip_vertex *o = from_outside ? outside : inside, *i = from_outside ? inside : outside;
    float d_o = from_outside ? d_outside : d_inside, d_i = from_outside ? d_inside : d_outside;
    return made_between(clipped, o, i, -d_o / (d_i - d_o));
}

static int clip_to_plane(struct zr_clipped *clipped, int plane, const struct zr_clip_vertex *in, int count,
                         struct zr_clip_vertex *out)
{
    int kept = 0;
    const struct zr_clip_vertex *previous = &in[0];
    float d_previous = plane_distance(plane, previous->position);
    for (int i = 1; i <= count && kept + 2 <= ZR_MUTANT(nine_corners, (int)ZR_CLIP_MAX, 9); i++) {
        const struct zr_clip_vertex *current = &in[i % count];
        float d = plane_distance(plane, current->position);
        bool inside = d >= 0.0f, previous_inside = d_previous >= 0.0f;
        if (previous_inside) out[kept++] = *previous;
        if (inside && !previous_inside) out[kept++] = cross_plane(clipped, current, d, previous, d_previous);
        if (!inside && previous_inside) out[kept++] = cross_plane(clipped, previous, d_previous, current, d);
        previous = current;
        d_previous = d;
    }
    return kept;
}

/* Returns the edge bits after clip_to_plane: bit i is the edge from vertex i to the next one. The new edge along the
 * plane, which starts where the polygon leaves the inside, gets no bit. */
static unsigned cut_edges(int plane, const struct zr_clip_vertex *in, int count, unsigned edges)
{
    unsigned left = 0;
    int kept = 0;
    bool inside = plane_distance(plane, in[0].position) >= 0.0f;
    for (int i = 0; i < count && kept + 2 <= ZR_CLIP_MAX; i++) {
        bool next_inside = plane_distance(plane, in[(i + 1) % count].position) >= 0.0f;
        if (inside || next_inside) left |= (edges >> i & 1u) << kept;
        kept += (inside ? 1 : 0) + (inside != next_inside ? 1 : 0);
        inside = next_inside;
    }
    return left;
}

static void begin(struct zr_clipped *out, int corners)
{
    out->corners = corners;
    out->count = out->made_count = 0;
}

int zr_clip_triangle(const zr_vec4 tri[3], unsigned outcodes, unsigned *edges, struct zr_clipped *out)
{
    struct zr_clip_vertex buffers[2][ZR_CLIP_MAX];
    int count = 3, side = 0;
    begin(out, 3);
    for (uint8_t k = 0; k < 3; k++)
        buffers[0][k] = (struct zr_clip_vertex){tri[k], k};
    for (int i = 0; i < PLANES && count >= 3; i++) {
        const int plane = ZR_MUTANT(near_plane_first, i, (i + 4) % PLANES);
        if (!(outcodes >> plane & 1u)) continue;
        if (edges) *edges = cut_edges(plane, buffers[side], count, *edges);
        count = clip_to_plane(out, plane, buffers[side], count, buffers[side ^ 1]);
        side ^= 1;
    }
    if (count < 3) return 0;
    memcpy(out->vertices, buffers[side], (size_t)count * sizeof *out->vertices);
    return out->count = count;
}

/* Returns the larger of `share` and the part that the plane cuts off a line, from its end at distance d towards
 * `other`. */
static float cut_share(float d, float other, float share)
{
    if (!(d < 0.0f)) return share;
    float t = d / (d - other);
    return t > share ? t : share;
}

bool zr_clip_line(const zr_vec4 in[2], const unsigned outcodes[2], struct zr_clipped *out)
{
    const struct zr_clip_vertex ends[2] = {{in[0], 0}, {in[1], 1}};
    begin(out, 2);
    if (outcodes[0] & outcodes[1]) return false;
    float t0 = 0.0f, t1 = 0.0f;
    for (int plane = 0; plane < PLANES; plane++) {
        if (!((outcodes[0] | outcodes[1]) >> plane & 1u)) continue;
        float d0 = plane_distance(plane, in[0]), d1 = plane_distance(plane, in[1]);
        if (!isfinite(d0) || !isfinite(d1)) return false;
        t0 = cut_share(d0, d1, t0);
        t1 = cut_share(d1, d0, t1);
    }
    if (ZR_MUTANT(line_ends_clipped_apart, t0 + t1 >= 1.0f, false)) return false;
    out->vertices[0] = outcodes[0] ? made_between(out, &ends[0], &ends[1], t0) : ends[0];
    out->vertices[1] = outcodes[1] ? made_between(out, &ends[1], &ends[0], t1) : ends[1];
    out->count = 2;
    return true;
}

void zr_clip_replay(const struct zr_clip_made *made, int made_count, int corners, zr_vec4 values[ZR_CLIP_VALUES])
{
    for (int i = 0; i < made_count; i++)
        values[corners + i] = mix4(values[made[i].from], values[made[i].to], made[i].t);
}
