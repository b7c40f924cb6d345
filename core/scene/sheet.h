/* sheet.h - scene: one picture of several views. */
#ifndef ZR_SHEET_H
#define ZR_SHEET_H

#include <stdbool.h>
#include <stdint.h>

enum zr_sheet_plan {
    ZR_SHEET_VIEWS,      /* the scene's views, row by row */
    ZR_SHEET_THREE_VIEW, /* front, top, right and an isometric view, as in technical drawings */
    ZR_SHEET_BALANCED,   /* isometric views of all sides: two from above, two from below */
    ZR_SHEET_LAYOUTS
};

/* Angle of projection of ZR_SHEET_THREE_VIEW (ISO 128-30): in the third, the top view lies above the front view and the
 * right view to the right of it; in the first, below it and to the left. */
enum zr_sheet_angle { ZR_SHEET_THIRD, ZR_SHEET_FIRST };

struct zr_sheet {
    bool is_on;
    int layout, angle; /* enum zr_sheet_plan, enum zr_sheet_angle */
    uint32_t columns;  /* 0: as many as rows, or one more */
    bool has_captions; /* name and scale below each view */
};

#endif
