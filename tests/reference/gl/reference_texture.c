#include "reference/gl/reference_texture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- levels ---- */

struct level {
    uint32_t width, height;
    uint16_t *values; /* four a texel, of 8 or 16 bits */
};

static double decoded(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double encoded(double v)
{
    return v <= 0.0031308 ? v * 12.92 : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
}

static bool level_of_image(const struct zr_image *image, struct level *out)
{
    const size_t count = (size_t)image->width * image->height * 4;
    *out = (struct level){image->width, image->height, malloc(count * sizeof *out->values)};
    for (size_t i = 0; out->values && i < count; i++)
        out->values[i] = image->bits == 8 ? ((const uint8_t *)image->texels)[i] : ((const uint16_t *)image->texels)[i];
    return out->values;
}

/* How much of `small` pieces number i covers of piece j of a side of `large`; all in parts of large * small. */
static uint64_t overlap(uint64_t large, uint64_t small, uint64_t i, uint64_t j)
{
    const uint64_t low = i * large > j * small ? i * large : j * small;
    const uint64_t high = (i + 1) * large < (j + 1) * small ? (i + 1) * large : (j + 1) * small;
    return high > low ? high - low : 0;
}

static uint16_t mean_of(const struct level *from, const struct level *to, uint32_t x, uint32_t y, uint32_t channel,
                        uint32_t largest, bool decode)
{
    uint64_t sum = 0, all = 0;
    double light = 0.0;
    const uint32_t x0 = (uint32_t)((uint64_t)x * from->width / to->width),
                   y0 = (uint32_t)((uint64_t)y * from->height / to->height);
    for (uint32_t v = y0; v < from->height && v < y0 + 4; v++)
        for (uint32_t u = x0; u < from->width && u < x0 + 4; u++) {
            const uint64_t share = overlap(from->width, to->width, x, u) * overlap(from->height, to->height, y, v);
            const uint32_t value = from->values[4 * ((size_t)v * from->width + u) + channel];
            sum += share * value;
            all += share;
            light += (double)share * decoded((double)value / largest);
        }
    if (decode && channel < 3) return (uint16_t)floor(encoded(light / (double)all) * largest + 0.5);
    return (uint16_t)((2 * sum + all) / (2 * all));
}

static bool halve(const struct level *from, uint32_t largest, bool decode, struct level *to)
{
    to->width = from->width > 1 ? from->width / 2 : 1;
    to->height = from->height > 1 ? from->height / 2 : 1;
    to->values = malloc((size_t)to->width * to->height * 4 * sizeof *to->values);
    for (uint32_t y = 0; to->values && y < to->height; y++)
        for (uint32_t x = 0; x < to->width; x++)
            for (uint32_t c = 0; c < 4; c++)
                to->values[4 * ((size_t)y * to->width + x) + c] = mean_of(from, to, x, y, c, largest, decode);
    return to->values;
}

/* ---- upload ---- */

static bool upload_floats(const struct level *level, GLint number, uint32_t largest, bool decode)
{
    const size_t count = (size_t)level->width * level->height * 4;
    float *floats = malloc(count * sizeof *floats);
    for (size_t i = 0; floats && i < count; i++) {
        const double value = (double)level->values[i] / largest;
        floats[i] = (float)(decode && i % 4 < 3 ? decoded(value) : value);
    }
    if (floats)
        glTexImage2D(GL_TEXTURE_2D, number, GL_RGBA32F, (GLsizei)level->width, (GLsizei)level->height, 0, GL_RGBA,
                     GL_FLOAT, floats);
    free(floats);
    return floats;
}

/* Opaque, as what we draw is where nothing is see-through. */
static bool upload_bits(const struct level *level, GLint number, uint32_t largest, bool opaque)
{
    const size_t count = (size_t)level->width * level->height * 4;
    uint16_t *words = malloc(count * sizeof *words);
    uint8_t *bytes = malloc(count);
    for (size_t i = 0; words && bytes && i < count; i++) {
        words[i] = (uint16_t)(opaque && i % 4 == 3 ? largest : level->values[i]);
        bytes[i] = (uint8_t)words[i];
    }
    if (words && bytes)
        glTexImage2D(GL_TEXTURE_2D, number, largest == 255 ? GL_RGBA8 : GL_RGBA16, (GLsizei)level->width,
                     (GLsizei)level->height, 0, GL_RGBA, largest == 255 ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT,
                     largest == 255 ? (const void *)bytes : (const void *)words);
    const bool good = words && bytes;
    free(words);
    free(bytes);
    return good;
}

static bool upload_levels(const struct zr_scene *scene, const struct zr_texture *texture, bool decode)
{
    const struct zr_image *image = &scene->images[texture->image];
    const uint32_t largest = image->bits == 8 ? 255 : 65535;
    const bool light = decode && texture->is_color;
    const bool opaque = !zr_any_is_see_through(scene->materials, scene->material_count);
    struct level level, next;
    bool good = level_of_image(image, &level);
    for (GLint number = 0; good; number++) {
        good = decode ? upload_floats(&level, number, largest, light) : upload_bits(&level, number, largest, opaque);
        if (!good || !zr_filter_has_levels(texture->minify) || (level.width == 1 && level.height == 1)) break;
        good = halve(&level, largest, light, &next);
        free(level.values);
        level = next;
    }
    free(level.values);
    return good;
}

static void set_sampler(const struct zr_texture *texture)
{
    static const GLint wraps[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
    static const GLint filters[] = {GL_NEAREST,
                                    GL_LINEAR,
                                    GL_NEAREST_MIPMAP_NEAREST,
                                    GL_LINEAR_MIPMAP_NEAREST,
                                    GL_NEAREST_MIPMAP_LINEAR,
                                    GL_LINEAR_MIPMAP_LINEAR};
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wraps[texture->wrap_s]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wraps[texture->wrap_t]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filters[texture->magnify]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filters[texture->minify]);
}

GLuint *reference_textures_make(const struct zr_scene *scene, bool decode, struct reference_error *error)
{
    GLuint *names = calloc(scene->texture_count, sizeof *names);
    bool good = names;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (good) glGenTextures((GLsizei)scene->texture_count, names);
    for (uint32_t i = 0; good && i < scene->texture_count; i++) {
        glBindTexture(GL_TEXTURE_2D, names[i]);
        set_sampler(&scene->textures[i]);
        good = upload_levels(scene, &scene->textures[i], decode) && reference_gl_ok(error, "texture");
    }
    if (good) return names;
    if (names) reference_textures_delete(scene, names);
    return NULL;
}

void reference_textures_delete(const struct zr_scene *scene, GLuint *names)
{
    glDeleteTextures((GLsizei)scene->texture_count, names);
    free(names);
}

/* ---- tables ---- */

GLuint reference_table_make(const float *fours, uint32_t count, struct reference_error *error)
{
    const uint32_t rows = (count + REFERENCE_TABLE_ROW - 1) / REFERENCE_TABLE_ROW;
    float *whole = calloc((size_t)rows * REFERENCE_TABLE_ROW, 4 * sizeof *whole);
    GLuint table = 0;
    if (!whole) return 0;
    memcpy(whole, fours, (size_t)count * 4 * sizeof *whole);
    glGenTextures(1, &table);
    glActiveTexture(GL_TEXTURE0 + REFERENCE_TABLE_UNIT);
    glBindTexture(GL_TEXTURE_2D, table);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, REFERENCE_TABLE_ROW, (GLsizei)rows, 0, GL_RGBA, GL_FLOAT, whole);
    glActiveTexture(GL_TEXTURE0);
    free(whole);
    if (reference_gl_ok(error, "table")) return table;
    reference_table_delete(table);
    return 0;
}

void reference_table_delete(GLuint table)
{
    glDeleteTextures(1, &table);
}

void reference_textures_bind(const GLuint *names, const struct zr_material *material)
{

    for (int slot = ZR_TEXTURE_SLOTS - 1; slot >= 0; slot--) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)slot);
        if (material->textures[slot]) glBindTexture(GL_TEXTURE_2D, names[material->textures[slot] - 1]);
    }
}
