/* wall_lines.h - mesh: a possible wall between two opposite triangles, and lines through it; for
 * mesh/facts/least_wall.c.
 *
 * Space:  that of the solid (wall_tree.h). A pair has a frame of its own, whose third axis runs through the material.
 * Work:   counted in steps, as least_wall.h describes. A search whose steps are used up, or that is cancelled, is
 *         stopped: all results are then false.
 */
#ifndef ZR_WALL_LINES_H
#define ZR_WALL_LINES_H

#include "mesh/facts/wall_tree.h"

enum {
    ZR_WALL_DEPTH = 64,  /* more than the depth of a tree */
    ZR_WALL_CORNERS = 9, /* most corners of a triangle that is clipped by three lines */
    ZR_WALL_STEPS_PER_CANCEL_CHECK = 1 << 12,
    ZR_WALL_CROSSINGS = 512 /* most crossings of a line with faces within a wall */
};

struct zr_wall_point {
    double u, v;
};

/* Axes of unit length; `d` runs through the material. */
struct zr_wall_frame {
    struct zr_world_place u, v, d;
};

/* A projected triangle, and its plane: height = at + du u + dv v. */
struct zr_wall_facet {
    struct zr_wall_point corners[3];
    double heights[3];
    double at, du, dv;
};

struct zr_wall_search {
    const struct zr_wall_solid *solid;
    const struct zr_cancel *cancel;
    uint64_t steps, steps_most, next_look;
    bool is_stopped; /* cancelled, or too many steps */
    double best;
    struct zr_world_place at, best_at; /* middles of the last line that was within a wall, and of the best one */
};

/* Both sides of a possible wall, projected: their overlap. */
struct zr_wall_pair {
    struct zr_wall_frame frame;
    struct zr_wall_facet near, far;
    struct zr_wall_point overlap[ZR_WALL_CORNERS];
    int count;
    double thickness;
};

/* Counts steps. False if the search is stopped. */
static inline bool zr_wall_has_steps(struct zr_wall_search *s, uint32_t steps)
{
    s->steps += steps;
    if (s->steps > s->steps_most) s->is_stopped = true;
    if (s->steps >= s->next_look) {
        s->next_look = s->steps + ZR_WALL_STEPS_PER_CANCEL_CHECK;
        if (zr_is_cancelled(s->cancel)) s->is_stopped = true;
    }
    return !s->is_stopped;
}

/* ---- projections ---- */

static inline void zr_wall_project(const struct zr_wall_frame *frame, const struct zr_world_place p[3],
                                   struct zr_wall_facet *out)
{
    for (int k = 0; k < 3; k++) {
        out->corners[k] =
            (struct zr_wall_point){zr_world_place_dot(frame->u, p[k]), zr_world_place_dot(frame->v, p[k])};
        out->heights[k] = zr_world_place_dot(frame->d, p[k]);
    }
}

/* Positive for a left turn. */
static inline double zr_wall_turn(struct zr_wall_point a, struct zr_wall_point b, struct zr_wall_point c)
{
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/* Finds the plane of a facet. False if it is seen edge-on. */
static inline bool zr_wall_find_plane(struct zr_wall_facet *f)
{
    const struct zr_wall_point *c = f->corners;
    const double area = zr_wall_turn(c[0], c[1], c[2]), h1 = f->heights[1] - f->heights[0],
                 h2 = f->heights[2] - f->heights[0];
    if (area == 0.0) return false;
    f->du = (h1 * (c[2].v - c[0].v) - h2 * (c[1].v - c[0].v)) / area;
    f->dv = (h2 * (c[1].u - c[0].u) - h1 * (c[2].u - c[0].u)) / area;
    f->at = f->heights[0] - (f->du * c[0].u + f->dv * c[0].v);
    return true;
}

/* Returns the height of the plane, within that of the triangle. */
static inline double zr_wall_height_at(const struct zr_wall_facet *f, struct zr_wall_point p)
{
    const double h = f->at + (f->du * p.u + f->dv * p.v);
    const double low = zr_least_of(f->heights[0], zr_least_of(f->heights[1], f->heights[2])),
                 high = zr_most_of(f->heights[0], zr_most_of(f->heights[1], f->heights[2]));
    return h < low ? low : h > high ? high : h;
}

/* ---- lines ---- */

/* True if a line through the overlap is inside the part from one side to the other, and outside before and behind.
 * Probes up to 1 + 3 * pair->count lines. Sets search->at then. */
bool zr_wall_probe(struct zr_wall_search *search, const struct zr_wall_pair *pair);

#endif
