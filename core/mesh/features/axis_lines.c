#include "mesh/features/axis_lines.h"

enum { AROUND = 6, LINES = AROUND + 1, HEIGHTS = 3, SCAN_PER_STEP = 4 };

static const double BESIDE[2] = {0.0871, 0.0533};      /* of the flat: the line near the axis, which no edge is on */
static const double NEAR_WALL = 0.92;                  /* of the flat */
static const double BEYOND = 0.02, BEYOND_SIZE = 1e-4; /* of the radius and the size */
static const double SOON = 0.15;                       /* of the radius */
static const double TIP = 1.5;                         /* of the radius */

/* Directions of lines near the wall: a hexagon, turned by an odd angle. */
static const double DIRECTIONS[AROUND][2] = {{0.98079, 0.19509},   {0.32144, 0.94693},   {-0.65935, 0.75184},
                                             {-0.98079, -0.19509}, {-0.32144, -0.94693}, {0.65935, -0.75184}};

/* Winding numbers of a line at given heights, and behind all. */
struct line {
    double x, y;
    int at[HEIGHTS], all;
    double next; /* least height above the third one where the line enters or leaves; for the tip */
    double before;
};

const struct zr_triangle_bounds *zr_triangle_bounds_make(struct zr_arena *arena, struct zr_feature_work *work,
                                                         const struct zr_surface *surface)
{
    struct zr_triangle_bounds *bounds = zr_arena_alloc(arena, surface->triangle_count, sizeof *bounds);
    for (uint32_t t = 0; bounds && t < surface->triangle_count; t++) {
        const uint32_t *corners = surface->corners[t];
        const zr_dvec3 a = surface->places[corners[0]], b = surface->places[corners[1]],
                       c = surface->places[corners[2]];
        const zr_dvec3 middle = {(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0, (a.z + b.z + c.z) / 3.0};
        const zr_dvec3 to_a = zr_dvec3_sub(a, middle), to_b = zr_dvec3_sub(b, middle), to_c = zr_dvec3_sub(c, middle);
        const double square =
            zr_most_of(zr_dvec3_dot(to_a, to_a), zr_most_of(zr_dvec3_dot(to_b, to_b), zr_dvec3_dot(to_c, to_c)));
        if (!zr_feature_has_steps(work, 1)) return NULL;
        bounds[t] = (struct zr_triangle_bounds){(float)middle.x, (float)middle.y, (float)middle.z,
                                                (float)(sqrt(square) * 1.00001 + 1e-6 * surface->size)};
    }
    return bounds;
}

/* Lists the triangles that may come as near to the axis as the wall. Returns their number. */
static uint32_t list_near(struct zr_feature_work *work, const struct zr_surface *surface,
                          const struct zr_triangle_bounds *bounds, const struct zr_cylinder *cylinder, uint32_t *list)
{
    const struct zr_cylinder_frame *frame = &cylinder->frame;
    const float ux = (float)frame->u.x, uy = (float)frame->u.y, uz = (float)frame->u.z;
    const float vx = (float)frame->v.x, vy = (float)frame->v.y, vz = (float)frame->v.z;
    const float x0 = (float)zr_dvec3_dot(frame->u, frame->center), y0 = (float)zr_dvec3_dot(frame->v, frame->center);
    const float radius = (float)(frame->radius + 1e-5 * surface->size);
    uint32_t count = 0;
    for (uint32_t t = 0; t < surface->triangle_count; t++) {
        const struct zr_triangle_bounds *b = &bounds[t];
        const float x = ux * b->x + uy * b->y + uz * b->z - x0, y = vx * b->x + vy * b->y + vz * b->z - y0,
                    most = b->radius + radius;
        if (t % SCAN_PER_STEP == 0 && !zr_feature_has_steps(work, 1)) return 0;
        if (x * x + y * y <= most * most) list[count++] = t;
    }
    return count;
}

/* ---- crossings ---- */

/* A corner across the axis and along it. */
struct corner {
    double x, y, z;
    uint32_t place;
};

/* Returns on which side of an edge a line is, the same for both triangles of the edge: positive is left. */
static double side_of(const struct corner *a, const struct corner *b, const struct line *line)
{
    const struct corner *low = a->place < b->place ? a : b, *high = a->place < b->place ? b : a;
    const double turn = (high->x - low->x) * (line->y - low->y) - (high->y - low->y) * (line->x - low->x);
    const double side = turn >= 0.0 ? zr_most_of(turn, DBL_MIN) : turn;
    return low == a ? side : 0.0 - side;
}

/* Adds a triangle to the winding numbers of a line. */
static void cross(const struct corner c[3], const double heights[HEIGHTS], struct line *line)
{
    const double a = side_of(&c[1], &c[2], line), b = side_of(&c[2], &c[0], line), d = side_of(&c[0], &c[1], line);
    const bool left = a > 0.0 && b > 0.0 && d > 0.0, right = a < 0.0 && b < 0.0 && d < 0.0;
    if (!left && !right) return;
    const double z = (a * c[0].z + b * c[1].z + d * c[2].z) / (a + b + d);
    const int turn = left ? -1 : 1; /* a face that looks along the axis is left behind */
    line->all += turn;
    for (int h = 0; h < HEIGHTS; h++)
        if (z <= heights[h]) line->at[h] += turn;
    if (z > heights[2] && z < line->next) line->next = z;
    if (z < heights[0] && z > line->before) line->before = z;
}

static bool cross_all(struct zr_feature_work *work, const struct zr_surface *surface,
                      const struct zr_cylinder_frame *frame, const uint32_t *list, uint32_t count,
                      const double heights[HEIGHTS], struct line lines[LINES])
{
    for (uint32_t i = 0; i < count; i++) {
        struct corner c[3];
        if (!zr_feature_has_steps(work, LINES)) return false;
        for (int k = 0; k < 3; k++) {
            const uint32_t place = surface->corners[list[i]][k];
            const zr_dvec3 p = zr_dvec3_sub(surface->places[place], frame->center);
            c[k] = (struct corner){zr_dvec3_dot(p, frame->u), zr_dvec3_dot(p, frame->v), zr_dvec3_dot(p, frame->axis),
                                   place};
        }
        for (int l = 0; l < LINES; l++)
            cross(c, heights, &lines[l]);
    }
    return true;
}

/* ---- ends ---- */

/* Returns the length from an end until a line enters or leaves. */
static double gap_of(const struct line *line, const double heights[HEIGHTS], int height)
{
    return height == 0 ? heights[0] - line->before : line->next - heights[2];
}

/* `height`: 0 below the cylinder, 2 above it. Cones under drills are near the wall soon after the end. */
static enum zr_cylinder_end end_of(const struct line lines[LINES], const double heights[HEIGHTS], int height,
                                   double radius)
{
    int solid = 0, known = 0;
    if (lines[0].all != 0) return ZR_END_UNKNOWN;
    if (lines[0].at[height] != 0) return ZR_END_CLOSED;
    for (int l = 1; l < LINES; l++) {
        if (lines[l].all != 0) continue;
        known++;
        solid += lines[l].at[height] != 0 || gap_of(&lines[l], heights, height) <= SOON * radius;
    }
    if (known < AROUND / 2) return ZR_END_UNKNOWN;
    if (2 * solid <= known) return ZR_END_OPEN;
    return gap_of(&lines[0], heights, height) <= TIP * radius ? ZR_END_CLOSED : ZR_END_NARROW;
}

bool zr_axis_lines_look(struct zr_feature_work *work, const struct zr_surface *surface,
                        const struct zr_triangle_bounds *bounds, const struct zr_cylinder *cylinder, uint32_t *room,
                        struct zr_cylinder_ends *out)
{
    const double radius = cylinder->frame.radius, beyond = zr_most_of(BEYOND * radius, BEYOND_SIZE * surface->size);
    const double heights[HEIGHTS] = {cylinder->low - beyond, 0.5 * (cylinder->low + cylinder->high),
                                     cylinder->high + beyond};
    struct line lines[LINES];
    *out = (struct zr_cylinder_ends){.is_filled = false};
    for (int l = 0; l < LINES; l++) {
        const double *to = l == 0 ? BESIDE : DIRECTIONS[l - 1];
        const double far = cylinder->flat * (l == 0 ? 1.0 : NEAR_WALL);
        lines[l] = (struct line){.x = far * to[0], .y = far * to[1], .next = HUGE_VAL, .before = -HUGE_VAL};
    }
    const uint32_t count = list_near(work, surface, bounds, cylinder, room);
    if (work->is_stopped || !cross_all(work, surface, &cylinder->frame, room, count, heights, lines)) return false;
    out->is_filled = lines[0].all == 0 && lines[0].at[1] != 0;
    out->end[0] = end_of(lines, heights, 0, radius);
    out->end[1] = end_of(lines, heights, 2, radius);
    return true;
}
