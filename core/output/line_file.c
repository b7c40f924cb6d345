#include "output/line_file.h"

#include "lines/line_sheet.h"
#include "overlay/annotate/annotate.h"
#include "overlay/annotate/length_text.h"
#include "output/svg.h"
#include "scene/picture.h"

bool zr_line_file_write(const struct zr_scene *scene, const struct zr_frame *frame, struct zr_buffer *out)
{
    const struct zr_line_sheet *sheet = frame->lines;
    const struct zr_edges *edges = &scene->picture->edges;
    const zr_vec3 paper = {scene->background.x, scene->background.y, scene->background.z};
    const double millimetres = sheet->pixel > 0.0 ? zr_unit_millimetres(scene->file.unit) : 0.0;
    const double width = (double)zr_stroke_width(edges->width, frame->width, frame->height);
    struct zr_svg_desc desc = {.lines = &sheet->lines,
                               .parts = sheet->parts,
                               .part_count = sheet->part_count,
                               .part_names = sheet->part_names,
                               .width = frame->width,
                               .height = frame->height,
                               .pixel = sheet->pixel > 0.0 ? sheet->pixel : 1.0,
                               .unit = millimetres > 0.0 ? "mm" : "",
                               .marks = frame->annotations ? &frame->annotations->marks : NULL,
                               .color = edges->color,
                               .paper = scene->background.w < 1.0f ? NULL : &paper};
    if (millimetres > 0.0) desc.pixel *= millimetres;
    for (int class = 0; class < ZR_STROKE_CLASSES; class ++) {
        const double own = width * (double)zr_stroke_share((enum zr_stroke_class) class) * desc.pixel;
        desc.widths[class] = millimetres > 0.0 ? zr_iso_line_width(own) : own;
    }
    return zr_svg_encode(&desc, out);
}
