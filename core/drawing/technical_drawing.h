/* technical_drawing.h - drawing, entry point of the room: a scene -> a technical drawing of it on paper.
 *
 *     page.h          paper, scale, places of the views
 *     view_lines.h    visible and hidden lines of each view
 *     cut_view.h      the section A-A
 *     part_holes.h    holes of all parts
 *     center_lines.h  their centre lines
 *     hole_notes.h    their notes
 *     overall.h       overall sizes
 *     title_block.h   frame, title block, symbol of the projection
 *     plot.h          all of it as lines and texts in millimetres
 *
 * Unit:   millimetres, converted from the file's unit; of a file without unit, one unit is drawn as one millimetre.
 * Exact:  doubles, + - * / and square roots in a fixed order; the same for any number of threads. */
#ifndef ZR_TECHNICAL_DRAWING_H
#define ZR_TECHNICAL_DRAWING_H

#include "base/run.h"
#include "base/status.h"
#include "base/warning_list.h"
#include "drawing/page.h"
#include "drawing/plot.h"
#include "scene/scene.h"

enum zr_cut_axis { ZR_CUT_NONE, ZR_CUT_X, ZR_CUT_Y, ZR_CUT_Z };

struct zr_technical_options {
    enum zr_page_size page;
    bool is_first_angle, has_hidden;
    const char *title, *date;   /* UTF-8 */
    struct zr_page_scale scale; /* .paper 0: the largest that fits */
    enum zr_cut_axis cut;       /* of the world: the section A-A */
    double cut_at;              /* share of the bounds along it, 0..1 */
};

struct zr_technical_facts {
    double sizes[3];       /* width, height, depth of the model, millimetres */
    uint32_t holes, noted; /* round holes, and those in notes */
    const char *unit;      /* of the file, the scene's; NULL: none */
};

/* Makes the drawing in the arena. Fails with ZR_BAD_SCENE, explained by *run->error, for scenes without faces, with
 * several views, with sections or combined solids of their own, and if nothing fits; with ZR_NO_MEMORY and
 * ZR_CANCELLED. Warnings are in the arena, too. */
enum zr_status zr_technical_drawing_make(const struct zr_run *run, const struct zr_scene *scene,
                                         const struct zr_technical_options *options, struct zr_plot *out,
                                         struct zr_technical_facts *facts, struct zr_warning_list *warnings);

#endif
