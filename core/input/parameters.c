#include "input/parameters.h"

#include <float.h>
#include <string.h>

#include "input/color_text.h"
#include "input/formats.h"
#include "input/number.h"
#include "input/outputs.h"
#include "input/text.h"
#include "scene/defaults.h"

struct reading {
    const struct zr_request *request;
    const struct zr_limits *limits;
    struct zr_query *query;
    struct zr_error *error;
};

/* ---- values ---- */

static void refuse(const struct reading *r, const char *name, const char *text, const char *wanted)
{
    zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameter %s: %s is not %s", name,
                 zr_quote(text, strlen(text)).text, wanted);
}

/* False after reporting. */
static bool read_word(const struct reading *r, const char *name, const char *text, const struct zr_names *names,
                      int *out)
{
    const int found = zr_names_of_query(name, names, text, r->error);
    if (found >= 0) *out = found;
    return found >= 0;
}

static bool read_flag(const struct reading *r, const char *name, const char *text, int *out)
{
    static const char *const words[] = {"false", "true", "0", "1"};
    static const struct zr_names names = ZR_NAMES(4, words);
    int found = 0;
    if (!read_word(r, name, text, &names, &found)) return false;
    *out = found % 2;
    return true;
}

/* Digits alone, at least one of them; beyond UINT32_MAX all numbers are some number that is. */
static bool read_whole(const char *text, uint64_t *value)
{
    const char *at = text;
    for (*value = 0; *at >= '0' && *at <= '9'; at++)
        if (*value <= UINT32_MAX) *value = *value * 10 + (uint64_t)(*at - '0');
    return *at == '\0' && at != text;
}

static void read_side(const struct reading *r, const char *name, const char *text, uint32_t *out)
{
    const uint32_t most = r->limits->window_side_max;
    uint64_t value;
    if (!read_whole(text, &value) || value < 1)
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL,
                     "query parameter %s: %s is not a whole number of pixels from 1 to %u", name,
                     zr_quote(text, strlen(text)).text, most);
    else if (value > most) /* well-formed, but more than may be drawn: as in a scene */
        zr_error_add(r->error, ZR_BAD_SCENE, NULL, "query parameter %s: %s pixels; 1 to %u are allowed", name,
                     zr_quote(text, strlen(text)).text, most);
    else
        *out = (uint32_t)value;
}

static void read_degrees(const struct reading *r, const char *name, const char *text, double most, double *out)
{
    const char *end = text + strlen(text);
    double value;
    if (zr_number_read(text, end, &value) != end || !(value >= -most) || !(value <= most))
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameter %s: %s is not a number of degrees from %g to %g",
                     name, zr_quote(text, strlen(text)).text, -most, most);
    else
        *out = value;
    r->query->view.pose = ZR_POSE_ORBIT;
    if (r->request->preset)
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameters preset and %s: each says where to look from",
                     name);
}

static bool read_opaque(const struct reading *r, const char *name, const char *text, zr_vec4 *out)
{
    zr_vec4 color;
    if (!zr_color_of_text(text, strlen(text), &color)) {
        refuse(r, name, text, "a colour: #rrggbb, #rgb, or a name of CSS");
        return false;
    }
    if (color.w < 1.0f) {
        refuse(r, name, text, "opaque, and only the background may be transparent");
        return false;
    }
    *out = color;
    return true;
}

/* ---- parameters ---- */

static void read_channel(const struct reading *r, const char *text)
{
    struct zr_output *output = &r->query->output;
    int channel;
    r->query->has_output = true;
    if (!read_word(r, "channel", text, &zr_channel_names, &channel)) return;
    output->channel = (enum zr_channel)channel;
    output->encoding = zr_channel_rows[channel].encodings[0];
}

static void read_encoding(const struct reading *r, const char *text)
{
    struct zr_output *output = &r->query->output;
    const int encoding = zr_names_find(&zr_encoding_names, text);
    const bool is_known = encoding >= 0 && encoding < zr_encoding_names.count;
    r->query->has_output = true;
    if (r->error->count > 0) return; /* of which channel is not known */
    if (is_known && zr_channel_has(output->channel, (enum zr_encoding)encoding))
        output->encoding = (enum zr_encoding)encoding;
    else
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL,
                     "query parameter encoding: %s is not one that the channel %s has; allowed: %s",
                     zr_quote(text, strlen(text)).text, zr_channel_rows[output->channel].name,
                     zr_channel_encodings_join(output->channel).text);
}

static void read_scale(const struct reading *r, const char *text)
{
    const char *end = text + strlen(text);
    double value;
    r->query->has_output = true;
    if (r->error->count > 0) return;
    if (r->query->output.encoding != ZR_ENCODING_PNG16)
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameter scale: only the encoding png16 has one");
    else if (zr_number_read(text, end, &value) != end || !(value <= (double)FLT_MAX) || !((float)value > 0.0f))
        refuse(r, "scale", text, "a number greater than 0");
    else
        r->query->output.scale = (float)value;
}

static void read_pixel(const struct reading *r, const char *name, const char *text, uint32_t *out)
{
    uint64_t value;
    r->query->has_output = true;
    if (r->error->count > 0) return;
    if (r->query->output.channel != ZR_CHANNEL_FRAGMENTS)
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameter %s: only the channel fragments has one", name);
    else if (!read_whole(text, &value) || value > UINT32_MAX)
        refuse(r, name, text, "the number of a pixel, counted from 0");
    else
        *out = (uint32_t)value;
}

static void read_x(const struct reading *r, const char *text)
{
    read_pixel(r, "x", text, &r->query->output.x);
}

static void read_y(const struct reading *r, const char *text)
{
    read_pixel(r, "y", text, &r->query->output.y);
}

static void read_compress(const struct reading *r, const char *text)
{
    int compress = 0;
    r->query->has_compress = read_word(r, "compress", text, &zr_compress_names, &compress);
    if (r->query->has_compress) r->query->compress = (enum zr_compress)compress;
}

static void read_strict(const struct reading *r, const char *text)
{
    int strict = 0;
    if (read_flag(r, "strict", text, &strict)) r->query->is_strict = strict != 0;
}

static void read_colorBar(const struct reading *r, const char *text)
{
    r->query->has_color_bar = read_flag(r, "colorBar", text, &r->query->color_bar);
}

/* Before all that goes over it. */
static void use_look(struct zr_query *query, const struct zr_look *look)
{
    query->look = look;
    query->background = look->background;
    zr_look_set_view(look, &query->view);
}

static void read_look(const struct reading *r, const char *text)
{
    const struct zr_look *look = zr_look_find(text);
    if (look)
        use_look(r->query, look);
    else
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "query parameter look: %s", zr_looks_refuse(text).text);
}

static void read_samples(const struct reading *r, const char *text)
{
    static const char *const words[] = {"1", "4", "16", "64"};
    static const struct zr_names names = ZR_NAMES(4, words);
    int found = 0;
    if (!read_word(r, "samples", text, &names, &found)) return;
    r->query->picture.picture.side = UINT32_C(1) << found;
    zr_picture_give(&r->query->picture, ZR_PICTURE_SIDE);
}

static void read_width(const struct reading *r, const char *text)
{
    read_side(r, "width", text, &r->query->view.width);
}

static void read_height(const struct reading *r, const char *text)
{
    read_side(r, "height", text, &r->query->view.height);
}

static void read_preset(const struct reading *r, const char *text)
{
    int preset;
    if (!read_word(r, "preset", text, &zr_preset_names, &preset)) return;
    r->query->view.preset = (enum zr_preset)preset;
    r->query->view.pose = ZR_POSE_PRESET;
}

static void read_azimuth(const struct reading *r, const char *text)
{
    read_degrees(r, "azimuth", text, 1e6, &r->query->view.azimuth_degrees);
}

static void read_elevation(const struct reading *r, const char *text)
{
    read_degrees(r, "elevation", text, 90, &r->query->view.elevation_degrees);
}

static void read_up(const struct reading *r, const char *text)
{
    int axis = 0;
    read_word(r, "up", text, &zr_up_names, &axis);
    r->query->z_is_up = axis == 1;
}

static void read_projection(const struct reading *r, const char *text)
{
    static const char *const words[] = {"orthographic", "perspective"};
    static const struct zr_names names = ZR_NAMES(2, words);
    int projection = 0;
    if (!read_word(r, "projection", text, &names, &projection)) return;
    r->query->view.projection = projection == 0 ? ZR_PROJECTION_ORTHOGRAPHIC : ZR_PROJECTION_PERSPECTIVE;
}

static void read_shading(const struct reading *r, const char *text)
{
    read_word(r, "shading", text, &zr_shading_names, &r->query->face_style.shading);
}

static void read_color(const struct reading *r, const char *text)
{
    r->query->has_color = read_opaque(r, "color", text, &r->query->color);
}

static void read_background(const struct reading *r, const char *text)
{
    zr_picture_give(&r->query->picture, ZR_PICTURE_BACKGROUND);
    if (strcmp(text, "transparent") == 0)
        r->query->background = (zr_vec4){0, 0, 0, 0};
    else if (!zr_color_of_text(text, strlen(text), &r->query->background))
        refuse(r, "background", text, "a colour: transparent, #rrggbb, #rrggbbaa, #rgb, #rgba, or a name of CSS");
}

static void read_outline(const struct reading *r, const char *text)
{
    struct zr_face_style *faces = &r->query->face_style;
    if (strcmp(text, "false") == 0)
        faces->outline = ZR_OUTLINE_SET_OFF;
    else if (strcmp(text, "true") == 0)
        faces->outline = ZR_OUTLINE_SET_ON;
    else if (read_opaque(r, "outline", text, &faces->outline_color))
        faces->outline = ZR_OUTLINE_SET_COLOR;
}

static void read_fill(const struct reading *r, const char *text)
{
    read_flag(r, "fill", text, &r->query->face_style.fill);
}

static void read_doubleSided(const struct reading *r, const char *text)
{
    read_flag(r, "doubleSided", text, &r->query->face_style.double_sided);
}

/* ---- all of them ---- */

enum whose { ANY, MESH };

/* The angle of a look that is orthographic is that of scenes. */
static void find_fov(struct zr_query *query)
{
    const float look = query->look->view.fov_radians;
    zr_view_set_fov(&query->view, 0.0f);
    if (query->view.projection != ZR_PROJECTION_PERSPECTIVE) return;
    if (look > 0.0f)
        zr_view_set_fov(&query->view, look);
    else
        query->view.yfov_radians = ZR_YFOV;
}

enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             const struct zr_scene *defaults, struct zr_query *query, struct zr_error *error)
{
    const struct reading r = {request, limits, query, error};
    const struct zr_format_row *format = &zr_format_rows[request->format];
    *query = (struct zr_query){.output = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                               .z_is_up = format->z_is_up,
                               .view = defaults->views[0],
                               .face_style = zr_face_style_unset};
    query->face_style.double_sided = true; /* nobody said which side is meant */
    use_look(query, zr_look_find("studio"));
#define PARAMETER(name, of, value, words) {#name, request->name, of, read_##name},
    const struct {
        const char *name, *text;
        enum whose of;
        void (*read)(const struct reading *r, const char *text);
    } rows[] = {ZR_PARAMETER_ROWS(PARAMETER)};
#undef PARAMETER
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (!rows[i].text) continue;
        if (rows[i].of == MESH && format->has_view)
            zr_error_add(error, ZR_BAD_REQUEST, NULL,
                         "query parameter %s belongs to bodies that are a bare mesh; a scene says it in its own keys",
                         rows[i].name);
        else
            rows[i].read(&r, rows[i].text);
    }
    find_fov(query);
    if (error->count == 0 && query->output.channel == ZR_CHANNEL_FRAGMENTS && !(request->x && request->y))
        zr_error_add(error, ZR_BAD_REQUEST, NULL,
                     "query parameter %s: missing; the channel fragments is of the pixel that x and y say",
                     request->x ? "y" : "x");
    return error->count > 0 ? error->status : ZR_OK;
}
