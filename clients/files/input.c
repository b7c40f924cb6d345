#include "input.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "options/endings.h"
#include "options/parameters.h"

#define FORMAT(ID, suffix, media_types, has_view, ...) {suffix, media_types, has_view},
static const struct {
    const char *suffix, *media_types; /* the first media type is sent */
    bool has_view;
} formats[] = {ZR_FORMAT_ROWS(FORMAT)};
enum { FORMATS = sizeof formats / sizeof formats[0] };

/* Formats of other programs, and what makes a file of them that zraster reads. */
#define CONVERT "Convert it to STL, OBJ, PLY or GLB: "
static const struct {
    const char *suffixes, *name, *advice;
} foreign[] = {
    {" step stp ", "a STEP", CONVERT "freecadcmd, or cadquery's exporters.export"},
    {" iges igs ", "an IGES", CONVERT "freecadcmd, or cadquery's exporters.export"},
    {" brep fcstd ", "a CAD", CONVERT "freecadcmd, or cadquery's exporters.export"},
    {" sldprt sldasm x_t x_b sat sab ipt iam prt catpart catproduct par psm 3dxml jt ", "a CAD",
     "Save it as STEP or STL in the program that made it"},
    {" 3dm ", "a Rhino", CONVERT "Rhino, or rhino3dm in Python"},
    {" scad ", "an OpenSCAD", CONVERT "openscad -o part.stl"},
    {" ifc ", "an IFC", CONVERT "IfcConvert building.ifc building.glb"},
    {" amf ", "an AMF", CONVERT "prusa-slicer --export-3mf, or assimp export"},
    {" dae fbx 3ds wrl x3d blend usd usda usdc usdz msh dxf ac lwo ", "a 3D",
     CONVERT "assimp export, Blender or meshio"},
    {" vtk vtu vtp vti ", "a VTK", CONVERT "meshio convert, or ParaView"},
    {" las laz e57 ", "a point cloud", CONVERT "pdal translate cloud.las cloud.ply, or CloudCompare"},
    {" splat ksplat spz sog ", "a splat", "Convert it to PLY: SuperSplat, or npx splat-transform scene.spz scene.ply"},
    {" drc ", "a Draco", CONVERT "draco_decoder -i mesh.drc -o mesh.ply"},
    {" b3dm i3dm cmpt pnts ", "a 3D Tiles", CONVERT "npx 3d-tiles-tools b3dmToGlb -i tile.b3dm -o tile.glb"},
    {" vox ", "a MagicaVoxel", CONVERT "vengi-voxconvert --input model.vox --output model.glb"},
    {" gz bz2 xz zst 7z rar tar tgz ", "a packed", "Unpack it first, such as by gunzip, unxz or tar xf"}};

static const char *ending_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
}

static size_t format_of(const char *suffix)
{
    size_t i = 0;
    while (i < FORMATS && strcasecmp(suffix, formats[i].suffix) != 0)
        i++;
    return i;
}

bool input_has_ending(const char *path)
{
    return format_of(ending_of(path)) < FORMATS;
}

enum input_kind input_kind_of(const char *path, const struct options *options)
{
    const char *type = options->own[OPTION_TYPE];
    const size_t i = format_of(type ? type : ending_of(path));
    return i == FORMATS ? INPUT_UNKNOWN : formats[i].has_view ? INPUT_SCENE : INPUT_MESH;
}

int input_check_type(const struct options *options)
{
    const char *type = options->own[OPTION_TYPE];
    if (!type || format_of(type) < FORMATS) return 0;
    return options_wrong("--type accepts one of" OPTIONS_TYPES ", not %s", type);
}

/* ---- refusals with advice ---- */

static bool refuse_foreign(const char *path, struct bytes *faults)
{
    char suffix[16];
    snprintf(suffix, sizeof suffix, " %.12s ", ending_of(path));
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign && strlen(suffix) > 2; i++)
        if (strcasestr(foreign[i].suffixes, suffix)) {
            bytes_print(faults, "it is %s file, which zraster does not read. %s", foreign[i].name, foreign[i].advice);
            return true;
        }
    return false;
}

static bool is_web_page(const struct bytes *body)
{
    static const char *const heads[] = {"<!doctype html", "<html"};
    const size_t space = body->data ? strspn(body->data, " \t\r\n") : 0;
    for (size_t i = 0; i < 2; i++)
        if (body->size > space + strlen(heads[i]) && strncasecmp(body->data + space, heads[i], strlen(heads[i])) == 0)
            return true;
    return false;
}

/* Refuses options that are keys of scenes. In a batch, which may have models, too, warnings name them. */
static bool refuse_parameters(struct input *input, const struct options *options, struct bytes *faults)
{
    char flag[FLAG_SIZE];
    const bool is_batch = options->command && strcmp(options->command->name, "batch") == 0;
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        const struct parameter_row *row = &parameter_rows[i];
        const bool has_key = strncmp(row->pointer, "/query/", strlen("/query/")) != 0;
        if (!row->of_mesh || !options->parameters[i]) continue;
        options_flag_of(row->name, strlen(row->name), flag);
        bytes_print(is_batch ? &input->warnings : faults, "%s is for meshes, ending with" OPTIONS_MESHES "; %s%s%s%s",
                    flag, has_key ? "a JSON scene has the key " : "leave it out for a JSON scene",
                    has_key ? row->pointer : "", has_key ? " in the file instead" : "", is_batch ? "\n" : "");
        if (!is_batch) return true;
    }
    return false;
}

/* ---- reading ---- */

static void find_type(struct input *input, const struct options *options)
{
    const char *type = options->own[OPTION_TYPE] ? options->own[OPTION_TYPE] : ending_of(input->path);
    const size_t i = format_of(type);
    input->is_known = i < FORMATS;
    input->is_scene = input->is_known && formats[i].has_view;
    const char *media_type = input->is_known ? formats[i].media_types : "application/octet-stream";
    snprintf(input->type, sizeof input->type, "%.*s", (int)strcspn(media_type, " "), media_type);
}

/* Reads the file that --environment names, as a part of this name. */
static bool read_environment(struct input *input, const char *name, struct bytes *faults)
{
    const bool is_file = name && strcmp(ending_of(name), "hdr") == 0;
    for (size_t i = 0; is_file && i < input->part_count; i++)
        if (strcmp(input->parts[i].name, name) == 0) return true;
    if (!is_file || input->part_count == INPUT_PARTS_MAX) return true;
    struct input_part *part = &input->parts[input->part_count++];
    part->name = strdup(name);
    if (part->name && bytes_read(&part->bytes, name)) return true;
    bytes_print(faults, "--environment %s: ", name);
    bytes_explain(faults);
    return false;
}

static bool read_parts(struct input *input, const struct options *options, struct bytes *faults)
{
    for (size_t i = 0; i < options->part_count; i++) {
        const char *equals = strchr(options->parts[i], '=');
        struct input_part *part = &input->parts[i];
        part->name = strndup(options->parts[i], (size_t)(equals - options->parts[i]));
        input->part_count = i + 1;
        if (part->name && bytes_read(&part->bytes, equals + 1)) continue;
        bytes_print(faults, "--part %s: ", options->parts[i]);
        bytes_explain(faults);
        return false;
    }
    return read_environment(input, options->parameters[PARAMETER_environment], faults);
}

bool input_read(struct input *input, const char *path, const struct options *options, struct bytes *faults)
{
    struct stat status;
    *input = (struct input){.path = path};
    find_type(input, options);
    input->is_usage = true;
    if (strcmp(path, "-") != 0 && stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        bytes_print(faults, "it is a folder; \"zraster batch %s\" draws its files", path);
        return false;
    }
    if (input->is_scene && refuse_parameters(input, options, faults)) return false;
    input->is_usage = false;
    if (!input->is_known && refuse_foreign(path, faults)) return false;
    if (!bytes_read(&input->body, path)) {
        bytes_explain(faults);
        return false;
    }
    if (input->body.size == 0)
        bytes_print(faults, "it is empty");
    else if (is_web_page(&input->body))
        bytes_print(faults, "it is an HTML page: was the download refused?");
    else
        return read_parts(input, options, faults);
    return false;
}

size_t input_parts(const struct input *input, struct zraster_part parts[INPUT_PARTS_MAX])
{
    for (size_t i = 0; i < input->part_count; i++) {
        const struct input_part *part = &input->parts[i];
        parts[i] =
            (struct zraster_part){.name = part->name,
                                  .array = {.data = bytes_text(&part->bytes), .ndim = 1, .shape = {part->bytes.size}},
                                  .flags = part->is_neighbour ? ZRASTER_OPTIONAL : 0};
    }
    return input->part_count;
}

void input_free(struct input *input)
{
    bytes_free(&input->body);
    bytes_free(&input->warnings);
    for (size_t i = 0; i < input->part_count; i++) {
        bytes_free(&input->parts[i].bytes);
        free(input->parts[i].name);
    }
}
