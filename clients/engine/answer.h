/* answer.h - client: the answer to a request, by the library or the server. */
#ifndef ANSWER_H
#define ANSWER_H

#include "api/zraster.h"

#include "files/bytes.h"

struct answer {
    int status;                /* exit status: STATUS_DONE with a picture, else the reason is in `faults` */
    struct zraster_bytes file; /* valid until answer_free */
    char look[64];             /* "studio@1"; "": unknown */
    struct bytes warnings;     /* lines */
    struct bytes faults;       /* lines: "/view/eye: ...", "--look: ..." */
    zraster_picture *picture;  /* owner of the file, or NULL */
    struct bytes received;     /* owner of the file of a server */
    char type[64];
};

void answer_free(struct answer *answer);

/* Sets the status of a refusal: STATUS_USAGE if a fault is one of a parameter, else STATUS_FAILED. */
void answer_refuse(struct answer *answer);

#endif
