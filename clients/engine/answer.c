#include "answer.h"

#include <string.h>

#include "options/options.h"

void answer_free(struct answer *answer)
{
    zraster_picture_free(answer->picture);
    bytes_free(&answer->warnings);
    bytes_free(&answer->faults);
    bytes_free(&answer->received);
}

void answer_refuse(struct answer *answer)
{
    const char *text = bytes_text(&answer->faults);
    const bool is_usage = strncmp(text, "parameter ", 10) == 0 || strstr(text, "\nparameter ");
    answer->status = is_usage ? STATUS_USAGE : STATUS_FAILED;
}
