/* stage.h - render: the macro that chains the steps of a pipeline. Needs a local `enum zr_status status`. */
#ifndef ZR_STAGE_H
#define ZR_STAGE_H

/* Runs the stage unless an earlier one failed. */
#define STAGE(call)                                                                                                    \
    if (status == ZR_OK) status = (call)

#endif
