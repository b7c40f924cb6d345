#include "sections/hatch.h"

/* Texels per line and gap; those of the line; and its shade, which multiplies the colour of the part. */
enum { PERIOD = 64, INK = 10, SHADE = 96 };

/* Largest distance from the first corner of a face, in lines, at which floats resolve them. */
#define FROM_MAX 1e4

uint32_t zr_hatch_texture(const struct zr_scene *scene)
{
    return scene->texture_count + 1;
}

bool zr_hatch_add(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_image *images = zr_arena_alloc(arena, (size_t)scene->image_count + 1, sizeof *images);
    struct zr_texture *textures = zr_arena_alloc(arena, (size_t)scene->texture_count + 1, sizeof *textures);
    uint8_t(*texels)[4] = zr_arena_alloc(arena, PERIOD, sizeof *texels);
    if (!zr_arena_ok(arena)) return false;
    for (int i = 0; i < PERIOD; i++) {
        const uint8_t shade = i < INK ? SHADE : 255;
        texels[i][0] = texels[i][1] = texels[i][2] = shade;
        texels[i][3] = 255;
    }
    for (uint32_t i = 0; i < scene->image_count; i++)
        images[i] = scene->images[i];
    for (uint32_t i = 0; i < scene->texture_count; i++)
        textures[i] = scene->textures[i];
    images[scene->image_count] = (struct zr_image){PERIOD, 1, 8, texels, NULL};
    textures[scene->texture_count] = (struct zr_texture){.image = scene->image_count,
                                                         .magnify = ZR_FILTER_LINEAR,
                                                         .minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR,
                                                         .is_color = true,
                                                         .rows = {{1, 0, 0}, {0, 1, 0}}};
    scene->images = images;
    scene->image_count++;
    scene->textures = textures;
    scene->texture_count++;
    return true;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Computes the direction in which u grows, by 1 per unit of length along its direction. */
static void direction_of(const double normal[3], bool z_is_up, uint64_t part, double pitch, double out[3])
{
    static const double pitches[] = {1.0, 1.35, 1.7}, level = 0.9;
    double up[3] = {0, 0, 0}, e1[3], e2[3];
    const int axis = z_is_up ? 2 : 1;
    if (fabs(normal[axis]) > level)
        up[z_is_up ? 1 : 2] = z_is_up ? 1.0 : -1.0;
    else
        up[axis] = 1.0;
    cross(up, normal, e1);
    const double length = sqrt((e1[0] * e1[0] + e1[1] * e1[1]) + e1[2] * e1[2]);
    for (int k = 0; k < 3; k++)
        e1[k] /= length;
    cross(normal, e1, e2);
    const double scale = 1.0 / (sqrt(2.0) * pitch * pitches[part / 2 % 3]);
    for (int k = 0; k < 3; k++)
        out[k] = (part % 2 == 0 ? e1[k] + e2[k] : e1[k] - e2[k]) * scale;
}

static double along(const zr_mat4 *m, zr_vec4 p, const double direction[3])
{
    double at[4];
    for (int row = 0; row < 4; row++)
        at[row] = (((double)m->m[row] * (double)p.x + (double)m->m[4 + row] * (double)p.y) +
                   (double)m->m[8 + row] * (double)p.z) +
                  (double)m->m[12 + row] * (double)p.w;
    return ((direction[0] * at[0] + direction[1] * at[1]) + direction[2] * at[2]) / at[3];
}

void zr_hatch_put(const struct zr_mesh *mesh, uint32_t face, const zr_mat4 *object_to_world,
                  const struct zr_section_plane *plane, bool z_is_up, uint64_t part, double pitch, zr_vec4 *texcoords)
{
    double direction[3], whole = 0.0;
    direction_of(plane->normal, z_is_up, part, pitch, direction);
    for (uint32_t i = mesh->face_offsets[face]; i < mesh->face_offsets[face + 1]; i++) {
        const double u = along(object_to_world, mesh->positions[mesh->indices[i]], direction);
        if (i == mesh->face_offsets[face]) whole = floor(u);
        const double from = u - whole;
        texcoords[mesh->indices[i]] = (zr_vec4){fabs(from) < FROM_MAX ? (float)from : 0.0f, 0, 0, 0};
    }
}
