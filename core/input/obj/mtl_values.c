/* Reads the lines of a material. */
#include <stddef.h>
#include <string.h>

#include "input/obj/mtl_file.h"
#include "input/text/number.h"

enum kind {
    COLOR,       /* one number, or three */
    NUMBER,      /* one number, possibly after -halo */
    MAP,         /* an image */
    SILENT,      /* without effect, and without a warning */
    LEFT_OUT,    /* not drawn */
    UNLESS_ZERO, /* not drawn, except for 0 */
    UNLESS_ONE   /* not drawn, except for 1 */
};

struct row {
    const char *word;
    enum kind kind;
    size_t flag, offset; /* in struct zr_mtl_values */
    enum zr_mtl_map map;
};

#define AT(member) offsetof(struct zr_mtl_values, member)
#define VALUE(word, kind, of)                                                                                          \
    {                                                                                                                  \
        word, kind, AT(has_##of), AT(of), 0                                                                            \
    }
#define IMAGE(word, map)                                                                                               \
    {                                                                                                                  \
        word, MAP, 0, 0, map                                                                                           \
    }
#define OTHER(word, kind)                                                                                              \
    {                                                                                                                  \
        word, kind, 0, 0, 0                                                                                            \
    }

static const struct row rows[] = {VALUE("kd", COLOR, diffuse),
                                  VALUE("ks", COLOR, specular),
                                  VALUE("ke", COLOR, emission),
                                  VALUE("d", NUMBER, alpha),
                                  VALUE("tr", NUMBER, transparency),
                                  VALUE("ns", NUMBER, shininess),
                                  VALUE("pr", NUMBER, roughness),
                                  VALUE("pm", NUMBER, metallic),
                                  IMAGE("map_kd", ZR_MTL_MAP_COLOR),
                                  IMAGE("map_d", ZR_MTL_MAP_ALPHA),
                                  IMAGE("map_opacity", ZR_MTL_MAP_ALPHA),
                                  IMAGE("map_bump", ZR_MTL_MAP_BUMP),
                                  IMAGE("bump", ZR_MTL_MAP_BUMP),
                                  IMAGE("norm", ZR_MTL_MAP_NORMAL),
                                  IMAGE("map_kn", ZR_MTL_MAP_NORMAL),
                                  IMAGE("map_normal", ZR_MTL_MAP_NORMAL),
                                  IMAGE("map_ke", ZR_MTL_MAP_EMISSION),
                                  IMAGE("map_emissive", ZR_MTL_MAP_EMISSION),
                                  IMAGE("map_pr", ZR_MTL_MAP_ROUGHNESS),
                                  IMAGE("map_pm", ZR_MTL_MAP_METALLIC),
                                  OTHER("ka", SILENT),
                                  OTHER("ni", SILENT),
                                  OTHER("illum", SILENT),
                                  OTHER("sharpness", SILENT),
                                  OTHER("map_ka", SILENT),
                                  OTHER("map_aat", SILENT),
                                  OTHER("anisor", SILENT),
                                  OTHER("pcr", SILENT),
                                  OTHER("tf", UNLESS_ONE),
                                  OTHER("ps", UNLESS_ZERO),
                                  OTHER("pc", UNLESS_ZERO),
                                  OTHER("aniso", UNLESS_ZERO),
                                  OTHER("kt", LEFT_OUT),
                                  OTHER("map_ks", LEFT_OUT),
                                  OTHER("map_ns", LEFT_OUT),
                                  OTHER("map_tr", LEFT_OUT),
                                  OTHER("map_ps", LEFT_OUT),
                                  OTHER("map_pc", LEFT_OUT),
                                  OTHER("map_pcr", LEFT_OUT),
                                  OTHER("disp", LEFT_OUT),
                                  OTHER("map_disp", LEFT_OUT),
                                  OTHER("decal", LEFT_OUT),
                                  OTHER("refl", LEFT_OUT),
                                  OTHER("map_refl", LEFT_OUT)};

static const struct row *find_row(const struct zr_mtl_text *key)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (zr_mtl_is_word(key, rows[i].word)) return &rows[i];
    return NULL;
}

/* Reads up to `most` numbers, and leaves the words after them.
 * Returns their count, or 0 if a word is not a finite number. */
static int read_numbers(struct zr_mtl_text line, int most, float *out)
{
    int count = 0;
    while (count < most && line.at < line.end && *line.at != '#') {
        const struct zr_mtl_text word = zr_mtl_word(&line);
        double value;
        const char *behind = zr_number_read(word.at, word.end, &value);
        if (behind != word.end || !(value >= -1e30 && value <= 1e30)) return 0;
        out[count++] = (float)value;
    }
    return count;
}

static void read_color(struct zr_mtl *mtl, const struct zr_mtl_text *whole, const struct zr_mtl_text *line,
                       const struct row *row, struct zr_mtl_values *out)
{
    float v[3];
    const int count = read_numbers(*line, 3, v);
    if (count != 1 && count != 3) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_VALUE, whole);
        return;
    }
    if (count == 1) v[1] = v[2] = v[0];
    const bool may_exceed = row->offset == AT(emission);
    bool is_clamped = false;
    for (int k = 0; k < 3; k++) {
        is_clamped = is_clamped || v[k] < 0.0f || (v[k] > 1.0f && !may_exceed);
        v[k] = v[k] < 0.0f ? 0.0f : v[k] > 1.0f && !may_exceed ? 1.0f : v[k];
    }
    if (is_clamped) zr_mtl_note(mtl, ZR_MTL_NOTE_CLAMPED, whole);
    memcpy((char *)out + row->offset, v, sizeof v);
    memset((char *)out + row->flag, true, sizeof(bool));
}

static void read_number(struct zr_mtl *mtl, const struct zr_mtl_text *whole, struct zr_mtl_text line,
                        const struct row *row, struct zr_mtl_values *out)
{
    struct zr_mtl_text behind = line;
    const struct zr_mtl_text first = zr_mtl_word(&behind);
    const float most = row->offset == AT(shininess) ? 1e30f : 1.0f;
    float value;
    if (zr_mtl_is_word(&first, "-halo")) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_OPTION, whole);
        line = behind;
    }
    if (read_numbers(line, 1, &value) != 1) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_VALUE, whole);
        return;
    }
    if (!(value >= 0.0f && value <= most)) zr_mtl_note(mtl, ZR_MTL_NOTE_CLAMPED, whole);
    value = value > 0.0f ? value < most ? value : most : 0.0f;
    memcpy((char *)out + row->offset, &value, sizeof value);
    memset((char *)out + row->flag, true, sizeof(bool));
    if (row->offset == AT(alpha) || row->offset == AT(transparency)) out->alpha_line = *whole;
}

/* Counts a value for a warning, unless all its numbers are `idle`, which has no effect. */
static void read_idle(struct zr_mtl *mtl, const struct zr_mtl_text *whole, const struct zr_mtl_text *line, float idle)
{
    float v[3];
    const int count = read_numbers(*line, 3, v);
    bool is_idle = count > 0;
    for (int k = 0; k < count; k++)
        is_idle = is_idle && v[k] == idle;
    if (!is_idle) zr_mtl_note(mtl, ZR_MTL_NOTE_LEFT_OUT, whole);
}

static void read_line(struct zr_mtl *mtl, struct zr_mtl_text line, struct zr_mtl_values *out)
{
    const struct zr_mtl_text whole = line, key = zr_mtl_word(&line);
    const struct row *row = find_row(&key);
    if (!row) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_UNKNOWN, &whole);
        return;
    }
    switch (row->kind) {
    case COLOR:
        read_color(mtl, &whole, &line, row, out);
        break;
    case NUMBER:
        read_number(mtl, &whole, line, row, out);
        break;
    case MAP:
        zr_mtl_read_map(mtl, &whole, line, &out->maps[row->map]);
        break;
    case LEFT_OUT:
        zr_mtl_note(mtl, ZR_MTL_NOTE_LEFT_OUT, &whole);
        break;
    case UNLESS_ZERO:
        read_idle(mtl, &whole, &line, 0.0f);
        break;
    case UNLESS_ONE:
        read_idle(mtl, &whole, &line, 1.0f);
        break;
    case SILENT:
        break;
    }
}

void zr_mtl_read_values(struct zr_mtl *mtl, const struct zr_mtl_entry *entry, struct zr_mtl_values *out)
{
    struct zr_mtl_text rest = entry->lines, line;
    memset(out, 0, sizeof *out);
    while (mtl->status == ZR_OK && zr_mtl_next(&rest, &line)) {
        read_line(mtl, line, out);
        if (zr_is_cancelled(mtl->cancel)) mtl->status = ZR_CANCELLED;
    }
}
