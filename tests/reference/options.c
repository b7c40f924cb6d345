#include "reference/options.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char options_usage[] =
    "usage: zraster-verify [options] [SCENE.json | MESH.obj | MESH.stl | FOLDER ...]\n"
    "Renders scenes with zraster and with Mesa and compares all pixels, of files in all channels; without a file,\n"
    "random polygons.\n"
    "  --triangles N       random polygons, over all kinds, counted as fans (200000)\n"
    "  --seed S            other polygons (1)\n"
    "  --kind NAME         one kind only; 'none' for no random polygons, 'list' to list them\n"
    "  --floats N          also N triangles by GLSL programs into floats: what is interpolated and lit is equal to "
    "the\n"
    "                      last bit\n"
    "  --models DIR        also stanford-bunny.obj and teapot.obj from DIR, in perspective, cut by the window\n"
    "  --preset NAME       the view of bare meshes: front, ... isometric, or 'all' (isometric)\n"
    "  --driver NAME       llvmpipe: everything is equal. softpipe, a second opinion: where another face owns a\n"
    "                      pixel, an edge within 1/256 px or an equal depth explains it (llvmpipe)\n"
    "  --transform NAME    reference: GL multiplies the matrices. independent: GL gets positions that were\n"
    "                      transformed in double, one matrix after the other: at most one pixel in a million has\n"
    "                      another owner, each within 1/256 px of an edge, depth within 1 ulp + 0.1 px of slope\n"
    "  --parity            the reference draws convex polygons as it does concave ones, by the odd-even rule in its\n"
    "                      stencil buffer, to see that this way is exact\n"
    "  --threads N         that render, on both sides (1)\n"
    "  --isa NAME          kernels for scalar, sse2, avx2, avx512 or neon, where the machine has it (the widest)\n"
    "  --failures DIR      where pictures of differences go (build/reference-failures); '': differences are counted "
    "only\n"
    "  --pictures DIR      got, want and diff pictures of all files, equal or not\n"
    "  --page FILE         a section of the report page, and FILE.row, its line of the summary\n"
    "  --title TEXT        the section's heading\n"
    "  --plain             no pictures in the section but of differences\n"
    "  --perturb X         adds X to clip-space x on the reference's side, to see the comparison fail\n"
    "  --perturb-ambient X adds X to the ambient light there, likewise\n"
    "  --perturb-lights X  adds X to x of the directions to the lights there, likewise\n"
    "  --mutant NAME       a rule of ours is wrong on purpose, to see the comparison fail; 'list' lists them. Only "
    "the\n"
    "                      zraster-verify of build/mutant has any\n"
    "  --without NAME      a fast way of ours is not taken; 'list' counts how often each was. Likewise\n"
    "  --line-rule         prints the rule by which Mesa draws lines, and nothing else: current, from Mesa 25.0 on, "
    "or\n"
    "                      older, which only the zraster-verify of build/mutant has, too\n"
    "  --tap               one TAP line a kind, a model or a file\n"
    "  --quiet             the total only\n"
    "Exit status: 0 all equal, or explained as said above; 1 differences; 2 bad usage, no reference, a named file\n"
    "that cannot be read, or nothing to compare.\n";

static bool parse_number(const char *text, uint64_t low, uint64_t high, uint64_t *out)
{
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (errno || end == text || *end || text[0] == '-' || value < low || value > high) return false;
    *out = value;
    return true;
}

static bool parse_driver(const char *text, struct harness_options *harness)
{
    harness->driver = text;
    if (strcmp(text, "softpipe") == 0) harness->bar = COMPARE_SECOND_OPINION;
    return strcmp(text, "softpipe") == 0 || strcmp(text, "llvmpipe") == 0;
}

static bool parse_transform(const char *text, struct harness_options *harness)
{
    harness->transformed = strcmp(text, "independent") == 0;
    if (harness->transformed) harness->bar = COMPARE_TRANSFORM;
    return harness->transformed || strcmp(text, "reference") == 0;
}

static bool parse_isa(const char *text, struct harness_options *harness)
{
    char known[128];
    if (zr_isa_choose(text, &harness->isa)) return true;
    zr_isa_list(known, sizeof known);
    fprintf(stderr, "zraster-verify: --isa: '%s' is no instruction set that this machine has; it has %s\n", text,
            known);
    return false;
}

static bool parse_real(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && !*end;
}

static bool parse_float(const char *text, float *out)
{
    double wide;
    bool understood = parse_real(text, &wide);
    *out = (float)wide;
    return understood;
}

/* What one option says; `option` is the character that getopt_long gives. */
static bool take(struct options *options, int option, const char *text)
{
    uint64_t threads = 1;
    switch (option) {
    case 't':
        options->random = true;
        return parse_number(text, 1, 1000000000, &options->triangles);
    case 's':
        return parse_number(text, 0, UINT64_MAX, &options->seed);
    case 'j':
        if (!parse_number(text, 1, ZR_TEAM_MAX, &threads)) return false;
        options->harness.threads = (int)threads;
        return true;
    case 'a':
        return parse_isa(text, &options->harness);
    case 'e':
        return parse_number(text, 1, 1000000, &options->floats);
    case 'k':
        options->kind = text;
        options->random = strcmp(text, "none") != 0;
        return true;
    case 'd':
        return parse_driver(text, &options->harness);
    case 'x':
        return parse_transform(text, &options->harness);
    case 'z':
        return parse_real(text, &options->harness.perturbation);
    case 'b':
        return parse_float(text, &options->harness.more_ambient);
    case 'c':
        return parse_float(text, &options->harness.more_to_x);
    case 'u':
        options->mutant = text;
        return true;
    case 'W':
        options->without = text;
        return true;
    case 'm':
        options->models = text;
        return true;
    case 'v':
        options->preset = text;
        return true;
    case 'f':
        options->harness.failures = text;
        return true;
    case 'i':
        options->pictures = text;
        return true;
    case 'g':
        options->page = text;
        return true;
    case 'l':
        options->title = text;
        return true;
    case 'o':
        options->harness.all_parity = true;
        return true;
    case 'n':
        options->plain = true;
        return true;
    case 'r':
        options->line_rule = true;
        return true;
    case 'p':
        options->style = REPORT_TAP;
        return true;
    case 'q':
        options->style = REPORT_QUIET;
        return true;
    default:
        return false;
    }
}

bool options_parse(int argc, char **argv, struct options *options)
{
    static const struct option known[] = {{"triangles", required_argument, NULL, 't'},
                                          {"seed", required_argument, NULL, 's'},
                                          {"kind", required_argument, NULL, 'k'},
                                          {"floats", required_argument, NULL, 'e'},
                                          {"models", required_argument, NULL, 'm'},
                                          {"preset", required_argument, NULL, 'v'},
                                          {"driver", required_argument, NULL, 'd'},
                                          {"transform", required_argument, NULL, 'x'},
                                          {"threads", required_argument, NULL, 'j'},
                                          {"isa", required_argument, NULL, 'a'},
                                          {"failures", required_argument, NULL, 'f'},
                                          {"pictures", required_argument, NULL, 'i'},
                                          {"page", required_argument, NULL, 'g'},
                                          {"title", required_argument, NULL, 'l'},
                                          {"perturb", required_argument, NULL, 'z'},
                                          {"perturb-ambient", required_argument, NULL, 'b'},
                                          {"perturb-lights", required_argument, NULL, 'c'},
                                          {"mutant", required_argument, NULL, 'u'},
                                          {"without", required_argument, NULL, 'W'},
                                          {"line-rule", no_argument, NULL, 'r'},
                                          {"tap", no_argument, NULL, 'p'},
                                          {"plain", no_argument, NULL, 'n'},
                                          {"parity", no_argument, NULL, 'o'},
                                          {"quiet", no_argument, NULL, 'q'},
                                          {NULL, 0, NULL, 0}};
    *options = (struct options){
        .triangles = 200000,
        .seed = 1,
        .preset = "isometric",
        .title = "Comparison",
        .harness = {.driver = "llvmpipe", .threads = 1, .isa = zr_isa_best(), .failures = "build/reference-failures"}};
    int option;
    bool said_kind = false;
    while ((option = getopt_long(argc, argv, "", known, NULL)) != -1) {
        if (!take(options, option, optarg)) return false;
        said_kind = said_kind || option == 'k';
    }
    options->path_count = argc - optind;
    options->paths = argv + optind;
    if (options->path_count == 0 && !said_kind) options->random = true;
    bool softpipe = strcmp(options->harness.driver, "softpipe") == 0;
    if (softpipe && (options->harness.transformed || options->floats)) return false;
    return (options->random || options->path_count > 0 || options->models || options->floats);
}
