#include "cost_sample.h"

#include <math.h>

#include "geometry/face.h"
#include "scene/picture.h"
#include "sections/section_planes.h"

/* SAMPLES: most faces, lines and points in the sample. SAMPLED_CORNERS: approximate limit of their corners. PLATES: most
 * faces that are compared two by two. */
enum { SAMPLES = 1024, SAMPLED_CORNERS = 1 << 16, PLATES = 64 };

/* Three corners of a face in window space, and its box. */
struct plate {
    double at[3][3], low[2], high[2];
};

struct tally {
    struct zr_cost_sample sums;
    double line_width, kept_squares;
    zr_mat4 world_to_clip, object_to_clip;
    const struct zr_camera *camera;
    bool is_mirrored;
    struct zr_section_planes planes; /* none if they are refused */
    const zr_mat4 *object_to_world;
    bool takes_plate; /* the face is one of those compared two by two */
    uint32_t plate_count;
    struct plate plates[PLATES];
};

/* Projection of a face, line or point to the window. */
struct footprint {
    double low[2], high[2];    /* bounding box, pixels */
    double area, net;          /* sums over rings of the absolute and the signed area; counter-clockwise is positive */
    double perimeter;          /* sum over edges of the larger extent in x or y */
    uint32_t in_front, behind; /* corners in front of the eye, and others */
};

/* Projects a corner to `at` and extends the box; at = 0, 0 behind the eye. */
static void include(const struct tally *tally, struct footprint *print, zr_vec4 position, double at[2])
{
    const zr_vec4 clip = zr_mat4_apply(&tally->object_to_clip, position);
    if (!(clip.w > 0.0f)) {
        print->behind++;
        at[0] = at[1] = 0.0;
        return;
    }
    const double w = (double)clip.w;
    at[0] = (0.5 + 0.5 * (double)clip.x / w) * tally->sums.width;
    at[1] = (0.5 + 0.5 * (double)clip.y / w) * tally->sums.height;
    print->in_front++;
    for (int k = 0; k < 2; k++) {
        print->low[k] = fmin(print->low[k], at[k]);
        print->high[k] = fmax(print->high[k], at[k]);
    }
}

static struct footprint footprint_of(const struct tally *tally, const struct zr_mesh *mesh, struct zr_rings rings)
{
    struct footprint print = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t begin = rings.offsets[r], end = rings.offsets[r + 1];
        double doubled = 0.0, before[2], at[2];
        struct footprint last = print;
        include(tally, &last, mesh->positions[mesh->indices[end - 1]], before);
        for (uint32_t i = begin; i < end; i++) {
            include(tally, &print, mesh->positions[mesh->indices[i]], at);
            doubled += before[0] * at[1] - at[0] * before[1];
            print.perimeter += fmax(fabs(at[0] - before[0]), fabs(at[1] - before[1]));
            before[0] = at[0];
            before[1] = at[1];
        }
        print.area += 0.5 * fabs(doubled);
        print.net += 0.5 * doubled;
    }
    return print;
}

/* Returns the share of an extent inside 0..size; extents count as at least one pixel. */
static double share_within(double low, double high, double size)
{
    const double within = fmin(high, size) - fmax(low, 0.0);
    return within < 0.0 ? 0.0 : fmin(fmax(within, 1.0) / fmax(high - low, 1.0), 1.0);
}

/* Estimates the pixels of a face in the window; a face with corners on both sides of the eye counts as the whole
 * window. */
static double pixels_in_window(const struct tally *tally, const struct footprint *print)
{
    const double window = tally->sums.width * tally->sums.height;
    if (print->in_front == 0) return 0.0;
    if (print->behind > 0) return window;
    const double pixels = print->area * share_within(print->low[0], print->high[0], tally->sums.width) *
                          share_within(print->low[1], print->high[1], tally->sums.height);
    return pixels < window ? pixels : window; /* NaN: all of it */
}

/* Estimates the length of a face's edges in the window, pixels. */
static double length_in_window(const struct tally *tally, const struct footprint *print)
{
    if (print->in_front == 0) return 0.0;
    if (print->behind > 0) return tally->sums.width + tally->sums.height;
    const double share = fmin(share_within(print->low[0], print->high[0], tally->sums.width),
                              share_within(print->low[1], print->high[1], tally->sums.height));
    const double most = (tally->sums.width + tally->sums.height) * (print->in_front);
    return print->perimeter * share < most ? print->perimeter * share : most;
}

static void add_layers(struct tally *tally, const struct zr_material *material, double pixels, double kept)
{
    if (!zr_material_is_layered(material)) return;
    tally->sums.layered += pixels;
    if (material->alpha_mode == ZR_ALPHA_MASK || zr_material_has_textures(material)) return;
    tally->sums.kept += kept;
    tally->kept_squares += kept * kept;
}

/* Cost of a light per pixel without linear light, relative to linear light. */
static const double TEXTBOOK_LAMP_TIMES = 0.2;

/* Counts the lights of a material; `placed`: point and spot lights, `shadows`: lights with shadow maps. */
static void count_lamps(const struct zr_scene *scene, const struct zr_material *material, double *all, double *placed,
                        double *shadows)
{
    const bool is_pbr = material->shading == ZR_SHADING_PBR;
    *all = *placed = *shadows = 0.0;
    if (material->shading == ZR_SHADING_UNLIT || material->shading == ZR_SHADING_NORMALS) return;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        if (light->lit == (is_pbr ? ZR_LIT_CLASSIC : ZR_LIT_PBR)) continue;
        *all += 1.0;
        *placed += zr_light_has_place(light);
        *shadows += zr_light_casts_shadows(light);
    }
}

static void add_light(struct tally *tally, const struct zr_material *material, double pixels, double vertices)
{
    const double lit = tally->sums.scene->picture->is_linear ? pixels : TEXTBOOK_LAMP_TIMES * pixels;
    double all, placed, shadows;
    count_lamps(tally->sums.scene, material, &all, &placed, &shadows);
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        tally->sums.textures += material->textures[slot] ? pixels : 0.0;
    if (tally->sums.scene->picture->is_linear || material->shading == ZR_SHADING_PHONG) {
        tally->sums.lit += material->shading == ZR_SHADING_UNLIT ? 0.0 : pixels;
        tally->sums.lamps += lit * all;
        tally->sums.placed_lamps += lit * placed;
        tally->sums.shadows += pixels * shadows;
    } else if (material->shading == ZR_SHADING_FLAT || material->shading == ZR_SHADING_GOURAUD) {
        tally->sums.vertex_lamps += vertices * all;
        tally->sums.vertex_placed_lamps += vertices * placed;
    }
}

/* Counts the planes that have corners of the face on both sides. */
static void add_crossings(struct tally *tally, const struct zr_mesh *mesh, uint32_t face)
{
    for (uint32_t k = 0; k < tally->planes.count; k++) {
        const struct zr_section_plane *plane = &tally->planes.at[k];
        bool has_kept = false, has_cut = false;
        for (uint32_t i = mesh->face_offsets[face]; i < mesh->face_offsets[face + 1]; i++) {
            const zr_vec4 p = zr_mat4_apply(tally->object_to_world, mesh->positions[mesh->indices[i]]);
            const double side =
                ((plane->normal[0] * (double)p.x + plane->normal[1] * (double)p.y) + plane->normal[2] * (double)p.z) +
                plane->offset * (double)p.w;
            has_kept = has_kept || side > 0.0;
            has_cut = has_cut || !(side > 0.0);
        }
        tally->sums.cap_corners += has_kept && has_cut;
    }
}

/* Takes a face before the eye. */
static void add_plate(struct tally *tally, const struct zr_mesh *mesh, struct zr_rings rings,
                      const struct footprint *print)
{
    const uint32_t begin = rings.offsets[0], corners = rings.offsets[1] - begin;
    if (!tally->takes_plate || tally->plate_count == PLATES || print->behind > 0 || corners < 3) return;
    struct plate *plate = &tally->plates[tally->plate_count++];
    for (uint32_t i = 0; i < 3; i++) {
        const zr_vec4 position = mesh->positions[mesh->indices[begin + i * corners / 3]];
        const zr_vec4 clip = zr_mat4_apply(&tally->object_to_clip, position);
        plate->at[i][0] = (0.5 + 0.5 * (double)clip.x / (double)clip.w) * tally->sums.width;
        plate->at[i][1] = (0.5 + 0.5 * (double)clip.y / (double)clip.w) * tally->sums.height;
        plate->at[i][2] = (double)clip.z / (double)clip.w;
    }
    for (int k = 0; k < 2; k++) {
        plate->low[k] = print->low[k];
        plate->high[k] = print->high[k];
    }
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

static void cross(const double u[3], const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

static double dot(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static bool is_inside(const struct plate *plate, const double normal[3], const double at[3])
{
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; i++) {
        double edge[3], to[3], side[3];
        subtract(plate->at[(i + 1) % 3], plate->at[i], edge);
        subtract(at, plate->at[i], to);
        cross(edge, to, side);
        positive += dot(side, normal) > 0.0;
        negative += dot(side, normal) < 0.0;
    }
    return positive == 3 || negative == 3;
}

/* Returns true if an edge of `b` goes through `a`. Corners that are nearly in the plane of `a` count as in it: faces
 * that share corners do not cross. */
static bool is_pierced(const struct plate *a, const struct plate *b)
{
    double u[3], v[3], normal[3], to[3], side[3];
    subtract(a->at[1], a->at[0], u);
    subtract(a->at[2], a->at[0], v);
    cross(u, v, normal);
    for (int i = 0; i < 3; i++) {
        subtract(b->at[i], a->at[0], to);
        side[i] = dot(to, normal);
    }
    const double least = 1e-3 * fmax(fmax(fabs(side[0]), fabs(side[1])), fabs(side[2]));
    for (int i = 0; i < 3; i++) {
        const double p = side[i], q = side[(i + 1) % 3];
        if (fmin(p, q) > -least || fmax(p, q) < least) continue;
        for (int k = 0; k < 3; k++)
            to[k] = b->at[i][k] + p / (p - q) * (b->at[(i + 1) % 3][k] - b->at[i][k]);
        if (is_inside(a, normal, to)) return true;
    }
    return false;
}

static bool plates_meet(const struct plate *a, const struct plate *b)
{
    return a->low[0] < b->high[0] && b->low[0] < a->high[0] && a->low[1] < b->high[1] && b->low[1] < a->high[1];
}

/* Returns a lower bound of the share of pairs that cut one another: two standard deviations below that of the sample,
 * since many faces have very many pairs. */
static double find_crossing(const struct tally *tally)
{
    const uint32_t count = tally->plate_count;
    double crossings = 0.0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < i; k++) {
            const struct plate *a = &tally->plates[i], *b = &tally->plates[k];
            crossings += plates_meet(a, b) && (is_pierced(a, b) || is_pierced(b, a));
        }
    if (count < 2) return 0.0;
    return fmax(crossings - 2.0 * sqrt(crossings), 0.0) / (0.5 * (double)count * (double)(count - 1));
}

static void add_face(struct tally *tally, const struct zr_mesh *mesh, uint32_t face)
{
    const struct zr_material *material = zr_material_of_face(tally->sums.scene, mesh, face);
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const struct footprint print = footprint_of(tally, mesh, rings);
    const double corners = (double)(rings.offsets[rings.count] - rings.offsets[0]);
    const double shared = (double)mesh->position_count / (double)mesh->face_offsets[mesh->face_count];
    if (material->outline != ZR_OUTLINE_NONE) {
        tally->sums.line_fragments += tally->line_width * length_in_window(tally, &print);
        tally->sums.outlines += corners;
    }
    add_crossings(tally, mesh, face);
    if (material->unfilled) return;
    if (mesh->face_materials && face > 0 && mesh->face_materials[face] != mesh->face_materials[face - 1])
        tally->sums.runs += 1.0;
    const bool shape = zr_face_is_shape(mesh, face);
    const bool is_back = print.behind == 0 && (tally->is_mirrored ? print.net > 0.0 : print.net < 0.0);
    const double pixels = is_back && !material->double_sided ? 0.0 : pixels_in_window(tally, &print);
    const double vertices = material->shading == ZR_SHADING_FLAT ? 1.0 : corners * fmin(shared, 1.0);
    add_light(tally, material, pixels, vertices);
    if (shape) {
        tally->sums.shape_corners += corners * corners;
        tally->sums.shape_samples += pixels * corners;
    }
    if (pixels <= 0.0) return;
    const bool is_whole = print.behind == 0 && print.low[0] >= 0.0 && print.low[1] >= 0.0 &&
                          print.high[0] <= tally->sums.width && print.high[1] <= tally->sums.height && corners == 3.0;
    add_layers(tally, material, pixels, is_whole ? fmax(pixels - 0.5 * print.perimeter, 0.0) : 0.0);
    add_plate(tally, mesh, rings, &print);
    tally->sums.faces += 1.0;
    tally->sums.fragments += pixels;
    tally->sums.boxes_width += fmin(print.high[0] - print.low[0], tally->sums.width);
    tally->sums.boxes_height += fmin(print.high[1] - print.low[1], tally->sums.height);
}

static void add_line(struct tally *tally, const struct zr_mesh *mesh, const uint32_t ends[2])
{
    const uint32_t offsets[2] = {0, 2};
    struct zr_mesh line = *mesh;
    line.indices = ends;
    struct footprint print = footprint_of(tally, &line, (struct zr_rings){1, offsets});
    print.perimeter *= 0.5; /* footprint_of adds the line twice, as a closed ring */
    const double pixels = tally->line_width * length_in_window(tally, &print);
    tally->sums.line_fragments += pixels;
    add_layers(tally, &tally->sums.scene->materials[mesh->material], pixels, 0.0);
}

/* Cost of a translucent pixel of a point, relative to a pixel of a face. */
static const double POINT_LAYER_TIMES = 3.0;

/* Counts the part of the point's square inside the window. */
static void add_point(struct tally *tally, const struct zr_mesh *mesh, uint32_t position)
{
    struct footprint print = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    const double size = fmax((double)mesh->point_size, 1.0);
    double at[2];
    include(tally, &print, mesh->positions[position], at);
    if (print.in_front == 0) return;
    const double across = fmin(at[0] + 0.5 * size, tally->sums.width) - fmax(at[0] - 0.5 * size, 0.0);
    const double up = fmin(at[1] + 0.5 * size, tally->sums.height) - fmax(at[1] - 0.5 * size, 0.0);
    const double pixels = fmax(across, 0.0) * fmax(up, 0.0);
    tally->sums.line_fragments += pixels;
    add_layers(tally, &tally->sums.scene->materials[mesh->material], POINT_LAYER_TIMES * pixels, 0.0);
}

static void add_primitive(struct tally *tally, const struct zr_mesh *mesh, uint32_t number)
{
    if (number < mesh->face_count)
        add_face(tally, mesh, number);
    else if (number - mesh->face_count < mesh->line_count)
        add_line(tally, mesh, mesh->lines + 2 * (size_t)(number - mesh->face_count));
    else
        add_point(tally, mesh, zr_mesh_point(mesh, number - mesh->face_count - mesh->line_count));
}

/* Returns the n-th pseudo-random number, the same on every machine (Steele's splitmix64). */
static uint64_t scatter(uint64_t n)
{
    n = (n + 1) * 0x9e3779b97f4a7c15u;
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
    return n ^ (n >> 31);
}

/* Adds one primitive from each of `samples` equal ranges, at a pseudo-random place, so that regular patterns in the
 * scene do not bias the sample. */
static void walk(struct tally *tally, uint64_t primitives, uint64_t samples)
{
    const struct zr_mesh *mesh = NULL;
    uint64_t first = 0, end = 0; /* range of `mesh` in the numbers of primitives over all instances */
    uint32_t next_instance = 0;
    for (uint64_t k = 0; k < samples; k++) {
        const uint64_t begin = k * primitives / samples, size = (k + 1) * primitives / samples - begin;
        const uint64_t primitive = begin + scatter(k) % size;
        const struct zr_instance *instance = NULL;
        while (primitive >= end) {
            instance = &tally->sums.scene->instances[next_instance++];
            mesh = &tally->sums.scene->meshes[instance->mesh];
            first = end;
            end += zr_mesh_ids(mesh);
        }
        if (instance) {
            tally->object_to_world = &instance->object_to_world;
            tally->object_to_clip = zr_mat4_mul(&tally->world_to_clip, &instance->object_to_world);
            tally->is_mirrored = zr_camera_reverses_windings(tally->camera, &instance->object_to_world);
        }
        tally->takes_plate = k % ((samples + PLATES - 1) / PLATES) == 0;
        add_primitive(tally, mesh, (uint32_t)(primitive - first));
    }
}

/* Returns a lower bound of the translucent fragments that rendering keeps: the mean of the sample less six standard
 * deviations of that mean, for all primitives. */
static double kept_at_least(const struct tally *tally, double samples, double scale)
{
    if (scale <= 1.0) return tally->sums.kept;
    const double mean = tally->sums.kept / samples, square = tally->kept_squares / samples;
    return fmax(mean - 6.0 * sqrt(fmax(square - mean * mean, 0.0) / samples), 0.0) * samples * scale;
}

struct zr_cost_sample zr_cost_sample_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    const struct zr_view *view = &scene->views[0];
    struct tally tally = {.sums = {.scene = scene, .width = (double)view->width, .height = (double)view->height},
                          .line_width = fmax((double)scene->picture->line_width, 1.0),
                          .world_to_clip = zr_mat4_mul(&resolved->camera.projection, &resolved->camera.world_to_eye),
                          .camera = &resolved->camera};
    uint64_t primitives = 0, corners = 0;
    struct zr_error error = {.count = 0};
    if (zr_section_planes_find(scene, resolved, &tally.planes, &error) != ZR_OK) tally.planes.count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        primitives += zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
        corners += zr_mesh_corners(&scene->meshes[scene->instances[i].mesh]);
    }
    const double per_primitive = (double)corners / fmax((double)primitives, 1.0);
    const double most = fmin(fmax(SAMPLED_CORNERS / fmax(per_primitive, 1.0), 1.0), SAMPLES);
    const uint64_t samples = primitives < (uint64_t)most ? primitives : (uint64_t)most;
    const double scale = samples > 0 ? (double)primitives / (double)samples : 0.0;
    walk(&tally, primitives, samples);
    tally.sums.scale = scale;
    tally.sums.crossing = find_crossing(&tally);
    tally.sums.kept = kept_at_least(&tally, (double)samples, scale);
    return tally.sums;
}
