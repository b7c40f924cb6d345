/* parameter_kinds.h - core: kinds of the values of parameters (parameter_rows.h). */
#ifndef ZR_PARAMETER_KINDS_H
#define ZR_PARAMETER_KINDS_H

/* KIND(ID, placeholder of a value in help): conversion of a text to a JSON value. Brackets: a command line may omit the
 * value, which means true. */
#define ZR_PARAMETER_KINDS(KIND)                                                                                       \
    KIND(NAME, "NAME")                                                                                                 \
    KIND(NAME_OR_FALSE, "NAME")                                                                                        \
    KIND(AXIS, "AXIS") /* x, -x and so on: a command line takes -x for the value */                                    \
    KIND(BOOL, "[BOOL]")                                                                                               \
    KIND(COUNT, "COUNT")     /* one of the numbers that the key allows */                                              \
    KIND(WHOLE, "NUMBER")    /* integer, within the range of the key */                                                \
    KIND(NUMBER, "NUMBER")   /* within the range of the key */                                                         \
    KIND(DEGREES, "DEGREES") /* likewise */                                                                            \
    KIND(PIXELS, "PIXELS")   /* likewise */                                                                            \
    KIND(SECONDS, "SECONDS")                                                                                           \
    KIND(UNITS, "UNITS")  /* greater than 0 */                                                                         \
    KIND(SIDE, "PIXELS")  /* integer, side of the window */                                                            \
    KIND(PIXEL, "PIXELS") /* integer, from 0 */                                                                        \
    KIND(VECTOR, "X,Y,Z")                                                                                              \
    KIND(PARTS, "NAME,...")   /* names, patterns or ids of parts, with commas between them */                          \
    KIND(PRESETS, "NAME,...") /* names of presets, with commas between them */                                         \
    KIND(WORDS, "NAME,...")   /* words of the key, with commas between them */                                         \
    KIND(PIXEL_LIST, "X,Y ...") /* pixels, with blanks between them */                                                  \
    KIND(PLANES, "PLANES")    /* AXIS[:FRACTION[:KEEP]], with commas between planes */                                 \
    KIND(COLOR, "COLOR")      /* opaque */                                                                             \
    KIND(BACKGROUND, "COLOR")                                                                                          \
    KIND(OUTLINE, "COLOR") /* true, false, or opaque */

/* Words of the kind WORDS: those of annotate, in the order of enum zr_annotation (scene/annotate.h). */
#define ZR_ANNOTATE_WORDS "box", "title", "triad", "scale", "labels", "holes"

#endif
