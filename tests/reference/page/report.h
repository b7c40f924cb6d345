/* report.h - reference: what a person gets to read. */
#ifndef ZR_TEST_REPORT_H
#define ZR_TEST_REPORT_H

#include "reference/harness.h"

enum report_style { REPORT_LINES, REPORT_TAP, REPORT_QUIET };

struct page; /* page.h */

struct report {
    enum report_style style;
    enum compare_bar bar;
    int count;         /* lines so far */
    int refused;       /* files that our readers did not take */
    struct page *page; /* NULL: no page is written */
};

/* One line for a kind, a model or a scene. The total is printed by report_total in every style. */
void report_line(struct report *report, const char *name, enum verdict verdict, const struct tally *tally);
void report_total(struct report *report, enum verdict verdict, const struct tally *tally);

/* One line for a channel that is held against its twin, over all scenes (twins.h). */
void report_channel(struct report *report, const char *name, enum verdict verdict, const char *figures);

/* A file that our readers refuse: not passed over in silence. */
void report_refused(struct report *report, const char *name, const char *reason);

/* Pictures whose colours nothing is held against: `what` they have that has no twin (look_twin.h). */
void report_no_colors(struct report *report, const char *name, const char *what);

/* Pictures of which the bar cannot be asked (struct tally). */
void report_left_out(struct report *report, const char *name, uint64_t pictures);

/* ---- failures ---- */

struct report_failure {
    const char *directory, *label;
    uint64_t number;
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    const struct harness_pictures *pictures;
    const uint32_t *alone; /* numbers of faces that differ when drawn alone */
    uint32_t alone_count;
};

/* Writes want, got and diff pictures and the scene's numbers; prints the first
 * pixels that differ. */
void report_difference(const struct report_failure *failure);

/* The wanted picture, dark, with red where another face owns the pixel, yellow where the depth
 * differs and cyan where only the colour does. To be freed. */
uint8_t *report_difference_picture(const struct harness_pictures *pictures);

/* Writes DIRECTORY/LABEL-NUMBER-{got,want,diff}.png, making the directory. */
void report_pictures(const char *directory, const char *label, uint64_t number,
                     const struct harness_pictures *pictures);

#endif
